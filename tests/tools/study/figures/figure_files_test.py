#!/usr/bin/env python3
"""The files made of a study: rows equal the study's formulas, drawings are whole, embedded, deterministic and drawn only when needed.

figure_files_test.py WRITE_OUTPUTS SOURCE_OF_FIGURES
"""
import csv
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import make_study  # noqa: E402

PER_CATEGORY = 4
COLUMN_POINTS = 252  # 3.5 inches
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def near(text, value):
    return text != "" and math.isclose(float(text), value, rel_tol=1e-9)


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def mean_rate(category, configuration):
    return make_study.harmonic([make_study.rate_of(category, w, configuration) for w in range(PER_CATEGORY)])


def check_axis_rows(folder):
    """Means of a relative axis are ratios of harmonic means."""
    seen = 0
    for row in rows_of(folder / "figures/pixel-sampling.csv"):
        if row["category"] == "all":
            continue
        expected = mean_rate(row["category"], row["configuration"]) / mean_rate(row["category"], "vdcp")
        expect(near(row["relative_rate"], expected), f"pixel-sampling {row['category']} {row['sample']}: {row['relative_rate']} is not {expected}")
        seen += 1
    expect(seen == 3 * 8, f"pixel-sampling has {seen} rows")
    ways = [row["ways"] for row in rows_of(folder / "figures/associativity.csv") if row["category"] == "UI"]
    expect(ways == ["1", "2", "4", "8", "16", "32", "full"], f"the ways are {ways}")
    for row in rows_of(folder / "figures/dcp-rate-against-ccd-size.csv"):
        w = int(row["workload"].rsplit("-", 1)[1])
        expect(near(row["rate"], make_study.rate_of(row["category"], w, row["configuration"])), f"rate of {row['workload']} at {row['fvc']}")


def check_category_rows(folder):
    for row in rows_of(folder / "figures/means-dcp-schemes.csv"):
        rates = [1.1 * make_study.rate_of(row["category"], w, row["configuration"]) for w in range(PER_CATEGORY)]
        expect(near(row["rate_payload"], make_study.harmonic(rates)), f"mean of {row['configuration']} in {row['category']}")
        expect(near(row["median"], make_study.median(rates)) and near(row["maximum"], max(rates)), f"spread of {row['configuration']}")
    order = [row["workload"] for row in rows_of(folder / "figures/rates-vdcp-ras-red.csv") if row["configuration"] == "vdcp"]
    expect(order == [name for name, _, _ in make_study.workloads(PER_CATEGORY)], f"the workloads stand as {order}")
    frames = [row for row in rows_of(folder / "figures/pixel-and-colour-change.csv") if row["workload"] == "ui-app-1"]
    expect([int(row["frame"]) for row in frames] == list(range(1, 40)), "frames of ui-app-1: the warm-up frame must be missing")
    expect(all(near(row["pixel_change"], make_study.frame_change("UI", 1, int(row["frame"]))) for row in frames), "pixel change of ui-app-1")


def check_claims(folder, figures_toml):
    claims = {row["id"]: row for row in rows_of(folder / "claims.csv")}
    expect(len(claims) >= 30, f"only {len(claims)} claims")
    for claim, category, configuration in (("vdcp-ui", "UI", "vdcp"), ("ras-3d", "3D", "ras"), ("hdcp-2d", "2D", "hdcp"),
                                           ("policy-lru", "UI", "vdcp:policy=lru")):
        ours = mean_rate(category, configuration)
        row = claims[claim]
        expect(near(row["ours"], ours), f"claim {claim}: {row['ours']} is not {ours}")
        expect(near(row["deviation"], ours / float(row["published"]) - 1), f"deviation of {claim}")
    expect(near(claims["saving-ui"]["ours"], 1 - 1 / mean_rate("UI", "vdcp") - 4.83 / 451.2), "energy saving")
    # Median entropy of four workloads: the second.
    expect(claims["entropy-ui"]["stands_for"] == "ui-app-1", "the workload that stands for Twitter: " + claims["entropy-ui"]["stands_for"])
    # 6000 of the blocks that count as VDCP's are raw either way.
    blocks = [(14000 + 100 * w) / 30000 for w in range(PER_CATEGORY)]
    expect(near(claims["hybrid-share"]["ours"], sum(blocks) / len(blocks)), "share of VDCP's blocks")
    stated = {float(row["published"]) for row in claims.values()} | {0.7}
    for figure in figures_toml:
        for point in figure.get("published", []):
            expect(point["value"] in stated, f"{figure['name']}: no claim states {point['value']}")


def check_tables(folder):
    names = {path.stem for path in (folder / "tables").iterdir()}
    expect(names == {"baseline", "configurations", "workloads", "system", "hardware-cost", "energy"}, f"tables: {sorted(names)}")
    for path in [*(folder / "tables").glob("*.tex"), folder / "claims.tex"]:
        text = path.read_text()
        lines = [line for line in text.splitlines() if line.endswith(r" \\")]
        expect(len({len(re.findall(r"(?<!\\)&", line)) for line in lines}) == 1, f"{path.name}: rows differ in columns")
        expect(text.count("{") - text.count("\\{") == text.count("}") - text.count("\\}"), f"{path.name}: braces do not match")
    for path in [*(folder / "tables").glob("*.md"), folder / "claims.md"]:
        rows = [line for line in path.read_text().splitlines() if line.startswith("|")]
        expect(len({len(re.findall(r"(?<!\\)\|", line)) for line in rows}) == 1, f"{path.name}: rows differ in columns")
    workloads = (folder / "tables/workloads.md").read_text()
    expect("unsupported: surface 0 is RGB565" in workloads, "a workload without results is not named")
    expect("0.00304232" in (folder / "tables/hardware-cost.md").read_text(), "area of the FVC")


def python_with_matplotlib():
    for python in (sys.executable, "python3", "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import matplotlib"], capture_output=True).returncode == 0:
            return python
    sys.exit("matplotlib is missing: apt-get install python3-matplotlib")


def draw(python, folder, **environment):
    return subprocess.run([python, "-B", folder / "figures/draw_figures.py", folder], capture_output=True, text=True, env=environment or None)




def check_drawings(folder, names):
    for name in names:
        root = xml.parse(folder / f"figures/{name}.svg").getroot()
        width = float(root.attrib["width"].removesuffix("pt"))
        expect(abs(width - COLUMN_POINTS) < 0.01, f"{name}.svg is {width} points wide")
        expect(not list(root.iter("{http://www.w3.org/2000/svg}text")), f"{name}.svg needs a font of the reader")
        expect(len(list(root.iter("{http://www.w3.org/2000/svg}path"))) > 20, f"{name}.svg is nearly empty")
        data = (folder / f"figures/{name}.pdf").read_bytes()
        expect(data.startswith(b"%PDF-") and b"%%EOF" in data[-20:], f"{name}.pdf is not whole")
        expect(b"/FontFile2" in data and b"/Type3" not in data, f"{name}.pdf has no embedded TrueType font")
        expect(b"CreationDate" not in data, f"{name}.pdf has a date")


def check_drawing(folder, scripts):
    names = [figure["name"] for figure in json.loads((folder / "figures/figures.json").read_text())["figures"]]
    for script in ("draw_figures.py", "figure_drawings.py", "figure_styles.py"):
        shutil.copy(scripts / script, folder / "figures" / script)
    (folder / "nothing").mkdir()
    (folder / "nothing/matplotlib.py").write_text("raise ImportError('not here')\n")
    python = python_with_matplotlib()
    done = draw(python, folder, PYTHONPATH=str(folder / "nothing"), PATH="/usr/bin:/bin")
    expect(done.returncode == 3 and done.stderr == "", f"without matplotlib: {done.returncode} {done.stderr}")
    twin = folder.parent / "twin"
    shutil.copytree(folder, twin)
    for place in (folder, twin):
        done = draw(python, place)
        expect(done.returncode == 0 and done.stdout + done.stderr == "", f"drawing: {done.returncode} {done.stdout}{done.stderr}")
    check_drawings(folder, names)
    files = [f"figures/{name}.{ending}" for name in names for ending in ("svg", "pdf")]
    for file in files:
        expect((folder / file).read_bytes() == (twin / file).read_bytes(), f"{file} differs when it is drawn again")

    times = {file: (folder / file).stat().st_mtime_ns for file in files}
    rates = folder / "figures/frame-sampling.csv"
    rates.write_text(rates.read_text().replace("UI,5,", "UI,6,", 1))
    (folder / "figures/associativity.pdf").unlink()
    expect(draw(python, folder).returncode == 0, "drawing again")
    again = {file for file in files if times[file] != (folder / file).stat().st_mtime_ns}
    expect(again == {f"figures/{name}.{ending}" for name in ("frame-sampling", "associativity") for ending in ("svg", "pdf")},
           f"drawn again: {sorted(again)}")

    (folder / "figures/hybrid-shares.csv").write_text("workload\nx\n")
    done = draw(python, folder)
    expect(done.returncode == 1 and done.stderr.count("\n") == 1 and "hybrid-shares: not drawn: " in done.stderr, f"a torn file: {done.stderr}")


def check_odd_names(program, scripts, folder):
    """Names with signs that CSV, HTML, LaTeX and matplotlib's formulas reserve, and a category in another spelling."""
    toml = folder.parent / "odd.toml"
    toml.write_text("""[[figure]]
name = "rates"
kind = "rates of workloads"
title = "R & D <$x_1$>"
[[figure]]
name = "means"
kind = "means"
configurations = ["vdcp"]
published = [{x = "vdcp", category = "UI", value = 5.26}]
[[figure]]
name = "gone"
kind = "rate over an axis"
axis = "nowhere"
""")
    plain, base = make_study.workloads, make_study.BASE
    make_study.BASE = {"ui": 4.0}
    make_study.workloads = lambda count: [(f'a_{w}, "$x$" & <b>\\', "ui", w) for w in range(count)]
    try:
        make_study.write_study(folder, toml, 2)
    finally:
        make_study.workloads, make_study.BASE = plain, base
    done = subprocess.run([program, folder], capture_output=True, text=True)
    expect(done.stdout == "figure gone: the study has no axis 'nowhere'\n" and done.returncode == 0, f"odd names: {done.stdout}{done.stderr}")
    for script in ("draw_figures.py", "figure_drawings.py", "figure_styles.py"):
        shutil.copy(scripts / script, folder / "figures" / script)
    done = draw(python_with_matplotlib(), folder)
    expect(done.returncode == 0 and done.stderr == "", f"odd names: {done.stderr}")
    names = {row["workload"] for row in rows_of(folder / "figures/rates.csv")}
    expect(names == {f'a_{w}, "$x$" & <b>\\' for w in range(2)}, f"odd names became {names}")
    expect([row["published"] for row in rows_of(folder / "figures/means.csv") if row["category"] == "ui"] == ["5.26"], "'ui' is not 'UI'")
    claims = {row["id"]: row for row in rows_of(folder / "claims.csv")}
    expect(claims["vdcp-ui"]["workloads"] == "2" and claims["vdcp-3d"]["ours"] == "", "claims of 'ui' and of no category")
    page = (folder / "study.html").read_text()
    expect("<b>" not in page and "R &amp; D &lt;$x_1$&gt;" in page, "names are not escaped on the page")


def main():
    program, source = sys.argv[1], Path(sys.argv[2])
    toml = source / "paper_figures.toml"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "study"
        make_study.write_study(folder, toml, PER_CATEGORY)
        done = subprocess.run([program, folder], capture_output=True, text=True)
        expect(done.returncode == 0 and done.stdout + done.stderr == "", f"outputs: {done.stdout}{done.stderr}")
        check_axis_rows(folder)
        check_category_rows(folder)
        check_claims(folder, tomllib.loads(toml.read_text())["figure"])
        check_tables(folder)
        check_drawing(folder, source)
        check_odd_names(program, source, Path(name) / "odd")
    for fault in faults[:20]:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
