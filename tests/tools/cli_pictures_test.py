#!/usr/bin/env python3
"""--heatmaps and --dump-frames through `run` and `replay`: bits add up to the rows, pixels are the program's.

Usage: cli_pictures_test.py TILEPRESS GOLDEN_FOLDER PICTURE_PROGRAM TRACES_FOLDER [TEST...]"""
import glob
import os
import sys

PROGRAM, TRACES = os.path.abspath(sys.argv[3]), os.path.abspath(sys.argv[4])
del sys.argv[3:5]

from cli_case import CliCase, XServer, main, read_rows  # noqa: E402  (it reads sys.argv)
from picture_files import read_pgm, read_png  # noqa: E402

SCHEMES = ("vdcp", "ras:ycocg=1")
ASK = [word for scheme in SCHEMES for word in ("-s", scheme)]


def known_picture(frame, width, height):
    """R, G, B rows of the picture that known_picture.h has the sample programs draw."""
    boxes = [(0, 0, width, height, (12, 200, 77)), (0, 0, 5, 3, (255, 0, 1)), (width - 4, 0, 4, 9, (3, 90, 255)),
             (7, height - 6, 11, 6, (250, 251, 2)), (16, 16, 1, 1, (1, 2, 3)), (9 + frame * 3 % 16, 4, 13, 8, (128, 64, 32))]
    out = bytearray(width * height * 3)
    for number, (left, top, box_width, box_height, color) in enumerate(boxes):
        if number not in (1, 4):
            color = tuple(value + frame * (3 + c) & 255 for c, value in enumerate(color))
        for y in range(top, top + box_height):
            at = (y * width + left) * 3
            out[at:at + box_width * 3] = bytes(color) * box_width
    return bytes(out)


class Pictures(CliCase):
    def check_bits(self, run, every):
        """Every heat map's samples add up to its row's payload; no frame is missing, none is too much."""
        rows = {(int(row["frame"]), row["scheme"]): row for row in read_rows(os.path.join(run, "schemes.csv"))}
        self.assertGreater(len(rows), 0)
        seen = set()
        for path in glob.glob(os.path.join(glob.escape(run), "heatmaps", "*.pgm")):
            scheme, width, height, bits = read_pgm(path)
            surface, frame = os.path.basename(path).split("-")[:2]
            self.assertEqual(surface, "0")
            row = rows[int(frame), scheme]
            self.assertEqual(width * height, int(row["blocks"]))
            self.assertEqual(sum(bits), int(row["payload_bits"]), path)
            self.assertEqual(sum((b + 127) // 128 for b in bits), int(row["bursts"]), path)
            seen.add((int(frame), scheme))
        self.assertEqual(seen, {key for key in rows if key[0] % every == 0})

    def check_pixels(self, run, every):
        """Every dumped frame has the size and the colours of its row."""
        count = 0
        for row in read_rows(os.path.join(run, "frames.csv")):
            path = os.path.join(run, "frames", f"0-{int(row['frame']):06}.png")
            self.assertEqual(os.path.exists(path), int(row["frame"]) % every == 0, path)
            if not os.path.exists(path):
                continue
            width, height, channels, samples = read_png(path)
            self.assertEqual((width, height), (int(row["width"]), int(row["height"])))
            self.assertEqual(channels, 4 if row["format"] == "RGBA8" else 3)
            colors = {samples[i:i + channels] for i in range(0, len(samples), channels)}
            self.assertEqual(len(colors), int(row["unique_colors"]), path)
            count += 1
        self.assertGreater(count, 0)
        self.assertEqual(glob.glob(os.path.join(glob.escape(run), "frames", "*.rgba")), [])

    def test_of_a_running_program(self):
        with XServer() as server:
            done = self.run_command("run", "-q", "-o", "out", *ASK, "--heatmaps", "every:3", "--dump-frames", "every:2", "--", PROGRAM,
                                    "glx", "9", "100", "60", env={"DISPLAY": server.display})
        self.assertEqual(done.returncode, 0, done.stderr)
        (run,) = glob.glob(self.path("out/glfw_picture-*"))
        self.check_bits(run, 3)
        self.check_pixels(run, 2)
        # Frame 0 is GLFW's own, of the window it makes; the program's follow.
        for frame in (2, 8):
            width, height, channels, samples = read_png(os.path.join(run, f"frames/0-{frame:06}.png"))
            self.assertEqual((width, height, channels), (100, 60, 3))
            self.assertEqual(samples, known_picture(frame - 1, 100, 60), f"frame {frame}")

    def test_of_a_replayed_trace(self):
        trace = os.path.join(TRACES, "glmark2-desktop-egl.trace")
        done = self.run_command("replay", "-q", "-o", "out", *ASK, "--frames", "0-5", "--heatmaps", "every:2", "--dump-frames", "every:5", trace)
        self.assertEqual(done.returncode, 0, done.stderr)
        run = self.path("out/glmark2-desktop-egl")
        self.check_bits(run, 2)
        self.check_pixels(run, 5)


if __name__ == "__main__":
    main()
