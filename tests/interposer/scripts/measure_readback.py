#!/usr/bin/env python3
"""Measures what the shim costs a program's thread per frame, beside a bare glReadPixels of the same frame.

  measure_readback.py [--tilepress PATH] [--program PATH] [--frames N] [--rounds N]

The program (tests/interposer/programs/read_cost.c) ends the rendering before either. So the figures contain no wait for
rendering, and none for room in the queue. Prints a table of medians; exit status 1 if the ratio at 720x1280 is above 1.2.
"""
import argparse
import csv
import glob
import shutil
import statistics
import subprocess
import sys
import tempfile

SIZES = ((320, 240), (720, 1280), (1920, 1080))
LIMIT = 1.2


def measure(arguments, width, height):
    """Lists of (bare read, hook) in ms, of all frames but the first ten."""
    output = tempfile.mkdtemp(prefix="tilepress-readback-")
    try:
        done = subprocess.run([arguments.tilepress, "run", "-q", "-s", "red", "-o", output, "--",
                               arguments.program, str(width), str(height), str(arguments.frames)],
                              stdout=subprocess.PIPE, check=True, text=True)
        bare = [int(line) / 1e6 for line in done.stdout.split()]
        (name,) = glob.glob(output + "/*/presents.csv")
        with open(name, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [(bare[int(row["frame"])], (int(row["readback_ns"]) + int(row["hand_off_ns"])) / 1e6,
                 int(row["read_ns"]) / 1e6, int(row["bind_ns"]) / 1e6) for row in rows if int(row["frame"]) >= 10]
    finally:
        shutil.rmtree(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tilepress", default="tilepress")
    parser.add_argument("--program", default="read_cost")
    parser.add_argument("--frames", type=int, default=200)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    print("| size | bare glReadPixels ms | hook ms | of it read | of it making current | ratio (of each round) |")
    print("|---|---|---|---|---|---|")
    ratios = {}
    for width, height in SIZES:
        frames, rounds = [], []
        for _ in range(arguments.rounds):
            found = measure(arguments, width, height)
            frames += found
            bare, hook, *_ = map(statistics.median, zip(*found))
            rounds.append(hook / bare)
        bare, hook, read, bind = map(statistics.median, zip(*frames))
        ratios[width, height] = hook / bare
        print(f"| {width}x{height} | {bare:.3f} | {hook:.3f} | {read:.3f} | {bind:.3f} | {hook / bare:.2f} "
              f"({', '.join(f'{ratio:.2f}' for ratio in rounds)}) |", flush=True)
    return 1 if ratios[720, 1280] > LIMIT else 0


if __name__ == "__main__":
    sys.exit(main())
