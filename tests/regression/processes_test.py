"""What the program does with signals, streams and files that are no regular ones, and with what starts it."""

import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import NO_FIGURES, PROGRAM

SCENE = """[hanging_wall]
length_m = 8000.0
thickness_m = 2000.0
mean_radius_m = 150.0
[detachment]
start_dip_deg = 60.0
segments = [{arc = {radius_m = 4000.0, end_dip_deg = 0.0}}, {line = {length_m = 15000.0}}]
[extension]
distance_m = 100000.0
speed_m_per_s = 0.5
[gravity]
[bonds]
[output]
interval_m = 20.0
figures_at_m = []
series = "none"
"""
PLAN = """scene = "./scene.toml"
measures = ["strain_top10"]
[[vary]]
parameter = "detachment.friction"
values = [0.1, 0.5]
"""
LONGEST = 60.0  # s


class Processes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cache = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.cache.cleanup)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "scene.toml").write_text(SCENE)
        (self.folder / "plan.toml").write_text(PLAN)
        self.environment = {**os.environ, **NO_FIGURES, "XDG_CACHE_HOME": self.cache.name}

    def call(self, *words, **other):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, env=self.environment, text=True,
                              stderr=subprocess.PIPE, timeout=LONGEST,
                              **{"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, **other})

    def run_words(self, *more):
        return ("run", "scene.toml", "--output", "out", "--no-report", "--quiet", "--threads", "1", *more)

    def begin(self, words, begun, ignored=()):
        """A call that has made a file, started where some signals are ignored."""
        def ignore():
            for number in ignored:
                signal.signal(number, signal.SIG_IGN)
        process = subprocess.Popen([PROGRAM, *words], cwd=self.folder, env=self.environment, preexec_fn=ignore,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for(lambda: process.poll() is not None or list(self.folder.glob(begun)))
        return process

    def wait_for(self, what):
        end = time.monotonic() + LONGEST
        while not what() and time.monotonic() < end:
            time.sleep(0.02)
        self.assertTrue(what())

    def snapshots(self):
        return len(list(self.folder.glob("out/snapshots/*.h5")))


class Signals(Processes):
    def test_what_was_ignored_at_the_start_stays_ignored(self):
        for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
            with self.subTest(number):
                run = self.begin(self.run_words("--force"), "out/snapshots/*.h5", ignored=(number,))
                before = self.snapshots()
                run.send_signal(number)
                self.wait_for(lambda: run.poll() is not None or self.snapshots() > before + 1)
                self.assertIsNone(run.poll(), "the signal has ended it")
                run.send_signal(signal.SIGINT if number != signal.SIGINT else signal.SIGTERM)
                run.wait(LONGEST)
                self.assertEqual(run.returncode, 130)

    def test_runs_of_a_sweep_that_was_started_with_nohup(self):
        sweep = self.begin(("sweep", "plan.toml", "--output", "out", "--jobs", "2"), "out/runs/*/snapshots/*.h5",
                           ignored=(signal.SIGHUP,))
        sweep.send_signal(signal.SIGHUP)
        count = len(list(self.folder.glob("out/runs/*/snapshots/*.h5")))
        self.wait_for(lambda: sweep.poll() is not None
                      or len(list(self.folder.glob("out/runs/*/snapshots/*.h5"))) > count + 3)
        self.assertIsNone(sweep.poll())
        sweep.send_signal(signal.SIGTERM)
        sweep.communicate(timeout=LONGEST)
        self.assertEqual(sweep.returncode, 130)

    def test_runs_of_a_sweep_end_with_it_where_sigterm_is_ignored(self):
        sweep = self.begin(("sweep", "plan.toml", "--output", "out", "--jobs", "2"), "out/runs/*/snapshots/*.h5",
                           ignored=(signal.SIGTERM,))
        runs = subprocess.run(["pgrep", "-P", str(sweep.pid)], stdout=subprocess.PIPE, text=True).stdout.split()
        self.assertEqual(len(runs), 2)
        sweep.kill()
        self.wait_for(lambda: not any(Path("/proc", number).exists() for number in runs))


class Streams(Processes):
    def test_a_reader_that_has_enough_is_no_error(self):
        for words in (("explain", "--parameters"), ("schema",), ("manual",), ("completion", "bash"), ("scenes",),
                      ("--help",), ("run", "--help"), ("--version",), ("check", "scene.toml")):
            with self.subTest(words):
                read, write = os.pipe()
                os.close(read)
                ended = self.call(*words, stdout=write)
                os.close(write)
                self.assertEqual((ended.returncode, ended.stderr), (0, ""))

    def test_a_reader_that_has_enough_does_not_make_wrong_scenes_right(self):
        read, write = os.pipe()
        os.close(read)
        (self.folder / "scene.toml").write_text(SCENE + "[compacton]\n")
        self.assertEqual(self.call("check", "scene.toml", stdout=write).returncode, 2)
        os.close(write)

    def test_an_output_that_is_full(self):
        for words in (("explain", "--parameters"), ("schema",), ("manual",), ("completion", "bash"), ("scenes",),
                      ("--help",), ("run", "--help"), ("--version",), ("check", "scene.toml")):
            with self.subTest(words), open("/dev/full", "w") as full:
                ended = self.call(*words, stdout=full)
                self.assertEqual(ended.returncode, 4)
                self.assertEqual(ended.stderr, "listric: standard output cannot be written\n")


class Files(Processes):
    def test_pipes_and_devices_are_refused(self):
        os.mkfifo(self.folder / "pipe.toml")
        for words in (("check",), ("run",), ("explain",), ("sweep",), ("validate", "--plan"), ("bench", "--packing"),
                      ("laboratory", "uniaxial")):
            for name in ("./pipe.toml", "/dev/zero"):
                with self.subTest(words=words, name=name):
                    ended = self.call(*words, name)
                    self.assertEqual(ended.returncode, 2)
                    self.assertIn(f"{name}: is no regular file", ended.stdout + ended.stderr)

    def test_a_standard_input_that_is_a_file_is_read(self):
        with open(self.folder / "scene.toml") as scene:
            self.assertEqual(self.call("check", "/dev/stdin", stdin=scene).returncode, 0)


class Launch(Processes):
    def test_one_process_is_one_whatever_the_environment_says(self):
        self.environment |= {"OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "1",
                             "LISTRIC_PYTHON": "/bin/true"}  # draws nothing, and lacks nothing to warn of
        ended = self.call(*self.run_words("--ranks=1", "--until", "0m"))
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertTrue((self.folder / "out/summary.json").exists())

    def test_an_environment_that_no_mpirun_makes(self):
        for count, mine in (("2", "2"), ("two", "0"), ("2x", "0"), ("0", "0"), ("2", "-1"), ("2", "\x1b[31m")):
            with self.subTest(count=count, mine=mine):
                self.environment |= {"PMI_SIZE": count, "PMI_RANK": mine}
                ended = self.call(*self.run_words())
                self.assertEqual(ended.returncode, 2)
                self.assertIn("which no mpirun or srun sets", ended.stderr)
                self.assertIn("--ranks=1", ended.stderr)
                self.assertNotIn("\x1b", ended.stderr)

    def test_half_of_an_environment_is_nothing(self):
        self.environment |= {"OMPI_COMM_WORLD_SIZE": "2", "SLURM_PROCID": "0", "PMI_SIZE": "", "PMI_RANK": "1"}
        self.assertEqual(self.call(*self.run_words("--until", "0m")).returncode, 0)


class Threads(Processes):
    def test_more_threads_than_cores_are_told_and_not_started(self):
        cores = len(os.sched_getaffinity(0))
        words = ("run", "scene.toml", "--output", "out", "--no-report", "--quiet", "--until", "4m")
        self.environment["LISTRIC_PYTHON"] = "/bin/true"  # draws nothing, and lacks nothing to warn of
        ended = self.call(*words, "--threads", str(cores + 62))
        self.assertEqual(ended.returncode, 0)
        self.assertIn(f"--threads {cores + 62}: here this program may use ", ended.stderr)
        self.assertEqual(self.call(*words, "--force", "--threads", "1").stderr, "")
        ended = self.call(*words, "--force", "--threads", "many")
        self.assertEqual(ended.returncode, 2)

    def test_a_process_may_be_kept_on_one_core(self):
        one = min(os.sched_getaffinity(0))
        ended = self.call("bench", "--discs", "100", "--steps", "10", "--threads", "2",
                          preexec_fn=lambda: os.sched_setaffinity(0, {one}))
        self.assertEqual(ended.returncode, 0)
        self.assertIn("may use 1 core, so 1 thread\n", ended.stderr)


if __name__ == "__main__":
    unittest.main()
