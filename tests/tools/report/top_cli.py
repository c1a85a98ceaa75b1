#!/usr/bin/env python3
"""tilepress top beside a running program: it shows the capture, and its end by SIGKILL disturbs nothing. top_cli.py TILEPRESS."""
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from live_checks import end_with_faults, expect, start_display, wait_for  # noqa: E402

TILEPRESS = sys.argv[1]


def top(*arguments):
    return subprocess.run([TILEPRESS, "top", *map(str, arguments)], capture_output=True, text=True, timeout=60)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        nothing = top("--once", folder)
        expect(nothing.returncode == 3 and "no running capture" in nothing.stderr, f"nothing runs: {nothing}")
        server, display = start_display("640x480")
        program = subprocess.Popen([TILEPRESS, "run", "-q", "-o", folder / "out", "-s", "vdcp", "-s", "ras", "--", "glmark2-es2", "--size", "96x64",
                                    "-b", "build:duration=600"], env=dict(os.environ, DISPLAY=display), stdout=subprocess.DEVNULL)
        try:
            pages = wait_for(lambda: list((folder / "out").glob("*/live")))
            expect(pages, "the capture has no live page")
            schemes = pages[0].parent / "schemes.csv"
            expect(wait_for(lambda: schemes.read_text().count("\n") > 30), "the capture makes no frames")
            seen = top("--once", "--interval", "0.5", folder)
            expect(seen.returncode == 0 and seen.stderr == "", f"top --once: {seen}")
            expect(re.search(r"^glmark2-es2 \(\d+\)  96x64  frame \d+ of surface 0$", seen.stdout, re.M), "the program's line: " + seen.stdout)
            expect(re.search(r"^  \d+\.\d frames/s  seen \d+  captured [1-9]\d*", seen.stdout, re.M), "the counts' line: " + seen.stdout)
            for scheme in ("vdcp", "ras"):
                expect(re.search(rf"^  {scheme} +[1-9]\d*\.\d{{3}} +\d+\.\d{{3}}  [#.]{{24}}$", seen.stdout, re.M), f"the rate of {scheme}: {seen.stdout}")

            # On a terminal, and killed there.
            watcher = subprocess.Popen(["script", "-qfec", f"'{TILEPRESS}' top --interval 0.1 '{folder}'", folder / "screen"],
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, start_new_session=True)
            expect(wait_for(lambda: (folder / "screen").exists() and b"frames/s" in (folder / "screen").read_bytes()), "top shows nothing on a terminal")
            os.killpg(watcher.pid, signal.SIGKILL)
            watcher.wait()
            before = schemes.stat().st_size
            expect(wait_for(lambda: schemes.stat().st_size > before), "the program stopped when its watcher was killed")
            expect(program.poll() is None, "the program ended with its watcher")
        finally:
            for run in (folder / "out").glob("glmark2-es2-*"):
                os.kill(int(run.name.rsplit("-", 1)[1]), signal.SIGKILL)
            if program.poll() is None and not list((folder / "out").glob("glmark2-es2-*")):
                program.kill()
            program.wait(timeout=60)
            server.terminate()
            server.wait()
        expect(not list((folder / "out").glob("*/live")), "a killed program's live page is left behind")
        expect(top("--once", folder).returncode == 3, "an ended capture still runs")
    end_with_faults()


if __name__ == "__main__":
    main()
