"""Finds dead links in a folder of HTML pages."""
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class LinkReader(HTMLParser):
    """The anchors of a page, and what it links to, each with its line."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)
            elif name in ("href", "src") and value:
                self.links.append((self.getpos()[0], value))


def dead_links(site):
    """A line per link that leads to no file of the site, or to no anchor of its page."""
    pages = {path.resolve(): LinkReader(path) for path in Path(site).rglob("*.html")}
    for path, page in sorted(pages.items()):
        for line, link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            fragment = unquote(parts.fragment)
            if not target.is_file() or not target.is_relative_to(Path(site).resolve()):
                yield f"{path}:{line}: {link}: there is no such file"
            elif fragment and target in pages and fragment not in pages[target].anchors:
                yield f"{path}:{line}: {link}: the page has no such anchor"
