#!/usr/bin/env python3
"""Every installed file belongs to a package, and every file that names the version names the same one.

Usage: packages_test.py SOURCE_FOLDER"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1])
faults = []


def check_components():
    packages = (ROOT / "tools/packaging/packages.cmake").read_text()
    components = set(re.findall(r"^set\(CPACK_DEBIAN_([A-Z]+)_PACKAGE_NAME", packages.replace("  set(", "set("), re.M))
    assert components == {"COMMAND", "CODEC", "PYTHON"}, components
    rules = 0
    for folder in ("codec", "interposer", "replay", "tools"):
        for path in (ROOT / folder).rglob("CMakeLists.txt"):
            for rule in re.findall(r"^ *install\(((?:[^()]|\([^()]*\))*)\)", path.read_text(), re.M):
                rules += 1
                # Each destination has a component of its own.
                named = re.findall(r"COMPONENT (\w+)", rule)
                if len(named) != max(1, rule.count("DESTINATION")) or not {name.upper() for name in named} <= components:
                    faults.append(f"{path.relative_to(ROOT)}: no package for: install({' '.join(rule.split())})")
    assert rules > 15, rules


def check_versions():
    """The tree agrees with itself. A tree with one different version fails with a line for each file."""
    done = subprocess.run([ROOT / "tools/release", "--check"], capture_output=True, text=True, timeout=60)
    if done.returncode != 0 or done.stderr:
        faults.append(done.stderr)
    version = done.stdout.split()[-1]
    with tempfile.TemporaryDirectory() as name:
        tree = Path(name)
        (tree / "tools").mkdir()
        for file in ("CMakeLists.txt", "CITATION.cff", "CHANGELOG.md", "README.md", "tools/release"):
            shutil.copy(ROOT / file, tree / file)
        citation = tree / "CITATION.cff"
        citation.write_text(citation.read_text().replace(f"version: {version}", "version: 9.9"))
        done = subprocess.run([tree / "tools/release", "--check"], capture_output=True, text=True, timeout=60)
        for line in (f"CMakeLists.txt: says {version}", "CITATION.cff: says 9.9", f"CHANGELOG.md: says {version}"):
            if f"tilepress: release: {line}\n" not in done.stderr or done.returncode != 1:
                faults.append(f"expected the line '{line}', got: {done.stderr}")


def check_zenodo():
    zenodo = json.loads((ROOT / ".zenodo.json").read_text())
    citation = (ROOT / "CITATION.cff").read_text()
    for text in (f'title: "{zenodo["title"]}"', f"license: {zenodo['license']}", f"keywords: [{', '.join(zenodo['keywords'])}]",
                 *(f"- name: {creator['name']}" for creator in zenodo["creators"])):
        if text not in citation:
            faults.append(f".zenodo.json and CITATION.cff differ: {text}")


check_components()
check_versions()
check_zenodo()
for fault in faults:
    print("FAULT:", fault)
sys.exit(1 if faults else 0)
