# SPDX-License-Identifier: BSD-3-Clause
"""The real server and the real OpenFOAM client, started by ./gimdem: a run, and faults in the middle of one."""
from __future__ import annotations

import json
import os
import re
import signal
import time
import unittest
from pathlib import Path

from front_door import tree_of
from real_case import RealCaseTest

RECORD = "uniform/gimdemCheckpoint"  # in a time folder that is whole
SMALL = 1e-12  # rounding of sums over thousands of cells and particles


class ShortRuns(RealCaseTest):
    def setUp(self) -> None:
        super().setUp()
        self.before = tree_of(self.case)

    def check(self, schedule: str, *options: str) -> None:
        code, out, err = self.gimdem("run", self.case, "--until", "0.002", "--schedule", schedule, *options)
        self.assertEqual(code, 0, err)
        figures = self.figures(self.run_folder)
        self.assertEqual(figures["coupling_steps"], 20)
        self.assertEqual(figures["particles"], 300)
        self.assertEqual(figures["particles_removed"], 0)
        self.assertEqual(figures["particles_lost"], 0)
        self.assertLess(figures["momentum_imbalance"], SMALL)
        self.assertLess(figures["volume_imbalance"], SMALL)
        if schedule != "overlapped":  # one works at a time, and waiting is what is left
            shares = sum(value for name, value in figures.items() if name.startswith("share_"))
            self.assertAlmostEqual(shares, 1, places=9, msg="no time is told twice")
        for name, value in figures.items():
            self.assertIsNotNone(value, f"{name} is not finite")
            self.assertIn(f"figure: {name} = ", out)
        for name in ("results.pvd", "bed.csv", "coupling.csv", "plots/snapshots.png", "plots/pressure_drop.png", "run.json"):
            self.assertTrue((self.run_folder / name).exists(), name)
        self.assertEqual(json.loads((self.run_folder / "run.json").read_text())["settings"]["schedule"], schedule)
        after = {name: content for name, content in tree_of(self.case).items() if name in self.before}
        self.assertEqual(after, self.before, "a run must not touch its case")

    def test_twenty_steps_serial(self) -> None:
        self.check("serial")

    def test_twenty_steps_overlapped(self) -> None:
        self.check("overlapped")

    def test_twenty_steps_iterated(self) -> None:
        self.check("iterated")
        figures = self.figures(self.run_folder)
        self.assertGreater(figures["passes_per_step"], 1)
        self.assertLessEqual(figures["residual_worst"], 1e-4)
        self.assertNotIn("did not agree", (self.run_folder / "log.gimdemFoam").read_text())

    def test_on_polyhedra(self) -> None:
        self.check("serial", "--grid", "E")
        self.assertIn("leastSquares", (self.run_folder / "system" / "fvSchemes").read_text())

    def test_over_tcp(self) -> None:
        self.edit(r'^endpoint = "ipc"', f'endpoint = "tcp://127.0.0.1:{20000 + os.getpid() % 20000}"')
        self.before = tree_of(self.case)
        self.check("serial")


class Restarts(RealCaseTest):
    """Twenty steps, with checkpoints and fields of the fluid in the middle and at the end."""

    def setUp(self) -> None:
        super().setUp()
        self.edit(r"^sample_interval = .*$", "sample_interval = 1e-4\ncheckpoint_interval = 1e-3")
        control = self.case / "system" / "controlDict"
        control.write_text(re.sub(r"(?m)^writeInterval .*;", "writeInterval 1e-3;", control.read_text()))
        self.assertEqual(self.gimdem("run", self.case, "--until", "0.002")[0], 0)

    def checkpoints(self, number: int) -> list[Path]:
        return sorted((self.case / "runs" / f"{number:04d}" / "checkpoints").iterdir())

    def last_row(self, number: int) -> list[float]:
        rows = (self.case / "runs" / f"{number:04d}" / "bed.csv").read_text().splitlines()
        return [float(value) for value in rows[-1].split(",")]

    def test_restarted_run_ends_where_the_uninterrupted_one_does(self) -> None:
        names = [file.name for file in self.checkpoints(1)]
        self.assertEqual(names, ["step_000000010_at_0.001.h5", "step_000000020_at_0.002.h5"])
        code, _, err = self.gimdem("run", self.case, "--until", "0.002", "--restart", self.checkpoints(1)[0])
        self.assertEqual(code, 0, err)
        self.assertEqual(self.figures(self.case / "runs" / "0002")["coupling_steps"], 10)
        self.assertEqual([file.name for file in self.checkpoints(2)], names[1:])
        self.assertEqual(self.last_row(1), self.last_row(2), "to the bit")
        for name in ("U", "p", "alpha", "alphaPhi", "alphaPhi_0"):
            one, other = (self.case / "runs" / run / "0.002" / name for run in ("0001", "0002"))
            self.assertEqual(one.read_bytes(), other.read_bytes(), name)
        one, other = self.checkpoints(1)[-1], self.checkpoints(2)[-1]
        self.assertEqual(one.read_bytes(), other.read_bytes())

    def test_latest_goes_on_from_the_end(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--until", "0.0025", "--restart", "latest")
        self.assertEqual(code, 0, err)
        self.assertEqual(self.figures(self.case / "runs" / "0002")["coupling_steps"], 5)
        self.assertEqual(self.checkpoints(2)[-1].name, "step_000000025_at_0.0025.h5")

    def test_what_does_not_fit_is_refused(self) -> None:
        before = tree_of(self.case / "runs" / "0001")
        code, _, err = self.gimdem("run", self.case, "--until", "0.002", "--restart", "latest")
        self.assertEqual(code, 1)
        self.assert_one_error(err, "nothing is left to do")
        code, _, err = self.gimdem("run", self.case, "--until", "0.003", "--restart", "latest", "--grid", "A")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "is of a run on grid B")
        self.assertEqual(tree_of(self.case / "runs" / "0001"), before)
        (self.case / "runs" / "0001" / "0.001" / RECORD).unlink()
        code, _, err = self.gimdem("run", self.case, "--until", "0.003", "--restart", self.checkpoints(1)[0])
        self.assertEqual(code, 2)
        self.assert_one_error(err, "has no fields of the fluid", "step_000000020_at_0.002.h5")

    def test_latest_passes_over_what_is_not_whole(self) -> None:
        run = self.case / "runs" / "0001"
        with (run / "0.002" / "p").open("r+b") as fields:
            fields.seek(-2000, os.SEEK_END)
            fields.write(b"\0")
        code, out, err = self.gimdem("run", self.case, "--until", "0.002", "--restart", "latest")
        self.assertEqual(code, 0, err)
        self.assertRegex(out + err, "not from .*0.002: p is damaged")
        self.assertEqual(self.figures(self.case / "runs" / "0002")["coupling_steps"], 10)
        (self.case / "runs" / "0002" / "0.002" / RECORD).unlink()  # as if the client had died before it
        (run / "checkpoints" / "step_000000010_at_0.001.h5").unlink()
        code, _, err = self.gimdem("run", self.case, "--until", "0.002", "--restart", "latest")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "left a checkpoint")


class Faults(RealCaseTest):
    """What happens once both are at work: the run is long enough never to end by itself."""

    def start_running(self):
        process = self.start("run", self.case, "--until", "50")
        self.wait_until(lambda: self.rows(self.run_folder) > 3 or process.poll() is not None, "samples", 60)
        self.assertIsNone(process.poll(), process.stderr.read() if process.poll() is not None else "")
        return process

    def pid_of(self, program: str) -> int:
        for pid in self.processes():
            if os.readlink(f"/proc/{pid}/exe").endswith(f"/{program}"):
                return pid
        raise AssertionError(f"{program} is not running")

    def killed(self, program: str, number: int, *parts: str) -> None:
        process = self.start_running()
        os.kill(self.pid_of(program), number)
        start = time.monotonic()
        code, _, err = self.finish(process)
        self.assertLess(time.monotonic() - start, 20, "the other must end within the time-out")
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, *parts)

    def test_killed_client_ends_the_server_which_keeps_its_state(self) -> None:
        self.killed("gimdemFoam", signal.SIGKILL, "gimdemFoam was killed by signal 9", "gimdem-server: ")
        self.assertGreater(self.figures(self.run_folder)["coupling_steps"], 0)
        self.assertEqual(len(list((self.run_folder / "checkpoints").iterdir())), 1)

    def test_killed_server_ends_the_client(self) -> None:
        self.killed("gimdem-server", signal.SIGKILL, "gimdem-server was killed by signal 9", "gimdemFoam: ")

    def test_hanging_client_ends_the_server(self) -> None:
        self.killed("gimdemFoam", signal.SIGSTOP, "gimdem-server ended with code 1", "gimdem-server: ")

    def test_hanging_server_ends_the_client(self) -> None:
        self.killed("gimdem-server", signal.SIGSTOP, "gimdemFoam ended with code 1", "gimdemFoam: ")

    def test_interrupt_ends_both_in_order(self) -> None:
        process = self.start_running()
        process.send_signal(signal.SIGINT)
        code, out, err = self.finish(process)
        self.assertEqual(code, 130, err)
        self.assertNotIn("error:", err)
        self.assertIn("figure: coupling_steps", out)
        self.assertIn("End", (self.run_folder / "log.gimdemFoam").read_text())

    def test_interrupt_before_the_first_step(self) -> None:
        self.edit(r"^duration = .*$", "duration = 50.0")
        self.edit(r"^kinetic_energy = .*$", "kinetic_energy = 0.0")
        process = self.start("run", self.case)
        self.wait_until(lambda: "Connected" in self.client_log(), "the client", 30)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        code, _, err = self.finish(process, 20)
        self.assertEqual(code, 130, err)

    def test_dictionary_that_the_client_refuses(self) -> None:
        (self.case / "system" / "fvSolution").write_text("nonsense { \n")
        start = time.monotonic()
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "gimdemFoam ended with code 1", "fvSolution")
        self.assertLess(time.monotonic() - start, 15)

    def test_particles_outside_the_mesh(self) -> None:
        self.edit(r"^box = \[\[0.0, ", "box = [[-0.05, ")
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "outside")

    def client_log(self) -> str:
        try:
            return (self.run_folder / "log.gimdemFoam").read_text(errors="replace")
        except OSError:
            return ""


if __name__ == "__main__":
    unittest.main()
