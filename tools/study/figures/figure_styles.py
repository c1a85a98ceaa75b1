"""Styles of the figures: colours, markers, dashes and hatches that differ in grey too, and the mark of the paper's values."""
import math

# Colours differ in lightness, so that they differ in grey too: colour, marker, dashes, hatch.
CATEGORY_STYLES = {"UI": ("#0b3c7d", "o", "-", ""), "2D": ("#e69f00", "s", (0, (5, 1.5)), "///"),
                   "3D": ("#2a9d8f", "^", (0, (1, 1.2)), ".."), "all": ("#555555", "D", (0, (5, 1.5, 1, 1.5)), "xxx")}
SCHEME_STYLES = {"dcp": ("#bdbdbd", "o", "-", ""), "adcp": ("#e69f00", "s", "-", "///"), "vdcp": ("#0b3c7d", "D", "-", ""),
                 "huffdcp": ("#2a9d8f", "^", "-", ".."), "ras": ("#f2c9a1", "v", "-", "\\\\\\"), "red": ("#a63603", "P", "-", "xxx"),
                 "hdcp": ("#54278f", "X", "-", "++"),
                 # The literature: greens from light to dark.
                 "palette": ("#d9f0d3", "o", "--", ""), "fbc": ("#c2e699", "s", "--", "///"), "bdi": ("#a6dba0", "D", "--", ""),
                 "bpc": ("#78c679", "^", "--", ".."), "fpc": ("#5aae61", "v", "--", ""), "fpcd": ("#41ab5d", "P", "--", "\\\\\\"),
                 "cpack": ("#238b45", "X", "--", ""), "freqvals": ("#1b7837", "<", "--", "xxx"), "hilo": ("#005a32", ">", "--", ""),
                 "msaa": ("#00441b", "h", "--", "++"),
                 # Shipping hardware: reds from light to dark.
                 "te": ("#fcbba1", "o", ":", ""), "intel8": ("#fb6a4a", "s", ":", "///"), "intel11": ("#cb181d", "D", ":", ""),
                 "amddcc": ("#67000d", "^", ":", ".."),
                 # Our own.
                 "lcc": ("#000000", "*", "-", "oo")}
OTHER_STYLES = [("#0b3c7d", "o", "-", ""), ("#e69f00", "s", (0, (5, 1.5)), "///"), ("#2a9d8f", "^", (0, (1, 1.2)), ".."),
                ("#8c2d04", "D", (0, (5, 1.5, 1, 1.5)), "xxx"), ("#7570b3", "v", (0, (3, 1)), "\\\\\\"),
                ("#999999", "P", (0, (7, 2)), "++"), ("#000000", "X", (0, (2, 2)), "oo"), ("#66a61e", "<", (0, (4, 1, 1, 1)), "--")]
# Grey lines: what general compressors reach. The CSV files also hold lz4_frame and zstd_frame.
BOUNDS = {"lz4_block": ("LZ4, each block", (0, (1, 1.2))), "zstd_block": ("zstd, each block", "-"), "webp_frame": ("WebP, whole frame", (0, (5, 1.5)))}
BOUND_STYLE = {"color": "0.5", "linewidth": 0.8, "zorder": 2.5}
PUBLISHED = {"marker": "*", "s": 42, "facecolor": "white", "edgecolor": "black", "linewidth": 0.8, "zorder": 5}


def style_of(table, name, index):
    return table.get(name) or OTHER_STYLES[index % len(OTHER_STYLES)]


def number(text):
    """The value of a cell; NaN for an empty one or a word."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def published_handle(plt):
    return plt.matplotlib.lines.Line2D([], [], linestyle="none", marker="*", markersize=6.5, markerfacecolor="white", markeredgecolor="black",
                                       markeredgewidth=0.8, label="paper")
