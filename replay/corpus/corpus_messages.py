"""Messages: one line each on standard error, and faults that end a workload or the program."""
import sys
import time

QUIET = False
STARTED = time.monotonic()


class Fault(Exception):
    """An error in one line: what is wrong and where."""


def say(text):
    """Prints a progress line."""
    if not QUIET:
        print(f"[{time.monotonic() - STARTED:5.0f} s] {text}", file=sys.stderr, flush=True)


def complain(text):
    """Prints an error line."""
    print(f"tilepress: {text}", file=sys.stderr, flush=True)


def counted(number, noun):
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
