"""The anchor that GitHub gives to a heading."""
import re


def slug(heading):
    """Of the heading's markdown, or of its text."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def numbered(name, taken):
    """The anchor, with a number if an earlier heading of the page has it. Adds it to `taken`."""
    anchor, count = name, 0
    while anchor in taken:
        count += 1
        anchor = f"{name}-{count}"
    taken.add(anchor)
    return anchor
