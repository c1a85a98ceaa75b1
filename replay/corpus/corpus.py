#!/usr/bin/env python3
"""The program behind `tilepress corpus`: lists, records, verifies, compares and exports workloads.

`tilepress corpus` passes absolute paths, and the path of itself as TILEPRESS in the environment."""
import argparse
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import comparison
import corpus_messages
import publish
import recipe as recipes
import workload
from corpus_messages import Fault, complain, counted, each_with_time_left, say


def list_recipes(options, chosen):
    lines = [f"{'name':28} {'kind':4} {'frames':>6}  {'recorded':8}  stands for"]
    for one in chosen:
        recorded = "yes" if (options.output / one.name / "info.json").is_file() else "-"
        lines.append(f"{one.name:28} {one.category:4} {one.frames:6}  {recorded:8}  {one.stands_for}")
    kinds = ", ".join(f"{sum(one.category == kind for one in chosen)} {kind}" for kind in recipes.CATEGORIES)
    lines.append(f"{counted(len(chosen), 'workload')} ({kinds}), {counted(sum(one.frames for one in chosen), 'frame')}")
    options.listing.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return True


def install(chosen):
    """Installs the Debian packages of the recipes. Raises Fault."""
    packages = sorted({package for one in chosen for package in one.packages if not workload.installed_version(package)})
    if not packages:
        return
    say(f"installing {', '.join(packages)}")
    command = ["apt-get", "install", "-y", "-qq", "--no-install-recommends", *packages]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
                          env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if line.startswith("E: ")]
        raise Fault(f"apt-get: {lines[0][3:] if lines else f'status {done.returncode}'}")


def record_recipes(options, chosen):
    if options.install:
        install(chosen)
    options.output.mkdir(parents=True, exist_ok=True)
    good = 0
    for one in chosen:
        if options.frames:
            one.frames = options.frames
    for one in each_with_time_left(chosen, lambda recipe: recipe.frames):
        try:
            info = workload.record(one, options.output, options.keep)
        except (Fault, OSError, subprocess.SubprocessError) as fault:
            complain(f"{one.name}: {fault}")
            continue
        good += 1
        say(f"{one.name}: {counted(info['frames'], 'frame')} {info['width']}x{info['height']}, {info['trace_bytes']} bytes, "
            f"VDCP {info['rates']['vdcp']['rate']:.2f}, RAS {info['rates']['ras']['rate']:.2f}")
    if len(chosen) > 1:
        say(f"{good} of {counted(len(chosen), 'workload')} recorded in {options.output}")
    return good == len(chosen)


def compare_recordings(options):
    table, equal = comparison.compare([Path(name) for name in options.names[:2]], options.names[2:], options.category,
                                      options.recipes, options.replay)
    options.listing.write_text(table, encoding="utf-8")
    return equal


def recorded_folders(options):
    """Folders with a recorded workload. Complains about names without one. Returns folders and whether all are there."""
    names = options.names or sorted(path.parent.name for path in options.output.glob("*/info.json"))
    folders, complete = [], True
    for name in names:
        folder = options.output / name
        try:
            info = json.loads((folder / "info.json").read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            complain(f"{folder}: {error.strerror if isinstance(error, OSError) else 'info.json: ' + str(error)}")
            complete = False
            continue
        if options.category in ("", info.get("category")):
            folders.append(folder)
    if not folders and complete:
        complain(f"{options.output}: no recorded workload")
        complete = False
    return folders, complete


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("command", choices=("list", "record", "verify", "compare", "export"))
    parser.add_argument("names", nargs="*")
    parser.add_argument("--category", default="")
    parser.add_argument("--recipes", type=Path, required=True)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--archive", type=Path)
    parser.add_argument("--listing", type=Path)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--frames", type=int, default=0)
    parser.add_argument("--install", action="store_true")
    parser.add_argument("--replay", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    return parser.parse_args()


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    signal.signal(signal.SIGINT, lambda *_: sys.exit(128 + signal.SIGINT))
    options = parse()
    corpus_messages.QUIET = options.quiet
    if options.command in ("list", "record"):
        chosen, faults = recipes.read_recipes(options.recipes, options.names, options.category)
        for fault in faults:
            complain(fault)
        act = list_recipes if options.command == "list" else record_recipes
        return bool(chosen) and act(options, chosen) and not faults
    if options.command == "compare":
        return compare_recordings(options)
    folders, complete = recorded_folders(options)
    if not folders:
        return False
    if options.command == "verify":
        return publish.verify(folders) and complete
    if complete:
        publish.export(folders, options.archive)
    return complete


if __name__ == "__main__":
    try:
        sys.exit(0 if main() else 1)
    except Fault as fault:
        complain(fault)
        sys.exit(1)
    except OSError as error:
        complain(f"{error.filename or 'corpus'}: {error.strerror}")
        sys.exit(1)
