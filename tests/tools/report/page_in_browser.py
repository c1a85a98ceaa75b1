#!/usr/bin/env python3
"""Opens a report in headless Chromium: no console error, charts drawn, every number equal to the CSV files' own.

page_in_browser.py TILEPRESS. The page gets a probe script that walks through runs and surfaces, presses every download
button and leaves what it saw in the document.
"""
import csv
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import make_runs  # noqa: E402

PROBE_HEAD = """<script>
window.probe = {errors: [], downloads: {}, drawn: []};
addEventListener('error', e => probe.errors.push('error: ' + e.message));
addEventListener('securitypolicyviolation', e => probe.errors.push('policy: ' + e.blockedURI));
for (const level of ['error', 'warn']) { const old = console[level]; console[level] = (...a) => { probe.errors.push(level + ': ' + a.join(' ')); old(...a); }; }
</script>"""
PROBE_TAIL = """<script>
(async () => {
  // Nothing here may wait for another process: the browser's virtual time runs out meanwhile.
  const texts = [];
  window.Blob = class { constructor(parts) { texts.push(parts.join('')); } };
  URL.createObjectURL = () => 'data:,';
  HTMLAnchorElement.prototype.click = function () { this.clicked = probe.name = this.download; };
  const press = (button, key) => {
    button.click();
    probe.downloads[key + probe.name] = texts.pop();
  };
  const inked = canvas => {
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const colors = new Set();
    for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 200) colors.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
    return colors.size;
  };
  const walk = async key => {
    // uPlot draws once the script that asked for it has ended.
    await new Promise(done => setTimeout(done, 50));
    for (const box of document.querySelectorAll('section.run:not([hidden]) .line-charts [data-plot]')) {
      const canvas = box.querySelector('canvas');
      probe.drawn.push({key, plot: box.dataset.plot, points: Number(box.querySelector('.lines').dataset.drawn), colors: inked(canvas),
                        width: canvas.clientWidth, label: box.querySelector('.lines').getAttribute('aria-label')});
      press(box.querySelector('button.save'), key);
      const details = box.querySelector('details');
      details.open = true;
    }
  };
  for (const button of document.querySelectorAll('button[data-table]')) press(button, '');
  const pick = document.getElementById('run-pick');
  for (let run = 0; run < (pick ? pick.options.length : 1); ++run) {
    if (pick) { pick.value = run; pick.dispatchEvent(new Event('change')); }
    await walk(run + '/');
    const surface = document.querySelector('section.run:not([hidden]) .line-charts select');
    for (let i = 1; surface && i < surface.options.length; ++i) {
      surface.value = i; surface.dispatchEvent(new Event('change'));
      await walk(run + '/');
    }
  }
  await new Promise(done => setTimeout(done, 200));
  probe.tables = document.querySelectorAll('.line-charts details table').length;
  probe.overflow = document.body.scrollWidth - document.body.clientWidth;
  probe.width = document.body.offsetWidth;
  for (const theme of ['dark', 'light']) {
    document.getElementById('theme').value = theme;
    document.getElementById('theme').dispatchEvent(new Event('change'));
    probe[theme] = [getComputedStyle(document.documentElement).backgroundColor, document.querySelectorAll('canvas').length];
  }
  dispatchEvent(new Event('beforeprint'));
  dispatchEvent(new Event('afterprint'));
  const out = document.createElement('pre');
  out.id = 'probe-result';
  out.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(probe))));
  document.body.append(out);
})().catch(e => { const out = document.createElement('pre'); out.id = 'probe-failed'; out.textContent = String(e.stack); document.body.append(out); });
</script>"""

faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def near(text, value, digits=12):
    return text != "" and math.isclose(float(text), value, rel_tol=10 ** -digits, abs_tol=1e-12)


def browser():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return name
    sys.exit("no chromium found: apt-get install chromium")


def probe_page(page, folder, width, script=PROBE_TAIL):
    """Opens the page at this width and returns what the script saw."""
    text = page.read_text()
    expect(not re.search(r'(src|href)="(https?:)?//', text), "the page refers to the network")
    # Chromium's windows are at least 500 pixels wide; a narrower page has to be told.
    narrow = f"<style>html {{ width: {width}px; }}</style>" if width < 500 else ""
    text = text.replace("<title>", PROBE_HEAD + narrow + "<title>", 1)
    head, tail = text.rsplit("</body>", 1)
    probed = folder / f"probed-{width}.html"
    probed.write_text(head + script + "</body>" + tail)
    environment = dict(os.environ, HOME=str(folder), XDG_RUNTIME_DIR=str(folder), DBUS_SESSION_BUS_ADDRESS="disabled:")
    environment.pop("LD_PRELOAD", None)
    for attempt in range(2):
        try:
            done = subprocess.run(
                [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
                 "--disable-background-networking", "--hide-scrollbars", f"--user-data-dir={folder}/profile-{width}-{attempt}",
                 f"--window-size={max(width, 500)},900", "--virtual-time-budget=20000", "--enable-logging=stderr", "--dump-dom", probed.as_uri()],
                capture_output=True, text=True, timeout=90, env=environment)
        except subprocess.TimeoutExpired:
            continue
        found = re.search(r'id="probe-result">([^<]*)<', done.stdout)
        if found:
            break
    else:
        sys.exit("the browser gave no result: " + done.stdout[-1500:] + done.stderr[-1500:])
    if not found:
        sys.exit("the probe did not finish: " + done.stdout[-2000:] + done.stderr[-2000:])
    import base64
    return json.loads(base64.b64decode(found.group(1)))


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def read_run(folder):
    return (rows_of((folder / "frames.csv").read_text()), rows_of((folder / "schemes.csv").read_text()),
            json.loads((folder / "run.json").read_text()))


def rate_of(schemes, scheme, bursts):
    rows = [row for row in schemes if row["scheme"] == scheme and row["warmup"] == "0"]
    moved = sum((int(row["bursts"]) * 128 + int(row["palette_bits"]) if bursts else int(row["payload_bits"])) + int(row["csb_bits"]) for row in rows)
    return sum(int(row["raw_bits"]) for row in rows) / moved


def check_numbers(seen, runs):
    downloads = seen["downloads"]
    workloads = rows_of(downloads["workloads.csv"])
    expect(len(workloads) == len(runs), "a workload is missing")
    for row in workloads:
        frames, schemes, info = runs[row["workload"]]
        measured = [frame for frame in frames if frame["warmup"] == "0"]
        expect(row["category"] == info["category"], row["workload"] + ": category")
        expect(int(row["frames"]) == len(frames) and int(row["measured"]) == len(measured), row["workload"] + ": frame counts")
        for column in ("entropy", "pixel_change", "color_change", "fvc_coverage", "unique_colors"):
            mean = sum(float(frame[column]) for frame in measured) / len(measured)
            expect(near(row[column], mean, 9), f"{row['workload']}: {column} {row[column]} is not {mean}")
        for scheme in make_runs.SCHEMES:
            expect(near(row["rate " + scheme], rate_of(schemes, scheme, True)), f"{row['workload']}: rate of {scheme}")
    for row in rows_of(downloads["rates-payload.csv"]):
        expect(near(row["vdcp"], rate_of(runs[row["workload"]][1], "vdcp", False)), row["workload"] + ": rate_payload of vdcp")
    order = [(["UI", "2D", "3D"].index(row["category"]), float(row["dcp"])) for row in rows_of(downloads["rates-payload.csv"])]
    expect(order == sorted(order), "workloads do not stand in the paper's order")

    means = {}
    for row in rows_of(downloads["means.csv"]):
        rates = [rate_of(schemes, row["scheme"], True) for _, schemes, info in runs.values() if info["category"] == row["category"]]
        means[row["category"], row["scheme"]] = len(rates) / sum(1 / rate for rate in rates)
        expect(near(row["harmonic mean"], means[row["category"], row["scheme"]]), f"mean of {row['scheme']} in {row['category']}")
        expect(int(row["workloads"]) == len(rates), "count of workloads in a mean")
    expect(len(means) == 3 * len(make_runs.SCHEMES), "not every category and scheme has a mean")
    for row in rows_of(downloads["energy.csv"]):
        saving = 1 - 1 / means[row["category"], row["scheme"]] - 4.83 / 451.2
        expect(near(row["saving"], saving, 9), f"saving of {row['scheme']} in {row['category']}")
    published = {(row["category"], row["scheme"], row["accounting"]): row for row in rows_of(downloads["published.csv"])}
    expect(published["UI", "vdcp", "with bursts"]["published mean"] == "5.26", "published mean of vdcp")
    expect(near(published["UI", "vdcp", "with bursts"]["this report"], means["UI", "vdcp"]), "own mean beside the published one")
    for row in rows_of(downloads["hybrid.csv"]):
        rows = [cells for cells in runs[row["workload"]][1] if cells["scheme"] == "hdcp" and cells["warmup"] == "0"]
        expect(int(row["vdcp_blocks"]) == sum(int(cells["vdcp_blocks"]) for cells in rows), row["workload"] + ": VDCP blocks")
        expect(int(row["ras_blocks"]) == sum(int(cells["ras_blocks"]) for cells in rows), row["workload"] + ": RAS blocks")


def check_lines(seen, runs):
    """Every value of a line's CSV is the cell of the run's file, to the six digits that the page keeps."""
    names = [row["workload"] for row in rows_of(seen["downloads"]["workloads.csv"])]
    checked = 0
    for key, text in seen["downloads"].items():
        found = re.fullmatch(r"(\d+)/.*-surface(\d+)-(rate|change|coverage)\.csv", key)
        if not found:
            continue
        frames, schemes, _ = runs[names[int(found.group(1))]]
        cells = {}
        for row in schemes:
            cells[row["frame"], row["surface"], row["scheme"]] = row["rate"]
        for row in frames:
            for column in ("pixel_change", "color_change", "fvc_coverage", "fvc_relative_coverage", "top100_coverage"):
                cells[row["frame"], row["surface"], column] = row[column]
        rows = rows_of(text)
        expect([row["frame"] for row in rows] == [row["frame"] for row in frames if row["surface"] == found.group(2) and row["warmup"] == "0"],
               key + ": frames")
        for row in rows:
            for column, value in row.items():
                if column == "frame":
                    continue
                cell = float(cells[row["frame"], found.group(2), column])
                expect(abs(float(value) - cell) <= abs(cell) * 5.1e-6, f"{key}: frame {row['frame']} {column}: {value} is not {cell}")
                checked += 1
    expect(checked > 1000, f"only {checked} values of lines were checked")


def check_drawn(seen, expected_width):
    expect(seen["errors"] == [], "the console is not silent: " + str(seen["errors"][:5]))
    expected_width = min(expected_width, 1200)
    expect(seen["width"] == expected_width, f"the page is {seen['width']} pixels wide, not {expected_width}")
    expect(seen["overflow"] <= 0, f"the page is {seen['overflow']} pixels wider than its window")
    expect(len(seen["drawn"]) == 12, f"{len(seen['drawn'])} line charts, not 3 for each of 4 surfaces")
    for chart in seen["drawn"]:
        expect(chart["points"] == 59, f"{chart['plot']} of {chart['key']} drew {chart['points']} of 59 points")
        expect(chart["colors"] > 10, f"{chart['plot']} of {chart['key']} is blank")
        expect(200 < chart["width"] <= expected_width, f"{chart['plot']} is {chart['width']} pixels wide")
        expect(" to " in chart["label"], "a line chart has no text alternative")
    expect(seen["dark"][0] != seen["light"][0], "dark and light look the same")
    expect(seen["dark"][1] == seen["light"][1] > 0, "a change of colours lost a chart")


def main():
    tilepress = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        runs = {}
        for i, category in enumerate(["3D", "UI", "2D"]):
            path = folder / "batch" / f"load{i}-{500 + i}"
            make_runs.make_run(path, i, 60, 2 if i == 1 else 1, category)
            runs[f"load{i}"] = read_run(path)
        page = folder / "report.html"
        subprocess.run([tilepress, "report", folder / "batch", "-o", page], check=True)
        for width in (1280, 390):
            seen = probe_page(page, folder, width)
            check_drawn(seen, width)
            check_numbers(seen, runs)
            check_lines(seen, runs)
    for fault in faults[:20]:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
