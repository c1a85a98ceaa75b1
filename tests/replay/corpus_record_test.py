#!/usr/bin/env python3
"""Recording, verifying and exporting a small workload; the files of the core set.

Usage: corpus_record_test.py TILEPRESS CORE_FOLDER"""
import hashlib
import json
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

COMMAND, CORE = sys.argv[1], Path(sys.argv[2])
RECIPE = """name = "{name}"
category = "3D"
stands_for = "tests"
licence = "GPL-3+"
packages = {{ glmark2-es2-x11 = "1" }}
command = ["glmark2-es2", "--size", "96x64", "-b", "build:nframes=400:duration=100"]
api = "egl"
window = {{ size = "96x64", manager = "none" }}
begins = {begins}
frames = 6
checks = {{ distinct = {distinct}, change = 0.01, rate_tolerance = 5.0 }}

[[input]]
at = 0.0
do = ["0.0 move 10 10"]
"""


def corpus(*words):
    return subprocess.run([COMMAND, "corpus", *map(str, words)], capture_output=True, text=True, timeout=400, check=False)


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tilepress-corpus-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.recipes, self.output = self.folder / "recipes", self.folder / "out"
        self.recipes.mkdir()

    def write(self, name, begins=0.05, distinct=2):
        (self.recipes / f"{name}.toml").write_text(RECIPE.format(name=name, begins=begins, distinct=distinct), encoding="utf-8")

    def test_leaves_a_workload_that_verifies_until_it_is_changed(self):
        self.write("cube")
        broken = RECIPE.format(name="absent", begins=1, distinct=2).replace('"glmark2-es2"', '"no-such-program"')
        (self.recipes / "absent.toml").write_text(broken, encoding="utf-8")
        done = corpus("record", "-q", "-o", self.output, "--recipes", self.recipes, "absent", "cube")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"\Atilepress: absent: .*\n\Z")
        self.assertEqual(sorted(path.name for path in self.output.iterdir()), ["cube"])
        folder = self.output / "cube"
        self.assertEqual(sorted(path.name for path in folder.iterdir()),
                         ["copyright", "cube.trace", "info.json", "log.txt", "sha256", "thumbnail.png"])
        subprocess.run(["sha256sum", "--quiet", "-c", "sha256"], cwd=folder, check=True, timeout=60)
        info = json.loads((folder / "info.json").read_text(encoding="utf-8"))
        self.assertEqual((info["frames"], info["width"], info["height"], len(info["frame_digests"])), (6, 96, 64, 6))
        self.assertEqual(info["equals"], "program")
        self.assertEqual(sorted(info["rates"]), ["adcp", "dcp", "hdcp", "huffdcp", "ras", "red", "vdcp"])

        done = corpus("verify", "-q", "-o", self.output)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.export(folder)

        info["rates"]["ras"]["rate"] += 1
        (folder / "info.json").write_text(json.dumps(info), encoding="utf-8")
        done = corpus("verify", "-q", "-o", self.output)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "tilepress: cube: the frames are equal, but the rates of ras differ from the recorded ones\n"))
        (folder / "cube.trace").write_bytes(b"torn")
        done = corpus("verify", "-q", "-o", self.output)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "tilepress: cube: the trace differs from the recorded one (SHA-256)\n"))

    def export(self, folder):
        archives = []
        for name in ("one", "two"):
            archive = self.folder / name / "set.tar"
            archive.parent.mkdir()
            done = corpus("export", "-q", "-o", self.output, "--archive", archive)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            archives.append(archive.read_bytes())
        self.assertEqual(hashlib.sha256(archives[0]).digest(), hashlib.sha256(archives[1]).digest())
        with tarfile.open(archive) as tar:
            tar.extractall(self.folder / "unpacked")
        root = self.folder / "unpacked/set"
        subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=root, check=True, timeout=60)
        self.assertEqual((root / "cube/cube.trace").read_bytes(), (folder / "cube.trace").read_bytes())
        done = subprocess.run([COMMAND, "study", "paper", "-n", "-o", str(self.folder / "plan"), str(root / "manifest.toml")],
                              capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_refuses_what_the_recipe_does_not_promise(self):
        self.write("lazy", distinct=6)
        text = (self.recipes / "lazy.toml").read_text(encoding="utf-8").replace("change = 0.01", "change = 99.9")
        (self.recipes / "lazy.toml").write_text(text, encoding="utf-8")
        done = corpus("record", "-q", "-o", self.output, "--recipes", self.recipes)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Atilepress: lazy: [\d.]+ % of the pixels change, the recipe asks for 99.9 %\n\Z")
        self.assertEqual(list(self.output.iterdir()), [])


class Core(unittest.TestCase):
    def test_set_has_all_categories_and_is_small(self):
        infos = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(CORE.glob("*/info.json"))]
        self.assertEqual({info["category"] for info in infos}, {"UI", "2D", "3D"})
        self.assertLess(sum(path.stat().st_size for path in CORE.rglob("*") if path.is_file()), 16 << 20)
        for info in infos:
            folder = CORE / info["name"]
            trace = (folder / f"{info['name']}.trace").read_bytes()
            self.assertEqual(hashlib.sha256(trace).hexdigest(), info["trace_sha256"], info["name"])
            self.assertTrue((folder / "copyright").is_file())
            self.assertIn(info["trace_sha256"], (CORE / "manifest.toml").read_text(encoding="utf-8"), info["name"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
