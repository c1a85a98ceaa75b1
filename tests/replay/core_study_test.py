#!/usr/bin/env python3
"""`tilepress study paper` on the core set has the results of core/results.csv, wherever the frames are the recorded ones.

Usage: core_study_test.py TILEPRESS CORE_FOLDER CORPUS_FOLDER [WORKLOAD...]    default: all workloads
       core_study_test.py --write TILEPRESS CORE_FOLDER CORPUS_FOLDER          writes results.csv anew

Mesa draws differently on other processors. A result depends on its frame and on the modelled frames before it: the rows
of a workload are compared up to its first frame with another digest. Frames that differ are counted and do not fail."""
import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

WRITE = "--write" in sys.argv
COMMAND, CORE, CORPUS, *WORKLOADS = [word for word in sys.argv[1:] if word != "--write"]
CORE = Path(CORE)
sys.path.insert(0, CORPUS)
sys.dont_write_bytecode = True

from frame_digests import read_cache, read_rows  # noqa: E402

EVERY = 10
COLUMNS = ["workload", "frame", "scheme", "payload_bits", "bursts", "csb_bits", "palette_bits", "fvc_relative_coverage"]


def study(names, folder):
    """Runs the study. Returns the digests of all frames and the result rows of each workload."""
    traces = [str(CORE / name / f"{name}.trace") for name in names]
    done = subprocess.run([COMMAND, "study", "paper", "-q", "-j", "2", "--every", str(EVERY), "-o", f"{folder}/out",
                           "--cache", f"{folder}/cache", *traces],
                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"the study ends with status {done.returncode}:\n{done.stderr}")
    caches = {}
    for path in Path(folder, "cache").glob("*.frames"):
        frames, origin = read_cache(path)
        caches[origin["input_sha256"]] = [frame[4] for frame in frames]
    infos = {name: json.loads((CORE / name / "info.json").read_text(encoding="utf-8")) for name in names}
    return {name: (caches[info["trace_sha256"]], result_rows(Path(folder, "out/results", name), name))
            for name, info in infos.items()}


def result_rows(folder, name):
    """The rows of all configurations on one workload, without warm-up, by frame."""
    rows = []
    for path in folder.glob("*.csv"):
        rows += [{**row, "workload": name} for row in read_rows(path) if "scheme" in row and row["warmup"] == "0"]
    return sorted(([row[column] for column in COLUMNS] for row in rows), key=lambda row: (int(row[1]), row[2]))


def compare(recorded, digests, expected, rows):
    """Returns how many modelled frames differ, how many rows were compared, and the lines of those that differ."""
    frames = range(0, max(len(recorded), len(digests)), EVERY)
    changed = [frame for frame in frames if recorded[frame:frame + 1] != digests[frame:frame + 1]]
    end = changed[0] if changed else sys.maxsize
    kept, other = ({tuple(row[:3]): row[3:] for row in table if int(row[1]) < end} for table in (expected, rows))
    lines = [f"{' '.join(key)}: {kept.get(key)} expected, {other.get(key)} computed"
             for key in sorted(kept.keys() | other.keys()) if kept.get(key) != other.get(key)]
    return len(changed), len(kept), lines


class Compare(unittest.TestCase):
    ROWS = [["w", "10", "ras", "1"], ["w", "20", "ras", "2"]]

    def test_counts_rows_up_to_the_first_changed_frame(self):
        recorded = [str(number) for number in range(21)]
        self.assertEqual(compare(recorded, recorded, self.ROWS, self.ROWS), (0, 2, []))
        self.assertEqual(compare(recorded, recorded[:20] + ["x"], self.ROWS, self.ROWS), (1, 1, []))
        self.assertEqual(compare(recorded, ["x"] + recorded[1:], self.ROWS, []), (1, 0, []))
        self.assertEqual(compare(recorded, recorded[:-1], self.ROWS, self.ROWS), (1, 1, []))

    def test_names_rows_that_differ_are_missing_or_new(self):
        recorded = [str(number) for number in range(21)]
        other = [["w", "10", "ras", "3"], ["w", "20", "red", "2"]]
        self.assertEqual(compare(recorded, recorded, self.ROWS, other)[2],
                         ["w 10 ras: ['1'] expected, ['3'] computed", "w 20 ras: ['2'] expected, None computed",
                          "w 20 red: None expected, ['2'] computed"])


class Study(unittest.TestCase):
    def test_has_the_committed_results(self):
        names = WORKLOADS or sorted(path.parent.name for path in CORE.glob("*/info.json"))
        with open(CORE / "results.csv", newline="", encoding="utf-8") as file:
            expected = list(csv.reader(file))
        self.assertEqual(expected[0], COLUMNS)
        with tempfile.TemporaryDirectory(prefix="tilepress-core-study-") as folder:
            results = study(names, folder)
        counts, faults = [0, 0], []
        for name, (digests, rows) in results.items():
            recorded = json.loads((CORE / name / "info.json").read_text(encoding="utf-8"))["frame_digests"]
            table = [row for row in expected[1:] if row[0] == name]
            self.assertTrue(table, f"{name} has no row in results.csv (core_study_test.py --write adds them)")
            changed, compared, lines = compare(recorded, digests, table, rows)
            if changed:
                print(f"{name}: {changed} of {len(range(0, len(recorded), EVERY))} frames differ from the recorded ones")
            counts[0] += changed
            counts[1] += compared
            faults += lines
        print(f"{len(names)} workloads, {counts[0]} frames differ, {counts[1]} rows compared")
        self.assertEqual(faults, [])


def write_results():
    names = sorted(path.parent.name for path in CORE.glob("*/info.json"))
    with tempfile.TemporaryDirectory(prefix="tilepress-core-study-") as folder:
        results = study(names, folder)
    for name, (digests, _) in results.items():
        if digests != json.loads((CORE / name / "info.json").read_text(encoding="utf-8"))["frame_digests"]:
            sys.exit(f"{name}: the frames differ from the recorded ones: results.csv stays as it is")
    with open(CORE / "results.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS] + [row for _, rows in results.values() for row in rows])


if __name__ == "__main__":
    if WRITE:
        write_results()
    else:
        unittest.main(argv=sys.argv[:1])
