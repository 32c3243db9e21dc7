#!/usr/bin/env python3
"""Looks for trouble until a time is over: crashes, reports of sanitizers, calls that do not end, exit codes
that nobody declares, refusals without a word, numbers that are none, other bits after a resume.

    python3 -B tests/fuzz/fuzz.py build/address/listric --seconds 600 --jobs 2

Kinds of cases, in turn: `scenes` from the declared parameters inside, at and beyond their ranges, with any
effects (check, explain); `runs` of small scenes; `damaged` inputs of all readers; `snapshots` with flipped
bytes; `sequences` of calls on one folder. The seed is the day's unless --seed gives one; the first line of
the log has it, and equal seeds make equal cases. What fails is shrunk and kept in --keep with its call.
LISTRIC_PYTHON=/bin/false spares the figures, which take most of a small run's time.
Exit code 1: something failed.
"""

import argparse
import collections
import concurrent.futures
import datetime
import json
import math
import random
import re
import shutil
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "stability"))
import damaged_inputs  # noqa: E402
import scenes  # noqa: E402
import shrink  # noqa: E402

# Kinds, and how many cases of each a round has: some take a hundred times as long as others.
SHARES = {"scenes": 4, "runs": 2, "damaged": 8, "snapshots": 4, "sequences": 1}
KINDS = tuple(SHARES)
LONGEST = {"check": 20.0, "explain": 20.0, "run": 60.0}   # s
EACH = 0.2   # s more for each further scene of a call
BRIEF = 30   # s that check forecasts for the program under test: small runs up to it are run
SLOWER = 5.0   # times the forecast, on a machine that became busy
LEAST = 1   # cases of each kind, however soon the time is over: else a busy machine finds nothing in nothing
SHRINKING = 60.0   # s after the end, for all that failed
RUN = ["--threads", "1", "--quiet", "--no-report"]
NUMBERLESS = (b" nan", b" inf ", b" -nan")


def finite(one):
    """Whether all numbers of JSON are numbers."""
    if isinstance(one, dict):
        return all(map(finite, one.values()))
    if isinstance(one, list):
        return all(map(finite, one))
    return not isinstance(one, float) or math.isfinite(one)


def forecast(line):
    """Seconds that `check` forecasts: "5 tables, about 175 discs, 3 s, ..."; infinite where it forecasts more."""
    found = re.search(r" discs[^,;]*, (\d+) s,", line)
    return int(found.group(1)) if found else math.inf


class Fuzzer:
    shrink_end = math.inf   # of time.monotonic()

    def __init__(self, program, scratch, keep, seed, batch):
        self.batch = batch   # scenes that one call checks
        self.runner = damaged_inputs.Runner(Path(program).resolve(), scratch, keep)
        self.maker = damaged_inputs.Maker(scenes.SOURCES / "tests/scenes/every-effect-begun")
        self.scratch, self.keep, self.seed = scratch, keep, seed
        self.count, self.codes = collections.Counter(), collections.defaultdict(collections.Counter)
        self.made = collections.Counter()   # cases by kind
        self.failures, self.hashes, self.lock = [], {}, threading.Lock()

    # ------------------------------------------------------------------------------ calls

    def call(self, words, folder, more=0.0):
        """What is wrong with a call, and its exit code; it may take so many more seconds than others."""
        return self.runner.call(words, folder, LONGEST.get(words[0], 60.0) + more)

    def checked(self, text, folder, words=("check",)):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "a.toml").write_text(text, encoding="utf-8")
        why, code, said = self.call([*words, "@a.toml"], folder)
        if not why and code == 0 and words[0] == "explain" and any(word in said for word in NUMBERLESS):
            why = "explain tells a number that is none"
        return why, code, said

    def run(self, text, folder, seconds=0):
        """What is wrong with a run of a scene, of which check forecasts the seconds, and its exit code."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        (folder / "a.toml").write_text(text, encoding="utf-8")
        why, code, said = self.call(["run", "@a.toml", "--output", "@out", *RUN], folder, SLOWER * seconds)
        if not why and code == 0:
            summary = json.loads((folder / "out/summary.json").read_text(encoding="utf-8"))
            if not summary.get("finished") or not finite(summary):
                why = "summary.json is not that of a finished run with numbers"
        return why, code, said

    # ------------------------------------------------------------------------------ kinds

    def scenes(self, number, folder):
        """Scenes, a batch to a call of check; those that fail are checked alone, and one is explained."""
        made = [scenes.make_scene(random.Random(f"{self.seed}:scenes:{number}:{k}")) for k in range(self.batch)]
        correct = self.correct_ones(made, number, folder, "scenes")
        self.add("valid scenes", len(correct))
        explained = made[number % self.batch]
        first = self.checked(scenes.to_toml(explained), folder, ("explain",))
        self.add("explained", 1)
        self.tell("explained", first[1])
        if first[0] and not self.shrunk_scene(explained, number, ("explain",)):
            self.fail(f"explain-once-{number}", first, {"a.toml": scenes.to_toml(explained).encode()},
                      [["explain", "a.toml"]])

    def correct_ones(self, made, number, folder, what):
        """What one call of check says of the valid scenes, by number; where it fails each is checked alone, and
        if none fails, the batch has."""
        files = {f"{k}.toml": scenes.to_toml(scene).encode() for k, scene in enumerate(made)}
        damaged_inputs.write(folder, files)
        why, code, said = self.call(["check", *(f"@{name}" for name in files)], folder, EACH * (len(made) - 1))
        self.add(what, len(made))
        self.tell(f"checks of {what}", code)
        if why and not any([self.shrunk_scene(scene, f"{what}-{number}-{k}", ("check",)) for k, scene in enumerate(made)]):
            self.fail(f"check-{what}-{number}", (why, code, said), files, [["check", *files]])
        found = re.findall(r"(\d+)\.toml: correct: (.*)", said.decode("utf-8", "replace"))
        return {int(k): line for k, line in found}

    def shrunk_scene(self, scene, name, words):
        """Whether a scene fails; it is kept as small as it does."""
        folder = self.scratch / f"shrink-{words[0]}-{name}-{threading.get_ident()}"
        first = self.checked(scenes.to_toml(scene), folder, words)
        if not first[0]:
            return False
        smallest = shrink.shrink_scene(scene, lambda s: self.checked(scenes.to_toml(s), folder, words)[0] == first[0],
                                       scenes.BASE, end=self.shrink_end)
        self.fail(f"{words[0]}-{name}", first, {"a.toml": scenes.to_toml(smallest).encode()}, [[*words, "a.toml"]])
        return True

    def runs(self, number, folder):
        """Small scenes, a third of a batch: those that are valid and brief by the forecast of check are run."""
        made = [scenes.make_scene(random.Random(f"{self.seed}:runs:{number}:{k}"), share_beyond=0.0, small=True)
                for k in range(max(1, self.batch // 3))]
        correct = self.correct_ones(made, number, folder, "runs")
        brief = {k: seconds for k, seconds in zip(correct, map(forecast, correct.values())) if seconds <= BRIEF}
        self.add("not run", len(made) - len(brief))
        for k, seconds in brief.items():
            self.run_one(made[k], seconds, f"{number}-{k}", folder)

    def run_one(self, scene, seconds, name, folder):
        why, code, said = self.run(scenes.to_toml(scene), folder / "run", seconds)
        self.add("ran to the end", code == 0)
        self.tell("runs", code)
        if why:
            smallest = shrink.shrink_scene(scene, lambda s: self.run(scenes.to_toml(s), folder / "run", seconds)[0] == why,
                                           scenes.BASE, budget=40, end=self.shrink_end)
            self.fail(f"run-{name}", (why, code, said), {"a.toml": scenes.to_toml(smallest).encode()},
                      [["run", "a.toml", "--output", "out", *RUN]])

    def damaged(self, number, folder, readers=None):
        names = readers or [r for r in damaged_inputs.SHARES if r not in ("explained", "snapshot", "underlay")]
        chance = random.Random(f"{self.seed}:damaged:{number}")
        reader = chance.choices(names, [damaged_inputs.SHARES[r] for r in names])[0]
        files, calls = getattr(self.maker, reader)(chance)
        damaged_inputs.write(folder, files)
        self.add("snapshots" if readers else "damaged files", 1)
        for k, words in enumerate(calls):
            result = self.call(words, folder)
            self.tell("snapshots" if readers else "damaged files", result[1])
            if result[0]:
                self.shrunk_files(f"{reader}-{number}-{k}", files, words, result, folder)

    def shrunk_files(self, name, files, words, first, folder):
        """With the damaged text as short as it fails; snapshots stay whole."""
        damaged = next((n for n in files if n.startswith("a.") and len(files[n]) < 100_000), None)
        if damaged:
            def fails(data):
                (folder / damaged).write_bytes(data)
                return self.call(words, folder)[0] == first[0]
            files = files | {damaged: shrink.shrink_text(files[damaged], fails, end=self.shrink_end)}
        self.fail(name, first, files, [words])

    def snapshots(self, number, folder):
        self.damaged(number, folder, ["snapshot"])

    def sequences(self, number, folder):
        """Calls on one folder in any order; a run that is resumed to its end has the bits of one in one go."""
        chance = random.Random(f"{self.seed}:sequences:{number}")
        text = damaged_inputs.SCENE.replace("distance_m = 200.0", "distance_m = 100.0").replace(
            "seed = 3", f"seed = {chance.randrange(1, 4)}").replace("figures_at_m = [100.0]", "figures_at_m = []")
        (folder / "a.toml").write_text(text, encoding="utf-8")
        steps = [["run", "@a.toml", "--output", "@out", *RUN, *more] for more in (
            ["--until", "25m"], ["--until", "50m", "--resume"], ["--resume"], ["--force", "--until", "10m"],
            ["--resume", "--until", "75m"], [], ["--until", "0m", "--resume"])]
        others = [["check", "@out/scene.toml"], ["export", "horizons", "@out"], ["export", "faults", "@out"],
                  ["report", "@out", "--output", "@r.html"], ["diff", "@out", "@out"], ["cite", "@out"],
                  ["explain", "@out/scene.toml", "--threads", "1"]]
        calls = [chance.choice(steps if chance.random() < 0.6 else others) for _ in range(chance.randrange(2, 7))]
        calls.append(steps[2])

        def fails(kept):
            shutil.rmtree(folder / "out", ignore_errors=True)
            for words in kept:
                result = self.call(words, folder)
                self.tell("sequences", result[1])
                if result[0]:
                    return result
            if words == steps[2] and result[1] != 0:   # what was interrupted in whatever way can go on
                return (f"exit code {result[1]} of the last call, --resume", *result[1:])
            return None

        result = fails(calls)
        self.add("sequences", 1)
        if not result:
            result = self.other_bits(text, folder)
        if result:
            shorter = shrink.shrink_list(calls, lambda kept: (fails(kept) or [None])[0] == result[0], 20, self.shrink_end)
            self.fail(f"sequence-{number}", result, {"a.toml": text.encode()}, shorter)

    def other_bits(self, text, folder):
        """What is wrong where the bits of the sequence's run are not those of a run in one go."""
        if not (folder / "out/summary.json").exists():
            return "no summary.json after a run to its end", 0, b""
        with self.lock:
            known = self.hashes.get(text)
        if known is None:
            why, code, said = self.run(text, folder / "whole")
            if why or code != 0:
                return why or f"exit code {code}", code, said
            known = self.hash_in(folder / "whole/out")
            with self.lock:
                self.hashes[text] = known
        found = self.hash_in(folder / "out")
        return (f"bits {found} after resumes, {known} in one go", 0, b"") if found != known else None

    @staticmethod
    def hash_in(output):
        return json.loads((output / "summary.json").read_text(encoding="utf-8"))["state_hash"]

    # ------------------------------------------------------------------------------ account

    def add(self, what, number):
        with self.lock:
            self.count[what] += int(number)

    def tell(self, what, code):
        with self.lock:
            self.codes[what][code] += 1

    def fail(self, name, first, files, calls):
        why, _, said = first
        kept = self.keep / name
        kept.mkdir(parents=True, exist_ok=True)
        damaged_inputs.write(kept, files)
        (kept / "call.txt").write_text("\n".join(" ".join(map(str, words)) for words in calls) + f"\n{why}\n",
                                       encoding="utf-8")
        (kept / "said.txt").write_bytes(said[-20_000:])
        with self.lock:
            self.failures.append((name, why))
        print(f"{name}: {why}: {kept}", flush=True)

    def case(self, kind, number):
        folder = self.scratch / f"{kind}-{number}"
        folder.mkdir(parents=True, exist_ok=True)
        try:
            getattr(self, kind)(number, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def carry_out(self, seconds, jobs, kinds, most=10 ** 9):
        """Cases of all kinds in turn until the time is over and each kind had one, or there were so many turns."""
        end = time.monotonic() + seconds
        self.shrink_end = end + SHRINKING

        def begins(kind):
            """Whether one more case of a kind may begin; it is counted."""
            with self.lock:
                if time.monotonic() > end and self.made[kind] >= LEAST:
                    return False
                self.made[kind] += 1
                return True

        def work(first):
            for turn in range(first, most, jobs):
                for kind in kinds:
                    for number in range(turn * SHARES[kind], (turn + 1) * SHARES[kind]):
                        if not begins(kind):
                            break
                        self.case(kind, number)
                if time.monotonic() > end:   # each kind has had its turn
                    return

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for done in [pool.submit(work, first) for first in range(jobs)]:
                done.result()

    def account(self):
        lines = [", ".join(f"{what} {number}" for what, number in self.count.items())]
        for what, codes in self.codes.items():
            lines.append(f"{what}, calls by exit code: "
                         + ", ".join(f"{code} {number}" for code, number in sorted(codes.items(), key=str)))
        return "\n".join(lines + [f"{len(self.failures)} failures"])


def seed_of_the_day():
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")


def fuzz(program, seconds, seed, jobs=1, kinds=KINDS, keep=None, most=10 ** 9, batch=12):
    """Returns the fuzzer, which has what failed."""
    with tempfile.TemporaryDirectory(prefix="fuzz-") as scratch:
        fuzzer = Fuzzer(program, Path(scratch), Path(keep or Path(scratch) / "kept").absolute(), seed, batch)
        fuzzer.carry_out(seconds, jobs, kinds, most)
        return fuzzer


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--seed", default=None, help="a word or a number; without it the day's")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", nargs="*", choices=KINDS)
    parser.add_argument("--batch", type=int, default=12, help="scenes that one call checks")
    parser.add_argument("--keep", default="fuzz-failures")
    call = parser.parse_args()
    seed = call.seed or seed_of_the_day()
    print(f"fuzz: seed {seed}, {call.seconds:g} s, {call.jobs} at a time, {call.program}", flush=True)
    begun = time.monotonic()
    fuzzer = fuzz(call.program, call.seconds, seed, call.jobs, call.only or KINDS, call.keep, batch=call.batch)
    print(f"{fuzzer.account()} in {time.monotonic() - begun:.0f} s")
    return 1 if fuzzer.failures else 0


if __name__ == "__main__":
    sys.exit(main())
