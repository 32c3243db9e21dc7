"""The notebooks of docs/notebooks run to their ends, as they stand there.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest notebooks_test

With LISTRIC_NOTEBOOKS=FOLDER they are left there with what they showed.
"""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # else debugpy tells of a debugger that is none
import nbformat
from nbclient import NotebookClient
from program import PROGRAM, SOURCES

NOTEBOOKS = SOURCES / "docs/notebooks"

class Notebooks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="listric-notebooks-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        # The settled packing is made once for all three.
        cls.environment = {**os.environ, "LISTRIC_PROGRAM": str(PROGRAM),
                           "PYTHONPATH": str(SOURCES / "apps/python"),
                           "PYTHONDONTWRITEBYTECODE": "1",
                           "XDG_CACHE_HOME": str(cls.folder / "cache"),
                           "IPYTHONDIR": str(cls.folder / "ipython")}

    def executed(self, name):
        """The notebook with its outputs; an error in a cell is thrown with the cell."""
        notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
        nbformat.validate(notebook)
        for cell in notebook.cells:
            if cell.cell_type == "code":
                self.assertEqual((cell.outputs, cell.execution_count), ([], None),
                                 "notebooks are kept without outputs")
        client = NotebookClient(notebook, timeout=600, kernel_name="python3",
                                resources={"metadata": {"path": str(self.folder)}})
        client.execute(env=self.environment)
        if wanted := os.environ.get("LISTRIC_NOTEBOOKS"):
            nbformat.write(notebook, Path(wanted, f"{name}.ipynb"))
        return notebook

    def check(self, name, pictures):
        """Runs to its end, shows so many pictures, and nothing on stderr."""
        outputs = [output for cell in self.executed(name).cells
                   for output in cell.get("outputs", ())]
        self.assertEqual([one["text"] for one in outputs if one.get("name") == "stderr"], [])
        self.assertEqual(sum("image/png" in one.get("data", ()) for one in outputs), pictures)

    def test_first_run(self):
        self.check("first-run", pictures=3)

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
