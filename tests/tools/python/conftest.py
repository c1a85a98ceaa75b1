"""Frames for the tests."""
import numpy
import pytest


def picture(number, height=200, width=320):
    """A window with flat areas, a gradient and noise that moves. Neither side fills whole render tiles."""
    frame = numpy.zeros((height, width, 4), numpy.uint8)
    frame[..., 3] = 255
    frame[:40, :, :3] = (30, 60, 90)
    frame[40:, :100, 0] = numpy.arange(height - 40)[:, None]
    noise = numpy.random.default_rng(number).integers(0, 50, (60, 60, 3))
    frame[80:140, 120 + number:180 + number, :3] = noise
    frame[150:190:3, 110:300, :3] = 200
    return frame


@pytest.fixture
def frames():
    return [picture(number) for number in range(4)]
