"""`listric export seismic`: SEG-Y as segyio reads it, arrays as NumPy reads them, and that both are the run's.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest seismic_test
"""

import json
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np
import segyio   # python3-segyio, of cmake/packages.sh: without it this fails, it is not skipped
from program import NO_FIGURES, listric


class Seismic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.run_folder = Path(folder.name) / "run"
        ended = listric("run", "lis1", "--accuracy", "draft", "--until", "1km", "--no-report", "--quiet",
                        "--output", cls.run_folder, env=os.environ | NO_FIGURES)
        assert ended.returncode == 0, ended.stdout

    def export(self, *words):
        ended = listric("export", "seismic", self.run_folder, "--at", "1km", *words)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        return [Path(line) for line in ended.stdout.split()]

    def test_segyio_reads_what_was_meant(self):
        image, faults, strain, axes, segy = sorted(self.export("--format", "npy,segy"), key=lambda path: [
            "-image.npy", "-faults.npy", "-strain.npy", ".json", ".segy"].index(next(
                end for end in ("-image.npy", "-faults.npy", "-strain.npy", ".json", ".segy") if path.name.endswith(end))))
        words = json.loads(axes.read_text())
        image, faults, strain = np.load(image), np.load(faults), np.load(strain)
        with segyio.open(segy, ignore_geometry=True) as file:
            traces = file.trace.raw[:]
            np.testing.assert_array_equal(traces, image)
            self.assertEqual(file.bin[segyio.BinField.Format], 5)
            self.assertEqual(file.bin[segyio.BinField.SEGYRevision], 256)
            self.assertEqual(segyio.tools.dt(file) / 1e6, words["sample_interval_s"])
            np.testing.assert_allclose(file.samples, 1e3 * (
                words["first_sample_s"] + words["sample_interval_s"] * np.arange(image.shape[1])), atol=1e-6)
            x = file.attributes(segyio.TraceField.CDP_X)[:] / 100.0
            self.assertEqual(set(file.attributes(segyio.TraceField.SourceGroupScalar)[:]), {-100})
            np.testing.assert_allclose(x, words["first_x_m"] + words["trace_spacing_m"] * np.arange(len(x)), atol=0.006)
            np.testing.assert_array_equal(file.attributes(segyio.TraceField.CDP)[:], np.arange(len(x)) + 1)
            text = bytes(file.text[0]).decode(errors="replace")
            for said in ("C 1 LISTRIC", "RICKER WAVELET, ZERO PHASE, 25 HZ", "NO MIGRATION", "WYLLIE'S TIME AVERAGE",
                         "C40 END TEXTUAL HEADER"):
                self.assertIn(said, text)
        # Labels are of the same samples: rock is deformed within faults more than beside them.
        self.assertEqual(image.shape, faults.shape)
        self.assertEqual(image.shape, strain.shape)
        strained = np.isfinite(strain)  # neither outside rock nor in sediment that has come since
        self.assertTrue(0.2 < strained.mean() < 1.0)
        self.assertEqual(set(np.unique(faults)), {0, 1})
        self.assertGreater(strain[strained & (faults == 1)].mean(), 3.0 * strain[strained & (faults == 0)].mean())

    def test_flat_layers_far_from_the_basin_are_where_they_began(self):
        [image, *_, axes] = self.export("--format", "npy", "--depth")
        words, image = json.loads(axes.read_text()), np.load(image)
        x = words["first_x_m"] + words["trace_spacing_m"] * np.arange(len(image))
        depth = words["first_sample_m"] + words["sample_interval_m"] * np.arange(image.shape[1])
        stack = image[(x > 30000) & (x < 38000)].mean(axis=0)
        # Tops of the pre-rift layers are a kilometre apart; even ones are faster. Discs of 370 m are rough.
        for layer in range(1, 10):
            near = np.abs(depth - 1000.0 * layer) < 300.0
            at = depth[near][np.argmax(np.abs(stack[near]))]
            self.assertLess(abs(at - 1000.0 * layer), 190.0, layer)
            self.assertEqual(stack[near][np.argmax(np.abs(stack[near]))] > 0, layer % 2 == 0, layer)

    def test_lateral_smoothing_keeps_flat_layers_and_a_call_can_be_wrong(self):
        def roughness(*words):
            image = np.load(self.export("--format", "npy", *words)[0])
            return np.abs(np.diff(image, axis=0)).mean()
        self.assertLess(roughness("--lateral", "500"), 0.7 * roughness())
        for words, said in ((("--format", "csv"), "export seismic: no format csv"), (("--frequency", "0.5"), "--frequency")):
            ended = listric("export", "seismic", self.run_folder, *words)
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(said, ended.stdout)


if __name__ == "__main__":
    unittest.main()
