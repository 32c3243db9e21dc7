"""The notebooks of docs/notebooks run to their ends, as they stand there and in their pages.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest notebooks_test
"""

import os
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from program import PROGRAM, SOURCES

NOTEBOOKS = SOURCES / "docs/notebooks"
sys.dont_write_bytecode = True
sys.path.insert(0, str(NOTEBOOKS))
import render


class Notebooks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="listric-notebooks-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def check(self, name, pictures):
        """Is kept without outputs, runs to its end, shows so many pictures, and nothing on stderr; its
        page has all its cells and pictures."""
        kept = render.nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
        code = [cell for cell in kept.cells if cell.cell_type == "code"]
        self.assertEqual([cell for cell in code if cell.outputs or cell.execution_count], [])
        page = (NOTEBOOKS / f"{name}.md").read_text()
        without = re.sub(r"!\[[^]]*\]\(\.\./pictures/notebooks/[^)]*\)", "", page)
        self.assertEqual([cell.source for cell in kept.cells
                          if re.sub(r"\.ipynb\)", ".md)", cell.source) not in without], [],
                         f"call docs/notebooks/render.py {name}")
        self.assertEqual(len(re.findall(r"^!\[", page, re.MULTILINE)), pictures)
        # The settled packing is made once for all three.
        outputs = [output for cell in render.executed(name, self.folder, PROGRAM).cells
                   for output in cell.get("outputs", ())]
        self.assertEqual([one["text"] for one in outputs if one.get("name") == "stderr"], [])
        self.assertEqual(sum("image/png" in one.get("data", ()) for one in outputs), pictures)

    def test_first_run(self):
        self.check("first-run", pictures=4)

    def test_sweep(self):
        self.check("sweep", pictures=2)

    @unittest.skipIf(os.environ.get("LISTRIC_FEM") == "0", "built without finite elements")
    def test_uplift(self):
        self.check("uplift", pictures=2)

    def test_all_notebooks_are_tested(self):
        self.assertEqual(sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")),
                         ["first-run", "sweep", "uplift"])


if __name__ == "__main__":
    unittest.main()
