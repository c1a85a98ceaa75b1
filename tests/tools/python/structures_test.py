"""FVC, CCD and Algorithm 1: what they show is what the engine uses."""
import numpy
import pytest

import tilepress


@pytest.mark.parametrize("keys", ["fvc=64", "fvc=16,policy=lru", "fvc=128,ways=4,policy=random", "fvc=32,sample=7", "fvc=512"])
def test_the_ccd_of_a_frame_is_the_rccd_of_the_next(frames, keys):
    """An rCCD has a valid bit and a colour per slot."""
    engine = tilepress.Engine(f"dcp:{keys}")
    fvc = tilepress.Fvc(f"dcp:{keys}")
    figures = engine.process(frames[0])[f"dcp:{keys}"]
    ccd = fvc.collect(frames[0]).ccd()
    tables = engine.process(frames[1], surfaces=True).surfaces[f"dcp:{keys}"].tables
    bits = numpy.unpackbits(numpy.frombuffer(tables, numpy.uint8))[:33 * ccd.entries].reshape(ccd.entries, 33)
    colors = bits[:, 1:].astype(numpy.uint64) @ (1 << numpy.arange(31, -1, -1, dtype=numpy.uint64))
    assert (colors[bits[:, 0] == 1] == ccd.colors).all()
    assert fvc.coverage == pytest.approx(figures.fvc_coverage)
    assert fvc.samples == -(-200 * 320 // (7 if "sample" in keys else 1)) or "sample" in keys
    entry_colors, entry_counts = fvc.entries
    assert sorted(entry_counts[entry_counts > 0]) == sorted(ccd.counts)
    assert (numpy.diff(ccd.counts.astype(int)) <= 0).all()


def test_a_ccd_finds_the_index_of_each_pixel():
    frame = numpy.zeros((4, 4, 4), numpy.uint8)
    frame[0, 0] = (1, 2, 3, 4)
    frame[0, 1:3] = (9, 9, 9, 9)
    ccd = tilepress.Fvc("dcp:fvc=4").collect(frame).ccd()
    assert ccd.rgba.tolist() == [[0, 0, 0, 0], [9, 9, 9, 9], [1, 2, 3, 4]]
    assert ccd.counts.tolist() == [13, 2, 1]
    assert (ccd.samples, ccd.coverage, ccd.index_bits) == (16, 1.0, 2)
    frame[3, 3] = 77
    assert ccd.indices(frame)[[0, 0, 0, 3], [0, 1, 3, 3]].tolist() == [2, 1, 0, -1]


def test_algorithm_1_on_derived_counts():
    """1000 pixels of 32 bits. 2 colours cover 900: 900 · 1 + 100 · 32 = 4100. 4 cover 960: 960 · 2 + 40 · 32 = 3200. The
    8 of round 3 cover 960 too: 960 · 3 + 40 · 32 = 4160."""
    found = tilepress.Algorithm1.predict([600, 300, 40, 20], 1000, max_width=3)
    assert [(each.width, each.covered_pixels, each.bits) for each in found.rounds] == [
        (0, 600, 400 * 32), (1, 900, 4100), (2, 960, 3200), (3, 960, 4160)]
    assert (found.width, found.entries) == (2, 4)
    assert tilepress.Algorithm1.predict([], 1000).width == 0


def test_adcp_takes_the_size_that_algorithm_1_predicts(frames):
    engine = tilepress.Engine("adcp")
    engine.process(frames[0])
    predicted = tilepress.Fvc("adcp").collect(frames[0]).ccd().algorithm1()
    assert engine.process(frames[1])["adcp"].palette_bits == 33 * predicted.entries


def test_color_counts_hold_every_pixel(frames):
    colors, counts = tilepress.color_counts(frames[0])
    assert counts.sum() == 200 * 320 and len(set(colors.tolist())) == len(colors)
    words, expected = numpy.unique(frames[0].view("<u4"), return_counts=True)
    assert dict(zip(colors.tolist(), counts.tolist())) == dict(zip(words.tolist(), expected.tolist()))
    assert tilepress.color_text(0x04030201) == "#01020304"


def test_rgb565(frames):
    words = numpy.arange(64, dtype=numpy.uint16).reshape(8, 8) // 16
    ccd = tilepress.Fvc("vdcp:fvc=4", format="rgb565").collect(words).ccd()
    assert sorted(ccd.colors.tolist()) == [0, 1, 2, 3] and (ccd.indices(words) >= 0).all()
    assert ccd.algorithm1().rounds[0].bits == 48 * 16


def test_schemes_without_an_fvc_are_refused():
    with pytest.raises(tilepress.Error, match="scheme 'ras': has no FVC"):
        tilepress.Fvc("ras")


def test_energy_saving_is_the_papers():
    """1 − 1/4 − 4.83/451.2"""
    assert tilepress.energy_saving(4) == pytest.approx(0.739295, abs=1e-6)
