#!/usr/bin/env python3
"""A family of schemes sees of another family its shared analyses alone: headers with a BlockAnalysis, and what those
headers include. The hybrid sees every family.

Usage: family_walls_test.py CODEC_FOLDER"""
import re
import sys
from pathlib import Path

codec = Path(sys.argv[1])
families = {path.parent.name for path in codec.glob("*/*_scheme.cpp")} - {"hybrid"}


def included(path):
    return re.findall(r'^#include "(.*)"', path.read_text(), re.M)


shared = set()
for family in families:
    for header in (codec / family).glob("*.h"):
        if "public BlockAnalysis" in header.read_text():
            shared |= {f"{family}/{header.name}", *included(header)}

walls_broken = [f"{source.relative_to(codec)} includes {name}" for family in sorted(families)
                for source in sorted((codec / family).glob("*")) if source.suffix in (".h", ".cpp")
                for name in included(source)
                if Path(name).parent.name in families - {family} and name not in shared]
assert {"dcp", "ras", "lcc"} <= families and {"dcp/ccd_view.h", "ras/ras_bits.h"} <= shared, (families, shared)
if walls_broken:
    raise SystemExit("\n".join(walls_broken))
print(f"{len(families)} families, no wall broken")
