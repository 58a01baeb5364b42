# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem run --ranks 2: the same results as of one process, and every end in order."""
from __future__ import annotations

import json
import os
import re
import shutil
import signal
import sys
import unittest
from pathlib import Path

from front_door import ROOT, tree_of
from ranked_case import RankedCaseTest

sys.path.insert(0, str(ROOT / "tools"))
import rank_parts  # noqa: E402
from restart import RECORD, TimeFolder  # noqa: E402

# The pressure is solved to 1e-9 of its first residual, 1e4 of which the matrix may make an error of the solution; forces
# on particles and their 4 steps hand it on.
TOLERANCE = 1e-5
# Of the wall clock, of what travels, or of rounding.
NOT_COMPARED = ("wall", "share_", "bytes", "imbalance", "overlap", "lag", "exchange", "waiting")
FIELD = re.compile(r"internalField\s+nonuniform List<(?:scalar|vector)>\s*\d+\s*\(\n(.*?)\n\)\s*;", re.DOTALL)


class Ranks(RankedCaseTest):
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
        # The same cut: each rank goes on from its own fields, and both sides end to the bit as if they had not stopped.
        self.assert_same_end(two, restarted)
        self.assert_parts_are_used_only_if_whole(two)

        anew = self.run_case(1, "0.0004", "--restart", middle)
        for name in ("U", "p", "alpha"):  # cut in another way: to the tolerance of the solvers
            self.assert_close(self.numbers(two / "0.0004" / name), self.numbers(anew / "0.0004" / name),
                              f"restarted_{name}")

    def assert_same_end(self, one: Path, other: Path) -> None:
        checkpoint = Path("checkpoints") / "step_000000004_at_0.0004.h5"
        self.assertEqual((one / checkpoint).read_bytes(), (other / checkpoint).read_bytes(), "particles")
        for folder in ("0.0004", "ranks/processor0/0.0004", "ranks/processor1/0.0004"):
            ones, others = tree_of(one / folder), tree_of(other / folder)
            for fields in (ones, others):
                del fields["uniform/gimdemCheckpoint"]  # differs in the number of the session
            self.assertGreaterEqual(set(ones), {"U", "p", "alpha", "alphaPhi"}, folder)
            self.assertEqual(sorted(name for name in ones.keys() | others.keys() if ones.get(name) != others.get(name)),
                             [], f"fluid in {folder}")
        # The first row of a restarted run has no interval before it.
        rows = [(run / "bed.csv").read_text().splitlines() for run in (one, other)]
        self.assertEqual(rows[0][-1], rows[1][-1], "bed.csv")

    def assert_parts_are_used_only_if_whole(self, run: Path) -> None:
        state = TimeFolder(run / "0.0002", (run / "0.0002" / RECORD).read_text(), run)
        cut = run / rank_parts.DICTIONARY
        parts = rank_parts.usable(state, cut, 2)
        self.assertEqual([part.relative_to(run) for part in parts], [Path("ranks/processor0"), Path("ranks/processor1")])
        self.assertEqual(rank_parts.usable(state, cut, 3), [], "another number of ranks")
        other_cut = self.folder / "another_cut"
        other_cut.write_text(cut.read_text().replace("simple", "hierarchical"))
        self.assertEqual(rank_parts.usable(state, other_cut, 2), [])
        velocity = parts[1] / "0.0002" / "U"
        whole = velocity.read_bytes()
        velocity.write_bytes(whole[:-1] + b" ")
        self.assertEqual(rank_parts.usable(state, cut, 2), [], "damaged fields")
        velocity.write_bytes(whole)
        self.assertEqual(rank_parts.usable(state, cut, 2), parts)

    def start_running(self):
        process = self.start("run", self.case, "--ranks", 2, "--until", "50")
        self.wait_until(lambda: self.rows(self.run_folder) > 3 or process.poll() is not None, "samples", 90)
        self.assertIsNone(process.poll(), process.stderr.read() if process.poll() is not None else "")
        return process

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
