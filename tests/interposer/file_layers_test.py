#!/usr/bin/env python3
"""No two files need each other, directly or through others. A file is a source with its header, called by their stem.
It needs another file whose header it includes, or whose symbols its object file uses.

Usage: file_layers_test.py --sources FOLDER... [--objects OBJECT_FILE...]"""
import argparse
import re
import subprocess
from pathlib import Path


def included(folders):
    """Yields (file, other, what for) for every include in the folders."""
    for folder in folders:
        for source in sorted(Path(folder).rglob("*")):
            if source.suffix in (".c", ".cpp", ".h", ".S"):
                for name in re.findall(r'^#include ["<](.*\.h)[">]', source.read_text(), re.M):
                    yield source.stem, Path(name).stem, f"#include \"{name}\""


def used(objects):
    """Yields (file, other, symbol) for every global symbol that one object file takes from another."""
    owner, uses = {}, []
    command = ["nm", "-A", "-P", "-g", *objects]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout if objects else ""
    for line in listed.splitlines():
        path, symbol = line.rsplit(": ", 1)
        stem = Path(path).name.split(".")[0]  # CMake calls it NAME.c.o
        name, kind = symbol.split()[:2]
        if kind in "Uvw":
            uses.append((stem, name))
        else:
            owner[name] = stem
    for stem, name in uses:
        if name in owner:
            yield stem, owner[name], name


def cycle_in(needs):
    """Returns a path that ends where it starts, or None. `needs`: for each file, the files it needs."""
    done = set()

    def visit(path):
        file = path[-1]
        if file in path[:-1]:
            return path[path.index(file):]
        found = None if file in done else next(filter(None, (visit(path + [o]) for o in sorted(needs.get(file, ())))), None)
        done.add(file)
        return found

    return next(filter(None, (visit([file]) for file in sorted(needs))), None)


def main():
    assert cycle_in({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]
    assert cycle_in({"a": {"b", "c"}, "b": {"c"}}) is None
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sources", nargs="+", required=True)
    parser.add_argument("--objects", nargs="+", default=[])
    options = parser.parse_args()
    files = {path.stem for folder in options.sources for path in Path(folder).rglob("*")}
    reasons = {}
    uses = list(used(options.objects))
    assert uses or not options.objects, "the object files do not use each other"
    for file, other, reason in [*included(options.sources), *uses]:
        if file != other and file in files and other in files:
            reasons.setdefault((file, other), reason)
    needs = {}
    for file, other in reasons:
        needs.setdefault(file, set()).add(other)
    cycle = cycle_in(needs)
    if cycle:
        raise SystemExit("\n".join(f"{a} needs {b}: {reasons[a, b]}" for a, b in zip(cycle, cycle[1:])))
    print(f"{len(needs)} files, no cycle")


main()
