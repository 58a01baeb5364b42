# SPDX-License-Identifier: BSD-3-Clause
"""OpenFOAM's environment, its mesh generator, and the errors in its logs."""
from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

from console import UserError, shown, tail_of
from process import run_logged

PACKAGED = Path("/usr/share/openfoam")  # of Debian's package
OWN_WORDS = re.compile(r"^gimdemFoam: (.*(?:\n(?!\s*$).*)*)", re.MULTILINE)  # to the next empty line
FATAL = re.compile(r"^--> FOAM FATAL (IO )?ERROR", re.MULTILINE)


def environment() -> dict[str, str]:
    """The environment to run OpenFOAM in: a sourced one as it is, else the package's."""
    env = dict(os.environ)
    if "WM_PROJECT_DIR" not in env:
        env["WM_PROJECT_DIR"] = str(PACKAGED)
    return env


def has_mesh(folder: Path) -> bool:
    return (folder / "constant" / "polyMesh" / "points").exists()


def make_mesh(folder: Path) -> str:
    """Run blockMesh where the case has no ready mesh; returns one line about the mesh."""
    log = folder / "log.blockMesh"
    if has_mesh(folder):
        return "ready in constant/polyMesh"
    if shutil.which("blockMesh") is None:
        raise UserError("blockMesh is not on the PATH (it makes the mesh); run ./gimdem setup, or source OpenFOAM")
    code = run_logged(["blockMesh", "-case", str(folder)], log, env=environment())
    if code != 0:
        raise UserError(f"blockMesh failed: {error_in(log) or 'no reason given'}; see {shown(log)}")
    cells = re.search(r"^\s*nCells:\s*(\d+)", log.read_text(errors="replace"), re.MULTILINE)
    return f"{cells[1]} cells" if cells else "made"


def error_in(log: Path) -> str:
    """The last error of an OpenFOAM program in one line, empty if there is none: its own line, or a fatal block."""
    text = tail_of(log, 200)
    own = OWN_WORDS.findall(text)
    if own:
        return own[-1].strip()
    start = FATAL.search(text)
    if not start:
        return ""
    words = []
    for line in text[start.end() :].splitlines()[1:]:
        line = line.strip()
        if line.startswith(("FOAM exiting", "FOAM aborting", "From ", "in file ")):
            break
        words.append(line)
    return " ".join(" ".join(words).split())
