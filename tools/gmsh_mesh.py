# SPDX-License-Identifier: BSD-3-Clause
"""A mesh from a script of gmsh: tetrahedra, or the polyhedra around their points.

gmsh makes tetrahedra, gmshToFoam translates them, and polyDualMesh makes a polyhedron of all that is nearest to one
of their points; points on walls become half cells. The script names the patches (patches called wall... are walls)
and, by the name of its physical volume, the cells: polyhedra or tetrahedra."""
from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from console import UserError, shown
from openfoam import environment, error_in
from process import run_logged

FEATURE_ANGLE = "50"  # edges at which walls turn by more stay sharp, besides those between patches [deg]
CELLS = ("polyhedra", "tetrahedra")
CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application gmshToFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;
writeControl timeStep; writeInterval 1; writeFormat ascii; writePrecision 17; writeCompression off;
"""
SCHEMES = """FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }
gradSchemes {} divSchemes {} laplacianSchemes {}
"""
SOLUTION = "FoamFile { version 2.0; format ascii; class dictionary; object fvSolution; }\n"


@dataclass
class MeshQuality:
    """What checkMesh tells of a mesh without faults."""

    cells: int
    faces_per_cell: float
    volume: float  # of all cells together [m^3]
    smallest: float  # volume of a cell [m^3]
    largest: float  # volume of a cell [m^3]
    non_orthogonality: float  # largest angle between a face's normal and the line through its cells' centres [deg]
    skewness: float


def make(script: Path, folder: Path) -> None:
    """constant/polyMesh in `folder`, which holds nothing else, in text and with all digits."""
    prepare(folder)
    tetrahedra = folder / "tetrahedra.msh"
    # One thread, and no options of the user's own: the mesh is to be the same everywhere.
    step(folder, "gmsh", "-3", "-nt", "1", "-format", "msh22", "-o", str(tetrahedra), str(script.resolve()))
    cells = kind_of_cells(tetrahedra, script)
    step(folder, "gmshToFoam", "-case", str(folder), str(tetrahedra))
    tetrahedra.unlink()
    name_walls(folder / "constant" / "polyMesh" / "boundary", script)
    remove_zones(folder)
    if cells == "polyhedra":
        step(folder, "polyDualMesh", "-case", str(folder), "-overwrite", FEATURE_ANGLE)
        remove_zones(folder)
    for drawing in folder.glob("*.obj"):
        drawing.unlink()


def prepare(folder: Path) -> None:
    """What OpenFOAM's programs want to find."""
    (folder / "system").mkdir(parents=True, exist_ok=True)
    for name, text in (("controlDict", CONTROL), ("fvSchemes", SCHEMES), ("fvSolution", SOLUTION)):
        (folder / "system" / name).write_text(text)


def step(folder: Path, program: str, *arguments: str) -> Path:
    """One program with all it says in log.PROGRAM; returns that file."""
    if shutil.which(program) is None:
        origin = "run ./gimdem setup" if program == "gmsh" else "run ./gimdem setup, or source OpenFOAM"
        raise UserError(f"{program} is not on the PATH (it makes the mesh of this grid); {origin}")
    log = folder / f"log.{program}"
    code = run_logged([program, *arguments], log, cwd=folder, env={**environment(), "GMSH_HOME": str(folder)})
    text = log.read_text(errors="replace")
    told = re.search(r"^Error\s*: (.*)", text, re.MULTILINE) if program == "gmsh" else None
    if code != 0 or told:
        raise UserError(f"{program} failed: {told[1] if told else error_in(log) or 'no reason given'}; see {shown(log)}")
    return log


def kind_of_cells(mesh: Path, script: Path) -> str:
    """polyhedra or tetrahedra: the name of the physical volume."""
    with mesh.open(errors="replace") as lines:
        head = [line for _, line in zip(range(100), lines)]
    names = re.findall(r'^3 \d+ "(.*)"$', "".join(head), re.MULTILINE)
    if len(names) != 1 or names[0] not in CELLS:
        raise UserError(f"{shown(script)} has the physical volumes {names or 'none'} (the name of the only one says of "
                        f"which cells the mesh is made); write e.g. Physical Volume(\"{CELLS[0]}\") = {{1}};")
    return names[0]


def name_walls(boundary: Path, script: Path) -> None:
    """Patches called wall... get OpenFOAM's type wall; faces without a patch are refused."""
    text = boundary.read_text()
    if re.search(r"^\s*defaultFaces$", text, re.MULTILINE):
        raise UserError(f"{shown(script)} leaves faces of the boundary without a patch (the fluid needs to know what is "
                        "there); name all its surfaces with Physical Surface(\"...\")")
    text = re.sub(r"\n\s*physicalType.*", "", text)
    boundary.write_text(re.sub(r"(\n\s*wall\w*\s*\{\s*type\s+)patch;", r"\1wall;", text))


def remove_zones(folder: Path) -> None:
    for name in ("cellZones", "faceZones", "pointZones"):
        (folder / "constant" / "polyMesh" / name).unlink(missing_ok=True)
    shutil.rmtree(folder / "constant" / "polyMesh" / "sets", ignore_errors=True)


def check(folder: Path) -> MeshQuality:
    """Have checkMesh look at constant/polyMesh; the mesh is refused where that finds a fault."""
    log = step(folder, "checkMesh", "-case", str(folder), "-constant")
    shutil.rmtree(folder / "constant" / "polyMesh" / "sets", ignore_errors=True)  # of faces that deserve a look
    text = log.read_text(errors="replace")
    if "\nMesh OK." not in text:
        faults = "; ".join(re.findall(r"^ \*\*\*(.*?)\.?$", text, re.MULTILINE)) or "it did not reach its end"
        raise UserError(f"checkMesh finds faults in the mesh: {faults}; change what it is made of; see {shown(log)}")
    return quality_in(log)


def quality_in(log: Path) -> MeshQuality:
    """What checkMesh told."""
    text = log.read_text(errors="replace")

    def value(words: str) -> float:
        found = re.search(words + r"\s*([-+.e\d]+)", text)
        return float(found[1].rstrip(".")) if found else float("nan")

    return MeshQuality(
        cells=int(value(r"\n    cells:")), faces_per_cell=value("faces per cell:"), volume=value("Total volume ="),
        smallest=value("Min volume ="), largest=value("Max volume ="),
        non_orthogonality=value("non-orthogonality Max:"), skewness=value("Max skewness ="),
    )
