"""Schemes of a plugin, which package_test.sh has built, beside the library's own."""
import os
from pathlib import Path

import pytest

import tilepress

PLUGIN = os.environ["TILEPRESS_TEST_PLUGIN"]


def test_its_schemes_are_verified_like_any_other(frames):
    assert tilepress.load_plugin(PLUGIN) == ["rowpal"]
    assert tilepress.load_plugin(Path(PLUGIN)) == ["rowpal"], "a second time"
    result = tilepress.compress(frames[:2], ["rowpal:slots=4", "vdcp"], verify=True)
    for figures in result.totals.values():
        assert (figures.checked_blocks, figures.mismatched_blocks) == (1000, 0)
    assert {each.name: each.source for each in tilepress.schemes()}["rowpal"] == "a plugin"


def test_what_is_no_plugin_is_named(tmp_path):
    text = tmp_path / "text.so"
    text.write_text("no library")
    for path, reason in ((text, "file too short"), (tmp_path / "absent.so", "No such file or directory")):
        with pytest.raises(tilepress.Error, match=f"{path}: .*{reason}") as raised:
            tilepress.load_plugin(path)
        assert raised.value.kind == "file"
