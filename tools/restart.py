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
from typing import ClassVar

from case_folder import CaseDescription
from console import UserError, say, shown

STATES = "states/*.state"  # below a run folder
RECORD = Path("uniform") / "gimdemCheckpoint"  # in a time folder: it is whole, and belongs to a checkpoint
CHECKPOINT = re.compile(r'^checkpoint\s+"([^"/]+)";', re.MULTILINE)
STEP = re.compile(r'^step\s+"(\d+)";', re.MULTILINE)
FILE = re.compile(r'"([^"]+)"\s+"(\d+)"\s+"([0-9a-f]{40})"')


@dataclass
class Restart:
    """A checkpoint of the particles and, in a coupled run, the fluid's state that is whole and belongs to it."""

    checkpoint: Path
    state: State | None = None  # in the run that wrote the checkpoint

    @property
    def fluid(self) -> Path | None:
        return self.state.fluid if self.state else None

    def copy_fluid(self, folder: Path) -> None:
        """Give OpenFOAM in a new run the fields and the mesh. Other clients read their state where it is."""
        if not isinstance(self.state, TimeFolder):
            return
        fluid = self.state.fluid
        shutil.copytree(fluid, folder / fluid.name, dirs_exist_ok=True)
        shutil.copytree(fluid.parent / "constant" / "polyMesh", folder / "constant" / "polyMesh", dirs_exist_ok=True)


@dataclass
class State:
    """What a client has saved together with a checkpoint, as its record tells; it may be damaged."""

    fluid: Path  # folder or file
    record: str
    run: Path  # folder
    checkpoint_words: ClassVar[re.Pattern[str]]
    step_words: ClassVar[re.Pattern[str]]

    @property
    def step(self) -> int:
        told = self.step_words.search(self.record)
        return int(told[1]) if told else -1

    @property
    def checkpoint(self) -> Path:
        told = self.checkpoint_words.search(self.record)
        return self.run / "checkpoints" / (told[1] if told else "unknown")

    def fault(self) -> str:
        """What is wrong with it; empty: nothing. The server checks its checkpoint itself."""
        if not self.checkpoint.is_file():
            return f"there is no {shown(self.checkpoint)}"
        return self.own_fault()

    def own_fault(self) -> str:
        """The same of the fluid alone."""
        raise NotImplementedError

    def options(self) -> list[str]:
        """With which its client goes on from it."""
        raise NotImplementedError


class TimeFolder(State):
    """Of OpenFOAM; the record is a file in it."""

    checkpoint_words = CHECKPOINT
    step_words = STEP

    def options(self) -> list[str]:
        return ["-restart", self.fluid.name]

    def own_fault(self) -> str:
        files = FILE.findall(self.record)
        for name, size, sha1 in files:
            file = self.fluid / name
            if not file.is_file() or file.stat().st_size != int(size):
                return f"{name} is absent or cut short"
            if hashlib.sha1(file.read_bytes()).hexdigest() != sha1:
                return f"{name} is damaged (its checksum is another)"
        return "" if files else f"{RECORD} is damaged"


class StateFile(State):
    """Of any other client, docs/write-a-client.md: a text, which is its own record."""

    checkpoint_words = re.compile(r"^checkpoint\s+([^\s/]+)$", re.MULTILINE)
    step_words = re.compile(r"^step\s+(\d+)$", re.MULTILINE)

    def options(self) -> list[str]:
        return ["--restart", str(self.fluid)]

    def own_fault(self) -> str:
        return "" if self.record.endswith("\nend\n") else "its last line is not 'end' (it is cut short)"


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
    return Restart(file) if case.client == "none" else Restart(file, state_of(file, case))


def latest(case: CaseDescription) -> Restart:
    """The newest checkpoint of the newest run of a case that has one, with its fluid."""
    for run in sorted((case.folder / "runs").glob("[0-9]*"), reverse=True):
        if case.client == "none":
            for file in sorted((run / "checkpoints").glob("step_*.h5"), reverse=True):
                return Restart(file)
            continue
        for state in states_of(run):
            fault = state.fault()
            if not fault:
                return Restart(state.checkpoint, of_same_kind(state, case))
            say("restart", f"not from {shown(state.fluid)}: {fault}")
    raise UserError(f"no run of {shown(case.folder)} left a checkpoint (--restart latest goes on from one); run it "
                    "from the start, or give the checkpoint's path", 2)


def newest_whole(run: Path) -> State | None:
    """From which a client of that run goes on, while the run's server waits for it."""
    return next((state for state in states_of(run) if not state.fault()), None)


def state_of(checkpoint: Path, case: CaseDescription) -> State:
    """The fluid's state that belongs to a checkpoint."""
    states = list(states_of(checkpoint.parents[1]))
    for state in states:
        if state.checkpoint == checkpoint:
            fault = state.fault()
            if fault:
                raise UserError(f"{shown(state.fluid)}, the fluid of {shown(checkpoint)}, cannot be gone on from: "
                                f"{fault}; restart from another checkpoint", 2)
            return of_same_kind(state, case)
    whole = ", ".join(state.checkpoint.name for state in states) or "none"
    raise UserError(f"{shown(checkpoint)} has no fields of the fluid (the client wrote none at its time, or died while it "
                    f"wrote them); restart from one that has: {whole}", 2)


def of_same_kind(state: State, case: CaseDescription) -> State:
    """The same, if this run's client and mesh can go on from it."""
    record = state.run / "run.json"
    grid = json.loads(record.read_text())["settings"]["grid"] if record.is_file() else case.grid
    if grid != case.grid:
        raise UserError(f"{shown(state.checkpoint)} is of a run on grid {grid} (its fields do not fit grid {case.grid}); "
                        f"give --grid {grid}", 2)
    if isinstance(state, TimeFolder) != (case.client == "openfoam"):
        raise UserError(f"{shown(state.fluid)} was written by another solver (the client {case.client} cannot read it); "
                        "go on with the client of that run: --client", 2)
    return state


def states_of(run: Path) -> Iterator[State]:
    """What the clients of a run have told to be whole, newest first."""
    found: list[State] = [TimeFolder(record.parents[1], record.read_text(errors="replace"), run)
                          for record in run.glob(f"*/{RECORD}")]
    found += [StateFile(file, file.read_text(errors="replace"), run) for file in run.glob(STATES)]
    yield from sorted(found, key=lambda state: state.step, reverse=True)
