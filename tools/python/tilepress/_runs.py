"""Runs: the files that `tilepress run`, `replay`, `frames` and `study` leave, as tables.

A table is a pandas.DataFrame if pandas is installed, else a list with a dict per row. Empty fields are NaN or None.
"""
from __future__ import annotations

import csv
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy

Table = Any  #: pandas.DataFrame, or list[dict[str, int | float | str | None]]


def _value(text: str) -> int | float | str | None:
    if text == "":
        return None
    for number in (int, float):
        try:
            return number(text)
        except ValueError:
            pass
    return text


def _read_table(path: Path, pandas: bool | None) -> Table:
    if pandas is not False:
        try:
            import pandas as library
        except ImportError:
            if pandas:
                raise
        else:
            # "none" and the like are words of these files, not missing values.
            return library.read_csv(path, keep_default_na=False, na_values=[""])
    with open(path, newline="", encoding="utf-8") as file:
        return [{name: _value(text) for name, text in row.items()} for row in csv.DictReader(file)]


def _read_tables(folder: Path, pandas: bool | None) -> dict[str, Table]:
    return {path.stem: _read_table(path, pandas) for path in sorted(folder.glob("*.csv"))}


@dataclass(frozen=True)
class Run:
    """A run folder. A table that the run did not write raises KeyError."""

    folder: Path
    about: dict[str, Any]    #: run.json: command, options, totals, state; empty if the run wrote none
    tables: dict[str, Table] = field(repr=False)  #: every CSV file by name without .csv

    @property
    def schemes(self) -> Table:
        """schemes.csv: a row per frame, surface and scheme."""
        return self.tables["schemes"]

    @property
    def frames(self) -> Table:
        """frames.csv: a row per frame and surface."""
        return self.tables["frames"]

    @property
    def presents(self) -> Table:
        """presents.csv, of captured programs."""
        return self.tables["presents"]

    @property
    def surfaces(self) -> Table:
        """surfaces.csv, of captured programs."""
        return self.tables["surfaces"]

    def heat_map(self, frame: int, scheme: str, surface: int = 0) -> numpy.ndarray:
        """Returns the payload bits of each block, (blocks_y, blocks_x) uint16, of a run with --heatmaps.
        Raises FileNotFoundError."""
        for path in sorted((self.folder / "heatmaps").glob("*.pgm")):
            stem = path.stem.split("-")
            if [int(stem[0]), int(stem[1])] == [surface, frame]:
                name, bits = read_heat_map(path)
                if name == scheme:
                    return bits
        raise FileNotFoundError(f"{self.folder}: no heat map of frame {frame}, surface {surface}, scheme {scheme}: "
                                "run with --heatmaps every:1")


def read_heat_map(path: str | Path) -> tuple[str, numpy.ndarray]:
    """Returns scheme and bits of a file of heatmaps/: payload bits of each block, (blocks_y, blocks_x) uint16."""
    content = Path(path).read_bytes()
    try:
        magic, comment, size, _, values = content.split(b"\n", 4)
        width, height = map(int, size.split())
        bits = numpy.frombuffer(values, ">u2").reshape(height, width).astype(numpy.uint16)
    except ValueError:
        magic = comment = b""
    if magic != b"P5" or not comment.startswith(b"# scheme "):
        raise ValueError(f"{path}: not a heat map of tilepress")
    return comment[len(b"# scheme "):].decode(), bits


def read_run(folder: str | Path, *, pandas: bool | None = None) -> Run:
    """Reads a run folder, or the only run below a folder.

    pandas: True requires pandas, False returns lists of dicts, None takes pandas if it is installed.
    Raises FileNotFoundError if there is no run, ValueError if there are several.
    """
    found = read_runs(folder, pandas=pandas)
    if len(found) > 1:
        raise ValueError(f"{folder}: holds {len(found)} runs: use read_runs(), or name one of them")
    return found[0]


def read_runs(folder: str | Path, *, pandas: bool | None = None) -> list[Run]:
    """Reads every run folder at or below `folder`, in the order of their names."""
    top = Path(folder)
    found = [top] if (top / "schemes.csv").is_file() else sorted(path.parent for path in top.rglob("schemes.csv"))
    if not found:
        raise FileNotFoundError(f"{folder}: no run: there is no schemes.csv")
    return [Run(each, _read_json(each / "run.json"), _read_tables(each, pandas)) for each in found]


def _read_json(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


@dataclass(frozen=True)
class Study:
    """The folder of a study. A table that the study did not write raises KeyError."""

    folder: Path
    about: dict[str, Any] = field(repr=False)  #: provenance.json
    tables: dict[str, Table] = field(repr=False)  #: every CSV file by name without .csv
    figures: dict[str, Table] = field(repr=False)  #: figures/*.csv: the rows of each figure

    @property
    def results(self) -> Table:
        """results.csv: a row per workload and configuration."""
        return self.tables["results"]

    @property
    def means(self) -> Table:
        """means.csv: a row per category and configuration."""
        return self.tables["means"]

    @property
    def workloads(self) -> Table:
        """workloads.csv: a row per workload."""
        return self.tables["workloads"]


def read_study(folder: str | Path, *, pandas: bool | None = None) -> Study:
    """Reads the folder of `tilepress study`. pandas: as for read_run(). Raises FileNotFoundError."""
    top = Path(folder)
    if not (top / "results.csv").is_file():
        raise FileNotFoundError(f"{folder}: no study: there is no results.csv")
    return Study(top, _read_json(top / "provenance.json"), _read_tables(top, pandas), _read_tables(top / "figures", pandas))
