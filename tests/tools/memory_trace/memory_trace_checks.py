#!/usr/bin/env python3
"""Checks memory traces from the outside: requests against statistics, contents against packed files, and each format by
a reader of its own (spec section 16)."""
import collections
import csv
import gzip
import io
import os
import struct
import subprocess
import sys
import unittest

TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, TESTS)
from cli_case import CliCase, XServer, golden, read_rows  # noqa: E402

TRACE = sys.argv[3]  # of GLX or EGL calls
PACKET_CLASSES = sys.argv[4]  # folder of gem5_packet_pb2.py
sys.path.insert(0, os.path.abspath(PACKET_CLASSES))

Key = collections.namedtuple("Key", "frame surface operation")


def ceil_div(value, by):
    return -(-value // by)


def expected_requests(folder, scheme, raw=False, burst=128):
    """Spec: bursts + ceil(CSB bits / burst) + ceil(table bits / burst), once written and once read."""
    counts = collections.Counter()
    for row in read_rows(os.path.join(folder, "schemes.csv")):
        if row["scheme"] != scheme:
            continue
        requests = (int(row["raw_bits"]) // burst if raw else
                    int(row["bursts"]) + ceil_div(int(row["csb_bits"]), burst) + ceil_div(int(row["palette_bits"]), burst))
        for operation in ("write", "read"):
            counts[Key(int(row["frame"]), int(row["surface"]), operation)] += requests
    return counts


def csv_requests(text):
    return list(csv.DictReader(io.StringIO(text)))


def counts_of(requests):
    return collections.Counter(Key(int(r["frame"]), int(r["surface"]), r["operation"]) for r in requests)


def read_varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, at


class MemoryTraceCase(CliCase):
    def good(self, *words, **further):
        done = self.run_command(*words, **further)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return done

    def text(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()


class Frames(MemoryTraceCase):
    def test_requests_equal_the_statistics_of_every_scheme(self):
        # SCHEMES names others, for a longer check by hand.
        schemes = os.environ.get("SCHEMES", "adcp huffdcp hdcp lcc").split()
        for scheme in schemes:  # frames of odd sizes
            with self.subTest(scheme):
                self.good("frames", "-q", "-s", scheme, "--burst", "256", "-o", scheme, "--memory-trace", scheme + ".csv",
                          golden("odd", 1), golden("odd", 2))
                requests = csv_requests(self.text(scheme + ".csv"))
                self.assertEqual(counts_of(requests), expected_requests(self.path(scheme), scheme, burst=256))
                times = [int(r["time_ps"]) for r in requests]
                self.assertEqual(times, sorted(times))

    def test_requests_of_16_bit_pixels_equal_the_bursts_of_reading_them(self):
        self.write("p.rgb565", bytes(range(256)) * 33)
        for scheme in ("vdcp", "huffdcp"):
            self.good("pack", "-q", "-s", scheme, "--format", "rgb565", "--size", "64x66", "-o", scheme + ".tpk", "p.rgb565",
                      "p.rgb565")
            self.good("memory-trace", "-q", scheme + ".tpk", "-o", scheme + ".csv")
            done = self.good("unpack", scheme + ".tpk", "--csv", "--csb-line-bursts", "1")
            expected = collections.Counter()
            for row in csv.DictReader(io.StringIO(done.stdout.decode())):
                for operation in ("write", "read"):
                    expected[Key(int(row["frame"]), 0, operation)] += sum(
                        int(row[c]) for c in ("payload_bursts", "csb_bursts", "table_bursts"))
            self.assertEqual(counts_of(csv_requests(self.text(scheme + ".csv"))), expected)

    def test_raw_twin_has_every_burst_of_the_frame_at_the_same_addresses(self):
        images = [golden("odd", 1), golden("odd", 2)]
        self.good("frames", "-q", "-s", "vdcp", "-o", "o", "--memory-trace", "c.csv", *images)
        self.good("memory-trace", "-q", "o", "--raw", "-o", "r.csv")
        raw = csv_requests(self.text("r.csv"))
        self.assertEqual(counts_of(raw), expected_requests(self.path("o"), "vdcp", raw=True))
        compressed = {r["address"] for r in csv_requests(self.text("c.csv")) if r["part"] == "payload"}
        self.assertLessEqual(compressed, {r["address"] for r in raw})

    def test_contents_are_those_of_the_packed_file_and_reads_return_what_was_written(self):
        images = [golden("odd", 1), golden("odd", 2)]
        self.good("pack", "-q", "-s", "hdcp", "-o", "p.tpk", *images)
        self.good("memory-trace", "-q", "p.tpk", "--trace-data", "-o", "packed.csv")
        self.good("frames", "-q", "-s", "hdcp", "-j", "2", "-o", "-", "--memory-trace", "frames.csv", "--trace-data", *images)
        self.assertEqual(self.text("packed.csv"), self.text("frames.csv"))
        for frame in ("0", "1"):
            memory, read = {}, {}
            for request in csv_requests(self.text("frames.csv")):
                if request["frame"] != frame:
                    continue
                self.assertEqual(len(request["data"]), 2 * int(request["bytes"]))
                into = memory if request["operation"] == "write" else read
                into[request["address"]] = request["data"]
            self.assertEqual(memory, read)
            with open(self.path("p.tpk"), "rb") as file:
                body = file.read()
            tables = "".join(memory[a] for a in sorted(memory, key=lambda a: int(a, 16)))[-34 * 16:]
            if frame == "1":  # the tables of the last frame: bits of the packed file, then zeros
                self.assertIn(bytes.fromhex(tables.rstrip("0")[: 2 * 200]), body)

    def test_requests_of_more_bursts_cover_the_same_bytes(self):
        image = golden("odd", 3)
        self.good("frames", "-q", "-s", "vdcp", "-o", "o", "--memory-trace", "a.csv", image, image)
        self.good("memory-trace", "-q", "o", "--request-bytes", "64", "-o", "b.csv")
        small = {int(r["address"], 16) // 64 for r in csv_requests(self.text("a.csv"))}
        large = csv_requests(self.text("b.csv"))
        self.assertEqual(small, {int(r["address"], 16) // 64 for r in large})
        self.assertEqual({r["bytes"] for r in large}, {"64"})
        self.assertTrue(all(int(r["address"], 16) % 64 == 0 for r in large))

    def test_frames_lie_at_the_base_and_fill_their_refresh(self):
        self.good("pack", "-q", "-s", "vdcp", "-o", "o.tpk", golden("odd", 1), golden("odd", 2))
        self.good("memory-trace", "-q", "o.tpk", "--refresh", "100", "--trace-base", "0x10000", "-o", "o.csv")
        requests = csv_requests(self.text("o.csv"))
        self.assertEqual(min(int(r["address"], 16) for r in requests), 0x10000)
        period = 10**10
        for request in requests:
            time, frame = int(request["time_ps"]), int(request["frame"])
            begin = frame * period if request["operation"] == "write" else (frame + 1) * period
            self.assertTrue(begin <= time < begin + period, request)

    def test_frames_of_two_surfaces_lie_apart_and_share_a_refresh(self):
        self.good("frames", "-q", "-s", "vdcp", "-o", "o", "--memory-trace", "t.csv", golden("odd", 1))
        # tilepress/block_log.h: two blocks of one burst, 48 CSB bits a block, no tables.
        log = struct.pack("<8s6I", b"TPBLOCKS", 1, 32, 128, 0, 4, 0) + b"vdcp"
        for frame, surface in ((0, 5), (0, 9), (1, 5), (1, 9), (2, 9)):
            log += struct.pack("<4Q6I2H", 4, frame, 0, 0, surface, 16, 8, 0, 48, 0, 100, 128)
        self.write("o/blocks.log", log)
        self.good("memory-trace", "-q", "o", "--refresh", "1000", "-o", "two.csv")
        requests = csv_requests(self.text("two.csv"))
        # Three requests each: two blocks and one burst of CSB.
        self.assertEqual(set(counts_of(requests).values()), {3})
        self.assertEqual({r["address"] for r in requests if r["surface"] == "5"}, {"0x0", "0x100", "0x200"})
        self.assertEqual({r["address"] for r in requests if r["surface"] == "9"}, {"0x1000", "0x1100", "0x1200"})
        writes = {int(r["time_ps"]) // 10**9 for r in requests if r["operation"] == "write" and r["frame"] == "1"}
        self.assertEqual(writes, {1})  # both surfaces share the second millisecond
        last = [int(r["time_ps"]) for r in requests if r["frame"] == "2" and r["operation"] == "read"]
        self.assertEqual(last, [3 * 10**9, 3 * 10**9 + 333333333, 3 * 10**9 + 666666666])

    def test_bad_options_are_one_line_before_any_work(self):
        for status, line, words in (
                (2, "--memory-trace: memory sees one scheme, and this run has 7; choose with -s SCHEME or --trace-scheme SCHEME",
                 ["--memory-trace", "t.csv"]),
                (2, "t.txt: the name tells no format; give --trace-format NAME, one of csv, gem5, dramsim3, ramulator2, "
                    "ramulator2-vectors, ramulator2-data, or a name such as trace.csv.zst",
                 ["-s", "vdcp", "--memory-trace", "t.txt"]),
                (2, "--memory-trace: scheme te has further traffic that one pass over the blocks does not show; choose "
                    "another scheme", ["-s", "te", "--memory-trace", "t.csv"]),
                (2, "--request-bytes 24: must be a power of two from 16 (one burst) to 4096",
                 ["-s", "vdcp", "--memory-trace", "t.csv", "--request-bytes", "24"]),
                (2, "--trace-scheme ras: not among the schemes of this run; add -s ras",
                 ["-s", "vdcp", "--memory-trace", "t.csv", "--trace-scheme", "ras"]),
                (2, "--trace-data: this format has no place for data; csv and ramulator2-data have",
                 ["-s", "vdcp", "--memory-trace", "t.gem5", "--trace-data"])):
            with self.subTest(line):
                self.expect(status, line, "frames", "-o", "o", *words, golden("odd", 1))
                self.assert_absent("o")

    def test_the_path_of_a_trace_may_hold_the_name_of_the_run(self):
        self.good("frames", "-q", "-s", "vdcp", "-o", "all/menu", "--memory-trace", "{name}.csv", golden("odd", 1))
        self.assertEqual(counts_of(csv_requests(self.text("menu.csv"))), expected_requests(self.path("all/menu"), "vdcp"))
        self.expect(1, "menu.csv: exists; choose another name or remove it", "frames", "-s", "vdcp", "-o", "menu", "--memory-trace",
                    "{name}.csv", golden("odd", 1))

    def test_sources_without_blocks_are_refused(self):
        os.mkdir(self.path("empty"))
        self.expect(1, "empty: holds no blocks.log; capture it with --memory-trace FILE", "memory-trace", "empty", "-o", "t.csv")
        self.good("frames", "-q", "-s", "vdcp", "-o", "o", "--memory-trace", "t.csv", golden("odd", 1))
        self.expect(1, "t.csv: exists; choose another name or remove it", "memory-trace", "o", "-o", "t.csv")
        self.expect(1, "none/t.csv: there is no folder none (mkdir -p none)", "memory-trace", "o", "-o", "none/t.csv")
        self.good("memory-trace", "-q", "o", "--force", "-o", "t.csv")


class Formats(MemoryTraceCase):
    def setUp(self):
        super().setUp()
        self.good("frames", "-q", "-s", "vdcp", "-s", "ras", "--trace-scheme", "vdcp", "-o", "o", "--memory-trace", "t.csv",
                  golden("odd", 1), golden("odd", 2))
        self.requests = csv_requests(self.text("t.csv"))

    def convert(self, name, *words):
        self.good("memory-trace", "-q", "o", "-o", name, *words)
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_gem5_packets_are_read_by_the_classes_of_protoc(self):
        import gem5_packet_pb2  # pylint: disable=import-outside-toplevel
        data = gzip.decompress(self.convert("t.gem5.gz"))
        self.assertEqual(data, self.convert("t.gem5"))
        self.assertEqual(data[:4], b"gem5")
        size, at = read_varint(data, 4)
        header = gem5_packet_pb2.PacketHeader.FromString(data[at:at + size])
        self.assertEqual(header.tick_freq, 10**12)
        at += size
        packets = []
        while at < len(data):
            size, at = read_varint(data, at)
            packets.append(gem5_packet_pb2.Packet.FromString(data[at:at + size]))
            at += size
        self.assertEqual([(p.tick, {1: "read", 4: "write"}[p.cmd], p.addr, p.size) for p in packets],
                         [(int(r["time_ps"]), r["operation"], int(r["address"], 16), int(r["bytes"])) for r in self.requests])

    def test_zstd_is_read_by_its_program(self):
        self.convert("t.csv.zst")
        text = subprocess.run(["zstd", "-dcq", self.path("t.csv.zst")], capture_output=True, check=True).stdout
        self.assertEqual(text.decode(), self.text("t.csv"))

    def test_dramsim3_lines_have_cycles_of_the_clock(self):
        lines = self.convert("t.dramsim3", "--trace-clock", "500").decode().splitlines()
        self.assertEqual(lines, [f"{r['address']} {r['operation'].upper()} {int(r['time_ps']) // 2000}" for r in self.requests])

    def test_ramulator_lines(self):
        names = {"read": "LD", "write": "ST"}
        lines = self.convert("t.ramulator2").decode().splitlines()
        self.assertEqual(lines, [f"{names[r['operation']]} {r['address']}" for r in self.requests])
        swapped = self.convert("s.ramulator2", "--swap-load-store").decode().splitlines()
        self.assertEqual([line[:2] for line in swapped], [{"LD": "ST", "ST": "LD"}[line[:2]] for line in lines])

    def test_ramulator_vectors_name_each_address(self):
        lines = self.convert("t.ramulator2-vectors", "--trace-levels", "2,1,4,4,1024,64").decode().splitlines()
        for request, line in zip(self.requests, lines, strict=True):
            operation, vector = line.split()
            channel, rank, group, bank, row, column = map(int, vector.split(","))
            self.assertEqual(operation, request["operation"][0].upper())
            address = (((row * 4 + bank) * 4 + group) + rank) * 64 + column
            self.assertEqual((address * 2 + channel) * 16, int(request["address"], 16))

    def test_ramulator_data_has_the_bytes_of_stores(self):
        self.good("frames", "-q", "-s", "vdcp", "-o", "d", "--memory-trace", "d.csv", "--trace-data", golden("odd", 1))
        self.good("memory-trace", "-q", "d", "-o", "d.ramulator2-data")
        for request, line in zip(csv_requests(self.text("d.csv")), self.text("d.ramulator2-data").splitlines(), strict=True):
            words = line.split()
            self.assertEqual(words[1:3], [request["address"], request["bytes"]])
            if words[0] == "ST":
                self.assertEqual(bytes(map(int, words[3:])).hex(), request["data"])


class Compose(MemoryTraceCase):
    def test_reads_equal_the_rows_of_compose(self):
        self.good("pack", "-q", "-s", "vdcp", "-o", "a.tpk", golden("odd", 1), golden("odd", 2))
        self.good("pack", "-q", "-s", "ras", "-o", "b.tpk", golden("odd", 1))
        common = ["a.tpk", "b.tpk", "--at", "0,0", "--at", "10,20", "--csb-lines", "2", "-q", "--force"]
        for raw in (False, True):
            self.good("compose", *common, "-o", "rows.csv", "--memory-trace", "t.csv", *(["--raw"] if raw else []))
            expected = collections.Counter()
            for row in read_rows(self.path("rows.csv")):
                columns = ("raw_bursts",) if raw else ("payload_bursts", "csb_bursts", "table_bursts")
                expected[Key(int(row["frame"]), int(row["surface"]), "read")] += sum(int(row[c]) for c in columns)
            self.assertEqual(counts_of(csv_requests(self.text("t.csv"))), expected)


class Programs(MemoryTraceCase):
    def test_replays_and_running_programs(self):
        self.good("replay", "-q", "-s", "vdcp", "-o", "r", "--frames", "0-2", "--memory-trace", "r-{name}.csv", TRACE)
        name = os.path.splitext(os.path.basename(TRACE))[0]
        requests = csv_requests(self.text(f"r-{name}.csv"))
        self.assertEqual(counts_of(requests), expected_requests(self.path(f"r/{name}"), "vdcp"))
        with XServer() as server:
            done = self.run_command("run", "-q", "-s", "hdcp", "-s", "vdcp", "--trace-scheme", "hdcp", "-o", "p", "--frames",
                                    "0-9", "--memory-trace", "p.csv", "--seconds", "6", "--", "glxgears",
                                    env={"DISPLAY": server.display})
        self.assertIn(done.returncode, (0, 128 + 15), done.stderr.decode())
        (folder,) = [entry.path for entry in os.scandir(self.path("p")) if entry.is_dir()]
        requests = csv_requests(self.text("p.csv"))
        self.assertEqual(counts_of(requests), expected_requests(folder, "hdcp"))
        # Every write of a frame comes before its present, and every read after it.
        presents = {int(row["frame"]): int(row["time_ns"]) * 1000 for row in read_rows(folder + "/frames.csv")}
        for request in requests:
            before = int(request["time_ps"]) < presents[int(request["frame"])]
            self.assertEqual(before, request["operation"] == "write", request)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
