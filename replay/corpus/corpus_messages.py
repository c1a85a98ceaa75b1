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


def each_with_time_left(items, work_of):
    """Yields `items`. Between two prints how many are done and the time that the others take, if it grows with their
    `work_of(item)`."""
    begin, total, done = time.monotonic(), sum(map(work_of, items)), 0
    for number, item in enumerate(items):
        if number > 0:
            left = (time.monotonic() - begin) * (total - done) / max(done, 1)
            say(f"{number} of {len(items)} done, about {max(left / 60, 1):.0f} min left")
        yield item
        done += work_of(item)


def counted(number, noun):
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
