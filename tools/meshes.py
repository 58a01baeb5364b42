# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem mesh, and the meshes that a case keeps: made once, and anew when what they are made of has changed."""
from __future__ import annotations

import argparse
import fcntl
import hashlib
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import gmsh_mesh
from console import UserError, say, shown
from packages import setup

KEY = "made-of.sha256"  # of all that a kept mesh depends on


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("case", metavar="CASE_DIR", type=Path, help="a case, or a folder with system/X.geo")
    parser.add_argument("--grid", metavar="X", help="mesh variant (none: the only one)")
    parser.add_argument("--to", metavar="FOLDER", type=Path, help="copy it there, as constant/polyMesh")


def run(options: argparse.Namespace) -> int:
    """Make a mesh without running the case; its figures go to stdout."""
    setup(quiet=True)
    source = mesh_source(options.case.resolve(), options.grid or "")
    if not source.is_file():
        raise UserError(f"{shown(source)} is absent (the mesh is made of it); the folder system of the case tells which "
                        "grids there are", 2)
    if options.to and options.to.exists() and any(options.to.iterdir()):
        raise UserError(f"{options.to} exists and is not an empty folder (nothing is overwritten); choose another --to", 2)
    folder, quality = up_to_date(source)
    if options.to:
        shutil.copytree(folder / "constant", options.to / "constant", dirs_exist_ok=True)
        folder = options.to
    say("mesh", f"{shown(folder)}/constant/polyMesh")
    print_figures(quality)
    return 0


def print_figures(mesh: gmsh_mesh.MeshQuality) -> None:
    for name, value, unit in (
        ("cells", mesh.cells, "1"), ("faces_per_cell", mesh.faces_per_cell, "1"), ("mesh_volume", mesh.volume, "m^3"),
        ("smallest_cell", mesh.smallest * mesh.cells / mesh.volume, "mean cell"),
        ("largest_cell", mesh.largest * mesh.cells / mesh.volume, "mean cell"),
        ("non_orthogonality", mesh.non_orthogonality, "deg"), ("skewness", mesh.skewness, "1"),
    ):
        print(f"figure: {name} = {value:.12g} [{unit}]")


def mesh_source(case: Path, grid: str) -> Path:
    """What the mesh of a grid is made of: system/GRID.geo where there is one, else OpenFOAM's dictionary.

    Without a grid: system/mesh.geo, or blockMeshDict."""
    script = case / "system" / f"{grid or 'mesh'}.geo"
    if script.is_file():
        return script
    return case / "system" / (f"blockMeshDict.{grid}" if grid else "blockMeshDict")


def is_script(source: Path) -> bool:
    """Of gmsh."""
    return source.suffix == ".geo"


def up_to_date(source: Path) -> tuple[Path, gmsh_mesh.MeshQuality]:
    """The folder CASE/meshes/GRID with the mesh of `source`, made now if need be."""
    grid = source.name.removesuffix(".geo").removeprefix("blockMeshDict").removeprefix(".")
    grid = grid or "mesh"
    folder = source.parents[1] / "meshes" / grid
    folder.mkdir(parents=True, exist_ok=True)
    wanted = digest(source)
    with alone(folder.parent / ".lock"):
        key = folder / KEY
        if not (key.is_file() and key.read_text() == wanted):
            shutil.rmtree(folder)
            folder.mkdir()
            say("mesh", f"making it of {shown(source)}")
            make(source, folder)
            quality = gmsh_mesh.check(folder)
            key.write_text(wanted)
            return folder, quality
        return folder, gmsh_mesh.quality_in(folder / "log.checkMesh")


def copy_into(folder: Path, source: Path) -> str:
    """Give a run the mesh of a script; returns one line about it."""
    kept, quality = up_to_date(source)
    shutil.copytree(kept / "constant" / "polyMesh", folder / "constant" / "polyMesh")
    shutil.copy2(kept / "log.checkMesh", folder / "log.checkMesh")
    return f"{quality.cells} cells with {quality.faces_per_cell:.1f} faces each, from {shown(kept)}"


def make(source: Path, folder: Path) -> None:
    if is_script(source):
        gmsh_mesh.make(source, folder)
    else:
        gmsh_mesh.prepare(folder)
        gmsh_mesh.step(folder, "blockMesh", "-case", str(folder), "-dict", str(source))


def digest(source: Path) -> str:
    """Of the text of a source and of what it includes, and of the code that makes a mesh of it."""
    state = hashlib.sha256()
    for file in [Path(gmsh_mesh.__file__), *sorted(with_included(source))]:
        state.update(f"{file.name} {file.stat().st_size}\n".encode())
        state.update(file.read_bytes())
    return state.hexdigest() + "\n"


def with_included(source: Path) -> set[Path]:
    """A script or dictionary, the files that it includes, and what these include."""
    found: set[Path] = set()
    todo = [source]
    while todo:
        file = todo.pop()
        if file in found or not file.is_file():
            continue
        found.add(file)
        names = re.findall(r'^\s*(?:#include|Include|Merge)\s+"([^"]+)"', file.read_text(errors="replace"), re.MULTILINE)
        todo += [file.parent / name for name in names]
    return found


@contextmanager
def alone(lock_file: Path) -> Iterator[None]:
    """Two that want a mesh of one case take turns."""
    with lock_file.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
