# SPDX-License-Identifier: BSD-3-Clause
"""The fields of each rank, kept beside those that are put together: a restart on the same cut finds every bit."""
from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from restart import CHECKPOINT, RECORD, STEP, State, TimeFolder

KEPT = "ranks"  # folder of a run
DICTIONARY = Path("system") / "decomposeParDict"


def processors(folder: Path) -> list[Path]:
    return sorted(folder.glob("processor[0-9]*"), key=lambda part: int(part.name.removeprefix("processor")))


def keep(run: Path, parts: Sequence[Path]) -> None:
    """Put the parts of a run that has ended out of the way, with the times that can be gone on from."""
    kept = run / KEPT
    for part in parts:
        times = [record.parents[1] for record in part.glob(f"*/{RECORD}") if is_checkpoint_there(run, record)]
        (kept / part.name).mkdir(parents=True)
        for folder in (part / "constant", *times):
            folder.rename(kept / part.name / folder.name)
        shutil.rmtree(part)


def is_checkpoint_there(run: Path, record: Path) -> bool:
    told = CHECKPOINT.search(record.read_text(errors="replace"))
    return told is not None and (run / "checkpoints" / told[1]).is_file()


def usable(state: State, dictionary: Path, ranks: int) -> list[Path]:
    """The parts that the run of before has of the fluid, by rank; none if they are not all whole, or were cut in
    another way than this dictionary tells."""
    run = state.run
    if not (run / DICTIONARY).is_file() or (run / DICTIONARY).read_text() != dictionary.read_text():
        return []
    for folder in (run / KEPT, run):
        parts = processors(folder)
        if len(parts) == ranks and all(is_part(part / state.fluid.name, state.fluid) for part in parts):
            return parts
    return []


def is_part(time: Path, whole: Path) -> bool:
    """Is it whole itself, and of the same checkpoint?"""
    if not (time / RECORD).is_file():
        return False
    record, wanted = (time / RECORD).read_text(errors="replace"), (whole / RECORD).read_text(errors="replace")
    return identity(record) == identity(wanted) and not TimeFolder(time, record, time.parent).own_fault()


def identity(record: str) -> tuple[str, str]:
    """The step and the checkpoint that a record tells."""
    step, checkpoint = STEP.search(record), CHECKPOINT.search(record)
    return step[1] if step else "", checkpoint[1] if checkpoint else ""


def take(parts: Sequence[Path], time: str, run: Path) -> None:
    """Give the ranks of a new run their meshes, and their fields of that time."""
    for part in parts:
        for name in ("constant", time):
            shutil.copytree(part / name, run / part.name / name)
