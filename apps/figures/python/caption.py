"""Captions of figures, as a journal has them, and beside them how figures were made."""
import json
import os
from collections.abc import Sequence

from frame import Frame
from page import letter, moment_text, strain_remark, time_text, window_text, without_source
from plot import Order

SHOWN = {
    "strata": "syn-rift strata by age and pre-rift layers by depth at the start",
    "bonds": "intact bonds between discs",
    "behaviour": "rock behaviour by the share of broken bonds, weakened rock by whether a fault is traced there",
    "strain": "maximum shear strain{remark}, {window}",
    "sediment": "thickness of the sediment (mean over 1 km) and depth of the pre-rift top",
    "kinematics": "pre-rift top beside kinematic predictions",
    "inversion": "height above the regional of the tops of all strata",
    "seismic": "synthetic seismic image in two-way time",
    "seismic-depth": "synthetic seismic image in depth",
    "underlay": "the model's horizons and faults over a picture of a section",
}
SEISMIC = "Seismic image: Ricker wavelet of {frequency:g} Hz, neither migration nor noise. Black: the rock below is harder."
SEISMIC_MADE = ("The seismic image is reflectivity convolved with a Ricker wavelet of {frequency:g} Hz: velocity by porosity "
                "(Wyllie et al. 1956), weakened rock slower by 15 %, layers faster and slower by turns (5 %, assumed).")
FAULTS = ("strata", "strain", "behaviour", "underlay", "seismic-depth")


def shown_text(name: str, frame: Frame) -> str:
    for layer in frame.layers:
        if name == f"layer-{layer.name}":
            return layer.label
    return SHOWN.get(name, name).format(window=window_text(frame), remark=strain_remark(frame))


def caption(names: Sequence[str], said: Sequence[str | None] | None, frame: Frame, order: Order) -> str:
    """A paragraph on the panels of these names of one frame. The words for a panel end with its scale in
    brackets. Panels have letters in a figure for print only."""
    meta = frame.meta
    texts = [shown_text(name, frame) for name in names]
    if said:
        texts = [text + (f" {words[words.rindex('('):]}" if words and "(" in words else "") for text, words in zip(texts, said)]
    if order.width_mm and len(texts) > 1:
        texts = [f"({letter(n)}) {text}" for n, text in enumerate(texts)]
    panels = ("; " if order.width_mm else "; below it ").join(texts)
    if "underlay" in names:
        left, top, right, bottom = meta["underlay"]["corners_m"]
        panels += (f" ({os.path.basename(meta['underlay']['image'])}, x from {left:g} to {right:g} m, depth from "
                   f"{top:g} to {bottom:g} m)")
    mean_rate = meta.get("way_m", meta["extension_m"]) / meta["time_a"] if meta["time_a"] else 0.0
    rate = mean_rate and meta.get("extension_rate_m_per_a", mean_rate)  # the mean is lower where pauses go by steps
    at = f" at {100 * rate:.3g} cm/yr" if rate else ""
    parts = [f"{order.software} model: {without_source(str(meta.get('title') or meta['scene']))}.",
             f"After {moment_text(frame)}{at} ({time_text(frame)}): {panels}."]
    if any(name in FAULTS or name.startswith("layer-") for name in names) and frame.faults is not None and len(frame.faults):
        parts.append("Black lines: faults active since the previous snapshot, wider where they slip faster.")
    if frequency := frequency_of(names, frame):
        parts.append(SEISMIC.format(frequency=frequency))
    if "inversion" in names and (words := meta.get("said")):
        parts.append("; ".join(words).capitalize() + ".")
    return " ".join(parts)


def origin(names: Sequence[str], frame: Frame, order: Order) -> str:
    """How a figure of these panels was made, and the errors of the run's results."""
    meta, frequency = frame.meta, frequency_of(names, frame)
    parts = [f"{order.software} model of scene {meta['scene']}: {len(frame.x):,} discs, mean radius "
             f"{meta.get('mean_radius_m', 1000 * frame.radius.mean()):.3g} m, accuracy {meta.get('accuracy', 'custom')}, "
             f"seed {meta.get('seed', '?')}.", SEISMIC_MADE.format(frequency=frequency) if frequency else "", order.errors, provenance_text(order)]
    return " ".join(filter(None, parts))


def frequency_of(names: Sequence[str], frame: Frame) -> float | None:
    """Frequency of the wavelet of a seismic image among these panels, Hz."""
    for name, axes in (("seismic", frame.seismic_axes), ("seismic-depth", frame.seismic_depth_axes)):
        if name in names and axes is not None:
            return axes[3]
    return None


def provenance_text(order: Order) -> str:
    if not order.provenance:
        return ""
    words = json.loads(order.provenance)
    known = [f"{key.replace('_', ' ')} {words[key]}" for key in ("commit", "scene_hash") if words.get(key)]
    return f"Made by {', '.join(known)}." if known else ""


def write_captions(captions: dict[str, str], folder: str, name: str = "caption.txt") -> None:
    """A paragraph per figure, by the names of their files. Those of other calls stay as long as their figures do."""
    path = os.path.join(folder, name)
    there = {os.path.splitext(name)[0] for name in os.listdir(folder)}
    others = {name: text for name, text in read_captions(path).items() if name in there and name not in captions}
    temporary = f"{path}.{os.getpid()}.tmp"
    with open(temporary, "w", encoding="utf-8") as file:
        file.write("\n".join(f"{name}\n{text}\n" for name, text in {**captions, **others}.items()))
    os.replace(temporary, path)


def read_captions(path: str) -> dict[str, str]:
    """Paragraphs of a caption.txt by the names of their figures; of what is none, nothing."""
    try:
        with open(path, encoding="utf-8") as file:
            parts = (part.strip("\n").split("\n", 1) for part in file.read().split("\n\n"))
    except (OSError, ValueError):
        return {}
    return {part[0]: part[1] for part in parts if len(part) == 2}
