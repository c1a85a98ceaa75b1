"""What the checks of running captures share: expectations that are collected, waiting, an X server of one's own."""
import os
import subprocess
import sys
import time

faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def wait_for(what, seconds=90):
    """What `what` returns once it is true; None if it is not within the time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = what()
        if found:
            return found
        time.sleep(0.05)
    return None


def end_with_faults():
    for fault in faults:
        print("FAULT:", fault)
    sys.exit(1 if faults else 0)


def start_display(size):
    """An X server on a number of its choice: the process and the value of DISPLAY."""
    reader, writer = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", f"{size}x24", "-nolisten", "tcp", "-noreset"],
                              pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as number:
        return server, ":" + number.readline().strip()
