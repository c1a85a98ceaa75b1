"""A page of the tree as a reader of GitHub sees it: headings, links, code blocks, inline code."""
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/site_pages"))
from github_slug import numbered, slug

# The folders of builds, and code of other projects.
NOT_OURS = {"build", "vendor", ".git", ".cache"}


@dataclass
class Command:
    line: int
    text: str
    output: list = field(default_factory=list)


@dataclass
class Block:
    """A code block. `language` is empty unless the block is fenced and names one. `excuse` is the reason not to run it."""
    line: int
    language: str
    lines: list
    excuse: str

    def is_session(self):
        return any(line.startswith("$ ") for line in self.lines)

    def paragraphs(self):
        """Parts between empty lines."""
        parts = []
        for number, line in enumerate(self.lines, self.line):
            if not line.strip():
                continue
            if not parts or parts[-1].line + len(parts[-1].lines) != number:
                parts.append(Block(number, self.language, [], self.excuse))
            parts[-1].lines.append(line)
        return parts

    def commands(self):
        """The commands of a shell block. In a session the lines without a prompt are output."""
        session, out, open_line = self.is_session(), [], False
        for number, line in enumerate(self.lines, self.line):
            if open_line:
                out[-1].text += "\n" + line
            elif line.startswith("$ ") or (not session and line and not line.startswith("#")):
                out.append(Command(number, line.removeprefix("$ ")))
            elif session and line.strip() and out:
                out[-1].output.append(line)
                continue
            open_line = line.endswith("\\")
        return out


class Page:
    def __init__(self, path):
        self.path = path
        self.lines = path.read_text(encoding="utf-8").splitlines()
        self.blocks, self.prose = self._split()

    def _split(self):
        """Code blocks, and the other lines as pairs of number and text."""
        blocks, prose = [], []
        fence, excuse, in_code, blank = "", "", False, True
        for number, line in enumerate(self.lines, 1):
            fence_line = re.match(r" {0,3}(```|~~~)(\w*)", line)
            excuse_line = re.match(r"<!-- not run: (.+) -->$", line)
            starts_code = not fence and not in_code and blank and line.startswith("    ")
            if fence:
                fence = "" if line.strip() == fence else fence
                blocks[-1].lines += [line] if fence else []
            elif fence_line or starts_code and line.strip():
                blocks.append(Block(number + bool(fence_line), fence_line.group(2) if fence_line else "", [], excuse))
                fence, in_code, excuse = fence_line.group(1) if fence_line else "", not fence_line, ""
            elif in_code and line.strip() and not line.startswith("    "):
                in_code = False
            if in_code:
                blocks[-1].lines.append(line[4:])
            elif excuse_line:
                excuse = excuse_line.group(1)
            elif not fence and not fence_line and line.strip():
                prose.append((number, line))
            blank = not line.strip()
        return blocks, prose

    def anchors(self):
        out = set()
        for _, line in self.prose:
            found = re.match(r"#{1,6} +(.*?)#*$", line)
            if found:
                numbered(slug(found.group(1)), out)
        return out

    def links(self):
        """Line and target of each link and picture."""
        for number, line in self.prose:
            bare = re.sub(r"`[^`]*`", "code", line)
            for target in re.findall(r"\]\(<?([^)\s>]+)>?(?: \"[^\"]*\")?\)", bare) + re.findall(r"(?:src|href)=\"([^\"]+)\"", bare):
                yield number, target

    def inline_code(self):
        """Line and text of each `code` span, which may go on in the next line."""
        text, starts = "", []
        for number, line in self.prose:
            starts.append((len(text), number))
            text += line + "\n"
        for found in re.finditer(r"(?<!`)`([^`]+)`(?!`)", text):
            yield max(n for at, n in starts if at <= found.start()), " ".join(found.group(1).replace("\\|", "|").split())


def pages_of(tree):
    return [Page(path) for path in sorted(Path(tree).rglob("*.md"))
            if not NOT_OURS & set(path.relative_to(tree).parts) and "node_modules" not in path.parts]


def dead_links(pages, tree):
    anchors = {}
    for page in pages:
        for number, target in page.links():
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = (page.path.parent / name).resolve() if name else page.path.resolve()
            where = f"{page.path.relative_to(tree)}:{number}"
            if not path.exists():
                yield f"{where}: {target}: there is no such file"
            elif not path.is_relative_to(Path(tree).resolve()):
                yield f"{where}: {target}: outside the tree"
            elif anchor and path.suffix == ".md":
                if path not in anchors:
                    anchors[path] = Page(path).anchors()
                if anchor not in anchors[path]:
                    yield f"{where}: {target}: the page has no such heading"
