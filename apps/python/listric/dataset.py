"""Sections of `listric dataset`, with their faults."""

import csv
import hashlib
import json
from pathlib import Path

import numpy as np

from .errors import BadValue, RunError, UnknownName, reading
from .snapshot import h5py  # which says what to install where it is missing

FAULT_LABELS = ("none", "active", "resting", "detachment", "doubtful")


class Dataset:
    """Sections of one split, each an (image, mask) of arrays: a row per trace, a column per sample.

    It has `len()` and takes indices, which is all that torch.utils.data.DataLoader asks for.

    split      "train", "validation" or "test"; None: all
    labels     labels that count as fault in the mask, of FAULT_LABELS
    transform  function of image and mask, whose result is handed out in their place
    index      list of dicts, the rows of index.csv that the sections are of
    licence    of the data set
    """

    def __init__(self, folder, split="train", labels=("active", "resting"), transform=None):
        self.folder = Path(folder)
        if not (self.folder / "dataset.json").exists():
            raise RunError(f"{self.folder}: is no data set, or not made to its end: listric dataset PLAN "
                           f"--output {self.folder}")
        with reading(self.folder / "dataset.json", "make it again"):
            about = json.loads((self.folder / "dataset.json").read_text(encoding="utf-8"))
            splits, self.licence = list(about["splits"]), about["licence"]
            self._arrays = list(about["arrays"])
        if split is not None and split not in splits:
            raise UnknownName(split, splits, f"{self.folder}: splits")
        for label in labels:
            if label not in FAULT_LABELS:
                raise UnknownName(label, FAULT_LABELS, f"{self.folder}: labels of faults")
        self._labels = [FAULT_LABELS.index(label) for label in labels]
        self._transform = transform
        with reading(self.folder / "index.csv"), open(self.folder / "index.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["file"]]
        self.index = [row for row in rows if split in (None, row["split"])]

    def __len__(self):
        return len(self.index)

    def __getitem__(self, number):
        arrays = self.section(number, "image", "fault")
        pair = arrays["image"], np.isin(arrays["fault"], self._labels).astype(np.uint8)
        return pair if self._transform is None else self._transform(*pair)

    def section(self, number, *names) -> dict:
        """Arrays of a section by name, without names all: image, fault, fault_throw, layer, strain, reflectivity."""
        path = self._path(number)
        with reading(path, "make it again"), h5py.File(path, "r") as file:
            for name in names:
                if name not in self._arrays:
                    raise UnknownName(name, self._arrays, str(path))
            return {name: file[name][:] for name in names or self._arrays}

    def numbers(self, number) -> dict:
        """How a section was made, and its axes: first_x_m, trace_spacing_m, first_sample_s, frequency_hz, ..."""
        path = self._path(number)
        with reading(path, "make it again"), h5py.File(path, "r") as file:
            return {name: float(value) for name, value in file.attrs.items() if name not in ("sha256", "made_of")}

    def verify(self):
        """Compares the arrays of every section with the index. Throws RunError."""
        for number, row in enumerate(self.index):
            digest = hashlib.sha256()
            for values in self.section(number).values():
                digest.update(np.ascontiguousarray(values).tobytes())
            if digest.hexdigest() != row["sha256"]:
                raise RunError(f"{self._path(number)}: is not what index.csv says of it (sha256): get it again")

    def _path(self, number) -> Path:
        try:
            return self.folder / self.index[number]["file"]
        except TypeError:
            raise BadValue(f"section {number!r}: give a number from 0 to {len(self) - 1}") from None

    def __repr__(self):
        return f"<{self.folder}: {len(self)} sections>"
