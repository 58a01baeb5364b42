# SPDX-License-Identifier: BSD-3-Clause
"""What the two stand-ins share. They meet through files in the run folder instead of an endpoint."""
from __future__ import annotations

import hashlib
import os
import signal
import sys
import time
from pathlib import Path


def option(name: str) -> str:
    """The value after --name or -name on our command line."""
    return sys.argv[sys.argv.index(name) + 1]


def moods(variable: str) -> set[str]:
    """How to misbehave, e.g. FAKE_SERVER=deaf,stubborn."""
    return set(filter(None, os.environ.get(variable, "").split(",")))


def write_pid(folder: Path, name: str) -> None:
    temporary = folder / f".{name}"
    temporary.write_text(str(os.getpid()))
    temporary.rename(folder / f"{name}.pid")


def pid_of(folder: Path, name: str) -> int:
    return int((folder / f"{name}.pid").read_text())


def state_of(folder: Path, name: str) -> str:
    """The letter of proc(5); Z where there is no such process."""
    try:
        return Path(f"/proc/{pid_of(folder, name)}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return "Z"


def is_running(folder: Path, name: str) -> bool:
    return state_of(folder, name) != "Z"


def is_silent(folder: Path, name: str) -> bool:
    """Gone or stopped."""
    return state_of(folder, name) in "ZT"


def save(folder: Path) -> None:
    """A checkpoint and its time folder, as gimdemFoam records it."""
    (folder / "checkpoints").mkdir(exist_ok=True)
    (folder / "checkpoints" / "step_10.h5").touch()
    (folder / "0.1" / "uniform").mkdir(parents=True, exist_ok=True)
    (folder / "0.1" / "p").write_text("fields")
    digest = hashlib.sha1(b"fields").hexdigest()
    (folder / "0.1" / "uniform" / "gimdemCheckpoint").write_text(
        f'step "10";\ncheckpoint "step_10.h5";\nfiles 1(("p" "6" "{digest}"));\n')


def wait_for(condition, patience: float = 30.0) -> bool:
    end = time.monotonic() + patience
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)
