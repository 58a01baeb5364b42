# SPDX-License-Identifier: BSD-3-Clause
"""What the two stand-ins share. They meet through files in the run folder instead of an endpoint."""
from __future__ import annotations

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


def is_running(folder: Path, name: str) -> bool:
    try:
        pid = int((folder / f"{name}.pid").read_text())
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"


def wait_for(condition, patience: float = 30.0) -> bool:
    end = time.monotonic() + patience
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False


def die() -> None:
    os.kill(os.getpid(), signal.SIGKILL)
