#!/usr/bin/python3
"""Draws docs/pictures/model.svg: the parts of the model and their names.

Usage: docs/pictures/model.py
"""
import math
from pathlib import Path

KM = 17.0  # pixels
LEFT, TOP = 150.0, 70.0


def at(x, depth):
    return f"{LEFT + KM * x:.1f},{TOP + KM * depth:.1f}"


def arc(begin, end, steps=40):
    angles = [math.radians(begin + (end - begin) * k / steps) for k in range(steps + 1)]
    return [(15 - 15 * math.cos(a), 15 * math.sin(a)) for a in angles]


def shape(points, **style):
    words = " ".join(f'{key.replace("_", "-")}="{value}"' for key, value in style.items())
    return f'<polygon points="{" ".join(at(*p) for p in points)}" {words}/>'


def line(points, **style):
    words = " ".join(f'{key.replace("_", "-")}="{value}"' for key, value in style.items())
    return f'<polyline points="{" ".join(at(*p) for p in points)}" fill="none" {words}/>'


def word(x, depth, text, anchor="start", **style):
    words = " ".join(f'{key.replace("_", "-")}="{value}"' for key, value in style.items())
    px, py = at(x, depth).split(",")
    return f'<text x="{px}" y="{py}" text-anchor="{anchor}" {words}>{text}</text>'


def spring(x, depth):
    points, y = [(x, depth)], depth
    for k in range(6):
        y += 0.22
        points.append((x + (0.25 if k % 2 else -0.25), y))
    points.append((x, y + 0.22))
    return line(points, stroke="#5b6770", stroke_width=1.2)


def arrow(x, depth, length):
    return (line([(x, depth), (x + length, depth)], stroke="#1d2730", stroke_width=2)
            + shape([(x + length + 0.5, depth), (x + length, depth - 0.3), (x + length, depth + 0.3)], fill="#1d2730"))


def main():
    wall, end = 44.0, 47.0
    detachment = arc(0, 90) + [(end, 15.0)]
    cut = math.degrees(4.0 / 15.0)
    top = [*arc(0, cut)[-1:], (9, 1.9), (12, 2.8), (20, 2.0), (24.5, 0.15), (26, 0.0)]
    parts = [
        shape([(-6, 0), *detachment, (end, 20.0), (-6, 20.0)], fill="#d9dde0"),
        shape([*arc(0, 90), (wall, 15), (wall, 0), (0, 0)], fill="#d8c7a5"),
        shape([(0, 0), *arc(0, cut), *top[1:]], fill="#f1e3a0"),
        line(top, stroke="#8a6d3b", stroke_width=1.5),
        line(detachment, stroke="#9d1f2d", stroke_width=3),
        line([(-6, 0), (end, 0)], stroke="#1d2730", stroke_width=0.8, stroke_dasharray="5 4"),
        line([(9.5, 2.1), (12.5, 6), (16, 10.5), (17.5, 14.2)], stroke="#1d2730", stroke_width=2),
        line([(24.0, 0.4), (22.3, 4), (20.0, 9), (17.8, 13.2)], stroke="#1d2730", stroke_width=2),
        line([(wall, -1), (wall, 15)], stroke="#1d2730", stroke_width=4),
        line([(0, 0), (0, -1.2)], stroke="#5b6770", stroke_width=3),
        arrow(wall + 0.6, 7, 2.2), arrow(38.0, 15.75, 3),
        *(spring(x, 20.0) for x in range(-5, 47, 4)),
        '<circle cx="{}" cy="{}" r="4" fill="#9d1f2d"/>'.format(*at(0, 0).split(",")),
        '<circle cx="{}" cy="{}" r="4" fill="#8a6d3b"/>'.format(*at(*top[0]).split(",")),
        '<circle cx="{}" cy="{}" r="4" fill="#9d1f2d"/>'.format(*at(15, 15).split(",")),
        word(-0.3, -1.5, "breakaway (x = 0)", "middle"),
        word(-0.4, 4.3, "cutoff", "end"),
        line([(-0.3, 4.1), top[0]], stroke="#1d2730", stroke_width=0.8),
        word(4.9, 7.6, "head block"), word(1.4, 2.0, "syn-rift sediment", font_size="12"),
        word(8.2, 1.3, "rollover crest", font_size="12"), word(14.0, 1.2, "collapse graben", font_size="12"),
        word(8.9, 8.6, "synthetic fault", font_size="12"), word(22.6, 7.0, "antithetic fault", font_size="12"),
        word(30, 7.6, "hanging wall (discs)"), word(-5.6, 9.5, "footwall,"), word(-5.6, 10.7, "rigid or"), word(-5.6, 11.9, "elastic"),
        word(13.2, 16.3, "sole-out point", "end"), line([(13.3, 16.0), (15, 15)], stroke="#1d2730", stroke_width=0.8),
        word(17.5, 16.1, "detachment: a sheet that moves with the wall"),
        word(wall - 0.4, -1.5, "right wall, moves away", "middle"),
        word(28, -0.35, "original surface, depth 0", font_size="12"),
        line([(-6, 18.1), (end, 18.1)], stroke="#5b6770", stroke_width=0.8, stroke_dasharray="3 4"),
        word(20, 17.7, "elastic thickness: strong rock", "middle", font_size="12"),
        word(20, 19.2, "relaxed rock", "middle", font_size="12"),
        word(20, 22.9, "springs of isostasy, only with an elastic footwall", "middle", font_size="12"),
    ]
    width, height = LEFT + KM * 49.5, TOP + KM * 23.6
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
            f'font-family="sans-serif" font-size="14" fill="#1d2730">\n'
            f'<rect width="100%" height="100%" fill="#ffffff"/>\n' + "\n".join(parts) + "\n</svg>\n")
    Path(__file__).with_suffix(".svg").write_text(text)


if __name__ == "__main__":
    main()
