#!/usr/bin/python3
"""Runs the recipes of docs/guides/which-engine.md as they stand there.

Usage: run_recipes.py PROGRAM [ENGINE...]

Each engine makes the runs of a small plan in a folder of its own, is killed when some are done, and is called
again.  Its table must be that of one `listric sweep`, byte for byte.  Slurm is started here, on one node, and
needs root.  An engine that is not there is told and left out: HyperQueue is not in Debian.  Exit status 1: a
table differs.
"""
import contextlib
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

GUIDE = pathlib.Path(__file__).resolve().parents[2] / "docs/guides/which-engine.md"
RUNS = 12   # as the guide's array has
PLAN = """scene = "pure-shear"
accuracy = "draft"
set = "extension.distance_m=100"
seeds = 3
measures = ["strain_top10"]
[[vary]]
parameter = "cycle.damping"
values = [0.5, 0.6, 0.7, 0.8]
"""
TIME_LIMIT = 600.0   # s


def recipe(engine: str) -> str:
    """The block below an engine's name; of those that have none, the first call behind it."""
    text = re.search(rf"\*\*{engine}\.\*\*(.*?)(?=\n\*\*|\Z)", GUIDE.read_text(), re.DOTALL)[1]
    block = re.search(r"```\w+\n(.*?)```", text, re.DOTALL)
    return block[1] if block else re.search(r"`([^`]+)`", text)[1]


def done(folder: pathlib.Path) -> int:
    return len(list(folder.glob("out/sweep-friction/runs/*/summary.json")))


def wait_for(what: str, reached) -> None:
    end = time.monotonic() + TIME_LIMIT
    while not reached():
        if time.monotonic() > end:
            raise TimeoutError(what)
        time.sleep(0.05)


def call_twice(call: str, folder: pathlib.Path, between: str = "") -> None:
    """Kills the first call with all its children when some runs are done."""
    with open(folder / "engine.log", "w") as log:
        first = subprocess.Popen(call, shell=True, cwd=folder, stdout=log, stderr=log, start_new_session=True)
        wait_for("first runs", lambda: done(folder) >= 3 or first.poll() is not None)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        print(f"  killed at {done(folder)} of {RUNS}", flush=True)
        if between:
            subprocess.run(between, shell=True, cwd=folder, stdout=log, stderr=log, check=True)
        subprocess.run(call, shell=True, cwd=folder, stdout=log, stderr=log, check=True, timeout=TIME_LIMIT)


def parallel(folder: pathlib.Path) -> None:
    call_twice(recipe("GNU parallel"), folder)


def snakemake(folder: pathlib.Path) -> None:
    (folder / "Snakefile").write_text(recipe("Snakemake"))
    call_twice("snakemake --cores 2", folder, between="snakemake --unlock")


def dask(folder: pathlib.Path) -> None:
    (folder / "run.py").write_text(recipe("Dask"))
    call_twice("/usr/bin/python3 run.py", folder)


@contextlib.contextmanager
def slurm_node(folder: pathlib.Path):
    """A cluster of this machine alone."""
    name = socket.gethostname().split(".")[0]
    state = folder / "slurm"
    state.mkdir()
    (state / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={name}
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation={state}
SlurmdSpoolDir={state}/node
SlurmctldPidFile={state}/control.pid
SlurmdPidFile={state}/node.pid
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
NodeName={name} CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
    os.environ["SLURM_CONF"] = str(state / "slurm.conf")
    if subprocess.run(("pgrep", "-x", "munged"), stdout=subprocess.DEVNULL, check=False).returncode:
        os.makedirs("/run/munge", exist_ok=True)
        shutil.chown("/run/munge", "munge", "munge")
        subprocess.run(("runuser", "-u", "munge", "--", "munged"), check=True)
    daemons = [subprocess.Popen((daemon, "-D"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
               for daemon in ("slurmctld", "slurmd")]
    try:
        wait_for("Slurm", lambda: "idle" in subprocess.run(("sinfo", "-h", "-o", "%T"), capture_output=True, text=True,
                                                           check=False).stdout)
        yield
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
            daemon.wait()


def slurm(folder: pathlib.Path) -> None:
    (folder / "array.sh").write_text(recipe("Slurm"))

    def is_empty() -> bool:
        return not subprocess.run(("squeue", "-h"), capture_output=True, text=True, check=True).stdout.strip()

    with slurm_node(folder):
        submit = ("sbatch", "array.sh")
        subprocess.run(submit, cwd=folder, stdout=subprocess.DEVNULL, check=True)
        wait_for("first runs", lambda: done(folder) >= 3 or is_empty())
        subprocess.run(("scancel", "--full", "--user=root"), check=True)
        wait_for("an empty queue", is_empty)
        print(f"  cancelled at {done(folder)} of {RUNS}", flush=True)
        subprocess.run(submit, cwd=folder, stdout=subprocess.DEVNULL, check=True)
        wait_for("an empty queue", is_empty)


def hyperqueue(folder: pathlib.Path) -> None:
    os.environ["HQ_SERVER_DIR"] = str(folder / "server")
    daemons = []
    try:
        for words in ("server", "start"), ("worker", "start"):
            daemons.append(subprocess.Popen(("hq", *words), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
            wait_for("HyperQueue", lambda: not subprocess.run(("hq", "server", "info"), capture_output=True,
                                                              check=False).returncode)
        for _ in "ab":
            subprocess.run(recipe("HyperQueue").replace("hq submit", "hq submit --wait"), shell=True, cwd=folder,
                           check=True, timeout=TIME_LIMIT)
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
            daemon.wait()


ENGINES = {"parallel": ("parallel", parallel), "snakemake": ("snakemake", snakemake), "dask": ("dask-worker", dask),
           "slurm": ("slurmctld", slurm), "hyperqueue": ("hq", hyperqueue)}


def prepare(folder: pathlib.Path, program: str) -> None:
    folder.mkdir()
    (folder / "friction.toml").write_text(PLAN)
    launcher = folder / "listric"
    launcher.write_text(f"#!/bin/sh\nLISTRIC_CALL=./listric exec '{program}' \"$@\"\n")
    launcher.chmod(0o755)
    with open(folder / "runs.txt", "w") as runs:
        subprocess.run(("./listric", "sweep", "friction.toml", "--list"), cwd=folder, stdout=runs, check=True)


def sweep(folder: pathlib.Path, *options: str) -> None:
    call = ("./listric", "sweep", "friction.toml", *options)
    with open(folder / "sweep.log", "w") as log:
        subprocess.run(call, cwd=folder, stdout=log, stderr=log, check=True)


def main(program: str, *asked: str) -> int:
    different = 0
    with tempfile.TemporaryDirectory(prefix="listric-engines-") as place:
        whole = pathlib.Path(place) / "whole"
        prepare(whole, program)
        sweep(whole, "--lean")
        table = (whole / "out/sweep-friction/sweep.csv").read_bytes()
        for name in asked or ENGINES:
            tool, run = ENGINES[name]
            if not shutil.which(tool):
                print(f"{name}: there is no {tool} here: left out", flush=True)
                continue
            print(name, flush=True)
            folder = pathlib.Path(place) / name
            prepare(folder, program)
            run(folder)
            if name != "snakemake":   # whose last rule has
                sweep(folder, "--merge", "out/sweep-friction")
            same = (folder / "out/sweep-friction/sweep.csv").read_bytes() == table
            print(f"  its table is {'the same' if same else 'ANOTHER'}", flush=True)
            different += not same
    return int(different > 0)


if __name__ == "__main__":
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= set(ENGINES):
        sys.exit(__doc__)
    sys.exit(main(os.path.abspath(sys.argv[1]), *sys.argv[2:]))
