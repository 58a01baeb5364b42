# SPDX-License-Identifier: BSD-3-Clause
"""From which checkpoint a run goes on, and what the fluid needs to go on with it."""
from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from case_folder import CaseDescription
from console import UserError, say, shown

RECORD = Path("uniform") / "gimdemCheckpoint"  # in a time folder: it is whole, and belongs to a checkpoint
CHECKPOINT = re.compile(r'^checkpoint\s+"([^"/]+)";', re.MULTILINE)
STEP = re.compile(r'^step\s+"(\d+)";', re.MULTILINE)
FILE = re.compile(r'"([^"]+)"\s+"(\d+)"\s+"([0-9a-f]{40})"')


@dataclass
class Restart:
    """A checkpoint of the particles and, in a coupled run, the time folder that is whole and belongs to it."""

    checkpoint: Path
    fluid: Path | None = None  # in the run that wrote the checkpoint

    def copy_fluid(self, folder: Path) -> None:
        """Give the client of a new run the fields and the mesh."""
        if self.fluid is None:
            return
        shutil.copytree(self.fluid, folder / self.fluid.name, dirs_exist_ok=True)
        shutil.copytree(self.fluid.parent / "constant" / "polyMesh", folder / "constant" / "polyMesh",
                        dirs_exist_ok=True)


@dataclass
class Pair:
    """A time folder with a record, which may be damaged."""

    fluid: Path
    record: str

    @property
    def step(self) -> int:
        told = STEP.search(self.record)
        return int(told[1]) if told else -1

    @property
    def checkpoint(self) -> Path:
        told = CHECKPOINT.search(self.record)
        return self.fluid.parent / "checkpoints" / (told[1] if told else "unknown")

    def fault(self) -> str:
        """What is wrong with it; empty: nothing. The server checks its checkpoint itself."""
        if not self.checkpoint.is_file():
            return f"there is no {shown(self.checkpoint)}"
        return self.damage()

    def damage(self) -> str:
        """The same of the fields alone."""
        files = FILE.findall(self.record)
        for name, size, sha1 in files:
            file = self.fluid / name
            if not file.is_file() or file.stat().st_size != int(size):
                return f"{name} is absent or cut short"
            if hashlib.sha1(file.read_bytes()).hexdigest() != sha1:
                return f"{name} is damaged (its checksum is another)"
        return "" if files else f"{RECORD} is damaged"


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
        if case.client == "none":
            for file in sorted((run / "checkpoints").glob("step_*.h5"), reverse=True):
                return Restart(file)
            continue
        for pair in pairs_of(run):
            fault = pair.fault()
            if not fault:
                return Restart(pair.checkpoint, of_same_grid(pair, case))
            say("restart", f"not from {shown(pair.fluid)}: {fault}")
    raise UserError(f"no run of {shown(case.folder)} left a checkpoint (--restart latest goes on from one); run it "
                    "from the start, or give the checkpoint's path", 2)


def fluid_of(checkpoint: Path, case: CaseDescription) -> Path:
    """The fluid's fields that belong to a checkpoint."""
    pairs = list(pairs_of(checkpoint.parents[1]))
    for pair in pairs:
        if pair.checkpoint == checkpoint:
            fault = pair.fault()
            if fault:
                raise UserError(f"{shown(pair.fluid)}, the fluid of {shown(checkpoint)}, cannot be gone on from: "
                                f"{fault}; restart from another checkpoint", 2)
            return of_same_grid(pair, case)
    whole = ", ".join(pair.checkpoint.name for pair in pairs) or "none"
    raise UserError(f"{shown(checkpoint)} has no fields of the fluid (the client wrote none at its time, or died while it "
                    f"wrote them); restart from one that has: {whole}", 2)


def of_same_grid(pair: Pair, case: CaseDescription) -> Path:
    record = pair.fluid.parent / "run.json"
    grid = json.loads(record.read_text())["settings"]["grid"] if record.is_file() else case.grid
    if grid != case.grid:
        raise UserError(f"{shown(pair.checkpoint)} is of a run on grid {grid} (its fields do not fit grid {case.grid}); "
                        f"give --grid {grid}", 2)
    return pair.fluid


def pairs_of(run: Path) -> Iterator[Pair]:
    """The time folders of a run that the client has told to be whole, newest first."""
    found = [Pair(record.parents[1], record.read_text(errors="replace")) for record in run.glob(f"*/{RECORD}")]
    yield from sorted(found, key=lambda pair: pair.step, reverse=True)
