#!/usr/bin/env python3
"""The decoder and the FVC of this folder agree with what `tilepress vectors` writes, under Icarus Verilog and Verilator; a changed
vector is noticed.

Usage: simulate.py TILEPRESS GOLDEN_FOLDER"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

TILEPRESS, GOLDEN = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
HERE = os.path.dirname(os.path.abspath(__file__))
MODULES = [os.path.join(HERE, name) for name in ("vectors_bench.v", "vdcp_decoder.v", "fvc.v")]
BLOCKS = 24
FIRST = {"desktop": 5000, "map": 7000, "odd": 1176 - BLOCKS}  # odd: the last blocks, with padding on both sides
# File, line and digit to change. Line 0 of the dictionaries is the most frequent colour and the first slot.
CHANGES = [("pixels", 100, 7), ("csb", 5, 3), ("payload_bits", 9, 3), ("ccd", 0, 8), ("fvc_before_blocks", 0, 16), ("fvc_after_blocks", 63, 16),
           ("mask", 3, 0)]


def run(*words, **further):
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False, **further)
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done.stdout + done.stderr


def write_vectors(folder, name):
    images = [os.path.join(GOLDEN, name, f"{number:03}.png") for number in range(2)]
    run(TILEPRESS, "vectors", "-q", "-s", "vdcp", "--write", "1", "--first", str(FIRST[name]), "--blocks", str(BLOCKS), *images, "-o",
        os.path.join(folder, name))
    return os.path.join(folder, name, "frame-000001")


def build_icarus(folder, parameters):
    run("iverilog", "-g2005", f"-I{parameters}", "-o", f"{folder}/bench.vvp", os.path.join(HERE, "icarus_clock.v"), *MODULES)
    return ["vvp", "-n", f"{folder}/bench.vvp"]


def build_verilator(folder, parameters):
    """Without optimization: the C++ takes longer to compile than to run."""
    run("verilator", "--cc", "--exe", "--build", "-Wall", "-Wno-UNUSEDSIGNAL", "-Wno-UNUSEDPARAM", "-Wno-DECLFILENAME", "--top-module", "vectors_bench",
        "-MAKEFLAGS", "OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0", "-Mdir", f"{folder}/verilated", f"-I{parameters}", *MODULES,
        os.path.join(HERE, "verilator_clock.cpp"))
    return [f"{folder}/verilated/Vvectors_bench"]


def change_digit(path, line, digit):
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    old = lines[line][digit]
    lines[line] = lines[line][:digit] + f"{int(old, 16) ^ 1:x}" + lines[line][digit + 1:]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines))


def check_changes(simulators, folder, frame):
    # A block of payload, all of it: its first digit is part of an index or of a raw pixel.
    with open(f"{frame}/payload_bits.hex", encoding="ascii") as file:
        filled = [number for number, line in enumerate(file) if int(line, 16) > 0]
    for name, line, digit in [*CHANGES, ("payload", filled[-1], 0)]:
        changed = f"{folder}/changed"
        shutil.copytree(frame, changed)
        change_digit(f"{changed}/{name}.hex", line, digit)
        for simulator in simulators:
            said = run(*simulator, f"+dir={changed}")
            assert said.startswith("FAIL "), (name, simulator, said)
        shutil.rmtree(changed)


def main():
    with tempfile.TemporaryDirectory(prefix="tilepress-verilog-") as folder:
        frames = {name: write_vectors(folder, name) for name in FIRST}
        # All sets have the same frame.vh but for the size of the surface, which the bench does not use.
        simulators = [build(folder, frames["odd"]) for build in (build_icarus, build_verilator)]
        evictions = 0
        for name, frame in frames.items():
            said = [run(*simulator, f"+dir={frame}") for simulator in simulators]
            found = [re.match(rf"PASS {BLOCKS} blocks, (\d+) hits, (\d+) evictions\n", text) for text in said]
            assert all(found) and "WARNING" not in said[0], (name, said)
            assert found[0].groups() == found[1].groups(), (name, said)
            evictions += int(found[0].group(2))
            print(f"{name}: {found[0].group(0)}", end="")
        assert evictions > 0, "no set evicts"
        check_changes(simulators, folder, frames["map"])


main()
