"""Sections of a data set with their labels, the picture of docs/guides/dataset.md:

    PYTHONPATH=apps/python docs/pictures/dataset.py out/dataset-seismics SECTION... docs/pictures/tools/dataset.webp
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import listric  # noqa: E402

COLOURS = {1: (0.84, 0.15, 0.16), 2: (0.98, 0.65, 0.10), 3: (0.12, 0.47, 0.71),   # active, resting, detachment
           4: (0.17, 0.63, 0.17)}                                                # doubtful


def overlay(fault):
    picture = np.zeros((*fault.T.shape, 4))
    for label, colour in COLOURS.items():
        picture[fault.T == label] = (*colour, 0.9)
    return picture


def main(folder, *words):
    *names, file = words
    data = listric.Dataset(folder, split=None)
    places = {row["section"]: number for number, row in enumerate(data.index)}
    figure, panels = plt.subplots(len(names), 2, figsize=(9.0, 3.1 * len(names)), sharex="row", sharey="row",
                                  squeeze=False, layout="constrained")
    for name, row in zip(names, panels):
        arrays, axes = data.section(places[name], "image", "fault"), data.numbers(places[name])
        unit = "s" if "first_sample_s" in axes else "m"
        traces, samples = arrays["image"].shape
        left, top = axes["first_x_m"] / 1e3, axes[f"first_sample_{unit}"]
        bottom = top + samples * axes[f"sample_interval_{unit}"]
        extent = (left, left + traces * axes["trace_spacing_m"] / 1e3, bottom, top)
        for panel in row:
            panel.imshow(arrays["image"].T, cmap="gray", vmin=-3, vmax=3, extent=extent, aspect="auto")
        row[1].imshow(overlay(arrays["fault"]), extent=extent, aspect="auto", interpolation="nearest")
        row[0].set_ylabel("two-way time (s)" if unit == "s" else "depth (m)")
        row[0].set_title(f"{name}, {data.index[places[name]]['split']}", fontsize=9, loc="left")
    for panel in panels[-1]:
        panel.set_xlabel("distance from the breakaway (km)")
    figure.savefig(file, dpi=110, pil_kwargs={"quality": 72} if file.endswith(".webp") else {})


if __name__ == "__main__":
    main(*sys.argv[1:])
