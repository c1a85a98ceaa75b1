#!/usr/bin/env python3
"""tilepress, its help, `schemes` and `frames` from the command line: rows, exact error lines, exit statuses.

Usage: cli_frames_test.py TILEPRESS GOLDEN_FOLDER [TEST...]"""
import base64
import json
import os
import struct
import zlib

from cli_case import CliCase, GOLDEN, golden, main, read_json, read_rows

USAGE, FAILED, NOTHING = 2, 1, 3
# So that the leak sanitizer sees whose leak it is.
WHOLE_STACKS = {"ASAN_OPTIONS": "fast_unwind_on_malloc=0"}


# 8 x 8 gray pixels; 1 x 1 pixel.
JPEG = base64.b64decode(
    "/9j/4AAQSkZJRgABAQAAAQABAAD/4QAWRXhpZgAASUkqAAgAAAAAAAAAAAD/2wBDAAEBAQEBAQEBAQEBAQEBAQIBAQEBAQIBAQECAgICAgICAg"
    "IDAwQDAwMDAwICAwQDAwQEBAQEAgMFBQQEBQQEBAT/wAALCAAIAAgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAA"
    "AgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVF"
    "VWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo"
    "6erx8vP09fb3+Pn6/9oACAEBAAA/APxnr//Z")
GIF = base64.b64decode("R0lGODlhAQABAIAAAAAAAP///yH5BAEAAAAALAAAAAABAAEAAAIBRAA7")


def png(width, height, channels, bits, rows, extra=()):
    """A PNG of raw sample bytes; channels 1, 2, 3 or 4. `extra`: chunks before the pixels, (name, content) each."""
    color_type = {1: 0, 2: 4, 3: 2, 4: 6}[channels]

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    header = struct.pack(">IIBBBBB", width, height, bits, color_type, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + row for row in rows))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + b"".join(chunk(*each) for each in extra) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


class Command(CliCase):
    def test_help_fits_a_screen_and_shows_examples(self):
        done = self.run_command("--help")
        text = done.stdout.decode()
        self.assertEqual(done.returncode, 0)
        self.assertIn("tilepress run -o out -- glmark2-es2", text)
        self.assertLessEqual(len(text.splitlines()), 50)
        self.assertEqual(self.run_command("help").stdout, done.stdout)

    def test_every_verb_of_the_help_has_its_own(self):
        for verb in ("run", "frames", "schemes", "doctor"):
            done = self.run_command("help", verb)
            self.assertEqual(done.returncode, 0, verb)
            self.assertIn(f"Usage: tilepress {verb}", done.stdout.decode())

    def test_version_is_one_line(self):
        self.assertRegex(self.run_command("--version").stdout.decode(), r"\Atilepress \d+\.\d+\.\d+\n\Z")

    def test_unknown_words_are_usage_errors(self):
        self.expect(USAGE, "no verb given (see tilepress help)")
        self.expect(USAGE, "unknown verb 'frob' (see tilepress help)", "frob")
        self.expect(USAGE, "unknown option '--frob' (see tilepress help)", "--frob")
        self.expect(USAGE, "unknown option '--frob' (see tilepress schemes --help)", "schemes", "--frob")
        self.expect(USAGE, "unexpected argument 'frob' (see tilepress doctor --help)", "doctor", "frob")

    def test_schemes_lists_the_seven_of_the_paper(self):
        listed = json.loads(self.run_command("schemes", "--json").stdout)
        names = [scheme["name"] for scheme in listed]
        self.assertEqual(names[:7], ["dcp", "adcp", "vdcp", "huffdcp", "ras", "red", "hdcp"])
        keys = {scheme["name"]: [key["name"] for key in scheme["keys"]] for scheme in listed}
        self.assertIn("fvc", keys["vdcp"])
        self.assertEqual(keys["red"], [])
        self.assertIn("sizes", keys["ras"])

    def test_schemes_lists_dram_presets(self):
        presets = json.loads(self.run_command("schemes", "--dram", "--json").stdout)
        self.assertEqual([(preset["name"], preset["burst_bits"], preset["width_bits"], preset["transfers_mt_s"]) for preset in presets],
                         [("paper", 128, None, None), ("lpddr3", 256, 32, 1600), ("lpddr4", 256, 16, 3200), ("lpddr5", 256, 16, 6400)])
        self.assertTrue(all(preset["source"] for preset in presets))
        text = self.run_command("schemes", "--dram").stdout.decode()
        self.assertRegex(text, r"\ADRAM presets \(--dram\):\n  paper +burst 128 bits; .*\n  lpddr3 +burst 256 bits, 32 wires, 1600 MT/s; JEDEC")


class Rows(CliCase):
    def test_a_sequence_gives_a_row_per_frame_and_scheme(self):
        images = [golden("odd", i) for i in range(5)]
        done = self.run_command("frames", "-o", "out", "-s", "vdcp", "-s", "ras", "--verify", *images)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, b"")
        rows = read_rows(self.path("out/schemes.csv"))
        self.assertEqual([(row["frame"], row["scheme"]) for row in rows],
                         [(str(f), s) for f in range(5) for s in ("vdcp", "ras")])
        self.assertEqual([row["warmup"] for row in rows], ["1"] * 2 + ["0"] * 8)
        frames = read_rows(self.path("out/frames.csv"))
        self.assertEqual({(row["width"], row["height"], row["format"]) for row in frames}, {("333", "217", "RGBA8")})
        run = read_json(self.path("out/run.json"))
        self.assertEqual((run["state"], run["via"], run["measured_frames"]), ("finished", "frames", 4))
        # 42 x 28 blocks, every one of every frame encoded, decoded and compared.
        self.assertEqual([(s["checked_blocks"], s["mismatched_blocks"]) for s in run["schemes"]], [(1176 * 4, 0)] * 2)
        self.assertIn("5 frames seen, 5 captured, 333x217 RGBA8", done.stderr.decode())

    def test_the_saving_is_of_schemes_with_dcp_structures_and_names_the_entries(self):
        note = "  saving: the energy of DCP's structures is that of 64 entries for every size"
        images = [golden("odd", i) for i in range(2)]
        for sizes, noted in (("64", False), ("64,128", True)):
            done = self.run_command("frames", "--force", "-s", "red", "-s", f"vdcp:fvc={{{sizes}}}", *images)
            lines = done.stderr.decode().splitlines()
            red, vdcp = (line for line in lines if line.startswith(("  red ", "  vdcp:fvc=64 ")))
            self.assertRegex(red, " % +-$")
            self.assertAlmostEqual(float(vdcp.split()[-2]), 100 * (1 - 1 / float(vdcp.split()[1]) - 4.83 / 451.2), delta=0.06)
            self.assertEqual(note in lines, noted, lines)

    def test_toggles_fill_the_last_columns_and_dram_sets_the_burst(self):
        images = [golden("odd", i) for i in range(2)]
        done = self.run_command("frames", "-q", "-o", "out", "-s", "red", "--dram", "lpddr4", "--toggles", "16", *images)
        self.assertEqual(done.returncode, 0, done.stderr)
        options = read_json(self.path("out/run.json"))["options"]
        self.assertEqual((options["dram"], options["burst"], options["toggles"]), ("lpddr4", 256, "16"))
        row = read_rows(self.path("out/schemes.csv"))[1]
        self.assertEqual(list(row)[-4:], ["toggles", "toggles_dbi", "raw_toggles", "raw_toggles_dbi"])
        self.assertTrue(0 < int(row["toggles"]) and 0 < int(row["toggles_dbi"]))
        self.run_command("frames", "-q", "-o", "plain", "-s", "red", *images)
        self.assertEqual({row["raw_toggles"] for row in read_rows(self.path("plain/schemes.csv"))}, {""})
        done = self.run_command("frames", "-o", "both", "--dram", "lpddr4", "--burst", "256", *images)
        self.assertEqual(done.returncode, USAGE)

    def test_standard_output_takes_the_rows_and_no_folder_is_made(self):
        done = self.run_command("frames", "-q", "-o", "-", "-s", "red", golden("odd", 0), golden("odd", 1))
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(len(done.stdout.splitlines()), 3)
        self.assertEqual(os.listdir(self.folder), [])

    def test_frames_and_every_choose(self):
        images = [golden("odd", i) for i in range(5)]
        self.run_command("frames", "-o", "out", "-s", "red", "--frames", "1-4", "--every", "2", *images)
        self.assertEqual([row["frame"] for row in read_rows(self.path("out/frames.csv"))], ["2", "4"])
        run = read_json(self.path("out/run.json"))
        self.assertEqual((run["counts"]["seen"], run["counts"]["skipped"]), (5, 3))

    def test_alpha_stays_as_stored(self):
        # Colour under zero alpha must survive: 8 x 8 pixels, all (200, 100, 50, 0), is one colour, not black.
        pixel = bytes([200, 100, 50, 0])
        self.write("clear.png", png(8, 8, 4, 8, [pixel * 8] * 8))
        self.write("clear.rgba", pixel * 64)
        self.write("black.rgba", bytes(4) * 64)
        self.run_command("frames", "-o", "same", "-s", "red", "--size", "8x8", "clear.rgba", "clear.png")
        self.run_command("frames", "-o", "other", "-s", "red", "--size", "8x8", "black.rgba", "clear.png")
        self.assertEqual(read_rows(self.path("same/frames.csv"))[1]["pixel_change"], "0")
        self.assertEqual(read_rows(self.path("other/frames.csv"))[1]["pixel_change"], "1")

    def test_gray_and_rgb_become_the_same_opaque_pixels(self):
        self.write("gray.png", png(8, 8, 1, 8, [bytes([77]) * 8] * 8))
        self.write("rgb.png", png(8, 8, 3, 8, [bytes([77]) * 24] * 8))
        self.write("opaque.rgba", bytes([77, 77, 77, 255]) * 64)
        self.write("graya.png", png(8, 8, 2, 8, [bytes([77, 255]) * 8] * 8))
        self.run_command("frames", "-o", "x", "-s", "red", "gray.png", "rgb.png")
        self.assertEqual({row["format"] for row in read_rows(self.path("x/frames.csv"))}, {"RGBX8"})
        self.run_command("frames", "-o", "out", "-s", "red", "--size", "8x8", "gray.png", "rgb.png", "opaque.rgba",
                         "graya.png")
        self.assertEqual([row["pixel_change"] for row in read_rows(self.path("out/frames.csv"))], ["0"] * 4)

    def test_samples_of_a_png_are_taken_as_stored_whatever_else_it_says_of_them(self):
        rows = [bytes((x * 31 + y * 7 + c * 50) % 256 for x in range(24) for c in range(4)) for y in range(8)]
        self.write("plain.png", png(24, 8, 4, 8, rows))
        self.write("other.png", png(24, 8, 4, 8, rows, [(b"gAMA", struct.pack(">I", 100000)), (b"sRGB", b"\1"),
                                                         (b"bKGD", bytes(6)), (b"sBIT", bytes([5, 6, 5, 8]))]))
        self.write("raw.rgba", b"".join(rows))
        self.run_command("frames", "-o", "out", "-s", "red", "--size", "24x8", "raw.rgba", "plain.png", "other.png", "raw.rgba")
        self.assertEqual([row["pixel_change"] for row in read_rows(self.path("out/frames.csv"))], ["0"] * 4)

    def test_a_transparent_colour_of_a_png_becomes_alpha(self):
        rows = [bytes([10, 20, 30] * 4 + [40, 50, 60] * 4)] * 8
        self.write("keyed.png", png(8, 8, 3, 8, rows, [(b"tRNS", struct.pack(">HHH", 10, 20, 30))]))
        self.write("raw.rgba", bytes([10, 20, 30, 0] * 4 + [40, 50, 60, 255] * 4) * 8)
        self.run_command("frames", "-o", "out", "-s", "red", "--size", "8x8", "raw.rgba", "keyed.png")
        self.assertEqual(read_rows(self.path("out/frames.csv"))[1]["pixel_change"], "0")

    def test_a_png_with_damaged_pixels_is_named(self):
        rows = [bytes((x * x + y * 3 + c) % 256 for x in range(64) for c in range(4)) for y in range(64)]
        whole = png(64, 64, 4, 8, rows)
        self.write("whole.png", whole)
        at = whole.index(b"IDAT") + 4 + 200
        self.write("broken.png", whole[:at] + bytes(byte ^ 0x55 for byte in whole[at:at + 8]) + whole[at + 8:])
        done = self.run_command("frames", "-q", "-o", "out", "whole.png", "broken.png", env=WHOLE_STACKS)
        self.assertEqual(done.returncode, FAILED)
        self.assertRegex(done.stderr.decode(), r"\Atilepress: broken\.png: [^\n]+\n\Z")
        self.assertEqual(len(read_rows(self.path("out/frames.csv"))), 1)

    def test_raw_frames_come_through_standard_input(self):
        two = bytes(8 * 8 * 4) + bytes([255]) * (8 * 8 * 4)
        done = self.run_command("frames", "--size", "8x8", "-o", "out", "-s", "red", "-", stdin=two)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([row["pixel_change"] for row in read_rows(self.path("out/frames.csv"))], ["0", "1"])
        self.expect(FAILED, "-: the last frame has 200 of 256 bytes", "frames", "-q", "--size", "8x8", "-o", "torn", "-",
                    stdin=two[:456])
        self.assertEqual(read_json(self.path("torn/run.json"))["state"], "failed")

    def test_the_summary_tells_the_rate_with_further_traffic(self):
        done = self.run_command("frames", "-o", "out", "-s", "dcp", "-s", "fbc", golden("odd", 0), golden("odd", 1))
        rows = [row for row in read_rows(self.path("out/schemes.csv")) if row["scheme"] == "fbc" and row["warmup"] == "0"]
        (row,) = rows
        self.assertGreater(int(row["extra_bits"]), 0)
        lines = [line for line in done.stderr.decode().splitlines() if "further traffic" in line]
        self.assertEqual(lines, [f"  fbc: rate {float(row['rate_with_extra']):.4f} with the further traffic it causes"])

    def test_a_repeated_scheme_counts_once(self):
        self.run_command("frames", "-o", "out", "-s", "red", "-s", "red", golden("odd", 0))
        self.assertEqual(len(read_rows(self.path("out/schemes.csv"))), 1)

    def test_a_configuration_file_gives_what_the_command_line_does_not(self):
        self.write("c.toml", b'scheme = ["vdcp", "vdcp:fvc=128"]\ntile = 64\nverify = true\noutput = "cfg"\nquiet = true\n')
        self.assertEqual(self.run_command("frames", "--config", "c.toml", "-s", "red", golden("odd", 0)).stderr, b"")
        options = read_json(self.path("cfg/run.json"))["options"]
        self.assertEqual((options["schemes"], options["tile"], options["verify"]), (["red"], 64, True))
        self.write("bad.toml", b"frob = 1\n")
        self.expect(USAGE, "bad.toml: line 1: unknown option 'frob'", "frames", "--config", "bad.toml", golden("odd", 0))
        self.write("torn.toml", b"scheme = [\n")
        done = self.run_command("frames", "--config", "torn.toml", golden("odd", 0))
        self.assertEqual((done.returncode, done.stderr.count(b"\n")), (USAGE, 1))

    def test_progress_as_json_ends_with_the_last_frame(self):
        done = self.run_command("frames", "--progress", "json", "-o", "-", "-s", "red", *[golden("odd", i) for i in range(5)])
        lines = [json.loads(line) for line in done.stderr.splitlines() if line.startswith(b"{")]
        self.assertEqual((lines[-1]["frames_done"], lines[-1]["frames_total"]), (5, 5))


class BadInput(CliCase):
    def test_a_missing_image_is_named_and_nothing_is_made(self):
        self.expect(FAILED, "gone.png: No such file or directory", "frames", "-o", "out", golden("odd", 0), "gone.png")
        self.assert_absent("out")

    def test_images_of_different_sizes_are_named_and_nothing_is_made(self):
        self.expect(FAILED, f"{golden('odd', 0)}: is 333x217, the sequence is 720x1280", "frames", "-o", "out",
                    golden("desktop", 0), golden("odd", 0))
        self.assert_absent("out")

    def test_a_truncated_image_ends_the_run_and_says_so(self):
        with open(golden("odd", 1), "rb") as file:
            self.write("torn.png", file.read()[:20000])
        self.expect(FAILED, "torn.png: Read error: hit end of file", "frames", "-q", "-o", "out", golden("odd", 0), "torn.png",
                    golden("odd", 2), env=WHOLE_STACKS)
        self.assertEqual([row["frame"] for row in read_rows(self.path("out/frames.csv"))], ["0"])
        run = read_json(self.path("out/run.json"))
        self.assertEqual((run["state"], run["reason"]), ("failed", "torn.png: Read error: hit end of file"))

    def test_a_truncated_header_makes_nothing(self):
        with open(golden("odd", 1), "rb") as file:
            self.write("torn.png", file.read()[:20])
        self.expect(FAILED, "torn.png: Read error: hit end of file", "frames", "-o", "out", golden("odd", 0), "torn.png",
                    env=WHOLE_STACKS)
        self.assert_absent("out")

    def test_a_jpeg_or_gif_that_is_cut_off_is_refused_not_filled_in(self):
        for name, content, kept in (("a.jpg", JPEG, -3), ("a.gif", GIF, -1)):
            self.write(name, content)
            self.assertEqual(self.run_command("frames", "-q", "-o", "-", name).returncode, 0, name)
            self.write("torn." + name, content[:kept])
            self.expect(FAILED, f"torn.{name}: is cut off", "frames", "-o", "out", "torn." + name)
        self.assert_absent("out")

    def test_what_is_no_image_is_named(self):
        self.write("text.txt", b"no image\n")
        self.expect(FAILED, "text.txt: not an image", "frames", "text.txt")
        self.expect(FAILED, ".: is a folder without images (raw .rgba files need --size WxH)", "frames", ".")

    def test_deep_images_are_refused_not_narrowed(self):
        self.write("deep.png", png(8, 8, 3, 16, [bytes(48)] * 8))
        self.expect(FAILED, "deep.png: has uint16 channels; only 8 bits a channel are taken, nothing is narrowed", "frames",
                    "-o", "out", "deep.png")
        self.assert_absent("out")

    def test_raw_files_need_a_size_that_fits(self):
        self.write("raw.rgba", bytes(256))
        self.expect(USAGE, "raw.rgba: a raw frame needs --size WxH", "frames", "raw.rgba")
        self.expect(FAILED, "raw.rgba: 256 bytes, a raw frame of 8x4 has 128", "frames", "--size", "8x4", "raw.rgba")
        for size in ("0x8", "8", "8x", "x8", "8x8x8", "65536x1", "-8x8"):
            self.expect(USAGE, f"--size {size}: must be WxH with sides in 1..65535", "frames", f"--size={size}", "raw.rgba")

    def test_an_output_folder_that_cannot_be_made_is_named(self):
        self.write("file", b"")
        self.expect(FAILED, "file/out: Not a directory", "frames", "-o", "file/out", golden("odd", 0))
        self.expect(FAILED, "/proc/out: No such file or directory", "frames", "-o", "/proc/out", golden("odd", 0))

    def test_a_run_is_replaced_only_when_asked(self):
        self.assertEqual(self.run_command("frames", "-o", "out", "-s", "red", golden("odd", 0)).returncode, 0)
        self.expect(FAILED, "out: already holds a run (--force replaces it)", "frames", "-o", "out", "-s", "ras",
                    golden("odd", 0))
        self.assertEqual(read_rows(self.path("out/schemes.csv"))[0]["scheme"], "red")
        self.assertEqual(self.run_command("frames", "--force", "-o", "out", "-s", "ras", golden("odd", 0)).returncode, 0)
        self.assertEqual([row["scheme"] for row in read_rows(self.path("out/schemes.csv"))], ["ras"])

    def test_schemes_and_keys_that_do_not_exist_are_named(self):
        for spec, word in (("zip", "zip"), ("vdcp:frob=1", "frob"), ("vdcp:fvc=3", "fvc"), ("ras:fvc=64", "fvc"),
                           ("vdcp:fvc=2048", "fvc"), ("vdcp:policy=best", "best"), ("vdcp:ways=3", "ways"), ("", "scheme"),
                           ("vdcp:sample=0", "sample"), ("vdcp:coverage=2", "coverage"), ("vdcp:fvc", "fvc")):
            done = self.run_command("frames", "-o", "out", "-s", spec, golden("odd", 0))
            self.assertEqual(done.returncode, USAGE, spec)
            self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
            self.assertIn(word, done.stderr.decode())
        self.assert_absent("out")

    def test_ranges_that_are_reversed_or_empty_are_named(self):
        for text, line in (("9-3", "--frames 9-3: reversed range 9-3"), ("0-2,9-3", "--frames 0-2,9-3: reversed range 9-3"),
                           ("", "--frames '': empty range"), ("1,,2", "--frames 1,,2: empty range"),
                           ("a-b", "--frames a-b: 'a-b' is not a frame or a range of frames")):
            self.expect(USAGE, line, "frames", "-o", "out", f"--frames={text}" if text else "--frames", *([] if text else [""]),
                        golden("odd", 0))
        self.assert_absent("out")

    def test_values_out_of_range_are_named(self):
        for words, line in ((("--tile", "12"), "--tile 12: must be a multiple of 8 in 8..4096"), (("--tile", "8192"), "--tile 8192: must be a multiple of 8 in 8..4096"),
                            (("--burst", "100"), "--burst 100: must be a power of two in 16..2048"), (("--every", "0"), "--every 0: must be a number in 1..4294967295"),
                            (("--log-level", "loud"), "--log-level loud: must be trace, debug, info, warn, error or off"),
                            (("--progress", "loud"), "--progress loud: not one of auto, never, json")):
            self.expect(USAGE, line, "frames", *words, golden("odd", 0))

    def test_a_selection_without_frames_captures_nothing(self):
        self.expect(NOTHING, "--frames and --every select none of the frames 0..0", "frames", "-o", "out", "--frames", "5-9",
                    golden("odd", 0))
        self.assert_absent("out")

    def test_no_image_is_a_usage_error(self):
        self.expect(USAGE, "no IMAGE given (see tilepress frames --help)", "frames")


if __name__ == "__main__":
    assert os.path.isdir(GOLDEN)
    main()
