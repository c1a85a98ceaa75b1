#!/usr/bin/env python3
"""What `tilepress vectors` writes, against a model of the rules in plain Python, and what it refuses.

Usage: cli_vectors_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import os
import random
import re

from cli_case import CliCase, golden, main, read_rows

WIDTH, HEIGHT, TILE = 43, 21, 16  # tiles and blocks are cut off at both borders
SCAN = [(x, y) for sy in range(4) for sx in range(4) for y in (2 * sy, 2 * sy + 1) for x in (2 * sx, 2 * sx + 1)]


def drawing(frame):
    """Few colours, some of them rare, and a little noise: hits, evictions and raw sub-blocks."""
    source = random.Random(frame)
    return [[source.choice([0xFF0000FF, 0x80FF2010, 0x01020304 + source.randrange(12) * (x // 9 + 1)]) for x in range(WIDTH)]
            for _ in range(HEIGHT)]


def blocks_in_order():
    columns, rows, step = -(-WIDTH // 8), -(-HEIGHT // 8), TILE // 8
    return [(bx, by) for ty in range(0, rows, step) for tx in range(0, columns, step)
            for by in range(ty, min(ty + step, rows)) for bx in range(tx, min(tx + step, columns))]


def scan(picture, bx, by):
    """The pixels of a block, and whether each lies inside."""
    places = [(8 * bx + x, 8 * by + y) for x, y in SCAN]
    return ([picture[min(y, HEIGHT - 1)][min(x, WIDTH - 1)] for x, y in places],
            [x < WIDTH and y < HEIGHT for x, y in places])


class Fvc:
    """Section 3 of the rules."""

    def __init__(self, entries, policy, ways, sample):
        self.entries, self.policy, self.ways, self.sample = entries, policy, ways or entries, sample
        self.slots = [None] * entries  # [colour, count, last]
        self.reset()

    def reset(self):
        self.slots = [None] * self.entries
        self.seen, self.samples, self.random = 0, 0, 0x9E3779B9

    def see(self, color):
        self.seen += 1
        if (self.seen - 1) % self.sample != 0:
            return
        self.samples += 1
        channels = color ^ color >> 8 ^ color >> 16 ^ color >> 24
        first = (channels & 255) % (self.entries // self.ways) * self.ways
        own = range(first, first + self.ways)
        for slot in own:
            if self.slots[slot] and self.slots[slot][0] == color:
                self.slots[slot][1:] = [self.slots[slot][1] + 1, self.samples]
                return
        empty = [slot for slot in own if self.slots[slot] is None]
        self.slots[empty[0] if empty else self.victim(own)] = [color, 1, self.samples]

    def victim(self, own):
        by_count = sorted(own, key=lambda slot: (self.slots[slot][1], slot))
        if self.policy == "2lfc":
            return by_count[min(1, len(by_count) - 1)]
        if self.policy == "lru":
            return min(own, key=lambda slot: self.slots[slot][2])
        if self.policy == "random":
            for shift in (13, -17, 5):
                self.random ^= (self.random << shift if shift > 0 else self.random >> -shift) & 0xFFFFFFFF
            return own[self.random % len(own)]
        return by_count[0]

    def lines(self):
        return [f"1{slot[0]:08x}{slot[1]:08x}" if slot else "0" * 17 for slot in self.slots]

    def last_lines(self):
        return [f"{slot[2] if slot else 0:08x}" for slot in self.slots]

    def ccd(self):
        held = [(-slot[1], at, slot[0]) for at, slot in enumerate(self.slots) if slot]
        return [color for _, _, color in sorted(held)]


def vdcp_block(pixels, ccd):
    """CSB and payload of a block with 16 entries, as text of 0 and 1."""
    csb = payload = ""
    for at in range(0, 64, 4):
        four = pixels[at:at + 4]
        if all(pixel in ccd for pixel in four):
            indices = [ccd.index(pixel) for pixel in four]
            width = max(indices).bit_length()
            payload += "".join(f"{index:0{width}b}" for index in indices) if width else ""
        else:
            width = 7
            payload += "".join(f"{pixel:032b}" for pixel in four)
        csb += f"{width:03b}"
    return csb, payload


def lines_of(path):
    with open(path, encoding="ascii") as file:
        return file.read().splitlines()


def hex_of(bits, total):
    return f"{int(bits.ljust(total, '0'), 2):0{total // 4}x}"


class VectorsCase(CliCase):
    def setUp(self):
        super().setUp()
        self.pictures = [drawing(frame) for frame in range(4)]
        self.images = [self.write(f"{frame}.rgba", b"".join(pixel.to_bytes(4, "little") for row in picture for pixel in row))
                       for frame, picture in enumerate(self.pictures)]

    def vectors(self, folder, *words):
        done = self.run_command("vectors", "--size", f"{WIDTH}x{HEIGHT}", "--tile", str(TILE), "-o", folder, *words, *self.images)
        self.assertEqual(done.stderr.decode().count("\n"), 1, done.stderr)
        self.assertEqual(done.returncode, 0)

    def lines(self, folder, frame, name):
        return lines_of(self.path(f"{folder}/frame-{frame:06}/{name}.hex"))

    def parameters(self, folder, frame):
        with open(self.path(f"{folder}/frame-{frame:06}/frame.vh"), encoding="ascii") as file:
            return dict(re.findall(r"^localparam .*?(\w+) *= (?:32'[dh])?(\w+);", file.read(), re.M))


class Files(VectorsCase):
    def test_hold_what_the_rules_say(self):
        for policy, ways, sample, period in (("lfc", 0, 1, 1), ("2lfc", 4, 1, 2), ("lru", 2, 3, 1), ("random", 8, 2, 1)):
            with self.subTest(policy=policy):
                spec = f"vdcp:fvc=16,policy={policy},ways={ways or 'full'},sample={sample},period={period}"
                self.vectors(policy, "-s", spec)
                self.check(policy, Fvc(16, policy, ways, sample), period)

    def check(self, folder, fvc, period):
        ccd, collecting = [], False
        for frame, picture in enumerate(self.pictures):
            def expect(name, expected, frame=frame):
                self.assertEqual(self.lines(folder, frame, name), expected, f"frame {frame}, {name}")
            expect("fvc_before_frame", fvc.lines())
            if collecting:
                ccd = fvc.ccd()
            collecting = frame % period == 0
            if collecting:
                fvc.reset()
            expect("ccd", [f"1{color:08x}" for color in ccd] + ["0" * 9] * (16 - len(ccd)))
            expect("fvc_before_blocks", fvc.lines())
            places = blocks_in_order()
            scans = [scan(picture, bx, by) for bx, by in places]
            for pixels, inside in scans if collecting else []:
                for pixel, counts in zip(pixels, inside):
                    if counts:
                        fvc.see(pixel)
            for name in ("fvc_after_blocks", "fvc_after_frame"):
                expect(name, fvc.lines())
            if fvc.policy == "lru":
                expect("fvc_after_blocks_last", fvc.last_lines())
            expect("places", [f"{by:04x}{bx:04x}" for bx, by in places])
            expect("pixels", [f"{pixel:08x}" for pixels, _ in scans for pixel in pixels])
            expect("mask", [hex_of("".join("01"[flag] for flag in inside), 64) for _, inside in scans])
            coded = [vdcp_block(pixels, ccd) for pixels, _ in scans]
            expect("csb", [hex_of(csb, 48) for csb, _ in coded])
            expect("payload", [hex_of(payload, 2048) for _, payload in coded])
            expect("payload_bits", [f"{len(payload):04x}" for _, payload in coded])
            parameters = self.parameters(folder, frame)
            self.assertEqual(int(parameters["SAMPLES_AFTER_BLOCKS"]), fvc.samples)
            self.assertEqual(int(parameters["RANDOM_AFTER_BLOCKS"], 16), fvc.random)
            self.assertEqual((parameters["BLOCKS"], parameters["CCD_COLORS"]), (str(len(places)), str(len(ccd))))

    def test_of_a_part_are_the_lines_of_the_whole_and_the_fvc_goes_through_it(self):
        self.vectors("all")
        self.vectors("part", "--write", "2-3", "--first", "5", "--blocks", "4")
        self.assertEqual(sorted(os.listdir(self.path("part"))), ["README.md", "frame-000002", "frame-000003"])
        for frame in (2, 3):
            for name in ("places", "mask", "csb", "payload", "payload_bits"):
                self.assertEqual(self.lines("part", frame, name), self.lines("all", frame, name)[5:9])
            self.assertEqual(self.lines("part", frame, "pixels"), self.lines("all", frame, "pixels")[5 * 64:9 * 64])
            for name in ("ccd", "tables", "fvc_before_frame", "fvc_after_frame"):
                self.assertEqual(self.lines("part", frame, name), self.lines("all", frame, name))
            fvc = Fvc(64, "lfc", 0, 1)
            for number, (bx, by) in enumerate(blocks_in_order()[:9]):
                if number == 5:
                    self.assertEqual(self.lines("part", frame, "fvc_before_blocks"), fvc.lines())
                for pixel, inside in zip(*scan(self.pictures[frame], bx, by)):
                    if inside:
                        fvc.see(pixel)
            self.assertEqual(self.lines("part", frame, "fvc_after_blocks"), fvc.lines())

    def test_of_other_schemes_have_the_sizes_that_frames_counts(self):
        schemes = ["hdcp", "huffdcp", "ras", "red", "bdi", "lcc", "dcp:coverage=1"]
        self.assertEqual(self.run_command("frames", "-q", "--size", f"{WIDTH}x{HEIGHT}", "--tile", str(TILE), "-o", "run",
                                          *(word for scheme in schemes for word in ("-s", scheme)), *self.images).returncode, 0)
        rows = {(row["scheme"], row["frame"]): row for row in read_rows(self.path("run/schemes.csv"))}
        for number, scheme in enumerate(schemes):
            folder = f"of-{number}"
            self.vectors(folder, "-s", scheme, "--write", "0,2")
            for frame in (0, 2):
                row = rows[(scheme, str(frame))]
                bits = [int(line, 16) for line in self.lines(folder, frame, "payload_bits")]
                self.assertEqual((sum(bits), len(bits)), (int(row["payload_bits"]), int(row["blocks"])), scheme)
                for count, line in zip(bits, self.lines(folder, frame, "payload")):
                    self.assertEqual(int(line, 16) & ((1 << 2048 - count) - 1), 0)
                parameters = self.parameters(folder, frame)
                self.assertEqual(int(parameters["CSB_BITS"]) * len(bits), int(row["csb_bits"]))
                self.assertEqual(int(parameters["TABLE_BITS"]), int(row["palette_bits"]))
                names = set(os.listdir(self.path(f"{folder}/frame-{frame:06}")))
                self.assertEqual("csb.hex" in names, row["csb_bits"] != "0")
                self.assertEqual("tables.hex" in names, row["palette_bits"] != "0")
                self.assertEqual("ccd.hex" in names, scheme not in ("ras", "red", "bdi"))

    def test_of_16_bit_pixels_have_four_digits_a_pixel(self):
        self.write("panel.rgb565", bytes(range(128)))
        done = self.run_command("vectors", "-q", "--format", "rgb565", "--size", "8x8", "panel.rgb565", "panel.rgb565", "-o", "out")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        words = [f"{2 * at + 1:02x}{2 * at:02x}" for at in range(64)]
        self.assertEqual(self.lines("out", 1, "pixels"), [words[8 * y + x] for x, y in SCAN])
        self.assertEqual(len(self.lines("out", 1, "payload")[0]), 256)


class Refusals(VectorsCase):
    def refuse(self, status, line, *words):
        self.expect(status, line, "vectors", *words)
        self.assertFalse(os.path.exists(self.path("out")))

    def test_are_one_line(self):
        image = golden("odd", 0)
        self.refuse(2, "--scheme te: its blocks cannot be restored without the frame before; give another scheme", "-s", "te",
                    image, "-o", "out")
        self.refuse(2, "--scheme: vectors are of one scheme; give one -s", "-s", "vdcp", "-s", "ras", image, "-o", "out")
        self.refuse(2, "--blocks: must be at least 1", "--blocks", "0", image, "-o", "out")
        self.refuse(2, "--format: raw frames need --size WxH", "--format", "rgb565", image, "-o", "out")
        self.refuse(1, "--first 1176: a frame of 333x217 has 1176 blocks, numbered from 0", "--first", "1176", image, "-o", "out")
        self.refuse(1, "absent.png: No such file or directory", "absent.png", "-o", "out")
        os.mkdir(self.path("old"))
        self.write("old/file", b"")
        self.refuse(1, "old: the folder is not empty; name another one with -o", image, "-o", "old")
        self.refuse(1, "0.rgba: not a folder; name another one with -o", image, "-o", "0.rgba")

    def test_say_that_no_frame_is_left(self):
        self.refuse(3, "no frame to write: --frames, --every and --write leave none", "--write", "7", golden("odd", 0), "-o", "out")

    def test_of_a_torn_image_leave_nothing(self):
        with open(golden("odd", 1), "rb") as file:
            self.write("torn.png", file.read()[:9000])
        done = self.run_command("vectors", golden("odd", 0), "torn.png", "-o", "out")
        self.assertRegex(done.stderr.decode(), r"\Atilepress: torn\.png: .+\n\Z")
        self.assertEqual(done.returncode, 1)
        self.assertFalse(os.path.exists(self.path("out")))


if __name__ == "__main__":
    main()
