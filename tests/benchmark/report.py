#!/usr/bin/python3
"""What a report costs: python3 tests/benchmark/report.py PROGRAM DIR

DIR is a finished run's folder. Prints medians of five: seconds to make the file, its size, that of the
program's own code in it, milliseconds from opening it to the first frame, of a frame at 1600 x 640 as the
snapshots go by, and of finding what was clicked.
"""
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

FRAME = """
const [section] = page.sections, times = [];
Object.assign(page.view, {scale: page.view.scale * 1600 / section.discCanvas.width});
section.resize(1600, 640);
for (let k = 0; k < page.runs[0].moments.length; ++k) {
  section.discs(k);
  const colours = discColours(section.run, k, "strata", "batlow", 1, 20), begun = performance.now();
  section.painter.paint(page.view, section.discs(k), colours);
  times.push(performance.now() - begun);
}
const begun = performance.now();
for (let n = 0; n < 1000; ++n) section.painter.ownerAt(1.6 * n, 0.6 * n);
return [times.sort((a, b) => a - b)[times.length >> 1], (performance.now() - begun) / 1000];
"""


def browse(file):
    """Milliseconds to the first frame, of a frame, of a pick."""
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1640,1200"):
        options.add_argument(word)
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    try:
        driver.get(f"file://{file}")
        while not driver.execute_script("return document.documentElement.dataset.ready"):
            time.sleep(0.005)
        first = driver.execute_script("return page.firstFrame;")
        return first, *driver.execute_script(FRAME)
    finally:
        driver.quit()


def main(program, folder):
    with tempfile.TemporaryDirectory() as place:
        file = Path(place, "report.html")
        made, shown = [], []
        for _ in range(5):
            begun = time.perf_counter()
            subprocess.run([program, "report", folder, "--output", file], check=True,
                           stdout=subprocess.DEVNULL)
            made.append(time.perf_counter() - begun)
            shown.append(browse(file))
        text = file.read_text()
        data = sum(len(part) for part in re.findall(
            r'<script type="application/json" id="data">.*?</script>', text, re.DOTALL))
        charts = len(text.split("<script>")[1].split("</script>")[0])
        first, frame, pick = (statistics.median(column) for column in zip(*shown))
        print(f"made in {statistics.median(made):.2f} s; {len(text) / 1e6:.2f} MB, own code "
              f"{(len(text) - data - charts) / 1e3:.0f} kB; first frame {first:.0f} ms, a frame "
              f"{frame:.1f} ms, a pick {1e3 * pick:.1f} us")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: report.py PROGRAM DIR")
    main(*sys.argv[1:])
