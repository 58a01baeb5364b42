# SPDX-License-Identifier: BSD-3-Clause
"""Who solves the fluid: how each client is built, started, and what its log says. A new one is one line in CLIENTS."""
from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path

import openfoam
from case_folder import CaseDescription, check_openfoam_dictionaries
from console import ROOT, UserError, build_dir, openfoam_client_binary, shown, tail_of

PYTHON = "/usr/bin/python3"  # the distribution's, which has the packages of apt
EXAMPLES = ROOT / "cfd-client" / "examples"


@dataclass
class Program:
    """A client that is started as COMMAND ENDPOINT RUN_FOLDER [KEYS], makes its own mesh, and ends with `NAME: why` on stderr
    and another exit code than 0 where it fails."""

    name: str
    command: list[str]
    targets: tuple[str, ...] = ()  # of the build

    def check(self, case: CaseDescription) -> None:
        """Before a run: whether the case has what the client needs. Each client of that kind knows for itself."""

    def make_mesh(self, case: CaseDescription, folder: Path) -> str:
        return f"by {self.name}"

    def start_command(self, folder: Path, endpoint: str, keys: str) -> list[str]:
        return [*self.command, endpoint, str(folder)] + ([keys] if keys else [])

    def environment(self) -> dict[str, str]:
        return dict(os.environ)

    def error_in(self, log: Path) -> str:
        """Its last words, in one line; empty if there are none."""
        lines = re.findall(rf"^{re.escape(self.name)}: (.*)$", tail_of(log, 200), re.MULTILINE)
        return lines[-1].strip() if lines else ""


class OpenFoam(Program):
    """gimdemFoam, on a case of OpenFOAM."""

    def check(self, case: CaseDescription) -> None:
        check_openfoam_dictionaries(case)

    def make_mesh(self, case: CaseDescription, folder: Path) -> str:
        """constant/polyMesh of the run, where a restart or the case has not brought one."""
        from meshes import copy_into, is_script, mesh_source

        source = mesh_source(case.folder, case.grid)
        if is_script(source) and not openfoam.has_mesh(folder):
            return copy_into(folder, source)
        return openfoam.make_mesh(folder)

    def start_command(self, folder: Path, endpoint: str, keys: str) -> list[str]:
        options = ["-keys", keys] if keys else []
        return [str(openfoam_client_binary()), "-case", str(folder), "-endpoint", endpoint, *options]

    def environment(self) -> dict[str, str]:
        return openfoam.environment()

    def error_in(self, log: Path) -> str:
        return openfoam.error_in(log)


def built(name: str) -> list[str]:
    return [str(build_dir() / "bin" / name)]


CLIENTS = {
    "openfoam": lambda: OpenFoam("gimdemFoam", [], ("gimdemFoam",)),
    "column-cpp": lambda: Program("column-cpp", built("column-cpp"), ("column-cpp",)),
    "column-c": lambda: Program("column-c", built("column-c"), ("column-c",)),
    "column-python": lambda: Program("column-python", [PYTHON, str(EXAMPLES / "column.py")]),
}


def find_client(wanted: str) -> Program:
    """By its name; or an executable of the user's, by its path."""
    if wanted in CLIENTS:
        return CLIENTS[wanted]()
    if "/" not in wanted:
        raise UserError(f"there is no client '{wanted}' (there are {', '.join(CLIENTS)}); choose one, or give the path "
                        "of a program of yours, e.g. ./my-client", 2)
    path = Path(wanted).resolve()
    if not (path.is_file() and os.access(path, os.X_OK)):
        raise UserError(f"{shown(path)} is not a program (the client must be an executable file); see "
                        "docs/write-a-client.md", 2)
    return Program(path.name, [str(path)])
