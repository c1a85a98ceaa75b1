"""Recipes: TOML files that say how a workload is recorded, and the check of their fields."""
import difflib
import re
import tomllib
from dataclasses import MISSING, dataclass, field, fields
from pathlib import Path

import input_events
from corpus_messages import Fault

CATEGORIES = ("UI", "2D", "3D")
WINDOW_FIELDS = {"size": str, "manager": str}
CHECK_FIELDS = {"distinct": int, "change": float, "rate_tolerance": float}
INPUT_FIELDS = {"at": float, "every": float, "times": int, "do": list}
# Chromium draws a page by GL ES through EGL, listens for DevTools, and finds no network. --test-type hides the bar
# about flags.
BROWSER = ["chromium", "--no-sandbox", "--test-type", "--use-gl=angle",
           "--use-angle=gles-egl", "--ignore-gpu-blocklist", "--no-first-run", "--no-default-browser-check",
           "--password-store=basic", "--disable-component-update", "--disable-background-networking",
           "--host-resolver-rules=MAP * ~NOTFOUND", "--allow-file-access-from-files", "--force-device-scale-factor=2",
           "--hide-scrollbars", "--touch-events=enabled", "--remote-debugging-port=0", "--user-data-dir={HOME}/browser"]
DATA = ("pictures", "text", "music", "video")


@dataclass
class Recipe:
    path: Path
    name: str
    category: str
    stands_for: str
    licence: str
    packages: dict
    begins: float
    frames: int
    checks: dict
    command: list = field(default_factory=list)
    page: str = ""
    api: str = ""
    flags: list = field(default_factory=list)
    npm: dict = field(default_factory=dict)
    environment: dict = field(default_factory=dict)
    window: dict = field(default_factory=dict)
    data: list = field(default_factory=list)
    files: dict = field(default_factory=dict)
    clock: str = ""
    input: list = field(default_factory=list)
    remark: str = ""

    @property
    def size(self):
        return tuple(int(side) for side in self.window.get("size", "720x1280").split("x"))

    @property
    def manager(self):
        return self.window.get("manager", "matchbox")

    @property
    def program(self):
        """The command line, with {HOME}, {DATA} and {NPM} in it."""
        return [*BROWSER, *self.flags, f"--app=file://{self.page}"] if self.page else self.command

    def events(self):
        """All timed events, sorted: pairs of seconds after the first frame and an event."""
        return input_events.expand(self.input)

    def __post_init__(self):
        self.api = self.api or ("egl" if self.page else "glx")


FIELDS = {one.name: one for one in fields(Recipe) if one.name != "path"}


def _fits(value, kind):
    if kind is float:
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    return isinstance(value, kind) and not (kind is int and isinstance(value, bool))


def _hint(word, known):
    near = difflib.get_close_matches(word, known, 1)
    return f"did you mean '{near[0]}'? " if near else ""


def _at_line(text, fault):
    """The fault, behind the line of the key that it says is unknown."""
    key = re.search("unknown key '(.*?)'", fault)
    found = key and re.search(rf"(?m)(?:^|[{{,])[ \t]*{re.escape(key[1])}[ \t]*=", text)
    return f"line {text.count(chr(10), 0, found.end()) + 1}: {fault}" if found else fault


def _field_faults(table, fields, where):
    faults = []
    for key, value in table.items():
        if key not in fields:
            hint = _hint(key, fields).strip()
            faults.append(f"{where}unknown key '{key}'" + (f" ({hint})" if hint else ""))
        elif not _fits(value, fields[key]):
            faults.append(f"{where}{key} is not of type {fields[key].__name__}")
    return faults


def _value_faults(table):
    faults = []
    if not re.fullmatch(r"[a-z0-9][a-z0-9-]*", table["name"]):
        faults.append("name has other characters than a-z, 0-9 and -")
    if table["category"] not in CATEGORIES:
        faults.append(f"category '{table['category']}' is not UI, 2D or 3D")
    if table.get("api", "glx") not in ("egl", "glx"):
        faults.append(f"api '{table['api']}' is not egl or glx")
    if not 2 <= table["frames"] <= 2000:
        faults.append("frames is not in 2..2000")
    if not 0 <= table["begins"] <= 300:
        faults.append("begins is not in 0..300 seconds")
    if not table["packages"] or not all(isinstance(version, str) for version in table["packages"].values()):
        faults.append("packages lists no package with its version")
    for key in ("command", "flags"):
        if not all(isinstance(word, str) for word in table.get(key, [])) or table.get(key) == []:
            faults.append(f"{key} is not a list of words")
    if ("command" in table) == ("page" in table):
        faults.append("neither command nor page" if "page" not in table else "both command and page")
    faults += [f"data '{name}' is not one of {', '.join(DATA)}" for name in table.get("data", []) if name not in DATA]
    faults += [f"environment: {key} is no text" for key, value in table.get("environment", {}).items()
               if not isinstance(value, str)]
    for path, text in table.get("files", {}).items():
        if not isinstance(text, str):
            faults.append(f"files: {path} is no text")
        if path.startswith("/") or ".." in path.split("/"):
            faults.append(f"files: {path} is not below HOME")
    for key in ("stands_for", "licence"):
        if not table[key].strip():
            faults.append(f"{key} is empty")
    return faults


def _table_faults(table):
    faults = _field_faults(table.get("window", {}), WINDOW_FIELDS, "window: ")
    if not re.fullmatch(r"[1-9]\d{1,3}x[1-9]\d{1,3}", str(table.get("window", {}).get("size", "720x1280"))):
        faults.append("window: size is not WIDTHxHEIGHT")
    if table.get("window", {}).get("manager", "matchbox") not in ("matchbox", "none"):
        faults.append("window: manager is not matchbox or none")
    faults += _field_faults(table["checks"], CHECK_FIELDS, "checks: ")
    faults += [f"checks: {key} is missing" for key in CHECK_FIELDS if key not in table["checks"]]
    for number, block in enumerate(table.get("input", []), 1):
        where = f"input {number}: "
        if not isinstance(block, dict):
            faults.append(f"{where}not a table")
            continue
        block_faults = _field_faults(block, INPUT_FIELDS, where)
        block_faults += [f"{where}{key} is missing" for key in ("at", "do") if key not in block]
        faults += block_faults or [where + fault for fault in input_events.faults(block)]
    return faults


def faults_of(table, stem):
    """Everything that is wrong with a recipe, a line each."""
    faults = _field_faults(table, {key: one.type for key, one in FIELDS.items()}, "")
    faults += [f"{key} is missing" for key, one in FIELDS.items()
               if one.default is MISSING and one.default_factory is MISSING and key not in table]
    if faults:
        return faults
    faults = _value_faults(table) + _table_faults(table)
    if table["name"] != stem:
        faults.append(f"name '{table['name']}' differs from the file's name")
    return faults


def read_recipe(path):
    """Raises Fault with a line per error."""
    try:
        text = path.read_text(encoding="utf-8")
        table = {"name": path.stem, **tomllib.loads(text)}
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error).splitlines()[0]
        raise Fault(f"{path}: {reason}") from error
    faults = faults_of(table, path.stem)
    if faults:
        raise Fault("\n".join(f"{path}: {_at_line(text, fault)}" for fault in faults))
    return Recipe(path=path, **table)


def read_recipes(folder, names, category):
    """The recipes that are asked for, in the order of their names. Returns recipes and fault lines."""
    recipes, faults = [], []
    paths = {path.stem: path for path in sorted(Path(folder).glob("*.toml"))}
    faults += [f"{name}: no such recipe ({_hint(name, paths)}see tilepress corpus list)" for name in names if name not in paths]
    for stem, path in paths.items():
        if names and stem not in names:
            continue
        try:
            recipe = read_recipe(path)
        except Fault as fault:
            faults += str(fault).splitlines()
            continue
        if category in ("", recipe.category):
            recipes.append(recipe)
    if not recipes and not faults:
        faults.append(f"{folder}: no recipe" + (f" of category {category}" if category else ""))
    return recipes, faults
