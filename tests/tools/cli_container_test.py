#!/usr/bin/env python3
"""`tilepress run` on programs in namespaces, of other users, and with few or closed descriptors.

Usage: cli_container_test.py TILEPRESS GOLDEN_FOLDER LONELY_FRAMES [TEST...]"""
import glob
import os
import resource
import shutil
import subprocess
import sys

PROGRAM = os.path.abspath(sys.argv[3])
del sys.argv[3]

from cli_case import CliCase, COMMAND, GOLDEN, main, read_json, read_rows  # noqa: E402  (it reads sys.argv)

PROGRAM_STATUS, NOTHING = 7, 3
NOBODY = 65534


def allowed(*command):
    """Whether this machine lets us run something so."""
    try:
        return subprocess.run([*command, "true"], capture_output=True, check=False).returncode == 0
    except FileNotFoundError:
        return False


class ContainerCase(CliCase):
    def setUp(self):
        super().setUp()
        os.chmod(self.folder, 0o755)

    def need(self, *command):
        if not allowed(*command):
            self.skipTest(f"not permitted here: {' '.join(command)}")

    def run_folders(self):
        return sorted(glob.glob(self.path("out/lonely_frames-*")))

    def expect_run(self, folder, frames=6, state="finished", dumps=False):
        self.assertEqual([row["frame"] for row in read_rows(os.path.join(folder, "frames.csv"))],
                         [str(i) for i in range(frames)])
        run = read_json(os.path.join(folder, "run.json"))
        self.assertEqual((run["state"], run["counts"]["seen"], run["counts"]["captured"]), (state, frames, frames))
        expected = {"frames.csv", "schemes.csv", "presents.csv", "surfaces.csv", "run.json"}
        self.assertEqual(set(os.listdir(folder)), expected | ({"frames"} if dumps else set()))
        if dumps:
            self.assertEqual(sorted(os.listdir(os.path.join(folder, "frames"))), [f"0-{i:06}.png" for i in range(frames)])

    def capture(self, *wrapper, program=("6",), options=("--dump-frames", "every:1"), status=PROGRAM_STATUS):
        done = self.run_command("run", "-s", "dcp", *options, "-o", "out", "--", *wrapper, PROGRAM, *program)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(glob.glob(self.path("out/.*")), [], "the session folder goes with the launcher")
        return done.stderr.decode()


class Namespaces(ContainerCase):
    def expect_whole(self, *wrapper):
        self.need(*wrapper)
        said = self.capture(*wrapper)
        (folder,) = self.run_folders()
        self.expect_run(folder, dumps=True)
        self.assertIn("6 frames seen, 6 captured", said)
        self.assertNotIn("still running", said)

    def test_a_pid_namespace(self):
        self.expect_whole("unshare", "--pid", "--fork", "--mount-proc")

    def test_a_pid_namespace_without_its_own_proc(self):
        self.expect_whole("unshare", "--pid", "--fork")

    def test_a_user_namespace(self):
        self.expect_whole("unshare", "--user", "--map-root-user", "--pid", "--fork")

    def test_a_private_folder_for_temporary_files(self):
        self.need("unshare", "--mount")
        os.mkdir(self.path("tmp"))
        os.environ["TMPDIR"] = self.path("tmp")
        self.addCleanup(os.environ.pop, "TMPDIR")
        self.expect_whole("unshare", "--mount", "sh", "-c", 'mount -t tmpfs none "$TMPDIR" && exec "$@"', "sh")

    def test_a_program_of_another_user(self):
        os.mkdir(self.path("out"))
        os.chmod(self.path("out"), 0o777)
        self.expect_whole("setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups")

    def test_an_output_folder_of_another_user(self):
        if os.geteuid() != 0:
            self.skipTest("needs root")
        os.mkdir(self.path("out"), 0o755)
        os.chown(self.path("out"), NOBODY, NOBODY)
        self.expect_whole("setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups")

    def test_a_program_that_drops_its_privileges_between_two_frames(self):
        if os.geteuid() != 0:
            self.skipTest("needs root")
        os.mkdir(self.path("out"))
        os.chmod(self.path("out"), 0o777)
        self.capture(program=("6", "user"))
        (folder,) = self.run_folders()
        self.expect_run(folder, dumps=True)

    def test_equal_pids_in_one_folder_lose_no_run(self):
        wrapper = ("unshare", "--pid", "--fork", "--mount-proc")
        self.need(*wrapper)
        processes = [subprocess.Popen([COMMAND, "run", "-q", "-s", "dcp", "-o", "out", "--", *wrapper, PROGRAM, "6"],
                                      cwd=self.folder, stderr=subprocess.PIPE) for _ in range(6)]
        for process in processes:
            self.assertEqual(process.communicate(timeout=300)[1], b"")
            self.assertEqual(process.returncode, PROGRAM_STATUS)
        folders = self.run_folders()
        self.assertEqual(len(folders), 6)
        for folder in folders:
            self.expect_run(folder)

    def test_a_kill_inside_a_pid_namespace_is_no_end_of_the_launchers_child(self):
        self.need("unshare", "--pid", "--fork", "--mount-proc")
        self.capture("unshare", "--pid", "--fork", "--mount-proc", "sh", "-c", '"$@"; exit 5', "sh",
                     program=("6", "kill"), status=5)
        (folder,) = self.run_folders()
        self.assertEqual(read_json(os.path.join(folder, "run.json"))["state"], "ended")
        self.assertEqual(len(read_rows(os.path.join(folder, "frames.csv"))), 6)

    def test_a_launcher_that_cannot_see_the_session_says_so(self):
        self.need("unshare", "--mount")
        os.mkdir(self.path("out"))
        script = f'mount -t tmpfs none "{self.path("out")}" && "$@"; exit 0'
        done = self.run_command("run", "-o", "out", "--", "unshare", "--mount", "sh", "-c", script, "sh", PROGRAM, "3")
        self.assertEqual(done.returncode, NOTHING)
        said = done.stderr.decode()
        self.assertIn("eglSwapBuffers (link)", said)
        self.assertIn(f"could not write to the session folder in {self.path('out')}", said)
        self.assertNotIn("no process", said)

    def test_a_folder_that_the_program_may_not_write_is_named(self):
        wrapper = ("setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups")
        self.need(*wrapper)
        os.mkdir(self.path("out"), 0o755)
        said = self.capture(*wrapper)
        self.assertIn(f"{self.path('out')}: Permission denied", said)


class Descriptors(ContainerCase):
    def expect_clean(self, folder, lines):
        """No byte of the program in a file of the run, and none of ours in `lines` of the program."""
        for path in glob.glob(os.path.join(folder, "**"), recursive=True):
            if os.path.isfile(path):
                with open(path, "rb") as file:
                    self.assertNotIn(b"PROGRAM LINE", file.read(), path)
        for line in lines:
            self.assertTrue(line.startswith("PROGRAM LINE "), line)

    def test_a_program_that_closes_its_streams(self):
        for limit in ("64", "1024"):
            with self.subTest(limit=limit):
                self.capture("sh", "-c", f'ulimit -n {limit}; exec "$@"', "sh", program=("100", "close-streams"))
                (folder,) = self.run_folders()
                self.expect_run(folder, frames=100, dumps=True)
                self.expect_clean(folder, [])
                shutil.rmtree(folder)

    def test_a_program_started_with_closed_streams(self):
        command = [COMMAND, "run", "-q", "-s", "dcp", "-o", "out", "--", PROGRAM, "60", "close-streams"]
        done = subprocess.run(["sh", "-c", '"$@" <&- >&- 2>&-', "sh", *command], cwd=self.folder, check=False, timeout=300)
        self.assertEqual(done.returncode, PROGRAM_STATUS)
        (folder,) = self.run_folders()
        self.expect_run(folder, frames=60)
        self.expect_clean(folder, [])

    def test_the_child_finds_closed_streams_closed(self):
        command = [COMMAND, "run", "-q", "-o", "out", "--", "sh", "-c", 'ls -l /proc/$$/fd/ >"$0"; exit 4', self.path("seen")]
        done = subprocess.run(["sh", "-c", '"$@" <&- 2>&-', "sh", *command], cwd=self.folder, stdout=subprocess.DEVNULL,
                              check=False, timeout=300)
        self.assertEqual(done.returncode, 4)
        with open(self.path("seen"), encoding="utf-8") as file:
            listed = [line.split(" -> ")[0].split()[-1] for line in file if " -> " in line]
        self.assertNotIn("0", listed)
        self.assertNotIn("2", listed)

    def test_frames_with_closed_streams_keep_their_rows_whole(self):
        image = os.path.join(GOLDEN, "desktop", "000.png")
        command = [COMMAND, "frames", "-s", "dcp", "-o", "out", image]
        done = subprocess.run(["sh", "-c", '"$@" <&- >&- 2>&-', "sh", *command], cwd=self.folder, check=False, timeout=300)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(read_rows(self.path("out/frames.csv"))), 1)
        self.assertEqual(read_json(self.path("out/run.json"))["state"], "finished")

    def test_a_program_that_closes_every_descriptor_and_takes_their_numbers(self):
        self.capture(program=("100", "close-all", "lines"))
        (folder,) = self.run_folders()
        self.expect_run(folder, frames=100, dumps=True)
        with open(self.path("lines"), encoding="utf-8") as file:
            self.expect_clean(folder, file.read().splitlines())

    def test_a_program_with_few_descriptors(self):
        for limit in (3, 4, 6, 8, 16, 64, resource.getrlimit(resource.RLIMIT_NOFILE)[1]):
            with self.subTest(limit=limit):
                said = self.capture(program=("6", "descriptors", str(limit)), options=())
                for folder in self.run_folders():
                    run = read_json(os.path.join(folder, "run.json"))
                    if run["state"] == "finished":
                        self.expect_run(folder)
                    else:
                        self.assertIn("Too many open files", run["reason"])
                    shutil.rmtree(folder)
                if limit == 3:  # the engine itself cannot be opened
                    self.assertIn("Too many open files", said)
                else:
                    self.assertIn("6 frames seen, 6 captured", said)


if __name__ == "__main__":
    main()
