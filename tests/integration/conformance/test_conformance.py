# SPDX-License-Identifier: BSD-3-Clause
"""gimdem-conformance: good clients pass every line, and a client with one thing broken fails the lines that it should.

    test_conformance.py FOLDER_OF_PROGRAMS [--foam]      --foam: gimdemFoam was built
"""
from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
PYTHON = "/usr/bin/python3"  # with zmq, protobuf and numpy
BROKEN = [PYTHON, str(HERE / "broken_client.py")]


class Conformance(unittest.TestCase):
    programs: Path
    has_foam = False

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="gimdem-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        shutil.copytree(ROOT / "cases" / "column-bed" / "constant", self.folder / "constant")
        column = self.folder / "constant" / "column"
        column.write_text(column.read_text().replace("timeout    30 ", "timeout    1 "))

    def prove(self, client: list[str], *options: str) -> tuple[int, dict[str, str], str]:
        """Exit code, verdict of each line, and all that was printed."""
        if "--until" not in options:
            options = ("--until", "0.006", *options)
        own = Path(tempfile.mkdtemp(dir=self.folder))  # of this client, as others run at the same time
        shutil.copytree(self.folder / "constant", own / "constant")
        folder = [] if client[-1] == "-endpoint" else [str(own)]
        command = [str(self.programs / "gimdem-conformance"), *options, "--", *client, "{endpoint}", *folder]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=200)
        lines = [line.split(maxsplit=1) for line in done.stdout.splitlines() if line[:1] in "oF-" and line]
        return done.returncode, {rest[:26].strip(): verdict for verdict, rest in lines}, done.stdout + done.stderr

    def passes(self, client: list[str], *options: str, lines: int = 22) -> None:
        code, verdicts, text = self.prove(client, *options)
        self.assertEqual(code, 0, text)
        self.assertEqual(set(verdicts.values()), {"ok"}, text)
        self.assertEqual(len(verdicts), lines, text)

    def test_examples(self) -> None:
        """In C++, in C over tcp, and in Python; at the same time, as most of it is waiting."""
        clients = ([str(self.programs / "column-cpp")], [str(self.programs / "column-c")],
                   [PYTHON, str(ROOT / "cfd-client" / "examples" / "column.py")])
        with ThreadPoolExecutor() as pool:
            for trial in [pool.submit(self.passes, client, *options) for client, options
                          in zip(clients, ((), ("--tcp",), ()))]:
                trial.result()

    def test_gimdem_foam(self) -> None:
        """On the box of wachem-bed with 5 x 1 x 25 cells."""
        if not self.has_foam:
            self.skipTest("gimdemFoam was not built")
        sys.path.insert(0, str(ROOT / "tools"))
        import openfoam

        case = self.folder / "case"
        for part in ("0", "constant", "system"):
            shutil.copytree(ROOT / "cases" / "wachem-bed" / part, case / part)
        grid = (case / "system" / "blockMeshDict.A").read_text()
        (case / "system" / "blockMeshDict").write_text(re.sub(
            r"(n[xyz]) \d+;", lambda found: f"{found[1]} {dict(nx=5, ny=1, nz=25)[found[1]]};", grid))
        openfoam.make_mesh(case)
        coupling = case / "constant" / "couplingProperties"
        coupling.write_text(coupling.read_text().replace("timeout     30;", "timeout     2;"))
        os.environ.update(openfoam.environment())
        self.passes([str(self.programs / "gimdemFoam"), "-case", str(case), "-endpoint"], "--until", "0.0006",
                    lines=29)  # it iterates

    def fails(self, what: str, trial: str, *expected: str) -> None:
        """Broken in that way, the client fails these lines of that trial and no other."""
        code, verdicts, text = self.prove([*BROKEN, what], "--only", trial, "--patience", "3")
        self.assertEqual(code, 1, text)
        self.assertEqual({name for name, verdict in verdicts.items() if verdict == "FAILED"}, set(expected), text)

    def test_open_cell(self) -> None:
        self.fails("mesh", "serial", "serial: mesh", "serial: exit code")

    def test_old_solid(self) -> None:
        self.fails("time level", "serial", "serial: time level")
        self.fails("time level", "overlapped", "overlapped: conservation")  # of a level that neither schedule has

    def test_half_of_the_force(self) -> None:
        self.fails("conservation", "serial", "serial: conservation", "serial: time level")

    def test_steps_with_a_gap(self) -> None:
        self.fails("step number", "serial", "serial: steps", "serial: exit code")
        self.fails("step time", "serial", "serial: steps", "serial: exit code")

    def test_field_that_is_cut_or_absent(self) -> None:
        self.fails("cut field", "serial", "serial: fields", "serial: exit code")
        self.fails("absent field", "serial", "serial: fields", "serial: exit code")

    def test_end_before_the_end_time(self) -> None:
        self.fails("end", "serial", "serial: end time")

    def test_stop_request_that_is_not_heard(self) -> None:
        code, verdicts, text = self.prove([*BROKEN, "stop"], "--only", "stop request", "--limit", "3")
        self.assertEqual((code, verdicts), (1, {"stop request": "FAILED"}), text)

    def test_exit_code_that_hides_the_fault(self) -> None:
        for trial in ("refused mesh", "lost server"):
            self.fails("exit code", trial, trial)

    def test_hang_after_the_loss_of_the_server(self) -> None:
        self.fails("hang", "lost server", "lost server")

    def test_version_that_is_not_looked_at(self) -> None:
        self.fails("version", "wrong version", "wrong version")

    def test_no_heartbeats(self) -> None:
        self.fails("heartbeat", "slow server", "slow server")

    def test_wrong_usage(self) -> None:
        done = subprocess.run([str(self.programs / "gimdem-conformance"), "--", "true"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("{endpoint}", done.stderr)


if __name__ == "__main__":
    if "--foam" in sys.argv:
        sys.argv.remove("--foam")
        Conformance.has_foam = True
    Conformance.programs = Path(sys.argv.pop(1))
    unittest.main()
