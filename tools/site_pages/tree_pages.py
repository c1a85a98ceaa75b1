"""Turns the pages of the tree into HTML, with everything that they link to."""
import html
import os
import re
import shutil
import subprocess
from pathlib import Path, PurePosixPath

from github_slug import numbered, slug

# Folders of builds and of other projects, and the text that a page is made from.
LEFT_OUT = {"build", "vendor", ".git", ".cache", "node_modules"}
TEMPLATES = {"replay/corpus/results_text.md"}
COPIED = {".png", ".svg", ".jpg", ".gif", ".csv"}


def pages_of(tree):
    """Paths of all pages, relative to the tree: README.md first, folders in order."""
    found = [path.relative_to(tree) for path in Path(tree).rglob("*.md")]
    return sorted((path for path in found if not LEFT_OUT & set(path.parts) and path.as_posix() not in TEMPLATES),
                  key=lambda path: (path.parent.as_posix(), path.name != "README.md", path.name))


def address(path):
    """Where the site has a file of the tree: pages and text as HTML, pictures and tables as they are."""
    if path.suffix in COPIED:
        return path
    if path.name == "README.md":
        return path.with_name("index.html")
    return path.with_suffix(".html") if path.suffix == ".md" else path.with_name(path.name + ".html")


class Site:
    def __init__(self, tree, folder):
        self.tree, self.folder = Path(tree).resolve(), Path(folder)
        self.pages = pages_of(self.tree)
        self.titles = {page: self.title(page) for page in self.pages}
        self.frame = (self.tree / "tools/site_pages/frame.html").read_text(encoding="utf-8")
        self.linked = set()

    def title(self, page):
        found = re.search(r"^# (.+)$", (self.tree / page).read_text(encoding="utf-8"), re.M)
        return found.group(1).replace("`", "") if found else str(page)

    def write(self):
        for page in self.pages:
            made = subprocess.run(["cmark-gfm", "--unsafe", "-e", "table", "-e", "strikethrough", str(self.tree / page)],
                                  capture_output=True, text=True, check=True).stdout
            made = self.with_anchors(made)
            made = re.sub(r'(href|src)="([^"]+)"', lambda found: f'{found[1]}="{self.target(page, found[2])}"', made)
            made = made.replace("<table>", '<div class="wide"><table>').replace("</table>", "</table></div>")
            self.write_page(address(page), self.titles[page], made)
        for path in sorted(self.linked - set(self.pages)):
            self.write_linked(path)
        shutil.copy(self.tree / "tools/site_pages/style.css", self.folder / "style.css")

    @staticmethod
    def with_anchors(made):
        taken = set()

        def heading(found):
            text = html.unescape(re.sub(r"<[^>]+>", "", found[2]))
            return f'<h{found[1]} id="{numbered(slug(text), taken)}">{found[2]}</h{found[1]}>'
        return re.sub(r"<h([1-6])>(.*?)</h\1>", heading, made, flags=re.S)

    def target(self, page, link):
        """The link as the site has it. Notes what it leads to."""
        if re.match(r"[a-z]+:", link) or link.startswith("#"):
            return link
        name, _, anchor = link.partition("#")
        path = Path(os.path.normpath(self.tree / page.parent / name))
        if not path.exists() or not path.is_relative_to(self.tree):
            return link
        path = path.relative_to(self.tree)
        if (self.tree / path).is_dir():
            path = path / ("README.md" if (self.tree / path / "README.md").exists() else ".")
        self.linked.add(path)
        place = path / "index.html" if (self.tree / path).is_dir() else address(path)
        return os.path.relpath(place, page.parent) + ("#" + anchor if anchor else "")

    def write_linked(self, path):
        source = self.tree / path
        if source.is_dir():
            names = sorted(entry.name + ("/" if entry.is_dir() else "") for entry in source.iterdir() if entry.name not in LEFT_OUT)
            items = "".join(f"<li>{html.escape(name)}</li>" for name in names)
            self.write_page(path / "index.html", f"{path}/", f"<h1>{html.escape(str(path))}/</h1><ul>{items}</ul>")
        elif path.suffix in COPIED:
            (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, self.folder / path)
        else:
            text = html.escape(source.read_text(encoding="utf-8"))
            self.write_page(address(path), str(path), f"<h1>{html.escape(str(path))}</h1><pre>{text}</pre>")

    def write_page(self, place, title, content):
        place = PurePosixPath(place)
        root = "../" * (len(place.parts) - 1)
        pages = "".join(f'<li><a href="{root}{address(page)}">{html.escape(title)}</a></li>' for page, title in self.titles.items())
        fields = {"title": html.escape(title), "root": root, "pages": pages, "content": content}
        out = self.folder / place
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(re.sub(r"\{\{(\w+)\}\}", lambda found: fields[found[1]], self.frame), encoding="utf-8")
