#!/usr/bin/python3
"""Runs of several seeds on one section.

Usage: seeds.py FILE DIR picture|page

FILE is the JSON that the program makes of the runs; DIR gets seeds.png: for each scene the faults and block
edges of all seeds on one section with the mean of the tops and their standard deviation, and below it, by
kilometre, the share of seeds with a fault's upper end there, with its exact 90 % interval; and
seeds-apart.png: a small section of each seed.  With "page" DIR gets report.html, too: the pictures, the
measures as points that open their runs, and a table.  Files are written under temporary names and then
renamed.  On bad input: one line on stderr, exit status 2.
"""
import base64
import html
import os
import sys
from urllib.parse import quote

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))  # an isolated Python does not
sys.dont_write_bytecode = True  # the sources may be read-only, and stay clean
from plot import FAINT, INK, STYLE, LineCollection, matplotlib, new_figure, np, read_json, run, save, without_frame
from script import InputError

SYNTHETIC, ANTITHETIC, EDGE, TOP, CHANCE = "#b4561d", "#1f6fb4", "#2e7d32", "#444444", "#8a8a8a"
WIDTH, SECTION, CHANCES, ROW_EXTRA = 10.0, 3.1, 1.15, 0.95   # inches
MOST_SCENES, MOST_TOPS = 12, 8
COLUMNS, MOST_APART = 4, 24   # small sections beside each other, and of a scene
LINES = ("faults that are active at the end: orange dip as the detachment does, blue against it; green: edges of "
         "blocks that moved as one")
SHOWN = ("greatest_throw_m", "depocentre_x_m", "depocentre_thickness_m", "rollover_tilt_deg",
         "halfgraben_area_share", "basin_area_m2", "cutoff_x_m", "strain_top10", "strain_top10_cumulative",
         "intervening_high_x_m", "basement_unbonded_fraction")


def chosen(tops: list[dict]) -> list[dict]:
    """Tops that are drawn: the pre-rift one, and evenly the others."""
    if len(tops) <= MOST_TOPS:
        return tops
    return [tops[round(k * (len(tops) - 1) / (MOST_TOPS - 1))] for k in range(MOST_TOPS)]


def gaps(x: np.ndarray) -> np.ndarray:
    """Where a line ends and another begins, km."""
    return np.flatnonzero(np.diff(x) > 0.3) + 1


def draw_lines(ax, scene: dict, runs: list[dict], width: float) -> None:
    """Base, faults and block edges of runs."""
    faint = max(0.3, 1.0 / len(runs) ** 0.4)
    for synthetic, colour in ((True, SYNTHETIC), (False, ANTITHETIC)):
        lines = [np.array(fault["points"]) / 1e3 for seed in runs for fault in seed["faults"]
                 if fault["synthetic"] is synthetic]
        ax.add_collection(LineCollection(lines, colors=colour, linewidths=width, alpha=faint))
    edges = [np.array(edge) / 1e3 for seed in runs for edge in seed["edges"]]
    ax.add_collection(LineCollection(edges, colors=EDGE, linewidths=width, alpha=faint, linestyles=(0, (4, 2))))
    if scene["base"]:
        base = np.array(scene["base"]) / 1e3
        ax.plot(base[:, 0], base[:, 1], color=INK, lw=1.4 * width)
    ax.set_xlim(0.0, scene["length_m"] / 1e3)
    ax.set_ylim(-1.03 * scene["depth_m"] / 1e3, 0.09 * scene["depth_m"] / 1e3)
    ax.set_aspect("equal", adjustable="box", anchor="SW")
    without_frame(ax)


def draw_section(ax, scene: dict) -> None:
    for top in chosen(scene.get("tops", [])):
        x, mean, deviation = (np.array(top[key]) / 1e3 for key in ("x", "mean", "deviation"))
        for part in zip(*(np.split(values, gaps(x)) for values in (x, mean, deviation))):
            ax.fill_between(part[0], part[1] - part[2], part[1] + part[2], color=TOP, alpha=0.13, lw=0)
            ax.plot(part[0], part[1], color=TOP, lw=1.1 if top["stratum"] == 0 else 0.6)
    draw_lines(ax, scene, scene["runs"], 1.0)
    ax.set_ylabel("y, km")
    ax.tick_params(labelbottom=False)
    seeds = len(scene["runs"])
    ax.set_title(f"{scene['title']}: {seeds} seed{'s' if seeds > 1 else ''} at "
                 f"{scene['runs'][0]['extension_m'] / 1e3:.3g} km", loc="left", fontsize=10, weight="semibold")


def draw_chances(ax, scene: dict) -> None:
    x, met, of, low, high = np.array(scene["chances"]).T
    share = met / of
    ax.bar(x / 1e3, share, width=0.86, color=CHANCE, lw=0)
    away = np.maximum(0.0, (share - low, high - share))
    ax.errorbar(x / 1e3, share, yerr=away, fmt="none", ecolor=INK, elinewidth=0.6)
    ax.set_xlim(0.0, scene["length_m"] / 1e3)
    ax.set_ylim(0.0, 1.0)
    ax.set_yticks((0.0, 0.5, 1.0))
    ax.set_ylabel("share\nof seeds", fontsize=8.5)
    ax.set_xlabel("x, km from the breakaway")
    without_frame(ax)


def draw(scenes: list[dict]):
    shown = scenes[:MOST_SCENES]
    high = (WIDTH - 1.0) * max(1.12 * scene["depth_m"] / scene["length_m"] for scene in shown)
    row = high + CHANCES + ROW_EXTRA
    up = len(shown) * row + 0.45
    figure = new_figure(WIDTH, up, 130)
    for k, scene in enumerate(shown):
        bottom = up - (k + 1) * row + 0.6
        wide = (WIDTH - 1.0) / WIDTH
        draw_chances(figure.add_axes((0.75 / WIDTH, bottom / up, wide, (CHANCES - 0.25) / up)), scene)
        draw_section(figure.add_axes((0.75 / WIDTH, (bottom + CHANCES - 0.1) / up, wide, high / up)), scene)
    left_out = len(scenes) - len(shown)
    figure.text(0.1 / WIDTH, 0.12 / up, f"{LINES}\ntops: mean and standard deviation; bars: a fault's upper end in "
                "this km, line: exact 90 % interval"
                + (f"; {left_out} more scenes are in the tables" if left_out else ""), fontsize=7, color=FAINT)
    return figure


def draw_seed(ax, scene: dict, seed: dict) -> None:
    for top in chosen(seed["tops"]):
        x, y = (np.array(top[key]) / 1e3 for key in ("x", "y"))
        for part in zip(*(np.split(values, gaps(x)) for values in (x, y))):
            ax.plot(*part, color=TOP, lw=0.9 if top["stratum"] == 0 else 0.4)
    draw_lines(ax, scene, [seed], 0.8)
    ax.set_xticks(())
    ax.set_yticks(())
    ax.set_title(f"seed {seed['seed']}", loc="left", fontsize=7.5, pad=1.0)


def draw_apart(scenes: list[dict]):
    """A small section of each seed."""
    shown = [(scene, scene["runs"][:MOST_APART]) for scene in scenes[:MOST_SCENES]]
    wide = (WIDTH - 0.2) / COLUMNS
    heights = [(wide - 0.15) * 1.12 * scene["depth_m"] / scene["length_m"] + 0.25 for scene, _ in shown]
    up = 0.35 + sum(0.35 + high * -(-len(runs) // COLUMNS) for (_, runs), high in zip(shown, heights))
    figure = new_figure(WIDTH, up, 130)
    below = up
    for (scene, runs), high in zip(shown, heights):
        more = f", {len(runs)} of {len(scene['runs'])} seeds" if len(runs) < len(scene["runs"]) else ""
        figure.text(0.1 / WIDTH, (below - 0.22) / up, scene["title"] + more, fontsize=10, weight="semibold")
        below -= 0.35
        for k, seed in enumerate(runs):
            row, column = divmod(k, COLUMNS)
            place = (0.1 + column * wide) / WIDTH, (below - (row + 1) * high) / up
            draw_seed(figure.add_axes((*place, (wide - 0.15) / WIDTH, (high - 0.2) / up)), scene, seed)
        below -= high * -(-len(runs) // COLUMNS)
    figure.text(0.1 / WIDTH, 0.12 / up, LINES, fontsize=7, color=FAINT)
    return figure


def scatter(scenes: list[dict], measure: str) -> str:
    """Values of a measure as points that open their runs, a column per scene."""
    points = [(k, seed, seed["measures"][measure]) for k, scene in enumerate(scenes) for seed in scene["runs"]
              if measure in seed["measures"]]
    if not points:
        return ""
    low, high = min(p[2] for p in points), max(p[2] for p in points)
    span = (high - low) or abs(high) or 1.0
    wide, tall = max(220, 60 + 46 * len(scenes)), 190
    marks = []
    for k, seed, value in points:
        x = 70 + 46 * k + 7 * ((seed["seed"] * 7) % 5 - 2)
        y = 20 + (tall - 50) * (1.0 - (value - low) / span)
        link = quote(seed["folder"] + ("/report.html" if seed["has_report"] else "/"))
        marks.append(f'<a href="{link}"><circle cx="{x}" cy="{y:.1f}" r="5"><title>scene {k + 1}, seed {seed["seed"]}: '
                     f'{value:.5g}</title></circle></a>')
    names = "".join(f'<text x="{70 + 46 * k}" y="{tall - 8}" text-anchor="middle">{k + 1}</text>'
                    for k in range(len(scenes)))
    return (f'<figure><figcaption>{html.escape(measure)}</figcaption><svg width="{wide}" height="{tall}" role="img">'
            f'<text x="4" y="24">{high:.4g}</text><text x="4" y="{tall - 26}">{low:.4g}</text>'
            f'{names}{"".join(marks)}</svg></figure>')


def page(scenes: list[dict], folder: str) -> str:
    pictures = {}
    for name in "seeds", "seeds-apart":
        with open(os.path.join(folder, f"{name}.png"), "rb") as file:
            pictures[name] = "data:image/png;base64," + base64.b64encode(file.read()).decode()
    measures = [name for name in SHOWN if any(name in seed["measures"] for scene in scenes for seed in scene["runs"])]
    rows = "".join(
        f'<tr><td>{k}</td><td>{html.escape(scene["title"])}</td><td><a href="{quote(seed["folder"])}/'
        f'{"report.html" if seed["has_report"] else ""}">{html.escape(seed["folder"])}</a></td><td>{seed["seed"]}</td>'
        + "".join(f'<td>{seed["measures"][name]:.4g}</td>' if name in seed["measures"] else "<td></td>"
                  for name in measures) + "</tr>"
        for k, scene in enumerate(scenes, 1) for seed in scene["runs"])
    number = sum(len(scene["runs"]) for scene in scenes)
    return f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Listric: {number} runs</title>
<style>body{{font:15px/1.45 sans-serif;margin:1.5rem auto;max-width:72rem;padding:0 1rem}}img{{max-width:100%}}
figure{{display:inline-block;margin:0 1rem 1rem 0}}svg text{{font-size:11px;fill:#555}}
circle{{fill:#1f6fb4;fill-opacity:.6}}circle:hover{{fill:#b4561d}}
table{{border-collapse:collapse;font-size:13px}}td,th{{padding:.15rem .6rem;text-align:right}}</style></head>
<body><h1>{number} runs, {len(scenes)} scene{"s" if len(scenes) > 1 else ""}</h1>
<p><img alt="faults of all seeds on one section" src="{pictures["seeds"]}"></p>
<details><summary>Each seed apart</summary><img alt="a section of each seed" src="{pictures["seeds-apart"]}"></details>
<h2>Measures</h2><p>A point is a run; a click opens it. Numbers below are those of the scenes in the table.</p>
{"".join(scatter(scenes, name) for name in measures)}
<h2>Runs</h2><table><tr><th></th><th>scene</th><th>run</th><th>seed</th>
{"".join(f"<th>{name}</th>" for name in measures)}</tr>{rows}</table>
<p>Tables: <a href="seeds.csv">seeds.csv</a>, <a href="seed-tops.csv">seed-tops.csv</a>,
<a href="seed-measures.csv">seed-measures.csv</a>.</p>
</body></html>
"""


def main(path: str, folder: str, kind: str) -> None:
    try:
        scenes = read_json(path)["ensembles"]
        with matplotlib.rc_context(STYLE):
            save(draw(scenes), folder, "seeds")
            save(draw_apart(scenes), folder, "seeds-apart")
        if kind == "page":
            text = page(scenes, folder)
    except (KeyError, TypeError, IndexError) as failure:
        raise InputError(f"{path}: not the runs of seeds ({failure!r})") from failure
    if kind == "page":
        temporary = os.path.join(folder, f".report-{os.getpid()}.tmp")
        with open(temporary, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(temporary, os.path.join(folder, "report.html"))


if __name__ == "__main__":
    run(main, "seeds.py FILE DIR picture|page")
