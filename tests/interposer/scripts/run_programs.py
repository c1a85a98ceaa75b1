#!/usr/bin/env python3
"""Runs real programs with and without the shim under an X server of its own and prints a table.

  run_programs.py [--tilepress PATH] [--frames N] [--seconds S] [--via auto|preload|glvnd] [--no-overhead] [NAME...]

A program that does not end gets SIGTERM once N frames (100) are captured or S seconds (45) are over. Without the shim it
runs as long as with it. The overhead is the ratio of mean frame times of two more runs: one captures with the default
schemes, one only counts. The script skips programs that are not installed and names their packages. Exit status 1 if a
program ends otherwise with the shim, if frames are missing, or if the program's output has a line of the shim.
"""
import argparse
import csv
import json
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent


def programs(scratch):
    for line in (HERE / "programs.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            name, packages, command = (field.strip() for field in line.split("|", 2))
            yield name, packages, shlex.split(command.format(here=HERE, scratch=scratch))


def x_server():
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1024x1280x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        return server, ":" + pipe.readline().strip()


def run_until(command, seconds, environment, log, enough=lambda: False):
    """Runs the command, sends it SIGTERM after `seconds`, or earlier when there is enough. Its exit status (a signal
    counts as 128 + its number) and the seconds it ran."""
    begin = time.monotonic()
    with open(log, "wb") as file:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=file, stderr=file,
                                   start_new_session=True)
    while process.poll() is None and time.monotonic() < begin + seconds and not enough():
        time.sleep(0.2)
    elapsed = time.monotonic() - begin
    if process.poll() is None:
        process.terminate()  # the program alone, not what it has started
    try:
        process.wait(15)
    except subprocess.TimeoutExpired:
        pass
    try:
        os.killpg(process.pid, signal.SIGKILL)  # the processes it has left behind
    except ProcessLookupError:
        pass
    process.wait()
    return (process.returncode if process.returncode >= 0 else 128 - process.returncode), elapsed


def rows_in(output):
    return sum(path.read_bytes().count(b"\n") - 1 for path in pathlib.Path(output).glob("*/frames.csv"))


def overhead(arguments, command, seconds, environment, output, log):
    """The frame-time ratio as text, and the exit statuses of both runs."""
    run_until([arguments.tilepress, "run", "-q", "--measure-overhead", "--rounds", "1", "--seconds", f"{seconds:.1f}", "--via",
               arguments.via, "-o", output, "--"] + command, 4 * seconds + 60, environment, log)
    try:
        with open(f"{output}/overhead.csv", newline="", encoding="utf-8") as file:
            without, with_shim = sorted(csv.DictReader(file), key=lambda row: row["shim"], reverse=True)
        return f"{float(with_shim['ratio_mean']):.2f} ({int(with_shim['mean_ns']) / 1e6:.1f} / " \
               f"{int(without['mean_ns']) / 1e6:.1f} ms)"
    except (OSError, ValueError):
        return "-"


def harvest(output):
    totals = {"runs": 0, "seen": 0, "captured": 0, "rows": 0, "readback_ms": 0.0, "sizes": set(), "via": set()}
    for run in sorted(pathlib.Path(output).glob("*/run.json")):
        record = json.loads(run.read_text())
        totals["runs"] += 1
        totals["via"].add(record["via"])
        for key in ("seen", "captured"):
            totals[key] += record["counts"][key]
        rows = (run.parent / "frames.csv").read_text().splitlines()
        names = rows[0].split(",")
        for row in rows[1:]:
            fields = dict(zip(names, row.split(",")))
            totals["rows"] += 1
            totals["readback_ms"] += int(fields["readback_ns"]) / 1e6
            totals["sizes"].add(f"{fields['width']}x{fields['height']} {fields['format']}")
    return totals


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tilepress", default="tilepress")
    parser.add_argument("--frames", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=45)
    parser.add_argument("--no-overhead", action="store_true")
    parser.add_argument("--via", default="auto")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    server, display = x_server()
    scratch = tempfile.mkdtemp(prefix="tilepress-programs-")
    environment = dict(os.environ, DISPLAY=display, HOME=scratch, XDG_RUNTIME_DIR=scratch)
    environment["PATH"] += ":/usr/games"
    os.environ["PATH"] = environment["PATH"]
    environment.pop("WAYLAND_DISPLAY", None)
    failures = 0
    print("| program | frames | captured | status without / with | readback ms | frame-time ratio | surfaces | via | verdict |")
    print("|---|---|---|---|---|---|---|---|---|")
    try:
        for name, packages, command in programs(scratch):
            if arguments.names and name not in arguments.names:
                continue
            program = next(word for word in command if word != "env" and "=" not in word)
            if shutil.which(program) is None:
                print(f"| {name} | | | | | | | | skipped: needs {packages} |", flush=True)
                continue
            output = f"{scratch}/{name}"
            shimmed = [arguments.tilepress, "run", "-q", "-s", "vdcp", "--via", arguments.via, "-o", output, "--"] + command
            status, elapsed = run_until(shimmed, arguments.seconds, environment, f"{scratch}/{name}.with",
                                        lambda: rows_in(output) >= arguments.frames)
            without, _ = run_until(command, elapsed, environment, f"{scratch}/{name}.without")
            for _ in range(2):  # the effect of SIGTERM depends on how far a program is
                if without != status:
                    without, _ = run_until(command, elapsed + 2, environment, f"{scratch}/{name}.without")
            totals = harvest(output)
            ratio = "" if arguments.no_overhead else overhead(arguments, command, max(5, elapsed), environment, output + ".overhead",
                                                              f"{scratch}/{name}.overhead-log")
            # Frames in the queue when a signal ends a program are lost: at most three per process.
            lost = totals["seen"] - totals["rows"]
            said = b"\ntilepress:" in b"\n" + pathlib.Path(f"{scratch}/{name}.with").read_bytes()
            good = not said and totals["rows"] > 0 and lost <= 3 * totals["runs"] and status == without
            failures += not good
            mean = totals["readback_ms"] / max(1, totals["rows"])
            print(f"| {name} | {totals['seen']} | {totals['rows']} | {without} / {status} | {mean:.2f} | {ratio} | "
                  f"{', '.join(sorted(totals['sizes']))} | {', '.join(sorted(totals['via']))} | "
                  f"{'good' if good else 'LOOK: ' + scratch} |", flush=True)
    finally:
        server.terminate()
        server.wait()
    if failures == 0:
        shutil.rmtree(scratch, ignore_errors=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
