# SPDX-License-Identifier: BSD-3-Clause
"""A case on disk: what its case.toml says, and whether the chosen client finds what it needs."""
from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from console import UserError, server_binary, shown
from meshes import mesh_source

DICTIONARIES = {
    "0/U": "initial and boundary velocity of the fluid",
    "0/p": "initial and boundary pressure of the fluid",
    "constant/transportProperties": "density and viscosity of the fluid",
    "constant/couplingProperties": "how the client talks to the DEM server",
    "system/controlDict": "time step and output of the fluid",
    "system/fvSchemes": "discretisation of the fluid equations",
    "system/fvSolution": "linear solvers of the fluid equations",
}


@dataclass
class CaseDescription:
    """What the server reads from case.toml; it alone parses that file."""

    file: Path
    title: str
    client: str  # "none": particles alone
    grid: str
    grids: list[str]
    schedule: str
    until: float  # [s]
    endpoint: str
    timeout: float  # a silent peer is dead after this [s]
    keys: str = ""  # folder, docs/security.md
    grace_time: float = 0.0  # a client that was lost may come back within it [s]
    encodings: list[str] = field(default_factory=list)  # of the fields; empty: as the case file says
    device: str = "auto"  # where the particles are computed
    precision: str | None = None  # of the contact laws, None: as the case file says

    @property
    def folder(self) -> Path:
        return self.file.parent


def find_case_file(argument: str) -> Path:
    """The case.toml of a case folder, or of itself."""
    path = Path(argument)
    if path.is_file():
        return path.resolve()
    if not path.is_dir():
        raise UserError(f"there is no case folder '{argument}'; cases that come with gimdem are in cases/", 2)
    if not (path / "case.toml").is_file():
        raise UserError(f"{argument} has no case.toml (it makes a folder a case); see docs/user-guide.md", 2)
    return (path / "case.toml").resolve()


def describe(case_file: Path) -> CaseDescription:
    """Have the server check the case file and tell what is in it."""
    command = [str(server_binary()), "--case", str(case_file), "--describe"]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    except OSError as error:
        raise UserError(f"{shown(server_binary())} cannot be started ({error.strerror}); run ./gimdem build") from None
    if answer.returncode != 0:
        raise UserError(without_prefix(answer.stderr) or f"{shown(case_file)} was refused without a reason")
    try:
        told = json.loads(answer.stdout)
    except json.JSONDecodeError:
        raise UserError(f"{shown(server_binary())} answered --describe with something else (it does not belong to this "
                        "launcher); run ./gimdem build") from None
    return CaseDescription(
        file=case_file, title=told["title"], client=told["client"], grid=told.get("grid", ""),
        grids=told.get("grids", []), schedule=told["schedule"], until=told["until"], endpoint=told["endpoint"],
        timeout=told["timeout"], keys=told.get("keys", ""), grace_time=told.get("grace_time", 0.0),
    )


def without_prefix(text: str) -> str:
    """An error of the server without its own 'error:' in front."""
    text = text.strip()
    for prefix in ("gimdem-server: ", "error: "):
        text = text.removeprefix(prefix)
    return text


def check_grid(case: CaseDescription, grid: str) -> None:
    if grid and grid not in case.grids:
        offer = f"it has {', '.join(case.grids)}" if case.grids else "it has a single one; leave out --grid"
        raise UserError(f"{shown(case.file)} has no grid '{grid}' ({offer})", 2)


def check_openfoam_dictionaries(case: CaseDescription) -> None:
    """Every file that gimdemFoam reads is there; the first absent one is named."""
    wanted = dict(DICTIONARIES)
    mesh = f"system/{mesh_source(case.folder, case.grid).name}"
    if case.grid:
        wanted[mesh] = f"mesh of grid {case.grid}; or a script of gmsh, {case.grid}.geo"
    elif not (case.folder / "constant" / "polyMesh" / "points").exists():
        wanted[mesh] = "mesh; or a script of gmsh, mesh.geo, or a ready mesh in constant/polyMesh"
    for name, purpose in wanted.items():
        if not (case.folder / name).is_file():
            raise UserError(f"{shown(case.folder / name)} is absent (OpenFOAM needs it: {purpose}); "
                            "copy it from cases/wachem-bed and adapt it")
