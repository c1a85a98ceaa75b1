#!/usr/bin/env python3
"""Opens study.html in headless Chromium at 1280 and 390 pixels: a silent console, drawn lines, numbers of the CSV files, nothing too wide.

study_page_test.py WRITE_OUTPUTS FIGURES_TOML FOLDER_OF_REPORT_TESTS
"""
import csv
import io
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, sys.argv[3])
import make_study  # noqa: E402
import page_in_browser  # noqa: E402

SCRIPT = """<script>
(async () => {
  const texts = [];
  window.Blob = class { constructor(parts) { texts.push(parts.join('')); } };
  URL.createObjectURL = () => 'data:,';
  HTMLAnchorElement.prototype.click = function () { probe.name = this.download; };
  await new Promise(done => setTimeout(done, 200));
  probe.sections = [...document.querySelectorAll('main > section')].map(section => section.id);
  probe.pickers = [...document.querySelectorAll('.line-charts select')].map(pick => pick.options.length);
  for (const box of document.querySelectorAll('[data-plot]')) {
    const canvas = box.querySelector('canvas');
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const colors = new Set();
    for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 200) colors.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
    box.querySelector('button.save').click();
    probe.drawn.push({plot: box.dataset.plot, colors: colors.size, width: canvas.clientWidth, csv: texts.pop(),
                      label: box.querySelector('.lines').getAttribute('aria-label')});
  }
  for (const details of document.querySelectorAll('details')) details.open = true;
  await new Promise(done => setTimeout(done, 200));
  probe.overflow = document.body.scrollWidth - document.body.clientWidth;
  probe.links = [...document.querySelectorAll('main a[href]')].map(link => link.getAttribute('href'));
  probe.claims = [...document.querySelectorAll('#table-claims tbody tr')].length;
  const out = document.createElement('pre');
  out.id = 'probe-result';
  out.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(probe))));
  document.body.append(out);
})().catch(e => { const out = document.createElement('pre'); out.id = 'probe-failed'; out.textContent = String(e.stack); document.body.append(out); });
</script>"""
LINES = {"pixel-and-colour-change", "colour-cdf", "dcp-rate-against-ccd-size", "fvc-size-against-relative-coverage",
         "fvc-size-against-rate", "associativity", "pixel-sampling", "frame-sampling"}
expect = page_in_browser.expect


def check_page(seen, folder, width):
    expect(seen["errors"] == [], f"{width}: the console is not silent: {seen['errors'][:5]}")
    expect(seen["overflow"] <= 0, f"the page is {seen['overflow']} pixels wider than {width}")
    figures = [figure["name"] for figure in json.loads((folder / "figures/figures.json").read_text())["figures"]]
    expect(seen["sections"][0] == "claims" and seen["sections"][1:len(figures) + 1] == figures, f"sections: {seen['sections']}")
    expect(seen["sections"].index("workloads") > len(figures), "the workloads stand before the figures")
    expect({chart["plot"] for chart in seen["drawn"]} == LINES, f"line charts: {[chart['plot'] for chart in seen['drawn']]}")
    expect(seen["pickers"] == [9], f"pickers: {seen['pickers']}")
    for chart in seen["drawn"]:
        expect(chart["colors"] > 10, f"{chart['plot']} is blank")
        expect(200 < chart["width"] <= width, f"{chart['plot']} is {chart['width']} pixels wide")
        expect(" to " in chart["label"], f"{chart['plot']} has no text alternative")
    expect(seen["claims"] >= 30, f"{seen['claims']} claims")
    for link in seen["links"]:
        expect(link.startswith("#") or (folder / link).exists(), f"the link {link} leads nowhere")


def check_values(seen, folder):
    """Lines carry the texts of their axis and the values of the CSV file, to six digits."""
    charts = {chart["plot"]: list(csv.DictReader(io.StringIO(chart["csv"]))) for chart in seen["drawn"]}
    with open(folder / "figures/associativity.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["category"] == "UI"]
    shown = [(row["ways"], f"{float(row['UI applications']):.5f}") for row in charts["associativity"]]
    expect(shown == [(row["ways"], f"{float(row['relative_rate']):.5f}") for row in rows], f"associativity shows {shown}")
    paper = {row["policy"] if "policy" in row else row["sample"]: row["UI applications, paper"] for row in charts["pixel-sampling"]}
    expect(paper["16"] == "0.987" and paper["4"] == "", f"the paper's values: {paper}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "study"
        make_study.write_study(folder, sys.argv[2])
        subprocess.run([sys.argv[1], folder], check=True)
        for width in (1280, 390):
            seen = page_in_browser.probe_page(folder / "study.html", Path(name), width, SCRIPT)
            check_page(seen, folder, width)
            check_values(seen, folder)
    for fault in page_in_browser.faults[:20]:
        print("FAULT:", fault)
    sys.exit(1 if page_in_browser.faults else 0)


if __name__ == "__main__":
    main()
