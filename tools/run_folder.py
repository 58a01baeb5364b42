# SPDX-License-Identifier: BSD-3-Clause
"""The folder of one run: made fresh, filled with a copy of the case, never overwritten."""
from __future__ import annotations

import shutil
from pathlib import Path

from case_folder import CaseDescription
from console import UserError, shown
from meshes import is_script, mesh_source

UNSTRUCTURED = "unstructured"  # files that take the place of those in system/ where the mesh is made by gmsh
REFERENCE = "reference.json"  # published means and deviations, drawn into the plots


def make_run_folder(case: CaseDescription, output: str | None) -> Path:
    """A new folder CASE/runs/NNNN, or `output`, which must be new or empty."""
    if output is None:
        return next_numbered(case.folder / "runs")
    folder = Path(output).resolve()
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise UserError(f"{output} exists and is not an empty folder (a run never overwrites anything); "
                            "choose another --output, or leave it out")
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"the run folder {output} cannot be made ({error.strerror}); choose another --output") from None
    return folder


def next_numbered(parent: Path) -> Path:
    """parent/0001, 0002, ...; two runs that start at once get two numbers."""
    try:
        parent.mkdir(parents=True, exist_ok=True)
        while True:
            taken = [int(path.name) for path in parent.iterdir() if path.name.isdigit()]
            folder = parent / f"{max(taken, default=0) + 1:04d}"
            try:
                folder.mkdir()
                return folder
            except FileExistsError:
                continue
    except OSError as error:
        raise UserError(f"no run folder can be made in {shown(parent)} ({error.strerror}); "
                        "give a folder of yours with --output") from None


def copy_case(case: CaseDescription, folder: Path) -> None:
    """What the run reads, as it was when it started."""
    shutil.copy2(case.file, folder / "case.toml")
    if (case.folder / REFERENCE).exists():
        shutil.copy2(case.folder / REFERENCE, folder / REFERENCE)
    for name in ("0", "constant", "system"):
        if (case.folder / name).is_dir():
            shutil.copytree(case.folder / name, folder / name)
    source = mesh_source(case.folder, case.grid)
    if is_script(source):
        # Schemes for cells of any shape.
        if (folder / "system" / UNSTRUCTURED).is_dir():
            shutil.copytree(folder / "system" / UNSTRUCTURED, folder / "system", dirs_exist_ok=True)
    elif case.grid:
        shutil.copy2(source, folder / "system" / "blockMeshDict")
