#!/usr/bin/env python3
"""Compares what `tilepress frames` writes for the schemes of the literature with sizes computed here.

Usage: literature_sizes.py TILEPRESS GOLDEN_FOLDER SET [FRAMES]

A model of its own: it knows the rules of fpc, fpcd, cpack, freqvals, hilo and msaa, and no line of the program."""
import csv
import functools
import heapq
import os
import subprocess
import sys
import tempfile

from picture_files import read_png

SCHEMES = ("fpc", "fpc:order=quad", "fpcd", "fpcd:order=quad", "cpack", "cpack:order=quad", "freqvals",
           "freqvals:fvc=16", "hilo", "msaa")
QUADS = [(sub // 4 * 2 + i // 2) * 8 + sub % 4 * 2 + i % 2 for sub in range(16) for i in range(4)]
BURST = 128


def signed_bits(value, bits):
    """Bits that a two's complement number of `bits` bits needs."""
    return (value if value < 1 << bits - 1 else (1 << bits) - 1 - value).bit_length() + 1


def fpc_word(word):
    costs = [35]
    need = signed_bits(word, 32)
    costs += [3 + n for n in (4, 8, 16) if need <= n]
    if word % 65536 == 0 or all(signed_bits(half, 16) <= 8 for half in divmod(word, 65536)):
        costs.append(19)
    if len(set(word.to_bytes(4, "big"))) == 1:
        costs.append(11)
    return min(costs)


def fpc(line):
    bits = zeros = 0
    for word in line + (1,):
        if word == 0:
            zeros += 1
            continue
        bits += -(-zeros // 8) * 6 + fpc_word(word)
        zeros = 0
    return bits - fpc_word(1)


def fpcd(line):
    bits = 0
    for i, word in enumerate(line):
        now = word.to_bytes(4, "big")
        forms = [(b"\0" * 4, "MMMM MMMX XMMM MMXX MXMX XXMM".split()), (b"\xff" * 4, ["MMMM", "MMXX"])]
        forms += [(line[j].to_bytes(4, "big"), ["MMMM", "MMMX", "MMXX"]) for j in (i - 1, i - 2) if j >= 0]
        stored = [1 if len(set(now)) == 1 else 4]
        for other, shapes in forms:
            for shape in shapes:
                if all(letter == "X" or now[at] == other[at] for at, letter in enumerate(shape)):
                    stored.append(shape.count("X"))
        bits += 4 + 8 * min(stored)
    return bits


def cpack(line):
    bits, dictionary = 0, []
    for word in line:
        if word == 0:
            bits += 2
        elif word in dictionary:
            bits += 6
        elif word < 256:
            bits += 12
        else:
            tops = {entry >> 8 for entry in dictionary}, {entry >> 16 for entry in dictionary}
            bits += 16 if word >> 8 in tops[0] else 24 if word >> 16 in tops[1] else 34
            dictionary.append(word)
    return bits


def lines(coder, block):
    sizes = [-(-coder(block[at:at + 16]) // 8) for at in range(0, 64, 16)]
    return sum(8 * size if size < 64 else 512 for size in sizes)


def hilo(block):
    for size, low in ((512, 5), (1024, 13), (1536, 21)):
        least, greatest = min(block) >> low, max(block) >> low
        if {word >> low for word in block} <= {least, least + 1, greatest - 1, greatest}:
            return size
    return 2048


def msaa(block):
    pixels = [block[i] for i in QUADS]
    for size, run, colors in ((512, 4, 1), (512, 16, 2), (1024, 2, 1), (1024, 8, 2), (1536, 4, 2)):
        if all(len(set(pixels[at:at + run])) <= colors for at in range(0, 64, run)):
            return size
    return 2048


def collect(picture, width, height, entries):
    """The FVC after a frame: slots of [count, color], by the rule `lfc`."""
    slots, places = [], {}
    for tile_y in range(0, height, 32):
        for tile_x in range(0, width, 32):
            for y in range(tile_y, min(tile_y + 32, height), 8):
                for x in range(tile_x, min(tile_x + 32, width), 8):
                    for at in QUADS:
                        px, py = x + at % 8, y + at // 8
                        if px >= width or py >= height:
                            continue
                        color = picture[py * width + px]
                        if color in places:
                            slots[places[color]][0] += 1
                        elif len(slots) < entries:
                            places[color] = len(slots)
                            slots.append([1, color])
                        else:
                            place = min(range(entries), key=lambda slot: slots[slot][0])
                            del places[slots[place][1]]
                            slots[place], places[color] = [1, color], place
    return slots


def huffman(weights):
    """Length of each weight's code. Joins the two nodes of smallest (weight, number); the new node takes the next number."""
    heap, lengths = [(weight, i, [i]) for i, weight in enumerate(weights)], [0] * len(weights)
    fresh = len(heap)
    heapq.heapify(heap)
    while len(heap) > 1:
        a, b = heapq.heappop(heap), heapq.heappop(heap)
        for leaf in a[2] + b[2]:
            lengths[leaf] += 1
        heapq.heappush(heap, (a[0] + b[0], fresh, a[2] + b[2]))
        fresh += 1
    return lengths


def dictionary(slots):
    """The CCD: slots of [count, color], most frequent first."""
    return sorted(slots, key=lambda slot: -slot[0])  # stable: ties by slot


def code_lengths(slots, pixels):
    """Length of each color's code, and of the escape (None)."""
    ordered = dictionary(slots)
    escapes = pixels - sum(count for count, _ in ordered)
    return dict(zip([color for _, color in ordered] + [None], huffman([count for count, _ in ordered] + [escapes])))


def read_picture(path):
    """Width, height and pixels as words."""
    width, height, channels, samples = read_png(path)
    return width, height, [int.from_bytes(samples[at:at + channels] + (b"" if channels == 4 else b"\xff"), "little")
                           for at in range(0, len(samples), channels)]


def blocks_of(picture, width, height):
    for y in range(0, height, 8):
        for x in range(0, width, 8):
            yield tuple(picture[min(y + i // 8, height - 1) * width + min(x + i % 8, width - 1)] for i in range(64))


@functools.lru_cache(maxsize=1 << 16)
def fixed_size(scheme, block):
    name, _, keys = scheme.partition(":")
    if name in ("hilo", "msaa"):
        return {"hilo": hilo, "msaa": msaa}[name](block)
    return lines({"fpc": fpc, "fpcd": fpcd, "cpack": cpack}[name],
                 tuple(block[i] for i in QUADS) if keys else block)


def figures(scheme, blocks, lengths, entries):
    csb = {"freqvals": 5, "hilo": 2, "msaa": 3}.get(scheme.partition(":")[0], 28)
    sizes = []
    for block in blocks:
        if not scheme.startswith("freqvals"):
            sizes.append(fixed_size(scheme, block))
        elif lengths is None:
            sizes.append(2048)
        else:
            sizes.append(min(2048, sum(lengths.get(word) or lengths[None] + 32 for word in block)))
    return {"payload_bits": sum(sizes), "bursts": sum(-(-size // BURST) for size in sizes),
            "csb_bits": csb * len(sizes), "palette_bits": 39 * entries + 6 if lengths is not None else 0}


def measured(command, schemes, images, options=()):
    """Rows of the program's schemes.csv by scheme and frame."""
    with tempfile.TemporaryDirectory() as folder:
        words = [command, "frames", "-q", "--verify", "-o", folder, *options]
        for scheme in schemes:
            words += ["-s", scheme]
        subprocess.run(words + images, check=True)
        with open(os.path.join(folder, "schemes.csv"), newline="", encoding="utf-8") as file:
            return {(row["scheme"], int(row["frame"])): row for row in csv.DictReader(file)}


def main():
    command, golden, name = sys.argv[1:4]
    images = sorted(os.path.join(golden, name, file) for file in os.listdir(os.path.join(golden, name)))
    images = images[:int(sys.argv[4])] if len(sys.argv) > 4 else images
    got = measured(command, SCHEMES, images)
    faults, lengths = [], {}
    for frame, image in enumerate(images):
        width, height, picture = read_picture(image)
        blocks = list(blocks_of(picture, width, height))
        for scheme in SCHEMES:
            entries = int(scheme.partition("fvc=")[2] or 64)
            for column, value in figures(scheme, blocks, lengths.get(scheme), entries).items():
                if int(got[scheme, frame][column]) != value:
                    faults.append(f"{name} frame {frame} {scheme}: {column} is {got[scheme, frame][column]}, not {value}")
            if scheme.startswith("freqvals"):
                lengths[scheme] = code_lengths(collect(picture, width, height, entries), width * height)
    print("\n".join(faults) if faults else f"{name}: {len(images)} frames of {len(SCHEMES)} schemes agree")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
