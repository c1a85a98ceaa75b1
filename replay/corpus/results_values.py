"""The numbers of RESULTS.md: means, ratios and tables from the CSV files of the studies."""
import json
import re
from collections import defaultdict
from pathlib import Path

from corpus_messages import Fault
from frame_digests import read_rows

CATEGORIES = ("UI", "2D", "3D", "all")
LONG_FRAMES = 180   # frame sampling to 60 needs workloads of this length


def table(heads, rows, left=2):
    """A Markdown table; the first `left` columns are text."""
    align = ["---"] * left + ["--:"] * (len(heads) - left)
    return "\n".join("| " + " | ".join(line) + " |" for line in [heads, align, *rows])


def harmonic_mean(values):
    return len(values) / sum(1 / value for value in values)


class Study:
    """The tables that `tilepress study` left in a folder."""

    def __init__(self, folder):
        self.means = {(row["category"], row["configuration"]): row for row in read_rows(folder / "means.csv")}
        self.workloads = [row for row in read_rows(folder / "workloads.csv") if row["status"] in ("done", "partial")]
        self.frames = {row["workload"]: int(row["frames"]) for row in self.workloads}
        self.rates, self.categories = defaultdict(dict), {}
        for row in read_rows(folder / "results.csv"):
            self.rates[row["configuration"]][row["workload"]] = row
            self.categories[row["workload"]] = row["category"]

    def mean(self, category, configuration, column="rate_hmean"):
        try:
            return float(self.means[category, configuration][column])
        except KeyError as error:
            raise Fault(f"no mean of {configuration} for {category}") from error

    def members(self, category):
        return [row for row in self.workloads if category in ("all", row["category"])]

    def metric(self, category, column):
        values = [float(row[column]) for row in self.members(category) if row[column]]
        return sum(values) / len(values)

    def relative(self, configuration, base, workloads):
        """The ratio of the harmonic means over these workloads."""
        means = [harmonic_mean([float(self.rates[name][workload]["rate"]) for workload in workloads])
                 for name in (configuration, base)]
        return means[0] / means[1]

    def long_workloads(self, category):
        return [row["workload"] for row in self.members(category) if int(row["frames"]) >= LONG_FRAMES]


def share(value, digits=1):
    return f"{100 * value:.{digits}f} %"


class Values:
    """Looks up what {{...}} in the text stands for. `folders`: name of a study and its folder. `translucent`: names of
    workloads with pixels that are not opaque. `first`: frames that all studies but the paper's took; 0: all."""

    def __init__(self, folders, infos, groups, translucent, first):
        self.studies = {name: Study(folder) for name, folder in folders.items()}
        self.paper = self.studies["paper"]
        self.infos, self.groups, self.translucent, self.first = infos, groups, translucent, first
        self.claims = {row["id"]: row for row in read_rows(folders["paper"] / "claims.csv")}
        self.claims_text = (folders["paper"] / "claims.md").read_text(encoding="utf-8")

    def value(self, words):
        function = getattr(self, "value_" + words[0].replace("-", "_"), None)
        if function is None:
            raise Fault(f"unknown value '{' '.join(words)}'")
        return function(*words[1:])

    def common_members(self, category):
        """The workloads that every study of the sensitivity has: recordings can come and go between studies."""
        others = [study for name, study in self.studies.items() if name not in ("paper", "schemes")]
        return [row["workload"] for row in others[0].members(category) if all(row["workload"] in one.frames for one in others)]

    def value_mean(self, study, category, configuration):
        if study not in ("paper", "schemes"):
            rates = self.studies[study.replace("-", " ")].rates[configuration]
            return f"{harmonic_mean([float(rates[name]['rate']) for name in self.common_members(category)]):.2f}"
        return f"{self.studies[study.replace('-', ' ')].mean(category, configuration):.2f}"

    def value_payload(self, category, configuration):
        return f"{self.paper.mean(category, configuration, 'rate_payload_hmean'):.2f}"

    def value_relative(self, category, configuration, base):
        return share(self.paper.mean(category, configuration) / self.paper.mean(category, base))

    def value_long_relative(self, category, configuration, base):
        members = self.paper.long_workloads(category)
        return share(self.paper.relative(configuration, base, members)) if members else "-"

    def value_metric(self, category, column):
        return share(self.paper.metric(category, column))

    def value_coverage(self, category, configuration):
        return share(self.paper.mean(category, configuration, "fvc_relative_coverage_mean"))

    def value_ours(self, claim):
        row = self.claims[claim]
        return share(float(row["ours"])) if row["unit"] == "share" else f"{float(row['ours']):.2f}"

    def value_workloads(self, category):
        return str(len(self.paper.members(category)))

    def value_frames(self, category):
        return str(sum(int(row["frames"]) for row in self.paper.members(category)))

    def value_members(self, study):
        return str(len(self.studies[study].workloads if study in self.studies else self.common_members("all")))

    def value_long(self, category):
        return str(len(self.paper.long_workloads(category)))

    def value_worst(self, count, configuration, base):
        """The workloads that lose most by a configuration, with what is left of their rate."""
        ratios = sorted((float(row["rate"]) / float(self.paper.rates[base][name]["rate"]), name)
                        for name, row in self.paper.rates[configuration].items())
        return ", ".join(f"`{name}` {share(ratio)}" for ratio, name in ratios[:int(count)])

    def _by_rate(self, category, configuration):
        return sorted((float(self.paper.rates[configuration][row["workload"]]["rate"]), row["workload"]) for row in self.paper.members(category))

    def value_lowest(self, count, category, configuration):
        return ", ".join(f"`{name}` ({rate:.2f})" for rate, name in self._by_rate(category, configuration)[:int(count)])

    def value_range(self, category, configuration):
        pairs = self._by_rate(category, configuration)
        return " to ".join(f"{rate:.2f} (`{name}`)" for rate, name in (pairs[0], pairs[-1]))

    def value_beaten(self, winner, loser):
        """Workloads on which `winner` has the higher rate."""
        return str(sum(float(row["rate"]) > float(self.paper.rates[loser][name]["rate"])
                       for name, row in self.paper.rates[winner].items()))

    def value_shortest(self):
        return str(min(self.paper.frames.values()))

    def value_longest(self):
        return str(max(self.paper.frames.values()))

    def value_low_rates(self, coverage, rate):
        """A sentence on the workloads of at least this FVC coverage: which have a lower rate with VDCP."""
        names = [row["workload"] for row in self.paper.workloads if float(row["fvc_coverage"]) >= float(coverage)]
        rates = {name: float(self.paper.rates["vdcp"][name]["rate"]) for name in names}
        low = ", ".join(f"`{name}` ({rates[name]:.2f})" for name in sorted(names, key=rates.get) if rates[name] < float(rate))
        return f"Of {len(names)} workloads with such a coverage, {'none is below' if not low else 'these are below: ' + low}"

    def value_translucent(self, category):
        """Workloads whose middle frame has pixels that are not opaque."""
        return str(sum(row["workload"] in self.translucent for row in self.paper.members(category)))

    def value_first(self):
        return f"the first {self.first} frames" if self.first else "all frames"

    def value_renderer(self):
        return ", ".join(sorted({info.get("renderer", "") for info in self.infos}))

    # Tables

    def table_workloads(self):
        heads = ["workload", "category", "frames", "size", "pixel change", "colour change", "colours", "FVC coverage", "VDCP", "RAS",
                 "RED", "HDCP"]
        rows = []
        for row in sorted(self.paper.workloads, key=lambda row: (CATEGORIES.index(row["category"]), row["workload"])):
            rates = [f"{float(self.paper.rates[scheme][row['workload']]['rate']):.2f}" for scheme in ("vdcp", "ras", "red", "hdcp")]
            rows.append([row["workload"], row["category"], row["frames"], f"{row['width']}x{row['height']}",
                         *(share(float(row[column])) for column in ("pixel_change", "color_change")),
                         f"{float(row['unique_colors']):.0f}", share(float(row["fvc_coverage"])), *rates])
        return table(heads, rows)

    def table_categories(self):
        heads = ["category", "workloads", f"of {LONG_FRAMES} frames or more", "frames", "the paper's workloads", "the paper's frames"]
        published = {"UI": ("92", "24031"), "2D": ("20", "7888"), "3D": ("12", "2549"), "all": ("124", "34468")}
        return table(heads, [[category, self.value_workloads(category), self.value_long(category), self.value_frames(category),
                              *published[category]] for category in CATEGORIES], 1)

    def table_schemes(self):
        study = self.studies["schemes"]
        rows = [[group, f"`{scheme}`", *(f"{study.mean(category, scheme):.2f}" for category in CATEGORIES)]
                for group, schemes in self.groups.items() for scheme in schemes]
        return table(["group", "scheme", *CATEGORIES], rows)

    def table_sensitivity(self):
        schemes = [configuration for configuration in self.groups["paper"]]
        heads = ["scheme", "category"] + [name for name in self.studies if name not in ("paper", "schemes")]
        rows = [[f"`{scheme}`", category, *(self.value_mean(name, category, scheme) for name in heads[2:])]
                for scheme in schemes for category in CATEGORIES]
        return table(heads, rows)

    def table_frame_sampling(self):
        periods = [key for key in (2, 5, 10, 20, 30, 40, 50, 60) if f"vdcp:period={key}" in self.paper.rates]
        rows = []
        for category in CATEGORIES:
            for title, members in (("all", [row["workload"] for row in self.paper.members(category)]),
                                   (f"of {LONG_FRAMES} frames or more", self.paper.long_workloads(category))):
                if members:
                    rows.append([category, title, str(len(members)),
                                 *(share(self.paper.relative(f"vdcp:period={period}", "vdcp", members)) for period in periods)])
        return table(["category", "workloads", "count", *(f"N = {period}" for period in periods)], rows)

    def table_claims(self):
        lines = self.claims_text.splitlines()
        return "\n".join(lines[next(number for number, line in enumerate(lines) if line.startswith("|")):])


def fill(text, values, figure):
    """Replaces each {{table:NAME}}, {{figure:NAME}} and {{VALUE}} of the text."""
    def replace(match):
        kind, _, name = match[1].partition(":")
        if kind == "table":
            return getattr(values, "table_" + name.replace("-", "_"))()
        if kind == "figure":
            return figure(name)
        return values.value(match[1].split())
    return re.sub(r"\{\{([^{}]+)\}\}", replace, text)


def read_infos(corpus):
    infos = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(Path(corpus).glob("*/info.json"))]
    if not infos:
        raise Fault(f"{corpus}: no recorded workload")
    return infos
