#!/usr/bin/env python3
"""tilepress compare and report at the command line: what they print and how they exit. compare_cli.py TILEPRESS."""
import csv
import io
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import make_runs  # noqa: E402

faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def tilepress(*arguments):
    done = subprocess.run([sys.argv[1], *map(str, arguments)], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


def worsen(folder, scheme, factor):
    """Multiplies the bursts of one scheme."""
    path = folder / "schemes.csv"
    rows = list(csv.reader(io.StringIO(path.read_text())))
    for row in rows[1:]:
        if row[2] == scheme:
            row[7] = str(int(int(row[7]) * factor))
    path.write_text("".join(",".join(row) + "\n" for row in rows))


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        a, b = folder / "a", folder / "b"
        make_runs.make_run(a, 1, 30, 1, "UI")
        shutil.copytree(a, b)
        status, out, err = tilepress("compare", a, b, "--threshold", "0")
        expect(status == 0 and err == "", f"equal runs: {status} {err}")
        expect("Frames that differ most" not in out, "equal runs have frames that differ")

        worsen(b, "vdcp", 1.1)
        status, out, err = tilepress("compare", a, b, "--threshold", "5", "--format", "csv")
        expect(status == 1, f"a regression past the threshold exits {status}")
        expect("rate of vdcp fell by" in err and "dcp fell" not in err.replace("vdcp fell", ""), "the regression is not named: " + err)
        rows = {row["scheme"]: row for row in csv.DictReader(io.StringIO(out))}
        source = [row for row in csv.DictReader((a / "schemes.csv").open()) if row["scheme"] == "vdcp" and row["warmup"] == "0"]
        worse = [row for row in csv.DictReader((b / "schemes.csv").open()) if row["scheme"] == "vdcp" and row["warmup"] == "0"]

        def rate(lines):
            moved = sum(int(row["bursts"]) * 128 + int(row["csb_bits"]) + int(row["palette_bits"]) for row in lines)
            return sum(int(row["raw_bits"]) for row in lines) / moved

        expect(abs(float(rows["vdcp"]["rate_a"]) - rate(source)) < 1e-12, "rate_a")
        expect(abs(float(rows["vdcp"]["change"]) - (rate(worse) / rate(source) - 1)) < 1e-12, "change")
        expect(rows["vdcp"]["worse"] == "29" and rows["vdcp"]["frames"] == "29", "frames of vdcp")
        expect(rows["dcp"]["change"] == "0", "change of dcp")
        expect(tilepress("compare", a, b, "--threshold", "50")[0] == 0, "a small regression is within a large threshold")
        expect(tilepress("compare", a, b)[0] == 0, "without a threshold nothing is a regression")
        expect(tilepress("compare", b, a, "--threshold", "0")[0] == 0, "an improvement is no regression")

        status, out, _ = tilepress("compare", a, b, "--per-frame", "--format", "csv", "--frames", "3-5")
        frames = list(csv.DictReader(io.StringIO(out)))
        expect([row["frame"] for row in frames if row["scheme"] == "vdcp"] == ["3", "4", "5"], "--frames chooses the frames")

        status, out, _ = tilepress("compare", a, b, "--format", "markdown")
        expect(out.startswith("| workload | scheme ") and "-----: |" in out, "Markdown table: " + out[:200])

        cut = folder / "cut"
        shutil.copytree(a, cut)
        for file, lines in (("frames.csv", 21), ("schemes.csv", 141)):
            path = cut / file
            path.write_text("".join(path.read_text().splitlines(keepends=True)[:lines]))
        status, out, _ = tilepress("compare", a, cut)
        expect("not the same frames: 19 compared, 10 only in A, 0 only in B" in out, "missing frames are told: " + out[-300:])

        other = folder / "other"
        make_runs.make_run(other, 2, 30, 1, "UI")
        status, out, _ = tilepress("compare", a, other)
        expect("not the same pictures: colours differ in 29 of 29 frames" in out, "other pictures are told: " + out[-300:])

        for arguments, wanted, line in (
                (("compare", a, folder / "none"), 1, "no such folder"), (("compare", a), 2, "B"),
                (("compare", a, b, "--format", "xml"), 2, "--format xml: not one of text, markdown, csv"),
                (("compare", a, b, "--frames", "9-3"), 2, "9-3"), (("report",), 2, "RUN"),
                (("report", folder / "none"), 1, "no such folder"), (("report", a, "-o", folder / "no" / "x.html"), 1, "No such file"),
                (("report", a, "--category", "UI"), 2, "needs PATTERN=NAME")):
            status, out, err = tilepress(*arguments)
            expect(status == wanted and err.startswith("tilepress: ") and err.count("\n") == 1 and line in err and out == "",
                   f"{arguments[0]} {arguments[1:]}: exit {status}, {err!r}")
        empty = folder / "empty"
        empty.mkdir()
        expect("holds no run" in tilepress("report", empty)[2], "an empty folder is named")

        page = folder / "x.html"
        status, out, err = tilepress("report", a, b, "-o", page)
        expect((status, out, err) == (0, "", f"{page}: a page about 2 runs\n"), f"report names its file: {err}")
        status, out, err = tilepress("report", a, "-o", "-", "--category", "*=2D", "--recategorize", "--title", "My <run>")
        expect(status == 0 and err == "" and out.startswith("<!doctype html>") and "<h1>My &lt;run&gt;</h1>" in out, "a page on standard output")
        expect('data-v="2D"' in out, "--category sets the category")
    for fault in faults:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
