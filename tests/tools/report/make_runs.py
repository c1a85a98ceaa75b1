#!/usr/bin/env python3
"""Makes run directories with plausible rows, the same for the same arguments: make_runs.py DIR [--runs N] [--frames N]."""
import argparse
import json
import math
import random
from pathlib import Path

SCHEMES = ["dcp", "adcp", "vdcp", "huffdcp", "ras", "red", "hdcp"]
CATEGORIES = ["UI", "UI", "2D", "3D"]
BURST_BITS = 128
FRAMES_HEADER = ("frame,surface,width,height,format,warmup,time_ns,unique_colors,entropy,pixel_change,color_change,fvc_coverage,"
                 "fvc_relative_coverage,top100_coverage,readback_ns,encode_ns")
SCHEMES_HEADER = ("frame,surface,scheme,warmup,blocks,raw_bits,payload_bits,bursts,csb_bits,palette_bits,rate_payload,rate,"
                  "extra_bits,vdcp_blocks,ras_blocks")


def scheme_row(rng, scheme, frame, surface, blocks, share):
    """One row of schemes.csv. `share`: how much of the picture palettes hold, 0..1."""
    raw = blocks * 2048
    part = {"dcp": 0.19, "adcp": 0.12, "vdcp": 0.07, "huffdcp": 0.08}.get(scheme)
    if part is not None:
        payload = 0.02 * raw if share > 0.999 else raw * (1 - share + share * part)
    elif scheme == "ras":
        payload = raw * (0.25 + 0.25 * (1 - share))
    elif scheme == "red":
        payload = raw * (0.2 + 0.7 * (1 - share))
    else:
        payload = raw * (0.08 + 0.3 * (1 - share))
    payload = int(min(raw, payload * rng.uniform(0.95, 1.05)))
    if frame == 0 and part is not None:
        payload = raw
    bursts = min(16 * blocks, math.ceil(payload / BURST_BITS * 1.1))
    csb = blocks * {"vdcp": 48, "ras": 2, "red": 2, "hdcp": 80}.get(scheme, 16)
    palette = {"adcp": 528, "huffdcp": 2496, "ras": 0, "red": 0}.get(scheme, 2112)
    vdcp_blocks = int(blocks * share) if scheme == "hdcp" else 0
    ras_blocks = blocks - vdcp_blocks if scheme == "hdcp" else 0
    moved = bursts * BURST_BITS + csb + palette
    return [frame, surface, scheme, int(frame == 0), blocks, raw, payload, bursts, csb, palette, repr(raw / (payload + csb)),
            repr(raw / moved), 0, vdcp_blocks, ras_blocks]


def make_run(folder, seed, frames, surfaces, category):
    rng = random.Random(seed)
    folder.mkdir(parents=True, exist_ok=True)
    frame_rows, scheme_rows = [FRAMES_HEADER], [SCHEMES_HEADER]
    base = rng.uniform(0.25, 0.98)
    for frame in range(frames):
        for surface in range(surfaces):
            width, height = (720, 1280) if surface == 0 else (240, 136)
            blocks = ((width + 7) // 8) * ((height + 7) // 8)
            wave = 0.08 * math.sin(frame / 17 + seed) - (0.3 if frame % 97 == 50 else 0)
            share = min(1.0, max(0.02, base + wave + rng.uniform(-0.01, 0.01)))
            change = 0.0 if frame == 0 else min(1.0, abs(wave) * 3 + rng.uniform(0, 0.05))
            frame_rows.append(",".join(map(str, [
                frame, surface, width, height, "RGBA8", int(frame == 0), frame * 16666667, int(20 + (1 - share) * 60000),
                repr(1 + 13 * (1 - share)), repr(change), repr(change * 0.3), repr(share), repr(min(1, share + 0.02)),
                repr(min(1.0, share + 0.03)), rng.randrange(200000, 900000), rng.randrange(3000000, 9000000)])))
            for scheme in SCHEMES:
                scheme_rows.append(",".join(map(str, scheme_row(rng, scheme, frame, surface, blocks, share))))
    (folder / "frames.csv").write_text("\n".join(frame_rows) + "\n")
    (folder / "schemes.csv").write_text("\n".join(scheme_rows) + "\n")
    info = {"schema_version": 1, "state": "finished", "started": "2026-01-02T03:04:05Z", "command": ["demo", "--seed", str(seed)],
            "program": "demo", "pid": 1000 + seed, "via": "preload", "api": "EGL", "gl_vendor": "Mesa",
            "gl_renderer": "llvmpipe (LLVM 15.0.6, 256 bits)", "gl_version": "OpenGL ES 3.2 Mesa 22.3.6",
            "options": {"schemes": SCHEMES, "tile": 32, "burst": BURST_BITS},
            "counts": {"seen": frames, "captured": frames, "dropped": 0, "skipped": 0, "unsupported": 0, "not_captured": 0}}
    if category:
        info["category"] = category
    (folder / "run.json").write_text(json.dumps(info, indent=2))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dir", type=Path)
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--frames", type=int, default=120)
    parser.add_argument("--surfaces", type=int, default=1)
    parser.add_argument("--no-category", action="store_true")
    options = parser.parse_args()
    for i in range(options.runs):
        category = None if options.no_category else CATEGORIES[i % len(CATEGORIES)]
        make_run(options.dir / f"workload{i:02d}-{1000 + i}", i, options.frames, options.surfaces, category)


if __name__ == "__main__":
    main()
