# SPDX-License-Identifier: BSD-3-Clause
"""A client that dies while the server has a grace time: started again, or not, and why. Needs no built binary."""
from __future__ import annotations

import json
import os
import pty
import signal
import unittest

from front_door import GIMDEM
from test_supervision import SupervisionTest, read_all


class Comeback(SupervisionTest):
    def setUp(self) -> None:
        super().setUp()
        (self.case / "case.toml").write_text('title = "grace"\n')

    def starts(self) -> list[str]:
        """Command lines of the client."""
        return (self.run_folder / "starts").read_text().splitlines()

    def comes_back(self, moods: str, *parts: str) -> None:
        self.misbehave(client=moods)
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 0, err)
        self.assertNotIn("error:", err)
        told = [line for line in err.splitlines() if line.startswith("client:")]
        self.assertEqual(len(told), 1, err)
        for part in (*parts, "started again from step_10.h5, 1 of 2"):
            self.assertIn(part, told[0])
        self.assertEqual(len(self.starts()), 2)
        self.assertNotIn("-restart", self.starts()[0])
        self.assertTrue(self.starts()[1].endswith("-restart 0.1"), self.starts()[1])
        record = json.loads((self.run_folder / "run.json").read_text())
        self.assertEqual((record["outcome"], record["client_starts"]), ("finished", 2))

    def stays_away(self, moods: str, starts: int, *parts: str) -> str:
        self.misbehave(client=moods)
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "the run failed: gimdemFoam")
        self.assertEqual(len(self.starts()), starts)
        for part in parts:
            self.assertIn(part, err)
        return err

    def test_after_it_was_killed(self) -> None:
        self.comes_back("save,die,once", "was killed by signal 9")

    def test_after_a_shell_told_that_it_crashed(self) -> None:
        self.comes_back("save,code,once", "ended with code 139")

    def test_after_it_hung(self) -> None:
        self.comes_back("save,hang,once", "hung and was killed")

    def test_told_in_lines_of_their_own_on_a_terminal(self) -> None:
        self.misbehave(client="save,die,once")
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execve(str(GIMDEM), [str(GIMDEM), "run", str(self.case)], self.environment)
        seen = read_all(terminal)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), 0, seen)
        self.assertRegex(seen, r"\ngimdem-server: client fake disappeared; waiting 60 s for a client that goes on\r\n")
        self.assertRegex(seen, r"\nclient: +gimdemFoam was killed by signal 9")

    def test_not_for_ever(self) -> None:
        self.stays_away("save,die", 3, "1 of 2", "2 of 2", "died 3 times behind step_10.h5")

    def test_not_where_somebody_has_told_it_to_end(self) -> None:
        self.stays_away("save,term", 1, "signal 15", "this signal says that it should end")

    def test_not_without_a_checkpoint(self) -> None:
        self.stays_away("die,once", 1, "no checkpoint yet")

    def test_not_after_an_error_of_the_solver(self) -> None:
        self.stays_away("save,fail,once", 1, "did not converge")

    def test_not_after_a_crash_with_an_error_of_the_solver(self) -> None:
        self.stays_away("save,die,told,once", 1, "its log tells an error", "did not converge")

    def test_not_without_a_grace_time(self) -> None:
        (self.case / "case.toml").write_text('title = "stand-in"\n')
        self.assertNotIn("client:", self.stays_away("save,die,once", 1))

    def test_option_wins_over_the_case(self) -> None:
        self.misbehave(client="save,die,once")
        code, _, err = self.gimdem("run", self.case, "--grace-time", "0")
        self.assertEqual(code, 1, err)
        code, _, err = self.gimdem("run", self.case, "--grace-time", "-1")
        self.assertEqual(code, 2, err)
        (self.case / "case.toml").write_text('title = "stand-in"\n')
        code, _, err = self.gimdem("run", self.case, "--grace-time", "30")
        self.assertEqual(code, 0, err)

    def test_not_where_the_user_has_stopped_the_run(self) -> None:
        self.misbehave(server="busy", client="save,run")
        process = self.start_running()
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        code, _, err = self.finish(process, 20)
        self.assertIn(code, (130, 143), err)
        self.assertEqual(len(self.starts()), 1)


if __name__ == "__main__":
    unittest.main()
