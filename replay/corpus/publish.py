"""Publishing: verifies recorded workloads, and packs them into an archive that others can use."""
import json
import tarfile
import tempfile
from pathlib import Path

from corpus_messages import Fault, complain, counted, each_with_time_left, say
from frame_digests import SCHEMES, rates_of, render, sha256_of

README = """# A corpus of OpenGL workloads

Recorded with tilepress from free programs. Each folder is a workload:

- `NAME.trace`: the OpenGL calls (apitrace), cut to the region of interest
- `info.json`: program, packages, licence, frames, rates, digest of every frame
- `thumbnail.png`: the middle frame
- `copyright`: the licences of the program and its artwork
- `log.txt`, `sha256`: how the workload was recorded; checksums

Use the corpus with

    tilepress study paper -o out manifest.toml
    tilepress replay -o out --manifest manifest.toml
    tilepress corpus verify -o .

`SHA256SUMS` has the checksums of all files: `sha256sum -c SHA256SUMS`.

"""


def replay_differences(folder):
    """Replays a workload. Returns how many frames differ, of how many, and the renderer of the recording. Raises Fault, also
    if equal frames have other rates."""
    info = json.loads((folder / "info.json").read_text(encoding="utf-8"))
    trace = folder / f"{folder.name}.trace"
    if sha256_of(trace) != info["trace_sha256"]:
        raise Fault("the trace differs from the recorded one (SHA-256)")
    with tempfile.TemporaryDirectory(prefix="tilepress-corpus-") as work:
        rendering = render(trace, Path(work), SCHEMES)
    digests, recorded = rendering.digests(), info["frame_digests"]
    if len(digests) != len(recorded):
        raise Fault(f"{counted(len(digests), 'frame')} replayed, {len(recorded)} recorded")
    differ = sum(1 for old, new in zip(recorded, digests) if old != new)
    others = [scheme for scheme, rates in rates_of(rendering).items() if rates != info["rates"].get(scheme, rates)]
    if differ == 0 and others:
        raise Fault(f"the frames are equal, but the rates of {', '.join(others)} differ from the recorded ones")
    return differ, len(recorded), info.get("renderer", "")


def verify(folders):
    """Replays each workload and compares the digests of its frames, and the rates if all frames are equal. Returns
    whether all workloads are equal."""
    def bytes_of(folder):
        trace = folder / f"{folder.name}.trace"
        return trace.stat().st_size if trace.exists() else 0

    good = 0
    for folder in each_with_time_left(folders, bytes_of):
        try:
            differ, count, renderer = replay_differences(folder)
        except (Fault, OSError, KeyError, ValueError) as fault:
            complain(f"{folder.name}: {fault}")
            continue
        if differ:
            complain(f"{folder.name}: {differ} of {counted(count, 'frame')} differ from those recorded with {renderer}")
            continue
        good += 1
        say(f"{folder.name}: {counted(count, 'frame')} equal")
    say(f"{good} of {counted(len(folders), 'workload')} equal")
    return good == len(folders)


def manifest_of(infos, prefix=""):
    """The text of a manifest for `tilepress replay --manifest` and `tilepress study`."""
    blocks = []
    for info in infos:
        blocks.append(f'[[trace]]\npath = "{prefix}{info["name"]}/{info["name"]}.trace"\nname = "{info["name"]}"\n'
                      f'category = "{info["category"]}"\nsha256 = "{info["trace_sha256"]}"\n')
    return "\n".join(blocks)


def _table(infos):
    lines = ["| workload | category | stands for | program | licence | frames | size | trace bytes |", "|---|---|---|---|---|--:|--:|--:|"]
    for info in infos:
        packages = ", ".join(f"{name} {version}" for name, version in {**info["packages"], **info.get("npm", {})}.items())
        lines.append(f"| {info['name']} | {info['category']} | {info['stands_for']} | {packages} | {info['licence']} | "
                     f"{info['frames']} | {info['width']}x{info['height']} | {info['trace_bytes']} |")
    return "\n".join(lines) + "\n"


def export(folders, archive):
    """Writes a tar file with the workloads, a manifest, a README and checksums. The same workloads give the same bytes."""
    infos = [json.loads((folder / "info.json").read_text(encoding="utf-8")) for folder in folders]
    root = archive.name.removesuffix(".tar")
    with tempfile.TemporaryDirectory(prefix="tilepress-corpus-") as place:
        work = Path(place)
        (work / "manifest.toml").write_text(manifest_of(infos), encoding="utf-8")
        (work / "README.md").write_text(README + _table(infos), encoding="utf-8")
        files = [(path, f"{folder.name}/{path.name}") for folder in folders for path in sorted(folder.iterdir())]
        files += [(work / name, name) for name in ("README.md", "manifest.toml")]
        (work / "SHA256SUMS").write_text("".join(f"{sha256_of(path)}  {name}\n" for path, name in files), encoding="utf-8")
        files.append((work / "SHA256SUMS", "SHA256SUMS"))
        partial = archive.with_name(archive.name + ".part")
        try:
            with tarfile.open(partial, "w", format=tarfile.PAX_FORMAT) as tar:
                for path, name in files:
                    entry = tar.gettarinfo(path, f"{root}/{name}")
                    entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname, entry.mode = 0, 0, 0, "root", "root", 0o644
                    with open(path, "rb") as file:
                        tar.addfile(entry, file)
            partial.rename(archive)
        finally:
            partial.unlink(missing_ok=True)
    say(f"{archive}: {counted(len(folders), 'workload')}, {archive.stat().st_size} bytes")
