"""The drawing page in a real browser, without the model: what a hand does in it. page/page_draw.py has the page with the model.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest draw_test

Frame times are printed with LISTRIC_SHOW=1.
"""

import json
import math
import os
import re
import shutil
import time
import tomllib
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from browsed import Browsed
from program import NO_FIGURES, SOURCES, listric

SCENES = sorted((SOURCES / "apps/scenes").glob("*.toml"))


def picture_file(path, width=400, height=150):
    from matplotlib import image
    image.imsave(path, [[(0.9, 0.8, x / width) for x in range(width)] for _ in range(height)])


class Draw(Browsed):
    has_model = False
    most_bytes = 360_000

    @classmethod
    def setUpClass(cls):
        cls.make_folders()
        ended = listric("draw", cwd=cls.folder)
        assert ended.returncode == 0 and ended.stdout == "lis1-drawing.html\n", ended.stdout
        cls.page = cls.folder / "lis1-drawing.html"
        cls.fit(cls.page)
        cls.open_browser(1200, 1000)

    @classmethod
    def fit(cls, page):
        """Takes the model out of a page, if it has one."""
        if not cls.has_model:
            page.write_text(re.sub(r'(<script type="text/plain" id="(?:module|worker)">)[^<]*', r"\1", page.read_text()))

    def draw(self, *words, output):
        """A page that `listric draw` writes."""
        ended = listric("draw", *words, "-o", output, "--threads", "1")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.fit(output)
        return output

    def open(self, file=None):
        self.assertEqual(self.visit(f"file://{file or self.page}"), "true", self.text("trouble"))

    def text(self, element):
        return self.driver.find_element("id", element).text

    def frame(self):
        self.script("await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))); return 0;")

    def handle(self, key):
        return self.driver.find_element("css selector", f'.handle[data-key="{key}"] .reach')

    def drag(self, key, across, down):
        """Drags a handle by pixels, as a hand does."""
        actions = ActionChains(self.driver, duration=20)
        actions.move_to_element(self.handle(key)).click_and_hold()
        for _ in range(4):
            actions.move_by_offset(across // 4, down // 4)
        actions.release().perform()
        self.frame()

    def state(self):
        """What the page says of the scene once the program, if there is one, has read it."""
        return self.script("await verdictNow(); return $('state').textContent;")

    def assert_good(self):
        self.assertIn("finds no fault" if self.has_model else "decides", self.state())

    def shape(self):
        return self.script("return shapeNow();")

    def scene(self):
        return self.script("return page.state.scene;")

    def read_into_page(self, *files):
        """Gives the page files as its file input does, of which one is there."""
        field = self.driver.find_element("id", "file")
        self.script("$('file').hidden = false; return 0;")
        field.send_keys("\n".join(map(str, files)))
        for _ in range(100):
            if not self.script("return $('file').value;"):
                break
            time.sleep(0.02)
        self.frame()

    def saved(self, button="save"):
        for old in self.downloads.glob("*"):
            old.unlink()
        self.script(f"$('{button}').click(); return 0;")
        for _ in range(100):
            files = sorted(file for file in self.downloads.glob("*") if file.suffix != ".crdownload")
            if files and all(file.stat().st_size for file in files):
                return files
            time.sleep(0.03)
        self.fail(f"{button} saved nothing: {self.text('told')}")

    def test_01_is_one_small_file_that_asks_for_nothing(self):
        self.assertLessEqual(self.page.stat().st_size, self.most_bytes)
        self.open()
        self.assertEqual(self.driver.get_log("browser"), [])
        asked = [message["params"]["request"]["url"] for entry in self.driver.get_log("performance")
                 if (message := json.loads(entry["message"])["message"])["method"] == "Network.requestWillBeSent"]
        self.assertEqual([url.split(":")[0] for url in asked if not url.startswith(("data:", "blob:"))], ["file"])
        self.assert_good()
        self.assertIn("depth of 15.00 km at x = 15.00 km", self.text("told"))

    def test_02_a_node_is_dragged_and_the_chain_stays_tangential(self):
        self.open()
        self.script("$('add').click(); return 0;")           # the arc becomes two
        self.assertEqual([p["kind"] for p in self.shape()["pieces"]], ["arc", "arc", "line"])
        place = self.script("const {end} = page.chain[0]; return [end.x, end.y];")
        self.drag("node 0", 40, 24)
        after, scale = self.script("const {end} = page.chain[0]; return [[end.x, end.y], page.section.view.scale];")
        self.assertAlmostEqual(after[0], place[0] + 40 / scale, delta=2 / scale)
        self.assertAlmostEqual(after[1], place[1] - 24 / scale, delta=2 / scale)
        joints = self.script("return page.chain.slice(1).map((s, k) => Math.abs(s.startDip - page.chain[k].endDip));")
        self.assertLess(max(joints), 1e-9)
        depth = self.script("return depthOf(shapeNow());")
        self.assertAlmostEqual(self.scene()["hanging_wall"]["thickness_m"], depth, delta=0.01)
        told = self.text("told")
        self.assertIn(f"depth of {depth / 1000:.2f} km", told)
        self.assertRegex(told, r"Node 1: x [\d.]+ km, depth [\d.]+ km; arc of radius [\d.]+ km, dip 90.0° to [\d.]+°")
        self.drag("turn 0", 40, 0)
        self.assertLess(self.shape()["startDip"], 89.0)
        depth = self.script("return depthOf(shapeNow());")
        self.drag("node 1", 30, 30)                            # where it soles out: the arc keeps its end flat
        self.assertEqual(self.shape()["pieces"][1]["endDip"], 0)
        self.assertGreater(self.script("return depthOf(shapeNow());"), depth)
        self.assert_good()
        frames = self.script("return frameTimes;")
        if os.environ.get("LISTRIC_SHOW"):
            print(f"frames while dragging: {len(frames)}, median {sorted(frames)[len(frames) // 2]:.1f} ms, most {max(frames):.1f} ms")

    def test_03_add_remove_undo_redo(self):
        self.open()
        before = self.scene()
        places = self.script("const box = page.section.svg.getBoundingClientRect(), p = pointAt(page.chain, 9000),"
                             "[x, y] = page.section.px(p.x, -p.y); return [x - box.width / 2, y - box.height / 2];")
        surface = self.driver.find_element("css selector", "#section svg")
        ActionChains(self.driver).move_to_element_with_offset(surface, *map(round, places)).double_click().perform()
        self.frame()
        self.assertEqual(len(self.shape()["pieces"]), 3)
        self.assertAlmostEqual(self.shape()["pieces"][0]["endDip"], 90 - math.degrees(9000 / 15000), delta=1.0)
        self.assertAlmostEqual(self.script("return depthOf(shapeNow());"), 15000, delta=0.5)   # nothing moved
        self.drag("node 0", 20, 0)
        self.drag("node 0", 0, 20)
        changed = self.scene()
        for _ in range(3):
            self.script("$('undo').click(); return 0;")
        self.assertEqual(self.scene(), before)
        self.assertFalse(self.driver.find_element("id", "undo").is_enabled())
        for _ in range(3):
            self.script("$('redo').click(); return 0;")
        self.assertEqual(self.scene(), changed)
        self.script("chooseHandle('node 0'); $('remove').click(); return 0;")
        self.assertEqual([p["kind"] for p in self.shape()["pieces"]], ["arc", "line"])
        self.script("chooseHandle('node 1'); $('add').click(); return 0;")     # a line gets a ramp
        self.assertEqual([p["kind"] for p in self.shape()["pieces"]], ["arc", "line", "arc", "arc", "line"])
        self.assert_good()
        self.script("chooseHandle('node 0'); return 0;")
        self.script("$('keep_depth').checked = true; return 0;")
        depth = self.script("return depthOf(shapeNow());")
        self.drag("node 1", 24, 12)
        self.assertAlmostEqual(self.script("return depthOf(shapeNow());"), depth, delta=0.1)
        self.script("chooseHandle('node 1'); return 0;")

    def test_03b_any_change_leaves_a_detachment_that_the_program_takes(self):
        """Thousands of random drags, turns, additions and removals."""
        self.open()
        faults, count = self.script("""
            let seed = 1, count = 0;
            const chance = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648, faults = [];
            for (const begin of a[0]) for (let t = 0; t < 20; ++t) {
              let shape = shapeOf(begin);
              for (let step = 0; step < 60; ++step) {
                const k = Math.floor(chance() * shape.pieces.length), {end} = chainOf(shape)[k], far = chance() < 0.2 ? 40000 : 2000, kind = chance();
                const next = kind < 0.55 ? dragNode(shape, k, {x: end.x + (chance() - 0.5) * far, y: end.y + (chance() - 0.5) * far})
                  : kind < 0.7 ? addNode(shape, k, chance()) : kind < 0.85 ? removeNode(shape, k) : turnStart(shape, chance() * 120 - 15);
                if (!next) continue;
                ++count;
                const kink = chainOf(next).some((s, n, all) => n > 0 && s.startDip !== all[n - 1].endDip && !("startDip" in next.pieces[n]));
                const why = (model ? answerOf("pieces", tableOf(next)).fault : !isWhole(next)) || (kink ? "a kink" : depthOf(next) > 0 ? "" : "no depth");
                if (why) faults.push([why, JSON.stringify(shape), JSON.stringify(next)]);
                shape = next;
              }
            }
            return [faults.slice(0, 3), count];""", [tomllib.loads(path.read_text())["detachment"] for path in SCENES
                                                     if path.stem in ("lis1", "lis2", "rfr")])
        self.assertEqual(faults, [])
        self.assertGreater(count, 2500)

    def test_04_a_picture_lies_under_it(self):
        picture, over = self.folder / "section.png", self.folder / "over.html"
        picture_file(picture)
        self.open(self.draw("lis1", "--over", picture, "--corners", "0,-1000,40000,14000", output=over))
        self.assertEqual(self.script("return cornersOf(pictureNow());"), [0, -1000, 40000, 14000])
        left, top, right = self.script("const b = page.section.image.getBoundingClientRect(), s = page.section.svg"
                                       ".getBoundingClientRect(); return [b.left - s.left, b.top - s.top, b.right - s.left];")
        for found, wanted in zip((left, top, right), self.script("const from = page.section.px(0, -1000), [to] = page.section.px(40000, 0);"
                                                                 "return [...from, to];")):
            self.assertAlmostEqual(found, wanted, delta=0.5)
        # Two points that are dragged to known places of the picture, and where these are.
        self.script("setTool('picture'); return 0;")
        self.drag("reference a", 80, 60)
        pixel = self.script("return page.state.picture[0];")
        self.assertGreater(pixel["px"], 20)
        self.assertEqual(self.script("return cornersOf(pictureNow()).map(Math.round);"), [0, -1000, 40000, 14000])
        field = self.driver.find_element("id", "reference_a_x")
        field.clear()
        field.send_keys("5000\n")
        corners = self.script("return cornersOf(pictureNow());")
        share = pixel["px"] / 400
        self.assertAlmostEqual(corners[0] + share * (corners[2] - corners[0]), 5000, delta=0.1)
        self.assertAlmostEqual(corners[2], 40000, delta=0.1)
        self.assertIn(f"listric figures DIR --underlay {picture}", self.text("corners"))
        self.open()                                      # the other way: given to the page itself
        self.read_into_page(picture)
        self.assertTrue(self.script("return page.section.image.getAttribute('href').startsWith('data:image/png');"))
        broken, page = self.folder / "broken.jpg", self.folder / "broken.html"
        # The parts of a JPEG, and nothing that a browser could show.
        broken.write_bytes(b"\xff\xd8\xff\xc0\0\x08\x08\0\x02\0\x03\0\xff\xda\0\x02\xff\xd9")
        self.open(self.draw("--over", broken, output=page))
        self.assertIn("broken.jpg: is damaged", self.text("told"))
        for words, why in ((("--over", self.folder / "none.png"), "no such file"), (("--over", __file__), "PNG"),
                           (("--corners", "0,0,1,1"), "is of --over")):
            ended = listric("draw", *words, "-o", self.folder / "no.html", cwd=self.folder)
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(why, ended.stdout)

    def test_10_a_drawn_scene_with_picks_is_checked_and_run(self):
        self.open()
        self.script("$('add').click(); return 0;")
        self.drag("node 0", 32, -12)
        self.script("setTool('picks'); $('new_horizon').click(); return 0;")
        surface = self.driver.find_element("css selector", "#section svg")
        for across in (-200, 100, -50):
            ActionChains(self.driver).move_to_element_with_offset(surface, across, -60).click().perform()
        self.script("$('new_fault').click(); return 0;")
        for down in (-60, 20):
            ActionChains(self.driver).move_to_element_with_offset(surface, 60 + down, down).click().perform()
        picks = self.script("return page.state.picks;")
        self.assertEqual(picks["horizons"][0]["x_m"], sorted(picks["horizons"][0]["x_m"]))
        self.assertEqual([len(picks[kind][0]["x_m"]) for kind in ("horizons", "faults")], [3, 2])
        self.saved()
        for _ in range(100):
            if len(list(self.downloads.glob("*.csv"))) == 2:
                break
            time.sleep(0.03)
        place = self.folder / "drawn"
        shutil.copytree(self.downloads, place)
        [scene] = place.glob("*.toml")
        ended = listric("check", scene)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.open(self.draw(scene, output=self.folder / "again.html"))
        self.assertEqual(self.script("return page.state.picks;"), picks)
        if self.has_model:
            self.open()
            self.read_into_page(scene, *sorted(place.glob("*.csv")))
            self.assertEqual(self.script("return page.state.picks;"), picks)
            self.assertNotIn("Drop", self.text("told"))
        ended = listric("run", scene, "--accuracy", "draft", "--until", "1km", "--output", place / "run", "--no-report", "--quiet",
                        env=os.environ | NO_FIGURES)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertTrue(json.loads((place / "run/summary.json").read_text())["finished"])

    def test_11_keyboard_alone(self):
        self.open()
        controls = self.script("return [...document.querySelectorAll('button, select, input, textarea, summary, .handle')].filter(e =>"
                               "!e.disabled && e.checkVisibility() && (e.type !== 'radio' || e.checked))"
                               ".map(e => e.dataset.n = String(Math.random()));")
        reached = set()
        for _ in range(len(controls) + 40):
            ActionChains(self.driver).send_keys(Keys.TAB).perform()
            reached.add(self.driver.execute_script("return document.activeElement.dataset.n"))
            if reached >= set(controls):
                break
        missed = [self.script("return document.querySelector(`[data-n='${a[0]}']`)?.outerHTML;", n) for n in set(controls) - reached]
        self.assertEqual(missed, [])
        self.script("page.section.handles.find(h => h.dataset.key === 'node 0').focus(); return 0;")
        before = self.script("return depthOf(shapeNow());")
        press = lambda *keys: ActionChains(self.driver).send_keys(*keys).perform()
        press("a")
        self.assertEqual(len(self.shape()["pieces"]), 3)
        press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.script("return document.activeElement.dataset.key;"), "node 0")
        self.assertNotEqual(self.script("return depthOf(shapeNow());"), before)
        press(Keys.DELETE)
        self.assertEqual(len(self.shape()["pieces"]), 2)
        for _ in range(3):
            ActionChains(self.driver).key_down(Keys.CONTROL).send_keys("z").key_up(Keys.CONTROL).perform()
        self.assertEqual(self.script("return [depthOf(shapeNow()), shapeNow().pieces.length];"), [before, 2])
        self.script("setTool('picks'); $('new_horizon').focus(); return 0;")
        press(Keys.ENTER)
        self.script("$('add_pick').focus(); return 0;")
        press(Keys.ENTER)
        x = self.script("return lineNow().x_m[0];")
        self.assertEqual(self.script("return document.activeElement.dataset.key;"), "pick 0")
        press(Keys.ARROW_LEFT)
        self.assertEqual(self.script("return lineNow().x_m[0];"), x - 100)
        press(Keys.DELETE)
        self.assertEqual(self.script("return lineNow().x_m.length;"), 0)

    def test_12_a_phone(self):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 800, "deviceScaleFactor": 2, "mobile": True})
        try:
            self.open()
            wide = self.script("return [document.documentElement.scrollWidth, [...document.querySelectorAll('main *')].filter(e =>"
                               "e.getBoundingClientRect().right > 391 && !e.closest('.scroll') && !e.closest('svg')).length];")
            self.assertEqual(wide, [390, 0])
            box = self.script("const b = page.section.svg.getBoundingClientRect(); return [b.width, b.height];")
            self.assertGreater(box[1], 200)
            self.drag("turn 0", 20, 0)
            self.assertLess(self.shape()["startDip"], 90)
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_12b_two_fingers_zoom(self):
        self.open()
        self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
        try:
            left, top = self.script("const box = page.section.svg.getBoundingClientRect(); return [box.left + 500, box.top + 150];")
            before, middle, scene = self.script("return [page.section.view.scale, page.section.metres(500, 150), page.state.scene];")
            touch = lambda kind, *spread: self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
                {"x": left + side * x, "y": top, "id": n} for x in spread for n, side in enumerate((-1, 1))]})
            touch("touchStart", 50)
            for spread in (70, 90, 100):
                touch("touchMove", spread)
            touch("touchEnd")
            self.frame()
            self.assertAlmostEqual(self.script("return page.section.view.scale;") / before, 2.0, delta=0.02)
            after = self.script("return page.section.metres(500, 150);")
            self.assertAlmostEqual(after["x"], middle["x"], delta=3 / before)
            self.assertEqual(self.scene(), scene)
            self.script("showWhole(); return 0;")
            self.drag("turn 0", 20, 0)                           # one finger, or a mouse, drags as before
            self.assertLess(self.shape()["startDip"], 90)
        finally:
            self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})

    def test_12c_nothing_that_is_pressed_lies_within_another(self):
        self.open()
        self.assertEqual(self.script("return document.querySelectorAll('summary input, summary button, label button').length;"), 0)

    def test_13_a_hostile_text_is_text(self):
        scene = self.folder / "hostile.toml"
        text = (SOURCES / "apps/scenes/lis1.toml").read_text()
        hostile = "</script><img src=x onerror=alert(1)>"
        scene.write_text(re.sub(r"^description = .*$", lambda _: f"description = '{hostile}'", text, flags=re.M))
        self.open(self.draw(scene, output=self.folder / "hostile.html"))
        self.assertEqual(self.text("title"), hostile)
        self.assertEqual(self.driver.find_elements("tag name", "img"), [])

    def type_at(self, path, text):
        """Types into the field of a parameter, of a table that may be closed, and returns what the page objects."""
        self.script("for (let e = document.getElementById(a[0]); e; e = e.parentElement) if (e.tagName === 'DETAILS') e.open = true;"
                    "return 0;", f"at_{path}")
        field = self.driver.find_element("id", f"at_{path}")
        field.clear()
        field.send_keys(text, Keys.TAB)
        return self.driver.find_element("id", f"at_{path}_fault").text

    def type_into_find(self, text):
        find = self.driver.find_element("id", "find")
        find.clear()
        find.send_keys(text or " ")

    def press(self, name):
        """Presses the button of this name."""
        self.script("const button = [...document.querySelectorAll('#forms button')].find(b => (b.ariaLabel ?? b.textContent) === a[0]);"
                    "button.closest('.table').querySelectorAll('details').forEach(details => { details.open = true; });"
                    "button.scrollIntoView({block: 'center'}); button.id = 'pressed'; return 0;", name)
        self.driver.find_element("id", "pressed").click()
        self.script("$('pressed')?.removeAttribute('id'); return 0;")

    def test_13b_stages_layers_and_old_faults_are_made_by_hand(self):
        self.open()
        before = self.scene()
        self.press("Add a stage")
        self.assertEqual(self.script("return document.activeElement.id;"), "at_stage.0.distance_m")
        self.type_at("stage.0.distance_m", "10000")
        for stage, (key, text) in enumerate((("distance_m", "-500"), ("pause_a", "200000")), 1):
            self.press("Add a stage")
            self.assertEqual(self.type_at(f"stage.{stage}.{key}", text), "")
        self.driver.find_element("id", "at_stage.1.sedimentation").send_keys("fill", Keys.TAB)
        self.type_at("detachment.footwall_top_m", "30000")
        self.type_at("extension.distance_m", "")
        back, rest = {"distance_m": -500, "sedimentation": "fill"}, {"pause_a": 200000}
        self.assertEqual(self.scene()["stage"], [{"distance_m": 10000}, back, rest])
        self.press("Up stage 3")
        self.assertEqual(self.script("return document.activeElement.ariaLabel;"), "Up stage 2")
        self.press("Down stage 1")
        self.assertEqual(self.scene()["stage"], [rest, {"distance_m": 10000}, back])
        self.script("$('undo').click(); return 0;")
        self.assertEqual(self.script("return $('at_stage.1.pause_a').value;"), "200000")
        self.press("Add an old fault")
        self.assertEqual(self.type_at("old_fault.0.points", "[12000, 1000], [15000, 6000]"), "")
        self.press("Add a layer")
        for key, text in (("name", "salt"), ("top_m", "4000"), ("thickness_m", "1000"), ("material", "salt")):
            self.assertEqual(self.type_at(f"layer.0.{key}", text), "")
        self.assert_good()
        [file] = self.saved()
        self.assertEqual(file.read_text().count("[[stage]]"), 3)
        saved = tomllib.loads(file.read_text())
        wanted = {"stage": [{"distance_m": 10000}, rest, back], "old_fault": [{"points": [[12000, 1000], [15000, 6000]]}],
                  "layer": [{"name": "salt", "top_m": 4000, "thickness_m": 1000, "material": "salt"}]}
        self.assertEqual({name: saved[name] for name in wanted}, wanted)
        ended = listric("check", file)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        for typed, why in (("stage.5.pause_a = 1", "the next is stage.3" if self.has_model else "unknown key"), ("old_fault.1.name = b\n", "is set")):
            self.type_into_find(typed)
            self.assertIn(why, self.text("found"))
        self.type_into_find("")
        self.assertEqual(self.scene()["old_fault"][1], {"name": "b"})
        for name in ("old fault 2", "layer 1", "old fault 1", "stage 2", "stage 1", "stage 1"):
            self.press(f"Remove {name}")
        self.assertEqual([name for name in wanted if name in self.scene()], [])
        self.assertEqual(self.script("return [...page.forms.fields.keys()].filter(path => /[.]\\d/.test(path));"), [])
        self.script("change('', state => setAt(state, 'detachment.base', 'moves')); return 0;")      # a word of older scenes is shown
        self.assertEqual(self.script("return $('at_detachment.base').value;"), "moves")
        for _ in range(50):
            self.script("$('undo').click(); return 0;")
        self.assertEqual(self.scene(), before)

    def slide(self, share):
        self.script("const slider = $('extension'); slider.value = a[0] * slider.max; slider.dispatchEvent(new Event('input')); return 0;", share)
        self.frame()
        return self.script("return page.extension;")

    def test_14b_the_slider_reaches_every_distance(self):
        self.open()
        for distance in (10000, 11230, 0.07, 1234.5678901):
            self.script("change('', state => setAt(state, 'extension.distance_m', a[0])); return 0;", distance)
            self.assertEqual(self.script("return page.extension;"), distance)
            self.assertAlmostEqual(self.slide(0.5), distance / 2)
            self.assertEqual(self.slide(1.0), distance)
        self.script("change('', state => setAt(state, 'extension.distance_m', 10000)); return 0;")
        ActionChains(self.driver).click(self.driver.find_element("id", "extension")).perform()   # its middle
        before = self.script("return page.extension;")
        self.assertAlmostEqual(before, 5000, delta=100)
        ActionChains(self.driver).send_keys(Keys.ARROW_LEFT).perform()
        self.assertEqual(self.script("return page.extension;"), before - 50)

    def test_14_what_needs_the_model_says_so(self):
        if self.has_model:
            return
        self.open()
        lis1 = SOURCES / "apps/scenes/lis1.toml"
        self.read_into_page(lis1)
        self.assertEqual(self.text("told"), "lis1.toml: to read a scene needs the model of the program, which this page does not have; "
                                            "begin with: listric draw lis1.toml")
        self.assertIn(".ci/run page makes it", self.text("no_module"))
        self.assertFalse(self.driver.find_element("id", "run_controls").is_displayed())
        self.script("const field = $('at_hanging_wall.porosity'); field.value = '0,2'; field.onchange(); return 0;")
        self.assertEqual(self.state(), "hanging_wall.porosity: 0,2 is no number")
        self.script("const field = $('at_hanging_wall.porosity'); field.value = '0.2'; field.onchange(); return 0;")
        [file] = self.saved()
        wanted = tomllib.loads(lis1.read_text())
        wanted["hanging_wall"]["porosity"] = 0.2
        self.assertEqual(tomllib.loads(file.read_text()), wanted)
        self.assertEqual(listric("check", file).returncode, 0)

    def test_15_files_of_others_stay(self):
        other = self.folder / "mine.html"
        other.write_text("<!DOCTYPE html>\nmine")
        ended = listric("draw", "-o", other)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("no page that draw wrote", ended.stdout)
        self.assertEqual(other.read_text(), "<!DOCTYPE html>\nmine")
        for scene, why in (("lis3", "lis1"), ("flexure", "flexure")):
            ended = listric("draw", scene, "-o", self.folder / "no.html")
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(why, ended.stdout)
        self.assertFalse((self.folder / "no.html").exists())


if __name__ == "__main__":
    unittest.main()
