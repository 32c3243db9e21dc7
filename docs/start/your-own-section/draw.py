#!/usr/bin/python3
"""An imaginary section to try Listric on: no data of anybody's.

Usage: draw.py DIR

DIR gets section.png (a picture of the section), section.svg (the fault as a path in units of 100 m,
exaggerated twice), fault.csv (the same fault as picked points), picks.csv (two horizons, picked with
an error of 40 m) and scene.toml (a copy of the scene beside this script).
"""
import math
import os
import random
import shutil
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

LENGTH, DEPTH = 46000.0, 12000.0   # of the section, m
EXTENSION = 6000.0                 # m, in 600,000 years
# Dip at the surface, then arcs: radius (m), dip at the far end (degrees).
START_DIP, ARCS = 62.0, ((14000.0, 38.0), (20000.0, 12.0), (40000.0, 0.0))


def fault() -> list[tuple[float, float]]:
    """Points of the fault every 50 m: x, depth."""
    x = depth = 0.0
    points, dip = [(x, depth)], math.radians(START_DIP)
    for radius, end in ARCS:
        steps = max(1, round(radius * (dip - math.radians(end)) / 50.0))
        turn = (dip - math.radians(end)) / steps
        for _ in range(steps):
            x += radius * turn * math.cos(dip - turn / 2)
            depth += radius * turn * math.sin(dip - turn / 2)
            dip -= turn
            points.append((x, depth))
    while x < LENGTH:
        x += 50.0
        points.append((x, depth))
    return points


def depth_at(points: list[tuple[float, float]], x: float) -> float:
    if x <= 0.0:
        return 0.0
    for (x0, z0), (x1, z1) in zip(points, points[1:]):
        if x <= x1:
            return z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    return points[-1][1]


def horizon(points, slip: float) -> list[tuple[float, float]]:
    """Top of what was flat that extension ago: sheared vertically, it follows the fault."""
    xs = [100.0 * k for k in range(int(LENGTH / 100.0) + 1)]
    return [(x, depth_at(points, x) - depth_at(points, x - slip)) for x in xs if x >= slip]


def draw_section(points, folder: str) -> None:
    figure = pyplot.figure(figsize=(LENGTH / 4000.0, DEPTH / 4000.0), dpi=200)
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_xlim(0, LENGTH)
    ax.set_ylim(DEPTH, 0)
    ax.set_axis_off()
    noise = random.Random(1)
    for k in range(1, 24):                         # reflectors of the basin, grey and broken
        line = horizon(points, EXTENSION * k / 24)
        for begin in range(0, len(line) - 8, 8):
            if noise.random() < 0.8:
                ax.plot(*zip(*line[begin:begin + 8]), color="0.55", linewidth=0.7)
    ax.plot(*zip(*horizon(points, EXTENSION)), color="0.15", linewidth=1.4)
    ax.plot(*zip(*points), color="0.15", linewidth=1.8)
    figure.savefig(os.path.join(folder, "section.png"))
    pyplot.close(figure)


def write_svg(points, folder: str) -> None:
    path = " ".join(f"{x / 100.0:.2f},{depth / 50.0:.2f}" for x, depth in points[::8])
    with open(os.path.join(folder, "section.svg"), "w", encoding="utf-8") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LENGTH / 100.0:g} '
                   f'{DEPTH / 50.0:g}">\n  <path id="fault" fill="none" stroke="black" '
                   f'd="M {path}"/>\n</svg>\n')


def write_picks(points, folder: str) -> None:
    noise = random.Random(2)
    with open(os.path.join(folder, "fault.csv"), "w", encoding="utf-8") as file:
        file.write("x_m,depth_m\n")
        for x, depth in points[::10]:
            file.write(f"{x:.0f},{depth:.0f}\n")
    with open(os.path.join(folder, "picks.csv"), "w", encoding="utf-8") as file:
        file.write("name,x_m,depth_m,age_a\n")
        for name, slip, age in (("top of the pre-rift", EXTENSION, 600000),
                                ("middle of the rift", EXTENSION / 2, 300000)):
            for x, depth in horizon(points, slip)[10::10]:
                if x > 8000.0:
                    file.write(f"{name},{x:.0f},{depth + noise.gauss(0.0, 40.0):.0f},{age}\n")


def main(folder: str) -> None:
    os.makedirs(folder, exist_ok=True)
    points = fault()
    draw_section(points, folder)
    write_svg(points, folder)
    write_picks(points, folder)
    shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "scene.toml"), folder)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: draw.py DIR")
    main(sys.argv[1])
