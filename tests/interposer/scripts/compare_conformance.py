#!/usr/bin/env python3
"""Runs piglit's tests (Debian package piglit) without and with the shim and compares every result.

  compare_conformance.py [--tilepress PATH] [--tests egl|window|all] [--via auto|preload|glvnd] [-t REGEX]...

egl: EGL and GLES tests; window: those and GLX (the default); all: the whole profile quick_gl. A test or subtest with another
result runs again alone, four times on both sides. It is listed as unsteady if the results then agree, or if those without the
shim differ among themselves. Else it is a difference. Prints a table of the differences; exit status 1 if there is one.
"""
import argparse
import bz2
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

EGL = [r"^egl@", r"^spec@egl", r"_gles[123]", r"@!opengl es", r"^spec@oes_", r"^spec@glsl-es", r"^spec@ext_image_dma"]
TESTS = {"egl": EGL, "window": EGL + [r"^glx@", r"^spec@glx"], "all": []}


def x_server():
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        return server, ":" + pipe.readline().strip()


def results_of(folder):
    """{test, or test@subtest: result}"""
    (path,) = pathlib.Path(folder).glob("results.json*")
    text = bz2.decompress(path.read_bytes()) if path.suffix == ".bz2" else path.read_bytes()
    found = {}
    for name, record in json.loads(text)["tests"].items():
        found[name] = record["result"]
        for subtest, result in record.get("subtests", {}).items():
            if subtest == "__type__":
                continue
            found[f"{name} / {subtest}"] = result
    return found


class Bench:
    """Where piglit runs: an X server, a scratch folder, the command."""

    def __init__(self, arguments, display, scratch):
        self.arguments, self.scratch, self.count = arguments, scratch, 0
        self.environment = dict(os.environ, DISPLAY=display)
        self.environment.pop("WAYLAND_DISPLAY", None)

    def run(self, patterns, with_shim):
        self.count += 1
        folder = f"{self.scratch}/{self.count}"
        command = ["piglit", "run", "-l", "dummy", "-j", str(self.arguments.jobs), "--timeout", "120"]
        for pattern in patterns:
            command += ["-t", pattern]
        command += ["quick_gl", folder]
        if with_shim:
            command = [self.arguments.tilepress, "run", "-q", "-s", "red", "--via", self.arguments.via, "-o",
                       f"{self.scratch}/captured", "--"] + command
        done = subprocess.run(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True, check=False)
        if not os.path.isdir(folder):
            sys.exit(f"piglit did not run: {done.stderr.strip()}")
        return results_of(folder)

    def captured(self):
        """Processes that presented, and frames captured of frames seen."""
        runs = [json.loads(path.read_text()) for path in pathlib.Path(self.scratch).glob("captured/*/run.json")]
        return len(runs), sum(run["counts"]["captured"] for run in runs), sum(run["counts"]["seen"] for run in runs)


def differing(without, with_shim):
    return sorted(name for name in without.keys() | with_shim.keys() if without.get(name) != with_shim.get(name))


def is_unsteady(name, without, sides):
    """The same on both sides when run again, or not steady without the shim either."""
    alone, shimmed = ({results.get(name) for results in sides[side]} for side in (False, True))
    return (alone == shimmed and len(alone) == 1) or len(alone | {without.get(name)}) > 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tilepress", default="tilepress")
    parser.add_argument("--tests", default="window", choices=sorted(TESTS))
    parser.add_argument("--via", default="auto")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("-t", action="append", dest="patterns")
    arguments = parser.parse_args()
    if shutil.which("piglit") is None:
        sys.exit("piglit: not found (Debian package piglit)")
    server, display = x_server()
    scratch = tempfile.mkdtemp(prefix="tilepress-conformance-")
    try:
        bench = Bench(arguments, display, scratch)
        patterns = arguments.patterns or TESTS[arguments.tests]
        without = bench.run(patterns, False)
        with_shim = bench.run(patterns, True)
        names = differing(without, with_shim)
        unsteady = []
        if names:
            again = sorted({"^" + re.escape(name.split(" / ")[0]) + "$" for name in names})
            arguments.jobs = 1
            sides = {False: [], True: []}
            for _ in range(4):
                for side, found in sides.items():
                    found.append(bench.run(again, side))
            unsteady = [name for name in names if is_unsteady(name, without, sides)]
        different = [name for name in names if name not in unsteady]
        processes, captured, seen = bench.captured()
        counts = collections.Counter(without.values())
        print(f"{len(without)} results of {sum(' / ' not in name for name in without)} tests, without the shim "
              f"{', '.join(f'{count} {result}' for result, count in counts.most_common())}; with it (--via {arguments.via}) "
              f"{processes} processes presented, {captured} of {seen} frames captured.")
        print(f"{len(different)} differences, {len(unsteady)} unsteady.")
        if names:
            print("\n| test | without | with | |\n|---|---|---|---|")
            for name in names:
                print(f"| {name} | {without.get(name)} | {with_shim.get(name)} | "
                      f"{'unsteady' if name in unsteady else 'DIFFERENT'} |")
        return 1 if different else 0
    finally:
        server.terminate()
        server.wait()
        shutil.rmtree(scratch, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
