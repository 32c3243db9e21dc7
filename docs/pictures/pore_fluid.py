#!/usr/bin/python3
"""Draws docs/pictures/scenes/NAME-10km.webp of a run with pore fluid: overpressure and undercompaction in section with
faults, isobars and flow, and pressure, porosity and mud weight at the depocentre. Of a run with beds: which is which in
place of undercompaction.

Usage: PYTHONPATH=apps/python docs/pictures/pore_fluid.py RUN [PICTURE.webp]

RUN is the folder of a finished run, such as out/lis1-mud. Needs what animate.py needs.
"""
import io
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import animate
import listric

RATIO, POROSITY = plt.get_cmap("magma_r"), plt.get_cmap("Purples")
GRAVITY, WATER = 9.81, 1030.0   # as in the shipped scenes


def section(figure, axes, snapshot, values, colours, highest, label):
    """A number of sediment on pale rock, with base and faults."""
    x, depth, stratum = snapshot.raster("stratum", animate.SPACING)
    extent = (x[0] / 1e3, x[-1] / 1e3, depth[-1] / 1e3, depth[0] / 1e3)
    rock = np.where(np.asarray(stratum) == 0, 1.0, np.nan)
    axes.imshow(np.ma.masked_invalid(rock), cmap="Greys", vmin=0, vmax=8, interpolation="nearest", extent=extent)
    shown = np.where(np.asarray(stratum) > 0, values, np.nan)
    image = axes.imshow(np.ma.masked_invalid(shown), cmap=colours, vmin=0.0, vmax=highest,
                        interpolation="nearest", extent=extent)
    foot_x, foot_z = animate.base(snapshot)
    axes.plot(foot_x, foot_z, color=animate.INK, lw=1.2)
    for fault in snapshot.lines("faults"):
        axes.plot(np.asarray(fault["x_m"]) / 1e3, np.asarray(fault["depth_m"]) / 1e3, color=animate.INK, lw=0.9)
    axes.set(xlim=(-1, 36), ylim=(11.5, -1.2), ylabel="depth (km)")
    return figure.colorbar(image, ax=axes, label=label, fraction=0.03, pad=0.01)


def means(grid, cells):
    """A raster averaged over squares of so many cells: a disc alone is no pressure."""
    values = np.asarray(grid, dtype=float)
    rows, columns = (n - n % cells for n in values.shape)
    squares = values[:rows, :columns].reshape(rows // cells, cells, columns // cells, cells)
    share = np.isfinite(squares).mean(axis=(1, 3))
    sums = np.nansum(squares, axis=(1, 3))
    return np.divide(sums, share * cells * cells, out=np.full(sums.shape, np.nan), where=share > 0.6)


def isobars(axes, snapshot):
    """Excess pressure by contours, and flow of water by arrows whose lengths go by the root."""
    x, depth, stratum = snapshot.raster("stratum", animate.SPACING)
    sediment = np.asarray(stratum) > 0

    def of(column, cells):
        return means(np.where(sediment, snapshot.raster(column, animate.SPACING)[2], np.nan), cells)

    def places(cells):
        at = [np.asarray(v)[:len(v) - len(v) % cells].reshape(-1, cells).mean(axis=1) / 1e3 for v in (x, depth)]
        return np.meshgrid(*at)

    near = max(1, round(400 / animate.SPACING))
    pressure = of("excess_pressure", near) / 1e6
    lines = axes.contour(*places(near), np.ma.masked_invalid(pressure), colors="#00bcd4", linewidths=0.9,
                         levels=np.arange(5, 200, 5))
    axes.clabel(lines, fmt="%d MPa", fontsize=6)
    far = max(1, round(1200 / animate.SPACING))
    flow_x, flow_y = of("darcy_x", far) * 3.156e10, of("darcy_y", far) * 3.156e10   # mm/a
    speed = np.hypot(flow_x, flow_y)
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(speed / np.nanpercentile(speed, 95)).clip(max=1.5) / speed
    axes.quiver(*places(far), flow_x * root, flow_y * root, color="#0d47a1", scale=28, width=0.0017, zorder=4)


def bed_of(run, age_a):
    """Number of the bed of an age of the run, from 0."""
    ends = [bed["until_a"] for bed in run.scene["bed"] if "until_a" in bed]
    return np.searchsorted(np.asarray(ends) * (1 + 1e-9), age_a)


def curves(axes, profile, run):
    """Pressure, porosity and mud weight down from the ground, with the names of beds."""
    column = {name: np.array([row[name] for row in profile]) for name in profile[0]}
    z = column["depth_m"] / 1e3
    at_rest = WATER * GRAVITY * column["depth_m"] / 1e6
    pressure, porosity, weight = axes
    pressure.plot(at_rest, z, color="#1565c0", lw=1, label="water at rest")
    pressure.plot(column["total_stress_pa"] / 1e6, z, color="#5d4037", lw=1, label="weight of all")
    pressure.plot(column["fracture_pressure_pa"] / 1e6, z, color="#5d4037", lw=1, ls=":",
                  label="fractures")
    pressure.plot(column["pressure_pa"] / 1e6, z, color="#b71c1c", lw=2, label="pore pressure")
    pressure.set(xlabel="pressure (MPa)", ylabel="depth (km)")
    porosity.plot(column["normal_porosity"], z, color="#1565c0", lw=1, label="water at rest")
    porosity.plot(column["porosity"], z, color="#4a148c", lw=2, label="porosity")
    porosity.set(xlabel="porosity")
    weight.plot(column["mud_weight_kg_per_m3"] / 1e3, z, color="#b71c1c", lw=2)
    weight.set(xlabel="mud weight (g/cm³)")
    if "bed" in run.scene:
        now = run.summary["extension_m"] / run.scene["extension"].get("rate_m_per_a", 0.01)
        bed = bed_of(run, now - column["age_a"])
        for change in np.flatnonzero(np.diff(bed)):
            for panel in axes:
                panel.axhline(0.5 * (z[change] + z[change + 1]), color="#9e9e9e", lw=0.8, ls="--")
        for k in np.unique(bed):
            porosity.text(0.99, z[bed == k].mean(), run.scene["bed"][k].get("name", ""), fontsize=7, ha="right",
                          transform=porosity.get_yaxis_transform())
    for panel in axes:
        panel.set_ylim(z[-1] * 1.02, 0.0)
        panel.spines[["top", "right"]].set_visible(False)
    for panel in axes[:2]:
        panel.legend(frameon=False, fontsize=7)


def main():
    run = listric.Run(sys.argv[1])
    snapshot = run.snapshots[-1]
    _, _, ratio = snapshot.raster("overpressure_ratio", animate.SPACING)
    _, depth, porosity = snapshot.raster("porosity", animate.SPACING)
    decay = run.scene["compaction"].get("coefficient_per_km", 0.4) / 1e3
    fresh = run.scene["sedimentation"].get("surface_porosity", 0.5)
    normal = fresh * np.exp(-decay * np.maximum(np.asarray(depth), 0.0))[:, np.newaxis]
    figure = plt.figure(figsize=(9.0, 9.2), dpi=100, layout="constrained")
    grid = figure.add_gridspec(3, 3)
    first, second = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :])
    section(figure, first, snapshot, ratio, RATIO, 1.0, "overpressure ratio λ*")
    isobars(first, snapshot)
    if "bed" in run.scene:
        _, _, stratum = snapshot.raster("stratum", animate.SPACING)
        rate = run.scene["extension"].get("rate_m_per_a", 0.01)
        laid = np.asarray(snapshot.raster("start_travel", animate.SPACING)[2]) / rate
        beds = np.where(np.asarray(stratum) > 0, bed_of(run, laid) + 1.0, np.nan)
        bar = section(figure, second, snapshot, beds, plt.get_cmap("YlOrBr"), len(run.scene["bed"]) + 1.0, "")
        bar.set_ticks(range(1, len(run.scene["bed"]) + 1), labels=[bed.get("name", "") for bed in run.scene["bed"]])
    else:
        section(figure, second, snapshot, np.asarray(porosity) - normal, POROSITY, 0.3, "porosity − that at rest")
    second.set_xlabel("distance from the breakaway (km)")
    first.set_title(f"{run.scene.get('name', 'lis1-mud')}, {snapshot.extension_m / 1e3:.0f} km of extension", loc="left")
    curves([figure.add_subplot(grid[2, k]) for k in range(3)], run.summary["pressure_profile"], run)
    picture = Path(sys.argv[2] if len(sys.argv) > 2 else animate.HERE / "scenes/lis1-mud-10km.webp")
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    Image.open(buffer).convert("RGB").save(picture, quality=70, method=6)


if __name__ == "__main__":
    main()
