"""A page of the program's in a real browser."""

import tempfile
import time
import unittest
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service


def browser(downloads, width=1600, height=1400):
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 f"--window-size={width},{height}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    driver.execute_cdp_cmd("Page.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(downloads)})
    driver.set_script_timeout(60)
    return driver


class Browsed(unittest.TestCase):
    """Tests of pages in `driver`, the class's own, with `folder` and, for what is saved, `downloads`."""

    @classmethod
    def make_folders(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.downloads = cls.folder / "downloads"
        cls.downloads.mkdir()

    @classmethod
    def open_browser(cls, *size):
        cls.driver = browser(cls.downloads, *size)
        cls.addClassCleanup(cls.driver.quit)

    def visit(self, address):
        """Opens a page and returns what it says of itself when it is done: "true" or "false"."""
        self.driver.get("about:blank")
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get(address)
        for _ in range(600):
            if ready := self.driver.execute_script("return document.documentElement.dataset.ready"):
                return ready
            time.sleep(0.05)
        self.fail("the page did not become ready")

    def script(self, text, *arguments):
        """What an asynchronous function with this body returns."""
        ended = self.driver.execute_async_script(
            "const done = arguments[arguments.length - 1]; (async (...a) => {" + text +
            "})(...arguments).then(value => done([value]), error => done(String(error.stack || error)));", *arguments)
        self.assertIsInstance(ended, list, ended)
        return ended[0]
