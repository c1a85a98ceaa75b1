#!/usr/bin/env python3
"""Studies of traces: each is rendered once, and results equal those of `tilepress replay`.

Usage: study_traces.py TILEPRESS GOLDEN_FOLDER TRACE_FOLDER [TEST...]"""
import os
import re
import shutil
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
TRACES = os.path.abspath(sys.argv.pop(3))
from cli_case import CliCase, main, read_json, read_rows

NAMES = ["glmark2-desktop-egl", "glmark2-desktop-glx"]
STUDY = """name = "traces"
configurations = ["vdcp", "hdcp"]
[[axis]]
name = "period"
scheme = "vdcp"
key = "period"
values = [1, 2]
"""
SCHEMES = ["vdcp", "hdcp", "vdcp:period=2"]
FRAMES = ["--frames", "0-9"]
SUMMED = ["blocks", "raw_bits", "payload_bits", "bursts", "csb_bits", "palette_bits"]


class Traces(CliCase):
    def setUp(self):
        super().setUp()
        self.write("s.toml", STUDY.encode())
        self.traces = [os.path.join(TRACES, name + ".trace") for name in NAMES]

    def study(self, *words, status=0):
        done = self.run_command("study", "s.toml", "-v", "--cache", "cache", "-o", "out", *FRAMES, *words)
        self.assertEqual(done.returncode, status, done.stderr)
        self.stderr = done.stderr.decode()
        return tuple(int(number) for number in re.search(
            r"traces: +(\d+) rendered, (\d+) from the cache\n +results: (\d+) computed, (\d+) kept", self.stderr).groups())

    def test_are_rendered_once_and_equal_a_replay(self):
        self.assertEqual(self.study(*self.traces), (2, 0, 6, 0))
        replay = [word for scheme in SCHEMES for word in ("-s", scheme)]
        self.assertEqual(self.run_command("replay", "-q", *FRAMES, *replay, "-o", "replayed", *self.traces).returncode, 0)
        for row in read_rows(self.path("out/results.csv")):
            frames = [frame for frame in read_rows(self.path(f"replayed/{row['workload']}/schemes.csv"))
                      if frame["scheme"] == row["configuration"] and frame["warmup"] == "0"]
            self.assertEqual(int(row["frames"]), len(frames))
            for name in SUMMED:
                self.assertEqual(int(row[name]), sum(int(frame[name]) for frame in frames), (row["configuration"], name))
        workload = read_json(self.path("out/provenance.json"))["workloads"][0]
        run = read_json(self.path(f"replayed/{NAMES[0]}/run.json"))
        self.assertEqual(workload["source_sha256"], run["trace_sha256"])
        self.assertRegex(workload["gl_renderer"], "llvmpipe|softpipe|.")
        self.assertEqual(self.study("--burst", "256", *self.traces), (0, 2, 6, 0))
        self.assertNotIn("rendered", self.stderr.split("study traces:")[0])
        self.assertEqual(self.study(*self.traces), (0, 2, 0, 6))

    def test_that_fail_are_named_and_the_others_go_on(self):
        with open(self.traces[0], "rb") as file:
            self.write("torn.trace", file.read()[:3000])
        self.assertEqual(self.study("torn.trace", self.traces[1], status=1)[2:], (3, 0))
        self.assertIn("torn.trace: ", self.stderr)
        rows = read_rows(self.path("out/workloads.csv"))
        self.assertEqual([(row["workload"], row["status"]) for row in rows], [("torn", "failed"), (NAMES[1], "done")])

    def test_that_lost_their_cache_keep_their_results(self):
        self.study(self.traces[0])
        shutil.rmtree(self.path("cache"))
        self.assertEqual(self.study(self.traces[0])[2:], (0, 3))


if __name__ == "__main__":
    main()
