#!/usr/bin/python3
"""What runs take, and what they say before that they will: appends to docs/benchmarks/prediction.csv.

Usage: tests/benchmark/prediction.py [REPEATS]

lis1, lis2, rfr and lis1-elastic at draft and lis1 at standard, on one thread and on two, in turn;
some eight minutes a repeat. Nothing else should run meanwhile. Needs a build (./listric --version),
whose preset LISTRIC_PRESET names as ever. Packings are kept from run to run, as for users.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import benchmark

RUNS = [(scene, "draft") for scene in ("lis1", "lis2", "rfr", "lis1-elastic")] + \
    [("lis1", "standard")]


def run(program, folder, scene, accuracy, *more):
    subprocess.run([program, "run", scene, "--accuracy", accuracy, "--quiet", "--force",
                    "--output", folder, *more], check=True, cwd=benchmark.ROOT,
                   stdout=subprocess.DEVNULL)
    return json.loads((pathlib.Path(folder) / "summary.json").read_text())


def row(scene, accuracy, threads, summary):
    predicted, took = summary["predicted_wall_s"], summary["wall_s"]
    return benchmark.circumstances() | {
        "scene": scene, "accuracy": accuracy, "threads": threads,
        "predicted_s": f"{predicted:.1f}", "took_s": f"{took:.1f}",
        "predicted_over_took": f"{predicted / took:.2f}"}


def main(repeats):
    program = benchmark.ROOT / "build" / os.environ.get("LISTRIC_PRESET", "native") / "listric"
    with tempfile.TemporaryDirectory() as folder:
        for scene, accuracy in RUNS:
            run(program, folder, scene, accuracy, "--until", "0m")
        for _ in range(repeats):
            for scene, accuracy in RUNS:
                for threads in (1, 2):
                    summary = run(program, folder, scene, accuracy, "--threads", str(threads))
                    benchmark.record("prediction", [row(scene, accuracy, threads, summary)])


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 3)
