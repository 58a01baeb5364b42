# SPDX-License-Identifier: BSD-3-Clause
"""A real client that is killed in a run with a grace time: ./gimdem starts it again, and the end is to the bit the same."""
from __future__ import annotations

import os
import signal
import unittest
from pathlib import Path

from real_case import RealCaseTest
from restart_kills import differences, end_of, processes_of, steps_of, substitute


class Grace(RealCaseTest):
    """300 beads in a coarse bed, forty steps, with checkpoints and fields every ten."""

    def setUp(self) -> None:
        super().setUp()
        self.edit(r"^threads = .*$", "threads = 1")
        self.edit(r"^particle_interval = .*$", "particle_interval = 0.0")
        self.edit(r"^timeout = .*$", "timeout = 20.0\ngrace_time = 60.0")
        for name, cells in (("nx", 9), ("ny", 1), ("nz", 25)):
            substitute(self.case / "system" / "blockMeshDict.B", rf"^{name} \d+;$", f"{name} {cells};")
        substitute(self.case / "system" / "controlDict", r"^writeInterval .*$", "writeInterval 1e-3;")

    def kill_behind(self, run: Path, steps: int, signal_number: int) -> None:
        self.wait_until(lambda: steps_of(run) >= steps, f"{steps} steps")
        os.kill(processes_of(self.case)["gimdemFoam"], signal_number)

    @staticmethod
    def table(run: Path) -> list[list[str]]:
        """bed.csv without what the client tells of the step before, which a client that goes on does not know."""
        rows = [line.split(",") for line in (run / "bed.csv").read_text().splitlines()]
        last = rows[0].index("particles [1]")
        return [row[:last + 1] for row in rows]

    def run_and_kill(self, signal_number: int) -> tuple[int, str]:
        """A run whose client is killed behind its first checkpoint; returns exit code and stderr."""
        process = self.start("run", self.case, "--until", "0.004")
        self.kill_behind(self.case / "runs" / "0002", 14, signal_number)
        code, _, err = self.finish(process, 120)
        return code, err

    def test_killed_client_is_started_again_and_the_end_is_the_same(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--until", "0.004", patience=120)
        self.assertEqual(code, 0, err)
        code, err = self.run_and_kill(signal.SIGKILL)
        self.assertEqual(code, 0, err)
        self.assertRegex(err, r"(?m)^client: +gimdemFoam was killed by signal 9 \(SIGKILL\); started again from "
                              r"step_0000000[123]0_at_0.00[123].h5, 1 of 2")
        whole, other = (self.case / "runs" / number for number in ("0001", "0002"))
        self.assertEqual(differences(end_of(whole), end_of(other)), [])
        self.assertEqual(self.table(whole), self.table(other), "rows behind the checkpoint must not come twice")
        self.assertEqual(steps_of(other), steps_of(whole))
        # Steps that came twice count twice, and so do their bytes; two handshakes and meshes are not half of that.
        ratio = self.figures(other)["bytes_per_step"] / self.figures(whole)["bytes_per_step"]
        print(f"figure: grace_bytes_per_step_ratio = {ratio:.4g} [1]")
        self.assertLess(abs(ratio - 1), 0.5)

    def test_solver_that_diverges_is_not_started_again(self) -> None:
        substitute(self.case / "system" / "fvSolution", r"^ *maxVelocity .*$", "    maxVelocity 1e-3;")
        code, _, err = self.gimdem("run", self.case, "--until", "0.004", patience=120)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "the fluid diverged")
        self.assertNotIn("started again", err)


if __name__ == "__main__":
    unittest.main()
