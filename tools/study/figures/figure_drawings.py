"""How each kind of figure is drawn: axes, legends, bars, lines and the paper's values."""
import math

from figure_styles import (BOUND_STYLE, BOUNDS, CATEGORY_STYLES, OTHER_STYLES, PUBLISHED, SCHEME_STYLES, number,
                           published_handle, style_of)

COLUMN_INCHES = 3.5
PAGE_INCHES = 7.1
NAMED_WORKLOADS = 24  # more workloads have numbers instead of names
COLUMN_BARS = 30      # more bars take the page width
LEGEND_LINES = 8      # more lines than this are thin and without names
NARROW_SCHEMES = 12   # more schemes take the page width
PANELS = 6


class Drawing:
    """One figure: its description, its rows, and what every kind of drawing does."""

    def __init__(self, plt, about, rows, categories):
        self.plt, self.about, self.rows = plt, about, rows
        self.titles = {category["name"]: category["title"] for category in categories}
        self.order = [category["name"] for category in categories]

    def bounds(self):
        """The bounds that the rows hold: column, label, dashes."""
        return [(column, *BOUNDS[column]) for column in BOUNDS if self.rows and any(row.get(column) for row in self.rows)]

    def near_bounds(self, values):
        """Bounds that fit on the axis of some values. Others would press the values to its foot."""
        limit = 1.25 * max((value for value in values if math.isfinite(value)), default=0)
        return [number(row[column]) for row in self.rows for column, _, _ in self.bounds() if row[column] and number(row[column]) < limit]

    def bound_handles(self):
        line = self.plt.matplotlib.lines.Line2D
        return [line([], [], color=BOUND_STYLE["color"], linewidth=BOUND_STYLE["linewidth"], linestyle=dashes, label=label)
                for _, label, dashes in self.bounds()]

    def draw_bounds(self, axes, row, left, right):
        """A grey line per bound of the row. A bound beyond the axis is not drawn."""
        for column, _, dashes in self.bounds():
            if row[column]:
                axes.hlines(number(row[column]), left, right, linestyles=[dashes], **BOUND_STYLE)

    def distinct(self, column):
        return list(dict.fromkeys(row[column] for row in self.rows))

    def category_style(self, category):
        return style_of(CATEGORY_STYLES, category, self.order.index(category) if category in self.order else 0)

    def start(self, width, height):
        figure, axes = self.plt.subplots(figsize=(width, height), layout="constrained")
        axes.set_xlabel(self.about["x_label"])
        axes.set_ylabel(self.about["y_label"])
        axes.grid(axis="y")
        return figure, axes

    def legend(self, axes, columns, handles=None):
        """A legend above the axes. A reader of the figure learns there what the marks of the paper are."""
        if handles is None:
            handles = axes.get_legend_handles_labels()[0]
        axes.legend(handles=handles, ncols=min(columns, max(1, len(handles))), loc="lower center", bbox_to_anchor=(0.5, 1.0),
                    frameon=False)

    def scale_y(self, axes, values):
        """From 0, unless all values are close to each other."""
        known = [value for value in values if math.isfinite(value)]
        if self.about["share"]:
            axes.yaxis.set_major_formatter(self.plt.matplotlib.ticker.PercentFormatter(1.0, decimals=None))
        if known and min(known) < 0.7 * max(known):
            axes.set_ylim(0, max(known) * 1.08)
        elif known:
            room = max(max(known) - min(known), 0.01 * max(known)) * 0.2
            axes.set_ylim(min(known) - room, max(known) + room)

    def positions(self, texts):
        """Where the values of x stand: at their numbers, or one after another."""
        if self.about["x_scale"] == "categories":
            return [self.about["x_order"].index(text) for text in texts]
        return [number(text) for text in texts]

    def scale_x(self, axes):
        scale, order = self.about["x_scale"], self.about["x_order"]
        if scale == "log2":
            axes.set_xscale("log", base=2)
            ticks = [number(text) for text in order]
            axes.set_xticks(ticks, order, rotation=35 if max(map(len, order)) > 4 else 0)
            axes.minorticks_off()
        elif scale == "categories":
            axes.set_xticks(range(len(order)), order)
        elif order:
            span = number(order[-1]) - number(order[0])
            shown = []
            for text in order:
                if not shown or number(text) - number(shown[-1]) > 0.04 * span:
                    shown.append(text)
            axes.set_xticks([number(text) for text in shown], shown)
            axes.set_xticks([number(text) for text in order], minor=True)


def draw_axis(drawing):
    about = drawing.about
    words = sum(math.isnan(number(text)) for text in about["x_order"])
    if about["by_workload"]:
        return draw_axis_by_workload(drawing)
    if 2 * words > len(about["x_order"]):
        return draw_grouped_bars(drawing, about["x_column"], about["x_order"], "category", drawing.distinct("category"))
    figure, axes = drawing.start(COLUMN_INCHES, 2.3)
    values = []
    for category in drawing.distinct("category"):
        color, marker, dashes, _ = drawing.category_style(category)
        rows = [row for row in drawing.rows if row["category"] == category]
        x = drawing.positions([row[about["x_column"]] for row in rows])
        y = [number(row[about["y_column"]]) for row in rows]
        axes.plot(x, y, color=color, marker=marker, linestyle=dashes, label=drawing.titles.get(category, category))
        marks = [(at, number(row["published"])) for at, row in zip(x, rows) if row["published"]]
        for at, value in marks:
            axes.scatter(at, value, **{**PUBLISHED, "edgecolor": color})
        values += y + [value for _, value in marks]
        bound = number(rows[0].get("zstd_block", ""))
        if math.isfinite(bound):
            axes.axhline(bound, linestyle=dashes, label=f"zstd, each block ({category})", **BOUND_STYLE)
    values += [bound for bound in drawing.near_bounds(values) if any(number(row["zstd_block"]) == bound for row in drawing.rows)]
    drawing.scale_x(axes)
    drawing.scale_y(axes, values)
    if about["share"] and not about["x_column"] == "fvc":
        axes.axhline(1, color="0.4", linewidth=0.6, zorder=0)
    handles = axes.get_legend_handles_labels()[0]
    if any(row["published"] for row in drawing.rows):
        handles.append(published_handle(drawing.plt))
    drawing.legend(axes, 2, handles)
    return figure


def draw_axis_by_workload(drawing):
    about = drawing.about
    figure, axes = drawing.start(COLUMN_INCHES, 2.5)
    workloads = drawing.distinct("workload")
    curves = {name: [row for row in drawing.rows if row["workload"] == name] for name in workloads}
    ends = {name: number(rows[-1][about["y_column"]]) / number(rows[0][about["y_column"]]) for name, rows in curves.items()}
    named = workloads if len(workloads) <= LEGEND_LINES else [max(ends, key=ends.get), min(ends, key=ends.get)]
    values = []
    for name in sorted(workloads, key=lambda name: name in named):
        rows = curves[name]
        x = drawing.positions([row[about["x_column"]] for row in rows])
        y = [number(row[about["y_column"]]) for row in rows]
        values += y
        if name in named:
            color, marker, dashes, _ = OTHER_STYLES[named.index(name) % len(OTHER_STYLES)]
            axes.plot(x, y, color=color, marker=marker, linestyle=dashes, label=f"{name} ({rows[0]['category']})" if rows[0]["category"] else name)
        else:
            axes.plot(x, y, color="0.75", linewidth=0.4, marker="")
    drawing.scale_x(axes)
    drawing.scale_y(axes, values)
    drawing.legend(axes, 2)
    return figure


def draw_grouped_bars(drawing, group_column, groups, member_column, members, styles=None):
    """A group of bars per value of one column, a bar in it per value of the other."""
    about = drawing.about
    cells = {(row[group_column], row[member_column]): row for row in drawing.rows}
    wide = len(groups) * len(members) > COLUMN_BARS
    figure, axes = drawing.start(PAGE_INCHES if wide else COLUMN_INCHES, 2.3)
    width = (0.9 if wide else 0.8) / len(members)
    means = [number(row[about["y_column"]]) for row in drawing.rows]
    top = 1.25 * max(means + drawing.near_bounds(means) + [number(row["published"]) for row in drawing.rows if row["published"]])
    for i, member in enumerate(members):
        color, _, _, hatch = styles(member, i) if styles else drawing.category_style(member)
        places = [(g - width * len(members) / 2 + width * (i + 0.5), cells[group, member]) for g, group in enumerate(groups) if (group, member) in cells]
        axes.bar([x for x, _ in places], [number(row[about["y_column"]]) for _, row in places], width * 0.92, color=color, hatch=hatch,
                 edgecolor="white" if hatch else color, linewidth=0, label=drawing.titles.get(member, member))
        for x, row in places:
            drawing.draw_bounds(axes, row, x - width / 2, x + width / 2)
            value, low, high = (number(row[name]) for name in (about["y_column"], "minimum", "maximum"))
            axes.plot([x, x], [low, min(high, top)], color="0.35", linewidth=0.6, marker="" if high <= top else None, zorder=3)
            # The value stands in the bar's foot, or above everything else where the bar is too short for it.
            stated = number(row["published"])
            foot = 0 if value > 0.15 * top else max(value, min(high, top), 0 if math.isnan(stated) else stated)
            axes.annotate(f"{value:.2f}" if value < 9.995 else f"{value:.1f}", (x, foot), (0, 2 if foot == 0 else 5), textcoords="offset points",
                          ha="center", va="bottom", rotation=90 if len(groups) * len(members) > 12 else 0, fontsize=4.8 if wide else 5.5,
                          bbox={"boxstyle": "square,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.85}, zorder=4)
            if row["published"]:
                axes.scatter(x, number(row["published"]), **PUBLISHED)
    axes.set_ylim(0, top)
    axes.set_xticks(range(len(groups)), [drawing.titles.get(group, group) for group in groups])
    if group_column == "category":
        axes.set_xlabel("")
    handles = axes.get_legend_handles_labels()[0]
    if any(row["published"] for row in drawing.rows):
        handles.append(published_handle(drawing.plt))
    drawing.legend(axes, 9 if wide else 3 if drawing.bounds() else 5 if styles else 2, handles + drawing.bound_handles())
    return figure


def draw_means(drawing):
    members = [name for name in drawing.about["x_order"] if name in drawing.distinct("configuration")]
    return draw_grouped_bars(drawing, "category", drawing.distinct("category"), "configuration", members,
                             lambda member, i: style_of(SCHEME_STYLES, member, i))


def workload_axis(drawing, axes):
    """Names or numbers of the workloads below the axis, categories above, a line between categories."""
    places = {row["workload"]: (int(row["order"]), row["category"]) for row in drawing.rows}
    names = sorted(places, key=places.get)
    orders = [places[name][0] for name in names]
    if len(names) <= NAMED_WORKLOADS:
        axes.set_xticks(orders, names, rotation=30, ha="right", rotation_mode="anchor")
        axes.set_xlabel("")
    axes.set_xlim(min(orders) - 0.6, max(orders) + 0.6)
    for before, name in zip([None] + names, names):
        order, category = places[name]
        if before is not None and places[before][1] != category:
            axes.axvline(order - 0.5, color="0.6", linewidth=0.6)
        if before is None or places[before][1] != category:
            axes.annotate(category, (order - 0.5, 1), (2, -2), xycoords=axes.get_xaxis_transform(), textcoords="offset points", va="top",
                          fontsize=6.5, bbox={"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8})


def width_for(drawing):
    narrow = len(drawing.distinct("workload")) <= 2 * NAMED_WORKLOADS and len(drawing.about["x_order"]) <= NARROW_SCHEMES
    return COLUMN_INCHES if narrow else PAGE_INCHES


def draw_workload_rates(drawing):
    about = drawing.about
    figure, axes = drawing.start(width_for(drawing), 2.4)
    size = 4 if len(drawing.distinct("workload")) <= 60 else 2.6
    values = []
    for i, name in enumerate(about["x_order"]):
        color, marker, _, _ = style_of(SCHEME_STYLES, name, i)
        rows = [row for row in drawing.rows if row["configuration"] == name]
        y = [number(row[about["y_column"]]) for row in rows]
        values += y
        axes.plot([int(row["order"]) for row in rows], y, color=color, marker=marker, markersize=size, markeredgecolor="black",
                  markeredgewidth=0.35, linestyle="none", label=name)
    for order in drawing.distinct("order"):
        drawing.draw_bounds(axes, next(row for row in drawing.rows if row["order"] == order), int(order) - 0.45, int(order) + 0.45)
    values += drawing.near_bounds(values)
    if max(values) > 16 * min(values) or max(values) > 40:
        axes.set_yscale("log", base=2)
        axes.yaxis.set_major_formatter(drawing.plt.matplotlib.ticker.FormatStrFormatter("%g"))
        axes.set_ylim(min(values) / 1.15, max(values) * 1.5)
    else:
        axes.set_ylim(0, max(values) * 1.18)
    workload_axis(drawing, axes)
    columns = 9 if width_for(drawing) == PAGE_INCHES else 3 if drawing.bounds() else 4
    drawing.legend(axes, columns, axes.get_legend_handles_labels()[0] + drawing.bound_handles())
    return figure


def draw_bursts(drawing):
    """A panel per category: a mark per scheme and burst, and a line between the marks of a scheme."""
    about, plt = drawing.about, drawing.plt
    names = [name for name in about["x_order"] if name in drawing.distinct("configuration")]
    categories, bursts = drawing.distinct("category"), drawing.distinct("burst")
    width = COLUMN_INCHES if len(names) <= NARROW_SCHEMES else PAGE_INCHES
    figure, panels = plt.subplots(len(categories), 1, figsize=(width, 0.7 + 1.25 * len(categories)), layout="constrained", squeeze=False, sharex=True)
    cells = {(row["category"], row["configuration"], row["burst"]): number(row[about["y_column"]]) for row in drawing.rows}
    fills = ["#0b3c7d", "white", "#e69f00", "#2a9d8f"]
    for axes, category in zip(panels[:, 0], categories):
        for x, name in enumerate(names):
            values = [cells[category, name, burst] for burst in bursts if (category, name, burst) in cells]
            axes.plot([x] * len(values), values, color="0.45", marker="", linewidth=0.8, zorder=2)
        for i, burst in enumerate(bursts):
            points = [(x, cells[category, name, burst]) for x, name in enumerate(names) if (category, name, burst) in cells]
            dram = next(row["dram"] for row in drawing.rows if row["burst"] == burst).replace(" ", ", ")
            axes.scatter([x for x, _ in points], [y for _, y in points], s=16, marker="os^D"[i % 4], facecolor=fills[i % 4], edgecolor="#0b3c7d",
                         linewidth=0.8, zorder=3, label=f"{burst} bits ({dram})" if dram else f"{burst} bits")
        axes.set_title(drawing.titles.get(category, category), loc="left", fontsize=6.5, pad=2)
        axes.set_ylim(0, axes.get_ylim()[1])
        axes.grid(axis="y")
    panels[-1, 0].set_xticks(range(len(names)), names, rotation=40, ha="right", rotation_mode="anchor")
    figure.supylabel(about["y_label"], fontsize=7)
    panels[0, 0].legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.12), frameon=False)
    return figure


def draw_hybrid(drawing):
    figure, axes = drawing.start(width_for(drawing), 2.3)
    parts = [("vdcp_only", "coded by VDCP", SCHEME_STYLES["vdcp"]), ("raw_share", "raw either way", ("white", "", "", "..")),
             ("ras_only", "coded by RAS", SCHEME_STYLES["ras"])]
    if not any(row["raw_share"] for row in drawing.rows):
        parts = [("vdcp_share", "VDCP", SCHEME_STYLES["vdcp"]), ("ras_share", "RAS", SCHEME_STYLES["ras"])]
    order = [int(row["order"]) for row in drawing.rows]
    base = [0.0] * len(order)
    for column, label, (color, _, _, hatch) in parts:
        share = [number(row[column]) if row[column] else 0.0 for row in drawing.rows]
        axes.bar(order, share, 0.86, bottom=base, color=color, hatch=hatch, edgecolor="0.45", linewidth=0, label=label)
        base = [low + high for low, high in zip(base, share)]
    for point in drawing.about["published"]:
        axes.axhline(point["value"], color="black", linewidth=0.9, linestyle=(0, (4, 2)), label="paper, on average")
    axes.set_ylim(0, 1)
    axes.yaxis.set_major_formatter(drawing.plt.matplotlib.ticker.PercentFormatter(1.0))
    workload_axis(drawing, axes)
    drawing.legend(axes, 2)
    return figure


def draw_cdf(drawing):
    about = drawing.about
    figure, axes = drawing.start(COLUMN_INCHES, 2.5)
    workloads = drawing.distinct("workload")
    crowded = len(workloads) > LEGEND_LINES
    seen = set()
    for i, name in enumerate(workloads):
        rows = [row for row in drawing.rows if row["workload"] == name]
        category = rows[0]["category"]
        color, _, dashes, _ = drawing.category_style(category) if crowded else OTHER_STYLES[i % len(OTHER_STYLES)]
        label = f"{name} ({category})" if category and not crowded else name
        if crowded:
            label = None if category in seen else drawing.titles.get(category, category)
        seen.add(category)
        axes.plot([number(row["colors"]) for row in rows], [number(row["pixels_share"]) for row in rows], color=color, linestyle=dashes,
                  linewidth=0.5 if crowded else 1.1, marker="", label=label)
    for point in about["published"]:
        axes.scatter(number(point["x"]), point["value"], **PUBLISHED)
        axes.annotate(f"paper, {point['category']}", (number(point["x"]), point["value"]), (5, -1), textcoords="offset points", va="top", fontsize=6)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(drawing.plt.matplotlib.ticker.FormatStrFormatter("%d"))
    axes.set_ylim(0, 1.02)
    axes.yaxis.set_major_formatter(drawing.plt.matplotlib.ticker.PercentFormatter(1.0))
    drawing.legend(axes, 2)
    return figure


def draw_coverage(drawing):
    about = drawing.about
    figure, axes = drawing.start(COLUMN_INCHES, 2.5)
    values = [number(row[about["y_column"]]) for row in drawing.rows]
    for category in drawing.distinct("category"):
        color, marker, _, _ = drawing.category_style(category)
        rows = [row for row in drawing.rows if row["category"] == category]
        for frame, size, edge, label in ((True, 2, "none", None), (False, 22, "black", drawing.titles.get(category, category))):
            part = [row for row in rows if bool(row["frame"]) == frame]
            axes.scatter([number(row["fvc_coverage"]) for row in part], [number(row[about["y_column"]]) for row in part], s=size, marker=marker,
                         color=color, edgecolor=edge, linewidth=0.4, alpha=0.45 if frame else 1, label=label, zorder=2 if frame else 3,
                         rasterized=frame and len(part) > 1500)
    axes.set_yscale("log", base=2)
    axes.yaxis.set_major_formatter(drawing.plt.matplotlib.ticker.FormatStrFormatter("%g"))
    axes.set_ylim(min(values) / 1.2, max(values) * 1.3)
    axes.set_xlim(-0.02, 1.02)
    for i, point in enumerate(about["published"]):
        axes.axvline(number(point["x"]), color="0.3", linewidth=0.8, linestyle=(0, (4, 2)), label=None if i else "paper: threshold")
        axes.axhline(point["value"], color="0.3", linewidth=0.8, linestyle=(0, (4, 2)))
    drawing.legend(axes, 2)
    return figure


def chosen_panels(drawing):
    """At most PANELS workloads and surfaces, from every category, those with the most frames first."""
    counts = {}
    for row in drawing.rows:
        key = (row["category"], row["workload"], row["surface"])
        counts[key] = counts.get(key, 0) + 1
    by_category = {}
    for key in sorted(counts, key=lambda key: -counts[key]):
        by_category.setdefault(key[0], []).append(key)
    share = max(1, PANELS // len(by_category))
    chosen = [key for keys in by_category.values() for key in keys[:share]][:PANELS]
    return [key for key in counts if key in chosen]


def draw_time(drawing):
    plt = drawing.plt
    keys = chosen_panels(drawing)
    figure, panels = plt.subplots(len(keys), 1, figsize=(COLUMN_INCHES, 0.5 + 0.95 * len(keys)), layout="constrained", squeeze=False)
    lines = (("pixel_change", "pixel change", "#0b3c7d", "-"), ("color_change", "colour change", "#e69f00", (0, (3, 1))))
    for axes, key in zip(panels[:, 0], keys):
        rows = [row for row in drawing.rows if (row["category"], row["workload"], row["surface"]) == key]
        frames = [int(row["frame"]) for row in rows]
        stated = []
        for column, label, color, dashes in lines:
            axes.plot(frames, [number(row[column]) for row in rows], color=color, linestyle=dashes, marker="", linewidth=0.9, label=label)
            for point in drawing.about["published"]:
                if point["x"] == column and point["category"] == key[0]:
                    axes.axhline(point["value"], color=color, linewidth=0.8, linestyle=(0, (1, 2)))
                    stated.append(f"{point['value']:.1%}")
        if stated:
            axes.set_title(f"paper, {key[0]}: {' and '.join(stated)}", loc="right", fontsize=6, pad=2)
        axes.set_title(f"{key[1]} ({key[0]})" if key[0] else key[1], loc="left", fontsize=6.5, pad=2)
        axes.set_ylim(-0.02, 1.02)
        axes.set_yticks([0, 0.5, 1])
        axes.yaxis.set_major_formatter(plt.matplotlib.ticker.PercentFormatter(1.0))
        axes.grid(axis="y")
    panels[-1, 0].set_xlabel(drawing.about["x_label"])
    panels[0, 0].legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.14), frameon=False)
    return figure


KINDS = {"metrics over time": draw_time, "colour CDF": draw_cdf, "coverage against rate": draw_coverage, "rate over an axis": draw_axis,
         "relative coverage over an axis": draw_axis, "rates of workloads": draw_workload_rates, "means": draw_means, "rate over bursts": draw_bursts,
         "hybrid shares": draw_hybrid}
