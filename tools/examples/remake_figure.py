#!/usr/bin/env python3
"""Remakes the paper's figure "Compression rates of workloads" from the CSV files of runs.

Usage: remake_figure.py RUN... -o figure.pdf [--payload]

RUN is a run directory, or a folder that holds some. The workloads stand as in the paper: by category, in it by the rate of
baseline DCP, smallest first. By default the effective rates are drawn (bursts, CSB and palettes counted); --payload draws the
paper's first comparison, payload and CSB alone. Needs python3-pandas and python3-matplotlib.
"""
import argparse
import json
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pandas as pd

ORDER = {"UI": 0, "2D": 1, "3D": 2}
MARKERS = "os^vDPX*<>"


def find_runs(path):
    if (path / "schemes.csv").exists():
        return [path]
    return sorted(found.parent for found in path.rglob("schemes.csv"))


def load_run(folder):
    """The run's sums per scheme, without the warm-up frames."""
    rows = pd.read_csv(folder / "schemes.csv")
    info = json.loads((folder / "run.json").read_text()) if (folder / "run.json").exists() else {}
    burst_bits = info.get("options", {}).get("burst", 128)
    rows = rows[rows["warmup"].astype(str).isin(["0", "false", "False"])]
    sums = rows.groupby("scheme", sort=False)[["raw_bits", "payload_bits", "bursts", "csb_bits", "palette_bits"]].sum().reset_index()
    sums["rate_payload"] = sums["raw_bits"] / (sums["payload_bits"] + sums["csb_bits"])
    sums["rate"] = sums["raw_bits"] / (sums["bursts"] * burst_bits + sums["csb_bits"] + sums["palette_bits"])
    sums["workload"] = re.sub(r"-\d+$", "", folder.resolve().name)
    sums["category"] = info.get("category", "")
    return sums


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN")
    parser.add_argument("-o", "--output", type=Path, required=True, help="the figure, in a format that matplotlib writes")
    parser.add_argument("--payload", action="store_true", help="rates without bursts and palettes")
    options = parser.parse_args()

    folders = [folder for path in options.runs for folder in find_runs(path)]
    if not folders:
        sys.exit("remake_figure.py: no run (no schemes.csv) in " + " ".join(map(str, options.runs)))
    column = "rate_payload" if options.payload else "rate"
    sums = pd.concat([load_run(folder).assign(run=i) for i, folder in enumerate(folders)])
    table = sums.pivot(index="run", columns="scheme", values=column)[list(dict.fromkeys(sums["scheme"]))]
    about = sums.groupby("run")[["workload", "category"]].first()
    baseline = sums[sums["scheme"] == ("dcp" if "dcp" in table else table.columns[0])].set_index("run")["rate_payload"]
    order = about.assign(group=about["category"].map(ORDER).fillna(3), rate=baseline).sort_values(["group", "category", "rate"]).index

    figure, axes = plt.subplots(figsize=(max(6, 0.28 * len(order) + 2), 4), layout="constrained")
    for i, scheme in enumerate(table.columns):
        axes.plot(range(len(order)), table.loc[order, scheme], MARKERS[i % len(MARKERS)], markersize=5, label=scheme)
    categories = about.loc[order, "category"].tolist()
    for i, category in enumerate(categories):
        if i > 0 and category != categories[i - 1]:
            axes.axvline(i - 0.5, color="0.7", linewidth=1)
        if i == 0 or category != categories[i - 1]:
            axes.text(i - 0.4, 0.98, category, va="top", transform=axes.get_xaxis_transform())
    axes.set_xticks(range(len(order)), about.loc[order, "workload"], rotation=90, fontsize=8)
    axes.set_ylabel("compression rate (raw bits / moved bits)" if not options.payload else "compression rate (raw / payload and CSB bits)")
    axes.set_ylim(bottom=0)
    axes.grid(axis="y", color="0.9")
    axes.legend(ncols=len(table.columns), fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    figure.savefig(options.output)

    means = sums.groupby(["category", "scheme"], sort=False)[column].agg(lambda rates: len(rates) / (1 / rates).sum())
    print("Harmonic means:")
    print(means.unstack().reindex(columns=table.columns).to_string(float_format=lambda rate: f"{rate:.3f}"))


if __name__ == "__main__":
    main()
