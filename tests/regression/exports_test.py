"""What `listric export` writes of an inverted basin, whose rock stands a kilometre above the original surface, as other
programs read it: segyio, GDAL, pandas, h5py, gsd. Zero is where they say, and calls with other options write other files.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest exports_test
"""

import itertools
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import gsd.hoomd
import h5py
import numpy as np
import pandas
import segyio
from osgeo import ogr   # python3-gdal, of cmake/packages.sh: without it this fails, it is not skipped
from program import NO_FIGURES, listric

ogr.UseExceptions()

# 1,150 m of rock above the original surface, a flat detachment 8 km below it.
SCENE = """
[hanging_wall]
length_m = 20000.0
thickness_m = 8000.0
[detachment]
start_dip_deg = 90.0
segments = [ {arc = {radius_m = 8000.0, end_dip_deg = 0.0}}, {line = {length_m = 30000.0}} ]
footwall_top_m = 15000.0
[extension]
rate_m_per_a = 0.01
[[stage]]
distance_m = 2000.0
[[stage]]
pause_a = 50000.0
[[stage]]
distance_m = -1500.0
sedimentation = "none"
sediment_friction = 0.3
[gravity]
[bonds]
[fault_weakening]
[sedimentation]
[compaction]
"""
LEVEL = "original surface"
PLACES = (10000.0, 12500.0, 15000.0, 17500.0)   # where the detachment is flat


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "inverted.toml").write_text(SCENE)
        cls.run_folder = cls.folder / "run"
        ended = listric("run", cls.folder / "inverted.toml", "--accuracy", "draft", "--seed", "1", "--threads", "1", "--no-report",
                        "--quiet", "--output", cls.run_folder, env=os.environ | NO_FIGURES)
        assert ended.returncode == 0, ended.stdout

    def export(self, kind, *words):
        """Files that a call prints, all of which are there."""
        ended = listric("export", kind, self.run_folder, *words)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        files = [Path(line) for line in ended.stdout.splitlines() if not line.startswith("listric: warning")]
        self.assertTrue(files and all(file.is_file() for file in files), ended.stdout)
        return files

    def table(self, kind, *words):
        """The last moment's lines as pandas reads them."""
        return pandas.read_csv(self.export(kind, "--at", "4km", *words)[0])

    def strongest_reflections(self, file, after):
        """Samples of the strongest reflection at PLACES that comes after another sample: that of the detachment, where the next
        boundary above, 7 km deep at the start, is left out."""
        x = file.attributes(segyio.TraceField.CDP_X)[:] / 100.0
        found = []
        for place, first in zip(PLACES, after):
            trace = np.abs(file.trace[int(np.argmin(np.abs(x - place)))])
            found.append(file.samples[np.argmax(np.where(file.samples > first, trace, 0.0))])
        return np.array(found)

    def test_segyio_has_the_detachment_at_its_depth(self):
        surfaces, horizons = self.table("surfaces"), self.table("horizons")
        floor = surfaces[surfaces.name == "detachment"]
        highest = -horizons.depth_m.min()
        self.assertGreater(highest, 500.0)   # else nothing is tested
        for frequency in ("25", "13"):
            [path] = self.export("seismic", "--at", "4km", "--depth", "--frequency", frequency)
            with segyio.open(path, ignore_geometry=True) as file:
                self.assertLess(abs(file.samples[0] + highest), 20.0)   # whole metres; horizons end at faults
                self.assertEqual(file.samples[0], np.floor(file.samples[0]))
                # A weakened disc, 185 m in radius, may touch the detachment, and its reflection be a quarter of a wavelength off.
                depth = np.interp(PLACES, floor.x_m, floor.depth_m)
                np.testing.assert_allclose(self.strongest_reflections(file, 0.95 * depth), depth, atol=45.0)
                for field in (segyio.TraceField.ReceiverDatumElevation, segyio.TraceField.SourceDatumElevation):
                    self.assertEqual(set(file.attributes(field)[:]), {0})
                self.assertEqual(set(file.attributes(segyio.TraceField.ElevationScalar)[:]), {-100})
                ground = file.attributes(segyio.TraceField.ReceiverGroupElevation)[:] / 100.0
                self.assertLess(abs(ground.max() - highest), 20.0)
                np.testing.assert_array_equal(file.attributes(segyio.TraceField.SourceSurfaceElevation)[:] / 100.0, ground)
                text = bytes(file.text[0]).decode()
                self.assertIn("DATUM, ELEVATION 0: THE ORIGINAL SURFACE, Y = 0", text)
                self.assertIn(f"FIRST SAMPLE AT A DEPTH OF {file.samples[0]:.0f} M (BYTES 109-110)", text)

    def test_segyio_has_the_detachment_at_its_time(self):
        [path] = self.export("seismic", "--at", "4km")
        with segyio.open(path, ignore_geometry=True) as file:
            self.assertLess(file.samples[0], -200.0)
            self.assertIn(f"FIRST SAMPLE AT {file.samples[0]:.0f} MS (BYTES 109-110) FROM THE DATUM", bytes(file.text[0]).decode())
        # Two-way time from the original surface through the discs of a column, by the laws of docs/guides/export.md: a mean over
        # 2 km by 500 m of discs of 370 m, within 4 %. A kilometre of rock too much is 13 %.
        discs = self.table("discs")
        depth = discs.start_depth_m
        porosity = np.where(discs.stratum > 0, discs.porosity, 0.1 * np.exp(-4e-4 * (np.floor(depth / 1000.0) + 0.5) * 1000.0))
        speed = 1.0 / ((1.0 - porosity) / 5500.0 + porosity / 1500.0)
        layer = np.where(discs.stratum > 0, discs.stratum, -np.floor(depth / 1000.0))
        speed *= np.where(layer % 2 == 0, 1.05, 0.95) * np.where(discs.rock.str.startswith("weak"), 0.85, 1.0)
        times = []
        for place in PLACES:
            near = (discs.x_m - place).abs() < 1000.0
            slowness = [(1.0 / speed)[near & (discs.depth_m >= top) & (discs.depth_m < top + 500.0)].mean() for top in range(0, 8000, 500)]
            times.append(2.0 * 500.0 * np.sum(slowness))
        with segyio.open(path, ignore_geometry=True) as file:
            found = self.strongest_reflections(file, 950.0 * np.array(times)) / 1000.0
        np.testing.assert_allclose(found / times, 1.0, atol=0.04)

    def test_arrays_are_of_the_same_samples(self):
        for words, unit in (((), "s"), (("--depth",), "m")):
            [path] = self.export("seismic", "--at", "4km", *words)
            files = {file.name: file for file in self.export("seismic", "--at", "4km", "--format", "npy", *words)}
            axes = json.loads(files[f"{path.stem}.json"].read_text())
            image, faults, strain = (np.load(files[f"{path.stem}-{name}.npy"]) for name in ("image", "faults", "strain"))
            self.assertEqual(image.shape, faults.shape)
            self.assertEqual(axes["depth_reference"], LEVEL)
            samples = axes[f"first_sample_{unit}"] + axes[f"sample_interval_{unit}"] * np.arange(image.shape[1])
            with segyio.open(path, ignore_geometry=True) as file:
                np.testing.assert_allclose(file.samples, (1000.0 if unit == "s" else 1.0) * samples, atol=1e-3)
                np.testing.assert_array_equal(file.trace.raw[:], image)
            # Rock, whose strain is known, lies above time and depth 0, too, and ends at the detachment.
            rows = np.flatnonzero(np.isfinite(strain).any(axis=0))
            self.assertLess(samples[rows[0]], 0.5 * samples[0])
            if unit == "m":
                self.assertLess(abs(samples[rows[-1]] - 8000.0), 60.0)   # a place of the map

    def test_gdal_reads_every_kind_of_lines_where_pandas_does(self):
        for kind in ("horizons", "faults", "surfaces", "well"):
            files = self.export(kind, "--at", "2km", "--format", "csv,geojson")
            self.assertEqual({file.suffix for file in files}, {".csv", ".geojson"})
            for file in files[::2]:
                self.assertEqual(file.suffix, ".csv")
                table, data = pandas.read_csv(file), ogr.Open(str(file.with_suffix(".geojson")))
                self.assertIn("depth_reference", table)
                self.assertLessEqual(set(table.depth_reference), {LEVEL})
                layer = data.GetLayer()
                self.assertEqual(layer.GetFeatureCount(), table.line.nunique(), file)
                self.assertIn(f"m above the {LEVEL} (y = 0)", json.loads(file.with_suffix(".geojson").read_text())["description"])
                for number, feature in enumerate(layer):
                    points = np.array(feature.GetGeometryRef().GetPoints())[:, :2]
                    rows = table[table.line == number]
                    np.testing.assert_array_equal(points, np.column_stack([rows.x_m, -rows.depth_m]))
                    self.assertEqual(feature.GetField("depth_reference"), LEVEL)

    def test_gdal_reads_what_it_has_written(self):
        for kind, at in ("horizons", "2km"), ("faults", "2km"), ("displacement", "1km,2km"):
            *_, file = self.export(kind, "--at", at, "--format", "gpkg,dxf,csv")
            table = pandas.read_csv(file)
            data, drawing = (ogr.Open(str(file.with_suffix(ending))) for ending in (".gpkg", ".dxf"))
            package = data.GetLayer(0)
            lines = [(line.GetField("name"), line.GetGeometryRef().GetPoint(0)) for line in package]
            first = table.groupby("line").first()
            self.assertEqual([name for name, _ in lines], list(first.name))
            for (_, (x, y, _)), (_, row) in zip(lines, first.iterrows()):
                self.assertAlmostEqual(x, row.x_m)
                self.assertAlmostEqual(y, -row.depth_m)
            self.assertIn("ENGCRS", package.GetSpatialRef().ExportToWkt(["FORMAT=WKT2_2019"]))
            self.assertEqual({line.GetField("Layer") for line in drawing.GetLayer(0)}, set(first.name))

    def test_polylines_and_points_of_models_are_where_pandas_has_them(self):
        polylines, points, file = self.export("horizons", "--at", "2km", "--format", "pl,gempy,csv")
        table = pandas.read_csv(file)
        vertices = [line.split() for line in polylines.read_text().splitlines() if line.startswith("VRTX ")]
        np.testing.assert_array_equal([[float(x), -float(z)] for _, _, x, _, z in vertices], table[["x_m", "depth_m"]])
        self.assertEqual(polylines.read_text().count("GOCAD PLine 1"), table.line.nunique())
        model = pandas.read_csv(points)
        self.assertEqual(list(model.columns), ["X", "Y", "Z", "surface", "dip", "azimuth", "polarity"])
        self.assertLessEqual(set(model.surface), set(table.name))
        self.assertTrue(((model.dip >= 0.0) & (model.dip <= 90.0)).all())
        piece = table[table.line == table.line[0]]
        falls = piece.depth_m.to_numpy()[2:] > piece.depth_m.to_numpy()[:-2]   # to the right
        np.testing.assert_array_equal(model.azimuth.to_numpy()[1:len(piece) - 1], np.where(falls, 90, 270))

    def test_the_ground_moves_as_its_discs_do(self):
        moved = pandas.read_csv(self.export("displacement", "--at", "1km,2km")[0])
        self.assertGreater(len(moved), 20)
        self.assertLess(moved.w_m.min(), -300.0)                     # beside the breakaway
        right = moved[moved.x_m > moved.x_m.max() - 2000.0]
        self.assertAlmostEqual(right.u_m.mean(), 1000.0, delta=30.0) # goes with the wall
        self.assertAlmostEqual(right.w_m.mean(), 0.0, delta=30.0)

    def test_h5py_and_gsd_have_the_discs_where_pandas_does(self):
        discs = self.table("discs").sort_values("id")
        self.assertLess(discs.depth_m.min(), -500.0)
        with h5py.File(sorted((self.run_folder / "snapshots").glob("*.h5"))[-1]) as file:
            order = np.argsort(file["discs/id"][()])
            for name, sign in (("x", 1.0), ("y", -1.0)):
                column = discs["x_m" if name == "x" else "depth_m"]
                np.testing.assert_allclose(sign * file[f"discs/{name}"][()][order], column, atol=6e-4)   # a millimetre
        [path] = self.export("discs", "--at", "4km", "--format", "gsd")
        with gsd.hoomd.open(str(path), "rb") as file:
            place = file[-1].particles.position
        np.testing.assert_allclose(place[:, 1], -discs.depth_m, atol=2e-3)   # single precision

    def test_calls_with_other_options_write_other_files(self):
        formats = ("--format", "csv,geojson,gmt")
        calls = [("well", *formats, *words) for words in ((), ("--x", "2km"), ("--x", "3km,2km"), ("--x", "2000.5m,2000.25m"),
                                                          ("--at", "1km"), ("--at", "1km", "--x", "2km"))]
        calls += [("seismic", "--at", "4km", "--format", "segy,npy", *words) for words in (
            (), ("--depth",), ("--frequency", "40"), ("--lateral", "500"), ("--depth", "--frequency", "40", "--lateral", "500"))]
        calls += [("discs", "--format", "gsd", *words) for words in ((), ("--at", "2km"), ("--at", "1km,2km"), ("--at", "1km,2km,4km"))]
        content = {}
        for call in calls:
            files = self.export(*call)
            self.assertFalse(content.keys() & set(files), call)
            content |= {file: file.read_bytes() for file in files}
        for file, before in content.items():   # nobody has written over them
            self.assertEqual(file.read_bytes(), before, file)
        for first, second in itertools.combinations(content, 2):
            if first.suffix == second.suffix == ".csv":
                self.assertNotEqual(content[first], content[second], (first, second))
        # A new run in its place removes all of them.
        ended = listric("run", self.folder / "inverted.toml", "--accuracy", "draft", "--seed", "2", "--until", "10m", "--force", "--quiet",
                        "--no-report", "--output", self.copy_of_run(), env=os.environ | NO_FIGURES)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        self.assertEqual(os.listdir(self.folder / "copy/export") if (self.folder / "copy/export").is_dir() else [], [])

    def copy_of_run(self):
        subprocess.run(["cp", "-a", self.run_folder, self.folder / "copy"], check=True)
        return self.folder / "copy"


if __name__ == "__main__":
    unittest.main()
