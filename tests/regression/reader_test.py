"""The Python package against h5py, the program's own words, and damage.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest reader_test
"""

import copy
import json
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest
import warnings
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
from program import PROGRAM, SOURCES

os.environ["LISTRIC_PROGRAM"] = str(PROGRAM)

sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCES / "apps/python"))
import listric
from listric import dictionary
from listric.snapshot import FORMAT

# 565 discs, sediment of two events, a base that moves as prescribed: every table but of events.
SCENE = """
[hanging_wall]
length_m = 4000.0
thickness_m = 1500.0
mean_radius_m = 50.0
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 6000.0}}]
[extension]
distance_m = 400.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 200.0
[gravity]
[bonds]
[bond_healing]
[sedimentation]
interval_a = 20000.0
[base_motion]
uplift = [[0, 0], [4000, 10]]
"""
# Its sediment holds water.
MUD = SCENE.partition("[base_motion]")[0].replace("interval_a = 20000.0", "interval_a = 20000.0\n[compaction]\n[pore_fluid]")


def tables_of(file):
    """Paths of the groups that are tables."""
    found = []
    file.visititems(lambda path, item: found.append(path) if "rows" in item.attrs else None)
    return found


def made_run(folder, text=SCENE):
    """A run of the scene above, in folder/run."""
    Path(folder, "scene.toml").write_text(text)
    before = {name: os.environ.get(name) for name in ("LISTRIC_PYTHON", "XDG_CACHE_HOME")}
    os.environ |= {"LISTRIC_PYTHON": "/bin/false", "XDG_CACHE_HOME": f"{folder}/cache"}
    try:
        return listric.simulate(Path(folder, "scene.toml"), set={"bond_healing.interval_a": 5000},
                                seed=3, threads=1, output=Path(folder, "run"))
    finally:
        for name, value in before.items():
            os.environ.pop(name, None) if value is None else os.environ.update({name: value})


class Reader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="listric-reader-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        made_run(cls.folder)

    def setUp(self):
        self.run_ = listric.Run(self.folder / "run")

    def copy(self):
        """The run in another folder, to be damaged."""
        place = Path(tempfile.mkdtemp(dir=self.folder))
        shutil.copytree(self.folder / "run", place / "run")
        return place / "run"

    @contextmanager
    def fails(self, error, *words):
        """A context in which this error is thrown, with these words in its one line."""
        with self.assertRaises(error) as caught:
            yield caught
        for word in words:
            self.assertIn(str(word), str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_columns_are_those_of_hdf5(self):
        self.assertEqual(len(self.run_.snapshots), 3)
        tables = set()
        for snapshot in self.run_.snapshots:
            with h5py.File(snapshot.path) as file:
                for path in tables_of(file):
                    read = snapshot.table(path)
                    self.assertEqual(read.rows, file[path].attrs["rows"])
                    self.assertEqual(set(read), set(file[path]))
                    for name in read:
                        stored = file[path][name]
                        self.assertEqual(read[name].dtype, stored.dtype)
                        self.assertEqual(read[name].tobytes(), stored[()].tobytes(), stored)
                        unit = stored.attrs["unit"].decode()
                        self.assertEqual(read[name].units, unit or dictionary.unit_of(name))
                    tables.add(path)
                for name in ("discs", "contacts", "base_contacts", "base_nodes"):
                    self.assertEqual(list(getattr(snapshot, name)), list(snapshot.table(name)))
                self.assertEqual(snapshot.numbers["seed"], 3)
                self.assertEqual(snapshot.extension_m, file.attrs["extension"])
        self.assertLess({"discs", "contacts", "base_contacts", "base_nodes", "run/history"}, tables)

    def test_columns_keep_units_and_results_have_none(self):
        x = self.run_.snapshots[-1].discs["x"]
        self.assertEqual((x.units, x[2:5].units, x.copy().units), ("m", "m", "m"))
        for result in (x * x, x + 1.0, -x, x > 0.0):
            self.assertIs(type(result), np.ndarray)
        x += 1.0  # a column of one's own
        self.assertEqual((x - 1.0).tolist(),
                         ((self.run_.snapshots[-1].discs["x"] + 1.0) - 1.0).tolist())

    def test_history_is_that_of_the_last_snapshot(self):
        history, stored = self.run_.history, self.run_.snapshots[-1].table("run/history")
        self.assertEqual(history.rows, 3)
        self.assertEqual(list(history), list(stored))
        for name in history:
            np.testing.assert_array_equal(history[name], stored[name], name)  # NaN equals NaN
        self.assertEqual(history["cycle"].dtype, np.int64)
        history["extension_m"][:] = -1.0  # nobody else's
        self.assertEqual(history["extension_m"][0], 0.0)

    def test_units_and_definitions_are_the_dictionarys(self):
        history = self.run_.history
        for name in history:
            entry = dictionary.dictionary()[name]
            self.assertEqual(history[name].units, entry["unit"], name)
            self.assertEqual(history[name].doc, entry["doc"], name)
        x = history["area_balance"]
        self.assertEqual((x.units, x[1:].doc, (2.0 * x).__class__), ("1", x.doc, np.ndarray))
        self.assertIsNone(dictionary.unit_of("lithology_m"))  # nothing is guessed
        self.assertEqual(dictionary.unit_of("antithetic_turn_deg"), "deg")
        self.assertEqual(dictionary.unit_of("dip_at_birth_deg"), "deg")

    def test_snapshots_have_the_history_s_units(self):
        with h5py.File(self.run_.snapshots[-1].path) as file:
            for name, values in file["run/history"].items():
                self.assertEqual(values.attrs["unit"].decode(), dictionary.unit_of(name), name)

    def test_what_the_run_says_is_declared(self):
        declared = dictionary.dictionary()
        self.assertEqual([name for name in self.run_.summary if name not in declared], [])
        for fault in self.run_.summary["faults"]:
            self.assertEqual([name for name in fault if name not in declared], [])

    def test_pandas(self):
        import pandas
        frame = self.run_.snapshots[0].discs.to_pandas()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame.x.tolist(), self.run_.snapshots[0].discs["x"].tolist())

    def test_nothing_is_read_before_it_is_asked_for(self):
        folder = self.copy()
        run = listric.Run(folder)
        table_before = run.snapshots[1].discs
        for file in (folder / "snapshots").iterdir():
            file.unlink()
        (folder / "summary.json").unlink()
        (folder / "history.csv").write_text("")
        for read in (lambda: run.snapshots[2].discs, lambda: table_before["x"]):
            with self.fails(listric.RunError, folder / "snapshots", "is not there", "open"):
                read()
        with self.fails(listric.RunError, folder / "summary.json", "--resume"):
            run.summary
        with self.fails(listric.RunError, folder / "history.csv"):
            run.history

    def test_summary_and_scene(self):
        told = json.loads((self.folder / "run/summary.json").read_text())
        self.assertEqual(self.run_.summary, told)
        self.assertEqual(self.run_.scene["hanging_wall"]["mean_radius_m"], 50.0)
        self.assertEqual(self.run_.scene["bond_healing"]["interval_a"], 5000.0)  # as told
        with self.fails(listric.UnknownName, "summary.json", "did you mean", "extension_m"):
            self.run_.summary["extention_m"]
        with self.fails(KeyError, "scene.toml [hanging_wall]", "length_m"):
            self.run_.scene["hanging_wall"]["lenght_m"]

    def test_faults_are_those_of_the_summary(self):
        # So small a run has none: those of the documents' example.
        folder = self.copy()
        told = json.loads((folder / "summary.json").read_text())
        told["faults"] = [{"dip_deg": 60.5, "throw_m": {"0": 12.25, "3": -1.5},
                           "points_m": [[1000.0, 100.0], [1050.0, 190.0], [1100.0, 280.0]]},
                          {"dip_deg": 45.0, "throw_m": {}, "points_m": []}]
        (folder / "summary.json").write_text(json.dumps(told))
        faults = listric.Run(folder).faults
        again = [{**fault, "points_m": fault["points_m"].tolist(),
                  "throw_m": {str(key): value for key, value in fault["throw_m"].items()}}
                 for fault in faults]
        self.assertEqual(again, told["faults"])
        self.assertEqual(faults[0]["points_m"].shape, (3, 2))
        self.assertEqual(faults[0]["throw_m"][3], -1.5)
        self.assertEqual(faults[1]["points_m"].shape, (0, 2))
        self.assertEqual(self.run_.faults, self.run_.summary["faults"])  # of the run itself: none

    def test_horizons_are_those_of_the_export(self):
        folder = self.copy()
        run = listric.Run(folder)
        from_program = run.horizons
        self.assertFalse((folder / "export").exists())  # asking leaves nothing behind
        listric.call("export", "horizons", folder, "--format", "csv,geojson")
        exported = sorted((folder / "export").glob("*.geojson"))[-1]
        features = json.loads(exported.read_text())["features"]
        self.assertGreater(len(features), 2)
        for lines in (from_program, listric.Run(folder).horizons):
            self.assertEqual(len(lines), len(features))
            for line, feature in zip(lines, features):
                places = np.array(feature["geometry"]["coordinates"])
                np.testing.assert_array_equal(line["x_m"], places[:, 0])
                np.testing.assert_array_equal(line["depth_m"], -places[:, 1])
                for name in ("name", "stratum"):
                    self.assertEqual(line[name], feature["properties"][name])
        # What is in the folder is taken as long as it is not older than the snapshot.
        file = exported.with_suffix(".csv")
        header = file.read_text().splitlines()[0]
        file.write_text(f"{header}\n0,alone,1,,,original surface,5,6\n")
        self.assertEqual([line["name"] for line in listric.Run(folder).horizons], ["alone"])
        os.utime(folder / "snapshots/extension-00000.00m.h5")   # of which the past of faults is made
        self.assertEqual(len(listric.Run(folder).horizons), len(features))
        self.assertIn("alone", file.read_text())  # the program has written elsewhere

    def test_pictures_are_those_of_the_figures(self):
        folder = self.copy()
        kept = sorted(folder.rglob("*"))
        first = listric.Run(folder).plot("strain", at=90.0)
        self.assertEqual(sorted(folder.rglob("*")), kept)  # asking leaves nothing behind
        listric.call("figures", folder, "--at", "90m")
        drawn, = (folder / "figures").glob("strain-*.png")
        self.assertEqual(first._repr_png_(), drawn.read_bytes())
        with self.fails(listric.UnknownName, "did you mean strain"):
            self.run_.plot("strian")
        with self.fails(listric.UnknownName, "extension-00000.00m.h5 at 0 m", "no kinematics", "strata"):
            self.run_.plot("kinematics", at=0)
        # A snapshot alone, as another program saves it.
        alone = shutil.copy(self.run_.snapshots[-1].path, folder / "saved.h5")
        listric.Snapshot(alone).plot().save(folder / "saved.png")
        self.assertTrue((folder / "saved.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("detachment", {line["name"] for line in listric.Snapshot(alone).lines("surfaces")})

    def test_notebooks_show_names_with_units(self):
        self.assertIn("<td style=\"text-align: left\">rollover_tilt_deg</td>", self.run_._repr_html_())
        self.assertRegex(self.run_.snapshots[-1].discs._repr_html_(), r"<td[^>]*>x</td><td[^>]*>m</td>")

    def test_notebooks_show_the_end_of_a_run_that_ends_between_two_rows(self):
        folder = self.copy()
        rows = (folder / "history.csv").read_text().splitlines(keepends=True)
        (folder / "history.csv").write_text("".join(rows[:2]))      # as of an interval longer than the run
        run = listric.Run(folder)

        def shown():
            return re.search(r"<td[^>]*>basin_area_m2</td><td[^>]*>([^<]*)</td><td[^>]*>m2</td>", run._repr_html_())[1]

        self.assertGreater(run.summary["basin_area_m2"], 0.0)
        self.assertEqual(shown(), f"{run.summary['basin_area_m2']:.6g}")
        (folder / "summary.json").unlink()                          # it goes on
        self.assertEqual(shown(), f"{run.history['basin_area_m2'][-1]:.6g}")

    def test_lines_of_other_kinds_and_moments(self):
        first = self.run_.at(90.0)
        self.assertEqual(first.path, self.run_.snapshots[0].path)
        surfaces = {line["name"]: line for line in first.lines("surfaces")}
        self.assertLess({"detachment", "original surface", "free surface"}, set(surfaces))
        self.assertGreater(surfaces["detachment"]["depth_m"].max(), 1400.0)
        self.assertEqual(self.run_.at(400.0).lines("base")[0]["start_x_m"].tolist(),
                         self.run_.snapshots[-1].base_nodes["x"].tolist())
        with self.fails(listric.ProgramError, "horizon", "did you mean"):
            first.lines("horizon")

    def test_lines_of_wells(self):
        place = Path(tempfile.mkdtemp(dir=self.folder))
        run = made_run(place, MUD)
        wells = run.snapshots[-1].lines("well")   # beside which the program writes their burial
        self.assertEqual(wells[0]["name"], "depocentre")
        self.assertEqual(wells[0]["pressure_pa"].shape, wells[0]["depth_m"].shape)
        listric.call("export", "well", run.folder)
        self.assertEqual([line["name"] for line in listric.Run(run.folder).snapshots[-1].lines("well")],
                         [line["name"] for line in wells])
        strata = run.snapshots[-1].lines("burial")
        self.assertEqual([line["stratum"] for line in strata if line["name"] == "depocentre"], [1, 2])
        self.assertEqual(strata[0]["thickness_m"].shape, strata[0]["x_m"].shape)

    def test_lines_are_those_of_no_other_call(self):
        folder = self.copy()

        def names():
            return [str(line["name"]) for line in listric.Run(folder).snapshots[-1].lines("burial")]

        before = names()
        self.assertEqual(before[0], "depocentre")
        for words in (("--x", "1km"), ("--x", "1km,1500m"), ("--at", "200m")):
            listric.call("export", "well", folder, *words)
            self.assertEqual(names(), before)
        listric.call("export", "well", folder)
        self.assertEqual(names(), before)
        # An earlier version wrote other places under this name, and told no depth reference.
        old = folder / "export" / f"burial-{listric.Run(folder).snapshots[-1].path.stem}.csv"
        text = (folder / "export" / f"{old.stem}-x-1000m.csv").read_text()
        old.write_text(text.replace("depth_reference,", "").replace("original surface,", ""))
        self.assertEqual(names(), before)
        snapshot = listric.Run(folder).snapshots[-1]
        snapshot.lines("surfaces")[0]["depth_m"][:] = -1.0   # of the caller alone
        self.assertGreater(snapshot.lines("surfaces")[0]["depth_m"].max(), 1400.0)

    def test_a_moment_without_a_kind_of_lines_says_what_there_is(self):
        last = self.run_.snapshots[-1]      # its sediment has no water
        with self.fails(listric.UnknownName, last.path, "m: no well; there are burial"):
            last.lines("well")
        self.assertGreater(len(last.lines("burial")), 0)
        with self.fails(listric.ProgramError, "no sediment to drill"):
            self.run_.snapshots[0].lines("well")

    def test_rows_that_are_too_short_or_too_long(self):
        folder = self.copy()
        whole = (folder / "history.csv").read_text()
        head = whole.splitlines()[0]
        fields = head.count(",") + 1
        for text in (whole + "400.0,", whole + whole.splitlines()[-1] + ",1\n", whole + "\n"):
            (folder / "history.csv").write_text(text)
            with self.fails(listric.RunError, folder / "history.csv", "line 5 has", f"fields, the head {fields}"):
                listric.Run(folder).history
        for cell in ("9" * 30, "9" * 200_000):   # more than an integer, and than a field, may have
            (folder / "history.csv").write_text(f"{head}\n0,{cell}{',' * (fields - 2)}\n")
            with self.fails(listric.RunError, folder / "history.csv"):
                listric.Run(folder).history

    def test_cells_in_quotes(self):
        folder = self.copy()
        listric.call("export", "horizons", folder)
        file = sorted((folder / "export").glob("*.csv"))[-1]
        head = file.read_text().splitlines()[0]
        file.write_text(f'{head}\n0,"salt, ""upper""\nand lower",1,,,original surface,5,6\n')
        self.assertEqual([line["name"] for line in listric.Run(folder).horizons], ['salt, "upper"\nand lower'])
        for lacks in ("line", "x_m"):
            file.write_text(f"{head.replace(lacks, 'other')}\n0,salt,1,,,original surface,5,6\n")
            with self.fails(listric.RunError, file, f"has no column {lacks}"):
                listric.Run(folder).horizons

    def test_errors_pass_between_processes(self):
        for error in (listric.ListricError("a"), listric.RunError("a: is not there"), listric.ProgramError("failed", 3),
                      listric.UnknownName("radios", ["radius", "x"], "file discs")):
            again = pickle.loads(pickle.dumps(error))
            self.assertIs(type(again), type(error))
            self.assertEqual((str(again), getattr(again, "code", 0)), (str(error), getattr(error, "code", 0)))
            self.assertEqual(str(copy.copy(error)), str(error))
        scene = pickle.loads(pickle.dumps(self.run_.scene))
        with self.fails(listric.UnknownName, "scene.toml [hanging_wall]", "length_m"):
            scene["hanging_wall"]["lenght_m"]

    def test_raster_has_the_disc_of_the_nearest_power_cell(self):
        snapshot = self.run_.snapshots[-1]
        discs = snapshot.discs
        centre_x, centre_depth, radius = discs["x"], -discs["y"], discs["radius"]
        for spacing in 23.0, 400.0:  # of the second, several discs have their middles in every cell
            x, depth, values = snapshot.raster("id", spacing)
            self.assertEqual(values.shape, (len(depth), len(x)))
            self.assertEqual((x.units, depth.units, values.units), ("m", "m", "1"))
            self.assertTrue((np.diff(depth) > 0).all())
            square = (x[None, :, None] - centre_x) ** 2 + (depth[:, None, None] - centre_depth) ** 2
            is_near = square <= (radius + 0.5 * snapshot.numbers["mean_radius"]) ** 2
            power = np.where(is_near, square - radius ** 2, np.inf)
            expected = np.where(is_near.any(axis=2), discs["id"][power.argmin(axis=2)], np.nan)
            np.testing.assert_array_equal(values, expected)
            self.assertGreater(np.isnan(values).mean(), 0.05)
        values = snapshot.raster("id", spacing=23.0).values
        self.assertGreater(len(np.unique(values[~np.isnan(values)])), 0.95 * discs.rows)

    def test_raster_of_an_extent(self):
        snapshot = self.run_.snapshots[-1]
        fine = snapshot.raster("start_x", spacing=40.0)
        part = snapshot.raster("start_x", spacing=40.0, extent=(1000.0, 2000.0, 400.0, 1000.0))
        self.assertEqual(part.values.shape, (15, 25))
        inside = np.ix_(np.isin(fine.depth, part.depth), np.isin(fine.x, part.x))
        np.testing.assert_array_equal(part.values, fine.values[inside])
        for values in {"spacing": 0.0}, {"spacing": 1e-3}, {"spacing": "1km"}, {"extent": (0, 1)}, {"extent": 5}:
            with self.assertRaisesRegex(listric.ListricError, next(iter(values))):
                snapshot.raster("id", **values)

    def test_a_history_of_another_run_is_told(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            listric.Run(self.folder / "run").history
        folder = self.copy()
        text = (folder / "history.csv").read_text()
        rows = text.splitlines(keepends=True)
        (folder / "history.csv").write_text("".join([*rows[:-1], rows[-1].replace("1", "2")]))
        with self.assertWarnsRegex(UserWarning, "history.csv: is of another run than the newest snapshot"):
            listric.Run(folder).history
        (folder / "history.csv").write_text("".join(rows[:-1]))
        with self.assertWarnsRegex(UserWarning, "history.csv: is older than the newest snapshot"):
            listric.Run(folder).history

    def test_a_moment_is_as_strict_as_in_calls(self):
        self.assertIs(self.run_.at("0.4km"), self.run_.at(400.0))
        for moment, said in ((99e3, "from 0 to 400 m"), ("99km", "from 0 to 400 m"), (-5.0, "no snapshot there"), (0.4, "0.4km"),
                             ("5", "with its unit"), ("5 miles", "with its unit"), (float("nan"), "no finite number"),
                             (None, "or a length with its unit"), ([1.0, 2.0], "no finite number")):
            with self.subTest(moment=moment), self.assertRaisesRegex(listric.BadValue, said):
                self.run_.at(moment)
        with self.assertWarnsRegex(UserWarning, "no snapshot at 90 m; the nearest is taken, at"):
            self.run_.at("90m")

    def test_the_documents_examples(self):
        text = (SOURCES / "docs/guides/python.md").read_text()
        text = text.replace("out/lis1", str(self.folder / "run")).replace("5000.0", "400.0")
        names = {}
        for block in re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)[:2]:
            exec(block, names)
        self.assertEqual(names["x"].units, "m")
        self.assertEqual(names["strain"].shape, names["depth"].shape + names["x"].shape)

    def test_snapshots_are_in_order(self):
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        (folder / "snapshots").mkdir()
        (folder / "scene.toml").touch()
        names = [f"extension-{name}m.h5"
                 for name in ("00000.00", "09999.98", "99500.00", "100000.01")]
        for name in [*reversed(names), "extension-00500.00m.h5.17.part"]:
            (folder / "snapshots" / name).touch()
        run = listric.Run(folder)
        self.assertEqual([snapshot.path.name for snapshot in run.snapshots], names)
        self.assertEqual(run.at(9000.0).named_extension_m, 9999.98)

    def test_a_folder_that_is_no_run(self):
        with self.fails(listric.RunError, "nowhere", "listric run"):
            listric.Run(self.folder / "nowhere")
        with self.fails(listric.RunError, "cache", "no scene.toml"):
            listric.Run(self.folder / "cache")
        folder = self.copy()
        shutil.rmtree(folder / "snapshots")
        with self.fails(listric.RunError, folder, "no snapshots"):
            listric.Run(folder).at(0.0)

    def test_a_damaged_snapshot(self):
        run = listric.Run(self.copy())
        cut, flipped, other = (snapshot.path for snapshot in run.snapshots)
        with open(cut, "r+b") as file:
            file.truncate(os.path.getsize(cut) // 2)
        bytes_ = bytearray(flipped.read_bytes())
        bytes_[:8] = b"nothdf5!"
        flipped.write_bytes(bytes_)
        with h5py.File(other, "r+") as file:  # which ends before the program's checksum
            file.attrs["format"] = np.bytes_(f"listric snapshot {FORMAT + 1}")
        with open(other, "ab") as file:
            file.write(b"listric checksum" + bytes(8))
        for snapshot, words in zip(run.snapshots, (("cut short",), ("is damaged",),
                                                   (f"format {FORMAT + 1}", f"to {FORMAT}"))):
            with self.fails(listric.RunError, snapshot.path, *words):
                snapshot.discs["x"]

    def test_damaged_texts_of_any_depth(self):
        folder = self.copy()
        deep = 5000
        for text in ("[" * deep + "]" * deep, "[1]", "7", '{"a": 1'):
            (folder / "summary.json").write_text(text)
            with self.fails(listric.RunError, folder / "summary.json", "is damaged"):
                listric.Run(folder).summary
        (folder / "scene.toml").write_text("a = " + "[" * deep + "]" * deep)
        (folder / "summary.json").unlink()
        (folder / "summary.json").mkdir()  # root may read everything, but no folder as a file
        with self.fails(listric.RunError, folder / "summary.json", "cannot be read: Is a directory"):
            listric.Run(folder).summary
        with self.fails(listric.RunError, folder / "scene.toml", "is damaged"):
            listric.Run(folder).scene

    def test_unknown_names(self):
        snapshot = self.run_.snapshots[0]
        with self.fails(listric.UnknownName, snapshot.path, "no radios", "did you mean radius"):
            snapshot.discs["radios"]
        with self.fails(listric.UnknownName, snapshot.path, "no disc;", "discs"):
            snapshot.table("disc")
        with self.fails(listric.UnknownName, "history.csv", "basin_area_m2"):
            self.run_.history["basin_area"]
        self.assertIsNone(snapshot.discs.get("radios"))

    def test_a_failed_call(self):
        with self.fails(listric.ProgramError, "gravity", "exit code 2") as failure:
            listric.simulate("lis1", set={"gravty.acceleration_m_per_s2": 9.0},
                             output=self.folder / "failed")
        self.assertEqual(failure.exception.code, 2)
        with self.fails(listric.ProgramError, "holds a finished run", "--force"):
            listric.simulate(self.folder / "scene.toml", output=self.folder / "run")

    def test_a_quiet_run_hides_no_warning_and_is_found_where_it_is_written(self):
        place = Path(tempfile.mkdtemp(dir=self.folder))
        program, scene = place / "listric", place / "own.toml"
        program.write_text('#!/bin/sh\nwhile [ "$1" != --output ]; do shift; done\nmkdir -p "$2"; touch "$2/scene.toml"\n'
                           'echo "progress" >&2; echo "listric: warning: $2: too fast" >&2\n')
        program.chmod(0o755)
        scene.write_text("[hanging_wall]\n")
        self.addCleanup(os.environ.update, LISTRIC_PROGRAM=str(PROGRAM))
        os.environ["LISTRIC_PROGRAM"] = str(program)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(place)
        for name, given, folder in ((None, {}, "own"), ("other", {}, "other"), ("other", {"name": "third"}, "third")):
            if name:
                scene.write_text(f'name = "{name}"\n')
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                self.assertEqual(listric.simulate(scene, set=given).folder, Path("out", folder))
            [warning] = said
            self.assertEqual(str(warning.message), f"out/{folder}: too fast")
            self.assertEqual(Path(warning.filename).name, Path(__file__).name)
        self.assertEqual(listric.simulate("lis1", quiet=False).folder, Path("out/lis1"))

    def test_the_program_is_found(self):
        self.assertEqual(listric.find_program(), PROGRAM)
        # As installed, on the PATH, and in the source tree, in this order.
        tree = Path(tempfile.mkdtemp(dir=self.folder))
        package = tree / "lib/python3/dist-packages/listric"
        shutil.copytree(SOURCES / "apps/python/listric", package)
        installed, on_path, launcher = (tree / name / "listric" for name in ("bin", "path", "lib"))
        for file in (installed, launcher, on_path):
            file.parent.mkdir(exist_ok=True)
            file.write_text("#!/bin/sh\necho nothing to see >&2\nkill -TERM $$\n")
            file.chmod(0o755)

        def found():
            environment = {"PYTHONPATH": str(package.parent), "PATH": str(on_path.parent)}
            call = [sys.executable, "-B", "-c", "import listric; print(listric.find_program())"]
            return subprocess.run(call, env=environment, text=True, capture_output=True)

        # The tree's package takes no program that lies where an installation has it.
        below = tree / "apps/checkout/apps/python"
        shutil.copytree(package, below / "listric")
        stray = tree / "apps/bin/listric"
        stray.parent.mkdir()
        shutil.copy(installed, stray)
        package = below / "listric"
        self.assertEqual(found().stdout.strip(), str(on_path))
        package = tree / "lib/python3/dist-packages/listric"
        for file in (installed, on_path, launcher):
            self.assertEqual(found().stdout.strip(), str(file), found().stderr)
            file.unlink()
        self.assertIn("LISTRIC_PROGRAM", found().stderr)
        self.addCleanup(os.environ.update, LISTRIC_PROGRAM=str(PROGRAM))
        os.environ["LISTRIC_PROGRAM"] = str(tree)
        with self.fails(listric.ProgramError, f"LISTRIC_PROGRAM: {tree}"):
            listric.call("scenes")

    def test_values_as_the_program_reads_them(self):
        from listric.program import _toml
        for value, text in ((9.81, "9.81"), (np.float64(5e3), "5000.0"), (np.int64(3), "3"),
                            (True, "true"), (np.bool_(False), "false"), ("mat18-b", "mat18-b"),
                            (np.arange(2), "[0, 1]"), ([1.0, "a"], '[1.0, "a"]'), ({}, "{}"),
                            ({"level_m": 0}, "{level_m = 0}")):
            self.assertEqual(_toml(value), text)
        every = "".join(map(chr, range(1, 256)))
        for value in ([{"name": 'a"b\\c', "note": every}], [Path('a "b"')], {'a "b".c': every, "": "é", "x-1": "\u2028"}):
            again = tomllib.loads(f"value = {_toml(value)}")["value"]
            self.assertEqual(again, [str(one) if isinstance(one, Path) else one for one in value] if isinstance(value, list) else value)

    def test_versions_agree(self):
        project = (SOURCES / "CMakeLists.txt").read_text()
        version = re.search(r"project\(listric VERSION ([\d.]+)", project).group(1)
        package = (SOURCES / "apps/python/pyproject.toml").read_text()
        self.assertIn(f'version = "{version}"', package)
        written = (SOURCES / "apps/archive/snapshot/snapshot.cpp").read_text()
        self.assertIn(f"constexpr int format = {FORMAT};", written)

    def test_cost_of_opening(self):
        """Printed, not judged: it is the machine's affair."""
        begun = time.perf_counter()
        run = listric.Run(self.folder / "run")
        opened = time.perf_counter()
        run.snapshots[-1].discs["x"]
        print(f"opening: {1e3 * (opened - begun):.2f} ms; a column: "
              f"{1e3 * (time.perf_counter() - opened):.1f} ms", file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
