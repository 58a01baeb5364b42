# SPDX-License-Identifier: BSD-3-Clause
"""Mistakes in a case, as the person at the terminal meets them: one clear message, nothing overwritten, nobody left."""
from __future__ import annotations

import unittest

from front_door import tree_of
from real_case import RealCaseTest


class RefusedBeforeTheRun(RealCaseTest):
    """The case file alone tells; no run folder is made."""

    def refused(self, *parts: str) -> None:
        before = tree_of(self.folder)
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, *parts)
        self.assertEqual(tree_of(self.folder), before)

    def test_unknown_key_names_the_nearest_one(self) -> None:
        self.edit(r"^restitution", "restituton")
        self.refused(f"case.toml:{self.line_of('restituton')}", "restituton", 'did you mean "restitution"')

    def test_missing_key_says_what_it_is_for(self) -> None:
        self.edit(r"^density.*\n", "")
        self.refused("case.toml", "density", "[[materials]]")

    def test_negative_density(self) -> None:
        self.edit(r"^density = ", "density = -")
        self.refused(f"case.toml:{self.line_of('density = -')}", "density", "> 0")

    def test_negative_diameter(self) -> None:
        self.edit(r"^diameter = ", "diameter = -")
        self.refused(f"case.toml:{self.line_of('diameter = -')}", "diameter", "> 0")

    def test_unknown_client(self) -> None:
        self.edit(r'^client = "openfoam"', 'client = "fluent"')
        self.refused("fluent", "openfoam")

    def test_text_that_is_no_toml(self) -> None:
        self.edit(r"^\[run\]$", "[run")
        self.refused("case.toml:", "not TOML")

    def test_absent_grid_dictionary(self) -> None:
        (self.case / "system" / "blockMeshDict.B").unlink()
        self.refused("system/blockMeshDict.B", "absent")


class RefusedByTheServer(RealCaseTest):
    """Particles and mesh must be there to tell; the run folder keeps the logs."""

    def failed(self, *parts: str) -> None:
        before = tree_of(self.folder)
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, *parts)
        kept = {name: content for name, content in tree_of(self.folder).items() if name in before}
        self.assertEqual(kept, before, "a failed run must not touch what was there")

    def test_time_step_too_long(self) -> None:
        self.edit(r"^time_step = \S+", "time_step = 2.5e-3")
        self.failed("time_step", "Rayleigh", "20 %")

    def test_particles_that_overlap(self) -> None:
        (self.case / "beds.csv").write_text("x,y,z\n0.01,0.004,0.01\n0.0105,0.004,0.01\n")
        self.edit(r'^arrangement = "lattice"', 'arrangement = "file"\nfile = "beds.csv"')
        self.edit(r"^count = 300.*\n", "")
        for key in ("box", "spacing", "jitter", "seed"):
            self.edit(rf"^{key} = .*\n", "")
        self.failed("overlap")


if __name__ == "__main__":
    unittest.main()
