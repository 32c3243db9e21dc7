#!/usr/bin/python3
"""Time of a frame while a node of a drawing page is dragged, in headless Chromium.

Usage: drawing.py PAGE..., pages that `listric draw` wrote

Prints, for 120 steps of the first node, the page's own work per frame and the time between frames (16.7 ms is
every frame of the screen).
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


def browser():
    options = Options()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1400,1200"):
        options.add_argument(word)
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def measure(driver, page):
    driver.get(f"file://{Path(page).resolve()}")
    while not driver.execute_script("return document.documentElement.dataset.ready"):
        time.sleep(0.05)
    driver.execute_script(WATCH)
    node = driver.find_element("css selector", '.handle[data-key="node 0"] .reach')
    actions = ActionChains(driver, duration=16).move_to_element(node).click_and_hold()
    for k in range(STEPS):
        actions.move_by_offset(*((2, 1) if k % 60 < 30 else (-2, -1)))
    actions.release().perform()
    return driver.execute_script("return [frameTimes, window.ticks];")


def summary(times):
    times = sorted(times)
    at = lambda share: times[min(int(share * len(times)), len(times) - 1)]
    return f"median {at(0.5):.1f}, 95 % {at(0.95):.1f}, most {times[-1]:.1f} ms ({len(times)} frames)"


def main(pages):
    driver = browser()
    try:
        for page in pages:
            work, between = measure(driver, page)
            print(f"{Path(page).name}: work {summary(work)}; between frames {summary(between)}")
    finally:
        driver.quit()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: drawing.py PAGE...")
    main(sys.argv[1:])
