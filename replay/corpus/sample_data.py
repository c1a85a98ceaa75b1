"""Sample data: pictures, texts and pages that programs open. Everything comes from installed free packages or is computed
here from a fixed seed."""
import json
import shutil
import subprocess
from pathlib import Path

from corpus_messages import Fault

# Only wallpapers of the recipe's own packages, so that all machines show the same pictures.
PICTURES = ("/usr/share/backgrounds/", "/usr/share/wallpapers/")
PICTURE_BYTES = (20_000, 8_000_000)
PICTURE_SIDE = 1920
TEXTS = ("/usr/share/common-licenses/GPL-3", "/usr/share/common-licenses/Artistic")


def _convert(words):
    """Runs ffmpeg. Raises Fault."""
    try:
        done = subprocess.run(["ffmpeg", "-loglevel", "error", "-y", *words], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False)
    except OSError as error:
        raise Fault(f"ffmpeg: {error.strerror}") from error
    if done.returncode != 0:
        raise Fault(f"ffmpeg: {(done.stderr.strip().splitlines() or ['failed'])[0]}")


def _pictures(place, packages, count=12):
    """Copies wallpapers, and makes them smaller than PICTURE_SIDE."""
    place.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["dpkg-query", "-L", *packages], capture_output=True, text=True, check=False).stdout.splitlines()
    found, names = [], set()
    for path in map(Path, sorted(set(listed))):
        # A wallpaper often lies there in several sizes.
        name = path.parts[4:5]
        if str(path).startswith(PICTURES) and path.suffix.lower() in (".jpg", ".jpeg", ".png", ".webp") and path.is_file() \
                and not path.is_symlink() and "screenshot" not in path.name and name not in names \
                and PICTURE_BYTES[0] <= path.stat().st_size <= PICTURE_BYTES[1]:
            found.append(path)
            if path.is_relative_to("/usr/share/wallpapers"):
                names.add(name)
    if not found:
        raise Fault("the recipe's packages have no pictures in " + " and ".join(PICTURES))
    for number, path in enumerate(found[:count]):
        scale = f"scale='min({PICTURE_SIDE},iw)':'min({PICTURE_SIDE},ih)':force_original_aspect_ratio=decrease"
        _convert(["-i", str(path), "-vf", scale, "-q:v", "2", str(place / f"{number:02}.jpg")])


def _video(place, packages):
    """A film of wallpapers: the camera moves over each for three seconds."""
    _pictures(place / "stills", packages, 6)
    stills = sorted((place / "stills").iterdir())
    words, graph = [], ""
    for number, still in enumerate(stills):
        words += ["-framerate", "24", "-i", str(still)]
        graph += (f"[{number}]scale=1440:1440:force_original_aspect_ratio=increase,loop=71:1,setpts=N,crop=720:1280:"
                  f"x='(iw-720)*t/3':y='(ih-1280)*(1-t/3)',setsar=1,format=yuv420p[v{number}];")
    graph += "".join(f"[v{number}]" for number in range(len(stills))) + f"concat=n={len(stills)}:v=1:a=0"
    _convert([*words, "-filter_complex", graph, "-c:v", "libvpx", "-b:v", "4M", "-deadline", "realtime", "-cpu-used", "8", "-threads", "1",
              str(place / "video.webm")])
    shutil.rmtree(place / "stills")


def _text(place):
    place.mkdir(parents=True, exist_ok=True)
    (place / "text.txt").write_text("".join(Path(path).read_text(encoding="utf-8", errors="replace") for path in TEXTS),
                                    encoding="utf-8")


def _music(place):
    place.mkdir(parents=True, exist_ok=True)
    for number, name in enumerate(("First", "Second", "Third", "Fourth")):
        tone = f"sine=frequency={220 * (number + 1)}:duration=30"
        _convert(["-f", "lavfi", "-i", tone, "-metadata", f"title={name} tone", "-metadata", "artist=Sine", "-metadata", "album=Tones",
                  str(place / f"{number}.ogg")])


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


def _files(texts, home):
    """Writes a program's settings, which are part of the recipe."""
    for name, text in texts.items():
        path = home / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def make_data(recipe, places):
    makers = {"pictures": lambda: _pictures(places["HOME"] / "Pictures", recipe.packages), "text": lambda: _text(places["DATA"]),
              "video": lambda: _video(places["HOME"] / "Videos", recipe.packages), "music": lambda: _music(places["HOME"] / "Music")}
    for name in recipe.data:
        makers[name]()
    _files(recipe.files, places["HOME"])
    if recipe.npm:
        _packages(recipe.npm, places["NPM"])
