"""Runs over MPI: the bits of one process on any number, whatever ends them, and never a hang.

    LISTRIC_PROGRAM=../../build/native/listric python3 -m unittest ranks_test
"""

import json
import os
import resource
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from program import NO_FIGURES, PROGRAM, SOURCES

# What an MPI that has started this process says to its own would confuse another; root may start one.
ENVIRONMENT = {name: value for name, value in os.environ.items()
               if not name.startswith(("OMPI_", "PMIX_", "PMI_"))} | NO_FIGURES
# mpirun says nothing of its own: of Open MPI 4, and 5.
ENVIRONMENT |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                "OMPI_MCA_orte_execute_quiet": "1", "PRTE_MCA_prte_execute_quiet": "1"}
MPIRUN = ["/usr/bin/mpirun", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1"]
LONGEST = 60.0  # s, until a run that something has ended is gone
LONG = "4km"  # takes seconds on any machine, so that what ends a run comes before its end
RESUMED = "500m"  # beyond the place where a run has been ended
needs_finite_elements = unittest.skipIf(os.environ.get("LISTRIC_FEM") == "0",
                                        "a build without finite elements")


def command(ranks, output, *words):
    return [*([*MPIRUN, "-n", str(ranks)] if ranks else []), PROGRAM, "run", *words, "--accuracy", "draft", "--output", output,
            "--quiet", "--no-report"]


def processes_of(output):
    """Numbers of the processes that run into a folder, the root's first."""
    listed = subprocess.run(["pgrep", "-f", f"^{PROGRAM} run .*{output}"], stdout=subprocess.PIPE, text=True)
    return [int(number) for number in listed.stdout.split()]


class Ranks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.environment = dict(ENVIRONMENT)

    def run_on(self, ranks, output, *words):
        """Runs to the end; 0 ranks: without mpirun of the test's own."""
        return subprocess.run(command(ranks, self.folder / output, *words), env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=10 * LONGEST)

    def summary(self, ranks, output, *words):
        ended = self.run_on(ranks, output, *words)
        self.assertEqual(ended.returncode, 0, ended.stdout)
        return json.loads(Path(self.folder, output, "summary.json").read_text())

    def assertSameBits(self, scene, extension, counts):
        whole = self.summary(0, "whole", scene, "--until", extension)
        self.assertEqual(whole["ranks"], 1)
        for count in counts:
            with self.subTest(ranks=count):
                shared = self.summary(count, f"on-{count}", scene, "--until", extension)
                self.assertEqual(shared["ranks"], count)
                self.assertEqual(shared["state_hash"], whole["state_hash"])

    def assertEndsWith(self, found, said, code, message):
        """One message, from one of the processes."""
        self.assertEqual(found, code, said)
        self.assertEqual(said.count("listric: "), 1, said)
        self.assertIn(message, said)

    def assertRefused(self, message, *words):
        ended = self.run_on(2, "out", *words)
        self.assertEndsWith(ended.returncode, ended.stdout, 2, message)

    def run_each(self, first, second, scene="lis1", folders=(".", "."), programs=(PROGRAM, PROGRAM), output=None):
        """Two processes with words of their own."""
        script = self.folder / "each.sh"
        output = output or self.folder / "out"
        script.write_text(f"""case $OMPI_COMM_WORLD_RANK in
            0) cd {folders[0]}; program={programs[0]}; words='{first}';;
            *) cd {folders[1]}; program={programs[1]}; words='{second}';;
            esac
            exec $program run {scene} --accuracy draft --until 4m --output {output} $words""")
        return subprocess.run([*MPIRUN, "-n", "2", "sh", script], cwd=self.folder,
                              env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=LONGEST)

    def ranks_of(self, output):
        """Numbers of the processes that mpirun has started, the root's first."""
        listed = subprocess.run(["pgrep", "-f", f"^{PROGRAM} run .*{self.folder / output} "],
                                stdout=subprocess.PIPE, text=True)
        parents = {int(number): Path(f"/proc/{number}/stat").read_text().rsplit(")", 1)[1].split()[1]
                   for number in listed.stdout.split()}
        return [number for number, parent in parents.items()
                if Path(f"/proc/{parent}/comm").read_text().strip() in ("mpirun", "prterun", "prted", "orted")]

    def assertGone(self):
        end = time.monotonic() + 10.0
        while processes_of(self.folder) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(processes_of(self.folder), [])

    def begin(self, ranks, output, *words, **other):
        """A run that has begun to extend."""
        run = subprocess.Popen(command(ranks, self.folder / output, *words), env=self.environment,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               start_new_session=True, **other)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.kill)
        first = self.folder / output / "snapshots"
        while run.poll() is None and not list(first.glob("*.h5")):
            time.sleep(0.05)
        time.sleep(0.2)
        return run


class SameBits(Ranks):
    def test_a_rigid_scene_on_any_number(self):
        self.assertSameBits("lis1", "120m", (1, 2, 3, 5))

    def test_a_ramp_and_a_flat(self):
        self.assertSameBits("rfr", "40m", (3,))

    @needs_finite_elements
    def test_an_elastic_base(self):
        self.assertSameBits("lis1-elastic", "40m", (2,))

    def test_more_ranks_than_discs_have_rows(self):
        few = ("--set", "hanging_wall.mean_radius_m=1000")
        whole = self.summary(0, "few", "lis1", "--until", "200m", *few)
        shared = self.summary(8, "few-on-8", "lis1", "--until", "200m", *few)
        self.assertEqual(shared["state_hash"], whole["state_hash"])

    def test_resumed_on_other_numbers(self):
        whole = self.summary(0, "whole", "lis1", "--until", "160m")
        steps = ((3, "40m"), (2, "80m"), (5, "120m"), (0, "160m"))
        for count, extension in steps:
            last = self.summary(count, "run", "lis1", "--until", extension, "--resume")
        self.assertEqual(last["state_hash"], whole["state_hash"])


class Ends(Ranks):
    @classmethod
    def setUpClass(cls):
        """The bits that a run must have which was ended and resumed."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(command(0, folder + "/whole", "lis1", "--until", RESUMED), env=ENVIRONMENT, check=True)
            cls.whole = json.loads(Path(folder, "whole/summary.json").read_text())["state_hash"]

    def assertResumes(self, ranks, *words):
        last = self.summary(ranks, "run", "lis1", "--until", RESUMED, "--resume", *words)
        self.assertEqual(last["state_hash"], self.whole)
        return last

    def test_what_is_refused(self):
        energies = self.folder / "energies.toml"
        energies.write_text((SOURCES / "apps/scenes/lis1.toml").read_text() + "\n[energy]\n")
        for words, message in ((("lis9",), "did you mean lis1?"),
                               (("lis1", "--set", "compacton.x=1"), "did you mean compaction?"),
                               ((energies,), "one process"), (("flexure",), "no discs")):
            with self.subTest(message):
                self.assertRefused(message, *words)

    def test_without_the_plug_in(self):
        self.environment["LISTRIC_RANKS_PLUGIN"] = "/nowhere.so"
        self.assertRefused("openmpi-bin", "lis1")
        self.assertEqual(self.summary(1, "one", "lis1", "--until", "0m")["ranks"], 1)

    def test_a_full_disk(self):
        run = self.begin(2, "run", "lis1", "--until", LONG)
        root = processes_of(self.folder / "run")[0]
        resource.prlimit(root, resource.RLIMIT_FSIZE, (100000, 100000))  # write() fails as on a full disk
        said, _ = run.communicate(timeout=LONGEST)
        self.assertEndsWith(run.returncode, said, 4, "resume with: ")

    def test_an_event_that_cannot_be_done(self):
        ended = self.run_on(2, "run", "lis1", "--set", "sedimentation.target=[{time_a=0, points=[[0, 0]]},"
                            " {time_a=1e4, points=[[0, 0]]},"
                            " {time_a=1.2e4, points=[[-9e4, 0], [-8e4, -3e4], [9e4, -3e4]]}]")
        self.assertEndsWith(ended.returncode, ended.stdout, 3, "below the whole hanging wall")

    def test_a_request_to_stop(self):
        run = self.begin(2, "run", "lis1", "--until", LONG)
        run.send_signal(signal.SIGUSR1)  # which mpirun hands on
        run.communicate(timeout=LONGEST)
        self.assertEqual(run.returncode, 130)
        self.assertEqual(processes_of(self.folder / "run"), [])
        self.assertEqual(json.loads((self.folder / "run/status.json").read_text())["phase"], "stopped")
        self.assertResumes(0)

    def test_ctrl_c_where_the_program_starts_mpirun(self):
        run = self.begin(0, "run", "lis1", "--until", LONG, "--ranks=2")
        os.killpg(run.pid, signal.SIGINT)  # as a terminal does
        run.communicate(timeout=LONGEST)
        self.assertEqual(run.returncode, 130)
        self.assertEqual(processes_of(self.folder / "run"), [])
        self.assertEqual(self.assertResumes(0, "--ranks=2")["ranks"], 2)

    def test_more_ranks_than_mpirun_starts(self):
        ended = self.run_on(0, "run", "lis1", "--ranks=1000")
        self.assertEndsWith(ended.returncode, ended.stdout, 2, "--oversubscribe -n 1000")

    def test_ranks_without_a_number_are_those_that_were_started(self):
        alone = self.summary(0, "alone", "lis1", "--until", "0m", "--ranks")
        self.assertEqual(alone["ranks"], 1)
        self.environment["LISTRIC_RANKS_PLUGIN"] = "/none"
        ended = self.run_on(0, "run", "lis1", "--ranks")
        self.assertEndsWith(ended.returncode, ended.stdout, 2, "plug-in for runs over MPI cannot be loaded")

    def test_a_number_of_ranks_that_is_none(self):
        for number in ("0", "-1", "two", "2.5"):
            ended = self.run_on(0, "run", "lis1", f"--ranks={number}")
            self.assertEndsWith(ended.returncode, ended.stdout, 2, f"--ranks={number}: a number of processes")

    def test_processes_that_were_called_differently(self):
        for change, message in (("--set detachment.friction=0.1", "another scene: detachment.friction 0.1 there, "),
                                ("--set gravity.acceleration_m_per_s2=1.62", "gravity.acceleration_m_per_s2 1.62 there"),
                                ("--seed 7", "seed 7 there, 1 here"),
                                ("--without fault_weakening", "[fault_weakening]"),
                                ("--until 50m", "another target: --until 50m there, 4m here"),
                                ("--output elsewhere", "another output: --output "),
                                ("--resume", "--resume yes there, no here"),
                                ("--set compacton.x=1", "process 1 cannot begin: "),
                                ("--bogus", "no option --bogus")):
            with self.subTest(change):
                ended = self.run_each("", change)
                self.assertEndsWith(ended.returncode, ended.stdout, 2, message)
                self.assertFalse((self.folder / "out").exists(), "work has begun")

    def test_one_scene_of_two_contents(self):
        """As of machines that do not see the same files."""
        (self.folder / "own").mkdir()
        text = (SOURCES / "apps/scenes/lis1.toml").read_text()
        (self.folder / "scene.toml").write_text(text)
        (self.folder / "own/scene.toml").write_text(text + "\n[energy]\n")
        ended = self.run_each("", "", scene="scene.toml", folders=(".", "own"))
        self.assertEndsWith(ended.returncode, ended.stdout, 2, "[energy] there, none here")
        (self.folder / "own/scene.toml").write_text(text)
        ended = self.run_each("", "", scene="scene.toml", folders=(".", "own"), output="relative")
        self.assertEndsWith(ended.returncode, ended.stdout, 2, "another output: --output ")

    def test_another_program(self):
        other = self.folder / "other"
        version = subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE, text=True).stdout.split()[1].encode()
        program = Path(PROGRAM).read_bytes()
        self.assertTrue(version in program, version)  # a failure would print the whole program
        other.write_bytes(program.replace(version, version[:-1] + b"#"))
        other.chmod(0o755)
        self.environment["LISTRIC_SHARE"] = str(SOURCES / "apps")
        ended = self.run_each("", "", programs=(PROGRAM, other))
        self.assertEndsWith(ended.returncode, ended.stdout, 2, "process 1 is another program: version ")

    def test_what_processes_may_differ_in(self):
        ended = self.run_each("--plain --threads 1", "--quiet --no-report")
        self.assertEqual(ended.returncode, 0, ended.stdout)

    def test_an_environment_that_mpirun_has_left(self):
        stale = subprocess.run(["/usr/bin/mpirun", "-n", "1", "env", "-0"], env=self.environment,
                               stdout=subprocess.PIPE, check=True).stdout.decode()
        left = dict(entry.split("=", 1) for entry in stale.split("\0") if "=" in entry)
        self.environment |= left | {"OMPI_COMM_WORLD_SIZE": "2"}
        ended = self.run_on(0, "run", "lis1", "--until", "0m")
        self.assertEndsWith(ended.returncode, ended.stdout, 2, "an mpirun that has ended")
        self.assertIn("--ranks=1", ended.stdout)
        self.assertEqual(self.summary(0, "one", "lis1", "--until", "0m", "--ranks=1")["ranks"], 1)
        self.environment["OMPI_COMM_WORLD_SIZE"] = "1"
        self.assertEqual(self.summary(0, "two", "lis1", "--until", "0m", "--ranks=2")["ranks"], 2)

    def test_a_starter_that_is_killed(self):
        run = self.begin(0, "run", "lis1", "--until", LONG, "--ranks=2")
        run.kill()
        run.wait()
        self.assertGone()
        self.assertEqual(json.loads((self.folder / "run/status.json").read_text())["phase"], "stopped")

    def test_a_process_that_the_starter_loses(self):
        run = self.begin(0, "run", "lis1", "--until", LONG, "--ranks=2")
        os.kill(self.ranks_of("run")[-1], signal.SIGKILL)
        said, _ = run.communicate(timeout=LONGEST)
        self.assertEqual(run.returncode, 130)
        # MPI of the other process may have a word on it, too.
        self.assertRegex(said, "(^|\n)listric: process [01] of 2 was ended by signal 9 .*; "
                               "resume with: .* --resume\n$")
        self.assertGone()

    def test_mpirun_is_interrupted_itself(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            run = self.begin(0, f"run-{number}", "lis1", "--until", LONG, "--ranks=2")
            mpirun = subprocess.run(["pgrep", "-P", str(run.pid), "mpirun"], stdout=subprocess.PIPE, text=True).stdout
            os.kill(int(mpirun), number)
            said, _ = run.communicate(timeout=LONGEST)
            self.assertEqual(run.returncode, 130, said)
            self.assertNotIn("does not start", said)
            self.assertGone()

    def test_nohup(self):
        run = self.begin(0, "run", "lis1", "--until", RESUMED, "--ranks=2",
                         preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        os.killpg(run.pid, signal.SIGHUP)
        said, _ = run.communicate(timeout=LONGEST)
        self.assertEqual(run.returncode, 0, said)

    def test_a_rank_that_is_killed(self):
        run = self.begin(3, "run", "lis1", "--until", LONG)
        os.kill(processes_of(self.folder / "run")[-1], signal.SIGKILL)
        begun = time.monotonic()
        run.communicate(timeout=LONGEST)
        self.assertNotEqual(run.returncode, 0)
        while processes_of(self.folder / "run") and time.monotonic() < begun + 5.0:
            time.sleep(0.05)
        self.assertEqual(processes_of(self.folder / "run"), [])
        self.assertResumes(2)


if __name__ == "__main__":
    unittest.main()
