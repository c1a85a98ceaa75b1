"""Session: a private X server, window manager, message bus and HOME, in which one program runs."""
import os
import shutil
import signal
import subprocess
import threading
import time
from pathlib import Path

import devtools
from corpus_messages import Fault

# Programs draw with llvmpipe, find no sound card and no accessibility bus, and store settings in memory.
ENVIRONMENT = {
    "LANG": "C.UTF-8", "TZ": "UTC", "LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": "llvmpipe", "QT_QPA_PLATFORM": "xcb",
    "GDK_BACKEND": "x11", "GSETTINGS_BACKEND": "memory", "NO_AT_BRIDGE": "1", "GTK_A11Y": "none",
    "SDL_AUDIODRIVER": "dummy", "SDL_VIDEODRIVER": "x11", "ALSOFT_DRIVERS": "null", "AUDIODEV": "null",
    "QT_LOGGING_RULES": "*=false", "PYTHONHASHSEED": "0",
}
MANAGERS = {"matchbox": ["matchbox-window-manager", "-use_titlebar", "no", "-use_cursor", "no"], "none": None}
START_SECONDS = 20


class Session:
    """Use with `with`. Everything that was started ends with it."""

    def __init__(self, folder, size, manager, environment):
        self.folder, self.size, self.manager = folder, size, manager
        self.processes = []
        self.log = open(folder / "session.log", "ab")
        home = folder / "home"
        self.environment = {"PATH": os.environ.get("PATH", "/usr/bin:/bin") + ":/usr/games:/usr/local/games", **ENVIRONMENT,
                            "HOME": str(home)}
        for name, place in (("CONFIG", ".config"), ("CACHE", ".cache"), ("DATA", ".local/share"), ("STATE", ".local/state")):
            self.environment[f"XDG_{name}_HOME"] = str(home / place)
            (home / place).mkdir(parents=True, exist_ok=True)
        runtime = folder / "runtime"
        runtime.mkdir(mode=0o700)
        self.environment["XDG_RUNTIME_DIR"] = str(runtime)
        self.environment.update(environment)

    def start(self, command, **further):
        """Starts a process in a group of its own. Raises Fault if the program is missing."""
        if shutil.which(command[0], path=self.environment["PATH"]) is None:
            raise Fault(f"{command[0]} is not installed (tilepress corpus record --install)")
        process = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log,
                                   cwd=self.environment["HOME"], start_new_session=True, **further)
        self.processes.append(process)
        return process

    def _start_x(self):
        read_end, write_end = os.pipe()
        width, height = self.size
        self.start(["Xvfb", "-displayfd", str(write_end), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", "-noreset"],
                   pass_fds=[write_end])
        os.close(write_end)
        with os.fdopen(read_end) as file:
            number = file.readline().strip()
        if not number:
            raise Fault("Xvfb did not start")
        self.environment["DISPLAY"] = f":{number}"

    def _start_bus(self):
        address = f"unix:path={self.folder}/runtime/bus"
        self.start(["dbus-daemon", "--session", "--nofork", f"--address={address}"])
        self.environment["DBUS_SESSION_BUS_ADDRESS"] = address
        deadline = time.monotonic() + START_SECONDS
        while not (self.folder / "runtime/bus").exists():
            if time.monotonic() > deadline:
                raise Fault("dbus-daemon did not start")
            time.sleep(0.02)

    def __enter__(self):
        try:
            self._start_x()
            self._start_bus()
            if MANAGERS[self.manager]:
                self.start(MANAGERS[self.manager])
                time.sleep(0.5)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            end_group(process)
        self.log.close()

    def _send(self, words):
        if words[0] != "page":
            subprocess.run(["xdotool", *words], env=self.environment, check=False, stdin=subprocess.DEVNULL,
                           stdout=self.log, stderr=self.log, timeout=120)
            return
        try:
            devtools.perform(Path(self.environment["HOME"]), words[1:])
        except (Fault, OSError, ValueError) as error:
            self.log.write(f"page {' '.join(words[1:])}: {error}\n".encode())
            self.log.flush()

    def perform(self, events, begin, over):
        """Starts a thread that sends the events at their times after `begin`, until `over` is set."""
        def send():
            for seconds, words in events:
                if over.wait(max(0.0, begin + seconds - time.monotonic())):
                    return
                self._send(words)
        thread = threading.Thread(target=send, daemon=True)
        thread.start()
        return thread


def _group_lives(group):
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            words = stat.read_text(encoding="utf-8", errors="replace").rsplit(")", 1)[1].split()
        except (OSError, IndexError):
            continue
        if words[2] == str(group) and words[0] != "Z":
            return True
    return False


def end_group(process, patience=10.0):
    """SIGTERM to the process, then SIGKILL to what is left of its group."""
    group = process.pid
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline and (process.poll() is None or _group_lives(group)):
        time.sleep(0.05)
        if process.poll() is not None:
            try:
                os.killpg(group, signal.SIGTERM)
            except ProcessLookupError:
                break
    try:
        os.killpg(group, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass
    process.wait()
