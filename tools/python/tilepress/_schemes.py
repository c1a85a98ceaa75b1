"""Schemes: the registry, and schemes written in Python."""
from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy

from . import _native
from ._errors import Error
from ._native import BitReader, BitWriter


@dataclass(frozen=True)
class SchemeKey:
    """A key that a specification may name."""

    name: str
    kind: str     #: "number", "power_of_two", "share", "choice" or "file"
    summary: str
    values: str   #: as help prints them
    default: str


@dataclass(frozen=True)
class SchemeInfo:
    """A scheme of the registry."""

    name: str
    label: str
    family: str
    group: str    #: "paper", "literature", "hardware" or "ours"
    summary: str
    source: str
    eight_bit_only: bool  #: supports rgba8 and rgbx8 only
    keys: tuple[SchemeKey, ...]


def schemes() -> list[SchemeInfo]:
    """Returns the schemes of the library, then those registered here."""
    return [SchemeInfo(*about, tuple(SchemeKey(*key) for key in keys)) for *about, keys in _native.schemes()]


def parse_schemes(text: str) -> list[str]:
    """Returns the specifications that a text with lists stands for: "vdcp:fvc={16,32}" → two. Raises Error."""
    return _native.parse_schemes(text)


def load_plugin(path: str | os.PathLike[str]) -> list[str]:
    """Loads a plugin for good and returns the names of its schemes, which work like any other from then on. Loading it
    again is no error. Raises Error if the library is no plugin, or if one of its schemes is refused."""
    return _native.load_plugin(os.fspath(path))


@dataclass(frozen=True)
class Key:
    """A key of a scheme in Python. Its value arrives in Scheme.values.

    kind: "number" (low to high), "power_of_two" (the same, powers of two only), "share" (a float from 0 to 1, default 0)
        or "choice" (a word of `choices`; `initial` is the position of the default).
    """

    name: str
    summary: str
    kind: str = "number"
    low: int = 0
    high: int = 0x7FFFFFFF
    initial: int = 0
    choices: Sequence[str] = ()


class Scheme:
    """Base of schemes in Python, for prototypes: some thousand blocks a second.

    Derive a class, register it with register_scheme(), and use its name like any other. An engine makes one instance that
    encodes, and with verify=True or a CompressedSurface another one that decodes: they share only bits. A class has

        name            of the scheme, without ':' and ','
        csb_bits        status bits of each block, 0 to 128; begin_frame() may change it
        encode(pixels, payload, csb)   writes the block: payload and csb are BitWriters. It writes at most a raw block, and
                        exactly csb_bits
        decode(csb, payload)   returns the block from two BitReaders, or None for bits that encode() never writes

    and may have

        measure(pixels) returns the payload bits that encode() writes. Without it, encode() counts them
        begin_frame(frame, pixels)   before the first block of frame number `frame`. pixels is None unless whole_frame
        write_tables(out), read_tables(tables, bits)   the bits that go with a frame, on the sides of encoder and decoder.
                        read_tables() may return False to refuse them

    A block is an 8×8 array like a frame: 8×8×4 uint8, or 8×8 uint16 or uint32. Pixels beyond the edge repeat the nearest one.
    An exception leaves Engine.process() as it is, and ends the use of that engine.
    """

    name: str = ""
    label: str = ""                #: for reports; by default the name
    family: str = "python"
    summary: str = ""
    source: str = "Python"
    keys: Sequence[Key] = ()
    csb_bits: int = 0
    eight_bit_only: bool = False   #: engines of other formats leave the scheme out
    whole_frame: bool = False      #: begin_frame() gets the pixels of the frame
    every_block: bool = False      #: encode() or measure() sees every block; else a block of one colour that repeats is skipped

    def __init__(self, values: dict[str, Any], format: str, pixel_bits: int, tile_side: int, burst_bits: int) -> None:
        self.values = values          #: by key
        self.format = format          #: "RGBA8", "RGBX8", "RGB565" or "RGB10A2"
        self.pixel_bits = pixel_bits  #: 32 or 16
        self.tile_side = tile_side
        self.burst_bits = burst_bits

    def begin_frame(self, frame: int, pixels: numpy.ndarray | None) -> None:
        """Does nothing."""

    def write_tables(self, out: BitWriter) -> None:
        """Writes no tables."""

    def read_tables(self, tables: BitReader, bits: int) -> bool | None:
        """Accepts no tables."""
        return bits == 0

    def words(self, pixels: numpy.ndarray) -> numpy.ndarray:
        """Returns the pixels as uint32 words in raster order, 64 for a block."""
        pixels = numpy.ascontiguousarray(pixels)
        return pixels.view("<u4").reshape(-1) if pixels.dtype == numpy.uint8 else pixels.reshape(-1).astype(numpy.uint32)

    def pixels(self, words: numpy.ndarray) -> numpy.ndarray:
        """Returns 64 words as a block."""
        words = numpy.ascontiguousarray(words, dtype="<u4").reshape(8, 8)
        if self.format == "RGB565":
            return words.astype(numpy.uint16)
        return words if self.format == "RGB10A2" else words.view(numpy.uint8).reshape(8, 8, 4)


def register_scheme(scheme: type[Scheme]) -> type[Scheme]:
    """Adds a class to the schemes; works as a decorator. A class of the same name and keys takes the place of the earlier
    one in engines made from now on, so that a notebook's cell can run again. Raises Error for a class that lacks a
    part, a name that is taken, or other keys."""
    for part in ("encode", "decode"):
        if not callable(getattr(scheme, part, None)):
            raise Error(f"scheme '{scheme.name}': the class {scheme.__name__} has no {part}()")
    if not issubclass(scheme, Scheme):
        raise Error(f"scheme '{scheme.name}': the class {scheme.__name__} must derive from tilepress.Scheme")
    earlier = _native.python_class(scheme.name)
    if earlier is not None and tuple(earlier.keys) != tuple(scheme.keys):
        raise Error(f"scheme '{scheme.name}': registered with other keys: choose another name, or start Python again")
    if not scheme.label:
        scheme.label = scheme.name
    _native.register_class(scheme.name, scheme)
    return scheme
