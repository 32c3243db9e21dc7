#!/usr/bin/python3
"""Draws the pictures of docs/guides/report.md with headless Chromium.

Usage: pictures.py RUNS, from the root of the sources

RUNS has folders of finished runs: lis1, lis2, rfr, lis1-elastic, and lis1-seed2 (lis1 with --seed 2).
Needs python3-selenium, python3-pil, chromium and chromium-driver.
"""
import io
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from urllib.parse import urlencode

from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

HERE = Path(__file__).resolve().parent
WIDE, PAIR, NARROW = (1400, 760), (1400, 1157), (500, 757)
MOST_BYTES = 150_000  # tests/checks/sizes.py
LAST = 20  # moments are 500 m apart
# name: runs, moment, colour, size, whether the longest fault is picked
PICTURES = {
    "lis1-5km": (["lis1"], 10, "window", WIDE, False),
    "lis1-10km": (["lis1"], LAST, "strata", WIDE, True),
    "lis2-5km": (["lis2"], 10, "strata", WIDE, False),
    "lis2-10km": (["lis2"], LAST, "rock", WIDE, False),
    "rfr-10km": (["rfr"], LAST, "strata", WIDE, False),
    "lis1-elastic-10km": (["lis1-elastic"], LAST, "strata", WIDE, False),
    "pair-5km": (["lis1", "lis1-seed2"], 10, "total", PAIR, False),
    "pair-10km": (["lis1", "lis1-seed2"], LAST, "strata", PAIR, False),
    "narrow-10km": (["lis1"], LAST, "strata", NARROW, False),
}
PICK = """
const done = arguments[arguments.length - 1], [section] = page.sections, run = section.run;
run.loadLines(page.t).then(({faults}) => {
  const longest = faults.reduce((best, fault, k) => fault.length_m > faults[best].length_m ? k : best, 0);
  return pick({kind: "fault", run, index: longest});
}).then(done);
"""


def browser(size):
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                 f"--window-size={size[0]},{size[1] + 200}"):
        options.add_argument(word)
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def draw(file, moment, colour, size, picked, picture):
    driver = browser(size)
    try:
        driver.get(f"file://{file}#{urlencode({'t': moment, 'colour': colour})}")
        while not driver.execute_script("return document.documentElement.dataset.ready"):
            time.sleep(0.05)
        if picked:
            driver.execute_async_script(PICK)
        time.sleep(1.0)  # charts follow the section
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": False})
        time.sleep(1.0)
        screen = io.BytesIO(driver.get_screenshot_as_png())
        image = Image.open(screen).convert("RGB")
        image.thumbnail((1000, 1000), Image.LANCZOS)
        for quality in (64, 56, 48):
            image.save(picture, quality=quality, method=6)
            if picture.stat().st_size <= MOST_BYTES:
                break
    finally:
        driver.quit()


def main(runs):
    with tempfile.TemporaryDirectory() as place:
        for name, (folders, *view) in PICTURES.items():
            file = Path(place, "+".join(folders) + ".html")
            if not file.exists():
                subprocess.run(["./listric", "report", *(runs / folder for folder in folders),
                                "--output", file], check=True)
            draw(file, *view, HERE / f"report/{name}.webp")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
