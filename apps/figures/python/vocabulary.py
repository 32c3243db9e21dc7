"""Vocabulary of all painters, ../vocabulary.json: classes of rock, colours, palettes, scales, layers."""
import json
import os

from script import MISTAKE, end, library

np = library("numpy")
library("matplotlib")
from matplotlib.colors import to_rgb


def read() -> dict:
    path = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../vocabulary.json")
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as failure:
        end(MISTAKE, f"{path}: {failure}; install Listric again")


VOCABULARY = read()
INKS = {name: layer["ink"] for name, layer in VOCABULARY["layers"].items() if "ink" in layer}
LAYER_COLOURS = VOCABULARY["pre_rift"]["colours"]     # of pre-rift rock by depth, in turn
LAYER = VOCABULARY["pre_rift"]["layer_m"] / 1000.0    # km
BED_COLOURS = VOCABULARY["rock_layers"]["colours"]    # of layers of rock, in turn
# Classes of rock behaviour in their order [paper, Figs. 5, 9b].
ROCK_CLASSES = VOCABULARY["rock_classes"]


def palette(name: str) -> np.ndarray:
    """256 colours (n x 3)."""
    rows = bytes.fromhex(VOCABULARY["palettes"][name]["rows"])
    return np.frombuffer(rows, np.uint8).reshape(-1, 3) / 255.0


def layer_colours(start_depth: np.ndarray) -> np.ndarray:
    """Colours (n x 3) of pre-rift rock from such depths (km) in layers, by turns."""
    depth = np.nan_to_num(start_depth, nan=0.0, posinf=0.0, neginf=0.0)
    return np.array([to_rgb(c) for c in LAYER_COLOURS])[
        np.floor(np.maximum(depth, 0.0) / LAYER).astype(int) % 2]


def stratum_colours(count: int) -> np.ndarray:
    """One colour per stratum, old (dark) to young; every second slightly lighter."""
    words = VOCABULARY["strata"]
    places = np.linspace(0.0, 255.0, max(count, 2))[:count]
    colours = palette(words["palette"])[np.floor(places + 0.5).astype(int)]
    if count >= words["lighter_from"]:
        colours[1::2] += words["lighter"] * (1.0 - colours[1::2])
    return colours
