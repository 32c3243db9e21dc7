#!/usr/bin/env python3
"""Damages inputs of every reader and looks for crashes, reports of sanitizers, exit code 70 and
calls that do not end; and for readers that refuse nothing, or say not in which file and where.

    cmake --preset address && cmake --build --preset address --target listric
    python3 -B tests/stability/damaged_inputs.py build/address/listric --cases 5000 --jobs 2

Equal seeds damage equally. What fails is kept with its call in --keep (damaged/); `--only READER`
takes some readers alone. Exit code 1: something failed. A test takes a few cases of a plain build
(damaged_inputs_test).
"""

import argparse
import collections
import concurrent.futures
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
LONGEST = 20.0  # s, of a case alone
EACH = 2.0  # s more for each further file of a call
ALLOWED = {0, 2, 3, 4, 130}
ALLOWED_OF = {"check": {0, 2}}  # it computes nothing that may go wrong, and writes nothing
PLACE = re.compile(rb"a\.\w+:\d+|at (?:byte|character) \d+")
NO_TEXT = ("snapshot", "json_of_run", "underlay")  # of which a refusal names the file alone
ACCEPTS = ("failed_sweep",)  # its file is no longer believed, and made again

SCENE = """description = "small, to be damaged"
seed = 3
[hanging_wall]
length_m = 4000.0
thickness_m = 1500.0
mean_radius_m = 110.0
radius_ratio = 1.66
[detachment]
start_dip_deg = 90.0
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 6000.0}}]
[extension]
distance_m = 200.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 50.0
figures_at_m = [100.0]
series = "none"
[gravity]
[bonds]
[fault_weakening]
interval_a = 6000.0
[bond_healing]
[sedimentation]
interval_a = 6000.0
target = [{time_a = 0.0, points = [[0.0, 0.0]]}, {time_a = 2e4, points = [[0.0, 0.0], [4e3, -300.0]]}]
[compaction]
"""
PICKED = """[hanging_wall]
length_m = 4000.0
mean_radius_m = 110.0
[detachment]
{keys}
[extension]
distance_m = 200.0
[output]
figures_at_m = []
[gravity]
[bonds]
{more}
"""
FAULT_CSV = "x_m,depth_m\n0,0\n200,600\n600,1100\n1200,1400\n2000,1500\n4000,1500\n"
TARGET_CSV = "time_a,x_m,y_m\n0,0,0\n0,4000,-100\n20000,0,0\n20000,4000,-300\n"
MOTION_CSV = "time_a,x_m,uplift_m\n0,0,0\n0,4000,0\n20000,0,50\n20000,4000,-30\n"
PICKS_CSV = 'name,x_m,depth_m,age_a\ntop,0,0,\ntop,1000,-20.5,\n"a, b",500,40,20000\n"a, b",900,50,20000\n'
POINTS_CSV = "x_m,depth_m,dx_m,ddepth_m\n" + "".join(
    f"{10 * i},{10 * j},{3 * (i > j)},{2 * (i > j)}\n" for i in range(12) for j in range(9))
SVG = """<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" width="400" height="200" viewBox="0 0 400 200">
<g transform="translate(10,5) rotate(1) scale(1.5 1)"><path id="other" d="M 1 1 h 5 z"/>
<path id="fault" transform="matrix(1 0 0 1 0 0)" d="m 0,0 c 10,60 30,100 60,120 q 20,15 60,20 l 100,10 h 60"/></g>
<rect x="1" y="2" width="3" height="4"/></svg>
"""
SVG_KEYS = ('svg = "{name}"\nsvg_path = "fault"\n'
            "svg_points = [[10.0, 5.0, 0.0, 0.0], [300.0, 160.0, 4000.0, 1500.0]]\n")
SWEEP = """scene = "{scene}"
seeds = 2
design = "latin-hypercube"
samples = 4
set = "extension.distance_m=100"
measures = ["strain_top10", "strain_top10@50"]
[[vary]]
parameter = "fault_weakening.friction"
range = [0.0, 0.2]
[[vary]]
parameter = "bonds.tensile_strength_pa"
values = [1e6, 2e6]
"""
VALIDATION = """[[run]]
name = "a"
scene = "{scene}"
set = "extension.distance_m=100"
seeds = 2
at_m = [50.0, 100.0]
[[experiment]]
name = "one"
title = "One"
runs = "a"
[[experiment.expect]]
measure = "strain_top10"
what = "strain"
at_m = 100.0
expected = 0.1
tolerance = 0.05
digits = 2
"""
MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
1 5 "detachment"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1000 0 0
3 1000 1000.5 0
4 0 1000 0
5 2e3 0 0
6 2000 1000 0
$EndNodes
$Elements
3
1 1 2 5 1 1 2
2 3 2 1 1 1 2 3 4
3 3 2 1 1 2 5 6 3
$EndElements
"""

NASTY = ["1e308", "-1e308", "1e-320", "-1", "0", "-0.0", "nan", "-nan", "inf", "-inf", "1e400", "1e5000",
         "9223372036854775807", "-9223372036854775808", "18446744073709551616", "99999999999999999999999",
         "4294967296", "2147483648", "65536", "0x7f", "1_000", "+5", "1,5", "1d3", "true", "\"\"", "''",
         "[]", "{}", "[[[[1]]]]", "\"a\"", "\x00", "\ufeff", "\x1b[31m", "é", "\u2028", "\U0001f600",
         "/dev/null", "../..", ".", "%s%n", "$x$", ",", ";", "\t", "\r", "\n", "\r\n", "\"", "'", "#", "=",
         "[" * 100_000, "{a=" * 50_000, "a." * 100_000, "(" * 50_000, "<g>" * 50_000, "1" * 5000,
         "M0 0" * 5000, "A1 1 0 0 1 5 5 " * 2000, "scale(1e300) " * 5, "matrix(1e300 0 0 1e300 0 0)"]
NUMBER = re.compile(rb"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
WORD = re.compile(rb"[A-Za-z_]+|[-+]?\d[\d.eE+-]*|[^\sA-Za-z_\d]")


def damage_text(data, chance):
    """One to four damages of a text."""
    for _ in range(chance.choice([1, 1, 1, 2, 4])):
        kind = chance.randrange(12)
        at = chance.randrange(len(data) + 1)
        nasty = chance.choice(NASTY).encode("utf-8", "surrogatepass")
        numbers, words = list(NUMBER.finditer(data)), list(WORD.finditer(data))
        if kind <= 3 and numbers:
            m = chance.choice(numbers)
            small = chance.choice([b"%d" % chance.randrange(-3, 12), b"%g" % (10 ** chance.uniform(-9, 12)),
                                   nasty, m.group() + b"e%d" % chance.randrange(-9, 20), b"-" + m.group()])
            data = data[:m.start()] + small + data[m.end():]
        elif kind == 4 and words:
            m = chance.choice(words)
            data = data[:m.start()] + nasty + data[m.end():]
        elif kind == 5 and len(words) > 1:
            m, n = sorted(chance.sample(words, 2), key=lambda w: w.start())
            data = (data[:m.start()] + n.group() + data[m.end():n.start()] + m.group() + data[n.end():])
        elif kind == 6:
            data = data[:at]
        elif kind == 7:
            lines = data.splitlines(keepends=True) or [b""]
            k = chance.randrange(len(lines))
            data = b"".join(lines[:k] + [lines[k]] * chance.choice([0, 2, 2, 3, 500]) + lines[k + 1:])
        elif kind == 8:
            data = data[:at] + nasty + data[at:]
        elif kind == 9:
            data = damage_bytes(data, chance)
        elif kind == 10:
            data = chance.choice([b"\xef\xbb\xbf" + data, data.replace(b"\n", b"\r\n"),
                                  data.replace(b"\n", b"\r"), data.replace(b",", b";"),
                                  data.replace(b".", b","), data.decode("utf-8", "replace").encode("utf-16"),
                                  data.replace(b"e", b"\xe9"), data + data, data[::-1]])
        elif words:
            m = chance.choice(words)
            data = data[:m.start()] + data[m.end():]
        if len(data) > 2_000_000:
            data = data[:2_000_000]
    return data


def damage_bytes(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice([1, 1, 2, 8, 64])):
        if not data:
            break
        at = chance.randrange(len(data))
        kind = chance.randrange(6)
        if kind <= 1:
            data[at] ^= 1 << chance.randrange(8)
        elif kind == 2:
            data[at] = chance.choice([0, 255, 127, 128, chance.randrange(256)])
        elif kind == 3:
            data[at:at + 8] = struct.pack("<q", chance.choice([-1, 0, 2 ** 62, 2 ** 31, 1 << chance.randrange(63)]))
        elif kind == 4:
            data[at:at + 8] = struct.pack("<d", chance.choice([1e308, float("nan"), -1.0, float("inf"), 1e18]))
        else:
            length = chance.randrange(1, 200)
            other = chance.randrange(len(data))
            data[at:at + length] = data[other:other + length]
    return bytes(data) if chance.random() < 0.9 else bytes(data[:chance.randrange(len(data) + 1)])


def png(width=4, height=3):
    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
    rows = b"".join(b"\0" + bytes(3 * width) for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def jpeg():
    """A grey JPEG of 8 x 8 pixels, its coefficients all 0."""
    def part(mark, body):
        return bytes([0xFF, mark]) + struct.pack(">H", len(body) + 2) + body
    table = bytes([1] + 15 * [0] + [0])            # one code, of one bit, for one value
    return (b"\xff\xd8" + part(0xDB, bytes(1) + bytes(64 * [1])) + part(0xC0, struct.pack(">BHHBBBB", 8, 8, 8, 1, 1, 0x11, 0))
            + part(0xC4, b"\x00" + table) + part(0xC4, b"\x10" + table) + part(0xDA, b"\1\1\0\0\x3f\0") + b"\x3f\xff\xd9")


Case = collections.namedtuple("Case", "reader number files calls batch")
# files: {name: bytes} in the case's folder; calls: words, "@name" is a file of the case; batch: whether
# its one call is `check` of a file, which takes many.


class Maker:
    """Makes cases; a run's folder is the base of those that damage results."""

    def __init__(self, run):
        self.run = {p.relative_to(run).as_posix(): p.read_bytes() for p in sorted(run.rglob("*"))
                    if p.is_file() and p.suffix in (".toml", ".h5", ".json", ".csv")}

    def picked(self, keys, more=""):
        return PICKED.format(keys=keys, more=more).encode()

    def scene(self, chance):
        return {"a.toml": damage_text(SCENE.encode(), chance)}, [["check", "@a.toml"]]

    def long_scene(self, chance):
        source = chance.choice(sorted((SOURCES / "apps/scenes").glob("*.toml")) + [
            SOURCES / "tests/scenes/every-effect.toml", SOURCES / "tests/scenes/every-effect-begun/scene.toml"])
        return {"a.toml": damage_text(source.read_bytes(), chance)}, [["check", "@a.toml"]]

    def explained(self, chance):
        files, _ = self.scene(chance)
        assignment = damage_text(b"hanging_wall.mean_radius_m=110", chance).replace(b"\0", b"?")
        return files, [["explain", "@a.toml"],
                       ["check", "@a.toml"] if chance.random() < 0.5 else
                       ["explain", "lis1", "--set", os.fsdecode(assignment)[:100_000]]]

    def begun(self, chance):
        files, _ = self.scene(chance)
        return files, [["run", "@a.toml", "--until", "0m", "--no-report", "--quiet", "--output", "@out"]]

    def material(self, chance):
        source = chance.choice(sorted((SOURCES / "apps/materials").glob("*.toml")))
        return {"a.toml": damage_text(source.read_bytes(), chance)}, [["check", "@a.toml"]]

    def fault_csv(self, chance):
        return {"a.toml": self.picked('csv = "a.csv"'), "a.csv": damage_text(FAULT_CSV.encode(), chance)}, [
            ["check", "@a.toml"]]

    def target_csv(self, chance):
        text = SCENE[:SCENE.index("target =")] + 'target_csv = "a.csv"\n'
        return {"a.toml": text.encode(), "a.csv": damage_text(TARGET_CSV.encode(), chance)}, [["check", "@a.toml"]]

    def motion_csv(self, chance):
        text = SCENE + '[base_motion]\ncsv = "a.csv"\n'
        return {"a.toml": text.encode(), "a.csv": damage_text(MOTION_CSV.encode(), chance)}, [["check", "@a.toml"]]

    def picks_csv(self, chance):
        text = SCENE + '[observed]\nhorizons = "a.csv"\nfaults = "a.csv"\n'
        return {"a.toml": text.encode(), "a.csv": damage_text(PICKS_CSV.encode(), chance)}, [["check", "@a.toml"]]

    def svg(self, chance):
        return {"a.toml": self.picked(SVG_KEYS.format(name="a.svg")),
                "a.svg": damage_text(SVG.encode(), chance)}, [["check", "@a.toml"]]

    def sweep_plan(self, chance):
        return {"s.toml": SCENE.encode(), "a.toml": damage_text(SWEEP.format(scene="s.toml").replace(
            '"s.toml"', '"./s.toml"').encode(), chance)}, [["check", "@a.toml"]]

    def validation_plan(self, chance):
        return {"a.toml": damage_text(
            VALIDATION.format(scene="lis1").encode(), chance)}, [["check", "@a.toml"]]

    def mesh(self, chance):
        text = SCENE + '[elastic_base]\nmesh_file = "a.msh"\n'
        return {"a.toml": text.encode(), "a.msh": damage_text(MESH.encode(), chance)}, [["check", "@a.toml"]]

    def points(self, chance):
        return {"a.csv": damage_text(POINTS_CSV.encode(), chance)}, [["trace", "@a.csv"]]

    def damaged_run(self, name, data):
        files = {f"run/{k}": v for k, v in self.run.items()}
        files[f"run/{name}"] = data
        return files

    def of_run(self, chance):
        return chance.choice([["report", "@run", "--output", "@r.html"], ["export", "horizons", "@run"],
                              ["export", "faults", "@run", "--format", "geojson"],
                              ["export", "discs", "@run", "--format", "csv,gsd"], ["figures", "@run"],
                              ["run", "@run/scene.toml", "--until", "0m", "--resume", "--quiet", "--no-report",
                               "--output", "@run"]])

    def snapshot(self, chance):
        name = chance.choice([n for n in self.run if n.endswith(".h5")])
        return self.damaged_run(name, damage_bytes(self.run[name], chance)), [self.of_run(chance)]

    def json_of_run(self, chance):
        name = chance.choice(["summary.json", "status.json", "failure.json", "scene.toml", "history.csv"])
        data = self.run.get(name, b'{"exit_code": 3, "reason": "why", "finished": true, "extension_m": 0.0, "scene": "a"}')
        return self.damaged_run(name, damage_text(data, chance)), [self.of_run(chance)]

    def failed_sweep(self, chance):
        name = chance.choice(["failure.json", "summary.json"])
        data = damage_text(b'{"exit_code": 3, "reason": "why", "finished": true, "extension_m": 0.0}', chance)
        other = b'{"exit_code": 3, "reason": "it ran away"}'
        plan = SWEEP.format(scene="./s.toml").replace("seeds = 2", "seeds = 1").replace("samples = 4", "samples = 2")
        files = {"s.toml": SCENE.encode(), "a.toml": plan.encode()}
        for run in ("0001-seed=1", "0002-seed=1"):
            files[f"out/runs/{run}/failure.json"] = other
        files[f"out/runs/0001-seed=1/{name}"] = data
        # What is there is no longer believed; --task 9 of 9 makes none of the runs.
        return files, [["sweep", "@a.toml", "--quiet", "--output", "@out", "--threads", "1"]]

    def underlay(self, chance):
        files = {f"run/{k}": v for k, v in self.run.items()}
        files["a.png"] = damage_bytes(chance.choice([png(), jpeg()]), chance)
        return files, [[chance.choice(["report", "report", "report", "figures"]), "@run", "--underlay", "@a.png",
                        "--corners", "0,0,4000,1500"]]


SHARES = {"scene": 14, "long_scene": 8, "explained": 2, "begun": 1, "material": 8, "fault_csv": 7, "target_csv": 8,
          "motion_csv": 6, "picks_csv": 8, "svg": 9, "sweep_plan": 6, "validation_plan": 6, "mesh": 9, "points": 6,
          "snapshot": 4, "json_of_run": 3, "failed_sweep": 1, "underlay": 1}


def write(folder, files):
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def batch_of(cases):
    """One case of many, whose one call checks the files of all."""
    return Case(cases[0].reader, f"batch-{cases[0].number}",
                {f"{case.number}/{name}": data for case in cases for name, data in case.files.items()},
                [["check"] + [f"@{case.number}/{case.calls[0][1][1:]}" for case in cases]], True)


class Runner:
    def __init__(self, program, scratch, keep):
        self.program, self.scratch, self.keep = str(program), scratch, keep
        self.environment = dict(
            os.environ, XDG_CACHE_HOME=str(scratch / "cache"), MPLCONFIGDIR=str(scratch / "cache"),
            ASAN_OPTIONS="detect_leaks=0:max_allocation_size_mb=4096:handle_abort=1:disable_coredump=1",
            UBSAN_OPTIONS="print_stacktrace=1", OMP_NUM_THREADS="1")
        self.failures, self.codes = [], collections.Counter()
        self.refused, self.placed = collections.Counter(), collections.Counter()  # by reader

    def call(self, words, folder, longest):
        """What is wrong with a call; and its exit code."""
        allowed = ALLOWED_OF.get(words[0], ALLOWED)
        words = [self.program] + [str(folder / w[1:]) if w.startswith("@") else w for w in words]
        begun = time.monotonic()
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, cwd=folder, env=self.environment,
                                   start_new_session=True)
        try:
            said = process.communicate(timeout=longest)[0]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return f"no end in {time.monotonic() - begun:.0f} s", None, b""
        for word in (b"Sanitizer", b"runtime error:", b"internal error", b"Assertion", b"terminate called"):
            if word in said:
                return word.decode(), process.returncode, said
        if process.returncode not in allowed:
            return f"exit code {process.returncode}", process.returncode, said
        if process.returncode in (2, 3, 4) and not said.strip():
            return f"exit code {process.returncode} without a word", process.returncode, said
        return None, process.returncode, said

    def fail(self, case, folder, words, why, said):
        kept = self.keep / f"{case.reader}-{case.number}"
        kept.mkdir(parents=True, exist_ok=True)
        write(kept, case.files)
        (kept / "call.txt").write_text(" ".join(map(str, words))[:2000] + f"\n{why}\n")
        (kept / "said.txt").write_bytes(said[-20_000:])
        self.failures.append((case, why))
        print(f"{case.reader} {case.number}: {why}: {' '.join(words)[:120]}", flush=True)

    def add_refusal(self, reader, said):
        self.refused[reader] += 1
        self.placed[reader] += PLACE.search(said) is not None

    def tolerant(self, readers):
        """Readers that refuse nothing, and those that mostly do not say where, each with that."""
        return [(reader, "refuses nothing") for reader in readers
                if reader not in ACCEPTS and not self.refused[reader]] + [
            (reader, f"{self.placed[reader]} of {self.refused[reader]} refusals say where") for reader in readers
            if reader not in NO_TEXT and 2 * self.placed[reader] < self.refused[reader]]

    def alone(self, case):
        """Whether one of the case's calls failed."""
        failed = False
        folder = self.scratch / f"{case.reader}-{case.number}"
        write(folder, case.files)
        for words in case.calls:
            longest = LONGEST if words[0] != "run" else 3 * LONGEST
            why, code, said = self.call(words, folder, longest)
            self.codes[code] += 1
            # What computes may refuse by a parameter, whichever file has it.
            if not why and code == 2 and words[0] not in ("explain", "run", "sweep") and not any(
                    Path(name).name.encode() in said for name in case.files):
                why = "a refusal without the name of a file"
            if why:
                self.fail(case, folder, words, why, said)
                failed = True
            elif code in (2, 4):
                self.add_refusal(case.reader, said)
        shutil.rmtree(folder, ignore_errors=True)
        return failed

    def together(self, cases):
        """Files that one call checks; where it fails each is checked alone, and if none fails, the batch has."""
        batch = batch_of(cases)
        folder = self.scratch / f"{batch.reader}-{batch.number}"
        write(folder, batch.files)
        [words] = batch.calls
        why, code, said = self.call(words, folder, LONGEST + EACH * (len(cases) - 1))
        about = [[line for line in said.splitlines() if line.startswith(os.fsencode(f"{folder / word[1:]}:"))]
                 for word in words[1:]]
        refusals = [lines[0] for lines in about if lines and b": correct" not in lines[0]]
        if not why and not all(about):
            why = f"no line about {about.count([])} of {len(cases)} files"
        if not why and (code == 2) != bool(refusals):
            why = f"exit code {code}, but {len(refusals)} files refused"
        if not why:
            self.codes["checked"] += len(cases)
            for line in refusals:
                self.add_refusal(cases[0].reader, line)
        elif not any([self.alone(case) for case in cases]):
            self.fail(batch, folder, words, why, said)
        shutil.rmtree(folder, ignore_errors=True)

    def carry_out(self, cases, jobs):
        batches, singles = collections.defaultdict(list), []
        for case in cases:
            (batches[case.reader] if case.batch else singles).append(case)
        size = 12
        work = [(self.together, some[k:k + size]) for some in batches.values()
                for k in range(0, len(some), size)] + [(self.alone, case) for case in singles]
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for done in [pool.submit(function, argument) for function, argument in work]:
                done.result()


def make_cases(maker, count, seed, only=None):
    readers = {r: s for r, s in SHARES.items() if not only or r in only}
    total = sum(readers.values())
    cases = []
    for reader, share in readers.items():
        for number in range(max(1, round(count * share / total))):
            chance = random.Random(f"{seed}:{reader}:{number}")
            files, calls = getattr(maker, reader)(chance)
            batch = len(calls) == 1 and calls[0][0] == "check"
            cases.append(Case(reader, number, files, calls, batch))
    return cases


def carry_out(program, count, seed, jobs=1, only=None, keep=None):
    """Returns the runner, which has what failed."""
    with tempfile.TemporaryDirectory(prefix="damaged-") as scratch:
        scratch = Path(scratch)
        maker = Maker(SOURCES / "tests/scenes/every-effect-begun")
        runner = Runner(Path(program).resolve(), scratch, Path(keep or scratch / "kept"))
        runner.carry_out(make_cases(maker, count, seed, only), jobs)
        return runner


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", nargs="*", choices=list(SHARES))
    parser.add_argument("--keep", default="damaged")
    call = parser.parse_args()
    begun = time.monotonic()
    runner = carry_out(call.program, call.cases, call.seed, call.jobs, call.only, call.keep)
    codes = ", ".join(f"{k}: {v}" for k, v in sorted(runner.codes.items(), key=str))
    tolerant = runner.tolerant(call.only or SHARES)
    for reader, why in tolerant:
        print(f"{reader}: {why}")
    print(f"{call.cases} cases in {time.monotonic() - begun:.0f} s; calls by exit code: {codes}; "
          f"{len(runner.failures)} failures")
    return 1 if runner.failures or tolerant else 0


if __name__ == "__main__":
    sys.exit(main())
