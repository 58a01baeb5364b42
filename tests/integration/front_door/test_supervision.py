# SPDX-License-Identifier: BSD-3-Clause
"""The launcher against peers that behave and misbehave on command. Needs no built binary."""
from __future__ import annotations

import json
import os
import pty
import signal
import socket
import time
import unittest
from pathlib import Path

from front_door import GIMDEM, FrontDoorTest, tree_of

FAKES = Path(__file__).resolve().parent / "fakes"
DICTIONARIES = ("0/U", "0/p", "constant/transportProperties", "constant/couplingProperties", "constant/polyMesh/points",
                "system/controlDict", "system/fvSchemes", "system/fvSolution")


class SupervisionTest(FrontDoorTest):
    def setUp(self) -> None:
        super().setUp()
        build = self.folder / "build"
        build.mkdir()
        (build / "bin").symlink_to(FAKES)
        self.environment["GIMDEM_BUILD_DIR"] = str(build)
        self.case = self.folder / "case"
        for name in DICTIONARIES:
            (self.case / name).parent.mkdir(parents=True, exist_ok=True)
            (self.case / name).write_text("{}\n")
        (self.case / "case.toml").write_text('title = "stand-in"\n')
        self.run_folder = self.case / "runs" / "0001"

    def misbehave(self, server: str = "", client: str = "") -> None:
        self.environment.update(FAKE_SERVER=server, FAKE_CLIENT=client)

    def start_running(self):
        """A run that goes on until it is stopped, once both peers are there."""
        process = self.start("run", self.case)
        self.wait_until(lambda: (self.run_folder / "client.pid").exists(), "the client")
        time.sleep(0.3)
        return process


class NormalRuns(SupervisionTest):
    def test_a_run_ends_with_figures_plots_and_paths(self) -> None:
        code, out, err = self.gimdem("run", self.case)
        self.assertEqual(code, 0, err)
        self.assertIn("figure: particles_lost = 0 [1]", out)
        self.assertIn("figure: mean_bed_height = 0.115 [m]", out)
        self.assertTrue((self.run_folder / "plots" / "bed_height.png").exists())
        record = json.loads((self.run_folder / "run.json").read_text())
        self.assertEqual(record["outcome"], "finished")
        self.assertIsNotNone(record["end"])

    def test_runs_are_numbered_and_never_overwritten(self) -> None:
        self.assertEqual(self.gimdem("run", self.case)[0], 0)
        first = tree_of(self.run_folder)
        self.assertEqual(self.gimdem("run", self.case)[0], 0)
        self.assertEqual(tree_of(self.run_folder), first)
        self.assertTrue((self.case / "runs" / "0002" / "summary.json").exists())

    def test_output_goes_where_the_user_says(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--output", "mine/first")
        self.assertEqual(code, 0, err)
        self.assertTrue((self.folder / "mine" / "first" / "run.json").exists())
        self.assertFalse((self.case / "runs").exists())


class Refusals(SupervisionTest):
    def refused(self, code: int, parts: list[str], *arguments: object) -> None:
        before = tree_of(self.folder)
        actual, _, err = self.gimdem(*arguments)
        self.assertEqual(actual, code, err)
        self.assert_one_error(err, *parts)
        self.assertEqual(tree_of(self.folder), before, "a refused run must not touch anything")
        self.assertFalse((self.case / "runs").exists())

    def test_output_folder_that_is_not_empty(self) -> None:
        (self.folder / "full").mkdir()
        (self.folder / "full" / "thesis.txt").write_text("years of work")
        self.refused(1, ["full", "never overwrites", "--output"], "run", self.case, "--output", "full")

    def test_output_that_is_a_file(self) -> None:
        (self.folder / "file").write_text("years of work")
        self.refused(1, ["file", "not an empty folder"], "run", self.case, "--output", "file")

    def test_bad_case_file(self) -> None:
        (self.case / "case.toml").write_text("bad = 1\n")
        self.refused(1, ["case.toml:1", 'did you mean "bed"'], "run", self.case)

    def test_absent_case_folder(self) -> None:
        self.refused(2, ["no case folder", "nowhere"], "run", "nowhere")

    def test_folder_without_case_file(self) -> None:
        (self.case / "case.toml").unlink()
        self.refused(2, ["no case.toml"], "run", self.case)

    def test_each_absent_dictionary_is_named(self) -> None:
        for name in DICTIONARIES:
            with self.subTest(name):
                (self.case / name).rename(self.folder / "aside")
                missing = "system/blockMeshDict" if "polyMesh" in name else name
                self.refused(1, [missing, "absent"], "run", self.case)
                (self.folder / "aside").rename(self.case / name)

    def test_unknown_client_grid_device_schedule_and_option(self) -> None:
        self.refused(2, ["fluent", "openfoam"], "run", self.case, "--client", "fluent")
        self.refused(2, ["no grid 'Z'"], "run", self.case, "--grid", "Z")
        self.refused(2, ["abacus"], "run", self.case, "--device", "abacus")
        self.refused(2, ["never"], "run", self.case, "--schedule", "never")
        self.refused(2, ["--fast"], "run", self.case, "--fast")
        self.refused(2, ["unknown command", "fly"], "fly")

    def test_what_is_to_come_says_what_there_is(self) -> None:
        self.refused(2, ["reference client", "--client openfoam"], "run", self.case, "--client", "reference")
        self.refused(2, ["CPU", "--device cpu"], "run", self.case, "--device", "cuda")

    def test_numbers_out_of_range(self) -> None:
        for value in ("0", "-1", "nan", "inf", "soon"):
            with self.subTest(value):
                self.refused(2, ["--until"], "run", self.case, "--until", value)
        for value in ("0", "33", "-1", "two"):
            with self.subTest(ranks=value):
                self.refused(2, ["--ranks"], "run", self.case, "--ranks", value)

    def test_endpoint_in_use(self) -> None:
        (self.case / "case.toml").write_text('title = "tcp"\n')
        with socket.create_server(("127.0.0.1", 5599)):
            self.refused(1, ["tcp://127.0.0.1:5599", "in use"], "run", self.case)


class Faults(SupervisionTest):
    def failed(self, *parts: str) -> None:
        start = time.monotonic()
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, *parts)
        self.assertLess(time.monotonic() - start, 15)
        self.assertEqual(json.loads((self.run_folder / "run.json").read_text())["outcome"], "failed")

    def test_client_killed(self) -> None:
        self.misbehave(client="die")
        self.failed("gimdemFoam was killed by signal 9", "client fake disappeared")

    def test_server_killed(self) -> None:
        self.misbehave(server="die", client="run")
        self.failed("gimdem-server was killed by signal 9", "server fake disappeared")

    def test_client_with_a_fatal_error(self) -> None:
        self.misbehave(client="fail")
        self.failed("gimdemFoam ended with code 1", "the pressure equation did not converge")

    def test_server_that_refuses_starts_no_client(self) -> None:
        self.misbehave(server="refuse")
        self.failed("gimdem-server ended with code 1", "bed.xyz is absent")
        self.assertFalse((self.run_folder / "client.pid").exists())

    def test_server_that_does_not_notice_is_ended(self) -> None:
        self.misbehave(server="deaf", client="die")
        self.failed("gimdemFoam was killed", "was ended")

    def test_server_that_will_not_go_is_killed(self) -> None:
        self.misbehave(server="stubborn", client="die")
        self.failed("gimdemFoam was killed", "was ended")

    def test_client_that_does_not_notice_is_ended(self) -> None:
        self.misbehave(server="die", client="deaf")
        self.failed("gimdem-server was killed", "was ended")


class Signals(SupervisionTest):
    def test_termination_ends_the_run_in_order(self) -> None:
        self.misbehave(client="run")
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = self.start_running()
                process.send_signal(number)
                code, out, err = self.finish(process, 10)
                self.assertEqual(code, 128 + number, err)
                self.assertIn("figure: particles_lost", out)
                self.assertNotIn("error:", err)
                self.assertEqual(json.loads((self.run_folder / "run.json").read_text())["outcome"], "stopped")
                self.run_folder = self.case / "runs" / "0002"

    def test_second_interrupt_kills_at_once(self) -> None:
        self.misbehave(server="busy", client="run,parent")  # like mpirun, whose ranks must not be left over
        process = self.start_running()
        process.send_signal(signal.SIGINT)
        time.sleep(0.5)
        self.assertIsNone(process.poll(), "the server is still busy")
        process.send_signal(signal.SIGINT)
        code, _, err = self.finish(process, 10)
        self.assertEqual(code, 130, err)

    def test_nothing_survives_a_killed_launcher(self) -> None:
        self.misbehave(server="stubborn", client="deaf")
        process = self.start_running()
        process.kill()
        self.finish(process, 10)
        self.wait_until(lambda: not self.processes(), "the peers to go", 5)
        for leftover in (self.folder / "tmp").iterdir():  # nobody was left to remove the socket's folder
            (leftover / "socket").unlink()
            leftover.rmdir()

    def test_ctrl_c_on_a_terminal(self) -> None:
        self.misbehave(client="run")
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execve(str(GIMDEM), [str(GIMDEM), "run", str(self.case)], self.environment)
        self.wait_until(lambda: (self.run_folder / "client.pid").exists(), "the client")
        time.sleep(0.5)
        os.write(terminal, b"\x03")
        seen = read_all(terminal)
        _, status = os.waitpid(pid, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), 130, seen)
        self.assertIn("\r\x1b[Kt = 2 ms", seen, "the progress line is rewritten in place")
        self.assertIn("stopping", seen)
        self.assertIn("figure: particles_lost", seen)
        self.assertNotIn("error:", seen)


def read_all(terminal: int) -> str:
    """All that a terminal shows until its last process has gone."""
    seen = b""
    while True:
        try:
            data = os.read(terminal, 4096)
        except OSError:  # EIO: closed
            data = b""
        if not data:
            return seen.decode(errors="replace")
        seen += data


if __name__ == "__main__":
    unittest.main()
