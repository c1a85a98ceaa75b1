"""tilepress: framebuffer compression of tile-based GPUs, frame by frame from numpy arrays.

    import numpy, tilepress

    engine = tilepress.Engine(["vdcp", "hdcp:fvc=128"])
    for frame in frames:                    # H×W×4 uint8 arrays, top row first
        figures = engine.process(frame)
    print(figures["vdcp"].rate)             # raw bits / bits that DRAM moves

A frame is an array of one pixel format:

    "rgba8", "rgbx8"    H×W×4 uint8: R, G, B, A. rgbx8 ignores A
    "rgb565"            H×W uint16: B | G << 5 | R << 11
    "rgb10a2"           H×W uint32: R | G << 10 | B << 20 | A << 30

Frames are read where they lie, without a copy. Rows may be any distance apart, also negative (``frame[::-1]``).
The pixels of a row must be contiguous: other arrays raise Error, and numpy.ascontiguousarray makes a copy that works.

Everything that the library refuses raises tilepress.Error, a ValueError with one line of text.
"""
from ._engine import CompressedSurface, Engine, Compression, compress
from ._errors import Error
from ._native import BitReader, BitWriter, version as __version__
from ._runs import Run, Study, read_heat_map, read_run, read_runs, read_study
from ._schemes import Key, Scheme, SchemeInfo, SchemeKey, load_plugin, parse_schemes, register_scheme, schemes
from ._statistics import FrameMetrics, FrameStatistics, SchemeStatistics
from ._structures import Algorithm1, Ccd, CcdSizeRound, Fvc, color_counts, color_text, energy_saving

__all__ = [
    "Algorithm1", "BitReader", "BitWriter", "Ccd", "CcdSizeRound", "CompressedSurface", "Compression", "Engine", "Error",
    "FrameMetrics", "FrameStatistics", "Fvc", "Key", "Run", "Scheme", "SchemeInfo", "SchemeKey", "SchemeStatistics",
    "Study", "color_counts", "color_text", "compress", "energy_saving", "load_plugin", "parse_schemes", "read_heat_map",
    "read_run", "read_runs", "read_study", "register_scheme", "schemes", "__version__",
]
