#!/usr/bin/env python3
"""Studies of images and finished runs, from outside.

Usage: study_cli.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import glob
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cli_case import COMMAND, GOLDEN, CliCase, golden, main, read_json, read_rows
import slurm_cluster

STUDY = """name = "small"
configurations = ["vdcp", "ras", "hdcp"]
[[category]]
name = "UI"
workloads = ["desk*"]
[[axis]]
name = "fvc"
scheme = "vdcp"
key = "fvc"
values = [{values}]
"""
TABLES = ["results.csv", "means.csv", "workloads.csv", "frame_metrics.csv", "color_cdf.csv", "frame_rates.csv"]
SUMMED = ["blocks", "raw_bits", "payload_bits", "bursts", "csb_bits", "palette_bits"]


def content(path):
    with open(path, "rb") as file:
        return file.read()


class StudyCase(CliCase):
    draws = False  # Drawing takes most of the time of a small study.

    def setUp(self):
        super().setUp()
        self.environment = {}
        if not self.draws:
            os.mkdir(self.path("programs"))
            self.write("programs/python3", b"#!/bin/sh\nexit 0\n")
            os.chmod(self.path("programs/python3"), 0o755)
            self.environment["PATH"] = self.path("programs") + ":" + os.environ["PATH"]
        self.write("small.toml", STUDY.format(values="16, 64").encode())
        for name in ("desktop", "map"):
            os.mkdir(self.path(name))
            for number in range(3):
                shutil.copy(self.source(name, number), self.path(f"{name}/{number}.png"))

    @staticmethod
    def source(name, number):
        """Small frames: most of the time goes into modelling."""
        return golden("odd", number + {"desktop": 0, "map": 2}[name])

    def make_long_workload(self):
        """A workload of some seconds."""
        os.mkdir(self.path("long"))
        for number in range(300):
            os.symlink(golden("odd", number % 5), self.path(f"long/{number:03}.png"))

    def run_command(self, *words, env=None, **further):
        return super().run_command(*words, env={**self.environment, **(env or {})}, **further)

    def study(self, *words, status=0, **further):
        """Returns (computed, kept) as the summary says."""
        done = self.run_command("study", "small.toml", *words, **further)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, status, text)
        self.stderr = text
        found = re.search(r"results: (\d+) computed, (\d+) kept", text)
        return (int(found.group(1)), int(found.group(2))) if found else None

    def rows(self, name, folder="out"):
        return read_rows(self.path(f"{folder}/{name}"))

    def lines(self):
        return [line for line in self.stderr.splitlines() if line.startswith("tilepress: ")]


class Results(StudyCase):
    def test_are_the_sums_of_the_rows_of_frames(self):
        self.assertEqual(self.study("-o", "out", "desktop", "map"), (8, 0))
        rows = self.rows("results.csv")
        self.assertEqual([(row["workload"], row["configuration"]) for row in rows],
                         [(workload, scheme) for workload in ("desktop", "map")
                          for scheme in ("vdcp", "ras", "hdcp", "vdcp:fvc=16")])
        for row in rows:
            folder = f"run-{row['workload']}"
            if not os.path.exists(self.path(folder)):
                words = [word for spec in ("vdcp", "ras", "hdcp", "vdcp:fvc=16") for word in ("-s", spec)]
                images = sorted(glob.glob(self.path(row["workload"]) + "/*.png"))
                self.assertEqual(self.run_command("frames", "-q", *words, "-o", folder, *images).returncode, 0)
            frames = [frame for frame in self.rows("schemes.csv", folder)
                      if frame["scheme"] == row["configuration"] and frame["warmup"] == "0"]
            self.assertEqual(int(row["frames"]), 2)
            for name in SUMMED:
                self.assertEqual(int(row[name]), sum(int(frame[name]) for frame in frames), (row["configuration"], name))
            moved = int(row["bursts"]) * 128 + int(row["csb_bits"]) + int(row["palette_bits"])
            self.assertEqual(int(row["moved_bits"]), moved)
            self.assertAlmostEqual(float(row["rate"]), int(row["raw_bits"]) / moved, 9)
            self.assertEqual(row["vdcp_blocks"] != "", row["scheme"] == "hdcp")

    def test_have_keys_with_defaults_and_none_of_other_schemes(self):
        self.study("-o", "out", "desktop")
        rows = {row["configuration"]: row for row in self.rows("results.csv")}
        self.assertEqual(rows["vdcp"]["fvc"], "64")
        self.assertEqual(rows["vdcp:fvc=16"]["fvc"], "16")
        self.assertEqual(rows["vdcp"]["policy"], "lfc")
        self.assertEqual(rows["ras"]["fvc"], "")
        self.assertEqual(rows["ras"]["ycocg"], "0")
        self.assertEqual(rows["ras"]["energy_nj"], "")
        # 451.2 pJ per byte moved and 4.83 pJ per raw byte.
        vdcp = rows["vdcp"]
        self.assertAlmostEqual(float(vdcp["energy_nj"]),
                               (int(vdcp["moved_bits"]) * 451.2 + int(vdcp["raw_bits"]) * 4.83) / 8000, 3)

    def test_have_harmonic_means_by_category_and_over_all(self):
        self.study("-o", "out", "desktop", "map")
        rates = {(row["workload"], row["configuration"]): float(row["rate"]) for row in self.rows("results.csv")}
        means = {(row["category"], row["configuration"]): row for row in self.rows("means.csv")}
        self.assertEqual(list(dict.fromkeys(category for category, _ in means)), ["UI", "other", "all"])
        both = [rates["desktop", "ras"], rates["map", "ras"]]
        mean = means["all", "ras"]
        self.assertEqual(mean["workloads"], "2")
        self.assertAlmostEqual(float(mean["rate_hmean"]), 2 / (1 / both[0] + 1 / both[1]), 9)
        self.assertAlmostEqual(float(mean["rate_min"]), min(both), 9)
        self.assertAlmostEqual(float(mean["rate_median"]), sum(both) / 2, 9)
        self.assertAlmostEqual(float(means["UI", "ras"]["rate_max"]), both[0], 9)

    def test_can_be_traced_to_files_and_digests(self):
        self.study("-o", "out", "desktop")
        entry = read_json(self.path("out/provenance.json"))["workloads"][0]
        digests = "".join(hashlib.sha256(content(self.path(f"desktop/{number}.png"))).hexdigest() + "\n"
                          for number in range(3))
        self.assertEqual(entry["source_sha256"], hashlib.sha256(digests.encode()).hexdigest())
        self.assertEqual([result["configuration"] for result in entry["results"]], ["vdcp", "ras", "hdcp", "vdcp:fvc=16"])
        for result in entry["results"]:
            names = {row["scheme"] for row in read_rows(self.path("out/" + result["rows"]))}
            self.assertEqual(names, {result["configuration"]})
            self.assertRegex(result["computed"]["date"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")


class Bounds(StudyCase):
    NAMES = ["lz4_block", "zstd_block", "lz4_frame", "zstd_frame", "webp_frame"]

    def test_are_results_like_others(self):
        self.assertEqual(self.study("-o", "out", "--bounds", "desktop", "map"), (18, 0))
        rows = self.rows("bounds.csv")
        self.assertEqual([(row["workload"], row["bound"]) for row in rows],
                         [(workload, name) for workload in ("desktop", "map") for name in self.NAMES])
        for row in rows:
            self.assertEqual((row["frames"], row["csb_bits"]), ("2", "0"))
            self.assertEqual(int(row["moved_bits"]), int(row["bursts"]) * 128)
            self.assertAlmostEqual(float(row["rate"]), int(row["raw_bits"]) / int(row["moved_bits"]), 9)
        rates = {(row["workload"], row["bound"]): float(row["rate"]) for row in rows}
        self.assertGreater(rates["desktop", "zstd_frame"], rates["desktop", "zstd_block"])
        means = {(row["category"], row["bound"]): row for row in self.rows("bound_means.csv")}
        self.assertEqual(list(dict.fromkeys(category for category, _ in means)), ["UI", "other", "all"])
        for name in self.NAMES:
            mean = 2 / sum(1 / rates[workload, name] for workload in ("desktop", "map"))
            self.assertAlmostEqual(float(means["all", name]["rate_hmean"]), mean, 9)
        self.assertEqual({row["webp_frame"] for row in self.rows("figures/means.csv") if row["category"] == "UI"},
                         {means["UI", "webp_frame"]["rate_hmean"]})
        self.assertIn("zstd, each block alone", content(self.path("out/study.html")).decode())
        # Kept, split, and left out.
        tables = {name: content(self.path("out/" + name)) for name in ("bounds.csv", "bound_means.csv", "results.csv")}
        self.assertEqual(self.study("-o", "out", "--bounds", "desktop", "map"), (0, 18))
        for part in ("1/3", "2/3", "3/3"):
            self.study("-o", "parts", "--bounds", "--shard", part, "desktop", "map")
        self.assertEqual(self.run_command("study", "merge", "parts").returncode, 0)
        for name, text in tables.items():
            self.assertEqual(content(self.path("parts/" + name)), text)
        self.assertEqual(self.study("-o", "out", "desktop", "map"), (0, 8))
        self.assertFalse(os.path.exists(self.path("out/bounds.csv")))
        self.assertEqual(content(self.path("out/results.csv")), tables["results.csv"])


class Bursts(StudyCase):
    draws = True

    def test_of_a_study_are_modelled_beside_that_of_the_call(self):
        self.write("small.toml", STUDY.format(values="16").replace("[[category]]", "bursts = [128, 256]\n[[category]]").encode())
        self.assertEqual(self.study("-o", "out", "desktop", "map"), (16, 0))
        self.assertEqual(self.study("-o", "out", "desktop", "map"), (0, 16))
        means = {row["configuration"]: row["rate_hmean"] for row in self.rows("means.csv") if row["category"] == "all"}
        bursts = {(row["configuration"], row["burst_bits"]): row for row in self.rows("sensitivity.csv") if row["category"] == "all"}
        self.assertEqual(len(bursts), 8)
        self.assertEqual(bursts["ras", "256"]["dram"], "lpddr3 lpddr4 lpddr5")
        for name, rate in means.items():
            self.assertEqual(bursts[name, "128"]["rate_hmean"], rate)
        tables = content(self.path("out/sensitivity.csv"))
        self.assertEqual(self.study("-o", "out", "--burst", "256", "desktop", "map"), (0, 16))
        self.assertEqual(content(self.path("out/sensitivity.csv")), tables)
        means = {row["configuration"]: row["rate_hmean"] for row in self.rows("means.csv") if row["category"] == "all"}
        self.assertEqual(bursts["hdcp", "256"]["rate_hmean"], means["hdcp"])
        self.assertEqual({row["burst"] for row in self.rows("figures/sensitivity.csv")}, {"128", "256"})
        self.assertTrue(os.path.exists(self.path("out/figures/sensitivity.svg")))


class Calls(StudyCase):
    def test_compute_only_what_is_new(self):
        self.assertEqual(self.study("-o", "out", "desktop"), (4, 0))
        before = content(self.path("out/results.csv"))
        self.assertEqual(self.study("-o", "out", "desktop"), (0, 4))
        self.assertEqual(content(self.path("out/results.csv")), before)
        self.write("small.toml", STUDY.format(values="16, 64, 32").encode())
        self.assertEqual(self.study("-o", "out", "desktop"), (1, 4))
        self.assertEqual(self.study("-o", "out", "--burst", "256", "desktop"), (5, 0))
        self.assertEqual({row["burst_bits"] for row in self.rows("results.csv")}, {"256"})
        self.assertEqual(self.study("-o", "out", "desktop", "map"), (5, 5))

    def test_give_the_same_bytes_for_any_jobs_chunks_and_shards(self):
        self.study("-o", "one", "-j", "1", "desktop", "map")
        self.study("-o", "two", "-j", "2", "--chunk", "2", "desktop", "map")
        for part in (2, 3, 1):
            self.study("-o", "parts", "--chunk", "1", "--shard", f"{part}/3", "desktop", "map")
            self.assertFalse(os.path.exists(self.path("parts/results.csv")))
        self.assertEqual(self.run_command("study", "merge", "parts").returncode, 0)
        for table in TABLES + ["study.json"]:
            for folder in ("two", "parts"):
                self.assertEqual(content(self.path(f"{folder}/{table}")), content(self.path(f"one/{table}")), table)

    def test_that_are_killed_lose_only_what_runs(self):
        self.make_long_workload()
        words = ["study", "small.toml", "-o", "out", "-j", "1", "--chunk", "1", "desktop", "long"]
        with subprocess.Popen([COMMAND, *words], cwd=self.folder, stderr=subprocess.DEVNULL) as process:
            def is_running():
                done = self.run_command("study", "status", "out")
                return re.search(rb"running +long", done.stdout)
            self.wait_until(lambda: os.path.exists(self.path("out/invocation.json")), process)
            self.wait_until(is_running, process)
            process.send_signal(signal.SIGKILL)
        status = self.run_command("study", "status", "out")
        self.assertEqual(status.returncode, 1)
        self.assertRegex(status.stdout.decode(), r"failed +long, \d configurations?: was cut off \(.*process \d+\)")
        stored = len(glob.glob(self.path("out/results/*/*.csv")))
        self.assertGreaterEqual(stored, 3 + 2)  # all of desktop but one, and its metrics
        merged = self.run_command("study", "merge", "out")
        self.assertEqual(merged.returncode, 1)
        self.assertIn(b"tasks are not done", merged.stderr)
        retried = self.run_command("study", "retry", "out")
        self.assertEqual(retried.returncode, 0, retried.stderr)
        kept = int(re.search(r"(\d+) kept", retried.stderr.decode()).group(1))
        self.assertGreaterEqual(kept, 3)
        self.assertEqual(len(self.rows("results.csv")), 8)
        self.assertEqual(self.run_command("study", "status", "out").stdout.decode().splitlines()[1:], [])
        self.assertEqual(glob.glob(self.path("out/**/*.part"), recursive=True), [])

    def test_that_a_signal_ends_say_so_and_go_on_later(self):
        self.make_long_workload()
        with subprocess.Popen([COMMAND, "study", "small.toml", "-o", "out", "-q", "long"], cwd=self.folder,
                              stderr=subprocess.PIPE) as process:
            self.wait_until(lambda: glob.glob(self.path("out/tasks/*.lock")), process)
            process.send_signal(signal.SIGTERM)
            text = process.stderr.read().decode()
        self.assertIn("tilepress: killed by signal 15 (Terminated): 0 results computed; call again to go on", text)
        self.assertEqual(process.returncode, 128 + 15)
        self.assertEqual(self.study("-o", "out", "--frames", "0-1", "long"), (4, 0))


class Inputs(StudyCase):
    def test_that_fail_are_named_and_the_others_go_on(self):
        self.write("map/1.png", content(golden("map", 1))[:2000])
        self.study("-o", "out", "desktop", "map", "nowhere", "x*.trace", status=1)
        self.assertEqual(len([line for line in self.lines() if "map" in line]), 1, self.stderr)
        self.assertIn("tilepress: nowhere: No such file or directory", self.lines())
        self.assertIn("tilepress: x*.trace: matches no file", self.lines())
        rows = self.rows("workloads.csv")
        self.assertEqual([(row["workload"], row["status"]) for row in rows], [("desktop", "done"), ("map", "failed")])
        self.assertIn("1.png", rows[1]["reason"])
        self.assertEqual({row["workload"] for row in self.rows("results.csv")}, {"desktop"})
        self.assertEqual(self.run_command("study", "status", "out").returncode, 1)
        shutil.copy(self.source("map", 1), self.path("map/1.png"))
        retried = self.run_command("study", "retry", "out")
        self.assertEqual(retried.returncode, 1, "two inputs are still missing")
        self.assertEqual([row["status"] for row in self.rows("workloads.csv")], ["done", "done"])

    def test_are_images_by_folder_patterns_and_movies(self):
        os.mkdir(self.path("all"))
        shutil.copytree(self.path("desktop"), self.path("all/desktop"))
        shutil.copytree(self.path("map"), self.path("all/map"))
        self.study("-o", "a", "all")
        self.study("-o", "b", "all/*/*.png")
        self.assertEqual(content(self.path("a/results.csv")), content(self.path("b/results.csv")))
        self.study("-o", "c", "desktop/0.png", "map/0.png", "desktop/1.png")
        self.assertEqual([row["workload"] for row in self.rows("workloads.csv", "c")], ["desktop", "map", "desktop-2"])

    def test_that_are_finished_runs_give_their_rows(self):
        images = [f"desktop/{number}.png" for number in range(3)]
        run = ["frames", "-q", "-s", "vdcp:fvc=16", "-s", "vdcp:fvc=64", "-s", "hdcp", "-s", "ras"]
        self.assertEqual(self.run_command(*run, "-o", "runs/desk-1", *images).returncode, 0)
        self.study("-o", "a", "desktop")
        self.study("-o", "b", "runs")
        for left, right in zip(self.rows("results.csv", "a"), self.rows("results.csv", "b"), strict=True):
            self.assertEqual({**left, "workload": "desk"}, right)
        # A run of an older version, which lacks columns and some configurations.
        old = [re.sub(r"(,[^,]*){3}$", "", line) for line in
               content(self.path("runs/desk-1/schemes.csv")).decode().splitlines() if ",ras," not in line]
        header = old[0].split(",")
        old = [",".join(line.split(",")[:header.index("rate") + 1]) for line in old]
        self.write("runs/desk-1/schemes.csv", ("\n".join(old) + "\n").encode())
        self.study("-o", "c", "runs")
        rows = self.rows("results.csv", "c")
        self.assertEqual([row["configuration"] for row in rows], ["vdcp", "hdcp", "vdcp:fvc=16"])
        self.assertEqual(rows[1]["vdcp_blocks"], "")
        workload = self.rows("workloads.csv", "c")[0]
        self.assertEqual((workload["status"], workload["reason"]), ("partial", "the run lacks 1 of 4 configurations"))
        self.study("-o", "d", "--burst", "256", "runs", status=1)
        self.assertRegex(self.stderr, r"tilepress: .*/runs/desk-1: was made with burst\w* 128, not 256 as the study")

    def test_get_categories_from_rules_before_patterns(self):
        self.study("-o", "out", "--category", "*k*=3D", "--category", "*x*=2D", "desktop", "map")
        self.assertEqual([row["category"] for row in self.rows("workloads.csv")], ["3D", "other"])
        self.assertIn("tilepress: category 'UI' has no workload", self.lines())
        self.assertIn("tilepress: --category *x*=2D matches no workload", self.lines())


class StudyFiles(StudyCase):
    def test_are_refused_with_the_line(self):
        for text, line in (
                ('name = "x"\nconfigurations = ["vdcp:fcv=3"]', "line 2: "),
                ('name = "x"\ncolour = 1', "line 2: unknown key 'colour'"),
                ('configurations = ["vdcp"]', "line 1: name = \"...\" is missing"),
                ('name = "x"\nconfigurations = ["red"]\nbursts = [100]', "line 3: burst"),
                ('name = "x"', "has no configurations (list them, or declare an [[axis]])"),
                ('name = "x"\n[[axis]]\nname = "a"\nscheme = "vdcp"\nkey = "fvc"\nvalues = [3]', "line 2: axis 'a': "),
                ('name = "x"\n[[axis]]\nname = "a"', "line 2: an axis needs name, scheme and key"),
                ('name = "x"\nbaseline = "ras"\nconfigurations = ["red"]', "line 2: baseline 'ras' is no configuration"),
                ("name = ", "line 1: ")):
            self.write("bad.toml", text.encode())
            done = self.run_command("study", "bad.toml", "-o", "out", "desktop")
            self.assertEqual(done.returncode, 2, text)
            self.assertTrue(done.stderr.decode().startswith(f"tilepress: bad.toml: {line}"), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assert_absent("out")

    def test_with_an_axis_without_values_leave_the_axis_out(self):
        self.write("small.toml", STUDY.format(values="").encode())
        self.assertEqual(self.study("-o", "out", "desktop"), (3, 0))
        self.assertIn("tilepress: axis 'fvc' has no values and is left out", self.lines())

    def test_that_are_the_example_run(self):
        done = self.run_command("study", "--example")
        self.write("mine.toml", done.stdout)
        planned = self.run_command("study", "mine.toml", "-n", "-o", "out", "desktop")
        self.assertEqual(planned.returncode, 0, planned.stderr)
        # vdcp, ras, red, hdcp; fvc = 16, 32, 128, 256; lru with sample = 1, 4, 16.
        self.assertIn(b"0/11", planned.stdout)
        self.assert_absent("out")

    def test_that_are_built_in_hold_every_configuration_of_the_paper(self):
        planned = self.run_command("study", "paper", "-n", "-o", "out", "desktop")
        self.assertIn(b"0/42", planned.stdout)

    def test_name_inputs_relative_to_themselves(self):
        os.mkdir(self.path("sub"))
        self.write("sub/mine.toml", b'name = "x"\nconfigurations = ["red"]\ninputs = ["../desktop"]')
        self.assertEqual(self.run_command("study", "sub/mine.toml", "-q", "-o", "out").returncode, 0)
        self.assertEqual(len(self.rows("results.csv")), 1)
        self.expect(2, "no input given (see tilepress study --help)", "study", "small.toml", "-o", "out")


class Disks(StudyCase):
    def test_that_are_full_are_named_once_and_leave_whole_files(self):
        disk = self.path("disk")
        os.mkdir(disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=40k", "tmpfs", disk], capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("no right to mount a small disk")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        self.study("-o", "disk/out", "-j", "1", "--chunk", "1", "desktop", "map", status=1)
        self.assertTrue(all("No space left on device" in line for line in self.lines() if "disk" in line), self.stderr)
        self.assertEqual(glob.glob(disk + "/**/*.part", recursive=True), [])


@unittest.skipUnless(slurm_cluster.is_possible(), "needs root, Slurm's daemons, a host name that resolves, and control groups")
class Slurm(StudyCase):
    def test_runs_an_array_job_and_retries_a_killed_task(self):
        self.make_long_workload()
        inputs = ["desktop", "long"]
        self.study("-o", "here", "--chunk", "2", *inputs)
        with slurm_cluster.SlurmCluster(self.path("slurm")) as cluster:
            words = ["-o", "out", "--chunk", "2", "--launcher", "slurm", *inputs]
            self.study(*words, env=cluster.environment)
            self.assertRegex(self.stderr, r"4 tasks submitted as array job \d+")
            deadline = time.monotonic() + 200
            worker = None
            while worker is None:
                self.assertLess(time.monotonic(), deadline, cluster.answer("squeue"))
                text = self.run_command("study", "status", "out").stdout.decode()
                self.assertNotIn(" 4 done", text, "the tasks ended before one could be killed")
                worker = re.search(r"running +long, .*process (\d+)", text)
            os.kill(int(worker.group(1)), signal.SIGKILL)
            cluster.wait_until_empty()
            status = self.run_command("study", "status", "out")
            self.assertEqual(status.returncode, 1)
            self.assertIn(b"1 failed", status.stdout)
            retried = self.run_command("study", "retry", "out", "--launcher", "slurm", env=cluster.environment)
            self.assertRegex(retried.stderr.decode(), r"1 task submitted as array job \d+")
            cluster.wait_until_empty()
            self.assertEqual(self.run_command("study", "status", "out").stdout.decode(),
                             "4 tasks: 4 done, 0 running, 0 failed, 0 never run\n")
        for table in TABLES:
            self.assertEqual(content(self.path(f"out/{table}")), content(self.path(f"here/{table}")), table)

    def test_that_is_not_there_is_one_line(self):
        done = self.run_command("study", "small.toml", "-o", "out", "--launcher", "slurm", "desktop", env={"PATH": "/nowhere"})
        self.assertEqual(done.stderr.decode().splitlines()[-1], "tilepress: --launcher slurm: sbatch is not there")
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    main()
