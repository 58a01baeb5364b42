# SPDX-License-Identifier: BSD-3-Clause
"""From which checkpoint a run goes on, and what the fluid needs to go on with it."""
from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from case_folder import CaseDescription
from console import UserError, shown

CHECKPOINT = re.compile(r"step_(\d+)_at_([-+.e\d]+)\.h5")
FLUID = ("U", "p", "alphaPhi")  # without them the fluid does not go on where it was
# Names of OpenFOAM's time folders have six digits or more; two checkpoints are farther apart than that.
NAME_TOLERANCE = 2e-6


@dataclass
class Restart:
    """A checkpoint of the particles and, in a coupled run, the fields of the fluid at the same time."""

    checkpoint: Path
    fluid: Path | None = None  # folder of the time, in the run that wrote the checkpoint

    def copy_fluid(self, folder: Path) -> None:
        """Give the client of a new run the fields and the mesh, and have it start from them."""
        if self.fluid is None:
            return
        shutil.copytree(self.fluid, folder / self.fluid.name, dirs_exist_ok=True)
        shutil.copytree(self.fluid.parent / "constant" / "polyMesh", folder / "constant" / "polyMesh",
                        dirs_exist_ok=True)
        with (folder / "system" / "controlDict").open("a") as control:
            control.write("\nstartFrom       latestTime; // --restart: the last entry counts\n")


def find_restart(case: CaseDescription, wanted: str | None) -> Restart | None:
    """What --restart asks for; None without it."""
    if wanted is None:
        return None
    if wanted == "latest":
        return latest(case)
    file = Path(wanted)
    if not file.is_file():
        raise UserError(f"there is no checkpoint '{wanted}'; they are in the folder checkpoints of a run", 2)
    file = file.resolve()
    return Restart(file) if case.client == "none" else Restart(file, fluid_of(file, case))


def latest(case: CaseDescription) -> Restart:
    """The newest checkpoint of the newest run of a case that has one, with its fluid."""
    for run in sorted((case.folder / "runs").glob("[0-9]*"), reverse=True):
        for file in sorted((run / "checkpoints").glob("step_*.h5"), reverse=True):
            if case.client == "none":
                return Restart(file)
            if time_folder(file):
                return Restart(file, fluid_of(file, case))
    raise UserError(f"no run of {shown(case.folder)} left a checkpoint (--restart latest goes on from one); run it "
                    "from the start, or give the checkpoint's path", 2)


def fluid_of(checkpoint: Path, case: CaseDescription) -> Path:
    """The fluid's fields at the time of a checkpoint."""
    folder = time_folder(checkpoint)
    if folder is None:
        times = ", ".join(f"{time.name} s" for _, time in sorted(times_of(checkpoint.parents[1]))) or "none"
        raise UserError(f"{shown(checkpoint)} has no fields of the fluid at its time (they must be of one time; there "
                        f"are: {times}); make [output] checkpoint_interval a multiple of writeInterval in "
                        "system/controlDict, or restart from another checkpoint", 2)
    record = folder.parent / "run.json"
    grid = json.loads(record.read_text())["settings"]["grid"] if record.is_file() else case.grid
    if grid != case.grid:
        raise UserError(f"{shown(checkpoint)} is of a run on grid {grid} (its fields do not fit grid {case.grid}); "
                        f"give --grid {grid}", 2)
    return folder


def time_folder(checkpoint: Path) -> Path | None:
    told = CHECKPOINT.fullmatch(checkpoint.name)
    if not told:
        return None
    time = float(told[2])
    near = (folder for at, folder in times_of(checkpoint.parents[1]) if abs(at - time) <= NAME_TOLERANCE * abs(time))
    return next(near, None)


def times_of(run: Path) -> Iterator[tuple[float, Path]]:
    """The time folders of a run that hold a whole state of the fluid."""
    for folder in run.iterdir():
        try:
            time = float(folder.name)
        except ValueError:
            continue
        if all((folder / name).is_file() for name in FLUID):
            yield time, folder
