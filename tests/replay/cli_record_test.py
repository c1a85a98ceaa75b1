#!/usr/bin/env python3
"""`tilepress record` from the command line.

Usage: cli_record_test.py TILEPRESS TRACE_FOLDER [TEST...]"""
import json
import os
import signal
import time

from cli_case import CliCase, XServer, main

NOTHING = 3
SCENE = ["-b", "clear:duration=0.3", "--size", "96x64"]


class Records(CliCase):
    @classmethod
    def setUpClass(cls):
        cls.server = XServer()
        cls.server.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def record(self, *words, status=0):
        done = self.run_command("record", "-o", "x.trace", "-v", *words,
                                env={"DISPLAY": self.server.display, "WAYLAND_DISPLAY": ""})
        self.assertEqual(done.returncode, status, done.stderr.decode())
        return done.stderr.decode()

    def recorded(self):
        return json.loads(self.run_command("info", "--json", "x.trace").stdout)[0]

    def test_an_egl_program_by_the_names_in_its_file(self):
        self.assertIn("recording EGL (the program names EGL", self.record("--", "glmark2-es2", *SCENE))
        trace = self.recorded()
        self.assertEqual((trace["api"], trace["state"]), ("EGL", "complete"))
        self.assertGreater(trace["frames"], 0)
        self.assertEqual((trace["surfaces"][0]["width"], trace["surfaces"][0]["height"]), (96, 64))

    def test_a_glx_program_by_the_names_in_its_file(self):
        self.assertIn("recording GLX (the program names GLX", self.record("--", "glmark2", *SCENE))
        self.assertEqual(self.recorded()["api"], "GLX")

    def test_a_program_that_does_not_tell_by_trying(self):
        text = self.record("--", "sh", "-c", 'exec "$0" "$@"', "glmark2-es2", *SCENE)
        self.assertIn("running it again for EGL", text)
        self.assertEqual(self.recorded()["api"], "EGL")

    def test_shows_the_lines_of_the_program_and_not_those_of_apitrace(self):
        # The program leaves a process that holds standard error.
        script = 'printf "apit" >&2; printf "ude\n" >&2; sleep 100 >&2 & echo $! > pid; "$0" "$@" >&2'
        words = ["--api", "egl", "--", "sh", "-c", script, "glmark2-es2", *SCENE]
        begin = time.monotonic()
        done = self.run_command("record", "-o", "x.trace", *words, env={"DISPLAY": self.server.display, "WAYLAND_DISPLAY": ""})
        with open(self.path("pid"), encoding="utf-8") as file:
            os.kill(int(file.read()), signal.SIGTERM)
        self.assertLess(time.monotonic() - begin, 90)
        lines = done.stderr.decode().splitlines()
        self.assertEqual((lines[0], done.returncode), ("apitude", 0), lines)
        self.assertEqual([line for line in lines if line.startswith("apitrace: ")], [])
        self.assertIn("GL_RENDERER", done.stderr.decode())
        self.assertRegex(lines[-1], r"^x.trace: \d+ frames, 96x64, EGL")

    def test_shows_the_last_lines_of_apitrace_if_it_fails(self):
        done = self.run_command("record", "-o", "x.trace", "--api", "egl", "--", "sh", "-c", "echo mine >&2",
                                env={"DISPLAY": self.server.display})
        said = done.stderr.decode().splitlines()
        self.assertEqual((said[0], done.returncode), ("mine", NOTHING))
        self.assertTrue(said[1].startswith("tilepress: sh: no frame recorded: "), said)
        self.assertTrue(said[2].startswith("  said: apitrace: loaded into "), said)

    def test_nothing_of_a_program_without_gl(self):
        text = self.record("--", "sh", "-c", "true", status=NOTHING)
        self.assertIn("tilepress: sh: no frame recorded: ", text)
        self.assert_absent("x.trace")
        self.assert_absent("x.trace.partial")

    def test_nothing_through_the_wrong_api_and_says_so(self):
        text = self.record("--api", "egl", "--", "glxinfo", status=NOTHING)
        self.assertIn("no frame recorded", text)

    def test_not_over_a_file_that_exists(self):
        self.write("x.trace", b"mine")
        self.expect(1, "x.trace: exists already (remove it, or give another name)", "record", "-o", "x.trace", "--", "true")
        self.expect(1, "none/x.trace: there is no folder none (mkdir -p none)", "record", "-o", "none/x.trace", "--", "true")


if __name__ == "__main__":
    main()
