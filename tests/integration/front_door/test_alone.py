# SPDX-License-Identifier: BSD-3-Clause
"""Particles without a fluid: the real server, started by ./gimdem; a run to its end, restarts, and bad checkpoints."""
from __future__ import annotations

import json
import re
import shutil
import signal
import unittest
from pathlib import Path

from front_door import ROOT, FrontDoorTest, tree_of

INLET = """
[[inlets]]
material = "bead"
diameter = 1.2e-3
mass_rate = 0.05
velocity = [0.5, 0.0, 0.0]
centre = [0.045, 0.004, 0.1]
normal = [0.0, 1.0, 0.0]
radius = 0.02
interval = 2e-3
"""


class Alone(FrontDoorTest):
    """self.case: settling-bed with 300 particles and an inlet that throws more out of an open side."""

    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case"
        shutil.copytree(ROOT / "cases" / "settling-bed", self.case, ignore=shutil.ignore_patterns("runs"))
        self.case_file = self.case / "case.toml"
        self.edit(r"^count = .*$", "count = 300")
        self.edit(r"^until = .*$", "until = 0.12")
        self.edit(r"^open = .*$", 'open = ["zmax", "xmax"]')
        self.edit(r"^checkpoint_interval = .*$", "checkpoint_interval = 0.05")
        self.case_file.write_text(self.case_file.read_text() + INLET)

    def edit(self, pattern: str, text: str) -> None:
        content, count = re.subn(pattern, text, self.case_file.read_text(), flags=re.MULTILINE)
        self.assertEqual(count, 1, f"{pattern} in case.toml")
        self.case_file.write_text(content)

    def run_folder(self, number: int) -> Path:
        return self.case / "runs" / f"{number:04d}"

    def figures(self, number: int) -> dict[str, float]:
        summary = json.loads((self.run_folder(number) / "summary.json").read_text())
        return {figure["name"]: figure["value"] for figure in summary["figures"]}

    def rows(self, number: int) -> list[str]:
        """Of bed.csv, without its header."""
        return (self.run_folder(number) / "bed.csv").read_text().splitlines()[1:]

    def checkpoints(self, number: int) -> list[Path]:
        return sorted((self.run_folder(number) / "checkpoints").iterdir())

    def test_run_and_restart(self) -> None:
        code, out, err = self.gimdem("run", self.case, "--threads", "1")
        self.assertEqual(code, 0, err)
        for name in ("results.pvd", "bed.csv", "run.json", "plots/snapshots.png", "plots/kinetic_energy.png"):
            self.assertTrue((self.run_folder(1) / name).exists(), name)
        whole = self.figures(1)
        self.assertEqual(whole["dem_steps"], 3530)  # 0.12 s / 0.034 ms, up
        self.assertGreater(whole["particles_inserted"], 1000)
        self.assertGreater(whole["particles_removed"], 100)
        self.assertEqual(whole["removed_through_xmax"], whole["particles_removed"])
        self.assertEqual(whole["particles_lost"], 0)
        self.assertEqual(whole["particles"], 300 + whole["particles_inserted"] - whole["particles_removed"])
        self.assertIn("figure: particles_removed = ", out)
        # Every 1471 steps, and at the end.
        self.assertEqual([file.name[:14] for file in self.checkpoints(1)],
                         ["step_000001471", "step_000002942", "step_000003530"])
        self.assertEqual(self.checkpoints(1)[0].name, "step_000001471_at_0.050014.h5")

        code, _, err = self.gimdem("run", self.case, "--threads", "2", "--restart", self.checkpoints(1)[0])
        self.assertEqual(code, 0, err)
        # The same bytes: the same state to the bit.
        self.assertEqual(self.checkpoints(1)[-1].read_bytes(), self.checkpoints(2)[-1].read_bytes())
        self.assertEqual(self.figures(2)["dem_steps"], 3530 - 1471)
        # So are the rows of the time series that both have: one every 29 steps.
        whole_rows, rows = (self.rows(number) for number in (1, 2))
        self.assertGreater(len(rows), 50)
        self.assertEqual(rows, whole_rows[-len(rows):])

        code, _, err = self.gimdem("run", self.case, "--restart", "latest")
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "nothing is left to do", "--until")
        code, _, err = self.gimdem("run", self.case, "--restart", "latest", "--until", "0.13")
        self.assertEqual(code, 0, err)
        self.assertEqual(self.checkpoints(4)[-1].name[:14], "step_000003824")

    def test_bad_checkpoints_are_refused_and_nothing_is_overwritten(self) -> None:
        self.edit(r"^until = .*$", "until = 0.01")
        self.assertEqual(self.gimdem("run", self.case)[0], 0)
        good = self.checkpoints(1)[-1]
        before = tree_of(self.run_folder(1))
        cut, flipped = self.folder / "cut.h5", self.folder / "flipped.h5"
        content = good.read_bytes()
        cut.write_bytes(content[:-100])
        flipped.write_bytes(content[:5000] + bytes([content[5000] ^ 4]) + content[5001:])
        for file, words in ((cut, "is cut short"), (flipped, "is damaged"), (self.folder / "none.h5", "no checkpoint")):
            code, _, err = self.gimdem("run", self.case, "--until", "0.02", "--restart", file)
            self.assertNotEqual(code, 0)
            self.assert_one_error(err, words)
        self.edit(r"^friction = .*$", "friction = 0.4")
        code, _, err = self.gimdem("run", self.case, "--until", "0.02", "--restart", good)
        self.assertEqual(code, 1)
        self.assert_one_error(err, "belongs to another case")
        self.assertEqual(tree_of(self.run_folder(1)), before)

    def test_interrupted_run_goes_on_as_if_it_had_not_been(self) -> None:
        process = self.start("run", self.case, "--until", "500")
        series = self.run_folder(1) / "bed.csv"
        self.wait_until(lambda: series.exists() and len(series.read_text().splitlines()) > 5, "samples")
        process.send_signal(signal.SIGINT)
        code, _, err = self.finish(process)
        self.assertEqual(code, 130, err)
        step = int(self.checkpoints(1)[-1].name[5:14])
        until = repr((step + 40) * 3.4e-5)
        code, _, err = self.gimdem("run", self.case, "--restart", "latest", "--until", until)
        self.assertEqual(code, 0, err)
        self.assertEqual(self.figures(2)["dem_steps"], 40)
        self.edit(r"^checkpoint_interval = .*$", "checkpoint_interval = 0.0")
        self.assertEqual(self.gimdem("run", self.case, "--until", until)[0], 0)
        self.assertEqual(self.checkpoints(2)[-1].read_bytes(), self.checkpoints(3)[-1].read_bytes())

    def test_particles_that_cannot_be_are_refused(self) -> None:
        text = self.case_file.read_text()
        begin, end = text.index("diameter ="), text.index("[output]")
        self.case_file.write_text(text[:begin] + 'arrangement = "file"\nfile = "beads.csv"\n' + text[end:])
        good = "0.01,0.004,0.1,7.7e-4\n"
        for line, words in (
            (good, ("particles 0 and 1 overlap by 0.00154 m",)),
            ("0.01,0.004,0.1013,7.7e-4\n", ("overlap by 0.00024 m",)),
            ("0.02,0.004,nan,7.7e-4\n", ("beads.csv:3", '"nan" is not a finite number')),
            ("0.02,0.004,0.1,0\n", ("beads.csv:3", "radius 0 m")),
            ("0.02,0.004,0.1,1e-110\n", ("has no mass",)),
            ("0.0005,0.004,0.1,7.7e-4\n", ("particle 1 at (0.0005, 0.004, 0.1) m overlaps the wall xmin",)),
            ("0.02,0.004,0.6,7.7e-4\n", ("is 0.1 m beyond the side zmax",)),
            ("0.02,0.004\n", ("beads.csv:3", "2 numbers where the header names 4")),
        ):
            (self.case / "beads.csv").write_text("x,y,z,radius\n" + good + line)
            code, _, err = self.gimdem("run", self.case)
            self.assertEqual(code, 1, err)
            self.assert_one_error(err, *words)

    def test_no_client_can_be_asked_for(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--client", "openfoam")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "has no fluid")

    def test_restart_without_a_checkpoint(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--restart", "latest")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "left a checkpoint")


class Drum(FrontDoorTest):
    """cases/rotating-drum, for an instant."""

    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case"
        shutil.copytree(ROOT / "cases" / "rotating-drum", self.case, ignore=shutil.ignore_patterns("runs"))
        self.case_file = self.case / "case.toml"
        self.text = self.case_file.read_text().replace("until = 3.0", "until = 0.02")

    def run_with(self, text: str) -> tuple[int, str, str]:
        self.case_file.write_text(text)
        return self.gimdem("run", self.case, "--threads", "1")

    def test_holds_its_bed(self) -> None:
        code, out, err = self.run_with(self.text)
        self.assertEqual(code, 0, err)
        self.assertIn("figure: particles = 3000 ", out)
        self.assertIn("figure: particles_removed = 0 ", out)

    def test_walls_that_cannot_be_are_refused(self) -> None:
        too_small = self.text.replace("radius = 0.05 ", "radius = 0.04 ")
        self.assertNotEqual(too_small, self.text)
        code, _, err = self.run_with(too_small)
        self.assertEqual(code, 1)
        self.assert_one_error(err, "particle 0", 'starts behind wall "drum"')
        code, _, err = self.run_with(
            self.text + '[[wall]]\nname = "blade"\nshape = "stl"\nfile = "blade.stl"\nopen = true\n')
        self.assertEqual(code, 1)
        self.assert_one_error(err, "blade.stl does not exist", "[[wall]] file")


if __name__ == "__main__":
    unittest.main()
