#!/usr/bin/env python3
"""tilepress export and the pictures of frames. export_cli.py TILEPRESS GOLDEN_FOLDER."""
import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import make_runs  # noqa: E402

TILEPRESS = sys.argv[1]
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def tilepress(*arguments):
    done = subprocess.run([TILEPRESS, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def check_gem5(run):
    status, out, err = tilepress("export", "--format", "gem5", run)
    expect(status == 0 and err == "", f"gem5: {status} {err}")
    expect(out.startswith("\n---------- Begin Simulation Statistics ----------\n"), "the Begin banner")
    expect(out.endswith("\n---------- End Simulation Statistics   ----------\n"), "the End banner")
    values = {}
    for line in out.splitlines():
        found = re.fullmatch(r"(\S+) +(\S+) +# (.+) \((\w+)\)", line)
        expect(found or line == "" or line.startswith("-----"), "a line is no statistic: " + line)
        if found:
            values[found.group(1)] = found.group(2)
    rows = [row for row in csv.DictReader((run / "schemes.csv").open()) if row["scheme"] == "hdcp" and row["warmup"] == "0"]
    for name, column in (("payloadBits", "payload_bits"), ("bursts", "bursts"), ("csbBits", "csb_bits"), ("vdcpBlocks", "vdcp_blocks")):
        expect(values["game_x.hdcp." + name] == str(sum(int(row[column]) for row in rows)), f"gem5 hdcp.{name}")
    expect(values["game_x.measuredFrames"] == "19", "gem5 measuredFrames")
    out = tilepress("export", "--format", "gem5", "--per-frame", run)[1]
    expect(out.count("Begin Simulation Statistics") == 19 == out.count("End Simulation Statistics"), "one dump per measured frame")


def check_jsonl(run):
    target = run.parent / "rows.jsonl"
    status, out, err = tilepress("export", "--format", "jsonl", run, "-o", target)
    expect(status == 0 and out == "" and err == "", f"jsonl: {status} {err}")
    objects = [json.loads(line) for line in target.read_text().splitlines()]
    expect([entry["type"] for entry in objects].count("run") == 1, "one run object")
    for kind, file in (("frame", "frames.csv"), ("scheme", "schemes.csv")):
        mine = [entry for entry in objects if entry["type"] == kind]
        rows = list(csv.DictReader((run / file).open()))
        expect(len(mine) == len(rows), f"an object per row of {file}")
        for entry, row in zip(mine, rows):
            for column, cell in row.items():
                value = entry[column]
                expect(value == cell if isinstance(value, str) else float(cell) == value, f"{file}: {column} {cell} became {value!r}")
            expect(isinstance(entry["frame"], int) and entry["run"] == "game x", "types of a row's object")


def check_pictures(golden, folder):
    images = sorted((golden / "odd").glob("*.png"))
    run = folder / "odd"
    status, _, err = tilepress("frames", "-q", "-s", "vdcp", "-s", "ras:ycocg=1,sizes=burst", "--heatmaps", "every:2", "--dump-frames", "every:3", "--cdf", run / "cdf.csv",
                               "-o", run, *images)
    expect(status == 0, "frames with pictures: " + err)
    rows = {(row["frame"], row["scheme"]): row for row in csv.DictReader((run / "schemes.csv").open())}
    maps = sorted((run / "heatmaps").iterdir())
    expect(len(maps) == 6, f"{len(maps)} heat maps, not frames 0, 2 and 4 of two schemes")
    for path in maps:
        magic, comment, size, most, samples = path.read_bytes().split(b"\n", 4)
        scheme = comment.decode().removeprefix("# scheme ")
        frame = str(int(path.name.split("-")[1]))
        # 333 x 217 pixels are 42 x 28 blocks.
        expect((magic, size, most) == (b"P5", b"42 28", b"2048") and len(samples) == 42 * 28 * 2, path.name + ": header")
        total = sum(samples[i] * 256 + samples[i + 1] for i in range(0, len(samples), 2))
        expect(total == int(rows[frame, scheme]["payload_bits"]), f"{path.name}: {total} bits, schemes.csv has {rows[frame, scheme]['payload_bits']}")
    dumps = sorted((run / "frames").iterdir())
    expect([path.name for path in dumps] == ["0-000000.png", "0-000003.png"], f"dumped frames: {dumps}")
    # What was dumped goes in again: the same pixels give the same colours and sizes.
    again = folder / "again"
    expect(tilepress("frames", "-q", "-s", "ras:ycocg=1,sizes=burst", "-o", again, *dumps)[0] == 0, "dumped frames are read")
    for row, number in zip(csv.DictReader((again / "schemes.csv").open()), ("0", "3")):
        expect(row["payload_bits"] == rows[number, "ras:ycocg=1,sizes=burst"]["payload_bits"], f"frame {number}: dumped pixels differ")
    page = tilepress("report", run, "-o", "-")[1]
    check_cdf(run, page)
    expect(page.count('<img class="heat" src="data:image/png;base64,') == 6, "heat maps on the page")
    expect(page.count("<figcaption>frame ") == 4, "frames 0, 2, 3 and 4 on the page")
    mean = int(rows["2", "vdcp"]["payload_bits"]) / (42 * 28)
    expect(f'alt="vdcp: {mean:.1f} of 2048 bits per block on average' in page, "a heat map's text has its mean")
    expect(tilepress("frames", "--heatmaps", "2", "-o", folder / "x", *images)[0] == 2, "--heatmaps 2 is a usage error")


def check_cdf(run, page):
    series = json.loads(re.search(r'id="series">(.*?)</script>', page, re.S).group(1))
    plots = [plot for plot in series[0]["surfaces"][0]["plots"] if plot["id"] == "cdf"]
    expect(len(plots) == 1 and len(plots[0]["series"]) == 5, "one colour CDF with a line per frame")
    cells = {(row["frame"], row["rank"]): float(row["cumulative"]) for row in csv.DictReader((run / "cdf.csv").open())}
    top100 = {row["frame"]: float(row["top100_coverage"]) for row in csv.DictReader((run / "frames.csv").open())}
    for frame, share in top100.items():
        expect(abs(cells[frame, "100"] - share) < 1e-9, f"frame {frame}: rank 100 of the CDF is not top100_coverage")
    drawn = 0
    for line in plots[0]["series"]:
        for rank, value in zip(plots[0]["x"], line["y"]):
            if value is not None:
                drawn += 1
                expect(abs(value - cells[line["name"].removeprefix("frame "), str(rank)]) < 1e-5, f"{line['name']}, rank {rank}: {value}")
        expect(abs(max(value for value in line["y"] if value is not None) - 1) < 1e-9, "a CDF does not reach 1")
    expect(drawn > 100, f"only {drawn} points of the CDF")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = folder / "game x"
        make_runs.make_run(run, 3, 20, 1, "3D")
        check_gem5(run)
        check_jsonl(run)
        status, _, err = tilepress("export", run)
        expect(status == 2 and "--format" in err, "--format is required")
        check_pictures(Path(sys.argv[2]), folder)
    for fault in faults[:20]:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
