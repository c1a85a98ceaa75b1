#!/usr/bin/env python3
"""Writes the CSV files and study.json of a finished study, with numbers that follow from formulas.

make_study.py FOLDER FIGURES_TOML [WORKLOADS_PER_CATEGORY]

Workload w (0, 1, ...) of a category has the rate BASE[category] * (1 + w / 4) * FACTOR[configuration], and a tenth more without
bursts. Harmonic means are computed here from these rates, apart from the code under test.
"""
import csv
import json
import math
import sys
import tomllib
from pathlib import Path

BASE = {"UI": 4.0, "2D": 2.5, "3D": 1.5}
AXES = {
    "ccd": ("dcp", "fvc", [16, 32, 64, 128, 256, 512]), "fvc": ("vdcp", "fvc", [16, 32, 64, 128, 256, 512]),
    "ways": ("vdcp", "ways", [1, 2, 4, 8, 16, 32]), "policy": ("vdcp", "policy", ["lfc", "2lfc", "lru", "random"]),
    "sample": ("vdcp", "sample", [1, 4, 16, 64, 256, 1024, 4096, 16384]), "period": ("vdcp", "period", [1, 2, 5, 10, 20, 30, 40, 50, 60]),
}
TITLES = {"ccd": "CCD entries", "fvc": "FVC entries", "ways": "FVC associativity", "policy": "FVC replacement policy",
          "sample": "Pixel sampling, 1:n", "period": "Frame sampling period"}
DEFAULTS = {"fvc": "64", "ways": "full", "policy": "lfc", "sample": "1", "period": "1"}
SCHEMES = {"dcp": 0.8, "adcp": 0.9, "vdcp": 1.0, "huffdcp": 0.95, "ras": 0.6, "ras:ycocg=1": 0.55, "red": 0.55, "hdcp": 1.3}
SUMS = ["frames", "blocks", "raw_bits", "payload_bits", "bursts", "burst_bits", "csb_bits", "palette_bits", "extra_bits", "moved_bits"]
RATES = ["rate", "rate_payload", "rate_with_extra", "fvc_coverage", "fvc_relative_coverage", "vdcp_blocks", "ras_blocks", "raw_blocks", "energy_nj"]


def factor(configuration):
    """What a configuration multiplies its workload's rate with."""
    scheme, _, keys = configuration.partition(":")
    if configuration in SCHEMES:
        return SCHEMES[configuration]
    key, _, value = keys.partition("=")
    ratio = {"fvc": lambda v: 1 + 0.02 * math.log2(int(v) / 64), "ways": lambda v: 0.7 + 0.04 * math.log2(int(v)),
             "policy": lambda v: {"2lfc": 0.998, "lru": 0.58, "random": 0.55}[v], "sample": lambda v: 1 - 0.015 * math.log2(int(v)) / 4,
             "period": lambda v: max(0.43, 1 - 0.03 * (int(v) - 1))}[key](value)
    return SCHEMES[scheme] * ratio


def configurations():
    names = list(SCHEMES)
    axes = []
    for name, (scheme, key, values) in AXES.items():
        own = [scheme if DEFAULTS[key] == str(value) else f"{scheme}:{key}={value}" for value in values]
        axes.append({"name": name, "title": TITLES[name], "scheme": scheme, "key": key, "values": values, "fixed": "", "configurations": own})
        names += [text for text in own if text not in names]
    return names, axes


def workloads(per_category):
    return [(f"{category.lower()}-app-{w}", category, w) for category in BASE for w in range(per_category)]


def rate_of(category, w, configuration):
    # A large table helps some workloads and hurts others.
    tilt = 0.03 * (w % 3 - 1) * (math.log2(int(configuration.split("fvc=")[1]) / 64) if "fvc=" in configuration else 0)
    return BASE[category] * (1 + w / 4) * (factor(configuration) + tilt)


def coverage_of(category, w):
    return min(0.97, {"UI": 0.8, "2D": 0.6, "3D": 0.3}.get(category, 0.5) + 0.02 * w)


def relative_coverage_of(configuration):
    return 0.94 + 0.008 * (math.log2(int(configuration.split("fvc=")[1])) - 4 if "fvc=" in configuration else 2)


def harmonic(values):
    return len(values) / sum(1 / value for value in values)


def median(values):
    values = sorted(values)
    half = len(values) // 2
    return values[half] if len(values) % 2 else (values[half - 1] + values[half]) / 2


def write_rows(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def key_cells(configuration):
    scheme, _, keys = configuration.partition(":")
    given = dict(pair.split("=") for pair in keys.split(",") if pair)
    family = scheme in ("dcp", "adcp", "vdcp", "huffdcp", "hdcp")
    return [given.get(key, default) if family else "" for key, default in DEFAULTS.items()] + [given.get("ycocg", "0" if scheme == "ras" else "")]


def result_rows(names, per_category):
    for workload, category, w in workloads(per_category):
        for name in names:
            rate = rate_of(category, w, name)
            raw, scheme = 2048 * 3600 * 10, name.partition(":")[0]
            moved = round(raw / rate)
            hybrid = [20000 + 100 * w, 16000 - 100 * w, 6000] if scheme == "hdcp" else ["", "", ""]
            dcp = scheme in ("dcp", "adcp", "vdcp", "huffdcp", "hdcp")
            yield [workload, category, name, scheme, *key_cells(name), 10, 36000, raw, moved, moved // 128, moved, 0, 0, 0, moved, rate,
                   rate * 1.1, rate, coverage_of(category, w) if dcp else "", relative_coverage_of(name) if dcp else "", *hybrid, ""]


def mean_rows(names, per_category):
    for category in [*BASE, "all"]:
        members = [(c, w) for _, c, w in workloads(per_category) if category in (c, "all")]
        for name in names:
            rates = [rate_of(c, w, name) for c, w in members]
            payload = [rate * 1.1 for rate in rates]
            dcp = name.partition(":")[0] not in ("ras", "red")
            yield [category, name, name.partition(":")[0], *key_cells(name), len(members), harmonic(rates), harmonic(payload),
                   min(rates), median(rates), max(rates), min(payload), median(payload), max(payload),
                   sum(coverage_of(c, w) for c, w in members) / len(members) if dcp else "", relative_coverage_of(name) if dcp else ""]


def frame_change(category, w, frame):
    size = {"UI": 0.12, "2D": 0.35, "3D": 0.7}.get(category, 0.2)
    return min(1, size * (1 + 0.4 * math.sin(frame * 0.7 + w))) if frame % 9 else min(1, 2 * size)


def write_study(folder, figures_toml, per_category=3, frames=40):
    folder.mkdir(parents=True, exist_ok=True)
    names, axes = configurations()
    keys = [*DEFAULTS, "ycocg"]
    write_rows(folder / "results.csv", ["workload", "category", "configuration", "scheme", *keys, *SUMS, *RATES], result_rows(names, per_category))
    write_rows(folder / "means.csv", ["category", "configuration", "scheme", *keys, "workloads", "rate_hmean", "rate_payload_hmean", "rate_min",
                                      "rate_median", "rate_max", "rate_payload_min", "rate_payload_median", "rate_payload_max",
                                      "fvc_coverage_mean", "fvc_relative_coverage_mean"], mean_rows(names, per_category))
    metrics, cdf, rates, about = [], [], [], []
    for workload, category, w in workloads(per_category):
        steep = {"UI": 0.8, "2D": 0.5, "3D": 0.1}.get(category, 0.4)
        for frame in range(frames):
            change = frame_change(category, w, frame)
            metrics.append([workload, category, frame, 0, 720, 1280, "RGBA8", int(frame == 0), 500 + frame, 5.5, change, change / 4, 0.8, 0.95, steep])
            if frame:
                rates.append([workload, category, frame, 0, "vdcp", rate_of(category, w, "vdcp") * (1 + 0.1 * math.sin(frame)),
                              rate_of(category, w, "vdcp") * 1.1, min(1, coverage_of(category, w) * (1 + 0.03 * math.cos(frame)))])
        for colors in [*range(1, 11), *(m * 10 ** p for p in range(1, 5) for m in range(2, 11))]:
            cdf.append([workload, category, colors, 1 - (1 - steep) ** (math.log(1 + colors) / math.log(101))])
        shown = [frame_change(category, w, frame) for frame in range(1, frames)]
        about.append([workload, category, "done", "", f"traces/{workload}.trace", frames, 1, 720, 1280, "RGBA8", 520, {"UI": 4.6, "2D": 8, "3D": 13}.get(category, 6) + w / 8,
                      sum(shown) / len(shown), sum(shown) / len(shown) / 4, coverage_of(category, w), 0.95, steep])
    about.append(["video-wall", "UI", "unsupported", "surface 0 is RGB565", "traces/video-wall.trace", 0, *[""] * 11])
    write_rows(folder / "frame_metrics.csv", ["workload", "category", "frame", "surface", "width", "height", "format", "warmup", "unique_colors", "entropy",
                                              "pixel_change", "color_change", "fvc_coverage", "fvc_relative_coverage", "top100_coverage"], metrics)
    write_rows(folder / "color_cdf.csv", ["workload", "category", "colors", "pixels_share"], cdf)
    write_rows(folder / "frame_rates.csv", ["workload", "category", "frame", "surface", "configuration", "rate", "rate_payload", "fvc_coverage"], rates)
    write_rows(folder / "workloads.csv", ["workload", "category", "status", "reason", "source", "frames", "surfaces", "width", "height", "format",
                                          "unique_colors", "entropy", "pixel_change", "color_change", "fvc_coverage", "fvc_relative_coverage",
                                          "top100_coverage"], about)
    figures = tomllib.loads(Path(figures_toml).read_text(encoding="utf-8"))["figure"]
    study = {"name": "paper", "title": "A study of formulas", "options": {"tile": 32, "burst": 128},
             "categories": [{"name": "UI", "title": "UI applications"}, {"name": "2D", "title": "2D applications"}, {"name": "3D", "title": "3D games"}],
             "axes": axes, "baseline": "vdcp", "figures": figures, "version": "0.1.0"}
    (folder / "study.json").write_text(json.dumps(study, indent=1) + "\n", encoding="utf-8")
    (folder / "provenance.json").write_text(json.dumps({"workloads": [{"workload": "ui-app-0", "gl_renderer": "llvmpipe (LLVM 15.0.6, 256 bits)", "gl_version": "4.5 Mesa 22.3.6"}]}) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write_study(Path(sys.argv[1]), sys.argv[2], *map(int, sys.argv[3:4]))
