#!/usr/bin/env python3
"""SIGINT, SIGTERM and SIGHUP while a verb works: one line, 128+n, nothing half-written.

Usage: cli_signals_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import os
import signal
import subprocess

from cli_case import COMMAND, CliCase, golden, main, read_json, read_rows

# Long enough that no machine is done with them before the signal comes.
MANY = [golden("desktop", number) for number in range(2)] * 2000


class SignalsCase(CliCase):
    def start(self, *words, **further):
        """In a session of its own, so that a signal to its group is a terminal's ^C."""
        return subprocess.Popen([COMMAND, *words], cwd=self.folder, start_new_session=True, stderr=subprocess.PIPE,
                                **{"stdin": subprocess.DEVNULL, **further})

    def row_count(self, path):
        return len(read_rows(self.path(path))) if os.path.exists(self.path(path)) else 0

    def end_of(self, process, number):
        os.killpg(process.pid, number)
        _, text = process.communicate(timeout=200)
        self.assertEqual(process.returncode, 128 + number, text)
        return text.decode()


class Frames(SignalsCase):
    def assert_whole(self, folder, number, text, of):
        run = read_json(self.path(folder + "/run.json"))
        rows = read_rows(self.path(folder + "/frames.csv"))
        self.assertEqual(run["state"], f"killed by signal {number}")
        self.assertEqual(run["counts"]["captured"], len(rows))
        self.assertEqual([int(row["frame"]) for row in rows], list(range(len(rows))))
        self.assertEqual(len(read_rows(self.path(folder + "/schemes.csv"))), 2 * len(rows))
        for name in ("frames.csv", "schemes.csv"):
            with open(self.path(f"{folder}/{name}"), "rb") as file:
                self.assertEqual(file.read()[-1:], b"\n")
        name = {2: "Interrupt", 15: "Terminated", 1: "Hangup"}[number]
        plural = "frame" if of == "" and len(rows) == 1 else "frames"
        self.assertEqual(text, f"tilepress: killed by signal {number} ({name}): {len(rows)}{of} {plural} captured\n")

    def test_end_between_two_frames(self):
        for number, jobs in ((signal.SIGINT, "1"), (signal.SIGINT, "2"), (signal.SIGTERM, "2"), (signal.SIGHUP, "1")):
            folder = f"out-{number}-{jobs}"
            process = self.start("frames", "-j", jobs, "-s", "vdcp", "-s", "ras", "-o", folder, "--dump-frames",
                                 "every:10", "--cdf", folder + "/colors.csv", *MANY)
            self.wait_until(lambda folder=folder: self.row_count(folder + "/frames.csv") > 2, process)
            self.assert_whole(folder, number, self.end_of(process, number), f" of {len(MANY)}")
            self.assertEqual([name for name in os.listdir(self.path(folder + "/frames")) if not name.endswith(".png")], [])

    def test_end_while_they_wait_for_input(self):
        process = self.start("frames", "-s", "vdcp", "-s", "ras", "--size", "16x16", "-o", "out", "-",
                             stdin=subprocess.PIPE)
        process.stdin.write(bytes(16 * 16 * 4))
        process.stdin.flush()
        self.wait_until(lambda: self.row_count("out/frames.csv") == 1, process)
        os.killpg(process.pid, signal.SIGINT)
        process.wait(timeout=100)
        text = process.stderr.read().decode()
        process.stdin.close()
        process.stderr.close()
        self.assertEqual(process.returncode, 130, text)
        self.assert_whole("out", 2, text, "")

    def test_end_with_whole_rows_on_standard_output(self):
        with open(self.path("rows.csv"), "wb") as rows:
            process = self.start("frames", "-s", "vdcp", "-s", "ras", "-o", "-", *MANY, stdout=rows)
            self.wait_until(lambda: self.row_count("rows.csv") > 4, process)
            self.assertEqual(len(self.end_of(process, signal.SIGINT).splitlines()), 1)
        with open(self.path("rows.csv"), "rb") as file:
            text = file.read()
        self.assertEqual((text[-1:], (len(text.splitlines()) - 1) % 2), (b"\n", 0))

    def test_end_once_for_two_signals_at_once(self):
        """timeout(1) sends each signal twice."""
        process = self.start("frames", "-q", "-s", "vdcp", "-s", "ras", "-o", "out", *MANY)
        self.wait_until(lambda: self.row_count("out/frames.csv") > 2, process)
        os.killpg(process.pid, signal.SIGINT)
        self.assert_whole("out", 2, self.end_of(process, signal.SIGINT), f" of {len(MANY)}")

    def test_go_on_where_the_caller_ignores_the_signal(self):
        process = self.start("frames", "-q", "-s", "red", "-o", "out", *MANY[:40],
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_until(lambda: self.row_count("out/frames.csv") > 0 or process.poll() is not None, process)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGHUP)
        _, text = process.communicate(timeout=200)
        self.assertEqual((process.returncode, text), (0, b""))
        self.assertEqual(self.row_count("out/frames.csv"), 40)


class FilesOfOtherVerbs(SignalsCase):
    def test_are_not_left_half_written(self):
        for words, number in ((["pack", "--force", *MANY], signal.SIGINT), (["pack", *MANY], signal.SIGTERM),
                              (["bench", "-s", "vdcp", "--rounds", "1000", *MANY[:4]], signal.SIGINT)):
            process = self.start(*words, "-o", "file")
            self.wait_until(lambda: os.path.exists(self.path("file.part")), process)
            text = self.end_of(process, number)
            self.assertEqual(text, f"tilepress: killed by signal {number} ({signal.strsignal(number)})\n")
            self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
