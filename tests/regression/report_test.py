"""report.html in a real browser: what it shows is what the run has left.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest report_test
"""

import base64
import csv
import functools
import io
import json
import os
import random
import re
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np
from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from browsed import Browsed
import program
from program import NO_FIGURES, PROGRAM, SOURCES
from run_folder_test import BOX

sys.path.insert(0, str(SOURCES / "apps/figures/python"))
import plot  # noqa: without it the modules of figures do not find Matplotlib's backend
import frame as frames
import sections
from matplotlib.collections import EllipseCollection
from matplotlib.colors import to_hex
from vocabulary import VOCABULARY

listric = functools.partial(program.listric, env=os.environ | NO_FIGURES)
HOSTILE = "</script><img src=x onerror=alert(1)>"


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


class Report(Browsed):
    @classmethod
    def setUpClass(cls):
        cls.make_folders()
        cls.run_folder = cls.folder / "a"
        for name, seed in (("a", "1"), ("b", "2")):
            ended = listric("run", "lis1", "--accuracy", "draft", "--seed", seed, "--set",
                            "extension.distance_m=1500", "--set", "output.figures_at_m=[1000]",
                            "--output", cls.folder / name)
            assert ended.returncode == 0, ended.stdout
        cls.open_browser()

    def open(self, file=None, words=""):
        return self.visit(f"file://{file or self.run_folder / 'report.html'}{words}")

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
            measured = np.bincount(np.load(folder / "discs_behaviour.npy"), minlength=5).tolist()
            k, present, rock, strata, end, weak, strain = self.script(
                "const [run] = page.runs, k = run.nearest(a[0]); page.t = k;"
                "await run.load(['behaviour', 'start_depth_m', 'layer_weak', 'window_tectonic_strain']);"
                "const colours = mode => Array.from(discColours(run, k, mode, 'figures', 1, a[1]), cssColour);"
                "return [k, Array.from(run.codes[k].present), colours('rock'), colours('strata'),"
                "run.moments[k].ends.window_tectonic_strain, Array.from(run.codes[k].layer_weak), colours('window')];",
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
            grey = VOCABULARY["scale"]["undefined"]["colour"]   # deposited since the window began
            self.assertEqual([strain[i] for i in there].count(grey), np.isnan(frame.strain).sum())
            self.assertEqual(drawn(frame, "strain")[0].count(grey), np.isnan(frame.strain).sum())
            self.assertGreater(np.isnan(frame.strain).sum(), 0)
            [layer] = [layer for layer in frame.layers if layer.label == "weakened"]
            self.assertEqual(sum(weak[i] == 255 for i in there), layer.rows.sum())
            found.append((frame.extension, measured, end))
        self.script("page.mode = 'window'; await draw(); return 0;")
        legend = self.driver.find_element("id", "legend").text
        self.assertAlmostEqual(float(re.search(r"([\d.]+) or more", legend)[1]), found[-1][2])
        self.assertIn(VOCABULARY["scale"]["undefined"]["label"], legend)
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
                               "[row.dataset.key, row.cells[0].title, row.cells[3].textContent]);")
            a, b = (json.loads((self.folder / name / "summary.json").read_text()) for name in ("a", other))
            self.assertGreater(len(rows), 40)
            for name, title, difference in rows:
                if other == "a":
                    self.assertRegex(difference, r"^(0|equal|-?0[.0]*( [a-z]+|°)?)", name)
                elif isinstance(a.get(name), float) and isinstance(b.get(name), float):
                    of_a, of_b = title.removeprefix(f"{name} = ").split(": ")[0].split(" and ")
                    self.assertAlmostEqual(float(of_a), a[name], delta=1e-3 * abs(a[name]))
                    self.assertAlmostEqual(float(of_b), b[name], delta=1e-3 * abs(b[name]))

    def test_07b_two_runs_say_what_differs(self):
        pair = self.folder / "differing.html"
        ended = listric("report", self.run_folder, self.folder / "b", "--output", pair)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertEqual(self.open(pair), "true")
        self.assertTrue(self.driver.find_element("id", "title").text.endswith(": seed 1 and 2"))
        self.assertEqual([name.text for name in self.driver.find_elements("class name", "name")],
                         ["A: lis1, seed 1", "B: lis1, seed 2"])
        self.assertIn("A: lis1, seed 1, draft; B: lis1, seed 2, draft", self.driver.find_element("id", "subtitle").text)
        rows = [[cell.text for cell in row.find_elements("tag name", "td")]
                for row in self.driver.find_elements("css selector", "#differences tbody tr")]
        self.assertEqual(rows, [["seed", "1", "2", ""]])
        self.open()
        self.assertFalse(self.driver.find_element("id", "differences_part").is_displayed())

    def test_07c_is_this_run_good_stands_first(self):
        self.open()
        self.assertEqual(self.script("return document.querySelector('main').firstElementChild.id;"), "quality_part")
        cards = {card.get_attribute("data-key"): card for card in self.driver.find_elements("class name", "check")}
        self.assertEqual(list(cards), [key for key in ("quasi_static", "mass_error_fraction", "volume_error_fraction",
                                       "area_balance", "still_ground_m", "flat_mobilised_friction", "width_diameters",
                                       "sediment_stress_ratio") if key in cards])
        self.assertGreater(len(cards), 4)
        summary = json.loads((self.run_folder / "summary.json").read_text())
        self.assertIn(f"{summary['area_balance']:.3f} (0.95 to 1.03)", cards["area_balance"].text)
        self.assertIn("Not judged before 5 km", cards["area_balance"].text)
        self.assertIn("good", cards["quasi_static"].get_attribute("class"))

    def test_07d_measures_have_words_units_and_few_digits(self):
        self.open()
        summary = json.loads((self.run_folder / "summary.json").read_text())
        rows = {row[0]: row[1:] for row in self.script(
            "return [...$('measures').querySelectorAll('tbody tr')].map(row => [row.dataset.key, row.cells[0].textContent,"
            "row.cells[1].textContent, row.closest('details') ? 'folded' : row.closest('section').firstChild.textContent]);")}
        self.assertEqual(rows["basin_area_m2"], ["Basin area", f"{summary['basin_area_m2'] / 1e6:.1f} km²", "Basin and block"])
        self.assertEqual(rows["rollover_tilt_deg"][1], f"{summary['rollover_tilt_deg']:.1f}°")
        self.assertEqual(rows["cutoff_z_m"][:2], ["Cutoff, depth", f"{summary['cutoff_z_m'] / 1e3:.2f} km"])
        for name in ("wall_s", "threads", "discs", "time_by_part_s.cycle"):
            self.assertEqual(rows[name][2], "folded", name)
        for name, (words, value, _) in rows.items():
            self.assertNotIn("_", words)
            mantissa = re.sub(r"e-?\d+$", "", value.split()[0].rstrip("°")) if value else ""
            if "." in mantissa and name != "state_hash":
                self.assertLessEqual(len(mantissa.replace(".", "").replace("-", "").lstrip("0")), 5, (name, value))

    def test_07f_a_result_has_its_error_in_its_own_row(self):
        self.open()
        known = {"resolution": -0.18, "speed": 0.004, "spread": "unknown"}   # the mean less that of finer grain, of a slower wall
        told = lambda *a: self.script("return valueAndError(...a);", *a)
        self.assertEqual(told(0.832, "1", 93.1, known), ["0.83", "finer grain: +0.18"])
        self.assertEqual(told(17900.0, "m", 93.1, {"spread": 450.0, "speed": 6100.0}), ["17.9 km", "slower wall: −6.1; other seeds: ±0.5"])
        self.assertEqual(told(38.12, "deg", 93.1, {"resolution": 0.03}), ["38.1°", ""])   # less than the last digit
        self.assertEqual(told(0.832, "1", 93.1, {"resolution": "unknown"}), ["0.832", ""])
        rows = ("page.runs[0].head.summary.known_errors = a[0]; drawTables(); return [...$('main_measures').rows]"
                ".map(row => [row.dataset.key, ...[...row.cells].slice(1).map(cell => cell.textContent)]);")
        found = {row[0]: row[1:] for row in self.script(rows, [{"measure": "strain_top10", **known}])}
        self.assertEqual(found["strain_top10"][1], "(finer grain: +0.18)")
        self.assertEqual(found["basin_area_m2"][1], "")
        self.assertTrue(all(len(row) == 2 for row in self.script(rows, [])))   # nothing is known: no column
        self.assertNotIn("Errors of these", self.driver.find_element("tag name", "body").text)

    def test_07g_paper_has_all_that_is_promised(self):
        self.open()
        command = self.driver.execute_cdp_cmd
        printed = base64.b64decode(command("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True})["data"])
        self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", printed)), 1)
        # The page between its margins, 277 by 190 mm, as the printer has it.
        command("Emulation.setDeviceMetricsOverride", {"width": 1047, "height": 718, "deviceScaleFactor": 1, "mobile": False})
        command("Emulation.setEmulatedMedia", {"media": "print"})
        try:
            parts = self.script("return [...document.querySelectorAll('.section, #legend, .check, #faults td, #main_measures td, footer')]"
                                ".map(part => [part.closest('[id]').id, ...['left', 'right'].map(side => part.getBoundingClientRect()[side])]);")
        finally:
            command("Emulation.setEmulatedMedia", {"media": ""})
            command("Emulation.clearDeviceMetricsOverride", {})
        for name, left, right in parts:
            self.assertTrue(-1 <= left < right <= 1048, (name, left, right))   # seen, and not cut off
        self.assertLessEqual({"sections", "legend", "quality", "faults", "main_measures", "footer"}, {name for name, *_ in parts})

    def test_07h_the_view_has_room_for_what_is_there(self):
        self.open()
        room = ("const [run] = page.runs, last = run.moments.length - 1, id = run.codes[last].present.findIndex(Boolean);"
                "run.values(last, 'depth_m')[id] = a[0]; run.values(last, 'x_m')[id] = a[1]; delete run.extent; layOut(); showWhole();"
                "const s = page.sections[0], [x, y] = s.toPixel(page.view, a[1], a[0]); return [x, y, s.discCanvas.width, s.discCanvas.height];")
        for depth, place in ((-4000.0, 20000.0), (500.0, -6000.0), (500.0, 60000.0), (22000.0, 20000.0)):
            x, y, width, height = self.script(room, depth, place)
            self.assertTrue(20 < x < width - 5 and 20 < y < height - 5, (depth, place, x, y, width, height))

    def test_07i_two_fingers_zoom(self):
        self.open()
        self.script("Element.prototype.setPointerCapture = () => {}; return 0;")
        touch = ("const c = page.sections[0].lineCanvas, b = c.getBoundingClientRect(); for (const [type, id, x, y] of a[0]) c.dispatchEvent("
                 "new PointerEvent(type, {clientX: b.left + x, clientY: b.top + y, pointerId: id})); return [page.view.scale, page.picked];")
        before = self.script("return page.view.scale;")
        scale, picked = self.script(touch, [["pointerdown", 1, 300, 100], ["pointerdown", 2, 400, 100], ["pointermove", 2, 500, 100],
                                            ["pointerup", 2, 500, 100], ["pointerup", 1, 300, 100]])
        self.assertAlmostEqual(scale / before, 2.0, delta=0.01)
        self.assertIsNone(picked)   # fingers that zoom click nothing

    def test_07e_throws_are_points_and_thin_strata_have_none(self):
        self.open()
        # Horizon, depth above and below the fault, whether it is resolved, error of the throw.
        cutoffs = [[-1, 4100, 3500, True, 40], [0, 3000, 2500, True, 20], [1, 1800, 1400, True, 90],
                   [2, 1500, 1250, False, 700], [3, 100, 100, True, 80]]
        throws = self.script("return throwPoints(a[0]);", cutoffs)
        self.assertEqual([(p["horizon"], p["throw"], p["depth"], p["error"]) for p in throws],
                         [(-1, 600, 3800, 40), (0, 500, 2750, 20), (1, 400, 1600, 90), (3, 0, 100, 80)])
        diameter = 300.0
        growth = self.script("return expansionPoints(a[0], a[1]);", cutoffs, diameter)
        # 1200 m above the fault and 1100 m below it; stratum 2 has 300 and 150 m; 3 has 1400 and 1150 m.
        self.assertEqual([p["stratum"] for p in growth], [1, 3])
        self.assertAlmostEqual(growth[0]["index"], 1200 / 1100)
        self.assertAlmostEqual(growth[0]["error"], 1200 / 1100 * np.hypot(diameter / 1200, diameter / 1100))
        self.script("drawThrows($('throws'), {}, a[0], {'-1': 'pre-rift 1000 m'}, 3); return 0;", cutoffs)
        self.assertEqual(len(self.driver.find_elements("css selector", "#throws canvas")), 1)
        # Thirteen horizons in 200 pixels, the first three at one depth: no word on another, on a point, or outside.
        box = {"left": 56, "top": 8, "right": 486, "bottom": 204}
        marks = [{"row": 40 + 12 * max(n - 2, 0), "from": 150 + 20 * n, "to": 200 + 20 * n, "width": 92} for n in range(13)]
        words = self.script("return placeWords(a[0], a[1]);", marks, box)
        self.assertGreaterEqual(len([w for w in words if w]), 12)
        points = [{"left": m["from"], "right": m["to"], "top": m["row"] - 5, "bottom": m["row"] + 5} for m in marks]
        for n, word in enumerate(words):
            if not word:
                continue
            self.assertTrue(box["left"] <= word["left"] and word["right"] <= box["right"])
            self.assertTrue(box["top"] <= word["top"] and word["bottom"] <= box["bottom"])
            for other in points + [w for w in words[:n] if w]:
                self.assertTrue(word["right"] <= other["left"] or other["right"] <= word["left"] or
                                word["bottom"] <= other["top"] or other["bottom"] <= word["top"], (n, word, other))
        self.script("drawThrows($('throws'), {}, [], {}, 3); return 0;")
        self.assertIn("known to two discs", self.driver.find_element("id", "throws").text)
        self.script("drawExpansion($('expansion'), page.runs[0], {}, [], 3); return 0;")
        self.assertIn("three discs (1,117 m)", self.driver.find_element("id", "expansion").text)

    def test_07f_time_over_the_section_holds_all_sediment(self):
        self.open()
        discs = self.discs(self.snapshots()[-1])
        width = 1000.0
        strata = self.script("const [run] = page.runs; const s = thicknessOf(run, page.t, a[0]);"
                             "return Object.entries(s).map(([n, one]) => [Number(n), one.travel, [...one.thickness]]);", width)
        for number, travel, thickness in strata:
            mine = discs["stratum"] == number
            self.assertAlmostEqual(sum(thickness) * width * 0.83, (np.pi * discs["radius"][mine] ** 2).sum(),
                                   delta=0.01 * sum(thickness) * width)
            self.assertAlmostEqual(travel, discs["start_travel"][mine][0], delta=1.0)
        self.assertEqual(len(strata), len(set(discs["stratum"])) - 1)
        self.assertEqual(len(self.driver.find_elements("css selector", "#wheeler canvas")), 1)

    def test_07f_cells_of_time_hold_three_discs_and_the_rest_is_not_resolved(self):
        self.open()
        def cells(*discs):
            return [tuple(cell) for cell in self.script(
                "return wheelerCells(a[0]).map(cell => [cell.first, cell.last, cell.discs]);", list(discs))]
        self.assertEqual(cells(1, 1, 1, 1, 1, 1), [(0, 2, 3), (3, 5, 3)])
        self.assertEqual(cells(3, 4, 5), [(0, 0, 3), (1, 1, 4), (2, 2, 5)])
        # A disc a stratum: three that are missing are a hiatus, two are what a disc is too large for.
        self.assertEqual(cells(1, 1, 1, 0, 0, 0, 1, 1, 1), [(0, 2, 3), (6, 8, 3)])
        self.assertEqual(cells(1, 1, 1, 0, 0, 1, 1, 1), [(0, 2, 3), (3, 7, 3)])
        # A disc in ten strata: ten without one are none.
        slow = [1, *[0] * 9] * 6
        self.assertEqual([(first, last) for first, last, _ in cells(*slow)], [(0, 20), (21, 59)])
        # Before the basin reached a place there is nothing; what has fewer than three discs is not resolved.
        self.assertEqual(cells(0, 0, 0, 0, 2, 1, 3), [(4, 5, 3), (6, 6, 3)])
        self.assertEqual(cells(0, 0, 0, 0, 1, 1), [(4, 5, 2)])
        self.assertEqual(cells(0, 0, 0), [])
        # Of the run: every disc is in a cell, a cell that is told apart has three, and words agree with colours.
        found, discs = self.script(
            "const [run] = page.runs, chart = wheelerChart(run, page.t, 4 * run.head.mean_radius_m), {present, stratum} = run.codes[page.t];"
            "return [chart.cells.map(cell => [cell.discs, cell.rate, wheelerWords(run, cell)]), present.filter((there, i) => there && stratum[i] > 0).length];")
        self.assertEqual(sum(count for count, _, _ in found), discs)
        for count, rate, words in found:
            self.assertEqual(rate is None, count < 3)
            self.assertEqual("not resolved" in words, count < 3)
        self.assertIn("fewer than three discs", self.driver.find_element("id", "wheeler_legend").text)

    def test_07g_the_pointer_reads_out(self):
        self.open(words="#colour=strata&shown=")
        places = self.script(
            "const s = page.sections[0], run = page.runs[0], d = s.discs(page.t); return Array.from(d.present, (there, id) => there ?"
            "[run.codes[page.t].stratum[id], ...s.toPixel(page.view, d.x[id], d.depth[id])] : null).filter(Boolean);")
        for stratum, column, row in random.Random(2).sample(places, 20):
            text = self.script(
                "const c = page.sections[0].lineCanvas, b = c.getBoundingClientRect(); c.dispatchEvent(new PointerEvent('pointermove',"
                "{clientX: b.left + a[0] * b.width / c.width, clientY: b.top + a[1] * b.height / c.height}));"
                "return page.sections[0].readout.hidden ? '' : page.sections[0].readout.textContent;", column, row)
            self.assertRegex(text, r"^x \d+\.\d\d km, -?\d+\.\d\d km deep; " + (f"stratum {stratum}$" if stratum else "pre-rift, from"))

    def test_07h_the_seismic_image_is_a_layer(self):
        self.open(words="#shown=seismic")
        self.assertIn("seismic image", self.driver.find_element("id", "layers").text)
        traces, samples, inked = self.script(
            "const lines = await page.runs[0].loadLines(page.t), {traces, samples, canvas} = lines.seismic;"
            "const pixels = new Uint8Array(canvas.getContext('2d').getImageData(0, 0, traces, samples).data.buffer);"
            "return [traces, samples, new Set(pixels.filter((_, k) => k % 4 === 0)).size];")
        self.assertGreater(traces * samples, 100_000)
        self.assertGreater(inked, 100)

    def test_07i_it_prints_on_one_page_of_everything(self):
        self.open()
        printed = base64.b64decode(self.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"])
        self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", printed)), 1)
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        try:
            for shown in ("sections", "legend", "moment", "faults", "main_measures", "footer", "quality"):
                self.assertTrue(self.driver.find_element("id", shown).is_displayed(), shown)
            for hidden in ("charts", "measures_part", "slider", "layers", "files"):
                self.assertFalse(self.driver.find_element("id", hidden).is_displayed(), hidden)
            rows = len(self.driver.find_elements("css selector", "#main_measures tbody tr"))
            self.assertTrue(8 <= rows <= 10, rows)
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})

    def test_07j_dark_and_on_a_phone(self):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        try:
            self.open()
            ground, ink, paper = self.script("return [getComputedStyle(document.body).backgroundColor, getComputedStyle(document.body).color,"
                                             "getComputedStyle(page.sections[0].host).backgroundColor];")
            brightness = [np.mean([int(n) for n in re.findall(r"\d+", colour)[:3]]) for colour in (ground, ink, paper)]
            self.assertLess(brightness[0], 60)
            self.assertGreater(brightness[1], 180)
            self.assertEqual(brightness[2], 255)   # its colours are of print
        finally:
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        try:
            self.open()
            self.assertLessEqual(self.script("return document.documentElement.scrollWidth;"), 390)
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_07k_colours_that_only_one_of_two_runs_has_are_not_offered(self):
        crumbly, pair = self.folder / "crumbly", self.folder / "crumbly.html"
        ended = listric("run", "lis1", "--accuracy", "draft", "--until", "0", "--without", "bonds", "--without", "fault_weakening",
                        "--without", "bond_healing", "--set", "extension.distance_m=1500", "--output", crumbly, "--quiet")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        ended = listric("report", self.run_folder, crumbly, "--output", pair)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertEqual(self.open(pair, "#colour=rock&t=-1.5&shown=bonds,faults"), "true")
        self.assertEqual(self.script("return [page.mode, page.t];"), ["strata", 0])
        self.driver.find_element("tag name", "body").send_keys("4")
        offered, hidden = self.script(
            "const offered = [...$('colour').options].map(option => option.value);"
            "for (page.mode of offered) for (page.t of [0, page.runs[0].moments.length - 1]) await draw();"
            "return [offered, $('trouble').hidden];")
        self.assertTrue(hidden)
        self.assertIn("window", offered)
        self.assertNotIn("rock", offered)
        self.open()
        self.assertIn("rock", self.script("return [...$('colour').options].map(option => option.value);"))

    def test_07l_the_slider_and_the_bar_of_strata_reach_to_the_longer_run(self):
        pair, cut = self.folder / "whole_pair.html", self.folder / "short_and_long.html"
        self.assertEqual(listric("report", self.run_folder, self.folder / "b", "--output", pair).returncode, 0)
        page = pair.read_text()
        begin = page.index('id="data">') + len('id="data">')
        end = page.index("</script>", begin)
        data = json.loads(page[begin:end])
        a, b = data["runs"]
        del a["moments"][2:]                                # A ends at 500 m
        cut.write_text(page[:begin] + json.dumps(data).replace("<", "\\u003c") + page[end:])
        self.assertEqual(self.open(cut), "true")
        text = lambda name: self.driver.find_element("id", name).text
        names = lambda: [name.text for name in self.driver.find_elements("class name", "name")]
        self.assertEqual(self.script("return [page.t, Number($('slider').max), page.chart.at, page.runs.map(momentOf)];"),
                         [3, 3, b["moments"][3]["extension_m"], [1, 3]])
        self.assertTrue(text("moment").startswith("B: 1.50 km, 0.150 Myr, "), text("moment"))
        self.assertEqual(names(), ["A: lis1, seed 1, here at 0.50 km", "B: lis1, seed 2"])
        with h5py.File(sorted((self.folder / "b/snapshots").glob("*.h5"))[-1]) as file:
            youngest = file["discs/start_travel"][:].max() / 1e4     # Myr at 1 cm a year
        self.assertIn(f"strata 0 {youngest:.2g}", re.sub(r"\s+", " ", text("legend")))
        self.assertEqual(self.saved("save_discs").name, "lis1-500m-discs.csv")     # A's, where it is shown
        self.driver.find_element("tag name", "body").send_keys(Keys.HOME)
        time.sleep(0.3)
        self.assertEqual((text("moment")[:10], names()), ("B: 0.00 km", ["A: lis1, seed 1", "B: lis1, seed 2"]))
        self.script("page.chart.show(1400); await new Promise(done => setTimeout(done, 300)); return 0;")
        self.assertEqual(self.script("return page.t;"), 3)

    def test_07m_a_run_that_goes_on_after_its_youngest_stratum_has_its_time_in_the_legend(self):
        self.open()
        legend = "return legendItems().find(item => item.label.includes('strata')).to;"
        to = self.script(legend)
        self.script("for (const moment of page.runs[0].moments) moment.travel_m = 2 * moment.extension_m; await draw(); return 0;")
        self.assertEqual(self.script(legend), to)           # with a stage back, in which nothing is laid down
        # A pause of a million years makes a long run of a short one.
        self.assertEqual(self.script("page.runs[0].head.extension_m = 50; page.runs[0].moments.forEach(moment => { moment.travel_m = 10000; });"
                                     "return timeUnit().name;"), "Myr")

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
        self.assertEqual(list(dips.values()), [float(f"{fault['dip_deg']:.4g}") for fault in summary["faults"]])
        self.assertEqual(self.saved("save_history").read_text().strip(),
                         (self.run_folder / "history.csv").read_text().strip())
        with Image.open(self.saved("save_png")) as picture:
            width, height = self.script("const c = page.sections[0].discCanvas; return [c.width, c.height];")
            self.assertGreater(picture.width, width + 50)    # axes beside it, words around it
            self.assertGreater(picture.height, height + 100)
            dark = np.asarray(picture.convert("L")) < 100
            for part in (dark[:25], dark[30:45], dark[50:64], dark[-45:-22], dark[-18:]):   # title, moment, axis, legend, origin
                self.assertGreater(part.sum(), 20)
        tree = xml.etree.ElementTree.parse(self.saved("save_svg"))
        said = ["".join(node.itertext()) for node in tree.iter("{http://www.w3.org/2000/svg}text")]
        self.assertIn("depth (km)", said)
        self.assertIn("distance from the breakaway (km)", said)
        self.assertIn("10", said)
        self.assertIn("pre-rift, layers of 1 km", said)
        for words in ("90-degree listric detachment", "1.50 km, 0.150 Myr", "no vertical exaggeration", "seed 1", summary["state_hash"],
                      "listric "):
            self.assertIn(words, " ".join(said))
        self.assertGreater(len(list(tree.iter("{http://www.w3.org/2000/svg}polyline"))), 5)

    def test_08b_a_saved_drawing_has_all_that_is_shown(self):
        self.open(words="#shown=" + ",".join([*VOCABULARY["layers"], "shore"]))
        legend = self.script(
            "const [run] = page.runs, lines = await run.loadLines(page.t), canvas = document.createElement('canvas');"
            "run.head.layers.push({name: 'shore', kind: 'line', label: 'the shore', ink: '#00ff00'});"
            "(lines.layers ??= {}).shore = [0, -2000, 20000, -2000];"
            "run.head.picks = {horizons: [{name: 'h', points: [[5000, 500], [9000, 700]]}], faults: [{name: 'f', points: [[1, 2], [3, 4]]}]};"
            "lines.footwall = {corners: [-900, 3000, -100, 3000, -100, 5000, -900, 5000], shear_mpa: [2], end_mpa: 2};"
            "lines.base = [{start_x_m: [0, 9000], start_depth_m: [100, 200], ddepth_m: [0, 0]}];"
            "canvas.getContext('2d').fillStyle = 'red'; canvas.getContext('2d').fillRect(0, 0, 999, 999);"
            "[page.underlay, page.data.underlay] = [canvas, {corners_m: [0, -1900, 4000, -900]}];"
            "page.layers = layersOf(page.runs); page.picked = {kind: 'fault', run, index: 0}; await draw();"
            "return legendItems().map(item => [item.label, item.colour]);")
        tree = xml.etree.ElementTree.parse(self.saved("save_svg"))
        lines = list(tree.iter("{http://www.w3.org/2000/svg}polyline"))
        inks = {line.get("stroke") for line in lines}
        layers = {layer["label"]: layer["ink"] for layer in VOCABULARY["layers"].values() if "ink" in layer}
        listed = [label for label, _ in legend if label in layers or label == "the shore"]
        self.assertGreater(len(listed), 5)
        for label, colour in legend:
            if label in listed:
                self.assertIn(colour, inks, label)
        self.assertLessEqual({layers["detachment"], layers["base before bending"], "#d4006a"}, inks)
        self.assertIn("3 3", {line.get("stroke-dasharray") for line in lines if line.get("stroke") == layers["kinematic predictions"]})
        discs, ground = (np.asarray(Image.open(io.BytesIO(base64.b64decode(image.get("href").split(",")[1]))))
                         for image in tree.iter("{http://www.w3.org/2000/svg}image"))
        self.assertEqual(discs.shape, ground.shape)
        at = {what: ground[row, column] for what, (column, row) in self.script(
            "const at = (x, depth) => page.sections[0].toPixel(page.view, x, depth).map(Math.round);"
            "return {footwall: at(-500, 4000), picture: at(2000, -1400), seismic: at(9000, 9000), sky: at(9000, -1800)};").items()}
        self.assertEqual([int(pixel[3] > 0) for pixel in at.values()], [1, 1, 1, 0])
        self.assertEqual(list(at["picture"][:3]), [255, 0, 0])
        self.assertFalse((ground[..., :3] == list(bytes.fromhex(layers["picks"][1:]))).all(axis=-1).any())   # no line twice
        self.open(words="#shown=faults")
        images = xml.etree.ElementTree.parse(self.saved("save_svg")).iter("{http://www.w3.org/2000/svg}image")
        self.assertEqual(len(list(images)), 1)

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

    def press(self, element, *keys):
        self.script("eval(a[0]).focus(); return 0;", element)
        ActionChains(self.driver).send_keys(*keys).perform()
        time.sleep(0.5)

    def test_11b_keys_do_what_belongs_to_the_focus(self):
        self.open()
        at = self.script(
            "const [run] = page.runs, [fault] = (await run.loadLines(page.t)).faults;"
            "for (const k of run.moments.keys()) { const {faults} = await run.loadLines(k); while (faults.length < 4) faults.push(fault); }"
            "await draw(); await new Promise(done => setTimeout(done, 300)); return page.t;")
        self.press("document.querySelector('#measures summary')", Keys.SPACE)
        self.assertEqual(self.script("return [document.querySelector('#measures details').open, $('play').textContent, page.t];"),
                         [True, "Play", at])
        row = "$('faults').tBodies[0].rows[1]"
        for keys, picked in (([Keys.ENTER], 1), ([Keys.TAB, Keys.SPACE], 2)):   # the row, and the one after it
            self.press(row, *keys)
            self.assertEqual(self.script("return [page.picked.index, $('play').textContent, document.activeElement.rowIndex];"),
                             [picked, "Play", picked + 1])
        self.press(row, Keys.ARROW_LEFT)
        self.assertEqual(self.script("return [page.t, document.activeElement.closest('table')?.id];"), [at - 1, "faults"])

    def test_11c_a_link_that_is_copied_is_of_what_is_shown(self):
        self.open()
        writes = self.script(
            "let writes = 0; const write = history.replaceState.bind(history);"
            "history.replaceState = (...words) => { ++writes; write(...words); };"
            "for (let n = 0; n < 40; ++n) { page.view.left += 10; await draw(); }"
            "await new Promise(done => setTimeout(done, 800)); return writes;")
        self.assertLess(writes, 10)
        self.assertGreater(writes, 0)
        address, view, copied, told = self.script(
            "for (let n = 0; n < 300; ++n) history.replaceState(null, '', '#t=0');"   # more than Chromium takes
            "Object.defineProperty(navigator, 'clipboard', {value: {writeText: async text => { page.copied = text; }}});"
            "page.view.left += 1234; page.t = 1; await draw(); $('copy').click();"
            "await new Promise(done => setTimeout(done, 100)); return [location.href, page.view, page.copied, $('copy').textContent];")
        self.assertIn("t=0", address)
        self.assertEqual(told, "copied")
        self.visit(copied)
        self.assertEqual(self.script("return page.t;"), 1)
        for name, value in self.script("return page.view;").items():
            self.assertAlmostEqual(value, view[name], delta=1e-5 * abs(view[name]), msg=name)

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

    def test_13b_a_small_model_is_seen(self):
        scene, run = self.folder / "box.toml", self.folder / "box"
        scene.write_text(BOX)
        ended = listric("run", scene, "--accuracy", "draft", "--until", "0.012m", "--output", run, "--quiet")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertEqual(self.open(run / "report.html"), "true")
        self.assertTrue(self.driver.find_element("id", "moment").text.startswith("12.00 mm, 1.200 a, "))
        share, discs, rows, marks = self.script(
            "const [s] = page.sections, [left] = s.toPixel(page.view, 0, 0), [right] = s.toPixel(page.view, 0.4, 0);"
            "return [(right - left) / s.discCanvas.width, new Set(s.painter.owner).size - 1, page.chart.rows(['discs']),"
            "s.marks(page.view).across.map(mark => mark.text)];")
        self.assertGreater(share, 0.75)
        self.assertGreater(discs, 500)
        np.testing.assert_allclose([row[0] for row in rows], [0, 4, 8, 12], atol=0.1)   # mm
        self.assertEqual(marks[:3], ["0", "20", "40"])
        closest, farthest = self.script(
            "const scales = []; for (const factor of [1.5, 1 / 1.5]) { for (let n = 0; n < 60; ++n) zoom(factor);"
            "scales.push(page.view.scale); } return scales;")
        self.assertGreater(closest * 0.004, 100)     # pixels of a disc
        self.assertGreater(farthest * 0.1, 5)        # of the model
        self.script("whole(); await pick({kind: 'disc', run: page.runs[0], id: 300});"
                    "await new Promise(done => setTimeout(done, 300)); return 0;")
        self.assertRegex(self.driver.find_element("id", "picked").text, r"is at x 0\.\d{3,4} m, depth 0\.\d{3,4} m; radius 0\.00\d+ m")
        self.open()    # what a basin had stays
        self.assertEqual(self.script("return [Math.round(page.view.top - page.runs[0].extent.top), zoomLimits()[0], page.chart.clockStep(), placeText(1500)];"),
                         [-2000, 0.001, 10, "1.50 km"])

    def test_14_status_and_a_live_page(self):
        status = json.loads((self.run_folder / "status.json").read_text())
        self.assertEqual((status["phase"], status["of_m"], status["seconds_left"]), ("finished", 1500, 0))
        run = listric("run", "lis1", "--accuracy", "draft", "--live", "--until", "500m", "--set",
                      "extension.distance_m=1500", "--output", self.folder / "d", "--quiet")
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertEqual(self.open(self.folder / "d/report.html"), "true")

    def test_14b_a_live_page_takes_over_what_is_new_without_reloading(self):
        folder = self.folder / "followed"
        process = subprocess.Popen(
            [PROGRAM, "run", "lis1", "--accuracy", "draft", "--live", "--set", "extension.distance_m=1500", "--output", folder, "--quiet"],
            cwd=SOURCES, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        for _ in range(600):
            if (folder / "report.html").exists():
                break
            time.sleep(0.05)
        self.assertEqual(self.open(folder / "report.html"), "true")
        live, moments = self.script("window.stayed = true; page.lookAfter = 200; page.look(); return [page.data.live, page.runs[0].moments.length];")
        self.assertTrue(live, "the run was over before its page was open")
        self.script("$('palette').value = 'greys'; $('palette').dispatchEvent(new Event('change')); return 0;")
        self.assertEqual(process.wait(120), 0)
        for _ in range(100):
            if not self.script("return page.data.live;"):
                break
            time.sleep(0.1)
        self.assertEqual(self.script("return [window.stayed, page.data.live, page.runs[0].moments.length > a[0], page.t + 1 === page.runs[0].moments.length,"
                                     "page.palette, $('quality').textContent.startsWith('Yes')];", moments), [True, False, True, True, "greys", True])
        self.assertEqual([entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"], [])


if __name__ == "__main__":
    unittest.main()
