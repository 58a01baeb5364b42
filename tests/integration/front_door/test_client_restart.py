# SPDX-License-Identifier: BSD-3-Clause
"""The clients of cfd-client/examples are killed, come back within the grace time, and go on in another run: to the bit as if
nothing had happened."""
from __future__ import annotations

import hashlib
import os
import signal
import time
import unittest
from pathlib import Path

from column_case import CLIENTS, ColumnCaseTest

PROGRAM = {"column-python": "column.py"}
UNTIL = "0.04"  # [s], forty steps


class ClientRestarts(ColumnCaseTest):
    def setUp(self) -> None:
        super().setUp()
        self.edit("case.toml", r"^time_step = \S+", "time_step = 5e-6")  # steps that last long enough to be hit
        self.edit("case.toml", r"^duration = \S+", "duration = 0.0")
        self.edit("constant/column", r"^save_interval \S+", "save_interval 0.01")
        self.edit("constant/column", r"^inflow +\S+", "inflow 3.0")  # the beads move soon

    def kill_client(self, name: str, run: Path) -> None:
        """Behind its first state and before its last."""
        program = PROGRAM.get(name, name)
        while len(self.lines(run / "coupling.csv")) < 14:
            time.sleep(0.002)
        for pid in self.processes():
            words = Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
            if any(word.endswith("/" + program) for word in words[:2]):
                return os.kill(pid, signal.SIGKILL)
        self.fail(f"no process of {name}")

    @staticmethod
    def lines(file: Path) -> list[str]:
        return file.read_text().splitlines() if file.exists() else []

    def cut_run(self, name: str, number: int, schedule: str) -> Path:
        """A run to step 30 whose client is killed and comes back."""
        process = self.start("run", self.case, "--client", name, "--grace-time", "60", "--until", "0.03", "--schedule",
                             schedule)
        folder = self.case / "runs" / f"{number:04d}"
        self.kill_client(name, folder)
        code, _, err = self.finish(process, 120)
        self.assertEqual(code, 0, err)
        self.assertRegex(err, rf"(?m)^client: +{name} was killed by signal 9 \(SIGKILL\); started again from step_")
        return folder

    def table(self, file: Path) -> list[list[float]]:
        """The rows, as the same numbers look different in Python."""
        return [[float(word) for word in line.split(",")] for line in self.lines(file)[1:]]

    def end_of(self, folder: Path) -> dict[str, object]:
        """What a run ends with; column.csv and bed.csv by their last lines, as a run that goes on has only these."""
        checkpoint = sorted((folder / "checkpoints").iterdir())[-1]
        state = sorted((folder / "states").glob("*.state"))[-1]
        own = [word for line in self.lines(state) if not line.startswith("session ") for word in line.split()]
        return {checkpoint.name: checkpoint.read_bytes(),
                state.name: [float(word) if word[0] in "-0123456789" else word for word in own],
                "profile.csv": self.table(folder / "profile.csv"),
                **{name: self.table(folder / name)[-1] for name in ("column.csv", "bed.csv")}}

    def check(self, schedule: str, clients: tuple[str, ...]) -> None:
        whole = self.run_client("column-cpp", "--until", UNTIL, "--schedule", schedule)
        number = 1
        for name in clients:
            with self.subTest(name):
                cut = self.cut_run(name, number + 1, schedule)
                for file in ("column.csv", "bed.csv"):
                    rows = self.table(cut / file)
                    self.assertEqual(rows, self.table(whole / file)[:len(rows)])
                self.assertEqual(len(self.table(cut / "column.csv")), 30)
                end = self.run_client(name, "--restart", "latest", "--until", UNTIL, "--schedule", schedule)
                self.assertEqual(self.figures(end)["coupling_steps"], 10)
                self.assertEqual(self.end_of(end), self.end_of(whole))
                number += 2

    def test_serial(self) -> None:
        self.check("serial", CLIENTS)

    def test_overlapped(self) -> None:
        self.check("overlapped", ("column-c",))

    def test_state_that_is_cut_short_is_passed_over(self) -> None:
        self.run_client("column-c", "--until", "0.02")
        state = self.case / "runs" / "0001" / "states" / "000000020.state"
        state.write_text(state.read_text()[:-100])
        code, _, err = self.gimdem("run", self.case, "--client", "column-python", "--until", "0.02", "--restart", "latest")
        self.assertEqual(code, 0, err)
        self.assertIn("000000020.state: its last line is not 'end'", err)
        self.assertEqual(self.figures(self.case / "runs" / "0002")["coupling_steps"], 10, "from the one before")

    def test_state_of_another_solver_is_refused(self) -> None:
        self.run_client("column-c", "--until", "0.01")
        time_folder = self.case / "runs" / "0001" / "0.02"
        (time_folder / "uniform").mkdir(parents=True)
        (time_folder / "p").write_text("fields")
        (time_folder / "uniform" / "gimdemCheckpoint").write_text(
            'step "20";\ncheckpoint "step_000000010_at_0.01.h5";\n'
            f'files (("p" "6" "{hashlib.sha1(b"fields").hexdigest()}"));\n')
        code, _, err = self.gimdem("run", self.case, "--client", "column-c", "--restart", "latest")
        self.assertEqual(code, 2, err)
        self.assert_one_error(err, "was written by another solver", "--client")


if __name__ == "__main__":
    unittest.main()
