#!/usr/bin/env python3
"""Runs the soak programs for long, without and with the shim, and prints what grew.

  soak.py [--programs FOLDER] [--tilepress PATH] [--frames N] [--cycles N] [--via auto|preload|glvnd]

egl_soak presents N frames (20000) and makes new surfaces and contexts every ten. window_soak makes N X windows and contexts
(7200: two hours of one a second) by EGL and by GLX, resizes each and destroys it. Memory, descriptors and threads must
not grow more than without the shim, and a new texture must get the same name. Prints a table; exit status 1 if something grew.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ALLOWED_KIB = 1024


def x_server():
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        return server, ":" + pipe.readline().strip()


def measure(command, environment):
    """(KiB, descriptors, threads) early and late, and the rest of what the program printed."""
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    sizes = [tuple(map(int, found)) for found in
             re.findall(r"(\d+) KiB, (\d+) descriptors, (\d+) threads", done.stdout)]
    return sizes[0], sizes[-1], re.findall(r"texture \d+", done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", default="build/dev/tests/interposer")
    parser.add_argument("--tilepress", default="build/release/tools/tilepress")
    parser.add_argument("--frames", type=int, default=20000)
    parser.add_argument("--cycles", type=int, default=7200)
    parser.add_argument("--via", default="auto")
    arguments = parser.parse_args()
    server, display = x_server()
    scratch = tempfile.mkdtemp(prefix="tilepress-soak-")
    environment = dict(os.environ, DISPLAY=display)
    failures = 0
    print("| program | without: KiB early, late | with: KiB early, late | descriptors | threads | captured | |")
    print("|---|---|---|---|---|---|---|")
    try:
        for name, frames, words in (("egl_soak", arguments.frames, [str(arguments.frames)]),
                                    ("window_soak egl", 4 * arguments.cycles, ["egl", str(arguments.cycles)]),
                                    ("window_soak glx", 4 * arguments.cycles, ["glx", str(arguments.cycles)])):
            command = [f"{arguments.programs}/{name.split()[0]}"] + words
            bare_early, bare_late, bare_rest = measure(command, environment)
            output = f"{scratch}/{name.replace(' ', '-')}"
            early, late, rest = measure([arguments.tilepress, "run", "-q", "-s", "vdcp", "--via", arguments.via, "-o", output,
                                         "--"] + command, environment)
            (run,) = pathlib.Path(output).glob("*/run.json")
            captured = json.loads(run.read_text())["counts"]["captured"]
            grown = late[0] - early[0] - max(0, bare_late[0] - bare_early[0])
            good = grown <= ALLOWED_KIB and late[1:] == early[1:] and rest == bare_rest and captured == frames
            failures += not good
            print(f"| {name} {words[-1]} | {bare_early[0]}, {bare_late[0]} | {early[0]}, {late[0]} | {early[1]}, {late[1]} | "
                  f"{early[2]}, {late[2]} | {captured} | {'good' if good else 'GROWN'} |", flush=True)
    finally:
        server.terminate()
        server.wait()
        shutil.rmtree(scratch, ignore_errors=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
