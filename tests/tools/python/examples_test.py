"""The examples of the page and the notebook run as they stand. The stubs name what the extension has."""
import ast
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import tilepress

PYTHON = Path(__file__).parents[3] / "tools" / "python"


def examples():
    blocks = (PYTHON / "README.md").read_text().split("\n\n    import ")
    for block in blocks[1:]:
        lines = ("    import " + block).splitlines()
        end = next((i for i, line in enumerate(lines) if line and not line.startswith("    ")), len(lines))
        yield textwrap.dedent("\n".join(lines[:end]))


def run(*command, **options):
    return subprocess.run([sys.executable, *map(str, command)], check=True, capture_output=True, text=True, **options).stdout


def test_the_first_example_prints_rates():
    first, _ = examples()
    assert [line.split()[:2] for line in run("-c", first).splitlines()] == [
        ["vdcp", "rate"], ["hdcp", "rate"], ["ras", "rate"]]


def test_the_scheme_of_the_page_restores_every_block():
    rate, mismatched = run("-c", list(examples())[1]).split()
    assert float(rate) > 1.5 and mismatched == "0"


def test_the_notebook_draws_its_figure(tmp_path):
    pytest.importorskip("matplotlib")
    run(PYTHON / "examples" / "fvc_size.py", "-o", "figure.png", cwd=tmp_path)
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_stubs_name_what_the_extension_has():
    stubs = ast.parse((Path(tilepress.__file__).parent / "_native.pyi").read_text())
    for node in stubs.body:
        if isinstance(node, ast.ClassDef):
            members = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
            found = getattr(tilepress._native, node.name)
            assert members - {"__init__"} == {name for name in vars(found) if not name.startswith("_") or name == "__bytes__"}
    named = {node.name for node in stubs.body if hasattr(node, "name")} | {"version"}
    assert named == {name for name in vars(tilepress._native) if not name.startswith("_")}


def test_all_that_is_public_has_a_docstring():
    for name in set(tilepress.__all__) - {"__version__"}:
        public = getattr(tilepress, name)
        assert public.__doc__, name
        for member, value in vars(public).items() if isinstance(public, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"
