#!/usr/bin/env python3
"""Compares the bit toggles of the uncompressed frame that `tilepress frames --toggles` writes with counts made here.

Usage: toggle_counts.py TILEPRESS GOLDEN_FOLDER

A model of its own: it knows the rules of the bus, and no line of the program."""
import csv
import os
import subprocess
import sys
import tempfile

from picture_files import read_png

SET, FRAME, TILE = "odd", 1, 32
# Bus width: raw toggles, raw toggles with data bus inversion. Counted by this script once.
KNOWN = {16: (1066607, 916569), 32: (177658, 164258)}


def written_bytes(path):
    """The frame's bytes in the order of the writes: tiles, blocks, 2x2 sub-blocks, pixels. The nearest pixel inside pads."""
    width, height, channels, samples = read_png(path)
    out = bytearray()
    for tile_y in range(0, height, TILE):
        for tile_x in range(0, width, TILE):
            for block_y in range(tile_y, min(tile_y + TILE, height), 8):
                for block_x in range(tile_x, min(tile_x + TILE, width), 8):
                    for number in range(64):
                        sub, pixel = divmod(number, 4)
                        x = min(block_x + sub % 4 * 2 + pixel % 2, width - 1)
                        y = min(block_y + sub // 4 * 2 + pixel // 2, height - 1)
                        at = (y * width + x) * channels
                        out += samples[at:at + 4] if channels == 4 else samples[at:at + 3] + b"\xff"
    return bytes(out)


def toggles(data, bus_bits):
    lanes = bus_bits // 8
    plain = inverted = 0
    for lane in range(lanes):
        before = wires = line = 0  # the bus starts at zeros
        for byte in data[lane::lanes]:
            plain += bin(byte ^ before).count("1")
            before = byte
            change = bin(byte ^ wires).count("1")
            inverts = int(change > 4)
            inverted += (8 - change if inverts else change) + (inverts != line)
            wires, line = byte ^ (0xFF if inverts else 0), inverts
    return plain, inverted


def main():
    command, golden = sys.argv[1:3]
    images = [os.path.join(golden, SET, f"{number:03}.png") for number in range(FRAME + 1)]
    data = written_bytes(images[FRAME])
    faults = []
    for bus_bits, known in KNOWN.items():
        counted = toggles(data, bus_bits)
        if counted != known:
            faults.append(f"{bus_bits} bits: this script counts {counted}, not {known}")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([command, "frames", "-q", "-s", "red", "--toggles", str(bus_bits), "-o", folder, *images], check=True)
            with open(os.path.join(folder, "schemes.csv"), newline="", encoding="utf-8") as file:
                row = next(row for row in csv.DictReader(file) if row["frame"] == str(FRAME))
        got = int(row["raw_toggles"]), int(row["raw_toggles_dbi"])
        if got != known:
            faults.append(f"{bus_bits} bits: raw_toggles and raw_toggles_dbi are {got}, not {known}")
    print("\n".join(faults) if faults else f"{SET}, frame {FRAME}: toggles agree for buses of {list(KNOWN)} bits")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
