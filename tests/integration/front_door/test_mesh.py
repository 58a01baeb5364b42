# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem mesh: the polyhedral grids of the wachem bed, small meshes of our own, and what goes wrong with them."""
from __future__ import annotations

import math
import os
import re
import shutil
import unittest
from pathlib import Path

from front_door import ROOT, FrontDoorTest, tree_of

WACHEM = ROOT / "cases" / "wachem-bed"
BOX = 0.09 * 0.008 * 0.5  # [m^3]
# A cube of 10 mm in 3 or 4 points along each edge; LAST is what the script ends with.
CUBE = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.01, 0.01, 0.01};
MeshSize {:} = 0.004;
Physical Surface("inlet") = {5};
Physical Surface("outlet") = {6};
LAST
"""
WALLS = 'Physical Surface("walls") = {1:4};'
POLYHEDRA = 'Physical Volume("polyhedra") = {1};'


class MeshTest(FrontDoorTest):
    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case"

    def mesh(self, *arguments: object) -> dict[str, float]:
        """Figures of a mesh that can be made."""
        code, out, err = self.gimdem("mesh", self.case, *arguments, patience=180)  # seconds, but on a busy machine
        self.assertEqual(code, 0, err)
        return {name: float(value) for name, value in re.findall(r"^figure: (\w+) = (\S+) \[", out, re.MULTILINE)}

    def boundary(self, folder: Path) -> dict[str, str]:
        """Types of the patches."""
        text = (folder / "constant" / "polyMesh" / "boundary").read_text()
        return dict(re.findall(r"^ +(\w+)\n +\{\n +type +(\w+);", text, re.MULTILINE))


class WachemGrids(MeshTest):
    """As many cells as published (Kianimoqadam & Lapp, Table 2), within 3 %."""

    def setUp(self) -> None:
        super().setUp()
        shutil.copytree(WACHEM / "system", self.case / "system")

    def check(self, grid: str, cells: int) -> None:
        figures = self.mesh("--grid", grid)
        print(f"figure: cells_of_grid_{grid} = {figures['cells']:.0f} [1]")
        self.assertLess(abs(figures["cells"] / cells - 1), 0.03)
        # Sums over some ten thousand faces, in double.
        self.assertLess(abs(figures["mesh_volume"] / BOX - 1), 1e-10)
        log = (self.case / "meshes" / grid / "log.checkMesh").read_text()
        self.assertIn("\nMesh OK.", log)
        # The bed's corners are where they were drawn.
        box = re.search(r"Overall domain bounding box \((.*?)\) \((.*?)\)", log)
        corners = [float(number) for number in f"{box[1]} {box[2]}".split()]
        for one, other in zip(corners, (0, 0, 0, 0.09, 0.008, 0.5)):
            self.assertAlmostEqual(one, other, delta=1e-12)
        self.assertEqual(self.boundary(self.case / "meshes" / grid),
                         {"inlet": "patch", "outlet": "patch", "walls": "wall"})

    def test_grid_e_is_the_same_each_time(self) -> None:
        self.check("E", 7302)
        first = tree_of(self.case / "meshes" / "E" / "constant")
        shutil.rmtree(self.case / "meshes")
        self.mesh("--grid", "E", "--to", self.folder / "copy")
        self.assertEqual(tree_of(self.folder / "copy" / "constant"), first)

    def test_grid_t_has_as_many_tetrahedra_as_grid_a_has_cells(self) -> None:
        self.check("T", 17919)
        self.assertIn("tetrahedra:    18", (self.case / "meshes" / "T" / "log.checkMesh").read_text())


class FineWachemGrids(WachemGrids):
    test_grid_e_is_the_same_each_time = test_grid_t_has_as_many_tetrahedra_as_grid_a_has_cells = None

    def test_grid_c(self) -> None:
        self.check("C", 25605)

    def test_grid_d(self) -> None:
        self.check("D", 17840)


class RoundCases(MeshTest):
    """Walls are flat between points on the curved surface, so a little of the volume is missing."""

    def check(self, name: str, volume: float, boundary: dict[str, str]) -> None:
        shutil.copytree(ROOT / "cases" / name / "system", self.case / "system")
        share = self.mesh()["mesh_volume"] / volume
        print(f"figure: share_of_volume_of_{name.replace('-', '_')} = {share:.4f} [1]")
        # A circle of n flat pieces misses 2 pi^2 / (3 n^2) of its area; n is about 15 around these tubes.
        self.assertLess(share, 1)
        self.assertGreater(share, 0.96)
        self.assertEqual(self.boundary(self.case / "meshes" / "mesh"), boundary)

    def test_tube(self) -> None:
        self.check("cylinder-bed", math.pi * 0.015**2 * 0.15, {"inlet": "patch", "outlet": "patch", "walls": "wall"})

    def test_cone_under_a_tube(self) -> None:
        bottom, top, height = 0.0075, 0.03, 0.2
        cone = (top - bottom) / math.tan(math.pi / 6)
        volume = math.pi * (cone / 3 * (bottom**2 + bottom * top + top**2) + (height - cone) * top**2)
        self.check("spouted-bed", volume,
                   {"inlet": "patch", "outlet": "patch", "walls_of_cone": "wall", "walls_of_tube": "wall"})


class Cube(MeshTest):
    def setUp(self) -> None:
        super().setUp()
        (self.case / "system").mkdir(parents=True)
        self.write(WALLS + POLYHEDRA)

    def write(self, last: str) -> None:
        (self.case / "system" / "cube.geo").write_text(CUBE.replace("LAST", last))

    def programs(self, *names: str) -> Path:
        """A folder of programs, the only one on the PATH."""
        folder = self.folder / "bin"
        folder.mkdir()
        for name in ("bash", "env", "cat", "dirname", "readlink", *names):
            (folder / name).symlink_to(shutil.which(name))
        self.environment["PATH"] = str(folder)
        return folder

    def refused(self, *parts: str, code: int = 1) -> None:
        answer, _, err = self.gimdem("mesh", self.case, "--grid", "cube")
        self.assertEqual(answer, code, err)
        self.assert_one_error(err, *parts)
        # Nothing that could be taken for a mesh the next time.
        self.assertFalse((self.case / "meshes" / "cube" / "made-of.sha256").exists())

    def test_kept_until_the_script_or_what_it_includes_changes(self) -> None:
        (self.case / "system" / "size.geo").write_text("MeshSize {:} = 0.004;\n")
        self.write(WALLS + POLYHEDRA + '\nInclude "size.geo";')
        points = self.case / "meshes" / "cube" / "constant" / "polyMesh" / "points"
        cells = self.mesh("--grid", "cube")["cells"]
        made = os.stat(points).st_mtime_ns
        self.assertEqual(self.mesh("--grid", "cube")["cells"], cells)
        self.assertEqual(os.stat(points).st_mtime_ns, made)

        (self.case / "system" / "size.geo").write_text("MeshSize {:} = 0.003;\n")

        self.assertGreater(self.mesh("--grid", "cube")["cells"], cells)

    def test_blocks_are_meshed_too(self) -> None:
        for name in ("blockMeshDict.B", "box"):
            shutil.copy(WACHEM / "system" / name, self.case / "system" / name)
        self.assertEqual(self.mesh("--grid", "B")["cells"], 26 * 2 * 140)

    def test_gmsh_is_absent(self) -> None:
        self.programs("gmshToFoam", "polyDualMesh", "checkMesh")
        self.refused("gmsh is not on the PATH", "./gimdem setup")

    def test_gmsh_does_not_understand_the_script(self) -> None:
        self.write("Physical Volumes;")
        self.refused("gmsh failed", "log.gmsh")

    def test_checkmesh_finds_a_fault(self) -> None:
        found = self.programs("gmsh", "gmshToFoam", "polyDualMesh") / "checkMesh"
        found.write_text('#!/bin/sh\necho " ***Zero or negative cell volume detected."; echo "Failed 1 mesh checks."\n')
        found.chmod(0o755)
        self.refused("Zero or negative cell volume detected;", "log.checkMesh")

    def test_faces_without_a_patch(self) -> None:
        self.write(POLYHEDRA)
        self.refused("cube.geo", "without a patch", "Physical Surface")

    def test_cells_of_no_kind(self) -> None:
        self.write(WALLS + 'Physical Volume("bricks") = {1};')
        self.refused("cube.geo", "bricks", "polyhedra")

    def test_no_such_grid(self) -> None:
        (self.case / "system" / "cube.geo").unlink()
        self.refused("is absent", code=2)

    def test_nothing_is_overwritten(self) -> None:
        code, _, err = self.gimdem("mesh", self.case, "--grid", "cube", "--to", self.case)
        self.assertEqual(code, 2, err)
        self.assert_one_error(err, "not an empty folder")


if __name__ == "__main__":
    unittest.main()
