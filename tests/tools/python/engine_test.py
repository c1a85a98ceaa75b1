"""Engine: arrays in, the library's figures out."""
import csv
import gc
import pickle
import threading
from pathlib import Path

import numpy
import pytest

import tilepress

GOLDEN = Path(__file__).parents[2] / "golden"


def golden_frames(name):
    image = pytest.importorskip("matplotlib.image")
    return [numpy.rint(image.imread(path) * 255).astype(numpy.uint8) for path in sorted((GOLDEN / name).glob("*.png"))]


def test_figures_are_those_of_the_independent_model():
    frames = golden_frames("odd")
    with open(GOLDEN / "expected.csv") as file:
        rows = [row for row in csv.DictReader(file) if row["set"] == "odd" and row["options"] == ""]
    result = tilepress.compress(frames, sorted({row["scheme"] for row in rows}))
    assert rows
    for row in rows:
        figures = result.frames[int(row["frame"])][row["scheme"]]
        for column in ("payload_bits", "bursts", "csb_bits", "palette_bits"):
            assert getattr(figures, column) == int(row[column]), row
    with open(GOLDEN / "metrics.csv") as file:
        for row in csv.DictReader(file):
            if row["set"] == "odd":
                metrics = result.frames[int(row["frame"])].metrics
                assert metrics.unique_colors == int(row["unique_colors"])
                assert metrics.entropy == pytest.approx(float(row["entropy"]), abs=1e-6)


def test_block_bits_add_up_and_surfaces_restore_the_frame(frames):
    engine = tilepress.Engine(["vdcp", "ras", "lcc"], verify=True)
    for frame in frames:
        result = engine.process(frame, block_bits=True, surfaces=True)
        for figures in result:
            bits, surface = result.block_bits[figures.scheme], result.surfaces[figures.scheme]
            assert (bits.shape, bits.dtype) == ((25, 40), numpy.uint16)
            assert bits.sum() == figures.payload_bits
            assert (bits == surface.block_bits).all()
            assert (figures.checked_blocks, figures.mismatched_blocks) == (1000, 0)
            assert (surface.decode() == frame).all()
            assert (surface.read(5, 7, 20, 30) == frame[7:37, 5:25]).all()
            assert (surface.read_block(3, 2) == frame[16:24, 24:32]).all()
            assert len(surface.payload(15, 11)) == -(-int(bits[11, 15]) // 8)
            assert surface.slots[11, 15, :len(surface.payload(15, 11))].tobytes() == surface.payload(15, 11)
            assert surface.slots.shape == (25, 40, surface.slot_bytes)
            assert surface.csb_bits * 1000 == figures.csb_bits and surface.table_bits == figures.palette_bits
            assert len(surface.tables) == -(-surface.table_bits // 8)
            assert surface.traffic["table_bursts"] == -(-surface.table_bits // 128)


def test_arrays_of_a_surface_outlive_it(frames):
    slots = tilepress.Engine("ras").process(frames[0], surfaces=True).surfaces["ras"].slots
    before = slots.sum()
    gc.collect()
    assert slots.sum() == before
    with pytest.raises(ValueError):
        slots[0, 0, 0] = 1


def figures_of(frames, **options):
    result = tilepress.compress(frames, ["vdcp", "hdcp"], frame_metrics=False, **options)
    return [each.to_dict() for frame in result for each in frame]


def test_rows_may_lie_any_distance_apart(frames):
    expected = figures_of(frames)
    wide = [numpy.concatenate([frame, frame], axis=1) for frame in frames]
    assert figures_of([frame[:, :320] for frame in wide]) == expected
    assert figures_of([frame[::-1].copy()[::-1] for frame in frames]) == expected
    assert figures_of([frame[..., [2, 1, 0, 3]].copy() for frame in frames], order="bgra") == expected
    assert figures_of(numpy.stack(frames)) == expected


@pytest.mark.parametrize("format, dtype, raw_bits", [("rgb565", numpy.uint16, 1024), ("rgb10a2", numpy.uint32, 2048)])
def test_other_formats_keep_their_bits(format, dtype, raw_bits):
    words = numpy.random.default_rng(1).integers(0, 20, (24, 36)).astype(dtype) * dtype(3000)
    engine = tilepress.Engine(["vdcp", "ras", "fpc"], format=format, verify=True)
    engine.process(words)
    result = engine.process(words, surfaces=True)
    assert list(result.schemes) == ["vdcp", "ras"]  # fpc takes 8-bit pixels only
    for figures in result:
        assert figures.raw_bits == 15 * raw_bits and figures.mismatched_blocks == 0
        decoded = result.surfaces[figures.scheme].decode()
        assert decoded.dtype == dtype and (decoded == words).all()


@pytest.mark.parametrize("change, line", [
    (lambda f: f[..., :3], "frame: shape (200, 320, 3) of uint8: RGBA8 frames are arrays of H×W×4 uint8"),
    (lambda f: f.astype(float), "frame: shape (200, 320, 4) of float64: RGBA8 frames are arrays of H×W×4 uint8"),
    (lambda f: f[:, ::2], "frame: the pixels of a row are not contiguous: pass numpy.ascontiguousarray(frame)"),
    (lambda f: f[:0], "frame: shape (0, 320, 4): sides are 1 to 65535 pixels"),
    (lambda f: f[:100], "frame: 320x100 pixels, but the surface of this engine has 320x200: make another engine"),
])
def test_other_arrays_are_refused_in_one_line(frames, change, line):
    engine = tilepress.Engine("ras")
    engine.process(frames[0])
    with pytest.raises(tilepress.Error) as error:
        engine.process(change(frames[1]))
    assert str(error.value) == line
    engine.process(frames[1])  # the engine goes on


@pytest.mark.parametrize("arguments, line", [
    ({"schemes": "vdcp:fcv=1"}, "scheme 'vdcp:fcv=1': unknown key 'fcv'"),
    ({"tile_side": 12}, "tile_side=12: must be a multiple of 8 from 8 to 4096"),
    ({"burst_bits": 100}, "burst_bits=100: must be a power of two from 16 to 2048"),
    ({"toggle_bits": 8}, "toggle_bits=8: must be 0, 16 or 32"),
    ({"format": "rgb9"}, "format: 'rgb9' is not a format (there are rgba8, rgbx8, rgb565, rgb10a2)"),
    ({"order": "argb"}, "order: 'argb' is not an order of bytes (rgba or bgra)"),
])
def test_bad_values_are_refused_in_one_line(arguments, line):
    with pytest.raises(tilepress.Error) as error:
        tilepress.Engine(**arguments)
    assert str(error.value).startswith(line) and "\n" not in str(error.value)
    assert error.value.kind == "bad value"
    assert isinstance(error.value, ValueError)


def test_what_is_no_array_is_a_type_error():
    with pytest.raises(TypeError, match="frame: must be a numpy array, not list"):
        tilepress.Engine("ras").process([[1]])


def test_a_block_outside_is_refused(frames):
    surface = tilepress.Engine("te").process(frames[0], surfaces=True).surfaces["te"]
    with pytest.raises(tilepress.Error, match=r"block \(40, 0\): outside of the surface"):
        surface.payload(40, 0)
    with pytest.raises(tilepress.Error, match="cannot be read without the frame before"):
        surface.decode()


def test_sums_leave_out_the_first_frame_and_results_can_be_kept(frames):
    result = tilepress.compress(frames, "vdcp:fvc={16,64}", toggle_bits=32)
    assert list(result.totals) == ["vdcp:fvc=16", "vdcp:fvc=64"]
    later = [frame["vdcp:fvc=16"] for frame in result.frames[1:]]
    total = result["vdcp:fvc=16"]
    assert total.raw_bits == 3 * 1000 * 2048 and total.payload_bits == sum(each.payload_bits for each in later)
    assert total.toggles == sum(each.toggles for each in later) and total.fvc_coverage is None
    assert total.rate == total.raw_bits / (total.bursts * 128 + total.csb_bits + total.palette_bits)
    assert [frame.warmup for frame in result] == [True, False, False, False]
    assert pickle.loads(pickle.dumps(result)) == result
    assert result.to_rows()[3]["scheme"] == "vdcp:fvc=64"
    assert result.frames[1].to_dict()["schemes"][0]["rate"] == later[0].rate


def test_parts_of_a_sequence_give_the_same_figures(frames):
    whole = tilepress.compress(frames, "vdcp")
    part = tilepress.Engine("vdcp")
    for number in part.history(3):
        part.seek(number)
        part.process(frames[number])
    part.seek(3)
    assert part.process(frames[3])["vdcp"] == whole.frames[3]["vdcp"]


def test_threads_run_side_by_side(frames):
    expected, results = figures_of(frames), [None] * 4

    def work(i):
        results[i] = figures_of(frames)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == [expected] * 4


def test_other_threads_run_while_a_frame_is_compressed(frames):
    """A thread that only counts goes on during one long call."""
    counted, end = [0], threading.Event()

    def count():
        while not end.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    engine, large = tilepress.Engine(), numpy.tile(frames[0], (8, 8, 1))
    steps = []
    for _ in range(3):
        before = counted[0]
        engine.process(large)
        steps.append(counted[0] - before)
    end.set()
    thread.join()
    assert max(steps) > 0
