"""Schemes in Python: checked by the same verify as the library's own."""
import numpy
import pytest

import tilepress


@tilepress.register_scheme
class Rows(tilepress.Scheme):
    """Stores the first pixel of a row of eight once if the whole row has that colour."""

    name = "rows"
    summary = "rows of one colour as one pixel"
    keys = [tilepress.Key("most", "rows that may be stored as one pixel", low=1, high=8, initial=8),
            tilepress.Key("order", "where rows begin", kind="choice", choices=("top", "bottom"))]
    csb_bits = 8

    def solid(self, words):
        rows = words.reshape(8, 8)
        return (rows == rows[:, :1]).all(axis=1) & (numpy.arange(8) < self.values["most"])

    def measure(self, pixels):
        solid = self.solid(self.words(pixels))
        return int(numpy.where(solid, 1, 8).sum()) * self.pixel_bits

    def encode(self, pixels, payload, csb):
        words = self.words(pixels)
        for row, solid in zip(words.reshape(8, 8), self.solid(words)):
            csb.put(int(solid), 1)
            payload.put_words(row[:1] if solid else row, self.pixel_bits)

    def decode(self, csb, payload):
        words = numpy.empty((8, 8), numpy.uint32)
        for row in words:
            row[:] = payload.get_words(1 if csb.get(1) else 8, self.pixel_bits)
        return self.pixels(words)


def test_it_runs_beside_others_and_is_verified(frames):
    result = tilepress.compress(frames[:2], ["rows", "rows:most=3,order=bottom", "ras"], verify=True)
    for figures in result.totals.values():
        assert (figures.checked_blocks, figures.mismatched_blocks) == (1000, 0)
    assert result["rows"].csb_bits == 8000
    assert 1 < result["rows:most=3,order=bottom"].rate_payload < result["rows"].rate_payload
    surface = tilepress.Engine("rows").process(frames[0], surfaces=True).surfaces["rows"]
    assert (surface.decode() == frames[0]).all()


@pytest.mark.parametrize("format, dtype", [("rgb565", numpy.uint16), ("rgb10a2", numpy.uint32)])
def test_it_works_for_other_formats(format, dtype):
    words = numpy.random.default_rng(2).integers(0, 2, (20, 20)).astype(dtype)
    figures = tilepress.Engine("rows", format=format, verify=True).process(words)["rows"]
    assert (figures.checked_blocks, figures.mismatched_blocks) == (9, 0)


def test_the_registry_and_the_parser_know_it():
    info = {each.name: each for each in tilepress.schemes()}["rows"]
    assert (info.label, info.family, info.group, info.keys[0].values) == ("rows", "python", "ours", "1 ... 8")
    assert tilepress.parse_schemes("rows:most={2,3}") == ["rows:most=2", "rows:most=3"]
    with pytest.raises(tilepress.Error, match="scheme 'rows:most=9': most=9: must be a whole number from 1 to 8"):
        tilepress.parse_schemes("rows:most=9")


def derived(name, **parts):
    return tilepress.register_scheme(type(name.title(), (Rows,), {"name": name, "label": "", **parts}))


def mismatches(name, frame):
    return tilepress.Engine(name, verify=True).process(frame)[name].mismatched_blocks


def lossy(self, csb, payload):
    return Rows.decode(self, csb, payload) & 0xFE


def test_verify_finds_what_is_wrong(frames):
    derived("lossy", decode=lossy)
    derived("mismeasured", measure=lambda self, pixels: Rows.measure(self, pixels) - 1)
    derived("refuses", decode=lambda self, csb, payload: None)
    derived("greedy", decode=lambda self, csb, payload: [payload.get(60) for _ in range(50)] and None)
    for name in ("lossy", "mismeasured", "refuses", "greedy"):
        assert mismatches(name, frames[0]) > 500, name


@pytest.mark.parametrize("name, parts, line", [
    ("wide", {"encode": lambda self, pixels, payload, csb: [payload.put(0, 64) for _ in range(33)]},
     "scheme 'wide': encode wrote 2112 payload bits: a raw block has 2048"),
    ("unmarked", {"encode": lambda self, pixels, payload, csb: None},
     "scheme 'unmarked': encode wrote 0 CSB bits: csb_bits is 8"),
    ("manymarks", {"csb_bits": 200}, "scheme 'manymarks': csb_bits=200: must be from 0 to 128"),
    ("negative", {"measure": lambda self, pixels: -1}, "scheme 'negative': measure=-1: must be from 0 to 2048"),
    ("half", {"measure": lambda self, pixels: 0.5}, "scheme 'half': measure: must be a whole number, not 0.5"),
    ("shape", {"decode": lambda self, csb, payload: numpy.zeros((8, 4, 4), numpy.uint8)},
     "scheme 'shape': decode: must return 8x8 pixels"),
])
def test_faults_are_errors_with_the_name_of_the_scheme(frames, name, parts, line):
    derived(name, **parts)
    with pytest.raises(tilepress.Error) as error:
        mismatches(name, frames[0])
    assert str(error.value) == line


def test_exceptions_arrive_as_they_are_and_end_the_engine(frames):
    def encode(self, pixels, payload, csb):
        raise KeyError("in encode")

    derived("raises", encode=encode)
    engine = tilepress.Engine(["vdcp", "raises"], verify=True)
    with pytest.raises(KeyError, match="in encode"):
        engine.process(frames[0])
    with pytest.raises(tilepress.Error, match="engine: a scheme raised an exception in an earlier frame"):
        engine.process(frames[0])


def test_a_scheme_may_learn_from_the_frame_before(frames):
    class Common(Rows):
        """One colour of the frame before, in the tables: a block of that colour has no payload."""

        name, label, keys, csb_bits, every_block = "common", "", (), 1, True
        color, seen = None, None

        def begin_frame(self, frame, pixels):
            self.color = max(self.seen, key=self.seen.get) if self.seen else None
            self.seen = {}

        def write_tables(self, out):
            if self.color is not None:
                out.put(self.color, self.pixel_bits)

        def read_tables(self, tables, bits):
            self.color = tables.get(self.pixel_bits) if bits else None
            return bits in (0, self.pixel_bits)

        def measure(self, pixels):
            words = self.words(pixels)
            self.seen[int(words[0])] = self.seen.get(int(words[0]), 0) + 1
            return 0 if (words == self.color).all() else 64 * self.pixel_bits

        def encode(self, pixels, payload, csb):
            words = self.words(pixels)
            common = bool((words == self.color).all())
            csb.put(common, 1)
            if not common:
                payload.put_words(words, self.pixel_bits)

        def decode(self, csb, payload):
            if not csb.get(1):
                return self.pixels(payload.get_words(64, self.pixel_bits))
            return None if self.color is None else self.pixels(numpy.full(64, self.color))

    tilepress.register_scheme(Common)
    result = tilepress.compress(frames[:3], "common", verify=True)
    assert [frame["common"].palette_bits for frame in result] == [0, 32, 32]
    assert result.frames[0]["common"].payload_bits == 1000 * 2048
    assert result["common"].mismatched_blocks == 0 and result["common"].rate > 1.4


def test_a_class_may_take_the_place_of_one_with_the_same_keys(frames):
    derived("again", decode=lossy)
    assert mismatches("again", frames[0]) > 0
    derived("again")
    assert mismatches("again", frames[0]) == 0
    with pytest.raises(tilepress.Error, match="scheme 'again': registered with other keys"):
        derived("again", keys=())


def test_classes_that_cannot_be_schemes_are_refused():
    with pytest.raises(tilepress.Error, match="scheme 'vdcp': there is a scheme of this name already"):
        derived("vdcp")
    with pytest.raises(tilepress.Error, match="scheme 'a:b': not a name for a scheme"):
        derived("a:b")
    with pytest.raises(tilepress.Error, match=r"scheme 'bare': the class Bare has no encode\(\)"):
        tilepress.register_scheme(type("Bare", (tilepress.Scheme,), {"name": "bare"}))
    with pytest.raises(tilepress.Error, match="key 'k': kind 'text' is not number"):
        derived("kinds", keys=[tilepress.Key("k", "", kind="text")])
