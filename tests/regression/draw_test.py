"""The drawing page in a real browser: what it draws, predicts and writes is what the program has.

    LISTRIC_PROGRAM=../../build/native/listric LISTRIC_CHAINS=../../build/native/tests/predict_chains \\
        python3 -m unittest draw_test

Without LISTRIC_CHAINS the comparison of random chains is skipped. Frame times are printed with LISTRIC_SHOW=1.
"""

import json
import math
import os
import random
import re
import shutil
import subprocess
import time
import tomllib
import unittest

import jsonschema
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from browsed import Browsed
from program import NO_FIGURES, SOURCES, listric
from refused_scenes import refused_scenes
from run_folder_test import BOX

CHAINS = os.environ.get("LISTRIC_CHAINS", "")
SCENES = sorted((SOURCES / "apps/scenes").glob("*.toml"))
SCHEMA = json.loads((SOURCES / "apps/scene.schema.json").read_text())
MODULE = SOURCES / "apps/page/listric.wasm.gz"  # in base64, where .ci/run page has made it
MOST_BYTES = 400_000 + (1.4 * MODULE.stat().st_size if MODULE.exists() else 0)


def picture_file(path, width=400, height=150):
    from matplotlib import image
    image.imsave(path, [[(0.9, 0.8, x / width) for x in range(width)] for _ in range(height)])


def random_chain(chance):
    """A detachment that ends flat: one to four arcs between lines, some steepening, some with a kink."""
    dip, pieces = round(chance.uniform(35, 90), 2), []
    start, count = dip, chance.randint(1, 4)
    for k in range(count):
        if chance.random() < 0.4:
            pieces.append({"length": round(chance.uniform(200, 5000), 2)})
            if k and chance.random() < 0.3:
                dip = pieces[-1]["start_dip"] = round(chance.uniform(20, 80), 2)
        end = 0.0 if k == count - 1 else round(chance.uniform(1, 89), 2)
        if end == dip:
            continue
        pieces.append({"radius": round(10 ** chance.uniform(3, 4.5), 2), "end_dip": end})
        dip = end
    return {"start_dip": start, "pieces": pieces, "length": round(chance.uniform(30e3, 60e3)),
            "extension": round(chance.uniform(200, 9000)), "angle": round(chance.uniform(-20, 60))}


# What predict_chains answers, by the page's functions.
OF_PAGE = """
const shape = one => ({startDip: one.start_dip, pieces: one.pieces.map(p => ({kind: "radius" in p ? "arc" : "line",
  radius: p.radius, endDip: p.end_dip, length: p.length, ...("start_dip" in p ? {startDip: p.start_dip} : {})}))});
const every = list => list.filter((_, k) => k % 50 === 0).map(p => [p.x, p.y]);
return a[0].map(one => {
  const chain = chainOf(shape(one), 3 * one.length), end = lengthOf(chain), right = one.length + one.extension;
  const shear = inclinedShearTop(chain, one.extension, one.angle, right), normals = normalsTop(chain, one.extension, right);
  const at = s => { const p = pointAt(chain, s); return [p.x, p.y]; };
  return {depth: -chain.at(-1).end.y, points: Array.from({length: 21}, (_, k) => at(end * k / 20)),
    area: hangingWallArea(one.length, chain), tilt: normalsTilt(chain, one.extension),
    turns: headBlockTurns(chain, one.extension), cutoff: at(one.extension), shear: every(shear), shear_points: shear.length,
    normals: every(normals), normals_points: normals.length};
});"""


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


class Draw(Browsed):
    @classmethod
    def setUpClass(cls):
        cls.make_folders()
        ended = listric("draw", cwd=cls.folder)
        assert ended.returncode == 0 and ended.stdout == "lis1-drawing.html\n", ended.stdout
        cls.page = cls.folder / "lis1-drawing.html"
        cls.open_browser(1200, 1000)

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
        self.assertLessEqual(self.page.stat().st_size, MOST_BYTES)
        self.open()
        self.assertEqual(self.driver.get_log("browser"), [])
        asked = [message["params"]["request"]["url"] for entry in self.driver.get_log("performance")
                 if (message := json.loads(entry["message"])["message"])["method"] == "Network.requestWillBeSent"]
        self.assertEqual([url.split(":")[0] for url in asked if not url.startswith(("data:", "blob:"))], ["file"])
        self.assertIn("finds no fault", self.text("state"))
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
        joints = self.script("return page.chain.slice(1).map((s, k) => Math.hypot(s.startTangent.x - page.chain[k].endTangent.x,"
                             "s.startTangent.y - page.chain[k].endTangent.y));")
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
        self.assertIn("finds no fault", self.text("state"))
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
        self.assertIn("finds no fault", self.text("state"))
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
              let shape = shapeOf(readToml(begin).document.detachment);
              for (let step = 0; step < 60; ++step) {
                const k = Math.floor(chance() * shape.pieces.length), {end} = chainOf(shape)[k], far = chance() < 0.2 ? 40000 : 2000, kind = chance();
                const next = kind < 0.55 ? dragNode(shape, k, {x: end.x + (chance() - 0.5) * far, y: end.y + (chance() - 0.5) * far})
                  : kind < 0.7 ? addNode(shape, k, chance()) : kind < 0.85 ? removeNode(shape, k) : turnStart(shape, chance() * 120 - 15);
                if (!next) continue;
                ++count;
                const chain = chainOf(next), kink = Math.max(0, ...chain.map((s, n) => n && !("startDip" in next.pieces[n]) ?
                  Math.hypot(s.startTangent.x - chain[n - 1].endTangent.x, s.startTangent.y - chain[n - 1].endTangent.y) : 0));
                const why = objectionToShape(next) || faultsBySchema(schema.properties.detachment, tableOf(next))[0]?.message ||
                  (kink > 1e-9 ? "a kink" : depthOf(next) > 0 ? "" : "no depth");
                if (why) faults.push([why, JSON.stringify(shape), JSON.stringify(next)]);
                shape = next;
              }
            }
            return [faults.slice(0, 3), count];""", [path.read_text() for path in SCENES if path.stem in ("lis1", "lis2", "rfr")])
        self.assertEqual(faults, [])
        self.assertGreater(count, 2500)

    def test_04_a_picture_lies_under_it(self):
        picture, over = self.folder / "section.png", self.folder / "over.html"
        picture_file(picture)
        ended = listric("draw", "lis1", "--over", picture, "--corners", "0,-1000,40000,14000", "-o", over, "--threads", "1")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.open(over)
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
        self.assertEqual(listric("draw", "--over", broken, "-o", page, "--threads", "1").returncode, 0)
        self.open(page)
        self.assertIn("broken.jpg: is damaged", self.text("told"))
        for words, why in ((("--over", self.folder / "none.png"), "no such file"), (("--over", __file__), "PNG"),
                           (("--corners", "0,0,1,1"), "is of --over")):
            ended = listric("draw", *words, "-o", self.folder / "no.html", cwd=self.folder)
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(why, ended.stdout)

    def test_05_forms_refuse_and_say_why(self):
        self.open()
        for path, typed, why in (("detachment.friction", "11", "at least 0, at most 10"), ("hanging_wall.porosity", "0,2", "decimal point"),
                                 ("materials.basement", "mat18-c", "did you mean mat18-b?"), ("seed", "1.5", "integer"),
                                 ("output.figures_at_m", "5000, x", "x is no value|list of numbers")):
            field = self.driver.find_element("id", f"at_{path}")
            self.script("for (let e = document.getElementById(a[0]); e; e = e.parentElement) if (e.tagName === 'DETAILS') e.open = true;"
                        "return 0;", f"at_{path}")
            field.clear()
            field.send_keys(typed, Keys.TAB)
            self.assertRegex(self.driver.find_element("id", f"at_{path}_fault").text, why)
            self.assertIn(path, self.text("state"))
            for old in self.downloads.glob("*"):
                old.unlink()
            self.script("$('save').click(); return 0;")
            self.assertIn("Not saved", self.text("told"))
            self.assertEqual(list(self.downloads.glob("*")), [])
            field.clear()
            field.send_keys(Keys.TAB)
        self.assertIn("finds no fault", self.text("state"))
        find = self.driver.find_element("id", "find")
        for typed, why in (("extension.rate = 0.02", "did you mean extension.rate_m_per_a?"), ("porosty", "did you mean porosity?"),
                           ("detachment.friction = -1", "at least 0")):
            find.clear()
            find.send_keys(typed)
            self.assertIn(why, self.text("found"))
        find.clear()
        find.send_keys("extension.rate_m_per_a = 0.02\n")
        self.assertEqual(self.scene()["extension"]["rate_m_per_a"], 0.02)

    def test_06_shipped_scenes_come_back_equal(self):
        self.open()
        for path in SCENES:
            text = path.read_text()
            written = self.script("return writeToml(readToml(a[0]).document, schema);", text)
            self.assertEqual(tomllib.loads(written), tomllib.loads(text), path.name)
        for name in ("rfr.toml", "pure-shear.toml", "lis1-mud.toml"):     # by the page's own way in and out
            self.read_into_page(SOURCES / "apps/scenes" / name)
            self.assertIn("finds no fault", self.text("state"), name)
            [file] = self.saved()
            self.assertEqual(file.name, name.replace(".toml", "-drawn.toml"))
            self.assertEqual(tomllib.loads(file.read_text()), tomllib.loads((SOURCES / "apps/scenes" / name).read_text()))
        odd = 'a."b c" = 1\nd = """x\\\n  y"""\ne = \'\'\'z\'\'\'\nf = [1, 2.5, # comment\n 0x1F, 9223372036854775807]\n' \
              'g = {h = true, i.j = "\\u00e9\\n"}\n[[k]]\nl = -1e-3\n[[k]]\n'
        found = self.script("return tomlValue(readToml(a[0]).document);", odd)
        self.assertEqual(tomllib.loads(f"all = {found}")["all"], tomllib.loads(odd))
        for broken, line in (("a = 1\na = 2", 2), ("a = ", 1), ("[t]\nx = abc", 2), ("a = [1, 2", 1), ("a = 1 b = 2", 1)):
            self.assertEqual(self.script("try { readToml(a[0]); return 0; } catch (error) { return error.line; }", broken), line, broken)

    def test_07_what_the_schema_refuses_is_refused(self):
        """Scenes that are spoiled at random: the page and a validator of JSON schemas judge alike."""
        self.open()
        chance, documents = random.Random(7), []
        scenes = [tomllib.loads(path.read_text()) for path in SCENES]
        numbers = [(table, key) for table, of in SCHEMA["properties"].items() for key, own in of.get("properties", {}).items()
                   if own.get("type") in ("number", "integer")]
        values = [-1, 0, 0.5, 1e9, -1e30, True, "text", [], {}, 3, 90, 1e-9]
        for _ in range(250):
            document = json.loads(json.dumps(chance.choice(scenes)))
            table, key = chance.choice(numbers)
            kind = chance.randrange(5)
            if kind <= 2:
                document.setdefault(table, {})[key] = chance.choice(values)
            elif kind == 3:
                document[chance.choice([table, table + "x"])] = {key + chance.choice(["", "x"]): chance.choice(values)}
            else:
                document.pop(chance.choice(list(document)))
            documents.append(document)
        judge = jsonschema.Draft4Validator(SCHEMA)
        found = self.script("return a[0].map(one => faultsBySchema(schema, one).map(fault => `${fault.path}: ${fault.message}`));", documents)
        refused = 0
        for document, faults in zip(documents, found):
            good = judge.is_valid(document)
            refused += not good
            self.assertEqual(good, not faults, f"{faults}\n{document}")
        self.assertGreater(refused, 100)
        self.assertLess(refused, 240)

    @unittest.skipUnless(CHAINS, "no LISTRIC_CHAINS")
    def test_08_geometry_and_kinematics_are_the_programs(self):
        chance = random.Random(43)
        chains = [random_chain(chance) for _ in range(200)]
        ended = subprocess.run([CHAINS], input=json.dumps(chains), stdout=subprocess.PIPE, text=True, check=True)
        self.open()
        worst = {"m": 0.0, "degrees": 0.0}
        for chain, ours, of_page in zip(chains, json.loads(ended.stdout), self.script(OF_PAGE, chains)):
            self.assertEqual(ours["turns"], of_page["turns"], chain)
            for name in ("shear_points", "normals_points"):
                self.assertEqual(ours[name], of_page[name], chain)
            for name in ("points", "shear", "normals"):
                for a, b in zip(ours[name], of_page[name]):
                    worst["m"] = max(worst["m"], math.dist(a, b))
            worst["m"] = max(worst["m"], abs(ours["depth"] - of_page["depth"]), math.dist(ours["cutoff"], of_page["cutoff"]))
            worst["degrees"] = max(worst["degrees"], abs(ours["tilt"] - of_page["tilt"]))
            self.assertAlmostEqual(ours["area"] / of_page["area"], 1.0, delta=1e-9)
        self.assertLess(worst["m"], 1.0)
        self.assertLess(worst["degrees"], 0.1)
        if os.environ.get("LISTRIC_SHOW"):
            print("page against program, 200 chains:", worst)

    def test_09_discs_and_time_are_the_programs(self):
        self.open()
        other = self.folder / "other.toml"
        other.write_text("[hanging_wall]\nlength_m = 30000.0\nthickness_m = 9000.0\nradius_ratio = 1.5\n[detachment]\nstart_dip_deg = 70.0\n"
                         f"segments = [{{arc = {{radius_m = {9000 / (1 - math.cos(math.radians(70)))}}}}}]\n[extension]\ndistance_m = 6000.0\n"
                         "rate_m_per_a = 0.003\nspeed_m_per_s = 2.0\n[cycle]\ninertial_mass_floor = 0.0\nsoftness = 4.0\n[output]\ninterval_m = 250.0\n"
                         "figures_at_m = [1000.0, 3000.0, 6000.0]\n[gravity]\n[bonds]\n[fault_weakening]\ninterval_a = 2500.0\n"
                         "update_interval_a = 900.0\n[bond_healing]\n[pore_fluid]\nhydrostatic = true\n[sedimentation]\ninterval_a = 12000.0\nnormal_stiffness_pa = 9e11\n[compaction]\n")
        staged = self.folder / "staged.toml"
        staged.write_text(STAGED)
        for path in [*(SOURCES / "apps/scenes" / name for name in ("rfr-elastic.toml", "inversion-lis1.toml")), other, staged]:
            page = self.folder / "program.html"
            ended = listric("draw", path, "-o", page, "--threads", "1")
            self.assertEqual(ended.returncode, 0, ended.stdout)
            wanted = json.loads(re.search(r'"predicted":(\{[^}]*\})', page.read_text())[1])
            found = self.script("return predictCost(facts, schema, readToml(a[0]).document);", path.read_text())
            for of_page, ours in (("discs", "discs_at_start"), ("discsAtEnd", "discs_at_end")):
                self.assertAlmostEqual(found[of_page], wanted[ours], delta=1)    # rounded down
            for name in ("cycles", "work"):
                self.assertAlmostEqual(found[name] / wanted[name], 1.0, delta=1e-6)
        self.assertGreater(self.script("return page.cost.seconds;"), 1.0)
        self.assertIn("about", self.text("state"))

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
        again = self.folder / "again.html"
        self.assertEqual(listric("draw", scene, "-o", again, "--threads", "1").returncode, 0)
        self.open(again)
        self.assertEqual(self.script("return page.state.picks;"), picks)
        self.open()
        self.read_into_page(scene, *sorted(place.glob("*.csv")))
        self.assertEqual(self.script("return page.state.picks;"), picks)
        self.assertNotIn("Drop", self.text("told"))
        ended = listric("run", scene, "--accuracy", "draft", "--until", "1km", "--output", place / "run", "--no-report", "--quiet",
                        env=os.environ | NO_FIGURES)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertTrue(json.loads((place / "run/summary.json").read_text())["finished"])

    def what_is_saved(self):
        """Texts that the page would save, by their files' names."""
        return self.script("const files = {}; download = (name, text) => { files[name] = text; }; save(); return files;")

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
        ended = listric("draw", scene, "-o", self.folder / "shifted.html", "--threads", "1")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.open(self.folder / "shifted.html")
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
        self.assertEqual(listric("draw", scene, "-o", place / "again.html", "--threads", "1").returncode, 0)
        self.open(place / "again.html")
        for found in (again, self.script("return cornersOf(pictureNow());")):
            for one, wanted in zip(found, corners):
                self.assertAlmostEqual(one, wanted, delta=0.011)
        self.script("$('drop_picture').click(); return 0;")
        self.assertNotIn("observed", tomllib.loads(self.what_is_saved()["lis1-drawn.toml"]))
        self.script("$('undo').click(); $('save_as').value = 'Lütken 7.toml'; $('save_as').onchange(); return 0;")
        self.assertEqual(list(self.what_is_saved()), ["Lütken-7.toml"])
        self.assertIn("listric check ./Lütken-7.toml decides", self.text("state"))
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
        ended = listric("draw", scene, "-o", self.folder / "hostile.html", "--threads", "1")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.open(self.folder / "hostile.html")
        self.assertEqual(self.text("title"), hostile)
        self.assertEqual(self.driver.find_elements("tag name", "img"), [])

    def test_14_odd_files_are_told_of(self):
        self.open()
        before = self.scene()
        bad = self.folder / "bad.toml"
        for text, why in (("[hanging_wall]\nlength_m = 4\n[detachment]\nsegments = [{arc = 3}, 5]\nfrction = 1\n", r"line 5: detachment.frction: unknown key, did you mean friction\?"),
                          ("[hanging_wall]\nx = ]\n", None), ("[hanging_wall]\n[detachment]\ncsv = 'fault.csv'\n[gravity]\n", "finds no fault"),
                          ("seed = 1.0\n[hanging_wall]\n[stretching]\n", "seed: wrong type")):
            bad.write_text(text)
            self.read_into_page(bad)
            if why:
                self.assertRegex(self.text("state"), why)
            else:
                self.assertIn("bad.toml:2: ", self.text("told"))
        self.script("document.getElementById('at_seed').value = '2'; page.forms.take('seed'); return 0;")
        self.assertIn("finds no fault", self.text("state"))
        points = self.folder / "fault.csv"
        points.write_text("x_m;depth_m\n0;0\n100;1900\n\n# end\n")
        self.read_into_page(points)
        self.assertEqual(self.script("return page.state.faultPoints;"), {"x_m": [0, 100], "depth_m": [0, 1900]})
        points.write_text("x_m,depth_km\n0,0\n")
        self.read_into_page(points)
        self.assertIn("did you mean depth_km?", self.text("told"))
        for _ in range(10):
            self.script("$('undo').click(); return 0;")
        self.assertEqual(self.scene(), before)
        self.assertIn("lis1.toml", self.text("subtitle"))

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

    def test_14c_a_small_model_is_drawn_as_a_large_one(self):
        box, page = self.folder / "box.toml", self.folder / "box.html"
        box.write_text(BOX)
        self.assertEqual(listric("draw", box, "-o", page, "--threads", "1").returncode, 0)
        self.open(page)
        self.assertAlmostEqual(self.slide(0.5), 0.02)
        self.assertEqual(self.text("extension_told"), "20.0 mm")
        self.assertIn("depth of 100.00 mm at x = 173.21 mm", self.text("told"))
        found = self.script("return page.kinematics;")
        # The whole model a hundred thousand times as large.
        large = self.script("const shape = shapeNow(); for (const piece of shape.pieces) for (const key of ['radius', 'length'])"
                            "if (key in piece) piece[key] *= 1e5; return predictKinematics(chainOf(shape, 66000), 2000, 30, 42000);")
        self.assertAlmostEqual(found["tilt"], large["tilt"], delta=0.2)
        self.assertAlmostEqual(found["deepest"]["depth"] * 1e5, large["deepest"]["depth"], delta=100)
        radius = self.shape()["pieces"][0]["radius"]
        self.drag("node 0", 40, 24)
        shape, depth = self.shape(), self.script("return depthOf(shapeNow());")
        self.assertTrue(0.2 < shape["pieces"][0]["radius"] < 0.4, shape)
        self.assertAlmostEqual(self.scene()["hanging_wall"]["thickness_m"], depth, delta=1e-6)
        self.assertIn("finds no fault", self.text("state"))
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
        self.assertEqual(self.script("return [decimalsOf(shapeNow()), leastLengthOf(shapeNow()), spacingOf(page.chain), placeDecimals()];"),
                         [0, 10, 25, 0])

    def test_14d_the_slider_reaches_the_greatest_extension_of_stages(self):
        scene = self.folder / "staged.toml"
        scene.write_text(STAGED)
        self.open()
        for path, greatest, travel in ((SOURCES / "apps/scenes/inversion-lis1.toml", 5000, 9000), (scene, 4000, 10260)):
            self.read_into_page(path)
            self.assertIn("finds no fault", self.text("state"))
            self.assertEqual(self.slide(1.0), greatest)
            self.assertEqual(self.text("extension_told"), f"{greatest / 1000:.1f} km")
            self.assertEqual(self.script("return valueAt(facts, schema, page.state.scene, 'extension.distance_m');"), travel)
            # The basin is that of the greatest extension without stages.
            area = self.script("return page.kinematics.area;")
            self.script("change('', state => { delete state.scene.stage; setAt(state, 'extension.distance_m', a[0]); }); return 0;", greatest)
            self.frame()
            self.assertEqual(self.script("return page.kinematics.area;"), area)
        self.read_into_page(scene)
        self.script("change('', state => setAt(state, 'extension.distance_m', 9000)); return 0;")
        self.assertIn("extension.distance_m: is 9000 beside [[stage]], whose ways it follows from (10260); leave it out", self.text("state"))

    def test_14e_toml_is_refused_as_everywhere(self):
        self.open()
        texts = [f'a = "x{sign}y"' for sign in map(chr, (*range(32), 127))] + [f"a = 1 # x{sign}y" for sign in map(chr, (*range(32), 127))]
        texts += ['a = "\\uD800"', 'a = "\\U00110000"', 'a = "\\U0010FFFF"', '[__proto__]\nx = 1', '__proto__ = {__proto__ = 2}', 'a.__proto__.b = 3',
                  '[[__proto__]]\n[[__proto__]]\nx = 1', '[constructor]\n[toString]\nvalueOf = 1']
        found = self.script("return a[0].map(text => { try { return writeToml(readToml(text).document, schema); } catch (error) {"
                            "if (!(error instanceof TomlError)) throw error; return null; } });", texts)
        for text, written in zip(texts, found):
            try:
                wanted = tomllib.loads(text)
            except tomllib.TOMLDecodeError:
                wanted = None
            self.assertEqual(written and tomllib.loads(written), wanted, repr(text))
        scene = (SOURCES / "apps/scenes/lis1.toml").read_text() + "\n[__proto__]\nx = 1\n"
        state = self.script("takeSceneFile(a[0], 'odd.toml'); return $('state').textContent;", scene)
        self.assertIn("__proto__: unknown table", state)

    def test_14f_what_check_refuses_is_not_called_correct(self):
        self.open()
        scenes, scene = refused_scenes(), self.folder / "refused.toml"
        self.assertGreaterEqual(len(scenes), 60)
        for what, text in scenes.items():
            with self.subTest(what):
                scene.write_text(text)
                self.assertEqual(listric("check", scene, cwd=self.folder).returncode, 2)
                said, is_bad, told = self.script("$('told').textContent = ''; takeSceneFile(a[0], 'refused.toml'); return [$('state').textContent,"
                                                 "$('state').classList.contains('bad'), $('told').textContent];", text)
                self.assertNotRegex(said, "(?i)correct|accept")
                self.assertTrue(is_bad or told.startswith("refused.toml:") or "listric check ./refused.toml decides" in said, said)

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
