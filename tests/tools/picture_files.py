"""Readers of the pictures that runs keep: PNG and the PGM of heat maps, with nothing but Python's own library."""
import struct
import zlib


def read_pgm(path):
    """Full scheme name, width, height, samples."""
    with open(path, "rb") as file:
        magic, comment, sizes, most, data = file.read().split(b"\n", 4)
    assert (magic, most) == (b"P5", b"2048"), (magic, most)
    width, height = map(int, sizes.split())
    return comment.decode().removeprefix("# scheme "), width, height, struct.unpack(f">{width * height}H", data)


def read_png(path):
    """Width, height, channels and samples; 8 bits, not interlaced."""
    with open(path, "rb") as file:
        data = file.read()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    channels = {2: 3, 6: 4}[kind]
    assert depth == 8
    packed, at = b"", 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    raw, pitch, out = zlib.decompress(packed), width * channels, bytearray()
    before = bytearray(pitch)
    for y in range(height):
        method, line = raw[y * (pitch + 1)], bytearray(raw[y * (pitch + 1) + 1:(y + 1) * (pitch + 1)])
        for x in range(pitch):
            a, b, c = line[x - channels] if x >= channels else 0, before[x], before[x - channels] if x >= channels else 0
            p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            guess = (0, a, b, (a + b) // 2, a if p <= q and p <= r else b if q <= r else c)[method]
            line[x] = line[x] + guess & 255
        out += line
        before = line
    return width, height, channels, bytes(out)
