"""The drawing page where memory, a worker or a hand fails, and on a telephone. `.ci/run page` calls it.

    LISTRIC_PROGRAM=../../build/ci/listric python3 -m unittest page.page_limits
"""

import unittest

from page.page_run import RunningPage

# The module whose memory may have no more than so many pages of 64 kB: that section's limits become two.
LIMITED = """
const number = value => value > 127 ? [value & 127 | 128, ...number(value >>> 7)] : [value];
const limited = (whole, most) => {
  const bytes = new Uint8Array(whole), read = (at, shift = 0, value = 0) => bytes[at] & 128
    ? read(at + 1, shift + 7, value | (bytes[at] & 127) << shift) : [value | bytes[at] << shift, at + 1];
  for (let at = 8; at < bytes.length;) {
    const [size, begin] = read(at + 1);
    if (bytes[at] === 5) {
      const [least] = read(begin + 2), limits = [1, 1, ...number(least), ...number(least + most)];
      return new Uint8Array([...bytes.slice(0, at), 5, limits.length, ...limits, ...bytes.slice(begin + size)]).buffer;
    }
    at = begin + size;
  }
};
const whole = moduleBytes;
moduleBytes = async () => limited(await whole(), a[0]);
"""
NAME = '<img src=x onerror="window.hurt = 1">", evil = "1'


class PageLimits(RunningPage):
    def asks_before_it_closes(self):
        return self.script("""
            const event = new Event("beforeunload", {cancelable: true});
            window.dispatchEvent(event);
            return event.defaultPrevented;""")

    def toml(self):
        return self.script("return sceneText()")

    def test_memory_that_ends_leaves_scene_and_files(self):
        before = self.toml()
        self.script(LIMITED + "$('run').click();", 8)
        failure = self.wait_for("runs[0]?.failure")
        self.assertRegex(failure, "memory")
        self.assertRegex(failure, "run it with the program")
        self.assertEqual(self.toml(), before)
        self.assertFalse(self.script("return $('run').disabled"))
        self.assertTrue(self.script("return $('run_stop').disabled"))

    def test_a_module_that_no_memory_is_given_for(self):
        self.script("moduleBytes = async () => { throw new RangeError('Out of memory'); }; $('run').click();")
        self.wait_for("$('run_state').textContent.includes('Out of memory')")

    def test_asks_before_a_run_is_lost(self):
        self.assertFalse(self.asks_before_it_closes())
        self.script("$('run').click();")
        self.wait_for("runs[0]?.discs")
        self.assertTrue(self.asks_before_it_closes())
        self.script("$('run_stop').click();")
        self.wait_for("runs[0].isStopped")
        self.assertTrue(self.asks_before_it_closes())
        asked = self.script("""
            const asked = [];
            window.former = runs[0];
            window.confirm = text => { asked.push(text); return false; };
            $("run").click();
            return [asked.length, runs[0] === former, Boolean(former.worker)];""")
        self.assertEqual(asked, [1, True, True])
        self.script("window.confirm = () => true; $('run').click();")
        self.wait_for("runs[0] && runs[0] !== former")
        self.assertIsNone(self.script("return former.worker"))

    def test_a_worker_that_is_gone_is_told(self):
        self.script("$('run').click();")
        self.wait_for("runs[0]?.discs")
        self.script("runs[0].worker.terminate(); runs[0].heard -= 1e3 * longestSilence + 1e3; showRuns();")
        self.assertIn("no word for", self.script("return runs[0].words.textContent"))
        self.script("runs[0].worker.onerror(new ErrorEvent('error', {message: 'gone'}));")
        self.assertIn("the run has failed: gone", self.script("return runs[0].words.textContent"))

    def test_twenty_thousand_picked_points(self):
        rows = "\n".join(f"top,{1000 + k},{500 + k % 100}" for k in range(20_000))
        self.script("takePicks(a[0], 'horizons.csv');", "name,x_m,depth_m\n" + rows)
        self.assertEqual(self.script("return page.state.picks.horizons[0].x_m.length"), 20_000)
        self.assertEqual(self.script("return picksText('horizons').split('\\n').length"), 20_002)
        self.assertLess(self.script("return page.section.handles.length"), 1000)  # more would take a browser minutes
        self.script("change('', state => { state.scene.extension.distance_m = 5; }); $('run').click();")
        self.wait_for("runs[0]?.summary || runs[0]?.failure")
        self.assertEqual(self.script("return runs[0].failure"), "")
        self.assertEqual(self.script("return runs[0].summary.observed[0].points"), 20_000)

    def test_names_of_all_kinds_harm_nothing(self):
        self.script("""
            change('', state => {
              state.scene.description = a[0];
              state.scene.extension.distance_m = 5;
              state.saveAs = a[0];
              state.picks.horizons = [{name: a[0], x_m: [1000, 2000], depth_m: [100, 200], age_a: 0}];
            });
            $('run').click();""", NAME)
        self.wait_for("runs[0]?.summary || runs[0]?.failure")
        self.assertEqual(self.script("return runs[0].failure"), "")
        self.assertIsNone(self.script("return window.hurt ?? null"))
        self.assertEqual(self.script("return page.state.scene.description"), NAME)
        self.assertEqual(self.script("return runs[0].summary.observed[0].name"), NAME)
        folder = self.unpacked(self.script("return runs[0].name"))
        self.assertTrue((folder / "summary.json").exists())
        self.assertEqual(folder.parent, self.folder)

    def test_a_scene_of_another_version_is_told_and_stays(self):
        self.script("takeSceneFile(a[0], 'later.toml');", self.toml() + "\n[glaciers]\nheight_m = 100.0\n")
        self.wait_for("$('state').classList.contains('bad')")
        self.assertIn("glaciers", self.script("return $('state').textContent"))
        self.assertIn("glaciers", self.toml())
        self.script("$('run').click();")
        self.assertIn("glaciers", self.wait_for("$('run_state').textContent"))

    def test_the_section_stays_under_the_hand_as_a_verdict_comes(self):
        self.wait_for("checker.verdict")
        top = self.script("""
            change("", state => { state.scene.extension.distance_m = 520; });
            return page.section.svg.getBoundingClientRect().top;""")
        self.wait_for("checker.verdict")
        self.assertAlmostEqual(self.script("return page.section.svg.getBoundingClientRect().top"), top, delta=1)

    def test_examples_are_taken_by_name_and_address(self):
        self.script("location.hash = 'rfr';")
        self.wait_for("page.state.file === 'rfr.toml'")
        self.assertEqual(self.script("return requestNow(1).request"), {"scene": "rfr", "accuracy": "draft", "seed": 1})
        self.script("$('example').value = 'lis2'; $('example').onchange();")
        self.assertEqual(self.script("return [shippedNow(), page.state.file]"), ["lis2", "lis2.toml"])
        self.script("change('', state => { state.scene.extension.distance_m = 5; });")
        self.assertEqual(self.script("return requestNow(1).request.scene"), "/lis2-drawn.toml")
        self.script("location.hash = 'none';")
        self.assertEqual(self.script("return page.state.file"), "lis2.toml")

    def touch(self, element, *ways):
        """A finger on an element, and where it goes from there, pixels."""
        self.script("document.querySelector(a[0]).scrollIntoView({block: 'center'});", element)
        x, y = self.script("""
            const {x, y, width, height} = document.querySelector(a[0]).getBoundingClientRect();
            return [x + width / 2, y + height / 2];""", element)

        def send(kind, *points):
            self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        send("touchStart", {"x": x, "y": y})
        for right, down in ways:
            send("touchMove", {"x": x + right, "y": y + down})
        send("touchEnd")

    def test_a_telephone_draws_runs_and_saves(self):
        emulate = self.driver.execute_cdp_cmd
        telephone = {"width": 390, "height": 844, "deviceScaleFactor": 3, "mobile": True}
        emulate("Emulation.setDeviceMetricsOverride", telephone)
        emulate("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
        self.addCleanup(emulate, "Emulation.clearDeviceMetricsOverride", {})
        self.addCleanup(emulate, "Emulation.setTouchEmulationEnabled", {"enabled": False})
        self.assertEqual(self.visit((self.folder / "short-drawing.html").as_uri()), "true")
        before = self.toml()
        self.touch("#section g.handle", (4, 4), (12, 6))
        self.assertNotEqual(self.toml(), before)
        self.assertFalse(self.script("return showState().length"))
        self.script("change('', state => { state.scene.extension.distance_m = 20; });")
        self.touch("#run")
        self.wait_for("runs[0]?.summary || runs[0]?.failure")
        self.assertEqual(self.script("return runs[0].failure"), "")
        self.assertGreater(self.script("return runs[0].table.rows.length"), 4)
        self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 390)
        name = self.script("return runs[0].name")
        self.touch("#save_run")
        self.assertTrue(self.saved(f"{name}.zip").stat().st_size > 100_000)


if __name__ == "__main__":
    unittest.main()
