#!/usr/bin/env python3
# Checks tilepress pack and unpack from the outside: images come back bit for bit, damage is refused in one line.
import os
import random
import struct
import subprocess
import sys
import tempfile
import zlib

TILEPRESS = sys.argv[1]


def png_chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def write_png(path, width, height, channels, pixels):
    """8 bits a channel; `pixels` are bytes from the top."""
    stride = width * channels
    rows = b"".join(b"\0" + pixels[y * stride:(y + 1) * stride] for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", head) + png_chunk(b"IDAT", zlib.compress(rows)) +
                   png_chunk(b"IEND", b""))


def read_png(path):
    """Width, height, channels, bit depth and samples as bytes: a decoder of our own, so that none of tilepress's vouches
    for itself."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, idat, head = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            idat += body
        at += 12 + size
    width, height, depth, color = head[:4]
    channels = {2: 3, 6: 4}[color]
    step = channels * depth // 8
    stride = width * step
    raw = zlib.decompress(idat)
    before, out = bytearray(stride), bytearray()
    for y in range(height):
        method, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            a = row[x - step] if x >= step else 0
            b, c = before[x], before[x - step] if x >= step else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[x] = (row[x] + [0, a, b, (a + b) // 2, paeth][method]) & 255
        out += row
        before = row
    return width, height, channels, depth, bytes(out)


def run(*args, status=0):
    done = subprocess.run([TILEPRESS, *args], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode == status, (args, done.returncode, done.stderr.decode())
    if status != 0:
        text = done.stderr.decode()
        assert text.startswith("tilepress: ") and text.count("\n") == 1, text
        assert done.stdout == b"", "nothing is written to standard output on failure"
    return done


def drawing(seed, width, height, channels):
    """Flat areas, a few colours and noise; alpha varies, 0 included."""
    source = random.Random(seed)
    out = bytearray()
    for y in range(height):
        for x in range(width):
            kind = (x // 9 + y // 7) % 3
            color = [(200, 30, 40, 0), (x & 255, y & 255, 90, 128)][kind % 2]
            if kind == 2:
                color = tuple(source.randrange(256) for _ in range(4))
            out += bytes(color[:channels])
    return bytes(out)


def check_images_come_back(folder):
    for width, height in ((1, 1), (67, 129), (64, 32)):
        for channels in (3, 4):
            name = f"{folder}/{width}x{height}x{channels}"
            os.mkdir(name)
            frames = [drawing(seed, width, height, channels) for seed in range(3)]
            paths = [f"{name}/in-{i}.png" for i in range(3)]
            for path, pixels in zip(paths, frames):
                write_png(path, width, height, channels, pixels)
            for scheme in {1: ("vdcp",), 67: ("hdcp:fvc=16", "huffdcp"), 64: ("red",)}[width]:
                file = f"{name}/{scheme.replace(':', '-')}.tpk"
                run("pack", "-s", scheme, "--verify", "-q", *paths, "-o", file)
                out = file + ".images"
                run("unpack", file, "-o", out)
                assert sorted(os.listdir(out)) == ["000000.png", "000001.png", "000002.png"]
                for i, pixels in enumerate(frames):
                    assert read_png(f"{out}/{i:06}.png") == (width, height, channels, 8, pixels), (scheme, i)
                run("unpack", file, "-o", out + ".raw", "--format", "rgba", "--frames", "1")
                raw = open(f"{out}.raw/000001.rgba", "rb").read()
                rgba = frames[1] if channels == 4 else b"".join(
                    frames[1][i:i + 3] + b"\xff" for i in range(0, len(frames[1]), 3))
                assert raw == rgba, scheme


def check_native_formats(folder):
    source = random.Random(9)
    for name, size in (("rgb565", 2), ("rgb10a2", 4)):
        colors = [bytes(source.randrange(256) for _ in range(size)) for _ in range(7)]
        frames = [b"".join(source.choice(colors) for _ in range(33 * 10)) for _ in range(2)]
        paths = [f"{folder}/{name}-{i}.{name}" for i in range(2)]
        for path, frame in zip(paths, frames):
            with open(path, "wb") as file:
                file.write(frame)
        packed = f"{folder}/{name}.tpk"
        run("pack", "--format", name, "--size", "33x10", *paths, "-o", packed)
        run("unpack", packed, "-o", f"{folder}/{name}.out", "--format", "raw")
        for i, frame in enumerate(frames):
            assert open(f"{folder}/{name}.out/{i:06}.{name}", "rb").read() == frame
        run("unpack", packed, "-o", f"{folder}/{name}.out")
        width, height, channels, depth, samples = read_png(f"{folder}/{name}.out/000000.png")
        word = int.from_bytes(frames[0][:size], "little")
        if name == "rgb565":
            r, g, b = word >> 11, word >> 5 & 63, word & 31
            assert (channels, depth) == (3, 8)
            assert samples[:3] == bytes((r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2))
        else:
            assert (channels, depth) == (4, 16)
            red, alpha = word & 1023, word >> 30
            assert struct.unpack(">H", samples[:2])[0] == red << 6 | red >> 4
            assert struct.unpack(">H", samples[6:8])[0] == alpha * 0x5555
        run("pack", "--format", name, "--size", "33x11", *paths, "-o", f"{folder}/no.tpk", status=1)


def check_parts(folder):
    """Four 2x2 pixels around (8, 8) of a solid surface lie in four blocks. VDCP: no payload in frame 1; CSB 4 blocks of 48
    bits a row of 8 blocks; 64 entries of 33 bits are 17 bursts of 128; raw 16 bursts a block."""
    paths = [f"{folder}/solid-{i}.png" for i in range(2)]
    for path in paths:
        write_png(path, 64, 16, 4, bytes((1, 2, 3, 4)) * (64 * 16))
    packed = f"{folder}/solid.tpk"
    run("pack", *paths, "-o", packed)
    rows = run("unpack", packed, "--rect", "7,7,2,2", "--frame", "1", "--csv").stdout.decode().splitlines()
    assert rows[0].startswith("frame,scheme,x,y,width,height,blocks,burst_bits,payload_bursts,csb_bursts,table_bursts,")
    # Blocks 0, 1, 8, 9: CSB bits 0-95 and 384-479, bursts 0 and 3, one line of four bursts.
    assert rows[1] == "1,vdcp,7,7,2,2,4,128,0,4,17,64,4,1", rows
    rows = run("unpack", packed, "--rect", "7,7,2,2", "--csv", "--csb-line-bursts", "1").stdout.decode().splitlines()
    assert rows[1] == "0,vdcp,7,7,2,2,4,128,64,2,0,64,4,2", rows
    assert rows[2] == "1,vdcp,7,7,2,2,4,128,0,2,17,64,4,2", rows
    said = run("unpack", packed, "--rect", "7,7,2,2", "--frame", "1", "-o", f"{folder}/part").stderr.decode()
    assert "4 blocks, bursts of 128 bits: payload 0 + CSB 4 + tables 17 = 21, raw 64" in said, said
    assert read_png(f"{folder}/part/000001-7,7,2,2.png") == (2, 2, 4, 8, bytes((1, 2, 3, 4)) * 4)


def check_refusals(folder):
    packed = f"{folder}/solid.tpk"
    whole = open(packed, "rb").read()
    broken = f"{folder}/broken.tpk"
    source = random.Random(3)
    for length in (0, 8, 20, 40, len(whole) - 1, source.randrange(len(whole))):
        with open(broken, "wb") as file:
            file.write(whole[:length])
        run("unpack", broken, "-o", f"{folder}/nothing", status=1)
    for _ in range(6):
        bit = source.randrange(8 * len(whole))
        data = bytearray(whole)
        data[bit // 8] ^= 1 << bit % 8
        with open(broken, "wb") as file:
            file.write(data)
        run("unpack", broken, "-o", f"{folder}/nothing", status=1)
    assert not os.path.exists(f"{folder}/nothing"), "a damaged file leaves nothing behind"
    run("unpack", f"{folder}/absent.tpk", "-o", f"{folder}/nothing", status=1)
    run("unpack", folder, "-o", f"{folder}/nothing", status=1)
    run("unpack", packed, "--rect", "60,0,5,1", status=1)
    run("unpack", packed, "--rect", "0,0,1,1", "--frame", "2", status=1)
    for bad in ("1,2,3", "1,2,3,4,5", "0,0,0,1", "-1,0,1,1"):
        run("unpack", packed, "--rect", bad, status=2)
    run("unpack", packed, status=2)
    run("unpack", packed, "-o", f"{folder}/nothing", "--format", "bmp", status=2)
    image = f"{folder}/solid-0.png"
    run("pack", image, status=2)
    run("pack", image, "-s", "dcp:fvc=3", "-o", broken, status=2)
    run("pack", image, "-s", "dcp", "-s", "red", "-o", broken, status=2)
    run("pack", image, "-o", packed, status=1)
    assert open(packed, "rb").read() == whole, "an existing file stays"
    run("pack", image, "--frames", "5", "-o", f"{folder}/empty.tpk", status=3)
    run("pack", f"{folder}/absent.png", "-o", f"{folder}/empty.tpk", status=1)
    run("pack", "--format", "rgb565", image, "-o", f"{folder}/empty.tpk", status=2)
    assert not [name for name in os.listdir(folder) if name.startswith("empty")], "a failure leaves no file"
    run("pack", image, "--force", "-o", packed)
    run("unpack", packed, "-o", f"{folder}/twice")
    run("unpack", packed, "-o", f"{folder}/twice", status=1)
    run("unpack", packed, "-o", f"{folder}/twice", "--force")


with tempfile.TemporaryDirectory() as scratch:
    for number, check in enumerate((check_images_come_back, check_native_formats, check_parts)):
        os.makedirs(f"{scratch}/{number}")
        check(f"{scratch}/{number}")
    check_refusals(f"{scratch}/2")
print("pack and unpack: all well")
