"""Input events: lines such as "4.0 tap 300 220", and the xdotool commands that make them.
Words that begin with "page" are for the browser instead (devtools.py).

    TIME tap X Y                       presses and releases
    TIME drag X1 Y1 X2 Y2 SECONDS      a swipe of a finger
    TIME scroll up|down X Y COUNT      turns of the wheel, 50 ms apart
    TIME move X Y                      moves the pointer
    TIME key NAME...                   presses keys, one after the other
    TIME hold NAME SECONDS             holds a key
    TIME press NAME..., release NAME...   presses keys, and lets go of them at another time
    TIME type TEXT                     types a text, 100 ms a letter
    TIME page swipe|press|run ...      an action in Chromium's page
"""
import devtools

STEP_SECONDS = 1 / 60
TAP_SECONDS = 0.08


def _tap(words):
    x, y = devtools.numbers(words, 2)
    return ["mousemove", f"{x:.0f}", f"{y:.0f}", "sleep", "0.05", "mousedown", "1", "sleep", str(TAP_SECONDS), "mouseup", "1"]


def _drag(words):
    x, y, to_x, to_y, seconds = devtools.numbers(words, 5)
    steps = max(2, round(seconds / STEP_SECONDS / 2))
    commands = ["mousemove", f"{x:.0f}", f"{y:.0f}", "sleep", "0.05", "mousedown", "1"]
    for step in range(1, steps + 1):
        part = step / steps
        commands += ["sleep", f"{seconds / steps:.4f}", "mousemove", f"{x + (to_x - x) * part:.0f}", f"{y + (to_y - y) * part:.0f}"]
    return commands + ["sleep", "0.02", "mouseup", "1"]


def _scroll(words):
    if len(words) != 4 or words[0] not in ("up", "down"):
        raise ValueError("takes up or down, X, Y and a count")
    x, y, count = devtools.numbers(words[1:], 3)
    button = "4" if words[0] == "up" else "5"
    return ["mousemove", f"{x:.0f}", f"{y:.0f}", "click", "--repeat", f"{count:.0f}", "--delay", "50", button]


def _move(words):
    x, y = devtools.numbers(words, 2)
    return ["mousemove", f"{x:.0f}", f"{y:.0f}"]


def _key(words):
    if not words:
        raise ValueError("takes a key")
    commands = []
    for word in words:
        commands += ["keydown", word, "sleep", "0.08", "keyup", word, "sleep", "0.05"]
    return commands


def _hold(words):
    if len(words) != 2:
        raise ValueError("takes a key and seconds")
    return ["keydown", words[0], "sleep", f"{float(words[1])}", "keyup", words[0]]


def _of_keys(action):
    def make(words):
        if not words:
            raise ValueError("takes a key")
        return [word for name in words for word in (action, name)]
    return make


def _type(words):
    if not words:
        raise ValueError("takes a text")
    return ["type", "--delay", "100", " ".join(words)]


def _page(words):
    devtools.message(words)
    return ["page", *words]


ACTIONS = {"tap": _tap, "drag": _drag, "scroll": _scroll, "move": _move, "key": _key, "hold": _hold, "press": _of_keys("keydown"),
           "release": _of_keys("keyup"), "type": _type, "page": _page}


def parse(line):
    """Returns (seconds, xdotool words). Raises ValueError."""
    words = line.split()
    if len(words) < 2 or words[1] not in ACTIONS:
        raise ValueError(f"'{line}': the second word is not one of {', '.join(ACTIONS)}")
    try:
        return float(words[0]), ACTIONS[words[1]](words[2:])
    except ValueError as error:
        raise ValueError(f"'{line}': {error}") from error


def faults(block):
    """What is wrong with an [[input]] table whose keys have the right types."""
    found = []
    if block.get("times", 1) > 1 and block.get("every", 0) <= 0:
        found.append("times without every")
    for line in block["do"]:
        try:
            parse(str(line))
        except ValueError as error:
            found.append(str(error))
    return found


def expand(blocks):
    """The events of [[input]] tables as (seconds, xdotool words), sorted by time."""
    events = []
    for block in blocks:
        for turn in range(block.get("times", 1)):
            for line in block["do"]:
                seconds, words = parse(line)
                events.append((block["at"] + turn * block.get("every", 0) + seconds, words))
    return sorted(events, key=lambda event: event[0])
