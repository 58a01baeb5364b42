# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem run --ranks 2: the same results as of one process, and every end in order."""
from __future__ import annotations

import json
import os
import re
import shutil
import signal
import unittest
from pathlib import Path

from real_case import RealCaseTest

# The pressure is solved to 1e-9 of its first residual, 1e4 of which the matrix may make an error of the solution; forces
# on particles and their 4 steps hand it on.
TOLERANCE = 1e-5
# Of the wall clock, of what travels, or of rounding.
NOT_COMPARED = ("wall", "share_", "bytes", "imbalance", "overlap", "lag", "exchange", "waiting")
FIELD = re.compile(r"internalField\s+nonuniform List<(?:scalar|vector)>\s*\d+\s*\(\n(.*?)\n\)\s*;", re.DOTALL)


class Ranks(RealCaseTest):
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

    def numbers(self, file: Path) -> list[float]:
        """The values of the cells."""
        found = FIELD.search(file.read_text())
        self.assertIsNotNone(found, f"{file} has no values")
        return [float(word) for word in re.findall(r"[-+.\de]+", found[1])]

    def assert_close(self, ones: list[float], others: list[float], what: str) -> None:
        self.assertEqual(len(ones), len(others), what)
        difference = max(abs(one - other) for one, other in zip(ones, others)) / max(map(abs, ones))
        print(f"figure: ranks_difference_of_{what} = {difference:.3g} [1]")
        self.assertLess(difference, TOLERANCE, what)

    def assert_in_order(self, run: Path) -> None:
        """As one process leaves it."""
        self.assertEqual(list(run.glob("processor*")), [])
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])

    def test_two_agree_with_one_and_restart(self) -> None:
        one = self.run_case(1, "0.0004")
        two = self.run_case(2, "0.0004")
        self.assert_in_order(two)
        self.assertEqual(json.loads((two / "run.json").read_text())["settings"]["ranks"], 2)
        for name in ("U", "p", "alpha", "dragMomentum"):
            self.assert_close(self.numbers(one / "0.0004" / name), self.numbers(two / "0.0004" / name), name)
        others = self.figures(two)
        for name, value in self.figures(one).items():
            if not any(word in name for word in NOT_COMPARED):
                self.assertLess(abs(others[name] - value), TOLERANCE * abs(value) + 1e-12, name)
        self.assertLess(others["momentum_imbalance"], 1e-12)
        self.assertLess(others["volume_imbalance"], 1e-12)

        middle = two / "checkpoints" / "step_000000002_at_0.0002.h5"
        restarted = self.run_case(2, "0.0004", "--restart", middle)
        self.assertEqual(self.figures(restarted)["coupling_steps"], 2)
        # Same cut, same numbers but for rounding in files, and the same solvers to their tolerance.
        for name in ("U", "p", "alpha"):
            self.assert_close(self.numbers(two / "0.0004" / name), self.numbers(restarted / "0.0004" / name),
                              f"restarted_{name}")

    def start_running(self):
        process = self.start("run", self.case, "--ranks", 2, "--until", "50")
        self.wait_until(lambda: self.rows(self.run_folder) > 3 or process.poll() is not None, "samples", 90)
        self.assertIsNone(process.poll(), process.stderr.read() if process.poll() is not None else "")
        return process

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

    def test_a_killed_rank_ends_the_run(self) -> None:
        process = self.start_running()
        os.kill(self.ranks()[1], signal.SIGKILL)
        code, _, err = self.finish(process)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "gimdem-server: ", "of 2\"")
        self.assertTrue((self.run_folder / "0.0002" / "U").exists(), "what was written is put together")
        self.assert_in_order(self.run_folder)

    def test_interrupt_ends_all_in_order(self) -> None:
        process = self.start_running()
        process.send_signal(signal.SIGINT)
        code, out, err = self.finish(process)
        self.assertEqual(code, 130, err)
        self.assertNotIn("error:", err)
        self.assertIn("figure: coupling_steps", out)
        self.assert_in_order(self.run_folder)

    def test_a_killed_launcher_leaves_no_process_and_a_run_to_restart(self) -> None:
        process = self.start_running()
        process.kill()
        self.finish(process)
        self.wait_until(lambda: not self.processes(), "the end of all processes", 30)
        for left in (self.folder / "tmp").iterdir():  # what a killed launcher cannot remove: sockets
            self.assertTrue(left.name.startswith("gimdem-"), left)
            shutil.rmtree(left)
        self.assertFalse((self.run_folder / "0.0002").exists())
        checkpoint = self.run_folder / "checkpoints" / "step_000000002_at_0.0002.h5"
        restarted = self.run_case(1, "0.0005", "--restart", checkpoint)
        self.assertEqual(self.figures(restarted)["coupling_steps"], 3)


if __name__ == "__main__":
    unittest.main()
