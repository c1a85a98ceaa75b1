#!/usr/bin/env python3
"""Schemes of `--plugin`: in every verb that takes them, and what hostile libraries come to.

Usage: cli_plugin_test.py TILEPRESS GOLDEN_FOLDER PLUGIN_FOLDER LONELY_FRAMES [TEST...]"""
import glob
import os
import shutil
import subprocess
import sys

PLUGINS, PROGRAM = (os.path.abspath(path) for path in sys.argv[3:5])
del sys.argv[3:5]

from cli_case import CliCase, COMMAND, golden, main, read_json, read_rows  # noqa: E402  (it reads sys.argv)

FAILED, USAGE, PROGRAM_STATUS = 1, 2, 7
IMAGES = [golden("odd", number) for number in range(3)]


def plugin(name):
    return os.path.join(PLUGINS, name + ".so")


class PluginCase(CliCase):
    def done(self, *words, status=0, **further):
        done = self.run_command(*words, **further)
        self.assertEqual(done.returncode, status, done.stderr.decode())
        return done


class Works(PluginCase):
    def test_as_a_scheme_among_others(self):
        self.done("frames", "-q", "--plugin", plugin("rowpal"), "-s", "rowpal:slots={4,64}", "-s", "vdcp", "--verify",
                  "-o", "out", *IMAGES)
        rows = [row for row in read_rows(self.path("out/schemes.csv")) if row["frame"] == "2"]
        self.assertEqual([row["scheme"] for row in rows], ["rowpal:slots=4", "rowpal:slots=64", "vdcp"])
        for row in rows:
            self.assertEqual((row["checked_blocks"], row["mismatched_blocks"]), (row["blocks"], "0"))
        self.assertGreater(int(rows[1]["rowpal_rows"]), int(rows[0]["rowpal_rows"]))
        self.assertEqual(rows[2]["rowpal_rows"], "0")
        # 8 bits a row that is raw or indices of 6 bits, of 8 pixels each.
        known = int(rows[1]["rowpal_rows"])
        self.assertEqual(int(rows[1]["payload_bits"]), 8 * (known * 6 + (8 * int(rows[1]["blocks"]) - known) * 32))
        self.assertEqual(read_json(self.path("out/run.json"))["options"]["plugin"], plugin("rowpal"))

    def test_its_rows_are_those_of_one_job(self):
        for jobs in ("1", "3"):
            self.done("frames", "-q", "--plugin", plugin("rowpal"), "-s", "rowpal", "-j", jobs, "-o", "out" + jobs, *IMAGES)
        self.assertEqual(read_rows(self.path("out1/schemes.csv")), read_rows(self.path("out3/schemes.csv")))

    def test_in_lists_reports_and_a_configuration_file(self):
        told = self.done("schemes", "--plugin", plugin("rowpal")).stdout.decode()
        self.assertIn("  rowpal    rows of a block as palette indices\n            a plugin\n            keys: slots\n", told)
        self.assertNotIn("rowpal", self.done("schemes").stdout.decode())
        self.write("options.toml", f'plugin = "{plugin("rowpal")}"\nscheme = ["rowpal", "red"]\n'.encode())
        self.done("frames", "-q", "--config", "options.toml", "-o", "out", *IMAGES[:2])
        self.done("report", "-o", "page.html", "out")
        with open(self.path("page.html"), encoding="utf-8") as page:
            self.assertIn("rate rowpal", page.read())
        self.assertIn(b"rowpal", self.done("summary", "out").stdout)

    def test_in_packed_files_and_bench(self):
        self.done("pack", "-q", "--plugin", plugin("rowpal"), "-s", "rowpal", *IMAGES[:2], "-o", "images.tpk")
        with_plugin = ["--plugin", plugin("rowpal")]
        self.done("unpack", "-q", *with_plugin, "images.tpk", "-o", "images")
        self.done("frames", "-q", "-s", "red", "-o", "before", *IMAGES[:2])
        self.done("frames", "-q", "-s", "red", "-o", "after", *sorted(glob.glob(self.path("images/*.png"))))
        before, after = (read_rows(self.path(f"{run}/schemes.csv")) for run in ("before", "after"))
        self.assertEqual([row["payload_bits"] for row in before], [row["payload_bits"] for row in after])
        self.done("compose", "-q", *with_plugin, "images.tpk", "-o", "reads.csv")
        refused = self.done("unpack", "images.tpk", "-o", "more", status=FAILED)
        self.assertIn("unknown scheme 'rowpal'", refused.stderr.decode())
        self.assertEqual(refused.stderr.count(b"\n"), 1)
        self.assertIn(b"rowpal", self.done("bench", "--rounds", "1", *with_plugin, "-s", "rowpal", IMAGES[0]).stderr)

    def test_in_a_captured_program(self):
        self.done("run", "--plugin", os.path.relpath(plugin("rowpal"), self.folder), "-s", "rowpal", "-s", "vdcp", "--verify",
                  "-o", "out", "--", PROGRAM, "4", status=PROGRAM_STATUS)
        (run,) = glob.glob(self.path("out/lonely_frames-*"))
        rows = [row for row in read_rows(run + "/schemes.csv") if row["scheme"] == "rowpal"]
        self.assertEqual([row["mismatched_blocks"] for row in rows], ["0"] * 4)
        # Frames of one colour each: the palette of the frame before lacks it.
        self.assertEqual([row["rowpal_rows"] for row in rows], ["0"] * 4)


class Studies(PluginCase):
    def study(self, name, *further):
        done = self.done("study", name, "-o", "out", "--progress", "never", *further)
        return [line for line in done.stderr.decode().splitlines() if "results:" in line][0].split(";")[0]

    def test_results_depend_on_the_content_of_the_library(self):
        os.mkdir(self.path("lib"))
        shutil.copy(plugin("rowpal"), self.path("lib/mine.so"))
        self.write("mine.toml", b'name = "mine"\nplugins = ["lib/mine.so"]\nconfigurations = ["rowpal", "rowpal:slots=4", "red"]\n')
        self.assertEqual(self.study("mine.toml", *IMAGES[:2]), "  results: 3 computed, 0 kept")
        self.assertEqual(self.study("mine.toml", *IMAGES[:2]), "  results: 0 computed, 3 kept")
        # From the study's folder the names in study.toml lead nowhere: the call's paths are kept.
        self.assertIn(b"1 task: 1 done", self.done("study", "status", "out").stdout)
        self.done("study", "merge", "-q", "out")
        rows = read_rows(self.path("out/results.csv"))
        self.assertEqual([row["configuration"] for row in rows], ["rowpal", "rowpal:slots=4", "red"])
        self.assertEqual(len(read_json(self.path("out/study.json"))["options"]["plugins"]), 1)
        os.remove(self.path("lib/mine.so"))
        shutil.copy(plugin("pixels"), self.path("lib/mine.so"))
        self.assertEqual(self.study("mine.toml", *IMAGES[:2]), "  results: 2 computed, 1 kept")
        os.remove(self.path("lib/mine.so"))
        self.expect(FAILED, f"{self.path('out/invocation.json')}: plugin {self.path('lib/mine.so')}: No such file or directory",
                    "study", "merge", "out")
        self.expect(USAGE, f"mine.toml: line 2: plugin {self.path('lib/mine.so')}: No such file or directory",
                    "study", "mine.toml", "-o", "out", *IMAGES[:2])


class Hostile(PluginCase):
    FAULTS = {
        "version": "is built for plugin interface 99, this tilepress has 1 (build it with this version's tilepress_plugin.h)",
        "no_decode": "scheme 'rowpal': the function decode() is missing",
        "name_taken": "scheme 'vdcp': there is a scheme of this name already",
        "measure": "scheme 'rowpal': encode() writes 2048 bits where measure() returns 2047",
        "no_scheme": "has no scheme",
        "undefined": "undefined symbol: no_such_function",
    }

    def test_libraries_are_refused_in_one_line(self):
        for name, reason in self.FAULTS.items():
            self.expect(USAGE, f"--plugin {plugin(name)}: {reason}", "schemes", "--plugin", plugin(name))
        self.write("text", b"no library")
        self.expect(USAGE, "--plugin text: file too short", "schemes", "--plugin", "text")
        self.expect(USAGE, "--plugin gone: No such file or directory", "schemes", "--plugin", "gone")
        self.expect(USAGE, "--plugin libc.so: No such file or directory", "schemes", "--plugin", "libc.so")

    def test_before_a_program_starts(self):
        self.expect(USAGE, f"--plugin {plugin('measure')}: {self.FAULTS['measure']}", "run", "--plugin", plugin("measure"),
                    "--", "touch", "started")
        self.assert_absent("started")

    def test_other_pixels_are_found_by_verify(self):
        done = self.done("frames", "-q", "--plugin", plugin("pixels"), "-s", "rowpal", "--verify", "-o", "out", IMAGES[0],
                         status=FAILED)
        self.assertEqual(done.stderr.count(b"\n"), 1)
        self.assertIn("rowpal", done.stderr.decode())

    def test_inside_a_program_a_bad_library_leaves_one_line(self):
        shim = os.path.join(os.path.dirname(COMMAND), "../interposer/libtilepress-preload.so")
        for name, reason in (("gone", "No such file or directory"), ("version", self.FAULTS["version"])):
            log = self.path(name + ".log")
            done = subprocess.run([PROGRAM, "3"], check=False, timeout=60, capture_output=True, cwd=self.folder, env={
                **os.environ, "LD_PRELOAD": shim, "TILEPRESS_OUT": self.path("out"), "TILEPRESS_PLUGIN": plugin(name),
                "TILEPRESS_LOG_FILE": log})
            self.assertEqual((done.returncode, done.stdout, done.stderr), (PROGRAM_STATUS, b"", b""))
            with open(log, encoding="utf-8") as file:
                self.assertEqual(file.read(), f"tilepress: TILEPRESS_PLUGIN={plugin(name)}: {reason}\n")
            self.assert_absent("out")

    def test_a_fault_among_frames_is_one_line(self):
        self.write("frame.rgba", b"\x01\x02\xff\xff" * 64 * 64)
        done = self.done("frames", "-q", "--size", "64x64", "--plugin", plugin("too_long"), "-s", "rowpal", "-o", "out",
                         "frame.rgba", status=FAILED)
        line = "scheme 'rowpal': the plugin's encode() writes 5000 bits; a block has at most 2048"
        self.assertEqual(done.stderr.decode(), f"tilepress: {line}\n")
        stream = self.done("frames", "-q", "--size", "64x64", "--plugin", plugin("too_long"), "-s", "rowpal", "-o", "piped",
                           "-", status=FAILED, stdin=b"\x01\x02\xff\xff" * 64 * 64)
        self.assertEqual(stream.stderr.decode(), f"tilepress: {line}\n")

    def test_a_fault_inside_a_program_ends_the_capture_alone(self):
        # The program's second frame has the bytes 1, 128, 255, 255.
        done = self.done("run", "-q", "--plugin", plugin("too_long"), "-s", "rowpal", "-o", "out", "--", PROGRAM, "3",
                         status=PROGRAM_STATUS)
        self.assertIn("scheme 'rowpal': the plugin's encode() writes 5000 bits", done.stderr.decode())
        (run,) = glob.glob(self.path("out/lonely_frames-*"))
        self.assertEqual(read_json(run + "/run.json")["state"], "failed")
        self.assertEqual(len(read_rows(run + "/schemes.csv")), 1)


if __name__ == "__main__":
    main()
