# %% [markdown]
# # Rate against the size of the FVC
#
# Remakes the paper's figure of rates over FVC sizes, on your own frames. Run it cell by cell in an editor that knows `# %%`, or
#
#     python3 fvc_size.py [FRAME.png ...] [-o fvc_size.png]
#
# Without frames it draws a window that scrolls. Needs tilepress, python3-numpy and python3-matplotlib.

# %%
import sys

import matplotlib

matplotlib.use("Agg")  # leave it out in a notebook
import matplotlib.image
import matplotlib.pyplot as plt
import numpy

import tilepress

# %% Frames: H×W×4 uint8 arrays of one size, top row first.


def draw(number, height=640, width=360):
    """A page of text lines and pictures that scrolls by 24 pixels a frame."""
    noise = numpy.random.default_rng(7)
    page = numpy.full((4096, width, 4), 255, numpy.uint8)
    for top in range(0, 4000, 160):
        shades = numpy.linspace(0, 255, width - 40).astype(numpy.uint8) // 8 * 8
        page[top:top + 48, 20:-20, :3] = shades[:, None] // (top // 160 % 5 + 1) + numpy.uint8([top % 200, 20, 40])
        for line in range(top + 60, top + 150, 16):
            ink = noise.random((9, width - 40)) < 0.25
            page[line:line + 9, 20:-20, :3][ink] = noise.choice(numpy.uint8([0, 40, 90, 150]), (ink.sum(), 1))
    page[:, :, 3] = 255
    return page[24 * number:24 * number + height]


def read(path):
    image = matplotlib.image.imread(path)  # 0..1
    pixels = numpy.full(image.shape[:2] + (4,), 255, numpy.uint8)
    pixels[..., :image.shape[2]] = numpy.rint(image * 255)
    return pixels


arguments = [] if "ipykernel" in sys.modules else sys.argv[1:]
output = "fvc_size.png"
if "-o" in arguments:
    at = arguments.index("-o")
    output = arguments[at + 1]
    del arguments[at:at + 2]
frames = [read(path) for path in arguments] or [draw(number) for number in range(12)]

# %% Every size of every scheme, in one pass over the frames.
SCHEMES = {"dcp": "o", "vdcp": "s", "huffdcp": "^"}
SIZES = [16, 32, 64, 128, 256, 512]
result = tilepress.compress(frames, [f"{scheme}:fvc={{16..512}}" for scheme in SCHEMES])

# %% The first frame has no palette, and result[...] leaves it out.
figure, (rates, sizes) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
for scheme, marker in SCHEMES.items():
    rates.plot(SIZES, [result[f"{scheme}:fvc={size}"].rate for size in SIZES], marker=marker, label=scheme)
rates.set_xscale("log", base=2)
rates.set_xticks(SIZES, SIZES)
rates.minorticks_off()
rates.set_title(f"{len(frames) - 1} frames", fontsize=10)
rates.set_xlabel("entries of the FVC")
rates.set_ylabel("compression rate (raw bits / moved bits)")
rates.set_ylim(bottom=0)
rates.grid(axis="y", color="0.9")
rates.legend()

# %% Why: what Algorithm 1 sees in the last frame, for dictionaries of each size.
ccd = tilepress.Fvc("dcp:fvc=512").collect(frames[-1]).ccd()
algorithm = ccd.algorithm1()
entries = [2**each.width for each in algorithm.rounds]
sizes.plot(entries, [each.bits / ccd.samples for each in algorithm.rounds], marker="o", label="bits per pixel")
sizes.axvline(algorithm.entries, color="0.6", linewidth=1)
sizes.text(algorithm.entries, 0.04, "chosen ", ha="right", color="0.4", transform=sizes.get_xaxis_transform())
sizes.set_xscale("log", base=2)
sizes.set_xticks(entries, entries)
sizes.minorticks_off()
sizes.set_title("Algorithm 1, last frame", fontsize=10)
sizes.set_xlabel("colours of the dictionary")
sizes.set_ylabel("predicted bits per pixel")
sizes.set_ylim(bottom=0)
sizes.grid(axis="y", color="0.9")
figure.savefig(output, dpi=150)
print(output)

# %% The same figures as a table.
if "pandas" in sys.modules or "ipykernel" in sys.modules:
    import pandas

    print(pandas.DataFrame(each.to_dict() for each in result.totals.values())[["scheme", "rate", "rate_payload"]])
