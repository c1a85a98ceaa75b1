"""Readers of run folders and studies."""
import json

import numpy
import pytest

import tilepress


@pytest.fixture
def folder(tmp_path):
    run = tmp_path / "out" / "glmark2-es2-7"
    (run / "heatmaps").mkdir(parents=True)
    (run / "schemes.csv").write_text('frame,scheme,warmup,rate,raw_toggles\n0,ras,1,2.5,\n1,"vdcp:fvc=16,ways=4",0,3,17\n')
    (run / "frames.csv").write_text("frame,format\n0,RGBA8\n")
    (run / "run.json").write_text(json.dumps({"state": "complete"}))
    (run / "heatmaps" / "0-5-ras.pgm").write_bytes(b"P5\n# scheme ras\n2 1\n2048\n\x01\x02\x00\x0a")
    return tmp_path / "out"


def test_a_run_is_read_as_data_frames(folder):
    pytest.importorskip("pandas")
    run = tilepress.read_run(folder)
    assert run.about["state"] == "complete" and run.folder.name == "glmark2-es2-7"
    assert run.schemes.groupby("scheme")["rate"].sum().to_dict() == {"ras": 2.5, "vdcp:fvc=16,ways=4": 3}
    assert run.schemes["raw_toggles"].isna().tolist() == [True, False]
    assert run.frames["format"].tolist() == ["RGBA8"]


def test_a_run_is_read_without_pandas(folder):
    run = tilepress.read_run(folder, pandas=False)
    assert run.schemes[0] == {"frame": 0, "scheme": "ras", "warmup": 1, "rate": 2.5, "raw_toggles": None}
    assert run.schemes[1]["scheme"] == "vdcp:fvc=16,ways=4"


def test_heat_maps(folder):
    run = tilepress.read_run(folder, pandas=False)
    bits = run.heat_map(5, "ras")
    assert bits.tolist() == [[258, 10]] and bits.dtype == numpy.uint16
    with pytest.raises(FileNotFoundError, match="no heat map of frame 6"):
        run.heat_map(6, "ras")
    torn = folder / "torn.pgm"
    torn.write_bytes(b"P5\n# scheme ras\n2 1\n2048\n\x01")
    with pytest.raises(ValueError, match="not a heat map"):
        tilepress.read_heat_map(torn)


def test_several_runs_or_none(folder):
    second = folder / "second-8"
    second.mkdir()
    (second / "schemes.csv").write_text("frame\n")
    assert [run.folder.name for run in tilepress.read_runs(folder, pandas=False)] == ["glmark2-es2-7", "second-8"]
    with pytest.raises(ValueError, match="holds 2 runs"):
        tilepress.read_run(folder)
    with pytest.raises(FileNotFoundError, match="no run: there is no schemes.csv"):
        tilepress.read_run(folder / "nowhere")


def test_a_study_is_read(tmp_path):
    (tmp_path / "figures").mkdir()
    for name in ("results", "means", "workloads", "figures/fvc-size"):
        (tmp_path / f"{name}.csv").write_text("workload,rate\nnone,2\n")
    study = tilepress.read_study(tmp_path)
    assert list(study.results["workload"]) == ["none"] and list(study.figures) == ["fvc-size"]
    assert tilepress.read_study(tmp_path, pandas=False).means == [{"workload": "none", "rate": 2}]
    with pytest.raises(FileNotFoundError, match="no study: there is no results.csv"):
        tilepress.read_study(tmp_path / "figures")
