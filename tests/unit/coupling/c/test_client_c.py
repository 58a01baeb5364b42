# SPDX-License-Identifier: BSD-3-Clause
"""libgimdem_client: what it exports, every status that it can return, and its use after cmake --install.

    test_client_c.py BUILD_FOLDER STATUSES
"""
from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[4]
HEADER = ROOT / "coupling" / "include" / "gimdem" / "coupling" / "client.h"
STATUSES = {name: int(number) for name, number in re.findall(r"GIMDEM_ERROR_(\w+) = (-?\d+)", HEADER.read_text())}


class ClientInC(unittest.TestCase):
    build: Path
    statuses: str

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="gimdem-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_program(self, *command: object) -> str:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_exports_the_functions_of_the_header_and_nothing_else(self) -> None:
        declared = set(re.findall(r"\b(gimdem_client_\w+)\(", re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)))
        told = self.run_program("nm", "-D", "--defined-only", self.build / "lib" / "libgimdem_client.so")
        exported = {line.split()[2].split("@")[0] for line in told.splitlines() if line.split()[1] != "A"}
        self.assertEqual(exported, declared)
        self.assertGreater(len(declared), 10)

    def test_mistakes_of_the_program(self) -> None:
        self.run_program(self.statuses)

    def test_no_memory(self) -> None:
        if "-fsanitize" in (self.build / "build.ninja").read_text():
            self.skipTest("the address sanitizer needs more memory than the limit allows")
        self.run_program(self.statuses, "no-memory")

    def session(self, status: int | str, *options: str) -> str:
        """One session against a mock server."""
        endpoint = f"ipc://{self.folder}/socket"
        server = subprocess.Popen([str(self.build / "bin" / "gimdem-mock-server"), "--endpoint", endpoint, *options],
                                  stdout=subprocess.DEVNULL)
        try:
            return self.run_program(self.statuses, endpoint, status)
        finally:
            server.kill()
            server.wait()

    def test_whole_session(self) -> None:
        self.session(0)

    def test_statuses_of_a_session(self) -> None:
        because = "because the script of the mock server says so"
        for misbehaviour, name, words in (
            ("wrong-version", "VERSION", "2.0"), ("refuse-mesh", "MESH", because), ("truncate", "PROTOCOL", "bytes"),
            ("die", "PEER", "disappeared"), ("report-error", "PEER", because), ("fall-silent", "TIMEOUT", "silent"),
        ):
            with self.subTest(misbehaviour):
                self.assertIn(words, self.session(STATUSES[name], "--misbehave", misbehaviour))

    def test_iterated_session(self) -> None:
        self.session("iterated", "--schedule", "iterated")

    def test_no_server(self) -> None:
        told = self.run_program(self.statuses, f"ipc://{self.folder}/nobody", STATUSES["ENDPOINT"])
        self.assertIn("no server has answered", told)

    def test_installed(self) -> None:
        """As a C program elsewhere finds it."""
        self.run_program("cmake", "--install", self.build, "--component", "client", "--prefix", self.folder)
        config = next(self.folder.rglob("gimdem-client.pc"))
        flags = self.run_program("env", f"PKG_CONFIG_PATH={config.parent}", "pkg-config", "--cflags", "--libs",
                                 "gimdem-client").split()
        # The sanitizers of a build for tests belong to the program, too.
        more = ["-fsanitize=address,undefined"] if "-fsanitize" in (self.build / "build.ninja").read_text() else []
        self.run_program("cc", "-std=c99", "-pedantic", "-Werror", ROOT / "cfd-client" / "examples" / "column.c", "-o",
                         self.folder / "column", *flags, *more, "-lm")
        library = next(self.folder.rglob("libgimdem_client.so"))
        told = subprocess.run([str(self.folder / "column")], env={"LD_LIBRARY_PATH": str(library.parent)},
                              capture_output=True, text=True)
        self.assertEqual(told.returncode, 2)
        self.assertRegex(told.stderr, r"^usage: column-c <endpoint> <run folder> ")


if __name__ == "__main__":
    ClientInC.statuses = sys.argv.pop(2)
    ClientInC.build = Path(sys.argv.pop(1))
    unittest.main()
