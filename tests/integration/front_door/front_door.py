# SPDX-License-Identifier: BSD-3-Clause
"""Run ./gimdem from tests, and see what it leaves behind."""
from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import uuid
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
GIMDEM = ROOT / "gimdem"
MARK = "GIMDEM_TEST_MARK"


def tree_of(folder: Path) -> dict[str, bytes]:
    """All files below a folder with their content."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class FrontDoorTest(unittest.TestCase):
    """A temporary folder, an environment by which all our processes can be found again, and the usual assertions."""

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="gimdem-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        (self.folder / "tmp").mkdir()
        self.mark = uuid.uuid4().hex
        self.environment = {
            **os.environ, MARK: self.mark, "GIMDEM_NO_BUILD": "1", "GIMDEM_NO_SETUP": "1",
            "PYTHONDONTWRITEBYTECODE": "1", "TMPDIR": str(self.folder / "tmp"),
        }

    def tearDown(self) -> None:
        left = self.processes()
        for pid in left:
            os.kill(pid, signal.SIGKILL)
        self.assertEqual(left, [], "processes are left over")
        self.assertEqual(list((self.folder / "tmp").iterdir()), [], "temporary files are left over")

    def processes(self) -> list[int]:
        """Living processes that inherited our mark."""
        needle = f"{MARK}={self.mark}".encode()
        found = []
        for entry in Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and needle in (entry / "environ").read_bytes():
                    found.append(int(entry.name))
            except OSError:
                continue
        return found

    def start(self, *arguments: object) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [str(GIMDEM), *map(str, arguments)], env=self.environment, cwd=self.folder, text=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )

    def finish(self, process: subprocess.Popen[str], patience: float = 60) -> tuple[int, str, str]:
        out, err = process.communicate(timeout=patience)
        return process.returncode, out, err

    def gimdem(self, *arguments: object, patience: float = 60) -> tuple[int, str, str]:
        return self.finish(self.start(*arguments), patience)

    def wait_until(self, condition, what: str, patience: float = 30.0) -> None:
        end = time.monotonic() + patience
        while not condition():
            self.assertLess(time.monotonic(), end, f"waited in vain for: {what}")
            time.sleep(0.05)

    def assert_one_error(self, err: str, *parts: str) -> None:
        """Exactly one error on the terminal; it says each of `parts`."""
        self.assertEqual(err.count("error:"), 1, err)
        message = err[err.index("error:") :]
        for part in parts:
            self.assertIn(part, message)
        self.assertNotIn("Traceback", err)
