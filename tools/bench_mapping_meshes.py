# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that ./gimdem bench mapping compares methods on, by name."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import meshes
from console import ROOT, UserError

RATIOS = (1, 1.25, 1.56, 1.76, 2.38, 3, 4, 6, 10)  # a / dp of cubes
BED_RATIO = 1.76  # a / dp of the other meshes made by the programs, as of Grids A and D
GRIDS = {"C": "polyhedra", "D": "polyhedra", "E": "polyhedra", "T": "tetrahedra"}  # of cases/wachem-bed


@dataclass(frozen=True)
class Mesh:
    name: str
    family: str
    label: str  # in plots and tables
    ratio: float = BED_RATIO  # where the programs make it
    made_of: str = ""  # their name for it; a folder; else the grid of cases/wachem-bed is `name`

    def arguments(self) -> list[str]:
        """Of the programs; a grid of the case is made now if it is not there."""
        if self.made_of:
            return ["--mesh", self.made_of, "--ratio", str(self.ratio)]
        folder, _ = meshes.up_to_date(meshes.mesh_source(ROOT / "cases" / "wachem-bed", self.name))
        return ["--mesh", str(folder)]


def known() -> dict[str, Mesh]:
    """All that are named here, in the order of tables."""
    found = [Mesh(f"hexahedra-{ratio}", "hexahedra", f"cubes, a/dp = {ratio}", ratio, "hexahedra") for ratio in RATIOS]
    found += [Mesh(f"stretched-{n}", "stretched", f"boxes 1:1:{n}", made_of=f"stretched-{n}") for n in (2, 4)]
    found += [Mesh("tetrahedra", "tetrahedra", "tetrahedra, of cubes", made_of="tetrahedra"),
              Mesh("polyhedra", "polyhedra", "Voronoi cells", made_of="polyhedra")]
    found += [Mesh(name, family, f"Grid {name}, {family}") for name, family in GRIDS.items()]
    return {mesh.name: mesh for mesh in found}


QUICK = ("hexahedra-1.76", "hexahedra-3", "stretched-2", "tetrahedra", "polyhedra")


def choose(names: str, quick: bool) -> list[Mesh]:
    """`names`: with commas; a folder with an OpenFOAM mesh counts too; empty: all, or those of --quick."""
    of_name = known()
    if not names:
        return [of_name[name] for name in (QUICK if quick else of_name)]
    chosen = []
    for name in filter(None, names.split(",")):
        if name in of_name:
            chosen.append(of_name[name])
        elif (Path(name) / "constant" / "polyMesh").is_dir() or (Path(name) / "points").is_file():
            folder = Path(name).resolve()
            chosen.append(Mesh(folder.name, "folder", folder.name, made_of=str(folder)))
        else:
            raise UserError(f"no mesh {name} (neither a folder with constant/polyMesh nor one of {', '.join(of_name)}); "
                            "see --help", 2)
    return chosen
