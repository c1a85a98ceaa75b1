"""Comparing two recordings of a corpus: regions of interest, rates within the recipe's tolerance, replays."""
import json
from dataclasses import dataclass, field

import publish
import recipe as recipes
from corpus_messages import Fault, complain, counted

COLUMNS = f"{'name':28} {'kind':4} {'frames':>9} {'size':>11} {'VDCP':>15} {'RAS':>15} {'change %':>13} " \
          f"{'largest':>16} {'allowed':>7}  replays"


@dataclass
class Comparison:
    name: str
    infos: list                                   # of both recordings
    tolerance: float
    faults: list = field(default_factory=list)
    replays: str = "-"

    def __post_init__(self):
        first, second = self.infos
        for what, values in (("frames", [info["frames"] for info in self.infos]),
                             ("size", [f"{info['width']}x{info['height']}" for info in self.infos])):
            if values[0] != values[1]:
                self.faults.append(f"{what} {values[0]} and {values[1]}")
        self.largest, self.scheme = max((100 * abs(second["rates"][scheme]["rate"] / rates["rate"] - 1), scheme)
                                        for scheme, rates in first["rates"].items() if scheme in second["rates"])
        if self.largest > self.tolerance:
            old, new = (info["rates"][self.scheme]["rate"] for info in self.infos)
            self.faults.append(f"the rate of {self.scheme} differs by {self.largest:.1f} % ({old:.2f} and {new:.2f}), "
                               f"the recipe allows {self.tolerance:g} %")

    def replay(self, folders):
        """Replays both recordings and compares their frames with the recorded digests."""
        counts = []
        for folder in folders:
            try:
                differ, count, _ = publish.replay_differences(folder)
            except (Fault, OSError) as fault:
                self.faults.append(f"{folder}: {fault}")
                counts.append("failed")
                continue
            counts.append(f"{count - differ}/{count}")
            if differ:
                self.faults.append(f"{folder}: {differ} of {counted(count, 'frame')} differ from the recorded ones")
        self.replays = " ".join(counts)

    def row(self):
        first, second = self.infos

        def both(text):
            values = [text(info) for info in self.infos]
            return values[0] if values[0] == values[1] else " ".join(values)

        def rates(scheme):
            return " ".join(f"{info['rates'][scheme]['rate']:.2f}" for info in self.infos)

        return (f"{self.name:28} {first['category']:4} {both(lambda info: str(info['frames'])):>9} "
                f"{both(lambda info: '{}x{}'.format(info['width'], info['height'])):>11} {rates('vdcp'):>15} {rates('ras'):>15} "
                f"{first['change_percent']:6.2f} {second['change_percent']:6.2f} "
                f"{self.largest:6.2f} % {self.scheme:>7} {self.tolerance:5g} %  {self.replays}")


def _read_info(folder):
    try:
        info = json.loads((folder / "info.json").read_text(encoding="utf-8"))
        info["rates"]["vdcp"]["rate"], info["rates"]["ras"]["rate"], info["change_percent"]
        return info
    except OSError as error:
        raise Fault(f"{folder}: {error.strerror}") from error
    except (KeyError, TypeError, ValueError) as error:
        raise Fault(f"{folder}/info.json: not the info of a workload ({error})") from error


def _compare_one(roots, recipe, replay):
    folders = [root / recipe.name for root in roots]
    one = Comparison(recipe.name, [_read_info(folder) for folder in folders], recipe.checks["rate_tolerance"])
    if replay:
        one.replay(folders)
    return one


def compare(roots, names, category, recipe_folder, replay):
    """Compares the workloads `names` (default: all) of two folders. Returns the table and whether all recordings agree.
    Each fault is a line on standard error."""
    names = names or sorted({path.parent.name for root in roots for path in root.glob("*/info.json")})
    if not names:
        raise Fault(f"{roots[0]}: no recorded workload")
    chosen, faults = recipes.read_recipes(recipe_folder, names, category)
    for fault in faults:
        complain(fault)
    lines, good = [COLUMNS], 0
    for recipe in chosen:
        try:
            one = _compare_one(roots, recipe, replay)
        except Fault as fault:
            complain(f"{recipe.name}: {fault}")
            continue
        for fault in one.faults:
            complain(f"{one.name}: {fault}")
        lines.append(one.row())
        good += not one.faults
    lines.append(f"{good} of {counted(len(chosen), 'workload')} alike")
    return "\n".join(lines) + "\n", not faults and good == len(chosen)
