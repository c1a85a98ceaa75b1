#!/usr/bin/env python3
"""Standard output and files that cannot take the result, for every verb of `tilepress help`.

Usage: cli_streams_test.py TILEPRESS GOLDEN_FOLDER TRACE_FOLDER [TEST...]"""
import glob
import os
import re
import signal
import stat
import subprocess
import sys
import time

from cli_case import COMMAND, CliCase, golden, main, read_rows

TRACE = os.path.join(os.path.abspath(sys.argv.pop(3)), "glmark2-desktop-egl.trace")
IMAGES = [golden("odd", number) for number in range(2)]
# What each verb prints on standard output. None: it prints nothing there but its help.
RESULTS = {
    "run": None,
    "frames": [["-q", "-o", "-", *IMAGES]],
    "replay": None,
    "study": [["--example"]],
    "corpus": [["list"]],
    "record": None,
    "info": [[TRACE], ["--json", TRACE]],
    "bench": [["-s", "red", "--rounds", "1", "-o", "-", *IMAGES]],
    "report": [["-o", "-", "run"]],
    "summary": [["run"]],
    "compare": [["run", "run"], ["--format", "csv", "run", "run"]],
    "pack": None,
    "unpack": [["--csv", "a.tpk"]],
    "compose": [["-q", "-o", "-", "a.tpk"]],
    "vectors": None,
    "cost": [[], ["--json"]],
    "top": [["--interval", "0.05", "live"]],
    "view": None,
    "export": [["--format", "jsonl", "run"], ["--format", "gem5", "run"]],
    "schemes": [[], ["--json"]],
    "doctor": [["--json"]],
}


def verbs_of_help():
    text = subprocess.run([COMMAND, "help"], capture_output=True, check=True, timeout=60).stdout.decode()
    table = text.split("Verbs:\n")[1].split("\n\n")[0]
    return [verb for verb in re.findall(r"^  (\w+) ", table, re.MULTILINE) if verb != "help"]


class StreamsCase(CliCase):
    def setUp(self):
        super().setUp()
        for words in (["frames", "-q", "-o", "run", *IMAGES], ["pack", "-q", "-o", "a.tpk", *IMAGES]):
            self.assertEqual(self.run_command(*words).returncode, 0)

    def start(self, words, **further):
        return subprocess.run([COMMAND, *words], cwd=self.folder, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              timeout=300, check=False, **further)

    def into_full_device(self, words):
        with open("/dev/full", "wb") as full:
            return self.start(words, stdout=full), "No space left on device"

    def into_closed_pipe(self, words):
        read_end, write_end = os.pipe()
        os.close(read_end)
        try:
            return self.start(words, stdout=write_end), "Broken pipe"
        finally:
            os.close(write_end)

    def into_nothing(self, words):
        return self.start(words, preexec_fn=lambda: os.close(1)), "Bad file descriptor"

    def assert_fails(self, words):
        for way in (self.into_full_device, self.into_closed_pipe, self.into_nothing):
            with self.subTest(words=words, way=way.__name__):
                done, reason = way(words)
                # bench prints its table there as well.
                lines = [line for line in done.stderr.decode().splitlines() if line.startswith("tilepress: ")]
                self.assertEqual(lines, [f"tilepress: standard output: {reason}"], done.stderr.decode())
                if words[0] != "bench":
                    self.assertEqual(len(done.stderr.splitlines()), 1)
                self.assertEqual(done.returncode, 1)


class StandardOutput(StreamsCase):
    def test_that_cannot_take_the_help_or_version_is_exit_1_and_a_line(self):
        for words in (["help"], ["--help"], ["-h"], ["--version"], ["version"]):
            self.assert_fails(words)
        for verb in verbs_of_help():
            self.assert_fails([verb, "--help"])
        self.assert_fails(["help", "run"])

    def test_that_cannot_take_a_result_is_exit_1_and_a_line_from_every_verb(self):
        self.assertEqual(sorted(RESULTS), sorted(verbs_of_help()), "a new verb needs a line in RESULTS")
        environment = {**os.environ, "WAFFLE_PLATFORM": "surfaceless_egl"}
        with subprocess.Popen([COMMAND, "run", "-q", "-s", "red", "-o", "live", "--", "eglretrace", "-b",
                               TRACE], cwd=self.folder, env=environment, start_new_session=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as capture:
            try:
                deadline = time.monotonic() + 100
                while time.monotonic() < deadline and not any(
                        len(read_rows(path)) > 1 for path in glob.glob(self.path("live/*/frames.csv"))):
                    time.sleep(0.02)
                os.killpg(capture.pid, signal.SIGSTOP)  # it lives until every verb has looked at it
                for verb, results in RESULTS.items():
                    for words in results or []:
                        self.assert_fails([verb, *words])
            finally:
                os.killpg(capture.pid, signal.SIGTERM)
                os.killpg(capture.pid, signal.SIGCONT)

    def test_that_nothing_is_printed_on_may_be_closed(self):
        done, _ = self.into_nothing(["frames", "-q", "-o", "other", *IMAGES])
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(len(read_rows(self.path("other/frames.csv"))), 2)

    def test_of_a_program_is_the_callers(self):
        """SIGPIPE and closed streams reach a captured program as the caller had them."""
        ask = "grep SigIgn /proc/self/status >&2; test -e /proc/$$/fd/1 && echo open >&2 || echo closed >&2; exit 9"
        for ignored in (False, True):
            def prepare(ignored=ignored):
                signal.signal(signal.SIGPIPE, signal.SIG_IGN if ignored else signal.SIG_DFL)
                os.close(1)
            texts = [subprocess.run([*before, "sh", "-c", ask], cwd=self.folder, stderr=subprocess.PIPE, timeout=60,
                                    check=False, preexec_fn=prepare, restore_signals=False)
                     for before in ([], [COMMAND, "run", "-q", "-o", "out", "--"])]
            self.assertEqual(texts[1].stderr, texts[0].stderr)
            self.assertEqual(texts[1].returncode, 9)
            self.assertIn(b"closed", texts[0].stderr)


def file_writers(folder):
    return [["report", "-o", folder + "x", "run"],
            ["export", "--format", "jsonl", "-o", folder + "x", "run"],
            ["compose", "-q", "--force", "-o", folder + "x", "a.tpk"],
            ["pack", "-q", "--force", "-o", folder + "x", *IMAGES],
            ["bench", "-s", "red", "--rounds", "1", "-o", folder + "x", *IMAGES],
            ["frames", "-q", "--force", "--cdf", folder + "x", "-o", "other", *IMAGES]]


class Files(StreamsCase):
    def test_on_a_full_device_are_named_with_the_reason(self):
        for words in file_writers("/dev/"):
            words = ["/dev/full" if word == "/dev/x" else word for word in words]
            done = self.start(words, stdout=subprocess.PIPE)
            self.assertEqual(done.stderr.decode().splitlines()[-1], "tilepress: /dev/full: No space left on device", words)
            self.assertEqual(done.returncode, 1)
            self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))
            self.assertFalse(os.path.exists("/dev/full.part"))

    def test_on_a_full_disk_leave_nothing_half_written(self):
        disk = self.path("disk")
        os.mkdir(disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4k", "tmpfs", disk], capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("no right to mount a small disk")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        writers = file_writers("disk/") + [["unpack", "-q", "--format", "raw", "-o", "disk", "a.tpk"],
                                           ["unpack", "-q", "-o", "disk", "a.tpk"],
                                           ["vectors", "-q", "-o", "disk/vectors", *IMAGES]]
        # The disk is full to the last byte; an empty file still finds room.
        with open(disk + "/filler", "wb") as filler:
            filler.write(bytes(4096))
        for words in writers:
            done = self.start(words, stdout=subprocess.PIPE)
            self.assertRegex(done.stderr.decode().splitlines()[-1], "^tilepress: disk/.*: .*", words)
            self.assertEqual(done.returncode, 1, words)
            self.assertEqual(os.listdir(disk), ["filler"], words)

    def test_that_are_replaced_keep_their_mode_and_their_link(self):
        self.write("old.html", b"old")
        os.chmod(self.path("old.html"), 0o640)
        os.symlink("old.html", self.path("link.html"))
        self.assertEqual(self.run_command("report", "-o", "link.html", "run").returncode, 0)
        self.assertTrue(os.path.islink(self.path("link.html")))
        self.assertEqual(stat.S_IMODE(os.stat(self.path("old.html")).st_mode), 0o640)
        with open(self.path("old.html"), "rb") as file:
            self.assertIn(b"<html", file.read(4096))


if __name__ == "__main__":
    main()
