#!/usr/bin/python3
"""Faults at random moments of a run, each followed by a resume that must end with the bits of a whole run.

Usage: tests/faults/faults.py PROGRAM FOLDER FAULT NUMBER [SEED]

FAULT is one of
  kill    SIGKILL at a random moment; the resumed run is killed again, until it ends
  disk    a file system (tmpfs) of random size that becomes full, and is then enlarged; needs root
  read    a file system (ext4) that an error makes read-only at a random moment, so that what was not yet on the disk is
          lost, and that is then repaired; needs root and a loop device
  size    a limit of file sizes (RLIMIT_FSIZE), random: a write fails in the middle of a file
  memory  a limit of address space (RLIMIT_AS), random
  clock   clocks that jump back and forth by up to a year at every reading; needs a C compiler

Appends a row for each to FOLDER/faults.csv: fault, phase of the run at the fault, exit code, last line of
its message, exit code of the resumed run, whether its bits are equal. Exit code 1: a resumed run failed or has
other bits. The scene is the soak's, of 110 discs with every effect, shortened. No test of CI.
"""

import csv
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "tests/soak/soak.toml"
SET = ["extension.distance_m=60", "extension.speed_m_per_s=0.2", "output.interval_m=10", "output.report=true",
       "output.figures_at_m=[30, 60]"]
LONGEST_S = 600.0
CLOCK = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <time.h>
int clock_gettime(clockid_t id, struct timespec* t) {
    static int (*real)(clockid_t, struct timespec*);
    if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
    const int result = real(id, t);
    if (id == CLOCK_REALTIME) t->tv_sec += rand() % 63072000 - 31536000;
    return result;
}
time_t time(time_t* t) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (t) *t = now.tv_sec;
    return now.tv_sec;
}
"""
COLUMNS = ["fault", "phase", "exit_code", "message", "resumed_exit_code", "equal"]


class Faults:
    def __init__(self, program, folder, seed):
        self.program, self.folder = program, folder
        self.random = random.Random(seed)
        self.output, self.image = folder / "run", folder / "disk.img"
        drawer = folder / "python"
        drawer.write_text("#!/bin/sh\nsleep 0.3\nexit 1\n")  # pictures take longer than these runs
        drawer.chmod(0o755)
        self.environment = {**os.environ, "LISTRIC_PYTHON": str(drawer), "XDG_CACHE_HOME": str(folder / "cache")}

    def words(self):
        sets = [word for change in SET for word in ("--set", change)]
        return [self.program, "run", str(SCENE), *sets, "--threads", "1", "--quiet", "--resume", "--output",
                str(self.output)]

    def begin(self, limit=None, preload=None):
        environment = self.environment | ({"LD_PRELOAD": preload} if preload else {})
        return subprocess.Popen(self.words(), env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True,
                                preexec_fn=(lambda: resource.setrlimit(*limit)) if limit else None)

    def finish(self, process):
        """Exit code and last line of the message; fails if it does not end."""
        _, err = process.communicate(timeout=LONGEST_S)
        return process.returncode, (err.strip().splitlines() or [""])[-1][:200]

    def phase(self):
        try:
            return json.loads((self.output / "status.json").read_text())["phase"]
        except (OSError, ValueError, KeyError):
            return "before the first status" if self.output.exists() else "before the folder"

    def state_hash(self):
        try:
            return json.loads((self.output / "summary.json").read_text())["state_hash"]
        except (OSError, ValueError, KeyError):
            return None

    def whole(self):
        """State of a run in one go, and how long it takes."""
        begun = time.monotonic()
        code, message = self.finish(self.begin())
        if code:
            sys.exit(message)
        found, size = self.state_hash(), sum(file.stat().st_size for file in self.output.rglob("*") if file.is_file())
        shutil.rmtree(self.output)
        return found, time.monotonic() - begun, size

    def stopped_after(self, process, seconds, act):
        """Phase in which something is done to a process after a time; none: it had ended."""
        try:
            process.wait(seconds)
            return None
        except subprocess.TimeoutExpired:
            phase = self.phase()
            act(process)
            return phase

    def mount(self, fault, size):
        self.output.mkdir(exist_ok=True)
        if fault == "disk":
            options = ["-t", "tmpfs", "-o", f"size={int(self.random.uniform(4096, size))}", "none"]
        else:
            self.image.unlink(missing_ok=True)
            subprocess.run(["mkfs.ext4", "-q", str(self.image), "64M"], check=True, stderr=subprocess.DEVNULL)
            options = ["-o", "loop,errors=remount-ro", str(self.image)]
        subprocess.run(["mount", *options, str(self.output)], check=True)
        shutil.rmtree(self.output / "lost+found", ignore_errors=True)

    def remount(self, options):
        return subprocess.run(["mount", "-o", f"remount,{options}", str(self.output)], check=False,
                              stderr=subprocess.DEVNULL).returncode == 0

    def repair(self):
        self.unmount()
        subprocess.run(["e2fsck", "-fy", str(self.image)], check=False, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)  # its exit code says that it has repaired something
        subprocess.run(["mount", "-o", "loop", str(self.image), str(self.output)], check=True)

    def unmount(self):
        subprocess.run(["umount", str(self.output)], check=True)

    def one(self, fault, seconds, size):
        """Phase, exit code and message of a run with a fault."""
        if fault == "kill":
            process = self.begin()
            phase = self.stopped_after(process, self.random.uniform(0.0, 1.1 * seconds),
                                       lambda p: p.send_signal(signal.SIGKILL))
            return phase or "ended before", *self.finish(process)
        if fault == "read":
            process = self.begin()
            phase = self.stopped_after(process, self.random.uniform(0.0, 1.1 * seconds), lambda _: self.remount("abort"))
            return phase or "ended before", *self.finish(process)
        if fault == "clock":
            library = self.folder / "clock.so"
            if not library.exists():
                subprocess.run(["gcc", "-shared", "-fPIC", "-x", "c", "-", "-o", str(library), "-ldl"], input=CLOCK,
                               text=True, check=True)
            ended = self.finish(self.begin(preload=str(library)))
            return self.phase(), *ended
        limit = {"size": (resource.RLIMIT_FSIZE, int(self.random.uniform(1e3, 250e3))),
                 "memory": (resource.RLIMIT_AS, int(self.random.uniform(20e6, 1.2e9)))}.get(fault)
        ended = self.finish(self.begin(limit and (limit[0], (limit[1], limit[1]))))
        return self.phase(), *ended

    def run(self, fault, number, table):
        """Whether every resumed run ended with equal bits."""
        all_equal = True
        self.whole()  # makes the hanging wall, which later runs find
        expected, seconds, size = self.whole()
        print(f"whole run: {expected}, {seconds:.1f} s, {size} bytes", flush=True)
        with_mount = fault in ("disk", "read")
        for _ in range(number):
            # A killed run goes on from where it was; all others begin anew.
            if fault != "kill" or self.state_hash():
                if self.output.exists():
                    shutil.rmtree(self.output)
            if with_mount:
                self.mount(fault, size)
            try:
                phase, code, message = self.one(fault, seconds, size)
                if fault == "disk":
                    self.remount(f"rw,size={10 * size}")
                elif fault == "read":
                    self.repair()
                resumed = ""
                if fault != "kill" or self.state_hash():
                    resumed, _ = self.finish(self.begin())
                equal = self.state_hash() == expected if resumed != "" else ""
            finally:
                if with_mount:
                    self.unmount()
            table.writerow(dict(zip(COLUMNS, (fault, phase, code, message, resumed, equal))))
            all_equal = all_equal and (resumed == "" or (resumed == 0 and equal))
        if fault == "kill":
            code, message = self.finish(self.begin())
            equal = self.state_hash() == expected
            table.writerow(dict(zip(COLUMNS, (fault, "the last resume", code, message, code, equal))))
            all_equal = all_equal and code == 0 and equal
        return all_equal


def main(program, folder, fault, number, seed=1):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "faults.csv"
    is_new = not file.exists()
    with file.open("a", buffering=1) as out:
        table = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        if is_new:
            table.writeheader()
        return 0 if Faults(program, folder, seed).run(fault, number, table) else 1


if __name__ == "__main__":
    if len(sys.argv) not in (5, 6):
        sys.exit(__doc__)
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3], *map(int, sys.argv[4:])))
