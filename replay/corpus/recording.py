"""Recording: runs a recipe's program in a session and leaves its trace with the time of every frame."""
import csv
import os
import shutil
import signal
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import devtools
from corpus_messages import Fault, say
from frame_digests import TILEPRESS
from session import Session
from sample_data import make_data

WRAPPERS = ("/usr/lib/x86_64-linux-gnu/apitrace/wrappers", "/usr/lib/apitrace/wrappers", "/usr/lib/aarch64-linux-gnu/apitrace/wrappers")
FIRST_FRAME_SECONDS = 60
REGION_SECONDS = 120
# A recording ends some frames after the region, because the last calls of a killed program can be lost.
FURTHER_FRAMES = 8
# A canvas that changes in each frame.
NOISE = """(() => {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 512;
  canvas.style.cssText = "position: fixed; left: 0; top: 0; z-index: 100000";
  const context = canvas.getContext("2d"), noise = context.createImageData(512, 512);
  document.body.append(canvas);
  const draw = () => {
    for (let i = 0; i < noise.data.length; i++) noise.data[i] = Math.random() * 256;
    context.putImageData(noise, 0, 0);
    requestAnimationFrame(draw);
  };
  draw();
})()"""
NOISE_SECONDS = 5


def wrapper_of(api):
    name = "egltrace.so" if api == "egl" else "glxtrace.so"
    for folder in WRAPPERS:
        if os.path.isfile(f"{folder}/{name}"):
            return f"{folder}/{name}"
    raise Fault(f"{name}: not found (Debian package apitrace-tracers)")


@dataclass
class Present:
    """A frame that the program presented while it was recorded."""
    seconds: float  # after the first one
    size: tuple     # width and height
    colors: tuple   # number of colours and entropy, which a replay must show too


def presents_of(runs):
    """The frames of the process that presented most."""
    best = []
    for rows in runs.glob("*/frames.csv"):
        try:
            with open(rows, newline="", encoding="utf-8") as file:
                found = [(int(row["time_ns"]), size_of(row), colors_of(row)) for row in csv.DictReader(file) if row.get("entropy")]
        except (OSError, ValueError, csv.Error):
            continue
        if len(found) > len(best):
            best = sorted(found)
    return [Present((time_ns - best[0][0]) / 1e9, size, colors) for time_ns, size, colors in best]


def size_of(row):
    return int(row["width"]), int(row["height"])


def colors_of(row):
    """What identifies the picture of a row of frames.csv or frame_metrics.csv."""
    return int(row["unique_colors"]), round(float(row["entropy"]), 9)


def expand(text, places):
    for name, place in places.items():
        text = text.replace("{" + name + "}", str(place))
    return text


def launch_line(recipe, trace, runs, places):
    """The program under apitrace's wrapper, and that under the shim, which notes when each frame is presented."""
    program = [expand(word, places) for word in recipe.program]
    clock = []
    if recipe.clock:
        clock = ["env", "FAKETIME_DONT_FAKE_MONOTONIC=1", "faketime", recipe.clock]
    script = f'TRACE_FILE="$0" LD_PRELOAD="{wrapper_of(recipe.api)}${{LD_PRELOAD:+:$LD_PRELOAD}}" exec "$@"'
    return [TILEPRESS, "run", "-q", "--via", "glvnd", "-s", "red", "-o", str(runs), "--", *clock, "sh", "-c", script, str(trace), *program]


def _wait_for_first_frame(process, runs):
    deadline = time.monotonic() + FIRST_FRAME_SECONDS
    while not presents_of(runs):
        if process.poll() is not None:
            raise Fault(f"the program ended before its first frame (status {process.returncode})")
        if time.monotonic() > deadline:
            raise Fault(f"no frame within {FIRST_FRAME_SECONDS} s")
        time.sleep(0.03)


def _wait_for_region(recipe, process, runs, begin):
    """Until enough frames were presented after the region's begin, or the program ended."""
    wanted, told = recipe.frames + FURTHER_FRAMES, 0.0
    while process.poll() is None:
        times = presents_of(runs)
        count = sum(1 for present in times if present.seconds >= recipe.begins)
        if count >= wanted or time.monotonic() > begin + recipe.begins + REGION_SECONDS:
            return
        if time.monotonic() - told > 10:
            told = time.monotonic()
            say(f"{recipe.name}: {len(times)} frames, {min(count, recipe.frames)} of {recipe.frames} in the region")
        time.sleep(0.3)


def _end(process, session):
    """Ends a program so that its last calls are written. Some programs take no notice of SIGTERM. At SIGQUIT apitrace's
    wrapper writes what it holds back."""
    process.send_signal(signal.SIGTERM)
    try:
        process.wait(timeout=8)
    except subprocess.TimeoutExpired:
        session.log.write(b"the program did not end at SIGTERM\n")
        os.killpg(process.pid, signal.SIGQUIT)
        try:
            process.wait(timeout=8)
        except subprocess.TimeoutExpired:
            session.log.write(b"the program did not end at SIGQUIT\n")


def _end_browser(process, session):
    """Ends Chromium. It kills the process that draws, with the calls that apitrace's wrapper holds back: up to a megabyte. So
    the page first draws noise, which fills the wrapper's buffer several times."""
    try:
        devtools.perform(Path(session.environment["HOME"]), ["run", NOISE])
    except (Fault, OSError, ValueError) as error:
        session.log.write(f"no noise after the region: {error}\n".encode())
    time.sleep(NOISE_SECONDS)
    os.killpg(process.pid, signal.SIGKILL)


def record_program(recipe, work):
    """Records into work/whole.trace. Returns the trace and its presents. Raises Fault."""
    trace, runs = work / "whole.trace", work / "runs"
    if not shutil.which("xdotool") and recipe.input:
        raise Fault("xdotool is not installed")
    places = {"HOME": work / "home", "DATA": work / "data", "NPM": work / "npm/node_modules"}
    environment = {key: expand(value, places) for key, value in recipe.environment.items()}
    with Session(work, recipe.size, recipe.manager, environment) as session:
        make_data(recipe, places)
        over = threading.Event()
        process = session.start(launch_line(recipe, trace, runs, places))
        try:
            _wait_for_first_frame(process, runs)
            begin = time.monotonic()
            thread = session.perform(recipe.events(), begin, over)
            _wait_for_region(recipe, process, runs, begin)
        finally:
            over.set()
        thread.join(timeout=30)
        if recipe.page:
            _end_browser(process, session)
        else:
            _end(process, session)
    if not trace.exists() or trace.stat().st_size == 0:
        raise Fault(f"nothing was recorded through {recipe.api}")
    return trace, presents_of(runs)
