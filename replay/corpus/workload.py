"""Workloads: a recording becomes a folder with trace, info, thumbnail, licence and checksums."""
import json
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import trimming
from corpus_messages import Fault, counted, say
from frame_digests import SCHEMES, TILEPRESS, rates_of, render, sha256_of
from recording import colors_of, record_program, size_of

THUMBNAIL_WIDTH = 240


def trim(name, trace, presents, begins, count, work, log):
    """Returns the packed trace of the region, its rendering, the numbers of its frames in the recording, and whether it
    equals what the program presented ("program") or a replay of the whole recording ("recording")."""
    swaps = trimming.swaps_of(trace, log)
    if abs(len(swaps) - len(presents)) > trimming_slack(swaps):
        say(f"{name}: {counted(len(swaps), 'swap')} recorded, {counted(len(presents), 'frame')} seen")
    chosen = trimming.choose_region(swaps, presents, begins, count)
    base, region, packed = work / "base.trace", work / "region.trace", work / f"{name}.trace"
    trimming.cut_after(trace, swaps[chosen[-1]].call, base, log)
    # Trimming numbers the calls anew.
    trimming.drop_swaps(base, trimming.swaps_of(base, log), chosen, region, log)
    trimming.pack(region, packed, log)
    say(f"{name}: frames {chosen[0]} to {chosen[-1]} of {len(swaps)}; replaying them")
    rendering = render(packed, work / "region", SCHEMES, log)
    if len(rendering.frames) != count:
        raise Fault(f"{len(rendering.frames)} of {counted(count, 'frame')} replayed")
    # A retracer's window is as large as the largest viewport of the trace.
    for index, row in zip(chosen, rendering.metrics):
        if presents[index].size != size_of(row):
            raise Fault("the replay is {}x{}, the program's window was {}x{}".format(*size_of(row), *presents[index].size))
    presented, replayed = [presents[index].colors for index in chosen], [colors_of(row) for row in rendering.metrics]
    log.write("".join(f"frame {n}: {a} presented, {b} replayed\n" for n, (a, b) in enumerate(zip(presented, replayed)) if a != b))
    if presented == replayed:
        log.write("the trimmed trace shows the colours that the program presented\n")
        return packed, rendering, chosen, "program"
    say(f"{name}: the replay differs from what the program presented; comparing it with the whole recording")
    whole = render(base, work / "base", ["red"], log)
    differ = sum(1 for old, new in zip(whole.digests()[-count:], rendering.digests()) if old != new)
    if differ:
        raise Fault(f"trimming changes the picture: {differ} of {counted(count, 'frame')} differ")
    return packed, rendering, chosen, "recording"


def trimming_slack(swaps):
    """Presents and swaps may differ by what was lost when the program was killed."""
    return max(3, len(swaps) // 50)


def measure(rendering):
    """Figures of the frames: rates, distinct frames, share of changed pixels."""
    change = [float(row["pixel_change"]) for row in rendering.metrics if row["warmup"] == "0"]
    return {
        "frames": len(rendering.frames), "distinct": len(set(rendering.digests())),
        "change_percent": round(100 * sum(change) / len(change), 4) if change else 0.0,
        "width": rendering.frames[0][2], "height": rendering.frames[0][3],
        "rates": rates_of(rendering),
    }


def check(recipe, figures):
    """Raises Fault if the frames are not what the recipe promises."""
    distinct, change = recipe.checks["distinct"], recipe.checks["change"]
    if figures["distinct"] < min(distinct, figures["frames"]):
        raise Fault(f"{counted(figures['distinct'], 'distinct frame')}, the recipe asks for {distinct}")
    if figures["change_percent"] < change:
        raise Fault(f"{figures['change_percent']} % of the pixels change, the recipe asks for {change} %")


def installed_version(package):
    done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def write_thumbnail(rendering, work, output):
    """The middle frame, made smaller if Pillow is there."""
    middle = len(rendering.frames) // 2
    done = subprocess.run([TILEPRESS, "frames", "-q", "-s", "red", "--frames", str(middle), "--dump-frames", "every:1",
                           "-o", str(work / "picture"), str(rendering.cache)],
                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    pictures = list((work / "picture").rglob("*.png"))
    if done.returncode != 0 or not pictures:
        raise Fault(f"no thumbnail: {done.stderr.strip()}")
    try:
        from PIL import Image
    except ImportError:
        shutil.copyfile(pictures[0], output)
        return
    with Image.open(pictures[0]) as picture:
        picture = picture.convert("RGB")
        height = max(1, picture.height * THUMBNAIL_WIDTH // picture.width)
        picture.resize((THUMBNAIL_WIDTH, height), Image.LANCZOS).save(output, optimize=True)


def write_licence(recipe, places, output):
    """The copyright files of the packages, one after the other."""
    text = f"{recipe.name}: {recipe.licence}\n"
    for package in recipe.packages:
        path = Path(f"/usr/share/doc/{package}/copyright")
        if path.is_file():
            text += f"\n==== Debian package {package} {installed_version(package)}\n\n" + path.read_text(encoding="utf-8", errors="replace")
    for package in recipe.npm:
        for path in sorted((places / package).glob("LICEN[SC]E*"))[:1]:
            text += f"\n==== npm package {package}\n\n" + path.read_text(encoding="utf-8", errors="replace")
    output.write_text(text, encoding="utf-8")


def describe(recipe, trimmed, figures, trace):
    _, rendering, chosen, equals = trimmed
    return {
        "name": recipe.name, "category": recipe.category, "stands_for": recipe.stands_for, "licence": recipe.licence,
        "packages": {package: installed_version(package) or version for package, version in recipe.packages.items()},
        "npm": recipe.npm, "recipe_sha256": sha256_of(recipe.path), "recorded": time.strftime("%Y-%m-%d", time.gmtime()),
        "renderer": rendering.origin.get("gl_renderer", ""), "gl_version": rendering.origin.get("gl_version", ""),
        "first_frame": chosen[0], "equals": equals, "trace_bytes": trace.stat().st_size, "trace_sha256": sha256_of(trace), **figures,
        "frames_digest": rendering.digest(), "frame_digests": rendering.digests(),
    }


def store(recipe, work, output, trimmed, log):
    """Writes the workload's folder in one step."""
    packed, rendering = trimmed[:2]
    figures = measure(rendering)
    check(recipe, figures)
    made = Path(tempfile.mkdtemp(prefix=f".{recipe.name}-", dir=output))
    try:
        made.chmod(0o755)
        trace = made / f"{recipe.name}.trace"
        shutil.copyfile(packed, trace)
        info = describe(recipe, trimmed, figures, trace)
        (made / "info.json").write_text(json.dumps(info, indent=1) + "\n", encoding="utf-8")
        write_thumbnail(rendering, work, made / "thumbnail.png")
        write_licence(recipe, work / "npm/node_modules", made / "copyright")
        log.flush()
        shutil.copyfile(work / "log.txt", made / "log.txt")
        with open(made / "log.txt", "ab") as file:
            file.write(b"\n==== program\n" + (work / "session.log").read_bytes()[-100_000:])
        sums = "".join(f"{sha256_of(path)}  {path.name}\n" for path in sorted(made.iterdir()))
        (made / "sha256").write_text(sums, encoding="utf-8")
        final = output / recipe.name
        if final.exists():
            shutil.rmtree(final)
        made.rename(final)
    except BaseException:
        shutil.rmtree(made, ignore_errors=True)
        raise
    return info


def record(recipe, output, keep=None):
    """Records one workload. Returns its info. Raises Fault. `keep`: a folder that keeps the intermediate files."""
    with tempfile.TemporaryDirectory(prefix="tilepress-corpus-", ignore_cleanup_errors=True) as place:
        work = Path(place)
        try:
            with open(work / "log.txt", "w", encoding="utf-8") as log:
                say(f"{recipe.name}: recording {counted(recipe.frames, 'frame')}")
                trace, presents = record_program(recipe, work)
                log.write(f"{len(presents)} frames were presented in {presents[-1].seconds if presents else 0:.1f} s\n")
                trimmed = trim(recipe.name, trace, presents, recipe.begins, recipe.frames, work, log)
                return store(recipe, work, output, trimmed, log)
        except Fault:
            if keep:
                shutil.copytree(work, keep / recipe.name, dirs_exist_ok=True, ignore=shutil.ignore_patterns("home", "runtime"))
            raise
