"""The drawing page with the model in it: what it reads, says, predicts and writes is what the program has. `.ci/run page`
calls it.

    LISTRIC_PROGRAM=../../build/ci/listric python3 -m unittest page.page_draw
"""

import json
import math
import os
import re
import shutil
import tomllib
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
import draw_test
from draw_test import SCENES, picture_file
from program import NO_FIGURES, SOURCES, listric
from run_folder_test import BOX


# Out, a rest, slowly back, a rest shorter than the change of stages, out again: 4 km at most after 10.26 km of travel.
STAGED = """
[hanging_wall]
length_m = 30000.0
thickness_m = 9000.0
[detachment]
segments = [{arc = {radius_m = 9000.0, end_dip_deg = 0.0}}, {line = {length_m = 60000.0}}]
footwall_top_m = 30000.0
[extension]
rate_m_per_a = 0.005
ramp_s = 300.0
[[stage]]
distance_m = 3000
[[stage]]
pause_a = 200_000
speed_m_per_s = 4.0
[[stage]]
distance_m = -1500.0
rate_m_per_a = 0.002
[[stage]]
pause_a = 2000
[[stage]]
distance_m = 2500.0
speed_m_per_s = 0.5
[output]
figures_at_m = [1000.0, 5500.0]
[gravity]
[bonds]
[sedimentation]
"""


class PageDraw(draw_test.Draw):
    has_model = True
    most_bytes = 1_500_000

    def test_05_forms_refuse_and_say_why(self):
        self.open()
        for path, typed, why in (("detachment.friction", "11", "at least 0, at most 10"), ("hanging_wall.porosity", "0,2", "wrong type .*decimal comma; write 0.2"),
                                 ("materials.basement", "mat18-c", "did you mean mat18-b?"), ("seed", "1.5", "integer"),
                                 ("output.figures_at_m", "5000, x", "wrong type")):
            self.assertRegex(self.type_at(path, typed), why)
            self.assertIn(path, self.state())
            for old in self.downloads.glob("*"):
                old.unlink()
            self.script("await save(); return 0;")
            self.assertIn("Not saved", self.text("told"))
            self.assertEqual(list(self.downloads.glob("*")), [])
            self.type_at(path, "")
        self.assert_good()
        for typed, why in (("extension.rate = 0.02", "did you mean rate_m_per_a?"), ("porosty", "did you mean hanging_wall.porosity"),
                           ("detachment.friction = -1", "at least 0")):
            self.type_into_find(typed)
            self.assertIn(why, self.text("found"))
        self.type_into_find("extension.rate_m_per_a = 0.02\n")
        self.assertEqual(self.scene()["extension"]["rate_m_per_a"], 0.02)

    def test_05b_forms_of_lists_refuse_and_say_why(self):
        self.open()
        for name in ("stage", "layer", "old fault"):
            self.press(f"Add a{'n' * (name[0] == 'o')} {name}")
        self.press("Add a stage")
        for path, typed, why in (("stage.1.distance_m", "5e7", r"^out of range \(5e7\), allowed: at least -1e6"),
                                 ("stage.1.distance_m", "0,2", "^wrong type .*decimal comma; write 0.2"), ("stage.0.pause_a", "long", '^wrong type .string "long"'),
                                 ("old_fault.0.points", "[1, 2], [3]", r"^old_fault\[0\].points\[1\]: needs two numbers"),
                                 ("layer.0.friction", "-1", "^out of range"), ("layer.0.top", "deep", "^wrong type|needs")):
            self.assertRegex(self.type_at(path, typed), why)
            self.assertIn(re.sub(r"\.(\d)", r"[\1]", path) + ": ", self.state())
            self.script("await save(); return 0;")
            self.assertIn("Not saved", self.text("told"))
            self.type_at(path, "")
        self.press("Remove old fault 1")
        self.press("Remove layer 1")
        self.type_at("extension.distance_m", "")
        marked = lambda: self.script("await verdictNow(); return [...document.querySelectorAll('#forms .bad > summary > b')].map(b => b.textContent);")
        self.type_at("stage.0.distance_m", "1000")     # what the whole scene is wrong in has its field
        self.assertEqual(marked(), ["Stage 2"])
        self.assertRegex(self.script("return $('at_stage.1.distance_m_fault').textContent;"), "is missing; a stage needs distance_m.*or pause_a")
        self.type_at("stage.1.distance_m", "500")
        self.type_at("stage.1.pause_a", "3000")
        self.assertEqual(marked(), ["Stage 2"])
        self.assertIn("a stage moves or rests", self.script("return $('at_stage.1.pause_a_fault').textContent;"))
        for text, found in (("stage.1.pause_a = 0", "out of range (0)"), ("stage.3.pause_a = 3000", "there are 2, counted from 0; the next is stage.2"),
                            ("stage.1.pose = 3000", "unknown key, allowed: distance_m, pause_a"), ("pause_a", "2 parameters"), ("old_fault band", "1 parameter")):
            self.type_into_find(text)
            self.assertIn(found, self.text("found"))
        self.type_into_find("stage.2.pause_a = 3000\n")
        self.type_at("stage.1.pause_a", "")
        self.assert_good()
        self.assertEqual(self.scene()["stage"], [{"distance_m": 1000}, {"distance_m": 500}, {"pause_a": 3000}])

    def test_05c_files_of_layers_are_dropped_on_the_page(self):
        self.open()
        self.press("Add a layer")
        for key, text in (("name", "salt"), ("thickness_m", "1000"), ("material", "salt"), ("top_csv", "top.csv")):
            self.type_at(f"layer.0.{key}", text)
        self.assertIn("top.csv: no such file", self.state())
        self.assertIn('top_csv = "top.csv"', self.what_is_saved()["lis1-drawn.toml"])
        self.assertIn("It needs top.csv beside it", self.text("told"))
        top = self.folder / "top.csv"
        top.write_text("x_m,depth_m\n0,4000\n40000,5000\n")
        self.read_into_page(top)
        self.assertIn("top.csv is read with the scene", self.text("told"))
        self.assert_good()
        top.write_text("x_m,depth_m\n0,deep\n")
        self.read_into_page(top)
        self.assertIn("top.csv:2", self.state())

    def test_06_shipped_scenes_come_back_equal(self):
        self.open()
        for path in SCENES:
            text = path.read_text()
            written = self.script("model.give('/s.toml', a[0]); return model.ask('text', model.ask('document', {scene: '/s.toml'}));", text)
            self.assertEqual(tomllib.loads(written), tomllib.loads(text), path.name)
            self.assertEqual(str(tomllib.loads(written)["hanging_wall"]), str(tomllib.loads(text)["hanging_wall"]))  # 1.0 is no 1
        for name in ("rfr.toml", "pure-shear.toml", "lis1-mud.toml", "salt-cover.toml", "em139.toml"):     # by the page's own way in and out
            self.read_into_page(SOURCES / "apps/scenes" / name)
            self.assert_good()
            [file] = self.saved()
            self.assertEqual(file.name, name.replace(".toml", "-drawn.toml"))
            self.assertEqual(tomllib.loads(file.read_text()), tomllib.loads((SOURCES / "apps/scenes" / name).read_text()))
        odd = 'd = """x\\\n  y"""\ne = \'\'\'z\'\'\'\nf = [1, 2.5, # comment\n 0x1F, 9223372036854775807]\n' \
              'g = {h = true, i.j = "\\u00e9\\n"}\n[a]\n"b c" = 1\n[[k]]\nl = -1e-3\n[[k]]\n'
        found = self.script("model.give('/s.toml', a[0]); return model.ask('text', model.ask('document', {scene: '/s.toml'}));", odd)
        self.assertEqual(tomllib.loads(found), tomllib.loads(odd))

    def test_09_discs_and_time_are_the_programs(self):
        """What the model in the page says of a scene is what the program says of it."""
        staged = self.folder / "staged.toml"
        staged.write_text(STAGED)
        for path in [*(SOURCES / "apps/scenes" / name for name in ("rfr-elastic.toml", "inversion-lis1.toml")), staged]:
            self.open(self.draw(path, output=self.folder / "program.html"))
            ours, of_page = self.script("checkSoon(); await verdictNow(); return [facts.now, page.now];")
            for facts in (ours, of_page):
                for own in (facts.pop, facts["in_force"].pop):      # the page's scene has a name of its own
                    own("name")
                facts.pop("toml")
            self.assertEqual(of_page, ours, path.name)
            self.assertGreater(self.script("return page.seconds.standard;"), 1.0)

    def what_is_saved(self):
        """Texts that the page would save, by their files' names."""
        return self.script("const files = {}; download = (name, text) => { files[name] = text; }; await save(); return files;")

    def test_10b_a_file_of_picks_that_is_not_dropped_keeps_its_shift(self):
        place = self.folder / "shifted"
        place.mkdir()
        files = {"horizons": "name,x_m,depth_m,age_a\ntop,3000.1,200,\ntop,9000.7,300,\n", "faults": "name,x_m,depth_m\nf,8000.3,100\nf,8500,900\n"}
        for kind, text in files.items():
            (place / f"{kind[0]}.csv").write_text(text)
        names = {"horizons": "h.csv", "faults": "f.csv"}
        lis1 = (SOURCES / "apps/scenes/lis1.toml").read_text()
        observed = lis1 + '\n[observed]\nhorizons = "h.csv"\nfaults = "f.csv"\n'
        for text, default in ((observed + "shift_x_m = -1500.0\n", 0.0),
                              (observed.replace("[detachment]", "[detachment]\nshift_x_m = -1500.0"), -1500.0)):
            scene = place / "s.toml"
            scene.write_text(text)
            self.open()
            self.read_into_page(scene)
            after = tomllib.loads(self.what_is_saved()["s.toml"])["observed"]
            self.assertEqual(after.pop("shift_x_m", default), -1500.0)
            self.assertEqual(after, names)
            self.read_into_page(place / "h.csv")
            self.assertEqual(self.script("return page.state.picks.horizons[0].x_m;"), [3000.1 - 1500, 9000.7 - 1500])
            after = self.what_is_saved()
            self.assertEqual(tomllib.loads(after["s.toml"])["observed"],
                             {"horizons": "s-horizons.csv", "faults": "f.csv", "shift_x_m": -1500.0})
            self.assertEqual(after["s-horizons.csv"], files["horizons"])         # as it was read
            self.read_into_page(place / "f.csv")
            after = self.what_is_saved()
            self.assertEqual(tomllib.loads(after["s.toml"])["observed"].get("shift_x_m", default), 0.0)
            rows = (after["s-horizons.csv"] + after["s-faults.csv"]).splitlines()
            self.assertEqual([float(row.split(",")[1]) for row in rows if "_m" not in row], [1500.1, 7500.7, 6500.3, 7000])
        # The program finds the picks where the page had them.
        self.open()
        scene.write_text(observed + "shift_x_m = -1500.0\n")
        self.read_into_page(scene, place / "h.csv")
        for name, text in self.what_is_saved().items():
            (place / name).write_text(text)
        picks = self.script("return page.state.picks.horizons;")
        self.open(self.draw(scene, output=self.folder / "shifted.html"))
        found = self.script("return page.state.picks;")
        self.assertEqual(found["horizons"], picks)
        self.assertEqual(found["faults"][0]["x_m"], [6500.3, 7000])

    def test_10c_picks_by_hand_in_place_of_a_file_are_told_of(self):
        scene = self.folder / "named.toml"
        scene.write_text((SOURCES / "apps/scenes/lis1.toml").read_text() + '\n[observed]\nhorizons = "h.csv"\nshift_x_m = -1500.0\n')
        self.open()
        self.read_into_page(scene)
        self.script("setTool('picks'); $('new_horizon').click(); addPick({x: 3000, y: -200}); return 0;")
        self.assertEqual(tomllib.loads(self.what_is_saved()["named.toml"])["observed"], {"horizons": "named-horizons.csv"})
        self.assertIn("Its horizons take the place of h.csv, which was not dropped", self.text("told"))
        self.assertNotIn("It needs h.csv", self.text("told"))
        ink = json.loads((SOURCES / "apps/figures/vocabulary.json").read_text())["layers"]["picks"]["ink"]   # as in figures
        red, green, blue = bytes.fromhex(ink[1:])
        self.assertEqual(self.script("return getComputedStyle(document.querySelector('#section .pick.chosen .mark')).fill;"),
                         f"rgb({red}, {green}, {blue})")

    def test_10d_a_drawn_scene_has_a_name_of_its_own_and_keeps_its_picture(self):
        place, picture = self.folder / "pictured", self.folder / "section.png"
        place.mkdir()
        picture_file(picture)
        self.open()
        self.read_into_page(picture)
        self.script("$('add').click(); change('', state => { Object.assign(state.picture[0], {px: 40, py: 15, x: 1234.567, depth: 300});"
                    "Object.assign(state.picture[1], {px: 360, py: 135, x: 30000, depth: 12345}); }); return 0;")
        corners = self.script("return cornersOf(pictureNow());")
        [file] = self.saved()
        self.assertEqual(file.name, "lis1-drawn.toml")
        self.assertRegex(self.text("told"), r"listric check ./lis1-drawn.toml, then listric run ./lis1-drawn.toml --accuracy standard\. "
                                            "It needs section.png beside it")
        scene = shutil.copy(file, place)
        shutil.copy(picture, place)
        ended = listric("run", scene, "--accuracy", "draft", "--until", "500m", "--output", place / "run", "--no-report", "--threads", "1",
                        env=os.environ | NO_FIGURES)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertRegex(ended.stdout.splitlines()[-1], "draft traces few faults: run it with --accuracy standard, about ")
        ended = listric("figures", place / "run", "--underlay", picture, "--only", "strata", "--width", "85mm")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        other = shutil.copy(picture, place / "other.png")
        self.assertIn("--corners: are missing", listric("figures", place / "run", "--underlay", other).stdout)
        self.open()
        self.read_into_page(scene, picture)
        again = self.script("return cornersOf(pictureNow());")
        self.open(self.draw(scene, output=place / "again.html"))
        for found in (again, self.script("return cornersOf(pictureNow());")):
            for one, wanted in zip(found, corners):
                self.assertAlmostEqual(one, wanted, delta=0.011)
        self.script("$('drop_picture').click(); return 0;")
        self.assertNotIn("observed", tomllib.loads(self.what_is_saved()["lis1-drawn.toml"]))
        self.script("$('undo').click(); $('save_as').value = 'Lütken 7.toml'; $('save_as').onchange(); return 0;")
        self.assertEqual(list(self.what_is_saved()), ["Lütken-7.toml"])
        shutil.copy(scene, place / "lis1.toml")
        said = listric("check", "lis1", cwd=place)
        self.assertEqual(said.returncode, 0)
        self.assertIn("lis1: is the shipped scene; the file lis1.toml in this folder is ./lis1.toml", said.stdout)
        self.assertNotIn("is the shipped", listric("check", "./lis1.toml", cwd=place).stdout)

    def test_10e_the_next_call_is_draft_where_standard_takes_long(self):
        self.open()
        self.script("change('', state => setAt(state, 'extension.speed_m_per_s', 0.001)); return 0;")
        self.what_is_saved()
        self.assertRegex(self.text("told"), r"run ./lis1-drawn.toml --accuracy draft \(about .*; draft traces few faults, standard takes about .* [hd]\)")
        self.script("change('', state => setAt(state, 'accuracy', 'fine')); return 0;")
        self.what_is_saved()
        self.assertRegex(self.text("told"), r"run ./lis1-drawn.toml$")

    def test_14_odd_files_are_told_of(self):
        self.open()
        before = self.scene()
        bad = self.folder / "bad.toml"
        for text, why in (("[hanging_wall]\nlength_m = 4\n[detachment]\nfrction = 1\nsegments = [{arc = 3}, 5]\n",
                           r"bad.toml:4: detachment.frction: unknown key, did you mean friction\?"),
                          ("[hanging_wall]\nx = ]\n", None), ("seed = 1.0\n[hanging_wall]\n[stretching]\n", "bad.toml:1: seed: wrong type"),
                          ("[hanging_wall]\nlength_m = 30000.0\n[detachment]\ncsv = 'fault.csv'\n[gravity]\n", "fault.csv: no such file")):
            bad.write_text(text)
            self.read_into_page(bad)
            if why:
                self.assertRegex(self.state(), why)
                self.assertIn("bad", self.script("return $('state').className;"))
            else:
                self.assertIn("bad.toml:2:", self.text("told"))
        self.assertIn("Drop it here", self.text("told"))
        points = self.folder / "fault.csv"          # as the program fits it
        arc = [(1e4 - 1e4 * math.cos(turn), 1e4 * math.sin(turn)) for turn in (math.radians(10 * k) for k in range(10))]
        points.write_text("x_m;depth_m\n" + "".join(f"{x};{z}\n" for x, z in [*arc, (15e3, 1e4), (2e4, 1e4)]) + "\n# end\n")
        self.read_into_page(points)
        self.assertIn("12 points, drawn as dots. The detachment is fitted to them", self.text("told"))
        self.assert_good()
        scene = self.folder / "fitted.toml"
        scene.write_text("[hanging_wall]\nlength_m = 30000.0\n[detachment]\ncsv = 'fault.csv'\n[gravity]\n")
        [arc, flat] = self.shape()["pieces"]
        self.open(self.draw(scene, output=self.folder / "fitted.html"))
        for found, wanted in zip(self.shape()["pieces"], (arc, flat), strict=True):   # sums of the fit are rounded otherwise
            self.assertEqual(found.pop("kind"), wanted.pop("kind"))
            for key in wanted:
                self.assertAlmostEqual(found[key], wanted[key], places=6)
        self.open()
        points.write_text("x_m;depth_m\n0;0\n100;1900\n\n# end\n")
        self.read_into_page(points)
        self.assertEqual(self.script("return page.state.faultPoints;"), {"x_m": [0, 100], "depth_m": [0, 1900]})
        points.write_text("x_m,depth_km\n0,0\n")
        self.read_into_page(points)
        self.assertRegex(self.text("told"), "fault.csv:1: .*depth_m")
        for _ in range(10):
            self.script("$('undo').click(); return 0;")
        self.assertEqual(self.scene(), before)
        self.assertIn("lis1.toml", self.text("subtitle"))

    def test_14c_a_small_model_is_drawn_as_a_large_one(self):
        box, page = self.folder / "box.toml", self.folder / "box.html"
        box.write_text(BOX)
        self.open(self.draw(box, output=page))
        self.assertAlmostEqual(self.slide(0.5), 0.02)
        self.assertEqual(self.text("extension_told"), "20.0 mm")
        self.assertIn("depth of 100.00 mm at x = 173.21 mm", self.text("told"))
        found = self.script("return page.kinematics;")
        # The whole model a hundred thousand times as large.
        large = self.script("const shape = shapeNow(); for (const piece of shape.pieces) for (const key of ['radius', 'length'])"
                            "if (key in piece) piece[key] *= 1e5; return model.ask('kinematics', {detachment: tableOf(shape), extension_m: 2000, angle_deg: 30,"
                            "right_m: 42000, reach_m: 66000, step_m: 25});")
        self.assertAlmostEqual(found["tilt"], large["tilt"], delta=0.2)
        self.assertAlmostEqual(found["deepest"]["depth"] * 1e5, large["deepest"]["depth"], delta=100)
        radius = self.shape()["pieces"][0]["radius"]
        self.drag("node 0", 40, 24)
        shape, depth = self.shape(), self.script("return depthOf(shapeNow());")
        self.assertTrue(0.2 < shape["pieces"][0]["radius"] < 0.4, shape)
        self.assertAlmostEqual(self.scene()["hanging_wall"]["thickness_m"], depth, delta=1e-6)
        self.assert_good()
        self.script("$('undo').click(); page.section.handles.find(h => h.dataset.key === 'node 0').focus(); return 0;")
        self.assertEqual(self.shape()["pieces"][0]["radius"], radius)
        self.assertIn("by 1 mm (Shift 10 mm, Alt 0.1 mm)", self.text("panel_fault"))
        ActionChains(self.driver).send_keys(Keys.ARROW_DOWN).perform()
        self.assertAlmostEqual(self.script("return depthOf(shapeNow());"), 0.1, delta=0.003)
        self.assertNotEqual(self.shape()["pieces"][0]["radius"], radius)
        self.script("$('add').click(); return 0;")
        self.assertEqual([p["kind"] for p in self.shape()["pieces"]], ["arc", "arc", "line"])
        self.script("setTool('picks'); $('new_horizon').click(); addPick({x: 0.1234, y: -0.0456}); return 0;")
        self.assertEqual(self.script("const {x_m, depth_m} = lineNow(); return [x_m, depth_m];"), [[0.1234], [0.0456]])
        self.open()     # what a basin had stays
        self.assertIn("by 100 m (Shift 1 km, Alt 10 m)", self.text("panel_fault"))
        self.assertEqual(self.script("return [decimalsOf(shapeNow()), leastLengthOf(shapeNow()), placeDecimals()];"),
                         [0, 10, 0])

    def test_14d_the_slider_reaches_the_greatest_extension_of_stages(self):
        scene = self.folder / "staged.toml"
        scene.write_text(STAGED)
        self.open()
        for path, greatest, travel in ((SOURCES / "apps/scenes/inversion-lis1.toml", 5000, 9000), (scene, 4000, 10260)):
            self.read_into_page(path)
            self.assert_good()
            self.assertEqual(self.slide(1.0), greatest)
            self.assertEqual(self.text("extension_told"), f"{greatest / 1000:.1f} km")
            self.assertEqual(self.script("return valueAt('extension.distance_m');"), travel)
            # The basin is that of the greatest extension without stages.
            area = self.script("return page.kinematics.area;")
            self.script("change('', state => { delete state.scene.stage; setAt(state, 'extension.distance_m', a[0]); }); return 0;", greatest)
            self.frame()
            self.assertEqual(self.script("return page.kinematics.area;"), area)
        self.read_into_page(scene)
        self.script("change('', state => setAt(state, 'extension.distance_m', 9000)); return 0;")
        self.assertRegex(self.state(), r"extension.distance_m: .*10260")

    def test_14e_toml_is_refused_as_everywhere(self):
        self.open()
        texts = [f'a = "x{sign}y"' for sign in map(chr, (*range(32), 127))] + [f"a = 1 # x{sign}y" for sign in map(chr, (*range(32), 127))]
        texts += ['a = "\\uD800"', 'a = "\\U00110000"', 'a = "\\U0010FFFF"', '[__proto__]\nx = 1', '__proto__ = {__proto__ = 2}', 'a.__proto__.b = 3',
                  '[[__proto__]]\n[[__proto__]]\nx = 1', '[constructor]\n[toString]\nvalueOf = 1']
        found = self.script("return a[0].map(text => { model.give('/s.toml', text); try { return model.ask('text', model.ask('document',"
                            "{scene: '/s.toml'})); } catch (error) { return null; } });", texts)
        for text, written in zip(texts, found):
            try:
                wanted = tomllib.loads(text)
            except tomllib.TOMLDecodeError:
                wanted = None
            self.assertEqual(written and tomllib.loads(written), wanted, repr(text))
        scene = (SOURCES / "apps/scenes/lis1.toml").read_text() + "\n[__proto__]\nx = 1\n"
        self.script("takeSceneFile(a[0], 'odd.toml'); return 0;", scene)
        self.assertIn("__proto__: unknown table", self.state())

    def test_14f_drawing_does_not_wait_for_the_model(self):
        self.open()
        before = self.script("return frameTimes.length;")
        self.drag("turn 0", 40, 0)
        self.assertGreater(self.script("return frameTimes.length;"), before)
        self.assertIsNone(self.script("return checker.verdict;"))       # asked for, elsewhere
        self.assert_good()


if __name__ == "__main__":
    unittest.main()
