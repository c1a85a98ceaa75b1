#!/usr/bin/env python3
"""Writes RESULTS.md anew: runs the studies on a recorded corpus, and fills results_text.md with their numbers.

    results.py CORPUS [--work DIR] [-j N] [--tilepress FILE]

CORPUS is a folder of `tilepress corpus record`. Every scheme of `tilepress schemes` takes part. DIR keeps frames and
results: a second call computes only what is new. Figures go to results/ beside RESULTS.md."""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Of the schemes of the paper. The defaults are bursts of 128 bits and tiles of 32.
SENSITIVITY = {"burst 128": [], "burst 256": ["--burst", "256"], "tile 16": ["--tile", "16"], "tile 64": ["--tile", "64"]}


def parse():
    parser = argparse.ArgumentParser(description="Writes RESULTS.md from a recorded corpus.")
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--work", type=Path, default=Path("tilepress-results"), help="folder of studies and frames")
    parser.add_argument("-j", "--jobs", default="2", help="tasks at a time")
    parser.add_argument("--first", type=int, default=30, metavar="N",
                        help="frames of each workload that every scheme and the sensitivity take; 0: all")
    parser.add_argument("--tilepress", default="tilepress", help="the command")
    parser.add_argument("--studies-only", action="store_true", help="run the studies and write nothing")
    return parser.parse_args()


options = parse()
os.environ["TILEPRESS"] = options.tilepress
sys.dont_write_bytecode = True

import publish  # noqa: E402
import results_values  # noqa: E402
from corpus_messages import Fault, complain, say  # noqa: E402


def read_groups():
    """Group: its schemes, in the order of `tilepress schemes`."""
    done = subprocess.run([options.tilepress, "schemes"], capture_output=True, text=True, check=True)
    groups = {}
    for line in done.stdout.splitlines():
        if match := re.fullmatch(r"([a-z]+):", line):
            group = groups[match[1]] = []
        elif re.match(r"\w", line):
            group = []   # the keys that schemes share
        elif match := re.match(r"  ([a-z][a-z0-9]*) ", line):
            group.append(match[1])
    return groups


def write_study(name, schemes):
    path = options.work / f"{name}.toml"
    words = ", ".join(f'"{scheme}"' for scheme in schemes)
    path.write_text(f'name = "{name}"\nbaseline = "vdcp"\nconfigurations = [{words}]\n', encoding="utf-8")
    return str(path)


def run_study(name, study, manifest, words=()):
    folder = options.work / name.replace(" ", "-")
    say(f"study {name}")
    done = subprocess.run([options.tilepress, "study", study, "-q", "-j", options.jobs, "-o", str(folder), "--cache",
                           str(options.work / "cache"), "--cache-size", "200", *words, str(manifest)], check=False)
    if done.returncode not in (0, 1) or not (folder / "means.csv").is_file():
        raise Fault(f"study {name}: status {done.returncode}")
    return folder


def run_studies(infos, groups):
    """Returns the folder of each study."""
    options.work.mkdir(parents=True, exist_ok=True)
    manifest = options.work / "manifest.toml"
    manifest.write_text(publish.manifest_of(infos, f"{options.corpus.resolve()}/"), encoding="utf-8")
    folders = {"paper": run_study("paper", "paper", manifest)}
    first = ["--frames", f"0-{options.first - 1}"] if options.first else []
    every = write_study("schemes", [one for group in groups.values() for one in group])
    folders["schemes"] = run_study("schemes", every, manifest, first)
    sensitivity = write_study("sensitivity", groups["paper"])
    folders.update({name: run_study(name, sensitivity, manifest, words + first)
                    for name, words in SENSITIVITY.items()})
    return folders


def translucent_workloads(paper):
    """Names of workloads whose middle frame has a pixel that is not opaque."""
    names = set()
    for path in sorted((paper / "workloads").glob("*.json")):
        record = json.loads(path.read_text(encoding="utf-8"))
        if not record.get("frames_file"):
            continue
        colors = options.work / "colors" / f"{record['frames_digest']}.csv"
        if not colors.exists():
            colors.parent.mkdir(exist_ok=True)
            with tempfile.TemporaryDirectory() as folder:
                subprocess.run([options.tilepress, "frames", "-q", "-s", "red", "--frames", str(record["frames"] // 2), "--cdf",
                                str(colors), "-o", f"{folder}/run", record["frames_file"]], check=True, stdout=subprocess.DEVNULL)
        if any(not row["color"].endswith("FF") for row in results_values.read_rows(colors)):
            names.add(path.stem)
    return names


def copy_drawing(source, target):
    """Writes a smaller SVG file that draws the same, with scour (Debian package scour)."""
    subprocess.run(["scour", "-q", "-i", str(source), "-o", str(target), "--enable-viewboxing", "--remove-metadata", "--shorten-ids",
                    "--indent=none", "--no-line-breaks", "--strip-xml-prolog", "-p", "4"], check=True)
    # scour leaves the places of marks as they are.
    text = re.sub(r'\b([xy])="(-?\d+\.\d{2,})"', lambda match: f'{match[1]}="{float(match[2]):.1f}"',
                  target.read_text(encoding="utf-8"))
    target.write_text(text, encoding="utf-8")


def figure_of(folders):
    """Returns the function that copies a drawing, and returns the Markdown line that shows it."""
    def figure(name):
        study, _, drawing = name.rpartition("/")
        source = folders[study or "paper"] / "figures" / f"{drawing}.svg"
        title = re.search(r"<title>(.*?)</title>", source.read_text(encoding="utf-8"))
        target = HERE / "results" / f"{study}{'-' if study else ''}{source.name}"
        target.parent.mkdir(exist_ok=True)
        copy_drawing(source, target)
        return f"![{title[1] if title else drawing}](results/{target.name})"
    return figure


def main():
    infos, groups = results_values.read_infos(options.corpus), read_groups()
    folders = run_studies(infos, groups)
    if options.studies_only:
        return
    values = results_values.Values(folders, infos, groups, translucent_workloads(folders["paper"]), options.first)
    text = (HERE / "results_text.md").read_text(encoding="utf-8")
    (HERE / "RESULTS.md").write_text(results_values.fill(text, values, figure_of(folders)), encoding="utf-8")
    say(f"{HERE / 'RESULTS.md'} written")


if __name__ == "__main__":
    try:
        main()
    except (Fault, OSError, subprocess.SubprocessError) as fault:
        complain(fault)
        sys.exit(1)
