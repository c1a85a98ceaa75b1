#!/usr/bin/env python3
"""Stills, animations, movies and pipes: the pixels that `tilepress frames` takes of them, or the line that refuses.

Usage: cli_images_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import glob
import os
import struct
import subprocess
import threading
import zlib

from cli_case import COMMAND, CliCase, main, read_json
from picture_files import read_png

FAILED = 1
MOVIES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "movies")
CLEAR = bytes(4)


def chunk(name, content):
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def scanlines(pixels, width, height, pixel_bytes=4):
    pitch = width * pixel_bytes
    return zlib.compress(b"".join(b"\0" + pixels[y * pitch:(y + 1) * pitch] for y in range(height)))


def png(width, height, pixels, bits=8, color_type=6, extra=(), interlace=0):
    header = struct.pack(">IIBBBBB", width, height, bits, color_type, 0, 0, interlace)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + b"".join(chunk(*each) for each in extra) +
            chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def apng(width, height, parts):
    """parts: (x, y, w, h, dispose, blend, RGBA bytes); the first one covers the canvas."""
    out = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
    out += chunk(b"acTL", struct.pack(">II", len(parts), 0))
    number = 0
    for i, (x, y, w, h, dispose, blend, pixels) in enumerate(parts):
        out += chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, w, h, x, y, 0, 100, dispose, blend))
        number += 1
        body = scanlines(pixels, w, h)
        out += chunk(b"IDAT", body) if i == 0 else chunk(b"fdAT", struct.pack(">I", number) + body)
        number += i > 0
    return out + chunk(b"IEND", b"")


def gif(width, height, palette, parts):
    """palette: 4 RGB colours. parts: (x, y, w, h, disposal, transparent index or None, indices)."""
    out = b"GIF89a" + struct.pack("<HHBBB", width, height, 0x81, 1, 0) + bytes(sum(palette, ()))
    for x, y, w, h, disposal, transparent, indices in parts:
        out += b"!\xf9\x04" + struct.pack("<BHBB", disposal << 2 | (transparent is not None), 0, transparent or 0, 0)
        out += b"," + struct.pack("<HHHHB", x, y, w, h, 0) + b"\x02"
        # Codes of 3 bits; a clear code before every second pixel keeps them that short.
        codes = []
        for i, index in enumerate(indices):
            codes += [4] * (i % 2 == 0) + [index]
        value = sum(code << 3 * i for i, code in enumerate(codes + [5]))
        data = value.to_bytes((3 * (len(codes) + 1) + 7) // 8, "little")
        for at in range(0, len(data), 255):
            out += bytes([len(data[at:at + 255])]) + data[at:at + 255]
        out += b"\0"
    return out + b";"


def bmp(width, height, bits, masks, rows):
    """A BMP with channel masks, rows from the top."""
    data = b"".join(row + bytes(-len(row) % 4) for row in reversed(rows))
    header = struct.pack("<IiiHHIIiiII", 56, width, height, 1, bits, 3 if masks else 0, len(data), 0, 0, 0, 0)
    header += struct.pack("<4I", *(masks or (0, 0, 0, 0)))
    return b"BM" + struct.pack("<IHHI", 14 + len(header) + len(data), 0, 0, 14 + len(header)) + header + data


def dds(width, height, bits, masks, data):
    return (b"DDS " + struct.pack("<7I44x", 124, 0x100F, height, width, width * bits // 8, 0, 0) +
            struct.pack("<II4s5I", 32, 0x40 | (0x01 if masks[3] else 0), bytes(4), bits, *masks) +
            struct.pack("<5I", 0x1000, 0, 0, 0, 0) + data)


def tga(width, height, bits, data, descriptor):
    return struct.pack("<BBB5xHHHHBB", 0, 0, 2, 0, 0, width, height, bits, descriptor) + data


class Images(CliCase):
    def frames_of(self, *words, **further):
        """The captured frames as RGBA bytes, in order."""
        done = self.run_command("frames", "-q", "-o", "out", "--force", "-s", "red", "--dump-frames", "every:1", *words, **further)
        self.assertEqual(done.returncode, 0, done.stderr)
        frames = []
        for path in sorted(glob.glob(self.path("out/frames/*.png"))):
            width, _, channels, samples = read_png(path)
            if channels == 3:
                samples = b"".join(samples[i:i + 3] + b"\xff" for i in range(0, len(samples), 3))
            frames.append(samples)
            os.unlink(path)
        return frames

    def refuse(self, name, text):
        done = self.run_command("frames", "-q", "-o", "refused", "--force", "-s", "red", name)
        self.assertEqual(done.returncode, FAILED, (name, done.stderr))
        self.assertRegex(done.stderr.decode(), rf"\Atilepress: {name}: [^\n]*{text}[^\n]*\n\Z")

    def expect_reds(self, frames, step=8):
        """30 frames, frame i red 8·i, as near as Y'CbCr keeps it."""
        self.assertEqual(len(frames), 30)
        for i, frame in enumerate(frames):
            self.assertLessEqual(abs(frame[0] - step * i), 4, f"frame {i}")


class Movies(Images):
    def test_frames_of_a_variable_rate_come_once_each_and_in_order(self):
        self.expect_reds(self.frames_of(os.path.join(MOVIES, "variable_rate.mp4")))

    def test_a_program_stream_ends_with_its_last_frame(self):
        self.expect_reds(self.frames_of(os.path.join(MOVIES, "program_stream.mpg")))

    def test_rgb_samples_of_a_movie_and_their_alpha_are_exact(self):
        frames = self.frames_of(os.path.join(MOVIES, "rgba.mkv"))
        self.assertEqual(frames, [bytes([8 * i, 0, 0, 255]) * 256 for i in range(30)])

    def test_frames_can_be_chosen_and_a_choice_of_none_is_said(self):
        self.assertEqual(len(self.frames_of("--frames", "3-7", os.path.join(MOVIES, "rgba.mkv"))), 5)
        done = self.run_command("frames", "-q", "-o", "none", "--frames", "90", os.path.join(MOVIES, "rgba.mkv"))
        self.assertEqual((done.returncode, done.stderr.decode()),
                         (3, "tilepress: --frames and --every select none of the frames 0..29\n"))

    def test_a_movie_that_is_cut_off_is_refused(self):
        for name in ("variable_rate.mp4", "rgba.mkv"):
            with open(os.path.join(MOVIES, name), "rb") as file:
                content = file.read()
            self.write("torn-" + name, content[:len(content) * 3 // 5])
            self.refuse("torn-" + name, "")

    def test_a_movie_and_a_still_follow_each_other(self):
        self.write("green.png", png(16, 16, scanlines(bytes([0, 255, 0, 255]) * 256, 16, 16)))
        movie = os.path.join(MOVIES, "rgba.mkv")
        frames = self.frames_of("green.png", movie, "green.png", movie)
        self.assertEqual([frame[:2] for frame in frames], ([b"\0\xff"] + [bytes([8 * i, 0]) for i in range(30)]) * 2)


class Animations(Images):
    RED, GREEN, BLUE = bytes([255, 0, 0, 255]), bytes([0, 255, 0, 255]), bytes([0, 0, 255, 255])

    @staticmethod
    def canvas(*rows):
        colors = {"r": Animations.RED, "g": Animations.GREEN, "b": Animations.BLUE, ".": CLEAR}
        return b"".join(colors[letter] for row in rows for letter in row)

    def test_a_gif_is_composed_with_each_disposal(self):
        palette = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (9, 9, 9)]
        self.write("a.gif", gif(4, 2, palette, [
            (0, 0, 4, 2, 1, None, [0] * 8),           # red, kept
            (0, 0, 2, 2, 3, None, [1] * 4),           # green, the red comes back
            (2, 0, 2, 1, 2, None, [2, 2]),            # blue, cleared after it
            (0, 1, 4, 1, 0, 3, [3, 1, 3, 1]),         # two greens
            (3, 1, 1, 1, 1, 3, [3])]))                # nothing
        self.assertEqual(self.frames_of("a.gif"), [
            self.canvas("rrrr", "rrrr"), self.canvas("ggrr", "ggrr"), self.canvas("rrbb", "rrrr"),
            self.canvas("rr..", "rgrg"), self.canvas("rr..", "rgrg")])

    def test_an_apng_is_composed_with_each_disposal_and_blending(self):
        half = bytes([0, 0, 255, 0])
        self.write("a.png", apng(4, 2, [
            (0, 0, 4, 2, 0, 0, self.RED * 8),
            (0, 0, 2, 2, 2, 0, self.GREEN * 4),       # the red comes back
            (2, 0, 2, 1, 1, 0, self.BLUE * 2),        # cleared after it
            (0, 1, 4, 1, 0, 1, half + self.GREEN + half + self.GREEN),   # clear pixels leave what is below
            (0, 0, 1, 1, 0, 0, half)]))               # a clear pixel replaces it
        frames = self.frames_of("a.png")
        self.assertEqual(frames[:4], [self.canvas("rrrr", "rrrr"), self.canvas("ggrr", "ggrr"), self.canvas("rrbb", "rrrr"),
                                      self.canvas("rr..", "rgrg")])
        self.assertEqual([frame[3::4] for frame in frames[4:]], [self.canvas(".r..", "rgrg")[3::4]])

    def test_an_animated_webp_gives_all_frames_with_alpha(self):
        frames = self.frames_of(os.path.join(MOVIES, "three.webp"))
        self.assertEqual(frames, [bytes([200, 100, 50, 128]) * 256, bytes([0, 0, 255, 255]) * 256, bytes([0, 255, 0, 255]) * 256])

    def test_cut_animations_are_refused(self):
        palette = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (9, 9, 9)]
        whole = gif(4, 2, palette, [(0, 0, 4, 2, 1, None, [0] * 8), (0, 0, 4, 2, 1, None, [1] * 8)])
        self.write("a.gif", whole + b"further bytes")
        self.assertEqual(len(self.frames_of("a.gif")), 2)
        for kept in range(6, len(whole), 13):
            self.write("torn.gif", whole[:kept])
            self.refuse("torn.gif", "")
        animation = apng(4, 2, [(0, 0, 4, 2, 0, 0, self.RED * 8), (0, 0, 4, 2, 0, 0, self.GREEN * 8)])
        for kept in range(60, len(animation) - 12, 25):
            self.write("torn.png", animation[:kept])
            self.refuse("torn.png", "")
        with open(os.path.join(MOVIES, "three.webp"), "rb") as file:
            webp = file.read()
        self.write("torn.webp", webp[:-4])
        self.refuse("torn.webp", "cut off")


class Stills(Images):
    def test_a_webp_keeps_the_colour_below_its_alpha(self):
        self.assertEqual(self.frames_of(os.path.join(MOVIES, "half_clear.webp")), [bytes([200, 100, 50, 128]) * 256])

    def test_png_kinds_give_their_samples(self):
        alpha = [(b"PLTE", bytes([1, 2, 3, 40, 50, 60])), (b"tRNS", bytes([7]))]
        self.write("palette.png", png(8, 1, zlib.compress(b"\0\x55"), 1, 3, alpha))
        self.assertEqual(self.frames_of("palette.png"), [bytes([1, 2, 3, 7, 40, 50, 60, 255]) * 4])
        self.write("gray.png", png(4, 1, zlib.compress(b"\0\x1b"), 2, 0, [(b"gAMA", struct.pack(">I", 22222))]))
        self.assertEqual(self.frames_of("gray.png"), [b"".join(bytes([v, v, v, 255]) for v in (0, 85, 170, 255))])
        # Adam7 of one pixel a pass: an image of 1 x 1 has its pixel in the first pass.
        self.write("laced.png", png(1, 1, scanlines(bytes([1, 2, 3, 4]), 1, 1), interlace=1))
        self.assertEqual(self.frames_of("laced.png"), [bytes([1, 2, 3, 4])])

    def test_a_png_is_cut_off_only_where_data_is_missing(self):
        whole = png(4, 4, scanlines(bytes(range(64)), 4, 4))
        self.write("a.png", whole + bytes(8000))
        self.assertEqual(self.frames_of("a.png"), [bytes(range(64))])
        for kept in range(9, len(whole), 13):
            self.write("torn.png", whole[:kept])
            self.refuse("torn.png", "")

    def test_bmp_pixels_are_as_stored_and_16_bits_are_refused(self):
        pixels = [bytes([30, 20, 10, 128, 60, 50, 40, 0])] * 2
        self.write("a.bmp", bmp(2, 2, 32, (0xFF0000, 0xFF00, 0xFF, 0xFF000000), pixels))
        self.assertEqual(self.frames_of("a.bmp"), [bytes([10, 20, 30, 128, 40, 50, 60, 0]) * 2])
        self.write("565.bmp", bmp(2, 2, 16, (0xF800, 0x07E0, 0x001F, 0), [bytes(4)] * 2))
        self.refuse("565.bmp", "5-6-5 bits")
        self.write("555.bmp", bmp(2, 2, 16, (0x7C00, 0x03E0, 0x001F, 0), [bytes(4)] * 2))
        self.refuse("555.bmp", "5-5-5 bits")
        self.write("1555.bmp", bmp(2, 2, 16, (0x7C00, 0x03E0, 0x001F, 0x8000), [bytes(4)] * 2))
        self.refuse("1555.bmp", "")

    def test_tga_and_dds_of_16_bits_are_refused_and_of_32_as_stored(self):
        pixels = bytes([30, 20, 10, 128, 60, 50, 40, 0])
        self.write("a.tga", tga(2, 1, 32, pixels, 0x28))
        self.write("a.dds", dds(2, 1, 32, (0xFF0000, 0xFF00, 0xFF, 0xFF000000), pixels))
        for name in ("a.tga", "a.dds"):
            self.assertEqual(self.frames_of(name), [bytes([10, 20, 30, 128, 40, 50, 60, 0])], name)
        self.write("16.tga", tga(2, 1, 16, bytes(4), 0x21))
        self.refuse("16.tga", "bits")
        self.write("565.dds", dds(2, 1, 16, (0xF800, 0x07E0, 0x001F, 0), bytes(4)))
        self.refuse("565.dds", "5-6-5 bits")
        self.write("torn.tga", tga(2, 1, 32, pixels[:5], 0x28))
        self.refuse("torn.tga", "")

    def test_content_counts_not_the_name(self):
        content = png(2, 1, scanlines(bytes(range(8)), 2, 1))
        for name in ("a.jpg", "a.null", "a.mp4", "a"):
            self.write(name, content)
            self.assertEqual(self.frames_of(name), [bytes(range(8))], name)
        self.write("text.null", b"no image\n")
        self.refuse("text.null", "not an image")

    def test_sizes_that_no_memory_holds_are_refused(self):
        self.write("large.png", png(65535, 65535, scanlines(bytes(4), 1, 1)))
        self.refuse("large.png", "")
        self.write("large.gif", gif(65535, 65535, [(0, 0, 0)] * 4, [(0, 0, 1, 1, 0, None, [0])]))
        self.refuse("large.gif", "more than 268435456 pixels")


class Pipes(Images):
    def through_fifo(self, content, *words):
        os.mkfifo(self.path("fifo"))
        writer = threading.Thread(target=lambda: self.write("fifo", content))
        writer.start()
        try:
            return self.frames_of(*words, "fifo")
        finally:
            writer.join()
            os.unlink(self.path("fifo"))

    def test_a_fifo_of_raw_frames_is_read_once(self):
        self.assertEqual(self.through_fifo(bytes(range(64)) * 2, "--size", "4x4"), [bytes(range(64))] * 2)

    def test_a_fifo_may_hold_an_image_or_a_movie(self):
        content = png(4, 4, scanlines(bytes(range(64)), 4, 4))
        self.assertEqual(self.through_fifo(content), [bytes(range(64))])
        self.assertEqual(self.through_fifo(content, "--size", "4x4"), [bytes(range(64))])
        with open(os.path.join(MOVIES, "rgba.mkv"), "rb") as file:
            self.assertEqual(len(self.through_fifo(file.read())), 30)

    def test_a_process_substitution_is_an_image(self):
        self.write("a.png", png(4, 4, scanlines(bytes(range(64)), 4, 4)))
        done = subprocess.run(["bash", "-c", f"{COMMAND} frames -q -o out -s red --dump-frames every:1 <(cat a.png) <(cat a.png)"],
                              cwd=self.folder, capture_output=True, timeout=300, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        for frame in (0, 1):
            self.assertEqual(read_png(self.path(f"out/frames/0-{frame:06}.png"))[3], bytes(range(64)))

    def test_a_pipe_named_twice_or_a_missing_file_is_said_before_anything_is_read(self):
        os.mkfifo(self.path("fifo"))
        self.expect(FAILED, "fifo: is a pipe that is named twice; it can be read once", "frames", "-o", "out", "--size", "4x4",
                    "fifo", "fifo")
        self.expect(FAILED, "gone.png: No such file or directory", "frames", "-o", "out", "--size", "4x4", "fifo", "gone.png")
        self.assert_absent("out")

    def test_a_pipe_that_holds_no_image_is_not_read_to_its_end(self):
        done = subprocess.run(["bash", "-c", f"{COMMAND} frames -o out <(yes)"], cwd=self.folder, capture_output=True, timeout=300,
                              check=False)
        self.assertEqual(done.returncode, FAILED)
        self.assertIn(b": not an image; raw frames need --size WxH too\n", done.stderr)


if __name__ == "__main__":
    main()
