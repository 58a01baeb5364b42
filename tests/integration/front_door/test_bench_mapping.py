#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench mapping and gim-figures: what they leave, and what they refuse."""
from __future__ import annotations

import csv
import re
import unittest

from front_door import FrontDoorTest

FIGURE = re.compile(r"^figure: (\S+) = (\S+) \[(\S+)\]", re.MULTILINE)
ERRORS = ["mesh", "family", "method", "cells", "ratio", "wrong_cells", "rms_error", "jump_largest", "jump_mean",
          "largest_solid_fraction", "wall_ratio"]
SPEED = ["mesh", "family", "method", "cells", "ratio", "particles", "threads", "locate_ns", "weights_ns", "sums_ns",
         "step_ms", "weights_per_particle", "bytes_per_particle"]


class MappingBenchmark(FrontDoorTest):
    def bench(self, *arguments: object) -> tuple[int, str, str]:
        return self.gimdem("bench", *arguments, "--to", self.folder / "out", patience=120)

    def table(self, name: str) -> list[dict[str, str]]:
        with (self.folder / "out" / name).open(newline="") as file:
            return list(csv.DictReader(file))

    def files(self) -> set[str]:
        return {path.name for path in (self.folder / "out").iterdir()}

    def test_every_method_has_its_rows_and_figures(self) -> None:
        code, out, err = self.bench("mapping", "--quick", "--only", "errors,speed", "--mesh", "hexahedra-10")
        self.assertEqual(code, 0, err)
        errors, speed = self.table("mapping-errors.csv"), self.table("mapping-speed.csv")
        self.assertEqual(list(errors[0]), ERRORS)
        self.assertEqual(list(speed[0]), SPEED)
        methods = [row["method"] for row in errors]
        self.assertEqual(methods, [row["method"] for row in speed])
        self.assertTrue({"gim", "pcm", "divided", "fbsi", "kernel", "diffusion", "exact"} <= set(methods), methods)
        figures = {name: float(value) for name, value, _ in FIGURE.findall(out)}
        for method in methods:
            self.assertGreater(figures[f"mapping_ns_per_particle_{method}_on_hexahedra-10_of_17563"], 0)
        # A cube of ten diameters: PCM errs by the share of particles near faces, 3/8 of dp/a to first order, to 1000 places.
        self.assertAlmostEqual(figures["mapping_wrong_cells_pcm_on_hexahedra-10"], 0.055, delta=0.012)
        self.assertEqual(figures["mapping_wrong_cells_exact_on_hexahedra-10"], 0)
        self.assertLess(figures["mapping_rms_error_gim_on_hexahedra-10"], figures["mapping_rms_error_pcm_on_hexahedra-10"])
        for row in errors:
            self.assertEqual(row["cells"], "125")
            self.assertTrue(0.3 < float(row["largest_solid_fraction"]) < 0.6, row)
        self.assertTrue({"mapping.md", "mapping-pareto-overlap.png", "mapping-pareto-packing.png"} <= self.files())
        self.assertIn("| hexahedra-10 |", (self.folder / "out" / "mapping.md").read_text())

        code, _, err = self.bench("mapping", "--quick", "--only", "errors", "--mesh", "hexahedra-10", "--method", "gim")
        self.assertEqual(code, 0, err)
        again = self.table("mapping-errors.csv")
        self.assertEqual([row["method"] for row in again], methods, "a later run takes the place of its own rows alone")
        self.assertEqual(again, errors)  # the same places and packing

    def test_figures_of_the_paper(self) -> None:
        code, out, err = self.bench("gim-figures")
        self.assertEqual(code, 0, err)
        figures = {name: float(value) for name, value, _ in FIGURE.findall(out)}
        self.assertAlmostEqual(figures["gim_figure_4_at_8"], 0.34, delta=0.005)
        self.assertAlmostEqual(figures["gim_figure_5_at_16"], 0.08, delta=0.005)
        self.assertEqual(self.files(), {"gim-figures.csv", *(f"gim-figure-{number}.png" for number in range(3, 9))})
        self.assertEqual(list(self.table("gim-figures.csv")[0]),
                         ["figure", "curve", "position", "volume_ratio", "phi", "x", "y"])

    def test_what_is_not_there_is_refused(self) -> None:
        for arguments, parts in (
            (("--mesh", "cubes"), ("no mesh cubes", "hexahedra-1.76")),
            (("--method", "magic"), ("no method magic", "fbsi")),
            (("--only", "peers"), ("no part peers", "errors, speed, stages")),
            (("--particles", "many"), ("--particles many is no number",)),
        ):
            with self.subTest(arguments):
                code, out, err = self.bench("mapping", *arguments)
                self.assertEqual(code, 2, err)
                self.assertEqual(out, "")
                self.assert_one_error(err, *parts)

    def test_a_mesh_that_cannot_be_read_is_refused(self) -> None:
        mesh = self.folder / "constant" / "polyMesh"
        mesh.mkdir(parents=True)
        (mesh / "points").write_text("FoamFile { format ascii; }\n1 (0 0 0)\n")
        code, _, err = self.bench("mapping", "--quick", "--only", "errors", "--mesh", self.folder)
        self.assertEqual(code, 1, err)
        self.assertIn("points:2:", err)
        self.assertNotIn("Traceback", err)


if __name__ == "__main__":
    unittest.main()
