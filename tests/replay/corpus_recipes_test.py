#!/usr/bin/env python3
"""Recipes of the corpus: every field of every recipe, and a line for each fault of a bad one.

Usage: corpus_recipes_test.py TILEPRESS CORPUS_FOLDER"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

COMMAND, CORPUS = sys.argv[1], Path(sys.argv[2])
sys.path.insert(0, str(CORPUS))
sys.dont_write_bytecode = True

import devtools  # noqa: E402
import input_events  # noqa: E402
import recipe  # noqa: E402
import results_values  # noqa: E402
import trimming  # noqa: E402
from corpus_messages import Fault  # noqa: E402
from recording import Present  # noqa: E402

GOOD = """name = "good"
category = "UI"
stands_for = "tests"
licence = "MIT"
packages = { nothing = "1" }
command = ["true"]
api = "egl"
begins = 1
frames = 10
checks = { distinct = 2, change = 0.1, rate_tolerance = 5.0 }
[[input]]
at = 1.0
every = 2.0
times = 2
do = ["0.5 tap 1 2", "0.0 key a b"]
"""


class Recipes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tilepress-recipes-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def faults(self, text, name="good"):
        path = self.folder / f"{name}.toml"
        path.write_text(text, encoding="utf-8")
        try:
            recipe.read_recipe(path)
        except Fault as fault:
            return [line.removeprefix(f"{path}: ") for line in str(fault).splitlines()]
        return []

    def test_of_the_project_are_good(self):
        recipes, faults = recipe.read_recipes(CORPUS / "recipes", [], "")
        self.assertEqual(faults, [])
        self.assertGreaterEqual(len(recipes), 12)
        for one in recipes:
            with self.subTest(one.name):
                self.assertGreater(one.checks["distinct"], 1)
                self.assertTrue(all(seconds >= 0 for seconds, _ in one.events()))

    def test_a_fault_is_a_line(self):
        self.assertEqual(self.faults(GOOD), [])
        for old, new, line in (
                ('category = "UI"', 'category = "4D"', "category '4D' is not UI, 2D or 3D"),
                ('api = "egl"', 'api = "vulkan"', "api 'vulkan' is not egl or glx"),
                ("frames = 10", "frames = 1", "frames is not in 2..2000"),
                ("begins = 1", "begins = true", "begins is not of type float"),
                ('licence = "MIT"', "", "licence is missing"),
                ('licence = "MIT"', 'licence = " "', "licence is empty"),
                ('licence = "MIT"', 'licence = "MIT"\nlicense = "MIT"', "line 5: unknown key 'license' (did you mean 'licence'?)"),
                ('packages = { nothing = "1" }', "packages = {}", "packages lists no package with its version"),
                ('command = ["true"]', "command = []", "command is not a list of words"),
                ('command = ["true"]', "", "neither command nor page"),
                ('api = "egl"', 'api = "egl"\npage = "/index.html"', "both command and page"),
                ('api = "egl"', 'api = "egl"\nfiles = { "/etc/motd" = "" }', "files: /etc/motd is not below HOME"),
                ("0.5 tap 1 2", "0.5 page swipe 1", "input 1: '0.5 page swipe 1': takes 5 numbers"),
                ("0.5 tap 1 2", "0.5 page jump", "input 1: '0.5 page jump': takes one of swipe, press, run"),
                ("distinct = 2, ", "", "checks: distinct is missing"),
                ("change = 0.1", 'change = "much"', "checks: change is not of type float"),
                ('api = "egl"', 'api = "egl"\nwindow = { size = "big" }', "window: size is not WIDTHxHEIGHT"),
                ('api = "egl"', 'api = "egl"\ndata = ["movies"]', "data 'movies' is not one of pictures, text, music, video"),
                ("0.5 tap 1 2", "0.5 tap 1", "input 1: '0.5 tap 1': takes 2 numbers"),
                ("0.5 tap 1 2", "0.5 jump", "input 1: '0.5 jump': the second word is not one of " + ", ".join(input_events.ACTIONS)),
                ("every = 2.0\n", "", "input 1: times without every")):
            self.assertEqual(self.faults(GOOD.replace(old, new)), [line])
        self.assertEqual(self.faults(GOOD.replace("every =", "evry =")),
                         ["line 13: input 1: unknown key 'evry' (did you mean 'every'?)"])
        self.assertEqual(recipe.read_recipes(self.folder, ["goood"], "")[1],
                         ["goood: no such recipe (did you mean 'good'? see tilepress corpus list)"])
        self.assertEqual(self.faults(GOOD, "other"), ["name 'good' differs from the file's name"])
        self.assertEqual(len(self.faults(GOOD.replace('"UI"', '"4D"').replace('"egl"', '"x"'))), 2)

    def test_that_are_bad_or_unknown_fail_the_command(self):
        self.faults(GOOD)
        self.faults("name =", "torn")
        done = subprocess.run([COMMAND, "corpus", "list", "--recipes", str(self.folder), "good", "torn", "none"],
                              capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("good                         UI", done.stdout)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 2)
        self.assertEqual(lines[0], "tilepress: none: no such recipe (see tilepress corpus list)")
        self.assertTrue(lines[1].startswith(f"tilepress: {self.folder}/torn.toml: "), lines[1])

    def test_options_of_another_command_are_usage(self):
        done = subprocess.run([COMMAND, "corpus", "list", "--install"], capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual((done.returncode, done.stderr), (2, "tilepress: --install is an option of corpus record\n"))


class Comparisons(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tilepress-compare-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "recipes").mkdir()
        (self.folder / "recipes/good.toml").write_text(GOOD, encoding="utf-8")

    def record(self, root, frames=10, width=720, vdcp=4.0):
        (self.folder / root / "good").mkdir(parents=True, exist_ok=True)
        info = {"name": "good", "category": "UI", "frames": frames, "width": width, "height": 1280, "change_percent": 1.5,
                "rates": {"vdcp": {"rate": vdcp}, "ras": {"rate": 2.0}}}
        (self.folder / root / "good/info.json").write_text(json.dumps(info), encoding="utf-8")

    def compare(self, *words):
        return subprocess.run([COMMAND, "corpus", "compare", "--recipes", "recipes", *words], cwd=self.folder,
                              capture_output=True, text=True, timeout=100, check=False)

    def test_allow_rates_within_the_tolerance(self):
        self.record("one")
        self.record("two", vdcp=4.18)
        done = self.compare("one", "two")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"good +UI +10 +720x1280 +4.00 4.18 .* 4.50 % +vdcp +5 %")
        self.assertIn("\n1 of 1 workload alike\n", done.stdout)

    def test_name_each_difference(self):
        self.record("one")
        self.record("two", frames=9, width=600, vdcp=4.3)
        done = self.compare("one", "two", "good")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.splitlines(), [
            "tilepress: good: frames 10 and 9", "tilepress: good: size 720x1280 and 600x1280",
            "tilepress: good: the rate of vdcp differs by 7.5 % (4.00 and 4.30), the recipe allows 5 %"])

    def test_name_what_is_missing(self):
        self.record("one")
        for words, code, line in ((("one",), 2, "corpus compare takes two folders of recorded workloads"),
                                  (("one", "two"), 1, "good: two/good: No such file or directory"),
                                  (("none", "two"), 1, "none: no recorded workload"),
                                  (("one", "two", "bad"), 1, "bad: no such recipe (see tilepress corpus list)")):
            done = self.compare(*words)
            self.assertEqual(done.returncode, code)
            self.assertTrue(done.stderr.startswith("tilepress: " + line), done.stderr)


class Events(unittest.TestCase):
    def test_repeat_and_are_sorted(self):
        blocks = [{"at": 1.0, "every": 2.0, "times": 2, "do": ["0.5 move 1 2", "0.0 key a"]}]
        events = input_events.expand(blocks)
        self.assertEqual([seconds for seconds, _ in events], [1.0, 1.5, 3.0, 3.5])
        self.assertEqual(events[1][1], ["mousemove", "1", "2"])

    def test_of_a_page_go_to_the_browser(self):
        self.assertEqual(input_events.parse("1 page run scrollTo(0, 9)"), (1.0, ["page", "run", "scrollTo(0,", "9)"]))
        self.assertEqual(devtools.message(["press", "3", "4"]),
                         ("Input.synthesizeTapGesture", {"x": 3.0, "y": 4.0, "gestureSourceType": "touch"}))

    def test_keys_stay_pressed(self):
        self.assertEqual(input_events.parse("0 press Up a")[1], ["keydown", "Up", "keydown", "a"])

    def test_a_drag_ends_where_it_says(self):
        _, words = input_events.parse("0 drag 0 0 100 50 0.5")
        last = len(words) - words[::-1].index("mousemove") - 1
        self.assertEqual(words[last:last + 3], ["mousemove", "100", "50"])


class Regions(unittest.TestCase):
    def test_are_frames_of_one_surface_after_the_begin(self):
        swaps = [trimming.Swap(10 * number, "popup" if number % 4 == 0 else "window") for number in range(12)]
        presents = [Present(float(number), (1, 1), (0, 0.0)) for number in range(12)]
        self.assertEqual(trimming.choose_region(swaps, presents, 2.5, 4), [3, 5, 6, 7])
        with self.assertRaisesRegex(Fault, "only 7 of 9 frames"):
            trimming.choose_region(swaps, presents, 2.5, 9)
        with self.assertRaisesRegex(Fault, "no frame was presented after 20 s"):
            trimming.choose_region(swaps, presents, 20, 1)

    def test_calls_are_left_out(self):
        self.assertEqual(trimming.call_set(9, [0, 3, 4]), "1-2,5-9")


class Results(unittest.TestCase):
    def test_fill_every_place_of_the_text(self):
        places = re.findall(r"\{\{([^{}]+)\}\}", (CORPUS / "results_text.md").read_text(encoding="utf-8"))
        self.assertGreater(len(places), 50)
        for place in places:
            kind, _, name = place.partition(":")
            function = f"table_{name}" if kind == "table" else f"value_{place.split()[0]}"
            if kind != "figure":
                self.assertTrue(hasattr(results_values.Values, function.replace("-", "_")), place)
        page = (CORPUS / "RESULTS.md").read_text(encoding="utf-8")
        self.assertNotIn("{{", page)
        for drawing in re.findall(r"\]\((results/[^)]*)\)", page):
            self.assertTrue((CORPUS / drawing).is_file(), drawing)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
