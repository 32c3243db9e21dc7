#!/usr/bin/python3
"""Draws docs/pictures/bases.svg: what of the base moves with the right wall, by detachment.base.

Usage: docs/pictures/bases.py
"""
import math
from pathlib import Path

KM, WIDE, HIGH = 9.0, 320.0, 190.0  # pixels: of a km, of a panel
MOVES, RESTS, INK = "#9d1f2d", "#5b6770", "#1d2730"
PANELS = (("sheet", "the whole detachment pulls", "pulls", "pulls"),
          ("ramp", "the ramp resists, the flat pulls", "rests", "pulls"),
          ("rests", "all of the footwall resists", "rests", "rests"))


def panel(number, name, words, ramp, flat):
    def at(x, depth):
        return f"{WIDE * number + 20 + KM * x:.1f},{45 + KM * depth:.1f}"

    def line(points, colour, width):
        return (f'<polyline points="{" ".join(at(*p) for p in points)}" fill="none" stroke="{colour}" '
                f'stroke-width="{width}"/>')

    def shape(points, colour):
        return f'<polygon points="{" ".join(at(*p) for p in points)}" fill="{colour}"/>'

    def arrow(x, depth, angle, colour):
        c, s = math.cos(angle), math.sin(angle)
        tip = (x + 2.6 * c, depth + 2.6 * s)
        head = [tip, *((tip[0] - 1.0 * c - side * s, tip[1] - 1.0 * s + side * c) for side in (0.5, -0.5))]
        return line([(x, depth), tip], colour, 2) + shape(head, colour)

    arc = [(10 - 10 * math.cos(a), 10 * math.sin(a)) for a in (math.radians(3 * k) for k in range(31))]
    sole, colour = [arc[-1], (28, 10)], {"pulls": MOVES, "rests": RESTS}
    parts = [shape([(-2, 0), *arc, (32, 10), (32, 13), (-2, 13)], "#d9dde0"),
             shape([*arc, (28, 10), (28, 0)], "#d8c7a5"),
             line(arc, colour[ramp], 4), line(sole, colour[flat], 4),
             line([(28, 0), (28, 10)], INK, 3), arrow(28.6, 5, 0.0, INK)]
    if ramp == "pulls":
        parts += [arrow(arc[k][0] - 0.9, arc[k][1] + 0.9, math.radians(90 - 3 * k), MOVES) for k in (9, 19)]
    if flat == "pulls":
        parts += [arrow(x, 11.2, 0.0, MOVES) for x in (12, 18, 24)]
    left, top = at(-2, 0).split(",")
    bottom = at(0, 15).split(",")[1]
    parts += [f'<text x="{left}" y="{float(top) - 18}" font-size="15" font-weight="bold">{name}</text>',
              f'<text x="{left}" y="{bottom}" font-size="13">{words}</text>']
    return "\n".join(parts)


def main():
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE * len(PANELS):.0f} {HIGH:.0f}" '
            f'font-family="sans-serif" fill="{INK}">\n<rect width="100%" height="100%" fill="#ffffff"/>\n'
            + "\n".join(panel(k, *one) for k, one in enumerate(PANELS)) + "\n</svg>\n")
    (Path(__file__).parent / "bases.svg").write_text(text)


if __name__ == "__main__":
    main()
