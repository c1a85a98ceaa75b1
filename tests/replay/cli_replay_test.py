#!/usr/bin/env python3
"""`tilepress replay` and `tilepress info` from the command line, on recorded traces and on damaged ones.

Usage: cli_replay_test.py TILEPRESS TRACE_FOLDER [TEST...]"""
import glob
import hashlib
import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import time

from cli_case import CliCase, COMMAND, XServer, main, read_json, read_rows

TRACES = os.path.abspath(sys.argv[2])
EGL = os.path.join(TRACES, "glmark2-desktop-egl.trace")
GLX = os.path.join(TRACES, "glmark2-desktop-glx.trace")
MAP = os.path.join(TRACES, "browser-map-egl.trace")
FRAMES = {EGL: 69, GLX: 57, MAP: 92}  # of `apitrace info`
FAILED, USAGE, NOTHING = 1, 2, 3
TIMES = {"time_ns", "readback_ns", "encode_ns"}
# A wrong preload of libasan or the like in the caller's environment is not what is tested here.
NO_DISPLAY = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}


def snappy_file(stream):
    """A trace file: one chunk, its snappy block a single literal."""
    block = bytearray()
    length = len(stream)
    while length >= 0x80:
        block.append(length & 0x7F | 0x80)
        length >>= 7
    block.append(length)
    block += bytes([61 << 2]) + (len(stream) - 1).to_bytes(2, "little") + stream
    return b"at" + len(block).to_bytes(4, "little") + bytes(block)


HEADER = b"\x06\x06\x00"
NO_FRAMES = snappy_file(HEADER + b"\x00\x00\x00\x0beglGetError\x00\x00" + b"\x01\x00\x00")


def statistics(folder):
    """The rows of a run without what depends on time."""
    frames = [{k: v for k, v in row.items() if k not in TIMES} for row in read_rows(folder + "/frames.csv")]
    return frames, read_rows(folder + "/schemes.csv")


class ReplayCase(CliCase):
    def replay(self, *words, env=None, status=0):
        done = self.run_command("replay", "-o", "out", *words, env={**NO_DISPLAY, **(env or {})})
        self.assertEqual(done.stdout, b"")
        self.assertEqual(done.returncode, status, done.stderr.decode())
        return done.stderr.decode()

    def run_of(self, trace):
        return self.path("out/" + os.path.basename(trace)[:-len(".trace")])

    def fake_retracer(self, script):
        """An eglretrace of our own in front of PATH."""
        self.write("eglretrace", b"#!/bin/sh\n" + script.encode() + b"\n")
        os.chmod(self.path("eglretrace"), stat.S_IRWXU)
        return {"PATH": self.folder + ":" + os.environ["PATH"]}


class Replays(ReplayCase):
    def test_every_frame_without_a_display_and_losslessly(self):
        text = self.replay("-s", "vdcp", "-s", "ras", "--verify", "-j", "2", EGL, GLX)
        self.assertIn("harmonic mean", text)
        for trace in (EGL, GLX):
            run = read_json(self.run_of(trace) + "/run.json")
            self.assertEqual((run["state"], run["via"]), ("finished", "replay"))
            self.assertEqual((run["counts"]["seen"], run["counts"]["captured"]), (FRAMES[trace], FRAMES[trace]))
            self.assertEqual((run["trace_frames"], run["expected_frames"]), (FRAMES[trace], FRAMES[trace]))
            with open(trace, "rb") as file:
                self.assertEqual(run["trace_sha256"], hashlib.sha256(file.read()).hexdigest())
            rows = read_rows(self.run_of(trace) + "/frames.csv")
            self.assertEqual([int(row["frame"]) for row in rows], list(range(FRAMES[trace])))
            self.assertEqual({(row["width"], row["height"], row["format"]) for row in rows}, {("720", "1280", "RGBA8")})
            for scheme in run["schemes"]:
                self.assertGreater(scheme["checked_blocks"], 0)
                self.assertEqual(scheme["mismatched_blocks"], 0)
        self.assertEqual(sorted(os.listdir(self.path("out"))),
                         ["categories.csv", "glmark2-desktop-egl", "glmark2-desktop-glx", "replay.csv"])

    def test_a_browser_whose_frames_end_with_another_framebuffer_bound(self):
        self.replay("-s", "red", MAP)
        rows = read_rows(self.run_of(MAP) + "/frames.csv")
        self.assertEqual(len(rows), FRAMES[MAP])
        self.assertEqual({(row["width"], row["height"]) for row in rows}, {("720", "1280")})

    def test_twice_with_the_same_result(self):
        self.replay("-s", "hdcp", GLX)
        first = statistics(self.run_of(GLX))
        shutil.rmtree(self.path("out"))
        self.replay("-s", "hdcp", GLX)
        self.assertEqual(statistics(self.run_of(GLX)), first)

    def test_with_the_statistics_of_apitraces_own_snapshots(self):
        for trace in (EGL, GLX):
            self.replay("-s", "vdcp", "-s", "red", trace)
            subprocess.run(["eglretrace", "--snapshot-alpha", "--snapshot-interval=1", "-s", "shot-", trace],
                           cwd=self.folder, env={**os.environ, "WAFFLE_PLATFORM": "surfaceless_egl"}, check=True,
                           capture_output=True, timeout=300)
            shots = sorted(glob.glob(self.path("shot-*.png")))
            self.assertEqual(len(shots), FRAMES[trace])
            done = self.run_command("frames", "-q", "-s", "vdcp", "-s", "red", "-o", "shots", *shots)
            self.assertEqual(done.returncode, 0, done.stderr)
            frames, schemes = statistics(self.run_of(trace))
            shot_frames, shot_schemes = statistics(self.path("shots"))
            for row in frames + shot_frames:
                del row["format"]  # apitrace writes opaque pictures without alpha
            self.assertEqual(frames, shot_frames)
            self.assertEqual(schemes, shot_schemes)
            shutil.rmtree(self.path("shots"))
            for shot in shots:
                os.remove(shot)

    def test_on_a_private_x_server(self):
        text = self.replay("-s", "red", "-v", "--display", "xvfb", GLX)
        self.assertIn("glretrace, private Xvfb", text)
        text = self.replay("-s", "red", "-v", "--display", "xvfb", EGL)
        self.assertIn("eglretrace, private Xvfb", text)
        for trace in (GLX, EGL):
            self.assertEqual(read_json(self.run_of(trace) + "/run.json")["counts"]["captured"], FRAMES[trace])

    def test_on_the_x_server_of_display(self):
        with XServer() as server:
            text = self.replay("-s", "red", "-v", "--api", "glx", "--display", "x11", GLX,
                               env={"DISPLAY": server.display})
        self.assertIn("glretrace, DISPLAY", text)
        self.assertEqual(len(read_rows(self.run_of(GLX) + "/frames.csv")), FRAMES[GLX])

    def test_some_frames_and_ends_behind_the_last(self):
        self.replay("-s", "red", "--frames", "3-5,8", EGL)
        self.assertEqual([row["frame"] for row in read_rows(self.run_of(EGL) + "/frames.csv")], ["3", "4", "5", "8"])
        run = read_json(self.run_of(EGL) + "/run.json")
        self.assertEqual((run["state"], run["expected_frames"], run["trace_frames"]), ("finished", 4, 69))
        self.assertLess(run["counts"]["seen"], 69)

    def test_every_tenth_frame(self):
        self.replay("-s", "red", "--every", "10", EGL)
        self.assertEqual([row["frame"] for row in read_rows(self.run_of(EGL) + "/frames.csv")],
                         ["0", "10", "20", "30", "40", "50", "60"])

    def test_with_progress_as_json(self):
        lines = [json.loads(line) for line in self.replay("-q", "-s", "red", "--progress", "json", GLX).splitlines()]
        self.assertEqual((lines[-1]["frames_done"], lines[-1]["frames_total"]), (FRAMES[GLX], FRAMES[GLX]))
        # Before the trace is read, which may take a while, there is no total yet.
        self.assertEqual({line["frames_total"] for line in lines if "frames_total" in line}, {FRAMES[GLX]})


class Manifests(ReplayCase):
    def manifest(self, *entries):
        return self.write("traces.toml", "\n".join("[[trace]]\n" + entry for entry in entries).encode())

    def test_give_names_categories_and_frames_and_make_means(self):
        self.manifest(f'path = "{EGL}"\nname = "a"\ncategory = "UI"\nframes = "0-4"',
                      f'path = "{GLX}"\nname = "b"\ncategory = "UI"\nframes = "0-5"',
                      f'path = "{GLX}"\nname = "c"\ncategory = "3D"\nframes = "0-2"')
        self.replay("-s", "red", "--manifest", "traces.toml")
        rates = {}
        for name in "abc":
            rows = [row for row in read_rows(self.path(f"out/{name}/schemes.csv")) if row["warmup"] == "0"]
            raw = sum(int(row["raw_bits"]) for row in rows)
            moved = sum(int(row["bursts"]) * 128 + int(row["csb_bits"]) + int(row["palette_bits"]) for row in rows)
            rates[name] = raw / moved
        means = {row["category"]: float(row["rate"]) for row in read_rows(self.path("out/categories.csv"))}
        self.assertAlmostEqual(means["UI"], 2 / (1 / rates["a"] + 1 / rates["b"]), places=9)
        self.assertAlmostEqual(means["3D"], rates["c"], places=9)
        self.assertAlmostEqual(means["all"], 3 / sum(1 / rate for rate in rates.values()), places=9)
        self.assertEqual(read_json(self.path("out/a/run.json"))["category"], "UI")

    def test_in_parts_into_one_folder_keep_the_tables_of_both(self):
        entries = [f'path = "{EGL}"\nname = "b"\ncategory = "UI"\nframes = "0-4"',
                   f'path = "{GLX}"\nname = "a"\ncategory = "3D"\nframes = "0-2"']
        for entry in entries:
            self.manifest(entry)
            self.replay("-s", "red", "--manifest", "traces.toml")
        rows = read_rows(self.path("out/replay.csv"))
        self.assertEqual([(row["trace"], row["status"]) for row in rows], [("a", "done"), ("b", "done")])
        means = {row["category"]: row for row in read_rows(self.path("out/categories.csv"))}
        rates = {row["trace"]: float(row["rate"]) for row in rows}
        self.assertAlmostEqual(float(means["all"]["rate"]), 2 / (1 / rates["a"] + 1 / rates["b"]), places=9)
        self.assertAlmostEqual(float(means["UI"]["rate"]), rates["b"], places=9)
        self.assertEqual(means["all"]["traces"], "2")
        shown = self.run_command("summary", "out")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertRegex(shown.stdout.decode(), rf"(?m)^harmonic mean +all +\(2 runs\) +{float(means['all']['rate']):.4f}$")

    def test_check_the_checksum(self):
        self.manifest(f'path = "{EGL}"\nsha256 = "{"0" * 64}"')
        self.assertIn("as the manifest says", self.replay("--manifest", "traces.toml", status=FAILED))

    def test_are_refused_with_the_line_of_the_fault(self):
        for entry, reason in (('path = "x.trace"\nkind = "UI"', "line 3: unknown key 'kind'"),
                              ('path = "x.trace"\ncategory = "4D"', "line 3: category '4D' is none of UI, 2D, 3D"),
                              ('path = "x.trace"\nsha256 = "12"', "line 3: sha256 is not 64 digits 0-9a-f"),
                              ('category = "UI"', "line 1: a trace without path")):
            self.manifest(entry)
            self.expect(USAGE, "traces.toml: " + reason, "replay", "--manifest", "traces.toml")
        self.write("traces.toml", b"")
        self.expect(USAGE, "traces.toml: line 1: lists no [[trace]]", "replay", "--manifest", "traces.toml")


class MesaManifests(ReplayCase):
    """As Mesa's continuous integration has them: today a mapping, earlier a list."""
    MAPPING = b"""traces-db:
  download-url: "https://traces.example/public/"

traces:
  glmark2/desktop:effect=blur-v2.trace:
    gl-vmware-llvmpipe:
      checksum: f9af0e7e0a3a1b3a0b6e2f6b6b0c6b31
    freedreno-a630:
      label: [skip, flakes]
      text: Flaky.
  supertuxkart/race.rdc:
    gl-vmware-llvmpipe:
      checksum: 58359ea4caf6ad44c6b65526881bbd17
"""
    LIST = b"""traces:
  - path: glmark2/desktop:effect=blur-v2.trace
    expectations:
      - device: gl-vmware-llvmpipe
        checksum: 58359ea4caf6ad44c6b65526881bbd17
"""
    NAME = "glmark2-desktop_effect=blur-v2"

    def setUp(self):
        super().setUp()
        os.makedirs(self.path("files/glmark2"))
        os.symlink(EGL, self.path("files/glmark2/desktop:effect=blur-v2.trace"))

    def test_take_traces_from_a_folder_and_categories_from_an_option(self):
        self.write("traces-x.yml", self.MAPPING)
        said = self.replay("-s", "red", "--frames", "0-2", "--manifest", "traces-x.yml", "--trace-folder", "files",
                           "--category", "glmark2*=3D", status=FAILED)
        rows = {row["trace"]: (row["status"], row["category"]) for row in read_rows(self.path("out/replay.csv"))}
        self.assertEqual(rows[self.NAME], ("done", "3D"))
        missing = [line for line in said.splitlines() if line.startswith("tilepress: ")]
        self.assertEqual(missing, ["tilepress: files/supertuxkart/race.rdc: No such file or directory"])

    def test_are_lists_too_and_inputs_of_a_study(self):
        self.write("files/traces-y.yaml", self.LIST)
        for words in (["files/traces-y.yaml"], ["--manifest", "files/traces-y.yaml"],
                      ["--manifest", "files/traces-y.yaml", "--trace-folder", "files"]):
            done = self.run_command("study", "paper", "-n", "-o", "plan", "--category", "glmark2*=3D", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout.decode(), rf"{self.NAME} +3D +trace")

    def test_are_refused_with_the_line_of_the_fault(self):
        for text, reason in (("x: 1", "has no key 'traces'"), ("- x", "has no key 'traces'"),
                             ("traces: x", "line 1: traces is no list and no mapping"),
                             ("traces:\n  - paht: x", "line 2: a trace without path"),
                             ("traces:\n  ../x.trace: {}", "line 2: '../x.trace' leaves the folder of the traces"),
                             ("traces: []", "line 1: lists no trace"),
                             ("traces: [", "line 2: end of sequence flow not found")):
            self.write("bad.yml", text.encode() + b"\n")
            self.expect(USAGE, "bad.yml: " + reason, "replay", "--manifest", "bad.yml")


class Folders(ReplayCase):
    def test_stand_for_the_traces_in_them_and_refused_replays_leave_the_rows(self):
        os.mkdir(self.path("traces"))
        os.symlink(EGL, self.path("traces/b.trace"))
        os.symlink(GLX, self.path("traces/a.trace"))
        self.write("traces/notes.txt", b"no trace")
        self.replay("-q", "-s", "red", "--frames", "0-1", "traces")
        with open(self.path("out/replay.csv"), encoding="utf-8") as file:
            rows = file.read()
        self.assertEqual([row["trace"] for row in read_rows(self.path("out/replay.csv"))], ["a", "b"])
        self.replay("-q", "-s", "red", "--frames", "0-1", "traces", status=FAILED)
        with open(self.path("out/replay.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), rows)


class Failures(ReplayCase):
    def test_are_told_in_a_line_each_and_do_not_stop_the_others(self):
        with open(EGL, "rb") as file:
            whole = file.read()
        self.write("cut.trace", whole[:300000])
        self.write("damaged.trace", whole[:200000] + b"\xff" * 8 + whole[200008:])
        self.write("empty.trace", b"")
        self.write("text.trace", b"just some words, and more of them\n")
        self.write("new.trace", snappy_file(b"\x09" * 9))
        self.write("silent.trace", NO_FRAMES)
        os.mkdir(self.path("folder.trace"))
        text = self.replay("-q", "-s", "red", "cut.trace", "damaged.trace", "empty.trace", "text.trace", "new.trace",
                           "silent.trace", "folder.trace", "none.trace", GLX, status=FAILED)
        self.assertEqual(text.splitlines(), [
            "tilepress: none.trace: No such file or directory (did you mean 'new.trace'?)",
            "tilepress: cut.trace: truncated after 14 frames: the last chunk is cut off; the frames before were captured",
            "tilepress: damaged.trace: corrupt at byte 1048576 of the stream, after 0 frames: a chunk is damaged; "
            "not replayed",
            "tilepress: empty.trace: is empty",
            "tilepress: text.trace: is not an apitrace trace",
            "tilepress: new.trace: has trace format version 9; versions up to 6 can be read",
            "tilepress: silent.trace: presents no frame (1 call, API EGL)",
            "tilepress: folder.trace: is a directory, not a trace"])
        self.assertEqual(len(read_rows(self.path("out/cut/frames.csv"))), 14)
        self.assertEqual(len(read_rows(self.run_of(GLX) + "/frames.csv")), FRAMES[GLX])

    def test_of_a_trace_without_frames_is_status_3(self):
        self.write("silent.trace", NO_FRAMES)
        self.replay("silent.trace", status=NOTHING)
        self.assert_absent("out")

    def test_of_a_trace_end_its_retracer_that_was_started_meanwhile(self):
        self.write("silent.trace", NO_FRAMES)
        env = self.fake_retracer('echo $$ > "$(dirname "$0")/started"; exec sleep 1000')
        done = self.run_command("replay", "-q", "-o", "new/out", "--timeout", "0", "silent.trace",
                                env={**NO_DISPLAY, **env})
        self.assertEqual(done.stderr, b"tilepress: silent.trace: presents no frame (1 call, API EGL)\n")
        self.assertEqual(done.returncode, NOTHING)
        self.assert_absent("new")
        if os.path.exists(self.path("started")):  # it may have been ended before its first word
            with open(self.path("started")) as file:
                self.assertFalse(os.path.exists("/proc/" + file.read().strip()))

    def test_of_a_retracer_are_told_with_its_last_words(self):
        env = self.fake_retracer("echo first >&2; echo cannot draw >&2; exit 7")
        text = self.replay("-q", "--display", "surfaceless", EGL, env=env, status=NOTHING)
        self.assertIn("no frame captured of 69 frames: eglretrace ended with status 7\n", text)
        self.assertIn("  said: cannot draw\n", text)
        self.assertEqual(os.listdir(self.path("out")), ["categories.csv", "replay.csv"])

    def test_of_a_retracer_that_crashes_are_told_with_the_signal(self):
        text = self.replay("-q", "--display", "surfaceless", EGL, env=self.fake_retracer("kill -SEGV $$"), status=NOTHING)
        self.assertIn("eglretrace was ended by signal 11 (Segmentation fault)", text)

    def test_of_a_retracer_that_hangs_are_ended(self):
        begin = time.monotonic()
        text = self.replay("-q", "--timeout", "1", EGL, env=self.fake_retracer("sleep 1000"), status=NOTHING)
        self.assertIn("eglretrace showed no frame for 1 s and was ended", text)
        self.assertLess(time.monotonic() - begin, 200)

    def test_of_a_retracer_that_stops_halfway_keep_its_frames(self):
        with open(EGL, "rb") as file:
            self.write("cut", file.read()[:300000])
        env = self.fake_retracer(f"exec /usr/bin/eglretrace -b {self.path('cut')}")
        text = self.replay("-q", "-s", "red", EGL, env=env, status=FAILED)
        self.assertIn("captured 14 of 69 frames: eglretrace presented 14 frames", text)
        run = read_json(self.run_of(EGL) + "/run.json")
        self.assertEqual((run["state"], run["counts"]["captured"]), ("failed", 14))

    def test_without_a_display_fall_back_to_a_private_x_server(self):
        real = 'case "$WAFFLE_PLATFORM" in x11_egl) exec /usr/bin/eglretrace "$@";; esac; exit 1'
        text = self.replay("-v", "-s", "red", "--frames", "0-2", EGL, env=self.fake_retracer(real))
        self.assertIn("eglretrace, private Xvfb (nothing was captured without a display)", text)
        self.assertEqual(len(read_rows(self.run_of(EGL) + "/frames.csv")), 3)

    def test_of_usage_name_the_fault(self):
        for words, line in ((["x.trace", "--api", "vulkan"], "--api vulkan: not one of auto, egl, glx"),
                            (["x.trace", "--progress", "x"], "--progress x: not one of auto, never, json"),
                            ([], "no trace given (see tilepress replay --help)"),
                            (["a/x.trace", "b/x.trace"], "a/x.trace and b/x.trace: both would be written to the folder "
                                                         "x (a manifest can give names)"),
                            (["x.trace", "--api", "glx", "--display", "surfaceless"],
                             "--api glx needs an X server and does not go with --display surfaceless")):
            self.expect(USAGE, line, "replay", *words)


class Interruptions(ReplayCase):
    def start(self, *words, env=None):
        """In a session of its own, so that a signal to its group is a terminal's ^C."""
        return subprocess.Popen([COMMAND, "replay", "-o", "out", *words], cwd=self.folder, start_new_session=True,
                                env={**os.environ, **NO_DISPLAY, **(env or {})}, stderr=subprocess.PIPE)

    def has_rows(self, name):
        paths = glob.glob(self.path(f"out/{name}.partial/*/runs/*/frames.csv"))
        return any(len(read_rows(path)) > 2 for path in paths)

    def end_of(self, process, number):
        """What it says at its end; nothing that it started is left."""
        os.killpg(process.pid, number)
        _, text = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 128 + number, text)
        for path in glob.glob("/proc/[0-9]*/stat"):
            try:
                with open(path, encoding="utf-8", errors="replace") as file:
                    words = file.read().rsplit(")", 1)[1].split()
            except OSError:  # it has just ended
                continue
            self.assertNotEqual((words[0] != "Z", int(words[3])), (True, process.pid), path)
        return text.decode()

    def assert_cut(self, trace, number):
        folder = self.run_of(trace)
        run = read_json(folder + "/run.json")
        rows = read_rows(folder + "/frames.csv")
        self.assertEqual((run["state"], run["via"], run["signal"]), (f"killed by signal {number}", "replay", number))
        self.assertEqual((run["counts"]["captured"], run["reason"]),
                         (len(rows), f"stopped after {len(rows)} of {FRAMES[trace]} frames"))
        self.assertEqual([int(row["frame"]) for row in rows], list(range(len(rows))))
        self.assertEqual(len(read_rows(folder + "/schemes.csv")), len(rows) * len(run["schemes"]))
        self.assertEqual(glob.glob(folder + "/*live*"), [])
        return len(rows)

    def test_leave_the_frames_so_far_and_a_line(self):
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            process = self.start(EGL)
            self.wait_until(lambda: self.has_rows("glmark2-desktop-egl"), process)
            text = self.end_of(process, number)
            rows = self.assert_cut(EGL, number)
            self.assertEqual(text, f"tilepress: killed by signal {number} ({signal.strsignal(number)}): "
                                   f"{EGL} stopped after {rows} of 69 frames\n")
            self.assert_absent("out/glmark2-desktop-egl.partial")

        self.replay("-s", "red", "--resume", EGL, status=FAILED)  # other options: not the same replay
        self.replay("-q", "--resume", EGL)
        self.assertEqual(len(read_rows(self.run_of(EGL) + "/frames.csv")), FRAMES[EGL])

    def test_name_what_is_done_and_what_is_not(self):
        process = self.start("-s", "red", GLX, EGL, MAP)
        self.wait_until(lambda: self.has_rows("glmark2-desktop-egl"), process)
        text = self.end_of(process, signal.SIGINT)
        self.assertEqual(text, f"tilepress: killed by signal 2 (Interrupt): done: {GLX}; {EGL} stopped after "
                               f"{self.assert_cut(EGL, 2)} of 69 frames; not replayed: {MAP}\n")
        self.assertEqual(read_json(self.run_of(GLX) + "/run.json")["state"], "finished")
        self.assertEqual(sorted(os.listdir(self.path("out"))),
                         ["categories.csv", "glmark2-desktop-egl", "glmark2-desktop-glx", "replay.csv"])
        self.assertEqual([row["status"] for row in read_rows(self.path("out/replay.csv"))],
                         ["done", "interrupted", "not replayed"])
        self.assertIn("exists already", self.replay("-q", "-s", "red", EGL, status=FAILED))
        self.replay("-q", "-s", "red", "--resume", GLX, EGL, MAP)

    def test_end_what_is_started_at_that_time(self):
        for name, words in (("Xvfb", ["--display", "xvfb"]), ("eglretrace", [])):
            self.write(name, b'#!/bin/sh\ntrap "" INT\necho > "$(dirname "$0")/started"\nsleep 1000\n')
            os.chmod(self.path(name), stat.S_IRWXU)
            process = self.start(*words, EGL, env={"PATH": self.folder + ":" + os.environ["PATH"]})
            self.wait_until(lambda: os.path.exists(self.path("started")), process)
            self.assertEqual(self.end_of(process, signal.SIGINT), f"tilepress: killed by signal 2 (Interrupt): {EGL} "
                                                                  "stopped after 0 of 69 frames\n")
            self.assertEqual(sorted(os.listdir(self.path("out"))), ["categories.csv", "replay.csv"])
            os.remove(self.path("started"))
            os.remove(self.path(name))

    def test_are_taken_up_again_without_touching_what_is_finished(self):
        self.replay("-s", "red", "--frames", "0-2", GLX)
        before = os.stat(self.run_of(GLX) + "/run.json").st_mtime_ns
        os.makedirs(self.path("out/glmark2-desktop-egl.partial/0/runs"))
        self.replay("-s", "red", "--frames", "0-2", "--resume", GLX, EGL)
        self.assertEqual(os.stat(self.run_of(GLX) + "/run.json").st_mtime_ns, before)
        self.assertEqual(len(read_rows(self.run_of(EGL) + "/frames.csv")), 3)
        kept = {row["trace"]: row["status"] for row in read_rows(self.path("out/replay.csv"))}
        self.assertEqual(kept, {"glmark2-desktop-glx": "kept", "glmark2-desktop-egl": "done"})

    def test_or_not_never_overwrite_a_run(self):
        self.replay("-s", "red", "--frames", "0", GLX)
        text = self.replay("-q", "-s", "red", "--frames", "0", GLX, status=FAILED)
        self.assertIn("exists already", text)


class Info(CliCase):
    def test_tells_what_a_trace_holds(self):
        done = self.run_command("info", EGL)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stdout.decode().splitlines(), [
            EGL,
            "  program    /usr/bin/glmark2-es2",
            "  api        EGL, OpenGL ES 2.0",
            "  recorded   llvmpipe (LLVM 15.0.6, 256 bits), OpenGL ES 3.2 Mesa 22.3.6",
            "  format     version 6 (semantics 6), snappy, 394717 bytes, 3094600 unpacked",
            "  frames     69",
            "  surfaces   0x55c28972b530: 720x1280, 69 frames",
            "  calls      16613 by 1 thread",
            "  duration   not recorded"])

    def test_tells_it_as_json(self):
        done = self.run_command("info", "--json", GLX, MAP)
        traces = json.loads(done.stdout)
        self.assertEqual([trace["frames"] for trace in traces], [57, 92])
        self.assertEqual([trace["api"] for trace in traces], ["GLX", "EGL"])

    def test_goes_on_after_a_file_that_is_no_trace(self):
        self.write("x", b"words")
        done = self.run_command("info", "x", GLX)
        self.assertEqual((done.returncode, done.stderr), (1, b"tilepress: x: is not an apitrace trace\n"))
        self.assertIn(b"frames     57", done.stdout)


if __name__ == "__main__":
    main()
