"""Runs the commands of a page in a folder of samples, and compares their output with what the page prints."""
import os
import re
import shutil
import struct
import subprocess
import textwrap
import zlib
from pathlib import Path

from markdown_page import Command

# What stands for the reader's own names.
STAND_INS = [("PROGRAM", "glmark2-es2"), ("IMAGE…", "shots/*.png"), ("TRACE…", "traces/*.trace")]
# Commands that take too long or need what is not here. Their verbs and options are compared with the manual instead.
ONLY_OPTIONS = re.compile(r"tilepress (corpus (?!list)|study (paper|sensitivity|status|retry|merge) (?!.*-n )|.*--manifest|.*librowpal|.*FILE\.frames)")
# Other programs: they build, install, go on in another program, or run for minutes.
OTHER_PROGRAMS = {"cmake", "ctest", "sudo", "cc", "cd", "export", "verilator", "dramsim3main", "python3", "$EDITOR"}
SCRIPTS = re.compile(r"(tools|tests|replay)/[\w./]+")
PYTHON = re.compile(r"^(import|from) \w+", re.M)


def write_png(path, width, height, shift):
    """Flat bars over a slope, moved to the right by `shift` pixels."""
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            bar = (x + shift) // 24 % 3
            rows += bytes((80 * bar, x & 255 if bar == 2 else 200, y // 8 * 8, 255))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)), (b"IDAT", zlib.compress(bytes(rows))), (b"IEND", b"")]
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, content in chunks:
            file.write(struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content)))


def write_script(path, text):
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


class Samples:
    """A folder with what the pages' commands take: shots/, traces/, packed files, an old run, programs that end soon."""

    def __init__(self, folder, tilepress, program, libraries):
        self.folder = Path(folder)
        programs = self.folder / "bin"
        for name in ("bin", "programs", "shots", "traces", "P"):
            (self.folder / name).mkdir()
        (programs / "tilepress").symlink_to(Path(tilepress).resolve())
        (self.folder / "P/lib").symlink_to(Path(libraries).resolve())
        # The sample program under the names that pages use. It draws to no display.
        shutil.copy(program, self.folder / "programs/glmark2-es2")
        for path in (programs / "glmark2-es2", self.folder / "game"):
            write_script(path, f"'{self.folder}/programs/glmark2-es2' 4\n[ $? = 7 ]")
        write_script(programs / "xvfb-run", 'while [ "${1#-}" != "$1" ]; do shift; done; exec "$@"')
        for number in range(4):
            write_png(self.folder / f"shots/{number:03}.png", 168, 112, 8 * number)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "HOME": str(self.folder),
                            "XDG_CACHE_HOME": str(self.folder / "cache")}
        self.environment.pop("DISPLAY", None)
        self.run("apitrace trace -a egl -o traces/glmark2-desktop-glx.trace programs/glmark2-es2 4", keep=(7,))
        self.run("tilepress frames -q -s vdcp -o old-run shots/*.png")
        self.run("tilepress pack -q -s vdcp shots/*.png -o bar.tpk && cp bar.tpk desktop.tpk")

    def run(self, command, keep=(0,)):
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300, check=False)
        output = done.stdout.decode(errors="replace")
        if done.returncode not in keep:
            raise ValueError(f"exit status {done.returncode}: {output.strip()}")
        return output

    def for_page(self, name):
        """A copy for one page, whose results do not meet those of another page."""
        other = Samples.__new__(Samples)
        other.folder, other.environment = self.folder / "pages" / name, self.environment
        other.folder.mkdir(parents=True)
        for sample in ("shots", "traces", "P", "old-run", "game", "bar.tpk", "desktop.tpk"):
            (other.folder / sample).symlink_to(self.folder / sample)
        return other


def shape(line):
    """The line without what depends on inputs and machine: numbers, and the plural that follows from them."""
    line = re.sub(r"(?<![A-Za-z])-?\d[\d.,]*", "#", re.sub(r"\d+x\d+", "# x #", line))
    return re.sub(r"# (\w+?)s\b", r"# \1", " ".join(line.split()))


def missing_line(expected, output):
    """The first line that the output lacks. The output may have further lines between and behind."""
    lines = iter([shape(line) for line in output.splitlines()])
    return next((line for line in expected if shape(line) not in lines), None)


def is_shell(block):
    """A block with prompts, one that says so, or one with a line that begins like a command."""
    if block.language:
        return block.language in ("sh", "bash", "shell", "console")
    return block.is_session() or any(first_word(line) in OTHER_PROGRAMS | {"tilepress"} or SCRIPTS.match(line) or "TILEPRESS_OUT=" in line
                                     for line in block.lines)


def first_word(line):
    return line.split(" ")[0].rstrip()


class PageRun:
    """The commands of a page, in order. `faults` has a line for each that fails or prints something else."""

    def __init__(self, page, tree, samples):
        self.page, self.tree, self.samples = page, Path(tree), samples
        self.faults, self.ran, self.only_options = [], 0, []

    def fault(self, line, text):
        self.faults.append(f"{self.page.path.relative_to(self.tree)}:{line}: {text}")

    def check(self):
        for block in self.page.blocks:
            if block.excuse:
                continue
            if is_shell(block):
                for part in [block] if block.is_session() else block.paragraphs():
                    for command in part.commands() if is_shell(part) else []:
                        self.take(command)
            elif block.language == "python" or PYTHON.search(textwrap.dedent("\n".join(block.lines))):
                self.compile_python(block)
            elif block.lines[0].startswith("#include"):
                self.compile_c(block)
        for line, code in self.page.inline_code():
            if SCRIPTS.match(code) and " " in code:
                self.check_script(Command(line, code))
        return self

    def take(self, command):
        text = command.text
        name = first_word(text)
        if SCRIPTS.match(name):
            self.check_script(command)
        elif name in OTHER_PROGRAMS:
            return
        elif name not in ("tilepress", "xvfb-run") and "=" not in name:
            self.fault(command.line, f"`{name}` is neither run nor excused: put <!-- not run: REASON --> above the block")
        elif ONLY_OPTIONS.match(text):
            self.only_options.append((command.line, text))
        else:
            self.execute(command)

    def check_script(self, command):
        """A script of the tree is there and knows the options."""
        path = self.tree / first_word(command.text)
        if not path.is_file():
            self.fault(command.line, f"{first_word(command.text)}: there is no such file")
            return
        for option in re.findall(r"(?<=\s)--[a-z-]+", re.split(r"&&|\||;", command.text)[0]):
            if option not in path.read_text():
                self.fault(command.line, f"{first_word(command.text)} has no option {option}")

    def execute(self, command):
        text = command.text
        for name, stands_for in STAND_INS:
            text = re.sub(rf"\b{name}", stands_for, text)
        # A study takes minutes: its plan reads all inputs and options.
        text = re.sub(r"^(tilepress study \S+\.toml)", r"\1 -n", text)
        # Pages write into one folder again and again.
        for output in re.findall(r" -o ([\w-]+)(?= |$)", text):
            shutil.rmtree(self.samples.folder / output, ignore_errors=True)
        self.ran += 1
        try:
            output = self.samples.run(text)
        except (ValueError, subprocess.TimeoutExpired) as reason:
            self.fault(command.line, f"`{command.text}` failed: {reason}")
            return
        line = missing_line(command.output, output)
        if line is not None:
            self.fault(command.line, f"`{command.text}` does not print\n  {line}\nbut\n  " + "\n  ".join(output.splitlines()))

    def compile_python(self, block):
        try:
            compile(textwrap.dedent("\n".join(block.lines)), str(self.page.path), "exec")
        except SyntaxError as error:
            self.fault(block.line + (error.lineno or 1) - 1, f"not Python: {error.msg}")

    def compile_c(self, block):
        done = subprocess.run(["cc", "-std=c11", "-Wall", "-Werror", "-fsyntax-only", "-I", str(self.tree / "codec/include"), "-xc", "-"],
                              input="\n".join(block.lines), capture_output=True, text=True, timeout=60, check=False)
        if done.returncode != 0:
            self.fault(block.line, done.stderr.strip())
