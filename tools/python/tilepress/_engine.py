"""Engine: frames of one surface in, statistics, bits and compressed surfaces out."""
from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy

from . import _native
from ._native import CompressedSurface
from ._statistics import FrameMetrics, FrameStatistics, SchemeStatistics

#: The schemes of the paper.
PAPER = ("dcp", "adcp", "vdcp", "huffdcp", "ras", "red", "hdcp")


class Engine:
    """Models one surface: a buffer with a size and a pixel format. The first frame decides the size.

    schemes: specifications such as "vdcp", "vdcp:fvc=128" or "vdcp:fvc={16..512}"; one text or a list.
    format: "rgba8", "rgbx8", "rgb565" or "rgb10a2"; see help(tilepress) for the arrays.
    order: "rgba" or "bgra": the bytes of 8-bit pixels in memory.
    tile_side: side of a render tile in pixels, a multiple of 8.
    burst_bits: size of a DRAM burst, a power of two.
    verify: encode, decode and compare every block; see SchemeStatistics.mismatched_blocks.
    frame_metrics: compute FrameMetrics, and the coverages of FVCs. Without it frames take less time.
    toggle_bits: count the toggles of a memory bus of 16 or 32 bits; 0 = off.

    Engines are independent of each other, and process() lets other Python threads run: use one engine per thread.
    A scheme that does not support the format is left out of every result.

    Raises Error for values that the library refuses.
    """

    def __init__(self, schemes: str | Iterable[str] = PAPER, *, format: str = "rgba8", order: str = "rgba",
                 tile_side: int = 32, burst_bits: int = 128, verify: bool = False, frame_metrics: bool = True,
                 toggle_bits: int = 0) -> None:
        texts = [schemes] if isinstance(schemes, str) else list(schemes)
        self._native = _native.Engine(texts, format, order, tile_side, burst_bits, verify, frame_metrics, toggle_bits)

    @property
    def schemes(self) -> list[str]:
        """The specifications, lists in braces written out."""
        return self._native.schemes()

    def process(self, frame: numpy.ndarray, *, block_bits: bool = False, surfaces: bool = False) -> FrameStatistics:
        """Compresses the next frame of the surface.

        frame: H×W×4 uint8 (rgba8, rgbx8), H×W uint16 (rgb565) or H×W uint32 (rgb10a2). It is not copied. Do not
            change it from another thread meanwhile.
        block_bits: also return the payload bits of each block.
        surfaces: also return the compressed frame of each scheme.

        Raises Error for an array of another shape, type or size, and for rows whose pixels are not contiguous;
        TypeError for what is no numpy array.
        """
        number, warmup, encode_ns, metrics, figures, bits, stored = self._native.process(frame, block_bits, surfaces)
        return FrameStatistics(
            frame=number, warmup=warmup, encode_ns=encode_ns,
            metrics=FrameMetrics(**metrics) if metrics is not None else None,
            schemes={each["scheme"]: SchemeStatistics(**each) for each in figures}, block_bits=bits, surfaces=stored)

    @property
    def frames(self) -> int:
        """The number of the next frame."""
        return self._native.frames()

    def history(self, frame: int) -> list[int]:
        """The frames that frame number `frame` depends on. Process them in this order, each after a seek() to its
        number, and the engine is as if it had seen all frames before: parts of a sequence can run side by side."""
        return self._native.history(frame)

    def seek(self, frame: int) -> None:
        """Makes the next frame number `frame` of the surface."""
        self._native.seek(frame)


@dataclass(frozen=True)
class Compression:
    """The frames of a sequence. ``result["vdcp"]`` is the sum of a scheme without warm-up frames."""

    frames: list[FrameStatistics]
    totals: dict[str, SchemeStatistics]  #: by specification; empty if there are only warm-up frames

    def __getitem__(self, scheme: str) -> SchemeStatistics:
        return self.totals[scheme]

    def __iter__(self) -> Iterator[FrameStatistics]:
        return iter(self.frames)

    def to_rows(self) -> list[dict[str, Any]]:
        """A dict per frame and scheme, for pandas.DataFrame."""
        return [{"frame": frame.frame, "warmup": frame.warmup, **each.to_dict()} for frame in self.frames for each in frame]


def compress(frames: Iterable[numpy.ndarray], schemes: str | Iterable[str] = PAPER, **options: Any) -> Compression:
    """Processes all frames of a surface: a list, an N×H×W×4 array or any iterable of arrays.

    options: the keywords of Engine.

        result = tilepress.compress(frames, "vdcp:fvc={16..512}")
        result["vdcp:fvc=64"].rate
    """
    engine = Engine(schemes, **options)
    results = [engine.process(frame) for frame in frames]
    totals: dict[str, SchemeStatistics] = {}
    for result in results:
        if not result.warmup:
            for each in result:
                totals[each.scheme] = totals[each.scheme] + each if each.scheme in totals else each
    return Compression(results, totals)
