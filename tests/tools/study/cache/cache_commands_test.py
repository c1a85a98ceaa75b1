"""The frame cache from outside: a study renders a trace once, and every verb that takes images reads its frames.

usage: cache_commands_test.py TILEPRESS TRACES
"""
import csv
import glob
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

COMMAND, TRACES = (os.path.abspath(path) for path in sys.argv[1:3])
STUDY = 'name = "small"\nbaseline = "vdcp"\nconfigurations = ["vdcp", "ras", "red"]\n'
# Frames 0 to 2 of the trace: the cache holds these.
MANIFEST = f'[[trace]]\npath = "{TRACES}/glmark2-desktop-egl.trace"\nname = "desktop"\nframes = "0-2"\n'


def scheme_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class CacheCommands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="tilepress-cache-")
        for name, text in (("small.toml", STUDY), ("traces.toml", MANIFEST)):
            with open(os.path.join(cls.folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        cls.first = cls.study("first")
        cls.files = glob.glob(os.path.join(cls.folder, "cache", "*"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def call(cls, *words):
        return subprocess.run([COMMAND, *words], cwd=cls.folder, capture_output=True, text=True, timeout=300, check=False)

    @classmethod
    def study(cls, name, *words):
        return cls.call("study", "small.toml", "-o", name, "--cache", "cache", "-v", *words, "traces.toml")

    def test_1_a_second_study_renders_nothing(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        self.assertIn("rendered into", self.first.stderr)
        self.assertEqual(len(self.files), 1, "the cache holds more than the frames")
        before = os.stat(self.files[0])
        second = self.study("second", "--burst", "256")
        self.assertEqual(second.returncode, 0, second.stderr)
        self.assertNotIn("rendered into", second.stderr)
        self.assertEqual(os.stat(self.files[0]).st_ino, before.st_ino)

    def test_2_rows_of_cached_frames_are_those_of_a_replay(self):
        options = ["-q", "-s", "vdcp", "-s", "ras", "--verify"]
        frames = self.call("frames", *options, "-o", "of-cache", self.files[0])
        self.assertEqual((frames.returncode, frames.stderr), (0, ""))
        replay = self.call("replay", *options, "--frames", "0-2", "-o", "of-replay",
                           os.path.join(TRACES, "glmark2-desktop-egl.trace"))
        self.assertEqual(replay.returncode, 0, replay.stderr)
        cached = scheme_rows(os.path.join(self.folder, "of-cache", "schemes.csv"))
        self.assertEqual(len(cached), 6)
        self.assertEqual(cached, scheme_rows(
            os.path.join(self.folder, "of-replay", "glmark2-desktop-egl", "schemes.csv")))

    def test_3_threads_get_the_same_rows(self):
        done = self.call("frames", "-q", "-s", "vdcp", "-j", "3", "-o", "of-threads", self.files[0], self.files[0])
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        alone = self.call("frames", "-q", "-s", "vdcp", "-o", "alone", self.files[0], self.files[0])
        self.assertEqual((alone.returncode, alone.stderr), (0, ""))
        rows = scheme_rows(os.path.join(self.folder, "of-threads", "schemes.csv"))
        self.assertEqual(len(rows), 6)
        self.assertEqual(rows, scheme_rows(os.path.join(self.folder, "alone", "schemes.csv")))

    def test_4_list_names_the_trace(self):
        done = self.call("study", "cache", "list", "--cache", "cache")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 3, done.stdout)
        # Three frames of 720x1280 RGBX8 are 11.1 MB.
        self.assertRegex(lines[1], r"^[0-9a-f]{16} +3 +11\.1 .*/glmark2-desktop-egl\.trace  .*llvmpipe")
        self.assertRegex(lines[2], r"/cache: 1 file, [0-9.]+ MB$|^cache: 1 file, [0-9.]+ MB$")

    def test_5_damage_is_one_line(self):
        torn = os.path.join(self.folder, "torn.frames")
        with open(self.files[0], "rb") as whole, open(torn, "wb") as file:
            file.write(whole.read()[:-1])
        line = f"tilepress: {torn}: is torn or no whole frame cache\n"
        done = self.call("frames", "-o", "of-torn", torn)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (1, "", line))
        os.mkdir(os.path.join(self.folder, "other"))
        shutil.move(torn, os.path.join(self.folder, "other", "torn.frames"))
        done = self.call("study", "cache", "list", "--cache", "other")
        self.assertEqual((done.returncode, done.stderr),
                         (1, "tilepress: other/torn.frames: is torn or no whole frame cache\n"))
        done = self.call("study", "cache", "prune", "--cache", "other", "--keep", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"^removed other/torn\.frames \([0-9.]+ MB, cannot be read\)\n$")
        self.assertEqual(os.listdir(os.path.join(self.folder, "other")), [])

    def test_6_a_flipped_byte_is_one_line(self):
        with open(self.files[0], "rb") as file:
            content = bytearray(file.read())
        content[100] ^= 1  # in the first frame
        flipped = os.path.join(self.folder, "flipped.frames")
        with open(flipped, "wb") as file:
            file.write(content)
        done = self.call("frames", "-q", "-o", "of-flipped", flipped)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (1, "", f"tilepress: {flipped}: frame 0 of surface 0: is damaged (wrong checksum)\n"))

    def test_7_prune_keeps_what_was_used_last(self):
        shutil.copytree(os.path.join(self.folder, "cache"), os.path.join(self.folder, "copy"))
        kept = self.call("study", "cache", "prune", "--cache", "copy", "--keep", "1")
        self.assertEqual((kept.returncode, kept.stdout, kept.stderr), (0, "", ""))
        dry = self.call("study", "cache", "prune", "--cache", "copy", "-n")
        self.assertRegex(dry.stdout, r"^would remove copy/[0-9a-f]{64}\.frames \([0-9.]+ MB, last used [^)]*\)\n$")
        self.assertEqual(len(os.listdir(os.path.join(self.folder, "copy"))), 1)
        self.assertEqual(self.call("study", "cache", "prune", "--cache", "copy").returncode, 0)
        self.assertEqual(os.listdir(os.path.join(self.folder, "copy")), [])


unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
