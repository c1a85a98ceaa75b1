"""Frames and rates of a trace: renders it by `tilepress study` and reads the digests of its frames."""
import csv
import hashlib
import json
import os
import struct
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from corpus_messages import Fault

TILEPRESS = os.environ.get("TILEPRESS", "tilepress")
SCHEMES = ["dcp", "adcp", "vdcp", "huffdcp", "ras", "red", "hdcp"]
FOOTER = struct.Struct("<QQQQQ8s")
ENTRY = struct.Struct("<IIIBBHQQQQQQ16s")


@dataclass
class Rendering:
    cache: Path
    frames: list = field(default_factory=list)    # (surface, frame, width, height, digest)
    metrics: list = field(default_factory=list)   # rows of frame_metrics.csv
    results: list = field(default_factory=list)   # rows of results.csv
    origin: dict = field(default_factory=dict)

    def digests(self):
        return [frame[4] for frame in self.frames]

    def digest(self):
        return hashlib.sha256("\n".join(self.digests()).encode()).hexdigest()


def read_cache(path):
    """The index of a frame cache (tools/study/cache/FORMAT.md)."""
    data = path.read_bytes()
    offset, count, origin_bytes, _, size, end = FOOTER.unpack(data[-FOOTER.size:])
    if end != b"TPFWHOLE" or size != len(data):
        raise Fault(f"{path}: the frame cache is torn")
    frames = []
    for number in range(count):
        entry = ENTRY.unpack_from(data, offset + number * ENTRY.size)
        frames.append((entry[0], entry[6], entry[1], entry[2], entry[12].hex()))
    origin = offset + count * ENTRY.size
    return frames, json.loads(data[origin:origin + origin_bytes])


def sha256_of(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def render(trace, folder, schemes, log=None):
    """Renders a trace with a frame cache and a study in `folder`. Raises Fault."""
    folder.mkdir(parents=True, exist_ok=True)
    study = folder / "study.toml"
    words = ", ".join(f'"{scheme}"' for scheme in schemes)
    study.write_text(f'name = "corpus"\nbaseline = "{schemes[0]}"\nconfigurations = [{words}]\n', encoding="utf-8")
    done = subprocess.run([TILEPRESS, "study", str(study), "-q", "-o", str(folder / "study"), "--cache", str(folder / "cache"),
                           "--timeout", "300", str(trace)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, errors="replace", check=False)
    if log is not None:
        log.write(done.stderr)
    caches = list((folder / "cache").glob("*.frames"))
    if done.returncode != 0 or len(caches) != 1:
        lines = [line for line in done.stderr.splitlines() if line.startswith("tilepress: ")]
        raise Fault(lines[0].removeprefix("tilepress: ") if lines else f"{trace}: not rendered (status {done.returncode})")
    rendering = Rendering(caches[0])
    rendering.frames, rendering.origin = read_cache(caches[0])
    rendering.metrics = read_rows(folder / "study/frame_metrics.csv")
    rendering.results = read_rows(folder / "study/results.csv")
    return rendering


def rates_of(rendering):
    """The rates of each scheme over all frames, without rounding."""
    return {row["scheme"]: {column: float(row[column]) for column in ("rate", "rate_payload")} for row in rendering.results}
