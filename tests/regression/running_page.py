"""The drawing page with a short scene, in a browser, to run it there."""

import time
import zipfile

from browsed import Browsed
from program import SOURCES, listric


class RunningPage(Browsed):
    METRES = 500

    @classmethod
    def setUpClass(cls):
        cls.make_folders()
        scene = (SOURCES / "apps/scenes/lis1.toml").read_text()
        assert "distance_m = 10000.0" in scene
        (cls.folder / "short.toml").write_text(scene.replace("distance_m = 10000.0", f"distance_m = {cls.METRES}.0"))
        assert listric("draw", "short.toml", cwd=cls.folder).returncode == 0
        cls.open_browser(1200, 1400)

    def setUp(self):
        self.assertEqual(self.visit((self.folder / "short-drawing.html").as_uri()), "true")

    def wait_for(self, what, seconds=600):
        end = time.monotonic() + seconds
        while not (found := self.script(f"return {what}")):
            self.assertLess(time.monotonic(), end, f"{what}: {self.script('return document.body.innerText')}")
            time.sleep(0.1)
        return found

    def saved(self, name):
        """A file that the page has saved, once it is whole."""
        path = self.downloads / name
        for _ in range(600):
            if path.exists():
                return path
            time.sleep(0.05)
        self.fail(f"{name} is not saved; there are {sorted(path.name for path in self.downloads.iterdir())}")

    def unpacked(self, name):
        """The folder in a zip that the page saves."""
        self.script("$('save_run').click();")
        with zipfile.ZipFile(self.saved(f"{name}.zip")) as packed:
            self.assertIsNone(packed.testzip())
            packed.extractall(self.folder)
        return self.folder / name
