#!/usr/bin/env python3
"""Compares every row of the golden tables with what `tilepress frames` writes.

Usage: check_golden.py TILEPRESS GOLDEN_FOLDER [SET]"""
import csv
import os
import subprocess
import sys
import tempfile
from collections import defaultdict

INTEGERS = ("payload_bits", "bursts", "csb_bits", "palette_bits")
RATIOS = ("entropy", "pixel_change", "color_change", "fvc_coverage", "fvc_relative_coverage", "top100_coverage")
FVC_RATIOS = ("fvc_coverage", "fvc_relative_coverage")
CALL_OPTIONS = ("tile", "burst")


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def split_options(text):
    """'--fvc 128 --tile 64' -> (call options, scheme keys), both as lists of words."""
    words = text.split()
    call, keys = [], []
    for name, value in zip(words[::2], words[1::2]):
        name = name.removeprefix("--")
        if name in CALL_OPTIONS:
            call += ["--" + name, value]
        else:
            keys.append(f"{name}={value}")
    return tuple(call), keys


def scheme_text(scheme, keys):
    if scheme.split(":")[0] in ("ras", "red") or not keys:
        return scheme
    return scheme + (":" if ":" not in scheme else ",") + ",".join(keys)


def main():
    command, golden = sys.argv[1:3]
    only = sys.argv[3:]
    calls = defaultdict(dict)  # (set, call options) -> {(scheme text, frame): expected row}
    coverages = defaultdict(dict)  # (set, call options) -> {(scheme text, frame): expected row}
    compared = 0
    for row in read_rows(os.path.join(golden, "expected.csv")):
        call, keys = split_options(row["options"])
        calls[row["set"], call].setdefault((scheme_text(row["scheme"], keys), row["frame"]), []).append(row)
    for row in read_rows(os.path.join(golden, "fvc.csv")):
        call, keys = split_options(row["options"])
        coverages[row["set"], call][scheme_text("vdcp", keys), row["frame"]] = row
    metrics = {(row["set"], row["frame"]): row for row in read_rows(os.path.join(golden, "metrics.csv"))}

    faults = []
    for (name, call), expected in sorted(calls.items()):
        if only and name not in only:
            continue
        images = sorted(os.path.join(golden, name, f) for f in os.listdir(os.path.join(golden, name)))
        schemes = sorted({scheme for scheme, _ in expected})
        with tempfile.TemporaryDirectory() as folder:
            words = [command, "frames", "-q", "-o", folder, *call]
            for scheme in schemes:
                words += ["-s", scheme]
            subprocess.run(words + images, check=True)
            got = {(row["scheme"], row["frame"]): row for row in read_rows(os.path.join(folder, "schemes.csv"))}
            frames = read_rows(os.path.join(folder, "frames.csv"))
        for key, rows in expected.items():
            for row in rows:
                compared += 1
                for column in INTEGERS:
                    if key not in got or got[key][column] != row[column]:
                        faults.append(f"{name} {' '.join(call)} {key}: {column} is "
                                      f"{got.get(key, {}).get(column)}, not {row[column]}")
        for key, row in got.items():
            wanted = coverages[name, call].get(key)
            if key[0].split(":")[0] != "vdcp" and wanted is None:
                continue
            compared += 1
            for column in FVC_RATIOS:
                shown = row[column] and f"{float(row[column]):.6f}"
                if shown != (wanted[column] if wanted else ""):
                    faults.append(f"{name} {' '.join(call)} {key}: {column} is {row[column]}, expected {wanted}")
        # The tile decides the traversal, and with it what the metrics' FVC holds: the table has the default tile's.
        for row in frames if "--tile" not in call else []:
            wanted = metrics[name, row["frame"]]
            compared += 1
            if row["unique_colors"] != wanted["unique_colors"]:
                faults.append(f"{name} frame {row['frame']}: unique_colors is {row['unique_colors']}")
            for column in RATIOS:
                if f"{float(row[column]):.6f}" != wanted[column]:
                    faults.append(f"{name} frame {row['frame']}: {column} is {row[column]}, not {wanted[column]}")
    for fault in faults[:40]:
        print(fault)
    print(f"{compared} rows compared, {len(faults)} values differ")
    return 1 if faults or compared == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
