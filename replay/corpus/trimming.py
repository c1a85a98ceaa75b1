"""Trimming: a trace that presents only the frames of the region of interest.

All calls before the region stay, because they make textures, shaders and buffers. Only their swaps go: what was drawn is
drawn again, but not presented. The frames are compared with those of the whole recording before a trimmed trace is used."""
import re
import subprocess
from dataclasses import dataclass

from corpus_messages import Fault

SWAP = re.compile(r"^(\d+) (eglSwapBuffers\w*|glXSwapBuffers\w*)\(\w+ = (\w+), \w+ = (\w+)")


@dataclass
class Swap:
    call: int
    surface: str


def run_apitrace(words, log):
    done = subprocess.run(["apitrace", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                          check=False)
    log.write(f"$ apitrace {' '.join(word if len(word) < 200 else word[:200] + '...' for word in words)}\n{done.stderr[-2000:]}")
    if done.returncode != 0:
        reason = (done.stderr.strip().splitlines() or [f"status {done.returncode}"])[-1]
        raise Fault(f"apitrace {words[0]}: {reason}")
    return done.stdout


def swaps_of(trace, log):
    """The swaps of a trace in their order."""
    text = run_apitrace(["dump", "--color=never", "--calls=*/frame", str(trace)], log)
    swaps = []
    for line in text.splitlines():
        found = SWAP.match(line)
        if found and found[4] not in ("NULL", "0"):
            swaps.append(Swap(int(found[1]), found[4]))
    return swaps


def call_set(last, without):
    """Calls 0..last but those of `without`, as apitrace writes sets of calls."""
    ranges, begin = [], 0
    for call in sorted(without):
        if call > begin:
            ranges.append(f"{begin}-{call - 1}")
        begin = call + 1
    ranges.append(f"{begin}-{last}")
    return ",".join(ranges)


def choose_region(swaps, presents, begins, count):
    """Indexes into `swaps` of the region's frames: `count` frames of the busiest surface that were presented at `begins`
    seconds or later. `presents` has what was presented at each swap."""
    usable = min(len(swaps), len(presents))
    after = [index for index in range(usable) if presents[index].seconds >= begins]
    if not after:
        raise Fault(f"no frame was presented after {begins} s")
    numbers = {}
    for index in after:
        numbers[swaps[index].surface] = numbers.get(swaps[index].surface, 0) + 1
    surface = max(numbers, key=numbers.get)
    chosen = [index for index in after if swaps[index].surface == surface]
    if len(chosen) < count:
        raise Fault(f"only {len(chosen)} of {count} frames were presented after {begins} s")
    return chosen[:count]


def cut_after(trace, last, output, log):
    run_apitrace(["trim", f"--calls=0-{last}", "-o", str(output), str(trace)], log)


def drop_swaps(trace, swaps, chosen, output, log):
    """Writes a trace without the swaps that are not chosen."""
    if len(swaps) != chosen[-1] + 1:
        raise Fault(f"{len(swaps)} of {chosen[-1] + 1} frames are left after cutting")
    keep = {swaps[index].call for index in chosen}
    last = swaps[chosen[-1]].call
    dropped = [swap.call for swap in swaps if swap.call not in keep and swap.call < last]
    run_apitrace(["trim", f"--calls={call_set(last, dropped)}", "-o", str(output), str(trace)], log)


def pack(trace, output, log):
    """Brotli at quality 9: about as small as 11 and much faster."""
    run_apitrace(["repack", "--brotli=9", str(trace), str(output)], log)
