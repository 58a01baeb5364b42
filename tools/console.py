# SPDX-License-Identifier: BSD-3-Clause
"""What the front door says, and where things are."""
from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


class UserError(Exception):
    """Something the user can mend. The text reads: problem (why it is one); what to do."""

    def __init__(self, text: str, code: int = 1) -> None:
        super().__init__(text)
        self.code = code


def say(label: str, text: str) -> None:
    """One line of what is going on, on stderr: stdout is for results."""
    print(f"{label + ':':<9} {text}", file=sys.stderr, flush=True)


def run_script(usage: str | None, counts: tuple[int, ...], work: Callable[..., Iterable[object]],
               arguments: list[str]) -> int:
    """A script of so many arguments: prints line by line what the work returns; returns the exit code."""
    if len(arguments) not in counts:
        print(usage, file=sys.stderr)
        return 2
    try:
        for line in work(*arguments):
            print(line)
    except UserError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.code
    return 0


def build_dir() -> Path:
    """Where the binaries are built; GIMDEM_BUILD_DIR points elsewhere."""
    return Path(os.environ.get("GIMDEM_BUILD_DIR") or ROOT / "build" / "release").resolve()


def server_binary() -> Path:
    return build_dir() / "bin" / "gimdem-server"


def openfoam_client_binary() -> Path:
    return build_dir() / "bin" / "gimdemFoam"


def shown(path: Path) -> str:
    """A path as one would type it here: relative where it is below the current folder."""
    relative = os.path.relpath(path)
    return str(path) if relative.startswith("..") else relative


def tail_of(path: Path, lines: int) -> str:
    """The last lines of a log, empty where there is none."""
    try:
        return "\n".join(path.read_text(errors="replace").splitlines()[-lines:])
    except OSError:
        return ""
