#!/usr/bin/env python3
"""Draws the figures of a study as SVG and PDF.

Usage: draw_figures.py STUDY

STUDY is the folder that `tilepress study` wrote. The script reads figures/figures.json and figures/NAME.csv and writes
figures/NAME.svg and figures/NAME.pdf, at the width of a column of two-column papers. A figure whose rows have not changed is
not drawn again. Equal rows give equal files. Needs python3-matplotlib.

Exit status: 0 done, 1 a figure could not be drawn, 3 matplotlib is missing.
"""
import csv
import hashlib
import io
import json
import os
import signal
import sys
import warnings
from pathlib import Path

from figure_drawings import KINDS, Drawing

SCRIPTS = ("draw_figures.py", "figure_drawings.py", "figure_styles.py")


def load_matplotlib():
    os.environ.setdefault("SOURCE_DATE_EPOCH", "0")
    warnings.simplefilter("ignore")
    import logging
    logging.disable(logging.CRITICAL)
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcdefaults()
    plt.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 7, "axes.labelsize": 7, "xtick.labelsize": 6.5, "ytick.labelsize": 6.5, "legend.fontsize": 6.5,
        "axes.linewidth": 0.6, "lines.linewidth": 1.1, "lines.markersize": 3.6, "grid.color": "0.88", "grid.linewidth": 0.5, "hatch.linewidth": 0.5,
        "text.parse_math": False, "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
        "legend.handlelength": 2.2, "legend.columnspacing": 1.2, "svg.fonttype": "path", "svg.hashsalt": "tilepress", "pdf.fonttype": 42,
        "savefig.dpi": 300, "figure.constrained_layout.h_pad": 0.02, "figure.constrained_layout.w_pad": 0.02})
    return plt


def draw(plt, folder, about, text, categories):
    drawing = Drawing(plt, about, list(csv.DictReader(io.StringIO(text, newline=""))), categories)
    figure = KINDS[about["kind"]](drawing)
    for ending, metadata in (("svg", {"Title": about["title"], "Date": None}), ("pdf", {"Title": about["title"], "CreationDate": None})):
        part = folder / f".{about['name']}.{ending}.part"
        figure.savefig(part, format=ending, metadata=metadata)
        part.replace(folder / f"{about['name']}.{ending}")
    plt.close(figure)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # end without a traceback
    folder = Path(sys.argv[1]) / "figures"
    document = json.loads((folder / "figures.json").read_text(encoding="utf-8"))
    record = folder / "drawn.json"
    try:
        drawn = json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        drawn = {}
    script = b"".join((Path(__file__).parent / file).read_bytes() for file in SCRIPTS)
    plt, status, now = None, 0, {}
    for about in document["figures"]:
        name = about["name"]
        text = (folder / f"{name}.csv").read_text(encoding="utf-8")
        digest = hashlib.sha256(script + json.dumps([about, document["categories"]]).encode() + text.encode()).hexdigest()
        if drawn.get(name) != digest or not all((folder / f"{name}.{ending}").exists() for ending in ("svg", "pdf")):
            if plt is None:
                try:
                    plt = load_matplotlib()
                except ImportError:
                    sys.exit(3)
            try:
                draw(plt, folder, about, text, document["categories"])
            except Exception as fault:  # one figure must not take the others along
                print(f"tilepress: {folder / name}: not drawn: {type(fault).__name__}: {fault}", file=sys.stderr)
                status = 1
                continue
        now[name] = digest
    record.write_text(json.dumps(now, indent=1) + "\n", encoding="utf-8")
    sys.exit(status)


if __name__ == "__main__":
    main()
