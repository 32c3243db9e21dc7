#!/usr/bin/python3
"""Time of a frame while a node of a drawing page is dragged, in headless Chromium.

Usage: drawing.py PAGE..., pages that `listric draw` wrote

Prints, for 120 steps of the first node, the page's own work per frame, the time between frames (16.7 ms is every frame
of the screen), the processor time of the page's thread per frame (pointer, script, style, layout, paint), and the least work of
five times the same steps, in which other programs have no part.
"""
import sys
import time
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains

STEPS = 120
WATCH = """
frameTimes.length = 0;
window.ticks = [];
let last = 0;
const tick = now => { if (page.drag) window.ticks.push(now - last); last = now; requestAnimationFrame(tick); };
requestAnimationFrame(tick);"""


LEAST = """
const before = copyState(page.state), {x, y} = chainOf(shapeNow())[0].end, least = [];
page.drag = {key: "node 0"};
for (let k = 0; k < arguments[0]; ++k) {
  const away = k % 60 < 30 ? k % 60 : 60 - k % 60, times = [];
  for (let turn = 0; turn < 5; ++turn) {
    const start = performance.now();
    page.state = copyState(before);
    moveHandle(page.state, "node 0", {x: x + 60 * away, y: y - 30 * away});
    showSection();
    tellChosen();
    times.push(performance.now() - start);
  }
  least.push(Math.min(...times));
}
[page.drag, page.state] = [null, before];
showSection();
return least;"""


def browser():
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1400,1200"):
        options.add_argument(word)
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def measure(driver, page):
    driver.get(f"file://{Path(page).resolve()}")
    while not driver.execute_script("return document.documentElement.dataset.ready"):
        time.sleep(0.05)
    driver.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    driver.execute_script(WATCH)
    before = processor_time(driver)
    node = driver.find_element("css selector", '.handle[data-key="node 0"] .reach')
    actions = ActionChains(driver, duration=16).move_to_element(node).click_and_hold()
    for k in range(STEPS):
        actions.move_by_offset(*((2, 1) if k % 60 < 30 else (-2, -1)))
    actions.release().perform()
    spent = processor_time(driver) - before
    work, between = driver.execute_script("return [frameTimes, window.ticks];")
    return work, between, spent / len(work), driver.execute_script(LEAST, STEPS)


def processor_time(driver):
    """Of all tasks of the page's thread, ms."""
    metrics = driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    return 1000 * next(one["value"] for one in metrics if one["name"] == "TaskDuration")


def summary(times):
    times = sorted(times)
    at = lambda share: times[min(int(share * len(times)), len(times) - 1)]
    return f"median {at(0.5):.1f}, 95 % {at(0.95):.1f}, most {times[-1]:.1f} ms ({len(times)} frames)"


def main(pages):
    driver = browser()
    try:
        for page in pages:
            work, between, spent, least = measure(driver, page)
            print(f"{Path(page).name}: work {summary(work)}; between frames {summary(between)}; "
                  f"processor {spent:.1f} ms per frame; least work of five {summary(least)}")
    finally:
        driver.quit()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: drawing.py PAGE...")
    main(sys.argv[1:])
