"""The drawing page in Firefox, where that is installed (Debian: firefox-esr). `.ci/run page` calls it.

    LISTRIC_PROGRAM=../../build/ci/listric python3 -m unittest page_firefox
"""

import json
import re
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
import zipfile
from pathlib import Path

from program import SOURCES, listric

FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Firefox:
    """A headless Firefox by its own protocol, Marionette: messages of a length, a colon and JSON."""

    def __init__(self, folder, downloads):
        port = free_port()
        prefs = {"marionette.port": port, "browser.download.folderList": 2, "browser.download.dir": str(downloads)}
        (folder / "user.js").write_text("".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n"
                                                for name, value in prefs.items()))
        self.process = subprocess.Popen([FIREFOX, "--headless", "--marionette", "--no-remote", "--profile", str(folder)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(1200):
            try:
                self.socket = socket.create_connection(("127.0.0.1", port))
                break
            except ConnectionRefusedError:
                time.sleep(0.1)
        self.stream, self.count = self.socket.makefile("rwb"), 0
        self.read()
        self.call("WebDriver:NewSession", capabilities={})

    def read(self):
        size = b""
        while (letter := self.stream.read(1)) != b":":
            size += letter
        return json.loads(self.stream.read(int(size)))

    def call(self, name, **words):
        self.count += 1
        text = json.dumps([0, self.count, name, words]).encode()
        self.stream.write(str(len(text)).encode() + b":" + text)
        self.stream.flush()
        _, _, error, result = self.read()
        if error:
            raise RuntimeError(f"{name}: {error['message']}")
        return result

    def script(self, text):
        return self.call("WebDriver:ExecuteScript", script=text, args=[])["value"]

    def close(self):
        self.stream.close()
        self.socket.close()
        self.process.terminate()
        self.process.wait()


@unittest.skipUnless(FIREFOX, "Firefox is not installed")
class PageFirefox(unittest.TestCase):
    def wait_for(self, what):
        end = time.monotonic() + 600
        while not (found := self.firefox.script(f"return {what}")):
            self.assertLess(time.monotonic(), end, f"{what}: {self.firefox.script('return document.body.innerText')}")
            time.sleep(0.2)
        return found

    def test_runs_to_the_hash_of_the_program_and_saves(self):
        with tempfile.TemporaryDirectory() as name:
            folder, downloads = Path(name), Path(name, "downloads")
            downloads.mkdir()
            scene = (SOURCES / "apps/scenes/lis1.toml").read_text().replace("distance_m = 10000.0", "distance_m = 300.0")
            (folder / "short.toml").write_text(scene)
            self.assertEqual(listric("draw", "short.toml", cwd=folder).returncode, 0)
            ended = listric("run", "short.toml", "--accuracy", "draft", "--no-figures", "--no-report", cwd=folder)
            self.assertEqual(ended.returncode, 0, ended.stdout)
            (folder / "profile").mkdir()
            self.firefox = Firefox(folder / "profile", downloads)
            self.addCleanup(self.firefox.close)
            self.firefox.call("WebDriver:Navigate", url=(folder / "short-drawing.html").as_uri())
            self.wait_for("document.documentElement.dataset.ready === 'true'")
            self.firefox.script("document.getElementById('run').click();")
            self.wait_for("document.getElementById('run_state').textContent.includes('The same run by the program')")
            told = self.firefox.script("return document.getElementById('runs').innerText")
            summary = json.loads((folder / "out/short/summary.json").read_text())
            self.assertEqual(re.search(r"state_hash (\w+)", told)[1], summary["state_hash"])
            self.firefox.script("document.getElementById('save_run').click();")
            self.wait_for("document.getElementById('run_state').textContent.includes('Saved')")
            saved = downloads / "short-seed-1.zip"
            for _ in range(600):
                if saved.exists() and zipfile.is_zipfile(saved):
                    break
                time.sleep(0.1)
            with zipfile.ZipFile(saved) as packed:
                self.assertIsNone(packed.testzip())
                self.assertEqual(json.loads(packed.read("short-seed-1/summary.json"))["faults"], summary["faults"])


if __name__ == "__main__":
    unittest.main()
