#!/usr/bin/env python3
"""Compares what `tilepress frames` writes for the scheme lcc with sizes computed here.

Usage: lcc_sizes.py TILEPRESS GOLDEN_FOLDER SET [FRAMES]

A model of its own: it knows the rules of the head comments in codec/lcc, and no line of the program. It runs the frames
of the set, their upper left corners, noise, and blocks of one color."""
import functools
import itertools
import os
import random
import sys
import tempfile

from literature_sizes import blocks_of, collect, dictionary, huffman, measured, read_picture

SCHEMES = ("lcc", "lcc:fvc=16", "lcc:fvc=128")
BURSTS = (128, 256)
CORNERS = ((61, 43), (21, 13))  # the frames of the second are too small for a palette and for learned codes

LEFT, ABOVE, ABOVE_LEFT, ABOVE_RIGHT, PALETTE, LUMA, COLOR, ALPHA = range(8)
NOISE = 1984  # nothing is learned from blocks whose estimates add up to this
CHANNELS = {LUMA: 1, COLOR: 3, ALPHA: 4}

# Folded residuals by class: the first of the class, and the bits that tell the others.
CLASSES = [(u, 0) for u in range(5)]
for bits in range(1, 7):
    CLASSES += [((2 << bits) + 1, bits), ((3 << bits) + 1, bits)]
CLASS_OF = [max(number for number, (first, _) in enumerate(CLASSES) if u >= first) for u in range(256)]

# Contexts are tuples: tokens by shape and residuals beside; the luma of tokens LUMA, that of other tokens, and alpha by
# the class of the gradient; R - G and B - G by half that class and the bit width of the residual before.
TOKEN_CONTEXTS = [("token", shape, beside) for shape in range(8) for beside in range(3)]
PLAIN_CONTEXTS = [(name, steep) for name in ("luma alone", "luma", "alpha") for steep in range(8)]
COLOR_CONTEXTS = [(name, half, width) for name in ("red", "blue") for half in range(5) for width in range(8)]
SYMBOLS = {context: 8 if context[0] == "token" else 17 for context in TOKEN_CONTEXTS + PLAIN_CONTEXTS + COLOR_CONTEXTS}
TABLE_BITS = 4 * sum(SYMBOLS.values())

# Fixed weights of tokens by kind of shape and residuals beside, and half-lives of folded residuals: as in lcc_codes.cpp.
TOKEN_WEIGHTS = (((900, 60, 10, 10, 10, 20, 10, 1), (300, 80, 20, 30, 20, 40, 20, 1), (120, 60, 20, 30, 20, 120, 60, 4)),
                 ((60, 100, 10, 20, 20, 20, 10, 1), (50, 60, 10, 20, 20, 60, 40, 1), (30, 30, 10, 20, 10, 120, 100, 4)),
                 ((60, 60, 10, 20, 20, 30, 60, 1), (40, 40, 10, 20, 20, 50, 160, 2), (8, 8, 4, 6, 6, 60, 400, 8)))
KIND_OF_SHAPE = (0, 0, 1, 1, 0, 2, 2, 2)
HALF_LIVES = (1, 1, 2, 3, 4, 7, 12, 24)
HALF_LIVES_BY_HALF = (1, 1, 2, 4, 10)
HALF_LIVES_BY_WIDTH = (1, 1, 1, 2, 2, 3, 6, 12)


def fixed_weights(context):
    name, *by = context
    if name == "token":
        return TOKEN_WEIGHTS[KIND_OF_SHAPE[by[0]]][by[1]]
    if name in ("red", "blue"):
        half_life = -(-(HALF_LIVES_BY_HALF[by[0]] + HALF_LIVES_BY_WIDTH[by[1]]) // 2)
    else:
        half_life = HALF_LIVES[by[0]]
    return [2 ** (20 + rest) >> min(26, first // half_life) for first, rest in CLASSES]


FIXED = {context: huffman(fixed_weights(context)) for context in SYMBOLS}


def learned(counts):
    return {context: huffman([count + sum(own) // 1024 + 1 for count in own]) for context, own in counts.items()}


def total(lengths, counts):
    return sum(length * count for context, own in counts.items() for length, count in zip(lengths[context], own))


def neighbors(i):
    """Places of the pixels left, above, above left and above right of pixel i of a block."""
    y, x = divmod(i, 8)
    if y == 0:
        return (i - 1,) * 4
    return (i - 1 if x > 0 else i - 8, i - 8, i - 9 if x > 0 else i - 8, i - 7 if x < 7 else i - 8)


NEIGHBORS = [neighbors(i) if i else None for i in range(64)]


def wrapped(value):
    """A difference in 8 bits, -128 to 127."""
    return (value + 128) % 256 - 128


@functools.lru_cache(maxsize=1 << 16)
def channels(word):
    red, green, blue, alpha = word.to_bytes(4, "little")
    return green, wrapped(red - green), wrapped(blue - green), alpha


@functools.lru_cache(maxsize=1 << 16)
def gradients(left, above, corner):
    return [abs(a - c) + abs(b - c) for a, b, c in zip(channels(left), channels(above), channels(corner))]


@functools.lru_cache(maxsize=1 << 16)
def shape(left, above, corner, right):
    if left == above == corner:
        return 0 if right == above else 1
    if left == corner:
        return 2
    if above == corner:
        return 3
    if left == above:
        return 4
    busy = sum(gradients(left, above, corner)[:3])
    return 5 if busy <= 8 else 6 if busy <= 32 else 7


@functools.lru_cache(maxsize=1 << 16)
def residuals(own, left, above, corner):
    """Token, estimated bits, context and class of each channel, and the bits after the classes."""
    folded = []
    for now, a, b, c in zip(channels(own), channels(left), channels(above), channels(corner)):
        error = wrapped(now - sorted((a, b, a + b - c))[1])
        folded.append(2 * error if error >= 0 else -2 * error - 1)
    token = ALPHA if folded[3] else COLOR if folded[1] or folded[2] else LUMA
    steep = [0 if step == 0 else min(7, (step - 1).bit_length() + 1) for step in gradients(left, above, corner)]
    half = [(step + 1) // 2 for step in steep]
    widths = [u.bit_length() for u in folded]
    contexts = (("luma alone" if token == LUMA else "luma", steep[0]), ("red", half[1], min(7, widths[0])),
                ("blue", half[2], min(7, widths[1])), ("alpha", steep[3]))
    used = CHANNELS[token]
    estimate = sum(1 + width for width in widths[:used])
    classes = [CLASS_OF[u] for u in folded[:used]]
    return token, estimate, list(zip(contexts, classes)), sum(CLASSES[number][1] for number in classes)


class Surface:
    """What the frames of a surface keep for the next one."""

    def __init__(self, entries):
        self.entries, self.index_bits = entries, entries.bit_length() - 1
        self.slots, self.counts = [], None

    def block_bits(self, block, palette, lengths):
        """Bits of a block's payload if it is not raw. Counts its symbols."""
        solid = len(set(block)) == 1
        if solid and palette.get(block[0], 64) < 64:
            return 0
        bits = 1 if palette else 0
        bits += self.index_bits if block[0] in palette else 1 + (24 if block[0] >> 24 == 255 else 32)
        is_residual, found, estimates = [False] * 64, [], 0
        for i in range(1, 64):
            at_left, at_above, at_corner, at_right = NEIGHBORS[i]
            own, left, above, corner, right = block[i], block[at_left], block[at_above], block[at_corner], block[at_right]
            context = ("token", shape(left, above, corner, right), is_residual[at_left] + is_residual[at_above])
            if own in (left, above, corner, right):
                found.append((context, (left, above, corner, right).index(own)))
                continue
            token, estimate, classes, rests = residuals(own, left, above, corner)
            estimates += estimate
            if own in palette and estimate > self.index_bits + 2:
                found.append((context, PALETTE))
                bits += self.index_bits
                continue
            is_residual[i] = True
            found.append((context, token))
            found += classes
            bits += rests
        learns = not solid and estimates < NOISE
        for context, symbol in found:
            bits += lengths[context][symbol]
            self.counts[context][symbol] += learns
        return bits

    def frame(self, width, height, picture):
        """Payload bits of each block, and the bits of the tables."""
        ordered = dictionary(self.slots)
        has_palette = 2 * sum(count for count, _ in ordered) > 33 * self.entries
        palette = {color: index for index, (_, color) in enumerate(ordered)} if has_palette else {}
        lengths, table_bits = FIXED, 33 * self.entries if has_palette else 0
        if self.counts is not None:
            new = learned(self.counts)
            if total(FIXED, self.counts) > total(new, self.counts) + TABLE_BITS:
                lengths, table_bits = new, table_bits + TABLE_BITS
        self.counts = {context: [0] * symbols for context, symbols in SYMBOLS.items()}
        sizes = [min(2048, self.block_bits(block, palette, lengths)) for block in blocks_of(picture, width, height)]
        self.slots = collect(picture, width, height, self.entries)
        return sizes, table_bits


def corner_of(frame, width, height):
    pitch, _, picture = frame
    return width, height, [picture[y * pitch + x] for y in range(height) for x in range(width)]


def noise(seed, width, height, mask):
    dice = random.Random(seed)
    return width, height, [dice.getrandbits(32) & mask for _ in range(width * height)]


def tiles(seed):
    """Blocks of 96 colors that stay from frame to frame, and a third of noise between them."""
    dice, side = random.Random(seed), 96
    picture = []
    for y, x in itertools.product(range(side), repeat=2):
        block = y // 8 * 12 + x // 8
        picture.append(dice.getrandbits(32) & 0x0F0F0F | 0xFF000000 if block % 3 == 0 else 0xFF000000 + 0x10203 * block)
    return side, side, picture


def compare(command, name, frames, folder):
    """Writes the frames as raw files, and returns what differs."""
    files = []
    for number, (width, height, picture) in enumerate(frames):
        files.append(os.path.join(folder, f"{name}-{number}.rgba"))
        with open(files[-1], "wb") as file:
            file.write(b"".join(word.to_bytes(4, "little") for word in picture))
    got = {burst: measured(command, SCHEMES, files, ("--burst", str(burst), "--size", f"{width}x{height}"))
           for burst in BURSTS}
    faults = []
    for scheme in SCHEMES:
        surface = Surface(int(scheme.partition("fvc=")[2] or 64))
        for number, frame in enumerate(frames):
            sizes, table_bits = surface.frame(*frame)
            for burst in BURSTS:
                most = -(-2048 // burst)
                wanted = {"payload_bits": sum(sizes), "bursts": sum(-(-size // burst) for size in sizes),
                          "csb_bits": (64 + most).bit_length() * len(sizes), "palette_bits": table_bits}
                row = got[burst][scheme, number]
                faults += [f"{name} frame {number} {scheme} burst {burst}: {column} is {row[column]}, not {value}"
                           for column, value in wanted.items() if int(row[column]) != value]
    return faults


def main():
    command, golden, name = sys.argv[1:4]
    images = sorted(os.path.join(golden, name, file) for file in os.listdir(os.path.join(golden, name)))
    frames = [read_picture(image) for image in itertools.islice(images, int(sys.argv[4]) if sys.argv[4:] else None)]
    sets = {name: frames}
    for width, height in CORNERS:
        sets[f"{name}-{width}x{height}"] = [corner_of(frame, width, height) for frame in frames]
    sets["noise"] = [noise(seed, 75, 50, mask) for seed, mask in enumerate((0xFFFFFFFF, 0xFF0F0F0F, 0xFF070707))]
    sets["tiles"] = [tiles(seed) for seed in range(3)]
    with tempfile.TemporaryDirectory() as folder:
        faults = [fault for title, pictures in sets.items() for fault in compare(command, title, pictures, folder)]
    print("\n".join(faults) if faults else f"{name}: {len(frames)} frames, their corners, noise and tiles agree")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
