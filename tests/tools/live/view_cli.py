#!/usr/bin/env python3
"""tilepress view beside a running program: what it shows, its keys, and that its death changes nothing.

view_cli.py TILEPRESS PICTURE_PROGRAM"""
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from live_checks import end_with_faults, expect, start_display, wait_for  # noqa: E402
from picture_files import read_pgm, read_png  # noqa: E402

TILEPRESS, PROGRAM = sys.argv[1:3]
# The window's drivers leave memory behind; what is ours to free is looked at in the unit tests.
QUIET = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")


class Display:
    def __enter__(self):
        self.server, number = start_display("1400x1000")
        self.environment = dict(QUIET, DISPLAY=number)
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()

    def window_names(self, pattern):
        found = subprocess.run(["xdotool", "search", "--name", pattern, "getwindowname", "%@"], env=self.environment,
                               capture_output=True, text=True, timeout=60)
        return found.stdout.splitlines()

    def press(self, *keys):
        """Keys go to the window under the pointer: there is no window manager."""
        subprocess.run(["xdotool", "mousemove", "300", "300", "key", "--delay", "30", *keys], env=self.environment, check=True, timeout=60)


def find_picture(rows, wanted):
    """Where rows of RGB bytes lie in a screenshot's: (x, y), or None."""
    for y in range(len(rows) - len(wanted) + 1):
        at = rows[y].find(wanted[0])
        while at >= 0:
            if at % 3 == 0 and all(rows[y + i][at:at + len(row)] == row for i, row in enumerate(wanted)):
                return at // 3, y
            at = rows[y].find(wanted[0], at + 1)
    return None


def heat_color(share):
    stops = [(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129), (92, 200, 99), (170, 220, 50),
             (253, 231, 37)]
    place = share * 8
    low = min(int(place), 7)
    return tuple(int(stops[low][c] * (1 - place + low) + stops[low + 1][c] * (place - low) + 0.5) for c in range(3))


def view(display, *arguments):
    return subprocess.run([TILEPRESS, "view", *map(str, arguments)], env=display.environment, capture_output=True, text=True, timeout=120)


def screenshot(display, folder, name, *arguments):
    """Takes one and returns it with the frame that it shows."""
    done = view(display, folder / "out", "--screenshot", folder / name, *arguments)
    found = re.fullmatch(rf"{re.escape(str(folder / name))}: frame (\d+) of surface 0\n", done.stderr)
    expect(done.returncode == 0 and found, f"{name}: {done}")
    if not found:
        return None, 0, 0, []
    width, height, channels, samples = read_png(folder / name)
    expect(channels == 3, f"{name} has {channels} channels")
    return int(found.group(1)), width, height, [samples[y * width * 3:(y + 1) * width * 3] for y in range(height)]


def shows_frames_and_heat(display, folder):
    """The window has the very pixels and bits that the run keeps of the same frame."""
    program = subprocess.Popen([TILEPRESS, "run", "-q", "-o", folder / "out", "-s", "vdcp", "-s", "ras", "--heatmaps", "every:1",
                                "--dump-frames", "every:1", "--", "glmark2-es2", "--size", "100x60", "-b", "build:duration=600"],
                               env=display.environment, stdout=subprocess.DEVNULL)
    run = None
    try:
        pages = wait_for(lambda: list((folder / "out").glob("*/live")))
        expect(pages, "the capture has no live page")
        run = pages[0].parent
        expect(not (run / "live-picture").exists(), "pictures are written though nobody asked for them")
        frame, width, height, rows = screenshot(display, folder, "frame.png", "--overlay", "off", "--zoom", "1")
        expect((width, height) == (960, 640), f"the window is {width}x{height}")
        expect((run / "live-picture").exists(), "there is no file of pictures")
        raw = (run / f"frames/0-{frame:06}.rgba").read_bytes()
        wanted = [b"".join(raw[(y * 100 + x) * 4:(y * 100 + x) * 4 + 3] for x in range(100)) for y in range(60)]
        expect(find_picture(rows, wanted), f"frame {frame} is not in the window")

        frame, width, height, rows = screenshot(display, folder, "heat.png", "--overlay", "only", "--zoom", "1", "-s", "ras")
        scheme, blocks_x, blocks_y, bits = read_pgm(run / f"heatmaps/0-{frame:06}-ras.pgm")
        expect((scheme, blocks_x, blocks_y) == ("ras", 13, 8), f"{scheme}: {blocks_x}x{blocks_y} blocks")
        wanted = [b"".join(bytes(heat_color(bits[y // 8 * blocks_x + x // 8] / 2048)) for x in range(100)) for y in range(60)]
        expect(find_picture(rows, wanted), f"the heat map of frame {frame} is not in the window")
    finally:
        if run:
            os.kill(int(run.name.rsplit("-", 1)[1]), signal.SIGKILL)
        else:
            program.kill()
        program.wait(timeout=60)
    expect(not list(run.glob("live*")), f"left behind by a killed program: {list(run.glob('live*'))}")


def obeys_keys(display, folder):
    program = subprocess.Popen([TILEPRESS, "run", "-q", "-o", folder / "out", "-s", "vdcp", "-s", "ras", "-s", "red", "--", "glmark2-es2",
                                "--size", "96x64", "-b", "build:duration=600"], env=display.environment,
                               stdout=subprocess.DEVNULL)
    window = None
    try:
        pages = wait_for(lambda: list((folder / "out").glob("*/live")))
        expect(pages, "the capture has no live page")
        window = subprocess.Popen([TILEPRESS, "view", pages[0].parent], env=display.environment)

        def title_ends(end):
            return wait_for(lambda: any(name.endswith(end) for name in display.window_names("tilepress view: glmark2")), 60)
        expect(title_ends(") vdcp"), "the window does not show the first scheme")
        for keys, end in ((["Right"], ") ras"), (["3"], ") red"), (["Left", "Left"], ") vdcp"), (["space"], ") vdcp frozen"),
                          (["2"], ") ras frozen"), (["space"], ") ras"), (["question", "Escape", "h", "plus", "f"], ") ras")):
            display.press(*keys)
            expect(title_ends(end), f"after {keys} the title is {display.window_names('tilepress view')}")
        display.press("q")
        expect(wait_for(lambda: window.poll() is not None) and window.returncode == 0, "q does not quit")
        expect(program.poll() is None, "the program ended with its window")
    finally:
        if window and window.poll() is None:
            window.kill()
        for run in (folder / "out").glob("*/live"):
            os.kill(int(run.parent.name.rsplit("-", 1)[1]), signal.SIGTERM)
        program.wait(timeout=60)


def killed_window_changes_nothing(display, folder):
    """The same frames, once with a window that is attached, killed and attached again, once without."""
    rows = {}
    for name in ("watched", "alone"):
        out = folder / name
        program = subprocess.Popen([TILEPRESS, "run", "-q", "-o", out, "-s", "hdcp", "-s", "te", "--", PROGRAM, "glx", "900", "320", "240"],
                                   env=display.environment, stdout=subprocess.DEVNULL)
        if name == "watched":
            pages = wait_for(lambda: list(out.glob("*/live")))
            expect(pages, "the capture has no live page")
            run = pages[0].parent
            pid = int(run.name.rsplit("-", 1)[1])
            os.kill(pid, signal.SIGSTOP)  # so that it is still there once the window is
            window = subprocess.Popen([TILEPRESS, "view", out], env=display.environment)
            expect(wait_for(lambda: display.window_names("tilepress view: glfw_picture .* waiting")), "the window does not attach")
            os.kill(pid, signal.SIGCONT)
            expect(wait_for(lambda: (run / "live-picture").exists() or program.poll() is not None), "no picture was written")
            window.kill()
            window.wait()
        expect(program.wait(timeout=200) == 0, name + ": the program failed")
        run, = out.glob("glfw_picture-*")
        rows[name] = (run / "schemes.csv").read_bytes()
        expect(not list(run.glob("live*")), f"left behind: {list(run.glob('live*'))}")
    # GLFW presents once more, when it makes the window: a header and 901 frames of two schemes.
    expect(rows["watched"].count(b"\n") == 1803, f"{rows['watched'].count(bytes([10]))} rows")
    expect(rows["watched"] == rows["alone"], "the rows are not the same with a window")


def fails_in_one_line(folder):
    without = {name: value for name, value in QUIET.items() if name != "DISPLAY"}
    for environment, line in ((without, "tilepress: view: no display: DISPLAY is not set "
                                        "(tilepress top needs none; xvfb-run -a gives one for --screenshot)\n"),
                              (dict(QUIET, DISPLAY=":987654"), "tilepress: view: no display: cannot open :987654\n")):
        done = subprocess.run([TILEPRESS, "view", folder], env=environment, capture_output=True, text=True, timeout=60)
        expect((done.returncode, done.stdout, done.stderr) == (1, "", line), f"without a display: {done}")


def main():
    with tempfile.TemporaryDirectory() as name, Display() as display:
        folder = Path(name)
        fails_in_one_line(folder)
        done = view(display, folder, "--screenshot", folder / "none.png", "--wait", "1")
        expect((done.returncode, done.stderr) == (3, f"tilepress: view: {folder}: no running capture\n"), f"nothing runs: {done}")
        for part in (shows_frames_and_heat, obeys_keys, killed_window_changes_nothing):
            own = folder / part.__name__
            own.mkdir()
            part(display, own)
    end_with_faults()


if __name__ == "__main__":
    main()
