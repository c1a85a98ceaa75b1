#!/usr/bin/env python3
"""Typical slips on the command line: each ends in one line that names the way out.

Usage: slips_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import csv
import os
import re
import shutil
import unittest

from cli_case import CliCase, GOLDEN, golden, main

FAILED, USAGE, NOTHING = 1, 2, 3
IMAGE = golden("odd", 0)
TRACE = os.path.join(GOLDEN, "../replay/traces/glmark2-desktop-egl.trace")
FILES = {
    "key.toml": "verify = true\ntlie = 32\n",
    "value.toml": "\ntile = 33\n",
    "scheme.toml": 'scheme = ["ras", "vdcp:fcv=16"]\n',
    "torn.toml": "tile 32\n",
    "study.toml": 'name = "x"\nconfiguratons = ["vdcp"]\n',
    "sizes.toml": 'name = "x"\nconfigurations = ["vdcp:polcy=lru"]\n',
    "axis.toml": 'name = "x"\nconfigurations = ["red"]\n[[axis]]\nnam = "a"\n',
    "traces.toml": '[[trace]]\npaht = "x.trace"\n',
    "tables.toml": '[[traces]]\npath = "x.trace"\n',
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
    ("compare run run --format markdwon", USAGE, "not one of text, markdown, csv (did you mean 'markdown'?)"),
    ("export --format gem run", USAGE, "not one of gem5, jsonl (did you mean 'gem5'?)"),
    ("corpus lsit", USAGE, "not one of list, record, verify, compare, export (did you mean 'list'?)"),
    ("study cache purne", USAGE, "not one of list, prune (did you mean 'prune'?)"),
    ("study papre shots", FAILED, "papre: No such file or directory (did you mean 'paper'?)"),
    ("frames --frames 9-3 IMAGE", USAGE, "--frames 9-3: reversed range 9-3"),
    ("frames --size 640 IMAGE", USAGE, "must be WxH with sides in 1..65535"),
    ("frames --heatmaps 5 IMAGE", USAGE, "--heatmaps 5: must be every:N"),
    ("cost --pixel-bits 24", USAGE, "--pixel-bits 24: not one of 16, 32"),
    # Paths.
    ("frames shost/0.png", FAILED, "shost/0.png: No such file or directory (did you mean 'shots/0.png'?)"),
    ("frames shots/*.jpg", FAILED, "shots/*.jpg: No such file or directory"),
    ("report rnu", FAILED, "rnu: no such folder (did you mean 'run'?)"),
    ("frames -s vdcp,ras IMAGE", USAGE, "unknown scheme 'vdcp,ras' (give each scheme an option of its own)"),
    ("frames -s vdcp:fvc=16 vdcp:fvc=32", FAILED, "(a scheme? Put it in quotes: -s 'vdcp:fvc={...}')"),
    ("schemes vdpc", USAGE, "did you mean 'vdcp'?"),
    ("study shots", FAILED, "is a folder; name a study before it, as in tilepress study paper shots"),
    ("record -o none/x.trace -- true", FAILED, "there is no folder none (mkdir -p none)"),
    ("replay gmae.trace", FAILED, "gmae.trace: No such file or directory (did you mean 'game.trace'?)"),
    ("unpack --csv shosts.tpk", FAILED, "did you mean 'shots.tpk'?"),
    ("frames empty", FAILED, "empty: is a folder without images"),
    ("report --category desk*=UI run", USAGE, "--category desk*=UI: matches no workload (there are run)"),
    ("compare run --map red=>vdpc", USAGE, "has no scheme 'vdpc' (did you mean 'vdcp'? it has red, vdcp)"),
    ("view run", NOTHING, "1 ended run is there; `tilepress report run -o report.html` shows it"),
    # Inputs of another verb.
    ("frames real.trace", FAILED, "; tilepress replay takes traces"),
    ("frames -o x traces", FAILED, "traces: is a folder without images (raw .rgba files need --size WxH); tilepress replay takes traces"),
    ("frames run", FAILED, "; tilepress report takes runs"),
    ("pack -o x.tpk real.tpk", FAILED, "; tilepress unpack takes packed files"),
    ("replay -q -o x IMAGE", FAILED, "; tilepress frames takes images"),
    ("replay -q -o x shots", FAILED, "shots: is a directory, not a trace; tilepress frames takes images"),
    ("info IMAGE", FAILED, "; tilepress frames takes images"),
    ("report real.trace", FAILED, "real.trace: not a run directory; tilepress replay takes traces"),
    ("summary shots", FAILED, "shots: holds no run (no frames.csv in it or below); tilepress frames takes images"),
    ("compare run IMAGE", FAILED, "; tilepress frames takes images"),
    ("unpack --csv real.trace", FAILED, "; tilepress replay takes traces"),
    ("view real.trace", FAILED, "real.trace: not a folder; tilepress replay takes traces"),
    ("top --once IMAGE", FAILED, ": not a folder; tilepress frames takes images"),
    ("study real.trace shots", FAILED, "real.trace: is no study; name one before it, as in tilepress study paper real.trace"),
    # TOML.
    ("frames --config key.toml IMAGE", USAGE, "key.toml: line 2: unknown option 'tlie' (did you mean 'tile'?)"),
    ("frames --config value.toml IMAGE", USAGE, "value.toml: line 2: --tile 33: must be a multiple of 8"),
    ("frames --config scheme.toml IMAGE", USAGE, "scheme.toml: line 1: --scheme vdcp:fcv=16: unknown key 'fcv' (did you mean 'fvc'?"),
    ("frames --config torn.toml IMAGE", USAGE, "torn.toml: line 1: "),
    ("frames --config kye.toml IMAGE", USAGE, "--config kye.toml: no such file (did you mean 'key.toml'?)"),
    ("study study.toml shots", USAGE, "study.toml: line 2: unknown key 'configuratons' (did you mean 'configurations'?)"),
    ("study sizes.toml shots", USAGE, "sizes.toml: line 2: scheme 'vdcp:polcy=lru': unknown key 'polcy' (did you mean 'policy'?"),
    ("study axis.toml shots", USAGE, "axis.toml: line 4: unknown key 'nam' (did you mean 'name'?)"),
    ("replay --manifest traces.toml", USAGE, "traces.toml: line 2: unknown key 'paht' (did you mean 'path'?)"),
    ("replay --manifest tables.toml", USAGE, "tables.toml: line 1: unknown key 'traces' (did you mean 'trace'?"),
]


class Slips(CliCase):
    def setUp(self):
        super().setUp()
        for folder in ("shots", "empty", "traces"):
            os.mkdir(self.path(folder))
        for name in ("real.trace", "traces/a.trace"):
            shutil.copy(TRACE, self.path(name))
        for number in range(2):
            shutil.copy(golden("odd", number), self.path(f"shots/{number}.png"))
        for name, text in FILES.items():
            self.write(name, text.encode())
        for name in ("game.trace", "shots.tpk"):
            self.write(name, b"")
        self.assertEqual(self.run_command("pack", "-q", "-o", "real.tpk", "shots").returncode, 0)
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
    def test_of_every_verb_shows_three_examples(self):
        verbs = self.run_command("help").stdout.decode().split("Verbs:\n")[1].split("\n\n")[0]
        for verb in re.findall(r"^  (\w+) ", verbs, re.MULTILINE):
            if verb == "help":
                continue
            text = self.run_command("help", verb).stdout.decode()
            examples = re.findall(rf"^  .*\btilepress {verb}\b", text.split("Examples:\n")[-1], re.MULTILINE)
            self.assertGreaterEqual(len(examples), 3, verb)

    def test_without_a_display_names_xvfb_run_and_replay(self):
        for words, status in ((("run", "-o", "out", "--", "true"), NOTHING), (("run", "-o", "out", "--", "false"), 1)):
            said = self.run_command(*words, env={"DISPLAY": "", "WAYLAND_DISPLAY": ""})
            self.assertEqual(said.returncode, status)
            self.assertIn(b"xvfb-run -a tilepress run", said.stderr)
            self.assertIn(b"tilepress replay", said.stderr)
        said = self.run_command("run", "-o", "out", "--", "false", env={"DISPLAY": ":987654", "WAYLAND_DISPLAY": ""})
        self.assertIn(b"no X server answers at DISPLAY=:987654: `xvfb-run -a tilepress run", said.stderr)
        quiet = self.run_command("run", "-q", "-o", "out", "--", "false", env={"DISPLAY": "", "WAYLAND_DISPLAY": ""})
        self.assertEqual((quiet.returncode, quiet.stderr), (1, b""))

    def test_ends_a_run_with_the_next_command(self):
        folder = "two words"
        done = self.run_command("frames", "-s", "red", "-o", folder, IMAGE, golden("odd", 1))
        self.assertEqual(done.stderr.decode().splitlines()[-1], "  next: tilepress report 'two words' -o report.html")
        self.assertEqual(done.stdout, b"")


class Labels(CliCase):
    def frames(self, folder, *words):
        done = self.run_command("frames", "-q", "-s", "red", "-s", "vdcp", "-o", folder, *words, IMAGE, golden("odd", 1))
        self.assertEqual(done.returncode, 0, done.stderr)

    def summary(self, *words):
        done = self.run_command("summary", *words)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        return [line.split()[:2] for line in done.stdout.decode().splitlines()[1:3]]

    def test_name_a_run_and_put_it_into_a_category(self):
        self.frames("all/a", "--name", "menu", "--category", "UI")
        self.frames("all/b")
        self.assertEqual(self.summary("all", "--category", "*=3D"), [["menu", "UI"], ["b", "3D"]])
        self.assertEqual(self.summary("all", "--category", "*=3D", "--recategorize"), [["menu", "3D"], ["b", "3D"]])

    def test_compare_takes_a_default_for_the_value_that_is_named(self):
        self.frames("run")
        self.run_command("frames", "-q", "-s", "vdcp:fvc={32,64}", "-o", "sweep", IMAGE, golden("odd", 1))
        for words, schemes in ((["--map", "vdcp => vdcp:fvc=64", "--map", "vdcp:policy=lfc => vdcp"],
                                ["vdcp => vdcp:fvc=64", "vdcp:policy=lfc => vdcp"]), ([], ["vdcp"])):
            done = self.run_command("compare", "run", "sweep", "--format", "csv", *words)
            rows = list(csv.DictReader(done.stdout.decode().splitlines()))
            self.assertEqual([(row["scheme"], row["frames"], row["change"]) for row in rows], [(s, "1", "0") for s in schemes], done.stderr)
            self.assertEqual(done.returncode, 0)
        self.expect(2, "--map vdcp => vdcp:fvc=16: sweep has no scheme 'vdcp:fvc=16' (did you mean 'vdcp:fvc=32'? it has vdcp:fvc=32, "
                    "vdcp:fvc=64)", "compare", "run", "sweep", "--map", "vdcp => vdcp:fvc=16")

    def test_compare_configurations_of_one_run(self):
        self.frames("run")
        self.frames("other", "--tile", "64")
        done = self.run_command("compare", "run", "other", "--map", "red => vdcp", "--threshold", "1", "--github", "--junit", "j.xml")
        lines = done.stdout.decode().splitlines()
        self.assertEqual(lines[0], "run: other options: tile 32 in A, 64 in B")
        self.assertTrue(lines[3].startswith("run       red => vdcp"), lines)
        self.assertEqual(sum(line.startswith("::warning title=tilepress compare::run: other options") for line in lines), 1)
        with open(self.path("j.xml"), encoding="utf-8") as file:
            junit = file.read()
        self.assertIn('<testcase classname="run" name="red =&gt; vdcp"', junit)
        self.assertEqual(done.returncode, 1 if "<failure" in junit else 0)
        worse = self.run_command("compare", "run", "--map", "vdcp => red", "--threshold", "1", "--github")
        better = self.run_command("compare", "run", "--map", "vdcp => vdcp", "--threshold", "1", "--github")
        self.assertEqual(sorted((worse.returncode, better.returncode)), [0, 1])
        self.assertIn(b"\n::error title=tilepress compare run::rate of vdcp => red fell by ", worse.stdout)
        self.assertIn(b"::notice title=tilepress compare::1 rate compared, none fell", better.stdout)


if __name__ == "__main__":
    unittest.TestCase.maxDiff = None
    main()
