#!/usr/bin/env python3
"""The manual page and bash completion have every verb and every option that the command itself knows.

Usage: manual_test.py TILEPRESS TOOLS_FOLDER"""
import re
import subprocess
import sys
from pathlib import Path

TILEPRESS, TOOLS = sys.argv[1], Path(sys.argv[2])
# Of every verb: told once.
EVERYWHERE = {"--help", "--config"}
# In the sections "OPTIONS OF SEVERAL VERBS", for the verbs named there.
SHARED = {"run", "replay", "frames", "bench", "pack", "unpack", "compose", "vectors", "view", "memory-trace"}
faults = []


def help_of(*words):
    return subprocess.run([TILEPRESS, "help", *words], capture_output=True, text=True, timeout=60, check=True).stdout


def options_of(verb):
    """--long names that stand where an option is declared, not those in its text."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", help_of(verb), re.M))


def sections(page):
    """Text below each .SH and .SS, by the heading's words."""
    out, heading = {}, ""
    for line in page.replace("\\-", "-").splitlines():
        found = re.match(r"\.S[HS] (.*)", line)
        if found:
            heading = found.group(1)
        else:
            out[heading] = out.get(heading, "") + line + "\n"
    return out


def mentions(text, option):
    return re.search(re.escape(option) + r"(?![a-z-])", text) is not None


def complete(verb):
    script = (f"PATH='{Path(TILEPRESS).resolve().parent}':$PATH; source '{TOOLS}/completion/tilepress.bash'; COMP_WORDS=(tilepress {verb} --); COMP_CWORD=2; "
              f"_tilepress tilepress -- {verb}; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
    return set(subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60, check=True).stdout.split())


def main():
    page = sections((TOOLS / "man/tilepress.1").read_text())
    shared = page["OPTIONS OF SEVERAL VERBS"] + page["MEMORY TRACES"]
    verbs = re.findall(r"^  ([a-z-]+) ", help_of().split("Verbs:\n")[1].split("\n\n")[0], re.M)
    assert len(verbs) > 15 and "help" in verbs, verbs
    count = 0
    for verb in verbs:
        if verb == "help":
            continue
        if verb not in page:
            faults.append(f"the manual has no section on {verb}")
            continue
        options = options_of(verb)
        count += len(options)
        for option in sorted(options):
            if not mentions(page[verb], option) and not (option in EVERYWHERE | {"--quiet"} or verb in SHARED) \
                    or not mentions(page[verb] + shared, option):
                faults.append(f"the manual does not tell of {verb} {option}")
        told = set(re.findall(r"(?<![\w-])(--[a-z][a-z-]*[a-z])", page[verb]))
        for option in sorted(told - options):
            faults.append(f"the manual tells of {verb} {option}, which there is not")
        missing = options - complete(verb)
        if missing:
            faults.append(f"completion of {verb} lacks {sorted(missing)}")
    assert count > 100, count
    for fault in faults:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
