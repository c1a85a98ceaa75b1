"""Statistics: the figures of a frame, of a scheme, and their sums."""
from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Iterator

if TYPE_CHECKING:
    import numpy

    from ._native import CompressedSurface


def _ratio(raw: int, moved: int) -> float:
    return raw / moved if moved else 0.0


@dataclass(frozen=True)
class SchemeStatistics:
    """The figures of one scheme, for a frame or summed over frames. Sizes are in bits.

    ``a + b`` adds two results of one scheme; coverages belong to a frame and are lost.
    """

    scheme: str              #: the specification, such as "vdcp:fvc=128"
    blocks: int              #: 8×8 blocks; partial blocks count whole
    raw_bits: int            #: size without compression
    payload_bits: int        #: what the scheme writes for all blocks
    bursts: int              #: DRAM bursts of the payload; every block starts on one of its own
    burst_bits: int          #: size of one burst
    csb_bits: int            #: compression status bits
    palette_bits: int        #: tables that go with the frame
    extra_bits: int = 0      #: further traffic of a scheme
    checked_blocks: int = 0  #: with verify: blocks encoded, decoded and compared
    mismatched_blocks: int = 0
    own: dict[str, int] = field(default_factory=dict)  #: columns of the scheme's own, such as hdcp's "vdcp_blocks"
    fvc_coverage: float | None = None            #: 0..1; None without an FVC that collected this frame
    fvc_relative_coverage: float | None = None   #: 0..1
    toggles: int | None = None                   #: with toggle_bits: wires that change
    toggles_dbi: int | None = None               #: the same with data bus inversion
    raw_toggles: int | None = None
    raw_toggles_dbi: int | None = None

    @property
    def moved_bits(self) -> int:
        """Bits that DRAM moves: whole bursts, CSB and tables."""
        return self.bursts * self.burst_bits + self.csb_bits + self.palette_bits

    @property
    def rate(self) -> float:
        """raw / moved; 0 without blocks."""
        return _ratio(self.raw_bits, self.moved_bits)

    @property
    def rate_payload(self) -> float:
        """raw / (payload + CSB): the paper's first comparison."""
        return _ratio(self.raw_bits, self.payload_bits + self.csb_bits)

    @property
    def rate_with_extra(self) -> float:
        """raw / (moved + extra)."""
        return _ratio(self.raw_bits, self.moved_bits + self.extra_bits)

    def __add__(self, other: SchemeStatistics) -> SchemeStatistics:
        if self.scheme != other.scheme or self.burst_bits != other.burst_bits:
            raise ValueError(f"statistics: {self.scheme} and {other.scheme}: only figures of one scheme and burst add up")
        sums: dict[str, Any] = {}
        for each in dataclasses.fields(self):
            a, b = getattr(self, each.name), getattr(other, each.name)
            if each.name in ("scheme", "burst_bits"):
                sums[each.name] = a
            elif each.name == "own":
                sums["own"] = {name: a.get(name, 0) + b.get(name, 0) for name in {**a, **b}}
            elif "coverage" not in each.name and not (a is None and b is None):
                sums[each.name] = (a or 0) + (b or 0)
        return SchemeStatistics(**sums)

    def to_dict(self) -> dict[str, Any]:
        """The figures and the rates under the column names of schemes.csv."""
        figures = {each.name: getattr(self, each.name) for each in dataclasses.fields(self) if each.name != "own"}
        return {**figures, **self.own, "moved_bits": self.moved_bits, "rate": self.rate,
                "rate_payload": self.rate_payload, "rate_with_extra": self.rate_with_extra}


@dataclass(frozen=True)
class FrameMetrics:
    """Metrics of the frame itself, over the pixels inside it."""

    unique_colors: int
    entropy: float                #: bits per pixel of the colour histogram
    pixel_change: float           #: 0..1, against the frame before
    color_change: float           #: 0..pixel_change
    fvc_coverage: float           #: 0..1, of a 64-entry FVC
    fvc_relative_coverage: float  #: 0..1
    top100_coverage: float        #: 0..1

    def to_dict(self) -> dict[str, Any]:
        """The metrics under the column names of frames.csv."""
        return dataclasses.asdict(self)


@dataclass(frozen=True)
class FrameStatistics:
    """One frame of one surface. ``figures["vdcp"]`` is the SchemeStatistics of a scheme."""

    frame: int        #: number of the frame, from 0
    warmup: bool      #: the first frame: no scheme has a palette yet, and sums leave it out
    encode_ns: int    #: time of the engine
    metrics: FrameMetrics | None                #: None with frame_metrics=False
    schemes: dict[str, SchemeStatistics]        #: by specification; without those that do not support the format
    block_bits: dict[str, numpy.ndarray] | None = field(default=None, repr=False, compare=False)
    """With block_bits=True: payload bits of each block, (blocks_y, blocks_x) uint16 by specification."""
    surfaces: dict[str, CompressedSurface] | None = field(default=None, repr=False, compare=False)
    """With surfaces=True: the compressed frame by specification."""

    def __getitem__(self, scheme: str) -> SchemeStatistics:
        return self.schemes[scheme]

    def __iter__(self) -> Iterator[SchemeStatistics]:
        return iter(self.schemes.values())

    def __len__(self) -> int:
        return len(self.schemes)

    def to_dict(self) -> dict[str, Any]:
        """Number, times and metrics in one level; "schemes" lists the dicts of the schemes."""
        return {"frame": self.frame, "warmup": self.warmup, "encode_ns": self.encode_ns,
                **(self.metrics.to_dict() if self.metrics else {}),
                "schemes": [each.to_dict() for each in self]}
