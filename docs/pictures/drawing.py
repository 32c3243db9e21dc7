#!/usr/bin/python3
"""Draws drawing.webp, the page of `listric draw` over the imaginary section of the tutorial, with headless Chromium.

Usage: docs/pictures/drawing.py, from the root of the sources; LISTRIC names another program than ./listric

Needs python3-selenium, python3-pil, chromium and chromium-driver.
"""
import io
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

HERE = Path(__file__).resolve().parent
WIDTH, HEIGHT = 1300, 1010
MOST_BYTES = 150_000  # tests/checks/front_door.py


def browser():
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                 f"--window-size={WIDTH},{HEIGHT + 200}"):
        options.add_argument(word)
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def page_in(folder):
    """The tutorial's fault over its section."""
    subprocess.run([sys.executable, HERE.parent / "start/your-own-section/draw.py", folder], check=True)
    page = Path(folder, "page.html")
    subprocess.run([os.environ.get("LISTRIC", "./listric"), "draw", Path(folder, "scene.toml"), "--over",
                    Path(folder, "section.png"), "--corners", "0,0,46000,12000", "--output", page], check=True)
    return page


def main():
    with tempfile.TemporaryDirectory() as folder:
        driver = browser()
        try:
            driver.get(f"file://{page_in(folder)}")
            while not driver.execute_script("return document.documentElement.dataset.ready"):
                time.sleep(0.05)
            driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                "width": WIDTH, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": False})
            time.sleep(0.5)
            driver.execute_script("$('angle').value = 0; chooseHandle('node 1');")  # as the section was made
            time.sleep(0.5)
            picture = Image.open(io.BytesIO(driver.get_screenshot_as_png())).convert("RGB")
        finally:
            driver.quit()
    path = HERE / "tools/drawing.webp"
    for quality in range(90, 40, -5):
        picture.save(path, quality=quality, method=6)
        if path.stat().st_size <= MOST_BYTES:
            break
    print(f"{path.name}: {path.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
