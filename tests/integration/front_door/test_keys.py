# SPDX-License-Identifier: BSD-3-Clause
"""Keys through ./gimdem run to every client, at an address that other machines could use, and who is turned away."""
from __future__ import annotations

import shutil
import signal
import socket
import sys
import unittest
from pathlib import Path

from column_case import CLIENTS, ColumnCaseTest
from front_door import ROOT

sys.path.insert(0, str(ROOT / "tools"))
from clients import find_client  # noqa: E402


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return probe.getsockname()[1]


class Keys(ColumnCaseTest):
    def setUp(self) -> None:
        super().setUp()
        self.keys = self.make_keys("keys")
        self.listen_at("127.0.0.1")

    def make_keys(self, name: str) -> Path:
        code, _, err = self.gimdem("keys", self.folder / name)
        self.assertEqual(code, 0, err)
        return self.folder / name

    def listen_at(self, host: str) -> None:
        self.edit("case.toml", r"^endpoint = .*$", f'endpoint = "tcp://{host}:{free_port()}"')

    def test_every_client_gets_in_with_those_of_the_case(self) -> None:
        shutil.copytree(self.keys, self.case / "keys")
        self.edit("case.toml", r"^timeout = ", 'keys = "keys"\ntimeout = ')
        for name in CLIENTS:
            with self.subTest(name):
                folder = self.run_client(name, "--until", "0.003")
                self.assertEqual(len((folder / "column.csv").read_text().splitlines()), 1 + 3)
                self.assertNotIn("without a key", (folder / "log.jsonl").read_text(), "the launcher is no peer")

    def test_server_at_all_addresses_of_the_machine(self) -> None:
        self.edit("case.toml", r'^endpoint = "tcp://127.0.0.1:', 'endpoint = "tcp://*:')
        self.run_client("column-c", "--until", "0.003", "--keys", self.keys)
        code, _, err = self.gimdem("run", self.case, "--until", "0.003")
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "make keys with ./gimdem keys")

    def test_client_with_another_key_is_turned_away(self) -> None:
        """A stranger's own key, and the server's public one."""
        strangers = self.make_keys("strangers")
        shutil.copy(self.keys / "server.public", strangers / "server.public")
        for name in CLIENTS:
            with self.subTest(name):
                wrapper = self.folder / name
                command = self.command_of(name)
                wrapper.write_text(f'#!/bin/sh\nexec {command} "$1" "$2" "{strangers}"\n')
                wrapper.chmod(0o755)
                code, _, err = self.gimdem("run", self.case, "--client", wrapper, "--keys", self.keys)
                self.assertEqual(code, 1, err)
                self.assert_one_error(err, f"{name} ended with code 1", "turned us away")
                self.assertIn("unknown key", err, "the server tells who came")

    def test_status_of_a_run_with_keys(self) -> None:
        process = self.start("run", self.case, "--client", "column-c", "--until", "100", "--keys", self.keys)
        folder = self.case / "runs" / "0001"
        self.wait_until(lambda: len((folder / "coupling.csv").read_text().splitlines()) > 2
                        if (folder / "coupling.csv").exists() else False, "steps")
        code, out, err = self.gimdem("status", folder)
        self.assertEqual(code, 0, err)
        self.assertRegex(out, r"doing +coupled steps")
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(process)[0], 130)

    def test_no_keys_in_the_folder(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--keys", self.folder / "absent")
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, "absent", "./gimdem keys")

    @staticmethod
    def command_of(name: str) -> str:
        return " ".join(f'"{word}"' for word in find_client(name).command)


if __name__ == "__main__":
    unittest.main()
