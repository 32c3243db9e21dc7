"""Whoever shows or reuses results compares them with what made them: every reader of results is tried on those of another
version, of another request, with an input file of other content, older than their source, unfinished, and damaged.
Whatever is not as it should be is said. With --table it prints what each of them says (docs/record).
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

from forged import OTHER, run_of_another_version
from program import NO_FIGURES, PROGRAM, SOURCES

sys.path.insert(0, str(SOURCES / "apps/python"))
os.environ["LISTRIC_PROGRAM"] = str(PROGRAM)
import listric  # noqa: E402 it lies in the sources

SCENE = """
name = "small"
accuracy = "draft"
[hanging_wall]
length_m = 30000.0
thickness_m = 6000.0
mean_radius_m = 400.0
[detachment]
csv = "fault.csv"
[gravity]
[bonds]
[fault_weakening]
[extension]
distance_m = 30.0
[output]
interval_m = 10.0
[observed]
horizons = "picks.csv"
"""
FAULT = "x_m,depth_m\n0,0\n2000,2600\n5000,4800\n9000,5800\n14000,6000\n31000,6000\n"
PICKS = "name,x_m,depth_m\ntop,1000,100\ntop,4000,120\ntop,9000,60\n"
PLAN = 'scene = "small.toml"\nmeasures = ["discs"]\n[[vary]]\nparameter = "cycle.damping"\nvalues = [0.5]\n'
CONDITIONS = ("other version", "other request", "other input", "older", "unfinished", "damaged")
RUN = ("run", "small.toml", "--threads", "1", "--no-figures")
SWEEP = ("sweep", "plan.toml", "--threads", "1", "-o")
STUDY = ("study", "speed", "--scene", "small.toml", "--values", "8,4", "--seeds", "1", "--threads", "1", "-o")
LABORATORY = ("laboratory", "uniaxial", "mat18-b", "--discs", "150", "--seeds", "1", "--threads", "1", "-o", "laboratory")


def change(file, **values):
    """Members of a JSON object."""
    file.write_text(json.dumps({**json.loads(file.read_text()), **values}, indent=2) + "\n")


class Results:
    """A folder of results, and what is done to them."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = {**os.environ, **NO_FIGURES, "XDG_CACHE_HOME": str(folder / "cache")}
        (folder / "small.toml").write_text(SCENE)
        (folder / "fault.csv").write_text(FAULT)
        (folder / "picks.csv").write_text(PICKS)
        (folder / "plan.toml").write_text(PLAN)
        self.must(*RUN, "-o", "run", "--until", "20m")
        self.must(*RUN, "-o", "other", "--until", "20m", "--seed", "2", "--no-report")
        self.must("export", "horizons", "run")
        self.must(*SWEEP, "sweep")
        self.must(*LABORATORY)
        shutil.move(folder / "laboratory", folder / "tested")
        shutil.copytree(folder / "run", folder / "longer")
        self.must(*RUN, "-o", "longer", "--resume")

    def call(self, *words, **environment):
        """Exit code, and all that is said."""
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, env=self.environment | environment, text=True,
                              check=False, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def must(self, *words):
        code, said = self.call(*words)
        assert code == 0, f"{words}: {said}"

    def spoilt(self, condition, name, of="run"):
        """A copy of a run under a condition."""
        run = self.folder / name
        shutil.rmtree(run, ignore_errors=True)
        run.parent.mkdir(parents=True, exist_ok=True)
        shutil.copytree(self.folder / of, run)
        if condition == "other version":
            run_of_another_version(run)
        elif condition == "other request":
            shutil.copy(self.folder / "other/summary.json", run)
        elif condition == "other input":
            (self.folder / "fault.csv").write_text(FAULT.replace("4800", "4900"))
        elif condition == "older":  # a run that was extended, and killed at the end of that
            if of == "run":
                shutil.copy(self.folder / "longer/snapshots/extension-00030.00m.h5", run / "snapshots")
            else:
                change(run / "summary.json", extension_m=20.0)
        elif condition == "unfinished":
            (run / "summary.json").unlink()
        elif condition == "damaged":
            text = (run / "summary.json").read_text()
            (run / "summary.json").write_text(text[:len(text) // 2])
        return run

    def mend_input(self):
        (self.folder / "fault.csv").write_text(FAULT)


def in_python(look):
    """A reader by the package: what it warns of or raises."""
    def read(results, run, condition):
        del results, condition
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                look(listric.Run(run))
            except listric.ListricError as error:
                return 1, f"{type(error).__name__}: {error}"
        return 0, "\n".join(f"warning: {one.message}" for one in caught)
    return read


def by_call(*words):
    return lambda results, run, condition: results.call(*(run.name if word == "RUN" else word for word in words))


def drawn(results, run, condition):
    """`figures`, with the Python that there is."""
    del condition
    return results.call("figures", run.name, "--at", "10m", "--only", "strata", LISTRIC_PYTHON=os.environ.get("LISTRIC_PYTHON", ""))


def cards(results, run, condition):
    """`listric view` without a folder, beside a folder `out`."""
    del condition
    out = results.folder / "out"
    shutil.rmtree(out, ignore_errors=True)
    shutil.move(run, out / "run")
    code, said = results.call("view")
    page = out / "index.html"
    if page.exists():
        said += re.sub("<[^>]*>", " ", page.read_text().partition("<main>")[2].replace("<p>", "\n"))
    return code, said


def batch(*words, folder):
    """A call that makes runs of its own and finds one of them spoilt."""
    def read(results, run, condition):
        del run
        shutil.rmtree(results.folder / "batch", ignore_errors=True)
        results.mend_input()
        results.must(*words)
        made = next(results.folder.glob(folder))
        shutil.copytree(made, results.folder / "made")
        results.spoilt(condition, made.relative_to(results.folder), of="made")
        shutil.rmtree(results.folder / "made")
        return results.call(*words)
    return read


def merged(results, run, condition):
    """`sweep --merge` of a table and its runs."""
    task = results.folder / "task"
    for folder in (task, results.folder / "merged"):
        shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(results.folder / "sweep", task)
    table, summary = task / "sweep.csv", next(task.glob("runs/*/summary.json"))
    text = table.read_text()
    if condition == "other version":
        table.write_text(re.sub(r"(,[0-9a-f]{16},)[^,]*,", rf"\g<1>{OTHER},", text))
    elif condition == "other request":
        file = summary.with_name("scene.toml")
        file.write_text(file.read_text().replace("damping = 0.5", "damping = 0.6"))
    elif condition == "older":
        change(summary, state_hash="0" * 16)
    elif condition == "unfinished":
        table.write_text(text.splitlines()[0] + "\n")
        summary.unlink()  # a finished run would be read without its row
    elif condition == "damaged":
        table.write_text(text[:-2])
    return results.call("sweep", "plan.toml", "--merge", "task", "-o", "merged")


def tested(results, run, condition):
    """`laboratory` once more."""
    del run
    lab = results.folder / "laboratory"
    shutil.rmtree(lab, ignore_errors=True)
    shutil.copytree(results.folder / "tested", lab)
    words = LABORATORY
    if condition == "other version":
        change(lab / "summary.json", version=OTHER)
    elif condition == "other request":
        words = (*words, "--seed", "2")
    elif condition == "other input":
        text = (lab / "material.toml").read_text()
        (lab / "material.toml").write_text(re.sub("(?m)^friction = [0-9.]+", "friction = 0.7", text))
    elif condition == "unfinished":
        (lab / "summary.json").unlink()
    elif condition == "damaged":
        (lab / "summary.json").write_text((lab / "summary.json").read_text()[:300])
    return results.call(*words)


# What is not compared, and why.
SCENE_HOLDS_IT = "reads no input: scene.toml holds its values"
NOT_COMPARED = {
    **{(reader, "other input"): SCENE_HOLDS_IT
       for reader in ("report", "figures", "export", "view DIR", "view", "diff", "cite", "Python summary", "Python history",
                      "Python snapshots", "Python faults", "Python lines")},
    ("laboratory", "older"): "the results are one file of one call",
    ("cite", "other version"): "prints that version",
}

READERS = {
    "sweep --merge": merged,
    "laboratory": tested,
    "run --resume": by_call(*RUN, "--resume", "--until", "20m", "-o", "RUN"),
    "report": by_call("report", "RUN"),
    "figures": drawn,
    "export": by_call("export", "horizons", "RUN", "--at", "10m"),
    "view DIR": by_call("view", "RUN"),
    "view": cards,
    "diff": by_call("diff", "RUN", "other"),
    "cite": by_call("cite", "RUN"),
    "sweep": batch(*SWEEP, "batch", folder="batch/runs/*"),
    "study": batch(*STUDY, "batch", folder="batch/runs/*=8-*"),  # its runs are made as those of fit and validate
    "Python summary": in_python(lambda run: run.summary),
    "Python history": in_python(lambda run: run.history),
    "Python snapshots": in_python(lambda run: run.snapshots),
    "Python faults": in_python(lambda run: run.faults),
    "Python lines": in_python(lambda run: run.snapshots[-1].lines("surfaces")),
}


def said_by(results, reader, condition):
    run = results.spoilt(condition, "spoilt")
    try:
        return READERS[reader](results, run, condition)
    finally:
        results.mend_input()


# Readers that go on with what they find, which makes the summary anew.
MAKERS = ("run --resume", "sweep", "study")
MADE_AGAIN = re.compile(r"resuming at|is longer than the scene")  # of a run that begins


def first_words(said, condition):
    """The line of an answer that tells of the condition."""
    lines = [line.strip() for line in said.splitlines()]
    about = {"other version": "0.1.0", "other request": "another (request|call|plan)", "other input": "there, ",
             "older": "newest snapshot|newer|older", "unfinished": "not ended|resuming|none of the folders|no file of such",
             "damaged": "damaged|resuming|cut short|readable"}
    found = [line for line in lines if re.search(about[condition], line)]
    return found[0] if found else ""


def cells(results, readers):
    """(reader, condition, answer) of every cell; an empty answer: silent."""
    for reader in readers:
        for condition in CONDITIONS:
            if why := NOT_COMPARED.get((reader, condition)):
                yield reader, condition, f"({why})"
                continue
            code, said = said_by(results, reader, condition)
            words = first_words(said, condition)
            if not words and reader in MAKERS and MADE_AGAIN.search(said):
                words = "(makes it again from its newest snapshot)"
            yield reader, condition, f"{words} [{code}]" if words else ""


class EveryReader(unittest.TestCase):
    def test_no_cell_is_silent(self):
        with tempfile.TemporaryDirectory() as place:
            for reader, condition, answer in cells(Results(Path(place)), READERS):
                with self.subTest(reader=reader, condition=condition):
                    self.assertTrue(answer)


def print_table():
    with tempfile.TemporaryDirectory() as place:
        print("| reader | " + " | ".join(CONDITIONS) + " |\n|---|" + "---|" * len(CONDITIONS))
        row = []
        for reader, condition, answer in cells(Results(Path(place)), sys.argv[2:] or READERS):
            answer = answer.replace(f"{place}/", "").replace("listric: warning: ", "warning: ").replace("|", "\\|")
            row.append(re.sub(r"\d\.\d\.\d\+[0-9a-f]{8}(-dirty)?", lambda found: "OTHER" if found[0] == OTHER else "THIS", answer))
            if condition == CONDITIONS[-1]:
                print(f"| {reader} | " + " | ".join(row) + " |", flush=True)
                row = []


if __name__ == "__main__":
    if sys.argv[1:2] == ["--table"]:
        print_table()
    else:
        unittest.main()
