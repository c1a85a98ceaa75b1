"""DevTools: input for pages in Chromium, through the browser's own protocol. One connection per action.

    swipe X Y DX DY SPEED     scrolls what lies at X, Y as a finger does that moves by DX, DY, at SPEED pixels a second.
                              Chromium scrolls by touch only on machines with a touch screen, so these are wheel events
    press X Y                 a finger taps
    run SCRIPT                evaluates JavaScript in the page
"""
import base64
import json
import os
import socket
import struct
import time
import urllib.request
from urllib.parse import urlsplit

from corpus_messages import Fault

START_SECONDS = 30
REPLY_SECONDS = 60


def numbers(words, count):
    """The words of an event as numbers; ValueError unless there are `count`."""
    if len(words) != count:
        raise ValueError(f"takes {count} numbers")
    return [float(word) for word in words]


def _swipe(words):
    x, y, by_x, by_y, speed = numbers(words, 5)
    return "Input.synthesizeScrollGesture", {"x": x, "y": y, "xDistance": by_x, "yDistance": by_y, "speed": int(speed),
                                             "gestureSourceType": "mouse"}


def _press(words):
    x, y = numbers(words, 2)
    return "Input.synthesizeTapGesture", {"x": x, "y": y, "gestureSourceType": "touch"}


def _run(words):
    if not words:
        raise ValueError("takes a script")
    return "Runtime.evaluate", {"expression": " ".join(words)}


ACTIONS = {"swipe": _swipe, "press": _press, "run": _run}


def message(words):
    """The method and parameters of an action. Raises ValueError."""
    if not words or words[0] not in ACTIONS:
        raise ValueError(f"takes one of {', '.join(ACTIONS)}")
    return ACTIONS[words[0]](words[1:])


class Connection:
    """A WebSocket to the first page of a browser. Use with `with`."""

    def __init__(self, address):
        place = urlsplit(address)
        self.socket = socket.create_connection((place.hostname, place.port), timeout=REPLY_SECONDS)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {place.path} HTTP/1.1\r\nHost: {place.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        self.input = self.socket.makefile("rb")
        if b" 101 " not in self.input.readline():
            raise Fault("the browser refuses a WebSocket")
        while self.input.readline().strip():
            pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.input.close()
        self.socket.close()

    def _send(self, text):
        data, mask = text.encode(), os.urandom(4)
        size = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + struct.pack(">H", len(data))
        self.socket.sendall(b"\x81" + size + mask + bytes(byte ^ mask[index % 4] for index, byte in enumerate(data)))

    def _receive(self):
        """The next text, without the frames' headers."""
        text, last = b"", False
        while not last:
            first, size = self.input.read(2)
            last, size = bool(first & 0x80), size & 0x7F
            if size >= 126:
                size, = struct.unpack(">H" if size == 126 else ">Q", self.input.read(2 if size == 126 else 8))
            text += self.input.read(size)
        return text.decode("utf-8", errors="replace")

    def call(self, method, parameters):
        """Sends a command and waits for its reply. Raises Fault."""
        self._send(json.dumps({"id": 1, "method": method, "params": parameters}))
        while True:
            reply = json.loads(self._receive())
            if reply.get("id") == 1:
                if "error" in reply:
                    raise Fault(f"{method}: {reply['error'].get('message')}")
                return reply.get("result", {})


def page_of(home):
    """The address of the browser's page. Chromium writes its port into the profile. Raises Fault."""
    deadline = time.monotonic() + START_SECONDS
    while time.monotonic() < deadline:
        for path in home.glob("*/DevToolsActivePort"):
            port = path.read_text(encoding="utf-8").split()[:1]
            if not port:
                continue
            with urllib.request.urlopen(f"http://127.0.0.1:{port[0]}/json/list", timeout=REPLY_SECONDS) as reply:
                pages = [page["webSocketDebuggerUrl"] for page in json.load(reply) if page.get("type") == "page"]
            if pages:
                return pages[0]
        time.sleep(0.2)
    raise Fault("no browser with DevTools runs (recipes start it with --remote-debugging-port=0)")


def perform(home, words):
    """Performs an action in the browser whose profile lies in `home`. Raises Fault, OSError."""
    method, parameters = message(words)
    with Connection(page_of(home)) as connection:
        connection.call(method, parameters)
