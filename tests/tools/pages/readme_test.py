#!/usr/bin/env python3
"""Links, commands, options and schemes in every page of the tree hold.

Usage: readme_test.py TILEPRESS TREE SAMPLE_PROGRAM FOLDER_OF_SHIMS

- A link leads to a file of the tree, and its anchor to a heading.
- A shell block is run among small samples. Its output has the lines that the page shows, but for numbers: further lines may
  stand between. A block that cannot run has <!-- not run: REASON --> above it. page_commands.py lists programs and verbs that are never run.
- Python blocks and whole C programs compile.
- Verbs and options in `inline code` are in the manual page. Schemes with their keys are accepted, and the README's table has all of them."""
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import inline_code
from markdown_page import dead_links, pages_of
from page_commands import PageRun, Samples

TILEPRESS, TREE, PROGRAM, SHIMS = sys.argv[1], Path(sys.argv[2]).resolve(), sys.argv[3], sys.argv[4]
# The history names options that were.
HISTORY = {"CHANGELOG.md"}


def run_pages(pages, samples):
    """Two pages at a time: most of a command's time is its start."""
    runs = [PageRun(page, TREE, samples.for_page(str(number))) for number, page in enumerate(pages)]
    with ThreadPoolExecutor(2) as threads:
        return list(threads.map(PageRun.check, runs))


def check_names(pages, runs, known):
    for page, run in zip(pages, runs):
        where = page.path.relative_to(TREE)
        for line, code in run.only_options + list(page.inline_code()):
            for fault in inline_code.unknown_names(code, known):
                yield f"{where}:{line}: {fault}"


def check_schemes(pages, samples):
    """All specifications in one call, and the README's table."""
    listed = set(re.findall(r"^  ([a-z][a-z0-9]+)  ", samples.run("tilepress schemes").split("\nKeys:")[0], re.M))
    readme = next(page for page in pages if page.path == TREE / "README.md")
    table = "\n".join(readme.lines).split("## Schemes")[1].split("\n\n    ")[0].split("\n## ")[0]
    for name in sorted(listed - set(re.findall(r"`([a-z0-9]+)`", table))):
        yield f"README.md: the table of schemes lacks {name}"
    specs = {spec for page in pages for _, code in page.inline_code() for spec in inline_code.specs_in(code, listed)}
    assert len(listed) > 15 and len(specs) > 5, (listed, specs)
    try:
        samples.run("tilepress frames -q -o specs " + " ".join(f"-s '{spec}'" for spec in sorted(specs)) + " shots/000.png")
    except ValueError as reason:
        yield f"a scheme of the pages is refused: {reason}"


def main():
    pages = pages_of(TREE)
    faults = list(dead_links(pages, TREE))
    pages = [page for page in pages if page.path.name not in HISTORY]
    with tempfile.TemporaryDirectory(prefix="tilepress-pages-") as folder:
        samples = Samples(folder, TILEPRESS, PROGRAM, SHIMS)
        runs = run_pages(pages, samples)
        faults += [fault for run in runs for fault in run.faults]
        faults += check_names(pages, runs, inline_code.Manual(TREE / "tools/man/tilepress.1"))
        faults += check_schemes(pages, samples)
    count = sum(run.ran for run in runs)
    assert count > 20, count
    for fault in faults:
        print("FAULT:", fault)
    print(f"{len(pages)} pages, {count} commands run")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
