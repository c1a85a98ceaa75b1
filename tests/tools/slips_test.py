#!/usr/bin/env python3
"""Typical slips on the command line: each ends in one line that names the way out.

Usage: slips_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import os
import shutil

from cli_case import CliCase, golden, main

FAILED, USAGE, NOTHING = 1, 2, 3
IMAGE = golden("odd", 0)
FILES = {
    "key.toml": "verify = true\ntlie = 32\n",
    "value.toml": "\ntile = 33\n",
    "scheme.toml": 'scheme = ["ras", "vdcp:fcv=16"]\n',
    "torn.toml": "tile 32\n",
    "sizes.toml": 'name = "x"\nconfigurations = ["vdcp:polcy=lru"]\n',
}
# Words of the command line, exit status, and what the line must hold.
SLIPS = [
    # Verbs.
    ("repotr run", USAGE, "unknown verb 'repotr' (did you mean 'report'?"),
    ("help frame", USAGE, "unknown verb 'frame' (did you mean 'frames'?"),
    ("scheme", USAGE, "did you mean 'schemes'?"),
    ("--versoin", USAGE, "did you mean '--version'?"),
    ("capture -- glxgears", USAGE, "unknown verb 'capture' (see tilepress help)"),
    # Options.
    ("run --tlie 32 -- true", USAGE, "unknown option '--tlie' (did you mean '--tile'?)"),
    ("run --schemes vdcp -- true", USAGE, "unknown option '--schemes' (did you mean '--scheme'?)"),
    ("run --out x -- true", USAGE, "did you mean '--output'?"),
    ("run -verify -- true", USAGE, "did you mean '--verify'?"),
    ("replay --catgory x=UI a.trace", USAGE, "did you mean '--category'?"),
    ("report --scheme vdcp run", USAGE, "unknown option '--scheme' (see tilepress report --help)"),
    ("cost 64", USAGE, "unexpected argument '64' (see tilepress cost --help)"),
    ("frames --tile", USAGE, "--tile: needs N (see tilepress frames --help)"),
    ("run --seconds=abc -- true", USAGE, "--seconds abc: must be a number in 0.1..86400"),
    ("report --dram-pj 0 run", USAGE, "--dram-pj 0: must be a number above 0"),
    ("frames -j 0 IMAGE", USAGE, "--jobs 0: must be a number in 1..1024"),
    ("frames --burst 128 --dram paper IMAGE", USAGE, "give only one of them"),
    # What is missing.
    ("", USAGE, "no verb given (see tilepress help)"),
    ("frames", USAGE, "no IMAGE given (see tilepress frames --help)"),
    ("compare run", USAGE, "no B given (see tilepress compare --help)"),
    ("record -- true", USAGE, "no --output given (see tilepress record --help)"),
    ("run", USAGE, "no program given (see tilepress run --help)"),
    ("study paper", USAGE, "no input given (see tilepress study --help)"),
    ("unpack a.tpk", USAGE, "give -o DIR, --rect or --csv"),
    # Schemes, keys, values.
    ("frames -s vdpc IMAGE", USAGE, "unknown scheme 'vdpc' (did you mean 'vdcp'?)"),
    ("frames -s VDCP IMAGE", USAGE, "did you mean 'vdcp'?"),
    ("bench -s zip IMAGE", USAGE, "unknown scheme 'zip' (there are dcp, adcp, "),
    ("frames -s vdcp:fcv=64 IMAGE", USAGE, "unknown key 'fcv' (did you mean 'fvc'? vdcp takes fvc, policy, ways, "),
    ("frames -s red:fvc=64 IMAGE", USAGE, "unknown key 'fvc' (red takes no key)"),
    ("frames -s vdcp:128 IMAGE", USAGE, "'128' is not key=value (vdcp takes fvc, "),
    ("frames -s vdcp:fvc=48 IMAGE", USAGE, "fvc=48: must be a power of two from 2 to 1024"),
    ("frames -s vdcp:policy=lur IMAGE", USAGE, "must be lfc, 2lfc, lru or random (did you mean 'lru'?)"),
    ("frames -s vdcp:fvc={16..} IMAGE", USAGE, "a range is {A..B} with whole numbers"),
    # Words and ranges.
    ("frames --tile 33 IMAGE", USAGE, "--tile 33: must be a multiple of 8 in 8..4096"),
    ("frames --dram lpddr44 IMAGE", USAGE, "must be paper, lpddr3, lpddr4 or lpddr5 (did you mean 'lpddr4'?)"),
    ("run --on-full dorp -- true", USAGE, "must be block or drop (did you mean 'drop'?)"),
    ("run --via prelaod -- true", USAGE, "not one of auto, preload, glvnd (did you mean 'preload'?)"),
    ("run --trigger finsh -- true", USAGE, "did you mean 'finish'?"),
    ("corpus lsit", USAGE, "not one of list, record, verify, compare, export (did you mean 'list'?)"),
    ("study cache purne", USAGE, "not one of list, prune (did you mean 'prune'?)"),
    ("frames --frames 9-3 IMAGE", USAGE, "--frames 9-3: reversed range 9-3"),
    ("frames --size 640 IMAGE", USAGE, "must be WxH with sides in 1..65535"),
    ("frames --heatmaps 5 IMAGE", USAGE, "--heatmaps 5: must be every:N"),
    ("cost --pixel-bits 24", USAGE, "--pixel-bits 24: not one of 16, 32"),
    # Paths.
    ("frames shost/0.png", FAILED, "shost/0.png: No such file or directory (did you mean 'shots/0.png'?)"),
    ("frames shots/*.jpg", FAILED, "shots/*.jpg: No such file or directory"),
    ("report rnu", FAILED, "rnu: no such folder (did you mean 'run'?)"),
    ("frames empty", FAILED, "empty: is a folder without images"),
    # TOML.
    ("frames --config key.toml IMAGE", USAGE, "key.toml: line 2: unknown option 'tlie' (did you mean 'tile'?)"),
    ("frames --config value.toml IMAGE", USAGE, "value.toml: line 2: --tile 33: must be a multiple of 8"),
    ("frames --config scheme.toml IMAGE", USAGE, "scheme.toml: line 1: --scheme vdcp:fcv=16: unknown key 'fcv' (did you mean 'fvc'?"),
    ("frames --config torn.toml IMAGE", USAGE, "torn.toml: line 1: "),
    ("frames --config kye.toml IMAGE", USAGE, "--config kye.toml: no such file (did you mean 'key.toml'?)"),
    ("study sizes.toml shots", USAGE, "sizes.toml: line 2: scheme 'vdcp:polcy=lru': unknown key 'polcy' (did you mean 'policy'?"),
]


class Slips(CliCase):
    def setUp(self):
        super().setUp()
        for folder in ("shots", "empty"):
            os.mkdir(self.path(folder))
        for number in range(2):
            shutil.copy(golden("odd", number), self.path(f"shots/{number}.png"))
        for name, text in FILES.items():
            self.write(name, text.encode())
        done = self.run_command("frames", "-q", "-s", "red", "-s", "vdcp", "-o", "run", "shots")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_are_named_in_one_line_with_the_way_out(self):
        self.assertGreater(len(SLIPS), 50)
        for words, status, text in SLIPS:
            with self.subTest(words=words):
                line = [IMAGE if word == "IMAGE" else word for word in words.split()]
                done = self.run_command(*line, env={"DISPLAY": "", "WAYLAND_DISPLAY": ""})
                said = done.stderr.decode()
                self.assertTrue(said.startswith("tilepress: ") and said.count("\n") == 1, said)
                self.assertIn(text, said)
                self.assertEqual((done.returncode, done.stdout), (status, b""))
        self.assert_absent("tilepress-out")


class Guidance(CliCase):
    def test_without_a_display_names_xvfb_run_and_replay(self):
        said = self.run_command("run", "-o", "out", "--", "true", env={"DISPLAY": "", "WAYLAND_DISPLAY": ""})
        self.assertEqual(said.returncode, NOTHING)
        self.assertIn(b"xvfb-run -a tilepress run", said.stderr)
        self.assertIn(b"tilepress replay", said.stderr)

    def test_frames_of_a_folder_are_ordered_by_number(self):
        os.mkdir(self.path("shots"))
        for number, name in enumerate(("2.png", "10.png", "notes.txt", "1.png")):
            shutil.copy(golden("odd", number), self.path("shots/" + name))
        self.write("shots/notes.txt", b"no image")
        rows = [self.run_command("frames", "-q", "-s", "red", "-o", "-", *words).stdout
                for words in (["shots"], ["shots/1.png", "shots/2.png", "shots/10.png"])]
        self.assertEqual(rows[0], rows[1])
        self.assertEqual(rows[0].count(b"\n"), 4)


if __name__ == "__main__":
    main()
