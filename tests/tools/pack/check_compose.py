#!/usr/bin/env python3
# Checks tilepress compose, cost and frames --cdf from the outside, against numbers derived by hand.
import csv
import io
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib

TILEPRESS = sys.argv[1]


def write_png(path, width, height, pixel):
    """A solid image; three or four channels as `pixel` has."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = (b"\0" + bytes(pixel) * width) * height
    head = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[len(pixel)], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def run(*args, status=0):
    done = subprocess.run([TILEPRESS, *args], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode == status, (args, done.returncode, done.stderr.decode())
    if status != 0:
        text = done.stderr.decode()
        assert text.startswith("tilepress: ") and text.count("\n") == 1, text
    return done


def compose(*args):
    done = run("compose", *args, "-o", "-")
    rows = list(csv.DictReader(io.StringIO(done.stdout.decode())))
    return rows, done.stderr.decode()


def numbers(row):
    return [int(row[name]) for name in ("blocks", "hidden_blocks", "outside_blocks", "payload_bursts", "csb_bursts",
                                        "table_bursts", "raw_bursts")]


def check_compose(folder):
    """DCP on one colour, 64 entries: a block is 16 sub-blocks of 24 bits = 3 bursts of 128, its CSB 16 bits; the rCCD
    64 x 33 bits = 17 bursts; raw 16 bursts a block. back: 8 x 2 blocks, CSB 256 bits = 2 bursts. window: one block without
    alpha, CSB 16 bits = 1 burst."""
    for i in range(3):
        write_png(f"{folder}/back-{i}.png", 64, 16, (1, 2, 3, 4))
        write_png(f"{folder}/window-{i}.png", 8, 8, (9, 9, 9))
    back, window = f"{folder}/back.tpk", f"{folder}/window.tpk"
    run("pack", "-s", "dcp", "-o", back, *(f"{folder}/back-{i}.png" for i in range(3)))
    run("pack", "-s", "dcp", "-o", window, *(f"{folder}/window-{i}.png" for i in range(2)))

    rows, table = compose(back, window, "--at", "0,0", "--at", "8,8")
    assert [(row["frame"], row["surface"]) for row in rows] == [(str(f), str(s)) for f in range(3) for s in range(2)]
    assert numbers(rows[0]) == [16, 0, 0, 256, 2, 0, 256], "frame 0 is raw"
    assert numbers(rows[2]) == [16, 0, 0, 48, 2, 17, 256], rows[2]
    assert numbers(rows[3]) == [1, 0, 0, 3, 1, 17, 16], rows[3]
    assert numbers(rows[5]) == numbers(rows[3]), "a shorter sequence goes on showing its last frame"
    assert rows[2]["moved_bits"] == str((48 + 2 + 17) * 128) and rows[2]["raw_bits"] == str(256 * 128)
    assert abs(float(rows[2]["rate"]) - 256 / 67) < 1e-12
    # Both together: 67 + 21 bursts of 16 bytes, 60 times a second; raw 272.
    all_line = [line for line in table.splitlines() if line.endswith("  all")][0].split()
    assert all_line[:2] == [f"{272 * 16 * 60 / 1e6:.3f}", f"{88 * 16 * 60 / 1e6:.3f}"], table

    # The window hides block (1, 1) of the back wholly; with alpha, or half a block off, it hides nothing.
    rows, _ = compose(back, window, "--at", "0,0", "--at", "8,8", "--skip-hidden", "--frames", "1")
    assert numbers(rows[0]) == [15, 1, 0, 45, 2, 17, 240], rows[0]
    rows, _ = compose(back, window, "--at", "0,0", "--at", "12,8", "--skip-hidden", "--frames", "1")
    assert numbers(rows[0])[:3] == [16, 0, 0]
    rows, _ = compose(window, back, "--at", "8,8", "--skip-hidden", "--frames", "1")
    assert numbers(rows[0])[:3] == [1, 0, 0], "a surface with alpha hides nothing"
    rows, _ = compose(window, window, "--at", "0,0", "--at", "0,0", "--skip-hidden", "--frames", "1")
    assert numbers(rows[0]) == [0, 1, 0, 0, 0, 0, 0], "not even the tables of a hidden surface are read"

    # Two halves, 4 pixels each, of two windows hide one block together.
    rows, _ = compose(window, window, window, "--at", "8,0", "--at", "4,0", "--at", "12,0", "--skip-hidden", "--frames", "1")
    assert numbers(rows[0])[:2] == [0, 1], rows[0]

    rows, _ = compose(back, "--screen", "16x16", "--frames", "1")
    assert numbers(rows[0]) == [4, 0, 12, 12, 2, 17, 64], rows[0]
    rows, _ = compose(back, "--at", "-60,-9", "--screen", "64x64", "--frames", "1")
    assert numbers(rows[0])[:3] == [1, 0, 15], "4 x 7 pixels are left, in one block"

    run("compose", status=2)
    run("compose", *[back] * 17, status=2)
    run("compose", back, "--at", "1", status=2)
    run("compose", back, "--at", "0,0", "--at", "0,0", status=2)
    run("compose", f"{folder}/absent.tpk", status=1)
    run("compose", f"{folder}/back-0.png", status=1)
    run("compose", back, "--frames", "9", status=3)


def check_cost():
    document = json.loads(run("cost", "--size", "4096x4096", "--rate", "5.26", "--rate", "1.75", "--json").stdout)
    assert (document["fvc_bytes"], document["ccd_bytes"], document["rccd_bytes"]) == (456, 264, 16 * 264)
    assert abs(document["area_mm2"] - 0.009527672) < 1e-12 and not document["area_is_extrapolated"]
    assert [round(100 * rate["energy_saving"], 1) for rate in document["rates"]] == [79.9, 41.8]
    assert document["bandwidth_suffices"]
    assert not json.loads(run("cost", "--size", "16384x16384", "--json").stdout)["bandwidth_suffices"]
    assert json.loads(run("cost", "--fvc", "128", "--json").stdout)["area_is_extrapolated"]
    hardware = {scheme["name"]: scheme["hardware"] for scheme in json.loads(run("cost", "--json").stdout)["schemes"]}
    assert hardware["vdcp"] == "FVC, CCD and rCCD" and hardware["intel11"] == "not known", hardware
    text = run("cost", "--rate", "2.9").stdout.decode()
    assert "amddcc, lcc: not known\n" in text, text
    assert "saves 64.4 %" in text and "199.6 mW is" in text and "swapped" not in text and "264 bytes" in text, text
    assert "in the structures, 2 passes" in text, text
    # The paper's 4.83 pJ hold for 64 entries.
    for words, says in ((["--fvc", "512"], True), (["--fvc", "512", "--structures-pj", "9"], False), ([], False)):
        assert (" (as with 64 entries: not scaled), 2 passes" in run("cost", *words).stdout.decode()) == says, words
        assert json.loads(run("cost", "--json", *words).stdout)["energy_is_not_scaled"] == says, words
    run("cost", "--fvc", "3", status=2)
    run("cost", "--rate", "0", status=2)


def check_cdf(folder):
    write_png(f"{folder}/a.png", 3, 2, (1, 2, 3, 4))
    write_png(f"{folder}/b.png", 3, 2, (9, 8, 7))
    images = [f"{folder}/a.png", f"{folder}/b.png"]
    run("frames", "-q", "-s", "red", *images, "-o", f"{folder}/run", "--cdf", f"{folder}/cdf.csv")
    assert open(f"{folder}/cdf.csv").read() == (
        "frame,surface,rank,color,count,cumulative\n0,0,1,#01020304,6,1\n1,0,1,#090807FF,6,1\n")
    run("frames", "-q", "-s", "red", *images, "-o", f"{folder}/other", "--cdf", f"{folder}/one.csv", "--cdf-frames", "1")
    assert open(f"{folder}/one.csv").read().splitlines()[1:] == ["1,0,1,#090807FF,6,1"]
    run("frames", "-q", "-s", "red", *images, "-o", f"{folder}/third", "--cdf", f"{folder}/one.csv", status=1)
    run("frames", "-q", "-s", "red", *images, "-o", f"{folder}/third", "--cdf-frames", "1", status=2)
    totals = json.load(open(f"{folder}/run/run.json"))
    red = totals["schemes"][0]
    assert abs(red["energy_saving"] - (1 - 1 / red["rate"] - 4.83 / 451.2)) < 1e-9
    # One block of 256 bytes, 60 times a second, written and read.
    assert abs(red["raw_power_mw"] - 256 * 60 * 2 * 451.2e-9) < 1e-12
    assert totals["energy"]["dram_pj_per_byte"] == 451.2


with tempfile.TemporaryDirectory() as scratch:
    for name, check in (("compose", check_compose), ("cdf", check_cdf)):
        os.mkdir(f"{scratch}/{name}")
        check(f"{scratch}/{name}")
    check_cost()
print("compose, cost and --cdf: all well")
