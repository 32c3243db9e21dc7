"""Disks that refuse locks or have no fsync, files that cannot be read, work of another version: a resume never begins
a run anew for these.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest shared_disks_test
"""

import errno
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from forged import made_by_another_version
from program import NO_FIGURES, PROGRAM, SOURCES

REFUSE = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
static int refused(const char* name) {
    const char* value = getenv(name);
    if (value)
        errno = atoi(value);
    return value != NULL;
}
int flock(int file, int operation) {
    int (*next)(int, int) = dlsym(RTLD_NEXT, "flock");
    return refused("LOCK") ? -1 : next(file, operation);
}
int fsync(int file) {
    int (*next)(int) = dlsym(RTLD_NEXT, "fsync");
    return refused("SYNC") ? -1 : next(file);
}
"""


class SharedDisks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "refuse.c").write_text(REFUSE)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", "refuse.so", "refuse.c", "-ldl"], cwd=cls.folder, check=True)
        cls.environment = {**os.environ, **NO_FIGURES, "XDG_CACHE_HOME": str(cls.folder / "cache")}
        cls.run_to("20m", "whole")

    @classmethod
    def run_to(cls, until, name, *words, code=0, before=(), refuse=None):
        """What a run says. `refuse` answers of calls that the disk does not have: {"LOCK": errno.ENOLCK}."""
        refused = {key: str(number) for key, number in (refuse or {}).items()}
        if refused:
            refused["LD_PRELOAD"] = str(cls.folder / "refuse.so")
        done = subprocess.run(
            [*before, PROGRAM, "run", "lis1", "--set", "hanging_wall.mean_radius_m=400", "--set",
             "output.interval_m=10", "--until", until, "--no-report", "--threads", "1", "-o", name, *words],
            cwd=cls.folder, env=cls.environment | refused, capture_output=True, text=True, stdin=subprocess.DEVNULL,
            check=False)
        assert done.returncode == code, f"{done.returncode}: {done.stderr}"
        return done.stderr

    def copy(self, name):
        """The whole run as if it had been stopped at its end, to be resumed beyond it."""
        shutil.copytree(self.folder / "whole", self.folder / name)
        return self.folder / name

    def test_a_disk_that_refuses_locks_is_read_all_the_same(self):
        for number in (errno.ENOLCK, errno.EOPNOTSUPP, 524, errno.ENOSYS):
            with self.subTest(number=number):
                name = f"lock-{number}"
                self.copy(name)
                said = self.run_to("30m", name, "--resume", refuse={"LOCK": number})
                self.assertIn("resuming at 20", said)
                self.assertNotIn("skipped", said)

    def test_a_disk_without_fsync_is_written_to_with_a_warning(self):
        for number in (errno.EINVAL, errno.EOPNOTSUPP, errno.ENOSYS):
            with self.subTest(number=number):
                said = self.run_to("10m", f"sync-{number}", refuse={"SYNC": number})
                self.assertEqual(said.count("does not say when a file is safe"), 1, said)
        said = self.run_to("10m", "sync-eio", code=4, refuse={"SYNC": errno.EIO})
        self.assertIn("cannot write", said)

    def test_a_snapshot_that_cannot_be_read_ends_the_resume(self):
        # Root may read anything but where it has given up that right.
        before = ("setpriv", "--bounding-set=-all") if os.geteuid() == 0 else ()
        run = self.copy("unreadable")
        newest = sorted((run / "snapshots").iterdir())[-1]
        newest.chmod(0)
        said = self.run_to("30m", "unreadable", "--resume", code=4, before=before)
        self.assertIn(f"{newest.name}: cannot be read: Permission denied", said)
        newest.chmod(0o600)
        (run / "snapshots").chmod(0)
        said = self.run_to("30m", "unreadable", "--resume", code=4, before=before)
        self.assertIn("snapshots: cannot be read: Permission denied", said)
        (run / "snapshots").chmod(0o700)
        self.assertIn("resuming at 20", self.run_to("30m", "unreadable", "--resume", before=before))

    def test_work_of_another_version_is_warned_of_and_recorded(self):
        run = self.copy("other")
        made_by_another_version(sorted((run / "snapshots").iterdir())[-1])
        said = self.run_to("30m", "other", "--resume")
        self.assertIn("warning: listric 0.1.0+deadbeef has made this run so far", said)
        provenance = json.loads((run / "summary.json").read_text())["provenance"]
        self.assertEqual(provenance["earlier_versions"], ["0.1.0+deadbeef"])
        self.assertIn("0.1.0+deadbeef", self.run_to("40m", "other", "--resume"))  # of the run's beginning, still
        cited = subprocess.run([PROGRAM, "cite", str(run)], capture_output=True, text=True, check=True).stdout
        self.assertIn("begun by 0.1.0+deadbeef", cited)
        own = json.loads((self.folder / "whole/summary.json").read_text())["provenance"]
        self.assertNotIn("earlier_versions", own)

    def test_unfinished_runs_are_compared_by_their_newest_states(self):
        for name in ("one", "two", "none"):
            (self.copy(f"cut-{name}") / "summary.json").unlink()

        def differ(first, second):
            done = subprocess.run([PROGRAM, "diff", first, second], cwd=self.folder, capture_output=True, text=True,
                                  check=False)
            return done.returncode, done.stdout + done.stderr
        code, said = differ("cut-one", "cut-two")
        self.assertEqual(code, 0, said)
        self.assertIn("the newest snapshots are compared", said)
        sorted((self.folder / "cut-two/snapshots").iterdir())[-1].unlink()
        code, said = differ("cut-one", "cut-two")
        self.assertEqual(code, 1, said)
        self.assertIn("state_hash", said)
        shutil.rmtree(self.folder / "cut-none/snapshots")
        code, said = differ("cut-none", "cut-none")
        self.assertEqual(code, 1, said)
        self.assertIn("nothing of its results", said)

    def test_an_interrupt_of_python_alone_reaches_the_program(self):
        script = ("import os, signal, threading, time, listric\n"
                  "threading.Timer(3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
                  "try:\n"
                  "    listric.simulate('lis1', set={'hanging_wall.mean_radius_m': 400}, threads=1, output='stopped')\n"
                  "except KeyboardInterrupt:\n"
                  "    print('stopped')\n")
        done = subprocess.run([sys.executable, "-c", script], cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=300, env=self.environment | {
                                  "PYTHONPATH": str(SOURCES / "apps/python"), "LISTRIC_PROGRAM": str(PROGRAM)})
        self.assertEqual(done.stdout, "stopped\n", done.stderr)
        self.assertEqual(json.loads((self.folder / "stopped/status.json").read_text())["phase"], "stopped")



if __name__ == "__main__":
    unittest.main()
