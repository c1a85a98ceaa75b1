"""Sample data: pictures, texts and pages that programs open. Everything comes from installed free packages or is computed
here from a fixed seed."""
import json
import shutil
import subprocess
from pathlib import Path

from corpus_messages import Fault

# Wallpapers and icons of Debian packages, the first that are there.
PICTURES = ("/usr/share/backgrounds", "/usr/share/wallpapers", "/usr/share/desktop-base", "/usr/share/pixmaps")
PICTURE_BYTES = (20_000, 4_000_000)
TEXTS = ("/usr/share/common-licenses/GPL-3", "/usr/share/common-licenses/Artistic")


def _pictures(place):
    place.mkdir(parents=True, exist_ok=True)
    found = []
    for folder in PICTURES:
        for path in sorted(Path(folder).rglob("*")):
            if path.suffix.lower() in (".jpg", ".jpeg", ".png") and path.is_file() and not path.is_symlink() \
                    and PICTURE_BYTES[0] <= path.stat().st_size <= PICTURE_BYTES[1]:
                found.append(path)
    if not found:
        raise Fault("no pictures on this machine (Debian package plasma-workspace-wallpapers or gnome-backgrounds)")
    for number, path in enumerate(found[:24]):
        shutil.copyfile(path, place / f"{number:02}{path.suffix.lower()}")


def _text(place):
    place.mkdir(parents=True, exist_ok=True)
    (place / "text.txt").write_text("".join(Path(path).read_text(encoding="utf-8", errors="replace") for path in TEXTS),
                                    encoding="utf-8")


def _music(place):
    place.mkdir(parents=True, exist_ok=True)
    for number, name in enumerate(("First", "Second", "Third", "Fourth")):
        tone = f"sine=frequency={220 * (number + 1)}:duration=30"
        done = subprocess.run(["ffmpeg", "-loglevel", "error", "-f", "lavfi", "-i", tone, "-metadata", f"title={name} tone",
                               "-metadata", "artist=Sine", "-metadata", "album=Tones", str(place / f"{number}.ogg")],
                              stdin=subprocess.DEVNULL, capture_output=True, check=False)
        if done.returncode != 0:
            raise Fault("ffmpeg made no music")


def _packages(npm, place):
    """Unpacks npm packages without running any of their scripts."""
    place.parent.mkdir(parents=True, exist_ok=True)
    (place.parent / "package.json").write_text(json.dumps({"name": "pages", "private": True}), encoding="utf-8")
    words = [f"{name}@{version}" for name, version in npm.items()]
    try:
        done = subprocess.run(["npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock", "--legacy-peer-deps",
                               "--omit=dev", *words], cwd=place.parent, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=300, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Fault(f"npm: {error}") from error
    if done.returncode != 0:
        raise Fault(f"npm: {(done.stderr.strip().splitlines() or ['failed'])[0]}")


def make_data(recipe, places):
    makers = {"pictures": lambda: _pictures(places["HOME"] / "Pictures"), "text": lambda: _text(places["DATA"]),
              "music": lambda: _music(places["HOME"] / "Music")}
    for name in recipe.data:
        makers[name]()
    if recipe.npm:
        _packages(recipe.npm, places["NPM"])
