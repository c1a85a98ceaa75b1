#!/usr/bin/env python3
"""Completion in bash, zsh and fish offers the same words. Usage: completion_test.py TILEPRESS COMPLETION_FOLDER"""
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(sys.argv[2]).resolve()
# The line, whose last word is being typed, and every word that is offered and begins so.
EXPECTED = {
    ("compa",): {"compare"},
    ("help", "unp"): {"unpack"},
    ("compare", "--thr"): {"--threshold"},
    ("run", "--measure"): {"--measure-overhead"},
    ("export", "--format", ""): {"gem5", "jsonl"},
    ("corpus", "--category", ""): {"UI", "2D", "3D"},
    ("run", "--heatmaps", ""): {"every:"},
    ("run", "--log-level", "w"): {"warn"},
    ("pack", "-s", "hu"): {"huffdcp"},
    ("run", "--", "./a-program", "--thr"): set(),
}
BASH = """source {file}
for line in {lines}; do
  eval "COMP_WORDS=(tilepress $line)"; COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
  _tilepress tilepress; printf '%s\\n' "${{COMPREPLY[@]}}" @
done"""
# Zsh's own functions, which only print what they are to offer.
ZSH = """_describe() {{ local name=$argv[-1]; print -l -- ${{${{(P)name}}%%:*}} }}
compadd() {{ shift; print -l -- $@ }}
_files() {{ }}
_normal() {{ }}
for line in {lines}; do
  eval "words=(tilepress $line)"; CURRENT=$#words PREFIX=$words[-1]
  source {file}; print @
done"""
FISH = """source {file}
for line in {lines}; complete -C "tilepress $line" | string replace -r '\\t.*' ''; echo @; end"""
SHELLS = {
    "bash": (["bash", "--norc", "-c"], BASH, "tilepress.bash"),
    "zsh": (["zsh", "-f", "-c"], ZSH, "_tilepress"),
    "fish": (["fish", "--no-config", "-c"], FISH, "tilepress.fish"),
}


def offered(shell, path):
    """The sets of words that the shell offers for the lines."""
    command, script, file = SHELLS[shell]
    # Fish reads the line as it is typed, the others as words.
    lines = [" ".join(words) if shell == "fish" else shlex.join(words) for words in EXPECTED]
    script = script.format(file=shlex.quote(str(FOLDER / file)), lines=shlex.join(lines))
    done = subprocess.run([*command, script], capture_output=True, text=True, timeout=120, cwd="/",
                          env={**os.environ, "PATH": f"{path}:{os.environ['PATH']}", "HOME": path})
    assert done.returncode == 0 and not done.stderr, f"{shell}: {done.returncode} {done.stderr}"
    answers = done.stdout.split("@\n")[:-1]
    return [{word for word in answer.splitlines() if word.startswith(words[-1]) and word}
            for answer, words in zip(answers, EXPECTED, strict=True)]


def main():
    faults = []
    with tempfile.TemporaryDirectory() as path:
        (Path(path) / "tilepress").symlink_to(Path(sys.argv[1]).resolve())
        for shell in SHELLS:
            for words, got in zip(EXPECTED, offered(shell, path)):
                if got != EXPECTED[words]:
                    faults.append(f"{shell}: tilepress {' '.join(words)}: offers {sorted(got)}, not {sorted(EXPECTED[words])}")
    for fault in faults:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
