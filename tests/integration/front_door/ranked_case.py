# SPDX-License-Identifier: BSD-3-Clause
"""The small bed of real_case, for several ranks of the fluid."""
from __future__ import annotations

import os
import re
from pathlib import Path

from real_case import RealCaseTest


class RankedCaseTest(RealCaseTest):
    def setUp(self) -> None:
        super().setUp()
        self.edit(r"^sample_interval = .*$", "sample_interval = 1e-4\ncheckpoint_interval = 2e-4")
        self.change("controlDict", r"(?m)^writeInterval .*;", "writeInterval 2e-4;")
        self.change("controlDict", r"(?m)^writeFormat .*;", "writeFormat ascii;")
        self.change("controlDict", r"(?m)^writePrecision .*;", "writePrecision 12;")
        # Of the solvers the one with the fewest messages: on a busy machine each may wait for its turn.
        self.change("fvSolution", r"solver +GAMG;", "solver PCG; preconditioner DIC;")
        self.change("fvSolution", r"relTol +0.05;", "relTol 1e-9;")
        self.change("fvSolution", r"tolerance +1e-6;", "tolerance 0;")
        self.change("fvSolution", r"relTol +0.003;", "relTol 1e-9;")

    def change(self, dictionary: str, pattern: str, text: str) -> None:
        file = self.case / "system" / dictionary
        content, count = re.subn(pattern, text, file.read_text())
        self.assertEqual(count, 1, f"{pattern} in {dictionary}")
        file.write_text(content)

    def run_case(self, ranks: int, until: str, *options: object) -> Path:
        code, _, err = self.gimdem("run", self.case, "--ranks", ranks, "--until", until, *options, patience=200)
        self.assertEqual(code, 0, err)
        return max((self.case / "runs").iterdir())

    def ranks(self) -> list[int]:
        """Process numbers by rank."""
        found = {}
        for pid in self.processes():
            try:
                if not os.readlink(f"/proc/{pid}/exe").endswith("/gimdemFoam"):
                    continue
                words = Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
            except OSError:
                continue
            rank = [word for word in words if word.startswith(b"OMPI_COMM_WORLD_RANK=")]
            found[int(rank[0].split(b"=")[1])] = pid
        return [found[rank] for rank in sorted(found)]
