#!/usr/bin/python3
"""Makes pages of the notebooks: runs each and writes NAME.md, with all that it shows.

Usage: LISTRIC_PROGRAM=build/native/listric docs/notebooks/render.py [NAME...]

Needs python3-nbclient, python3-nbformat, python3-ipykernel, python3-pil, matplotlib and pandas.
"""
import base64
import io
import os
import re
import sys
import tempfile
from pathlib import Path

os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # else debugpy tells of a debugger that is none
import nbformat
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PICTURES = HERE.parent / "pictures/notebooks"


def executed(name, folder, program):
    """The notebook with its outputs; its files are left in the folder. An error in a cell is thrown with
    the cell."""
    notebook = nbformat.read(HERE / f"{name}.ipynb", as_version=4)
    nbformat.validate(notebook)
    client = NotebookClient(notebook, timeout=600, kernel_name="python3",
                            resources={"metadata": {"path": str(folder)}})
    client.execute(env={**os.environ, "LISTRIC_PROGRAM": str(program),
                        "PYTHONPATH": str(ROOT / "apps/python"), "PYTHONDONTWRITEBYTECODE": "1",
                        "XDG_CACHE_HOME": f"{folder}/cache", "IPYTHONDIR": f"{folder}/ipython"})
    return notebook


def shown(output, name, pictures):
    """An output as Markdown; its picture joins the list."""
    data = output.get("data", {})
    if "image/png" in data:
        pictures.append(base64.b64decode(data["image/png"]))
        return f"![{name}, picture {len(pictures)}](../pictures/notebooks/{name}-{len(pictures)}.webp)\n"
    if "text/html" in data:
        html = re.sub(r"<style.*?</style>\s*", "", data["text/html"], flags=re.DOTALL)
        lines = re.sub(r"\n\s*", "\n", html).strip() + "\n"
        return re.sub(r"\n(?=<t[hd]\b|</tr>)", "", lines)  # a row of a table stands on a line
    return f"```\n{(output.get('text') or data.get('text/plain', '')).rstrip()}\n```\n"


def page(notebook, name, pictures):
    """The notebook as Markdown."""
    parts = []
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            text = re.sub(r"\(([\w-]+)\.ipynb\)", r"(\1.md)", cell.source)
            parts.append(text + "\n")
            if len(parts) == 1:
                parts.append(f"This page is the notebook [{name}.ipynb]({name}.ipynb) with all that it shows.\n")
        else:
            parts.append(f"```python\n{cell.source}\n```\n")
            parts += [shown(output, name, pictures) for output in cell.outputs]
    return "\n".join(parts)


def save(png, path):
    """As WebP, not wider than a page."""
    from PIL import Image
    image = Image.open(io.BytesIO(png)).convert("RGB")
    image.thumbnail((1100, 1100), Image.LANCZOS)
    image.save(path, quality=70, method=6)


def render(name, program):
    with tempfile.TemporaryDirectory(prefix="listric-notebooks-") as folder:
        notebook = executed(name, folder, program)
    pictures = []
    (HERE / f"{name}.md").write_text(page(notebook, name, pictures), encoding="utf-8")
    for number, png in enumerate(pictures, start=1):
        save(png, PICTURES / f"{name}-{number}.webp")


if __name__ == "__main__":
    for wanted in sys.argv[1:] or sorted(path.stem for path in HERE.glob("*.ipynb")):
        render(wanted, Path(os.environ["LISTRIC_PROGRAM"]).resolve())
