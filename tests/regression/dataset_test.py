"""`listric dataset`: equal bits on a second making, masks where rock has come apart, splits by shape, the Python loader.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest dataset_test
"""

import csv
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from program import NO_FIGURES, PROGRAM, SOURCES, listric

sys.path.insert(0, str(SOURCES / "apps/python"))
os.environ["LISTRIC_PROGRAM"] = str(PROGRAM)
import listric as reader  # noqa: E402

SHALLOW = "hanging_wall.thickness_m=5000"
WIDTH = 3.0  # of a line in the mask, samples
DISC = 220.0
# Samples by depth, as discs have; every fault is marked, however small its throw.
PLAN = f"""scene = "lis1"
accuracy = "draft"
set = "hanging_wall.length_m=14000 hanging_wall.mean_radius_m=110 extension.distance_m=1000"
measures = ["strain_top10"]
[dataset]
split_by = "shape"
test = "steep"
in_depth = true
traces = 256
samples = 256
trace_spacing_m = 50
sample_interval_m = 25
fault_width_samples = {WIDTH}
least_throw_m = 0
least_height_m = 0
[[vary]]
parameter = "shape"
values = ["steep", "gentle"]
sets = [
    "{SHALLOW} detachment={{start_dip_deg=90, segments=[{{arc={{radius_m=5000}}}}, {{line={{length_m=30000}}}}]}}",
    "{SHALLOW} detachment={{start_dip_deg=60, segments=[{{arc={{radius_m=10000}}}}, {{line={{length_m=30000}}}}]}}",
]
"""


def rows_of(folder):
    with open(folder / "index.csv", newline="") as file:
        return list(csv.DictReader(file))


class DatasetOfTwoRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "tiny.toml").write_text(PLAN)
        cls.made = cls.make("made")
        assert cls.made.returncode == 0, cls.made.stdout

    @classmethod
    def make(cls, name, *words):
        return listric("dataset", cls.folder / "tiny.toml", "--runs", cls.folder / "runs", "--threads", "1",
                       "--jobs", "1", "--output", cls.folder / name, *words, env=os.environ | NO_FIGURES)

    def test_splits_are_by_shape_and_a_second_making_has_the_same_bits(self):
        rows = rows_of(self.folder / "made")
        self.assertEqual([(row["shape"], row["split"], row["outcome"]) for row in rows],
                         [("steep", "test", "finished"), ("gentle", "train", "finished")])
        self.assertNotEqual(rows[0]["frequency_hz"], rows[1]["frequency_hz"])
        self.assertEqual(self.make("again", "--so-far").returncode, 0)
        for file in sorted((self.folder / "made").rglob("*.*")):
            again = self.folder / "again" / file.relative_to(self.folder / "made")
            self.assertEqual(file.read_bytes(), again.read_bytes(), file.name)
        card = (self.folder / "made/README.md").read_text()
        for said in ("Licence: CC BY 4.0", "What is wrong with it", "| test | 1 |", "`shape`"):
            self.assertIn(said, card)

    def test_a_section_is_made_again_where_it_is_damaged_and_only_there(self):
        shutil.copytree(self.folder / "made", self.folder / "mended")
        damaged, whole = sorted((self.folder / "mended/sections").iterdir())
        right, age = damaged.read_bytes(), whole.stat().st_mtime_ns
        damaged.write_bytes(right[:1000])
        self.assertEqual(self.make("mended", "--so-far").returncode, 0)
        self.assertEqual(damaged.read_bytes(), right)
        self.assertEqual(whole.stat().st_mtime_ns, age)

    def test_runs_that_are_missing_are_told(self):
        lacking = self.folder / "lacking"
        shutil.copytree(self.folder / "runs/runs/0001-seed=1", lacking / "runs/0001-seed=1")
        ended = listric("dataset", self.folder / "tiny.toml", "--runs", lacking, "--output", self.folder / "part",
                        "--so-far")
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertIn("1 sections; 1 runs have none", ended.stdout)
        self.assertEqual([row["outcome"] for row in rows_of(self.folder / "part")], ["finished", "not yet"])
        self.assertEqual(len(reader.Dataset(self.folder / "part", split=None)), 1)

    def test_rock_has_come_apart_beside_the_mask(self):
        data = reader.Dataset(self.folder / "made", split=None)
        ratios = []
        for number, row in enumerate(data.index):
            axes, arrays = data.numbers(number), data.section(number)
            discs = reader.Run(self.folder / "runs/runs" / row["section"]).snapshots[-1].discs
            old = discs["stratum"] == 0
            x, y = discs["x"][old], discs["y"][old]
            rise = y - discs["start_y"][old]
            for trace, sample in np.argwhere(np.isin(arrays["fault"], (1, 2))):
                away = x - (axes["first_x_m"] + trace * axes["trace_spacing_m"])
                level = np.abs(y + axes["first_sample_m"] + sample * axes["sample_interval_m"]) < 1.5 * DISC
                left, right = (rise[level & (side * away > DISC) & (side * away < 4 * DISC)] for side in (-1, 1))
                if min(len(left), len(right)) > 5 and arrays["fault_throw"][trace, sample] != 0.0:
                    step = abs(np.median(left) - np.median(right))
                    ratios.append(step / abs(arrays["fault_throw"][trace, sample]))
        self.assertGreater(len(ratios), 50)
        # Blocks tilt, so that medians so far apart differ by more or less than the offset does.
        self.assertTrue(0.6 < np.median(ratios) < 1.7, np.percentile(ratios, (5, 25, 50, 75, 95)))
        self.assertGreater(np.mean(np.array(ratios) > 0.4), 0.8)

    def test_the_loader_hands_out_pairs_of_one_split(self):
        data = reader.Dataset(self.folder / "made", "train")
        self.assertEqual(len(data), 1)
        [(image, mask)] = list(data)  # as DataLoader does, by numbers up to IndexError
        self.assertEqual((image.shape, image.dtype, mask.dtype), ((256, 256), np.float32, np.uint8))
        arrays = data.section(0)
        self.assertEqual(list(arrays), ["image", "fault", "fault_throw", "layer", "strain", "reflectivity"])
        np.testing.assert_array_equal(mask, np.isin(arrays["fault"], (1, 2)))
        floor = reader.Dataset(self.folder / "made", "train", labels=("detachment",))[0][1]
        np.testing.assert_array_equal(floor, arrays["fault"] == 3)
        # Below the detachment there is no layer, and above it there is one.
        below = arrays["layer"] == -32768
        self.assertTrue(0.05 < below.mean() < 0.6)
        self.assertTrue(np.isnan(arrays["strain"][below]).mean() > 0.95)
        doubled = reader.Dataset(self.folder / "made", "train", transform=lambda image, mask: (2 * image, mask))
        np.testing.assert_array_equal(doubled[0][0], 2 * image)
        data.verify()
        data.index[0]["sha256"] = "0" * 64
        with self.assertRaisesRegex(reader.RunError, "sha256"):
            data.verify()
        with self.assertRaisesRegex(reader.UnknownName, "did you mean test"):
            reader.Dataset(self.folder / "made", "tests")
        with self.assertRaisesRegex(reader.RunError, "listric dataset PLAN"):
            reader.Dataset(self.folder)

    def test_calls_that_cannot_be_are_refused(self):
        ended = listric("dataset", self.folder / "no.toml")
        self.assertEqual(ended.returncode, 2)
        (self.folder / "sweep.toml").write_text(PLAN[:PLAN.index("[dataset]")] + PLAN[PLAN.index("[[vary]]"):])
        ended = listric("dataset", self.folder / "sweep.toml")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("needs [dataset]", ended.stdout)
        ended = listric("dataset", self.folder / "tiny.toml", "--so-far",
                        "--output", self.folder / "runs/runs/0001-seed=1")
        self.assertEqual(ended.returncode, 2)  # the folder of a run


if __name__ == "__main__":
    unittest.main()
