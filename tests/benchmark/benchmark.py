#!/usr/bin/python3
"""Measures this machine and appends to the CSV files in docs/benchmarks.

Usage: tests/benchmark/benchmark.py [cycle|neighbours|runs|instructions|effects ...]

  cycle         disc-steps per second by build (vector width), discs and threads
  neighbours    neighbour search and packing, ns per disc
  runs          whole runs of lis1 at draft: wall time and where it goes
  instructions  instructions per disc-step (valgrind, AVX2 build), which are repeatable
  effects       instructions of a scene with gravity and friction alone, in this build and in one
                linked without the sources of the effects; and what each effect adds

Rates are medians of several repeats. Compare lines of one session only: machines are noisy.
"""
import csv
import datetime
import json
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RESULTS = ROOT / "docs" / "benchmarks"
PRESETS = ("native", "x86-64-v3")
REPEATS = 5


def call(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, text=True,
                          capture_output=True, cwd=ROOT, **options).stdout


def build(preset, tests=False):
    call("cmake", "--preset", preset, "-D", "LISTRIC_TESTS=" + ("ON" if tests else "OFF"))
    call("cmake", "--build", "--preset", preset)
    return ROOT / "build" / preset / "listric"


def circumstances():
    cpuinfo = pathlib.Path("/proc/cpuinfo").read_text()
    model = re.search(r"model name\s*: (.*)", cpuinfo)
    return {
        "date": datetime.date.today().isoformat(),
        "commit": call("git", "describe", "--always", "--dirty").strip(),
        "processor": model[1] if model else platform.machine(),
        "cores": os.cpu_count(),
        "load": round(os.getloadavg()[0], 2),
        "compiler": call("c++", "-dumpfullversion").strip(),
    }


def record(name, rows):
    RESULTS.mkdir(parents=True, exist_ok=True)
    path = RESULTS / f"{name}.csv"
    fresh = not path.exists()
    with path.open("a", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        if fresh:
            writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print(" ".join(f"{key}={value}" for key, value in row.items()))


def measure_cycle():
    rows = []
    for preset in PRESETS:
        program = build(preset)
        for kind in ("", "--unbonded", "--plain"):
            for discs in (1_000, 5_000, 20_000, 100_000, 1_000_000):
                for threads in sorted({1, 2, os.cpu_count()}):
                    if kind and (threads > 1 or discs != 20_000):
                        continue
                    steps = max(5, 40_000_000 // discs)
                    runs = [json.loads(call(program, "bench", "--discs", discs, "--steps", steps,
                                            "--threads", threads, *kind.split()))
                            for _ in range(REPEATS)]
                    rows.append(circumstances() | {
                        "preset": preset, "cycle": kind.strip("-") or "bonded",
                        "discs": runs[0]["discs"], "threads": threads,
                        "disc_steps_per_s": f"{statistics.median(r['disc_steps_per_s'] for r in runs):.4g}",
                        "disc_steps_per_cpu_s":
                            f"{statistics.median(r['disc_steps_per_cpu_s'] for r in runs):.4g}"})
    record("cycle", rows)


def measure_neighbours():
    build("native", tests=True)
    report = json.loads(call(ROOT / "build" / "native" / "tests" / "listric_benchmark",
                             "--benchmark_format=json", f"--benchmark_repetitions={REPEATS}"))
    record("neighbours", [circumstances() | {
        "work": b["run_name"].split("/")[0], "discs": b["run_name"].split("/")[1],
        "ns_per_disc": f"{1e9 * b['per_disc']:.3g}"}
        for b in report["benchmarks"] if b.get("aggregate_name") == "median"])


def measure_runs():
    rows = []
    program = build("native")
    for threads in sorted({1, os.cpu_count()}):
        with tempfile.TemporaryDirectory() as folder:
            call(program, "run", "lis1", "--accuracy", "draft", "--threads", threads,
                 "--output", folder + "/run")
            summary = json.loads(pathlib.Path(folder, "run", "summary.json").read_text())
        parts = sorted(summary["time_by_part_s"].items(), key=lambda part: -part[1])
        rows.append(circumstances() | {
            "scene": "lis1", "accuracy": "draft", "threads": threads,
            "wall_s": f"{summary['wall_s']:.1f}",
            "predicted_wall_s": f"{summary['predicted_wall_s']:.1f}",
            "disc_steps_per_s": f"{summary['disc_steps_per_s']:.4g}",
            "parts_s": " ".join(f"{name}:{seconds:.2f}" for name, seconds in parts[:8])})
    record("runs", rows)


def instructions(*command):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out",
                        *(str(word) for word in command)], check=True, capture_output=True)
        totals = pathlib.Path(folder, "out").read_text()
    return int(re.search(r"^(?:summary|totals): (\d+)", totals, re.M)[1])


def measure_instructions():
    # valgrind knows no AVX-512.
    program = build("x86-64-v3")

    def count(steps, *kind):
        return instructions(program, "bench", "--discs", "5000", "--steps", steps, *kind)

    discs = json.loads(call(program, "bench", "--discs", 5000, "--steps", 1))["discs"]
    record("instructions", [circumstances() | {
        "preset": "x86-64-v3", "cycle": kind.strip("-") or "bonded", "discs": discs,
        "instructions_per_disc_step":
            f"{(count(120, *kind.split()) - count(20, *kind.split())) / (100 * discs):.1f}"}
        for kind in ("", "--unbonded", "--plain")])


# What a scene with gravity and friction alone never calls, in dem/events and dem.
EFFECTS = ("bond_healing", "compaction", "energy", "energy_account", "fault_weakening",
           "measure_circle", "property_update", "sediment_stress", "sedimentation", "soft_discs")


def link(preset, folder, without):
    """The program linked anew into a folder, without these sources of dem: a call of what is missing
    would end it."""
    place, library = ROOT / "build" / preset, folder / "dem.a"
    shutil.copy(place / "dem/liblistric_dem.a", library)
    if without:
        call("ar", "d", library, *(f"{name}.cpp.o" for name in without))
    program = folder / ("listric-without" if without else "listric")
    command = call("ninja", "-C", place, "-t", "commands", "listric").splitlines()[-1]
    command = command.replace("dem/liblistric_dem.a", str(library)).replace(
        "-o listric ", f"-o {program} -no-pie -Wl,--unresolved-symbols=ignore-all ")
    subprocess.run(command, shell=True, check=True, cwd=place)
    return program


def measure_effects():
    scene = ROOT / "tests" / "scenes" / "every-effect.toml"
    alone = ["bonds", "fault_weakening", "bond_healing", "sedimentation", "compaction"]

    def count(program, effects, folder):
        """Instructions and disc-steps from 50 to 100 m of extension. A resumed run neither makes a
        hanging wall nor measures this machine, which would not be repeatable."""
        words = [scene, "--output", folder / "run", "--threads", "1", "--quiet",
                 "--set", "extension.speed_m_per_s=2"]
        for effect in alone:
            words += [] if effect in effects else ["--without", effect]
        words += ["--set", "energy={}"] if "energy" in effects else []
        call(program, "run", *words, "--until", "50m", "--force")
        before = json.loads((folder / "run/summary.json").read_text())
        counted = instructions(program, "run", *words, "--resume", "--until", "100m")
        after = json.loads((folder / "run/summary.json").read_text())
        steps = (after["cycles"] - before["cycles"]) * (after["discs"] + before["discs"]) / 2
        return counted, steps

    build("x86-64-v3")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        # Pictures are made by a child, of which nothing is counted.
        os.environ["LISTRIC_PYTHON"] = "/bin/false"
        os.environ["XDG_CACHE_HOME"] = str(folder / "cache")

        def add(which, of, effects):
            counted, steps = count(of, effects, folder)
            rows.append(circumstances() | {
                "build": which, "effects": " ".join(["gravity", *effects]),
                "instructions": counted, "disc_steps": round(steps),
                "instructions_per_disc_step": f"{counted / steps:.1f}"})

        os.environ["LISTRIC_SHARE"] = str(ROOT / "apps")
        program = link("x86-64-v3", folder, [])
        add("without effects", link("x86-64-v3", folder, EFFECTS), [])
        for effects in ([], ["bonds"], ["bonds", "bond_healing"], ["fault_weakening"],
                        ["sedimentation"], ["sedimentation", "compaction"], ["energy"], alone):
            add("all", program, effects)
    record("effects", rows)


MEASUREMENTS = {"cycle": measure_cycle, "neighbours": measure_neighbours, "runs": measure_runs,
                "instructions": measure_instructions, "effects": measure_effects}

if __name__ == "__main__":
    wanted = sys.argv[1:] or list(MEASUREMENTS)
    for name in wanted:
        if name not in MEASUREMENTS:
            sys.exit(__doc__)
    for name in wanted:
        MEASUREMENTS[name]()
