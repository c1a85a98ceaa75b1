"""Structures: FVC, CCD and Algorithm 1 as objects to look into."""
from __future__ import annotations

from dataclasses import dataclass

import numpy

from . import _native
from ._native import color_text, energy_saving  # noqa: F401  (part of the package)


def _pixel_words(frame: numpy.ndarray) -> numpy.ndarray:
    frame = numpy.ascontiguousarray(frame)
    return frame.view("<u4")[..., 0] if frame.dtype == numpy.uint8 else frame.astype(numpy.uint32)


class Fvc:
    """Frequent Values Collector: a small associative memory that counts the colours of a frame.

    scheme: a specification with an FVC; its keys fvc, policy, ways and sample count. "dcp:fvc=64" is the paper's.
    format, order, tile_side: as for Engine. Pixels enter in the order of the render tiles.
    """

    def __init__(self, scheme: str = "dcp", *, format: str = "rgba8", order: str = "rgba", tile_side: int = 32) -> None:
        if tile_side < 8 or tile_side > 4096 or tile_side % 8:
            raise ValueError(f"tile_side={tile_side}: must be a multiple of 8 from 8 to 4096")
        self._native = _native.Fvc(scheme, format, order, tile_side)
        self._pixel_bits = 16 if format.lower() == "rgb565" else 32

    def collect(self, frame: numpy.ndarray) -> Fvc:
        """Empties the FVC, collects a frame and returns the FVC."""
        self._native.collect(frame)
        return self

    @property
    def entries(self) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Colours (uint32 pixel words) and counts (uint32) by slot. Count 0: the slot is empty."""
        return self._native.entries()

    @property
    def samples(self) -> int:
        """Pixels that entered."""
        return self._native.samples()

    @property
    def coverage(self) -> float:
        """Counts held / pixels that entered, 0..1."""
        return self._native.coverage()

    def ccd(self) -> Ccd:
        """Returns the dictionary that the next frame uses."""
        colors, counts = self._native.ccd()
        return Ccd(len(self.entries[0]), colors, counts, self.samples, self.coverage, self._pixel_bits)


@dataclass(frozen=True)
class Ccd:
    """Common Colors Dictionary: the colours of an FVC, the most frequent first."""

    entries: int           #: slots N; the colours may be fewer
    colors: numpy.ndarray  #: uint32 pixel words by index
    counts: numpy.ndarray  #: uint32 FVC counts, descending
    samples: int           #: pixels that entered the FVC
    coverage: float        #: of the FVC, 0..1
    pixel_bits: int = 32

    @property
    def index_bits(self) -> int:
        """M = log2 N."""
        return self.entries.bit_length() - 1

    @property
    def rgba(self) -> numpy.ndarray:
        """The colours of an 8-bit format as N×4 uint8."""
        return self.colors.astype("<u4").view(numpy.uint8).reshape(-1, 4)

    def indices(self, frame: numpy.ndarray) -> numpy.ndarray:
        """Returns the index of each pixel as H×W int16; -1 for a colour that the dictionary lacks."""
        words = _pixel_words(frame)
        if not len(self.colors):
            return numpy.full(words.shape, -1, numpy.int16)
        order = numpy.argsort(self.colors)
        at = numpy.minimum(numpy.searchsorted(self.colors, words, sorter=order), len(order) - 1)
        found = order[at]
        return numpy.where(self.colors[found] == words, found, -1).astype(numpy.int16)

    def algorithm1(self) -> Algorithm1:
        """Predicts the dictionary's size as ADCP does."""
        return Algorithm1.predict(self.counts, self.samples, self.index_bits, self.pixel_bits)


@dataclass(frozen=True)
class CcdSizeRound:
    """One round of Algorithm 1."""

    width: int           #: the round tries 2**width entries
    covered_pixels: int  #: pixels of the first 2**width colours
    bits: int            #: indices of these pixels, and the other pixels raw


@dataclass(frozen=True)
class Algorithm1:
    """Algorithm 1 of the paper: the dictionary size that would have moved the fewest bits."""

    width: int  #: the dictionary gets 2**width entries; 0 if no size saves bits
    rounds: tuple[CcdSizeRound, ...]

    @property
    def entries(self) -> int:
        """2**width."""
        return 1 << self.width

    @classmethod
    def predict(cls, counts: numpy.ndarray | list[int], frame_pixels: int, max_width: int = 6,
                pixel_bits: int = 32) -> Algorithm1:
        """counts: FVC counts in descending order. frame_pixels: pixels that entered. max_width: log2 of the entries."""
        width, rounds = _native.predict_ccd_size([int(count) for count in counts], frame_pixels, max_width, pixel_bits)
        return cls(width, tuple(CcdSizeRound(*each) for each in rounds))


def color_counts(frame: numpy.ndarray, *, format: str = "rgba8", order: str = "rgba") -> tuple[numpy.ndarray, numpy.ndarray]:
    """Returns every colour of a frame (uint32 pixel words) and its pixels (uint64), the most frequent first."""
    return _native.color_counts(frame, format, order)
