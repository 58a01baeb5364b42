# SPDX-License-Identifier: BSD-3-Clause
"""A rank of gimdemFoam is killed, and all ranks come back to a server that waits: the same fluid to the bit as of a run
that nothing happened to."""
from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

from front_door import ROOT
from ranked_case import RankedCaseTest

sys.path.insert(0, str(ROOT / "tools"))
import openfoam  # noqa: E402
import parallel  # noqa: E402
from console import openfoam_client_binary, server_binary  # noqa: E402

RANKS = 2
LOST_AT, COMPARED_AT = "0.0002", "0.0006"  # [s], both with a checkpoint
RECORD = "uniform/gimdemCheckpoint"


class RankReturn(RankedCaseTest):
    def setUp(self) -> None:
        super().setUp()
        # On a busy machine the run must not be over before a rank is killed, nor a rank be taken for dead.
        self.edit(r"^timeout = .*$", "timeout = 40.0")
        dictionary = self.case / "constant" / "couplingProperties"
        dictionary.write_text(dictionary.read_text().replace("timeout     3;", "timeout     40;"))
        self.scratch = parallel.Scratch(RANKS)
        self.addCleanup(self.scratch.remove)

    def prepare(self, whole: Path) -> Path:
        """A run folder like that one, before its run."""
        run = self.folder / "run"
        for name in ("0", "constant", "system"):
            shutil.copytree(whole / name, run / name)
        parallel.tool("decomposePar", [], run)
        return run

    def begin(self, command: list[str], log: Path, env: dict[str, str]) -> subprocess.Popen[bytes]:
        with log.open("ab") as output:
            return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, env=env)

    def start_server(self, run: Path) -> subprocess.Popen[bytes]:
        return self.begin([str(server_binary()), "--case", str(self.case_file), "--run", str(run), "--endpoint",
                           self.endpoint, "--until", "50", "--grace-time", "60"], run / "log.server", self.environment)

    def start_client(self, run: Path, *options: str) -> subprocess.Popen[bytes]:
        alone = [str(openfoam_client_binary()), "-case", str(run), "-endpoint", self.endpoint, *options]
        environment = self.scratch.environment({**openfoam.environment(), **self.environment})
        return self.begin(parallel.command(alone, RANKS), run / "log.gimdemFoam", environment)

    def wait_for_pair(self, run: Path, time: str, client: subprocess.Popen[bytes]) -> None:
        parts = [run / f"processor{rank}" / time / RECORD for rank in range(RANKS)]
        self.wait_until(lambda: all(map(Path.is_file, parts)) or client.poll() is not None, f"pair of {time} s", 90)
        self.assertTrue(all(map(Path.is_file, parts)), (run / "log.gimdemFoam").read_text()[-2000:])

    def drop_what_came_later(self, run: Path) -> None:
        """So that what is compared was written after the return."""
        for part in run.glob("processor*"):
            for folder in part.iterdir():
                if parallel.is_number(folder.name) and float(folder.name) > float(LOST_AT):
                    shutil.rmtree(folder)

    def test_is_as_if_nothing_had_happened(self) -> None:
        whole = self.run_case(RANKS, COMPARED_AT)
        run = self.prepare(whole)
        self.endpoint = f"ipc://{self.folder}/socket"
        server = self.start_server(run)
        self.wait_until((self.folder / "socket").exists, "the server")
        client = self.start_client(run)
        self.wait_for_pair(run, LOST_AT, client)
        os.kill(self.ranks()[1], signal.SIGKILL)
        self.assertNotEqual(client.wait(60), 0)
        self.wait_until(lambda: "for a client that goes on" in (run / "log.server").read_text(), "the grace time")
        self.assertIn("rank 1 of 2", (run / "log.server").read_text())

        self.drop_what_came_later(run)
        client = self.start_client(run, "-restart", LOST_AT)
        self.wait_for_pair(run, COMPARED_AT, client)
        server.send_signal(signal.SIGINT)
        self.assertEqual(client.wait(60), 0, (run / "log.gimdemFoam").read_text()[-2000:])
        server.wait(60)

        self.assertIn("has come back", (run / "log.server").read_text())
        for rank in range(RANKS):
            for name in ("U", "p", "alpha", "alphaPhi"):
                self.assertEqual((run / f"processor{rank}" / COMPARED_AT / name).read_bytes(),
                                 (whole / "ranks" / f"processor{rank}" / COMPARED_AT / name).read_bytes(),
                                 f"{name} of rank {rank}")


if __name__ == "__main__":
    unittest.main()
