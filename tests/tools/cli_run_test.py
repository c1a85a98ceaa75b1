#!/usr/bin/env python3
"""`tilepress run` from the command line: what passes through, exit statuses, and what a kill leaves.

Usage: cli_run_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import glob
import json
import os
import signal
import subprocess
import time

from cli_case import CliCase, COMMAND, XServer, main, read_json, read_rows

USAGE, NOTHING, LAUNCHER, NOT_EXECUTABLE, NOT_FOUND = 2, 3, 125, 126, 127


class PassesThrough(CliCase):
    """Programs without GL: nothing captured, all else as if tilepress were not there."""

    def test_input_output_and_error(self):
        done = self.run_command("run", "-q", "--", "sh", "-c", "cat; echo err >&2; exit 4", stdin=b"in")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (4, b"in", b"err\n"))

    def test_arguments_after_the_dashes_as_they_are(self):
        done = self.run_command("run", "-q", "--", "printf", "%s|", "--frames", "9-3", "--", "-o", "a b")
        self.assertEqual(done.stdout, b"--frames|9-3|--|-o|a b|")

    def test_the_first_word_that_is_no_option_is_the_program(self):
        done = self.run_command("run", "-q", "sh", "-c", "exit 5")
        self.assertEqual(done.returncode, 5)

    def test_a_signal_as_128_plus_its_number(self):
        for number in (signal.SIGKILL, signal.SIGSEGV, signal.SIGTERM):
            done = self.run_command("run", "--", "sh", "-c", f"kill -{int(number)} $$")
            self.assertEqual(done.returncode, 128 + number)

    def test_an_earlier_preload_stays(self):
        done = self.run_command("run", "--", "sh", "-c", "echo $LD_PRELOAD",
                                env={"LD_PRELOAD": "libc.so.6", "ASAN_OPTIONS": "verify_asan_link_order=0"})
        self.assertTrue(done.stdout.decode().endswith("/libtilepress-preload.so:libc.so.6\n"), done.stdout)

    def test_sigterm_reaches_the_program(self):
        process = subprocess.Popen([COMMAND, "run", "-o", "out", "--", "sh", "-c",
                                    "trap 'echo caught; exit 6' TERM; echo ready; while :; do sleep 0.1; done"],
                                   cwd=self.folder, stdout=subprocess.PIPE)
        self.assertEqual(process.stdout.readline(), b"ready\n")
        process.terminate()
        self.assertEqual(process.stdout.read(), b"caught\n")
        self.assertEqual(process.wait(timeout=60), 6)
        process.stdout.close()

    def test_no_temporary_folder_stays(self):
        os.mkdir(self.path("tmp"))
        self.run_command("run", "--", "true", env={"TMPDIR": self.path("tmp")})
        self.assertEqual(os.listdir(self.path("tmp")), [])


class BadInput(CliCase):
    def test_a_missing_program_is_127(self):
        self.expect(NOT_FOUND, "no-such-program: not found", "run", "-o", "out", "--", "no-such-program")
        self.expect(NOT_FOUND, "./gone: No such file or directory", "run", "-o", "out", "--", "./gone")
        self.assert_absent("out")

    def test_a_program_that_cannot_be_executed_is_126(self):
        self.write("plain", b"text")
        self.expect(NOT_EXECUTABLE, "./plain: not executable", "run", "-o", "out", "--", "./plain")
        self.expect(NOT_EXECUTABLE, "/: is a folder", "run", "-o", "out", "--", "/")
        self.assert_absent("out")

    def test_a_missing_interpreter_is_127(self):
        self.write("script", b"#!/no/such/interpreter\n")
        os.chmod(self.path("script"), 0o755)
        self.expect(NOT_FOUND, "./script: its interpreter is missing", "run", "--", "./script")

    def test_an_output_folder_that_cannot_be_written_is_125(self):
        self.write("file", b"")
        self.expect(LAUNCHER, f"{self.path('file/out')}: Not a directory", "run", "-o", "file/out", "--", "true")
        self.expect(LAUNCHER, "/proc/out: No such file or directory", "run", "-o", "/proc/out", "--", "true")

    def test_usage_errors_are_one_line_and_start_nothing(self):
        touch = ["--", "touch", "started"]
        self.expect(USAGE, "--frames 9-3: reversed range 9-3", "run", "--frames", "9-3", *touch)
        self.expect(USAGE, "--on-full wait: must be block or drop", "run", "--on-full", "wait", *touch)
        self.assertEqual(self.run_command("run", "--seconds", "0", *touch).returncode, USAGE)
        self.assertEqual(self.run_command("run", "--rounds", "0", *touch).returncode, USAGE)
        self.expect(USAGE, "unknown option '--frob' (see tilepress run --help)", "run", "--frob", *touch)
        self.expect(USAGE, "unexpected argument 'frob' (see tilepress run --help)", "run", "frob", *touch)
        self.expect(USAGE, "no program given (see tilepress run --help)", "run")
        self.assertEqual(self.run_command("run", "-s", "zip", *touch).returncode, USAGE)
        self.assert_absent("started")

    def test_nothing_captured_is_3_and_says_what_was_looked_for(self):
        done = self.run_command("run", "-o", "out", "--", "true")
        lines = done.stderr.decode().splitlines()
        self.assertEqual(done.returncode, NOTHING)
        self.assertEqual(lines[0], "tilepress: true: no frame captured")
        self.assertIn("eglSwapBuffers", lines[1])
        self.assertIn("seen: nothing: no process that reaches the session folder", done.stderr.decode())
        self.assert_absent("out")


class Doctor(CliCase):
    def test_the_shim_is_tried_by_each_road(self):
        done = self.run_command("doctor", "--json", env={"DISPLAY": ""})
        self.assertEqual(done.returncode, 0, done.stderr)
        findings = json.loads(done.stdout)
        tried = [finding for finding in findings if finding["what"] == "capture"]
        self.assertEqual([finding["found"] for finding in tried], [True, True], tried)
        self.assertTrue(tried[0]["detail"].startswith("preloaded: 3 frames"), tried)
        dram = {finding["what"]: finding["detail"] for finding in findings if finding["what"].startswith("DRAM ")}
        self.assertEqual(list(dram), ["DRAM paper", "DRAM lpddr3", "DRAM lpddr4", "DRAM lpddr5"])
        self.assertTrue(dram["DRAM lpddr4"].startswith("burst 256 bits, 16 wires, 3200 MT/s; "), dram)
        self.assertRegex([finding["detail"] for finding in findings if finding["what"] == "Mesa"][0], r"^[0-9.]+")


class Captures(CliCase):
    """Debian's own GL programs under a private X server."""

    def test_every_frame_of_glmark2_es2_is_lossless(self):
        with XServer() as server:
            done = self.run_command("run", "-o", "out", "-s", "vdcp", "-s", "hdcp", "--verify", "--", "glmark2-es2", "--size",
                                    "320x240", "-b", "desktop:nframes=20:duration=100", env={"DISPLAY": server.display})
        self.assertEqual(done.returncode, 0, done.stderr)
        (folder,) = glob.glob(self.path("out/glmark2-es2-*"))
        run = read_json(os.path.join(folder, "run.json"))
        self.assertEqual((run["state"], run["exit_status"], run["api"]), ("finished", 0, "EGL"))
        self.assertEqual((run["counts"]["seen"], run["counts"]["captured"]), (20, 20))
        # 40 x 30 blocks, 19 frames after the warm-up, two schemes.
        self.assertEqual([(s["checked_blocks"], s["mismatched_blocks"]) for s in run["schemes"]], [(1200 * 19, 0)] * 2)
        self.assertEqual(len(read_rows(os.path.join(folder, "schemes.csv"))), 40)
        self.assertIn("20 frames seen, 20 captured, 320x240 RGBA8", done.stderr.decode())

    def test_frames_outside_the_selection_are_counted_not_captured(self):
        with XServer() as server:
            self.run_command("run", "-o", "out", "-s", "red", "--frames", "5-7", "--", "glmark2", "--size", "160x120", "-b",
                             "build:nframes=12:duration=100", env={"DISPLAY": server.display})
        (folder,) = glob.glob(self.path("out/glmark2-*"))
        counts = read_json(os.path.join(folder, "run.json"))["counts"]
        self.assertEqual((counts["seen"], counts["captured"], counts["skipped"]), (12, 3, 9))
        self.assertEqual([row["frame"] for row in read_rows(os.path.join(folder, "frames.csv"))], ["5", "6", "7"])

    def test_the_overhead_compares_runs_that_count_with_runs_that_capture(self):
        with XServer() as server:
            done = self.run_command("run", "--measure-overhead", "--rounds", "2", "-o", "out", "-s", "red", "--",
                                    "glmark2-es2", "--size", "160x120", "-b", "build:nframes=12:duration=100",
                                    env={"DISPLAY": server.display})
        self.assertEqual(done.returncode, 0, done.stderr)
        # Once more each round, but only the runs with the shim leave a folder.
        self.assertEqual(len(glob.glob(self.path("out/glmark2-es2-*"))), 2)
        rows = read_rows(self.path("out/overhead.csv"))
        self.assertEqual([(row["round"], row["shim"]) for row in rows],
                         [("1", "without"), ("1", "with"), ("2", "with"), ("2", "without")])
        for row in rows:
            self.assertEqual((row["frames"], row["exit_status"]), ("12", "0"))
            self.assertGreater(int(row["mean_ns"]), 0)
            self.assertGreaterEqual(int(row["p95_ns"]), int(row["median_ns"]))
        for number in ("1", "2"):
            without, with_shim = ([row for row in rows if (row["round"], row["shim"]) == (number, side)][0]
                                  for side in ("without", "with"))
            self.assertEqual(without["ratio_mean"], "")
            self.assertAlmostEqual(float(with_shim["ratio_mean"]), int(with_shim["mean_ns"]) / int(without["mean_ns"]), 4)
        self.assertIn("frame-time ratio", done.stderr.decode())

    def test_a_program_without_end_is_ended_after_its_seconds(self):
        with XServer() as server:
            done = self.run_command("run", "--measure-overhead", "--rounds", "1", "--seconds", "2", "-q", "-o", "out",
                                    "-s", "red", "--", "glxgears", env={"DISPLAY": server.display})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("frame-time ratio", done.stderr.decode())
        self.assertEqual([row["shim"] for row in read_rows(self.path("out/overhead.csv"))], ["without", "with"])
        (folder,) = glob.glob(self.path("out/glxgears*"))
        self.assertEqual(read_json(os.path.join(folder, "run.json"))["signal"], int(signal.SIGTERM))

    def test_sigterm_ends_the_measurement(self):
        process = subprocess.Popen([COMMAND, "run", "--measure-overhead", "-o", "out", "--", "sh", "-c",
                                    "echo started >> starts; echo ready; while :; do sleep 0.1; done"],
                                   cwd=self.folder, stdout=subprocess.PIPE)
        self.assertEqual(process.stdout.readline(), b"ready\n")
        process.terminate()
        self.assertEqual(process.wait(timeout=60), 128 + signal.SIGTERM)
        process.stdout.close()
        with open(self.path("starts"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "started\n")

    def test_presents_tell_what_each_frame_cost(self):
        with XServer() as server:
            self.run_command("run", "-o", "out", "-s", "red", "--", "glmark2-es2", "--size", "160x120", "-b",
                             "build:nframes=12:duration=100", env={"DISPLAY": server.display})
        (name,) = glob.glob(self.path("out/glmark2-es2-*/presents.csv"))
        rows = read_rows(name)
        self.assertEqual(len(rows), 12)
        self.assertEqual(list(rows[0])[-5:], ["bind_ns", "hand_off_ns", "interval_ns", "cause", "readback"])
        self.assertEqual(rows[0]["interval_ns"], "0")
        for row in rows[1:]:
            # All of it lies between this present and the one before, except what follows the call.
            self.assertGreater(int(row["interval_ns"]), 0)
            self.assertGreaterEqual(int(row["readback_ns"]), int(row["read_ns"]) + int(row["bind_ns"]))

    def test_sigkill_leaves_every_finished_frame_readable(self):
        with XServer() as server:
            process = subprocess.Popen([COMMAND, "run", "-o", "out", "--", "glxgears"], cwd=self.folder,
                                       env={**os.environ, "DISPLAY": server.display}, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE)
            rows = []
            deadline = time.monotonic() + 120
            while len(rows) < 20 and time.monotonic() < deadline:
                time.sleep(0.05)
                rows = [row for name in glob.glob(self.path("out/glxgears*/frames.csv")) for row in read_rows(name)]
            self.assertGreaterEqual(len(rows), 20)
            (folder,) = glob.glob(self.path("out/glxgears*"))
            os.kill(int(folder.rsplit("-", 1)[1]), signal.SIGKILL)
            process.communicate(timeout=120)
        self.assertEqual(process.returncode, 128 + signal.SIGKILL)
        frames = read_rows(os.path.join(folder, "frames.csv"))
        schemes = read_rows(os.path.join(folder, "schemes.csv"))
        self.assertGreaterEqual(len(frames), 20)
        self.assertEqual([row["frame"] for row in frames], [str(i) for i in range(len(frames))])
        self.assertEqual(len(schemes), 7 * len(frames))
        self.assertTrue(all(None not in row and None not in row.values() for row in frames + schemes))
        run = read_json(os.path.join(folder, "run.json"))
        self.assertEqual((run["state"], run["signal"]), ("killed by signal 9", 9))
        self.assertEqual((run["counts"]["captured"], run["measured_frames"]), (len(frames), len(frames) - 1))
        for i, scheme in enumerate(run["schemes"]):
            self.assertEqual(scheme["payload_bits"], sum(int(row["payload_bits"]) for row in schemes[7 + i::7]))


if __name__ == "__main__":
    main()
