"""report.html in a real browser: what it shows is what the run has left.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest report_test
"""

import csv
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from program import PROGRAM, SOURCES

sys.path.insert(0, str(SOURCES / "apps/figures/python"))
import plot  # noqa: without it the modules of figures do not find Matplotlib's backend
import frame as frames
import sections
from matplotlib.collections import EllipseCollection
from matplotlib.colors import to_hex
from vocabulary import VOCABULARY

HOSTILE = "</script><img src=x onerror=alert(1)>"


def listric(*words, **options):
    return subprocess.run([PROGRAM, *words], cwd=SOURCES, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, **options)


def browser(downloads, width=1600, height=1400):
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 f"--window-size={width},{height}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    driver.execute_cdp_cmd("Page.setDownloadBehavior",
                           {"behavior": "allow", "downloadPath": str(downloads)})
    driver.set_script_timeout(60)
    return driver


def lightness(colour, seen_by):
    """CIE L*a*b* of an sRGB colour as somebody without green cones sees it (Machado et al. 2009)."""
    linear = np.array([c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
                       for c in np.array(colour) / 255.0])
    if seen_by == "deuteranope":
        linear = np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                           [-0.011820, 0.042940, 0.968881]]) @ linear
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722],
                    [0.0193, 0.1192, 0.9505]]) @ np.clip(linear, 0.0, 1.0)
    f = np.cbrt(xyz / np.array([0.9505, 1.0, 1.089]))
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def figure_frames(run_folder, place):
    """The frames of a run's figures as the program writes them for the scripts that draw."""
    keeper = place / "keeper"
    keeper.write_text('#!/bin/sh\nfor word; do if [ -f "$word/000000/frame.json" ]; then '
                      f"rm -rf '{place}/frames'; cp -r \"$word\" '{place}/frames'; fi; done\n")
    keeper.chmod(0o755)
    ended = listric("figures", run_folder, env={**os.environ, "LISTRIC_PYTHON": str(keeper)})
    assert ended.returncode == 0, ended.stdout
    return sorted((place / "frames").iterdir())


def drawn(frame, panel):
    """The colours of the discs of a figure, and the end of its colour bar."""
    figure = sections.draw_figure(frame, [panel], 20)
    [discs] = [shapes for shapes in figure.axes[0].collections if isinstance(shapes, EllipseCollection)]
    return list(map(to_hex, discs.get_facecolors())), figure.axes[1].get_ylim()[1]


def counted(colours):
    """How many discs have the colour of each class of rock."""
    return [colours.count(rock["colour"]) for rock in VOCABULARY["rock_classes"]]


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.run_folder = cls.folder / "a"
        for name, seed in (("a", "1"), ("b", "2")):
            ended = listric("run", "lis1", "--accuracy", "draft", "--seed", seed, "--set",
                            "extension.distance_m=1500", "--set", "output.figures_at_m=[1000]",
                            "--output", cls.folder / name)
            assert ended.returncode == 0, ended.stdout
        cls.downloads = cls.folder / "downloads"
        cls.driver = browser(cls.downloads)
        cls.addClassCleanup(cls.driver.quit)

    def open(self, file=None, words=""):
        self.driver.get("about:blank")
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(f"file://{file or self.run_folder / 'report.html'}{words}")
        for _ in range(300):
            if ready := self.driver.execute_script("return document.documentElement.dataset.ready"):
                return ready
            time.sleep(0.1)
        self.fail("the page did not become ready")

    def script(self, text, *arguments):
        """What an asynchronous function with this body returns."""
        ended = self.driver.execute_async_script(
            "const done = arguments[arguments.length - 1]; (async (...a) => {" + text +
            "})(...arguments).then(value => done([value]), error => done(String(error)));",
            *arguments)
        self.assertIsInstance(ended, list, ended)
        return ended[0]

    def snapshots(self):
        return sorted((self.run_folder / "snapshots").glob("*.h5"))

    def discs(self, snapshot):
        with h5py.File(snapshot) as file:
            order = np.argsort(file["discs/id"][:])
            return {name: file["discs"][name][:][order] for name in file["discs"]}

    def saved(self, button):
        for old in self.downloads.glob("*"):
            old.unlink()
        self.script(f"$('{button}').click(); return 0;")
        for _ in range(100):
            files = [f for f in self.downloads.glob("*") if f.suffix != ".crdownload"]
            if files and files[0].stat().st_size:
                return files[0]
            time.sleep(0.1)
        self.fail(f"{button} saved nothing")

    def test_01_opens_from_disk_and_asks_for_nothing(self):
        self.assertEqual(self.open(), "true")
        self.assertEqual(self.driver.get_log("browser"), [])
        asked = [message["params"]["request"]["url"] for entry in self.driver.get_log("performance")
                 if (message := json.loads(entry["message"])["message"])["method"]
                 == "Network.requestWillBeSent"]
        self.assertEqual([url for url in asked if not url.startswith(("file:", "data:", "blob:"))], [])
        self.assertEqual(len([url for url in asked if url.startswith("file:")]), 1)

    def test_02_places_are_those_of_the_snapshots(self):
        self.open()
        for k, path in enumerate(self.snapshots()):
            discs = self.discs(path)
            there, x, depth, stratum, rock, bonds = self.script(
                "const [run] = page.runs, k = a[0]; await run.load(['bonds']);"
                "return [Array.from(run.codes[k].present), Array.from(run.values(k, 'x_m')),"
                "Array.from(run.values(k, 'depth_m')), Array.from(run.codes[k].stratum),"
                "Array.from(run.codes[k].rock), Array.from(run.codes[k].bonds)];", k)
            step = self.script("return page.runs[0].head.scales.x_m.step;")
            ids = np.flatnonzero(there)
            np.testing.assert_array_equal(ids, discs["id"])
            self.assertLessEqual(np.abs(np.array(x)[ids] - discs["x"]).max(), 0.501 * step)
            self.assertLessEqual(np.abs(np.array(depth)[ids] + discs["y"]).max(), 0.501 * step)
            np.testing.assert_array_equal(np.array(stratum)[ids], discs["stratum"])
            np.testing.assert_array_equal(np.array(rock)[ids] >= 2, discs["stratum"] > 0)
            with h5py.File(path) as file:
                bonded = file["contacts/bonded"][:] > 0
                ends = np.concatenate((file["contacts/first"][:][bonded],
                                       file["contacts/second"][:][bonded]))
                count = np.bincount(ends, minlength=len(ids))[np.argsort(file["discs/id"][:])]
            np.testing.assert_array_equal(np.array(bonds)[ids], count)

    def test_02b_bonds_are_those_of_the_snapshots(self):
        self.open()
        for k, path in enumerate(self.snapshots()):
            pairs = np.array(self.script(
                "await page.runs[0].load(bondStreams); return page.runs[0].bonds(a[0]);", k))
            with h5py.File(path) as file:
                ids, bonded = file["discs/id"][:], file["contacts/bonded"][:] > 0
                ends = np.sort([ids[file["contacts/first"][:][bonded]],
                                ids[file["contacts/second"][:][bonded]]], axis=0)
            self.assertEqual(sorted(map(tuple, pairs.reshape(-1, 2).tolist())),
                             sorted(map(tuple, ends.T.tolist())))

    def test_03_the_address_chooses_a_moment(self):
        with open(self.run_folder / "history.csv", newline="") as file:
            history = [float(row["extension_m"]) for row in csv.DictReader(file)]
        self.assertEqual(len(history), len(self.snapshots()))
        for k, extension in enumerate(history):
            self.assertEqual(self.open(words=f"#t={k}"), "true")
            shown = self.driver.find_element("id", "moment").text
            self.assertTrue(shown.startswith(f"{extension / 1000:.2f} km"), shown)
            painted = self.script("return new Set(page.sections[0].painter.owner).size - 1;")
            discs = len(self.discs(self.snapshots()[k])["id"])
            self.assertLess(abs(painted - discs), 0.02 * discs)

    def click(self, x, y, which="lineCanvas"):
        self.script(
            f"const c = page.sections[0].{which}, b = c.getBoundingClientRect();"
            "for (const type of ['pointerdown', 'pointerup']) c.dispatchEvent(new PointerEvent(type,"
            "{clientX: b.left + a[0] * b.width / c.width, clientY: b.top + a[1] * b.height / c.height,"
            "pointerId: 1})); await new Promise(done => setTimeout(done, 60)); return 0;", x, y)

    def test_04_a_click_names_what_is_there(self):
        # A synthetic pointer cannot be captured.
        self.open(words="#t=2&shown=detachment")
        self.script("Element.prototype.setPointerCapture = () => {}; return 0;")
        places = self.script(
            "const s = page.sections[0], d = s.discs(page.t); return Array.from(d.present, (there, id) =>"
            "there ? [id, ...s.toPixel(page.view, d.x[id], d.depth[id])] : null).filter(Boolean);")
        for id, column, row in random.Random(1).sample(places, 100):
            self.click(column, row)
            self.assertEqual(self.script("return page.picked.id;"), id)
        self.assertIn(f"disc {id}:", self.driver.find_element("id", "picked").text)
        self.open()
        self.script("Element.prototype.setPointerCapture = () => {}; return 0;")
        summary = json.loads((self.run_folder / "summary.json").read_text())
        self.assertEqual(self.script("return (await page.runs[0].loadLines(page.t)).faults.length;"),
                         len(summary["faults"]))
        for index, fault in enumerate(summary["faults"]):
            column, row = self.script(
                "const f = (await page.runs[0].loadLines(page.t)).faults[a[0]];"
                "return page.sections[0].toPixel(page.view, ...f.points[Math.floor(f.points.length / 2)]);",
                index)
            self.click(column, row)
            self.assertEqual(self.script("return [page.picked.kind, page.picked.index];"), ["fault", index])
            self.assertIn(f"dip {fault['dip_deg']:.1f}", self.driver.find_element("id", "picked").text)

    def test_05_colours_are_those_of_the_table(self):
        self.open(words="#colour=rock&shown=")
        pixels = self.script(
            "const s = page.sections[0], k = page.t, run = page.runs[0], d = s.discs(k), found = [];"
            "const colours = discColours(run, k, 'rock', 'figures', 1, 1), c = s.discCanvas;"
            "for (let id = 0; id < d.present.length && found.length < 50; id += 61) if (d.present[id]) {"
            "  const [x, y] = s.toPixel(page.view, d.x[id], d.depth[id]).map(Math.floor);"
            "  found.push([cssColour(colours[id]), Array.from(c.getContext('2d').getImageData(x, y, 1, 1).data)]); }"
            "return found;")
        self.assertEqual(len(pixels), 50)
        for wanted, pixel in pixels:
            self.assertEqual(wanted, "#%02x%02x%02x" % tuple(pixel[:3]))
        named = {rock["name"]: list(bytes.fromhex(rock["colour"][1:])) for rock in VOCABULARY["rock_classes"]}
        weak = named.pop("weakened")
        self.assertEqual(max(weak), weak[0])  # a red brown
        for other in named.values():
            for eye in ("everybody", "deuteranope"):
                self.assertGreaterEqual(np.linalg.norm(lightness(weak, eye) - lightness(other, eye)), 10.0)

    def check_one_truth(self, run_folder, place, file=None):
        """Classes of rock, ends of scales and strata are the same in the program, figures and page."""
        self.open(file or run_folder / "report.html")
        folders = figure_frames(run_folder, place)
        self.assertGreater(len(folders), 1)
        found = []
        for folder in folders:
            frame = frames.load_frame(str(folder))
            measured = np.bincount(np.load(folder / "discs_behaviour.npy"), minlength=4).tolist()
            k, present, rock, strata, end, weak = self.script(
                "const [run] = page.runs, k = run.nearest(a[0]); page.t = k;"
                "await run.load(['behaviour', 'start_depth_m', 'layer_weak']);"
                "const colours = mode => Array.from(discColours(run, k, mode, 'figures', 1, a[1]), cssColour);"
                "return [k, Array.from(run.codes[k].present), colours('rock'), colours('strata'),"
                "run.moments[k].ends.window_strain, Array.from(run.codes[k].layer_weak)];",
                frame.meta["extension_m"], frame.strata)
            there = np.flatnonzero(present)
            self.assertEqual(counted(drawn(frame, "behaviour")[0]), measured)
            self.assertEqual(counted([rock[i] for i in there]), measured)
            self.assertEqual(sum(measured), len(there))
            self.assertEqual(end, json.loads((folder / "frame.json").read_text())["strain_end"])
            self.assertEqual(drawn(frame, "strain")[1], end)
            in_page, in_figure = (np.sort([list(bytes.fromhex(colour[1:])) for colour in colours], axis=0)
                                  for colours in ([strata[i] for i in there], drawn(frame, "strata")[0]))
            differ = np.abs(in_page - in_figure).max(axis=1) > 1
            self.assertLess(differ.mean(), 0.01)   # whose depth in the page, rounded, is of another layer
            [layer] = [layer for layer in frame.layers if layer.label == "weakened"]
            self.assertEqual(sum(weak[i] == 255 for i in there), layer.rows.sum())
            found.append((frame.extension, measured, end))
        self.script("page.mode = 'window'; await draw(); return 0;")
        legend = self.driver.find_element("id", "legend").text
        self.assertAlmostEqual(float(re.search(r"([\d.]+) or more", legend)[1]), found[-1][2])
        return found

    def test_05b_page_and_figures_tell_one_truth(self):
        found = self.check_one_truth(self.run_folder, self.folder)
        self.assertGreater(min(map(len, (f[1] for f in found))), 3)
        self.assertGreater(sum(n > 0 for n in found[-1][1]), 2)   # discs of several classes

    def test_05c_strain_is_light_where_nothing_happens(self):
        self.open(words="#colour=window")
        first, last = self.script("const table = paletteOf('window', page.palette);"
                                  "return [cssColour(table[0]), cssColour(table[255])];")
        self.assertGreater(lightness(list(bytes.fromhex(first[1:])), "everybody")[0], 95.0)
        self.assertLess(lightness(list(bytes.fromhex(last[1:])), "everybody")[0], 20.0)

    def test_05d_a_layer_that_the_page_does_not_know_is_drawn_by_its_kind(self):
        self.open(words="#shown=")
        self.script(
            "const [run] = page.runs, lines = await run.loadLines(page.t);"
            "for (const [name, kind, ink, rows] of [['shore', 'line', '#00ff00', [0, -2000, 20000, -2000]],"
            "['lake', 'band', '#0000ff', [0, 500, 900, 20000, 500, 900]]]) {"
            "  run.head.layers.push({name, kind, label: 'the ' + name, ink}); (lines.layers ??= {})[name] = rows; }"
            "run.head.layers.push({name: 'marked', kind: 'discs', label: 'the marked', ink: '#ff0000'});"
            "run.codes[page.t].marked = run.codes[page.t].present.map(there => 255 * there);"
            "run.moments[0].streams.marked = 0; run.codes[0].marked = [];"
            "page.layers = layersOf(page.runs); $('layers').textContent = ''; addLayers();"
            "for (const box of $('layers').querySelectorAll('input')) if (box.parentElement.textContent"
            ".includes('the ')) box.click(); await draw(); return 0;")
        shown = self.driver.find_element("id", "layers").text
        for label in ("the shore", "the lake", "the marked"):
            self.assertIn(label, shown)
        pixel = ("const s = page.sections[0], [x, y] = s.toPixel(page.view, a[0], a[1]).map(Math.round), found = [];"
                 "for (let dy = -2; dy <= 2; ++dy) found.push(Array.from(s[a[2]].getContext('2d')"
                 ".getImageData(x, y + dy, 1, 1).data.slice(0, 3))); return found;")
        self.assertIn([0, 255, 0], self.script(pixel, 10000, 2000, "lineCanvas"))
        self.assertIn([0, 0, 255], self.script(pixel, 10000, -700, "discCanvas"))
        self.assertIn([255, 0, 0], self.script(pixel, 10000, 3000, "discCanvas"))

    def test_06_slider_and_chart_move_together(self):
        self.open()
        self.script("$('slider').value = 1; $('slider').dispatchEvent(new Event('input'));"
                    "await new Promise(done => setTimeout(done, 300)); return 0;")
        self.assertAlmostEqual(self.script("return page.chart.at;"),
                               self.script("return page.runs[0].moments[1].extension_m;"))
        ink = self.script("const c = page.chart.chart, x = c.toDomXCoord(page.chart.at / 1000);"
                          "const all = [...$('history').querySelectorAll('canvas')].map(canvas => {"
                          "const r = canvas.width / canvas.clientWidth; return Array.from(canvas.getContext('2d')"
                          ".getImageData(Math.round(x * r), 20 * r, 1, 1).data); }); return all;")
        self.assertTrue(any(pixel[0] > 120 and pixel[1] < 90 for pixel in ink), ink)
        chart = self.driver.find_element("css selector", "#history canvas:last-of-type")
        x, width = self.script("const c = page.chart.chart; return [c.toDomXCoord(page.runs[0].moments[2]"
                               ".extension_m / 1000), $('history').clientWidth];")
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", chart)
        ActionChains(self.driver).move_to_element_with_offset(chart, x - width / 2, 0).click().perform()
        time.sleep(0.5)
        self.assertEqual(self.script("return page.t;"), 2)

    def test_07_two_runs(self):
        pair = self.folder / "pair.html"
        for other in ("a", "b"):
            ended = listric("report", self.run_folder, self.folder / other, "--output", pair)
            self.assertEqual(ended.returncode, 0, ended.stdout)
            self.assertEqual(self.open(pair), "true")
            rows = self.script("return [...$('measures').querySelectorAll('tbody tr')].map(row =>"
                               "[...row.cells].map(cell => cell.textContent));")
            a, b = (json.loads((self.folder / name / "summary.json").read_text()) for name in ("a", other))
            self.assertGreater(len(rows), 40)
            for name, of_a, of_b, difference in rows:
                if other == "a":
                    self.assertIn(difference, ("0", "equal"), name)
                elif isinstance(a.get(name), float) and isinstance(b.get(name), float):
                    self.assertAlmostEqual(float(of_a), a[name], delta=1e-3 * abs(a[name]))
                    self.assertAlmostEqual(float(of_b), b[name], delta=1e-3 * abs(b[name]))
                    self.assertAlmostEqual(float(difference), b[name] - a[name],
                                           delta=1e-3 * abs(b[name] - a[name]) + 1e-12)

    def test_08_saved_tables_say_the_same(self):
        self.open()
        discs = self.discs(self.snapshots()[-1])
        with open(self.saved("save_discs"), newline="") as file:
            rows = list(csv.DictReader(file))
        np.testing.assert_array_equal([int(row["id"]) for row in rows], discs["id"])
        step = self.script("return page.runs[0].head.scales.x_m.step;")
        self.assertLessEqual(np.abs(np.array([float(row["x_m"]) for row in rows]) - discs["x"]).max(), 0.501 * step)
        with open(self.saved("save_horizons"), newline="") as file:
            strata = {float(row["stratum"]) for row in csv.DictReader(file)}
        self.assertEqual({s for s in strata if s > 0}, set(map(float, np.unique(discs["stratum"][discs["stratum"] > 0]))))
        summary = json.loads((self.run_folder / "summary.json").read_text())
        with open(self.saved("save_faults"), newline="") as file:
            dips = {row["fault"]: float(row["dip_deg"]) for row in csv.DictReader(file)}
        self.assertEqual(list(dips.values()), [fault["dip_deg"] for fault in summary["faults"]])
        self.assertEqual(self.saved("save_history").read_text().strip(),
                         (self.run_folder / "history.csv").read_text().strip())
        self.assertTrue(self.saved("save_png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("<polyline", self.saved("save_svg").read_text())

    def test_09_a_hostile_description_is_text(self):
        scene = self.folder / "hostile.toml"
        text = (SOURCES / "apps/scenes/lis1.toml").read_text()
        scene.write_text(re.sub(r'^description = .*$', lambda _: f"description = '{HOSTILE}'", text, flags=re.M))
        ended = listric("run", scene, "--accuracy", "draft", "--until", "500m", "--set",
                        "extension.distance_m=1500", "--output", self.folder / "h", "--quiet")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertEqual(self.open(self.folder / "h/report.html"), "true")
        self.assertEqual(self.driver.find_element("id", "title").text, HOSTILE)
        self.assertEqual(self.driver.find_elements("tag name", "img"), [])

    def test_10_a_small_file_says_what_it_lacks(self):
        whole = (self.run_folder / "report.html").stat().st_size / 1e6
        small = self.folder / "small.html"
        ended = listric("report", self.run_folder, "--most-mb", f"{0.9 * whole:.3f}", "--output", small)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertLess(small.stat().st_size / 1e6, 0.9 * whole)
        self.assertEqual(self.open(small), "true")
        self.assertIn("left out so that the file is smaller: bonds", self.driver.find_element("id", "subtitle").text)
        ended = listric("report", self.run_folder, "--most-mb", "0.1")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("--most-mb 0.1", ended.stdout)

    def test_11_all_by_keyboard(self):
        self.open()
        controls = self.script("return [...document.querySelectorAll('button, select, input')].filter(e =>"
                               "e.offsetParent).map(e => (e.dataset.n = Math.random()) && e.dataset.n);")
        reached = set()
        body = self.driver.find_element("tag name", "body")
        for _ in range(3 * len(controls)):
            ActionChains(self.driver).send_keys(Keys.TAB).perform()
            reached.add(self.driver.execute_script("return document.activeElement.dataset.n"))
        self.assertEqual(set(controls) - reached, set())
        self.driver.execute_script("document.activeElement.blur()")
        at = self.script("return page.t;")
        for key, moment in ((Keys.ARROW_LEFT, at - 1), (Keys.HOME, 0), (Keys.ARROW_RIGHT, 1), (Keys.END, at)):
            body.send_keys(key)
            time.sleep(0.2)
            self.assertEqual(self.script("return page.t;"), moment)
        body.send_keys("2")
        time.sleep(0.3)
        self.assertEqual(self.script("return page.mode;"), "window")

    def test_12_damage_is_said(self):
        text = (self.run_folder / "report.html").read_text()
        at = text.index('"depth_m":[', text.index('"moments"')) + 200
        damaged = self.folder / "damaged.html"
        damaged.write_text(text[:at] + text[at + 1:])
        self.assertEqual(self.open(damaged), "false")
        said = self.driver.find_element("id", "trouble")
        self.assertTrue(said.is_displayed())
        self.assertIn("Snapshot data damaged", said.text)

    def test_12b_a_page_that_is_not_whole_says_so(self):
        summary = self.run_folder / "summary.json"
        whole, page = summary.read_text(), self.folder / "lacking.html"
        try:
            summary.write_text('{"finished": tr')
            ended = listric("report", self.run_folder, "--output", page)
        finally:
            summary.write_text(whole)
        self.assertEqual(ended.returncode, 4, ended.stdout)
        self.assertEqual(self.open(page), "true")   # the section is there
        said = self.driver.find_element("id", "lacks")
        self.assertTrue(said.is_displayed())
        self.assertIn("This page is not whole: ", said.text)
        self.assertIn("summary.json is damaged", said.text)
        self.assertIn("missing", self.driver.find_element("id", "measures").text)

    def test_12c_a_file_that_is_cut_off_or_broken_says_so(self):
        text = (self.run_folder / "report.html").read_text()
        data = text.index('id="data">')
        script = text.index('"use strict";', data)
        for k, broken in enumerate((text[:script + 5000], text[:data + 3000],
                                    text[:data + 12] + "nonsense" + text[data + 12:],
                                    text.replace('id="vocabulary">{', 'id="vocabulary">', 1))):
            page = self.folder / f"broken-{k}.html"
            page.write_text(broken)
            self.driver.get(f"file://{page}")   # returns when it is loaded
            time.sleep(0.3)
            said = self.driver.find_element("id", "trouble")
            self.assertTrue(said.is_displayed(), k)
            self.assertIn("listric report DIR", said.text)

    def test_13_without_a_report_the_run_is_the_same(self):
        state = json.loads((self.run_folder / "summary.json").read_text())["state_hash"]
        run = ("run", "lis1", "--accuracy", "draft", "--set", "extension.distance_m=1500",
               "--set", "output.figures_at_m=[1000]", "--output", self.folder / "c", "--quiet")
        self.assertEqual(listric(*run, "--no-report", "--until", "1km").returncode, 0)
        self.assertFalse((self.folder / "c/report.html").exists())
        (self.folder / "c/report.html").mkdir()  # cannot be written
        ended = listric(*run, "--resume")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertIn("warning: no report", (self.folder / "c/log.txt").read_text())
        summary = json.loads((self.folder / "c/summary.json").read_text())
        self.assertEqual(summary["state_hash"], state)

    def test_14_status_and_a_live_page(self):
        status = json.loads((self.run_folder / "status.json").read_text())
        self.assertEqual((status["phase"], status["of_m"], status["seconds_left"]), ("finished", 1500, 0))
        run = listric("run", "lis1", "--accuracy", "draft", "--live", "--until", "500m", "--set",
                      "extension.distance_m=1500", "--output", self.folder / "d", "--quiet")
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertEqual(self.open(self.folder / "d/report.html"), "true")


if __name__ == "__main__":
    unittest.main()
