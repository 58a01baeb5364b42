# SPDX-License-Identifier: BSD-3-Clause
"""gimdem_client by itself and against mock servers: calls out of order, bad numbers, last words, generated code.

    test_client_python.py BUILD_FOLDER
"""
from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "coupling" / "python"))
from gimdem_client import (Client, ClientOptions, CouplingError, Fault, FluidFields, FluidProperties, Mesh,  # noqa: E402
                           Monitor, Patch, Step)

AIR = FluidProperties(1.2, 1.8e-5)
CUBE = Mesh(
    points=np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]),
    face_offsets=4 * np.arange(7), face_points=np.array([0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0,
                                                         4, 7]),
    owner=np.zeros(6), neighbour=[], cell_count=1, patches=[Patch("walls", "wall", 0, 6)])


def fluid() -> FluidFields:
    return FluidFields(np.zeros((1, 3)), np.zeros((1, 9)), np.zeros((1, 3)), np.zeros((1, 3)), np.zeros(1))


class ClientInPython(unittest.TestCase):
    build: Path

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="gimdem-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.endpoint = f"ipc://{self.folder}/socket"

    def start_server(self, *options: str) -> subprocess.Popen[str]:
        server = subprocess.Popen([str(self.build / "bin" / "gimdem-mock-server"), "--endpoint", self.endpoint, *options],
                                  stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.wait)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.kill)
        return server

    def client(self, **options) -> Client:
        client = Client(ClientOptions(self.endpoint, "test", **options))
        self.addCleanup(client.abort, "the test is over")
        return client

    def fails(self, fault: Fault, part: str, call, *arguments) -> None:
        with self.assertRaises(CouplingError) as caught:
            call(*arguments)
        self.assertEqual(caught.exception.fault, fault, caught.exception)
        self.assertIn(part, str(caught.exception))

    def test_options_are_checked(self) -> None:
        for endpoint in ("tcp://10.0.0.1:5570", "udp://127.0.0.1:1", "ipc://", f"ipc:///{'x' * 200}", "tcp://127.0.0.1"):
            self.fails(Fault.ENDPOINT, endpoint, Client, ClientOptions(endpoint, "test"))
        self.fails(Fault.USER, "name", Client, ClientOptions(self.endpoint, ""))
        self.fails(Fault.USER, "timeout", Client, ClientOptions(self.endpoint, "test", timeout=float("nan")))
        self.fails(Fault.USER, "color", Client, ClientOptions(self.endpoint, "test", wants=["color"]))
        self.fails(Fault.USER, "swift", Client, ClientOptions(self.endpoint, "test", schedule="swift"))

    def test_calls_out_of_order(self) -> None:
        client = self.client()
        self.fails(Fault.USER, "send_mesh() is illegal in state created", client.send_mesh, CUBE)
        self.fails(Fault.USER, "illegal", client.begin_step, Step(1, 0, 1), fluid())
        self.fails(Fault.USER, "illegal", client.end_step)
        client.finish("nothing begun")
        self.fails(Fault.USER, "in state finished", client.connect, AIR)

    def test_no_server(self) -> None:
        self.fails(Fault.ENDPOINT, "no server has answered", self.client(connect_time=0.3).connect, AIR)

    def test_mistakes_end_nothing(self) -> None:
        self.start_server()
        client = self.client()
        self.assertEqual(client.connect(AIR).schedule, "serial")
        broken = Mesh(**{**CUBE.__dict__, "patches": [Patch("walls", "brick", 0, 6)]})
        self.fails(Fault.USER, "brick", client.send_mesh, broken)
        client.send_mesh(CUBE)
        self.assertEqual(client.solid.void_fraction.tolist(), [0.6])
        self.assertIsNone(client.solid.momentum_source)
        bad = fluid()
        bad.velocity[0, 1] = np.nan
        self.fails(Fault.USER, '"velocity"', client.begin_step, Step(1, 0, 1e-3), bad)
        bad = fluid()
        bad.pressure = None
        self.fails(Fault.USER, '"pressure" has 0 numbers', client.begin_step, Step(1, 0, 1e-3), bad)
        self.fails(Fault.USER, "monitor", client.begin_step, Step(1, 0, 1e-3), fluid(), [Monitor("x", float("inf"))])
        solid = client.begin_step(Step(1, 0, 1e-3), fluid(), [Monitor("x", 1.0, "m")])
        self.assertEqual(solid.drag_momentum.tolist(), [[0, 0, 2.5]])  # KnownSolid after step 1: 2 (1 + 1/4)
        client.end_step()
        saved = client.save_checkpoint(1e-3)
        self.assertEqual((saved.step, saved.time, saved.name), (1, 1e-3, "none.h5"))
        self.assertNotEqual(saved.session, 0)
        client.finish("done")
        self.assertGreater(client.exchange_times.bytes, 0)

    def test_iterated_session(self) -> None:
        server = self.start_server("--schedule", "iterated", "--until", "0.002")
        client = self.client(iterates=True)
        welcome = client.connect(AIR)
        self.assertEqual(welcome.schedule, "iterated")
        self.assertGreater(welcome.iteration.max_passes, 1)
        client.send_mesh(CUBE)
        for number in (1, 2):
            client.begin_step(Step(number, 1e-3 * (number - 1), 1e-3), fluid())
            solid = client.iterate_step(fluid(), 0.1)
            self.assertEqual(solid.drag_momentum.tolist(), [[0, 0, 2 * (1 + number / 4)]])
            client.end_step(residual=1e-5)
        self.fails(Fault.USER, "illegal", client.iterate_step, fluid())
        client.finish("done")
        told, _ = server.communicate(timeout=60)
        self.assertIn("ok\tpasses\t2 steps were repeated 2 times", told)

    def test_with_keys(self) -> None:
        """Encrypted; a server without keys, and one that has others, do not answer."""
        keys = [str(self.folder / name) for name in ("keys", "others")]
        for folder in keys:
            subprocess.run([str(self.build / "bin" / "gimdem-keys"), folder], check=True, stdout=subprocess.DEVNULL)
        self.start_server("--keys", keys[0])
        client = self.client(keys=keys[0])
        client.connect(AIR)
        client.send_mesh(CUBE)
        client.finish("done")
        self.fails(Fault.ENDPOINT, "tcp://10.0.0.1:5570", Client, ClientOptions("tcp://10.0.0.1:5570", "test"))
        Client(ClientOptions("tcp://10.0.0.1:5570", "test", keys=keys[0]))
        self.fails(Fault.USER, "cannot be read", Client, ClientOptions(self.endpoint, "test", keys="nowhere"))
        (self.folder / "keys" / "client.secret").chmod(0o644)
        self.fails(Fault.USER, "mode 644", Client, ClientOptions(self.endpoint, "test", keys=keys[0]))

    def test_keys_that_do_not_fit(self) -> None:
        folder = str(self.folder / "keys")
        subprocess.run([str(self.build / "bin" / "gimdem-keys"), folder], check=True, stdout=subprocess.DEVNULL)
        self.start_server()
        self.fails(Fault.ENDPOINT, "the keys do not fit", self.client(keys=folder, connect_time=1).connect, AIR)

    def test_unknown_key_is_told_at_once(self) -> None:
        keys, others = (self.folder / name for name in ("keys", "others"))
        for folder in (keys, others):
            subprocess.run([str(self.build / "bin" / "gimdem-keys"), str(folder)], check=True, stdout=subprocess.DEVNULL)
        shutil.copy(keys / "server.public", others / "server.public")
        self.start_server("--keys", str(keys))
        client = self.client(keys=str(others), connect_time=600)
        self.fails(Fault.ENDPOINT, "has turned us away (it does not know our key)", client.connect, AIR)

    def test_last_words_reach_the_server(self) -> None:
        for end in ("client.abort('the gas ran out')", "raise ValueError('the gas ran out')",
                    "client.__exit__(None, ValueError('the gas ran out'), None)"):
            server = self.start_server()
            program = "\n".join([
                "import sys", f"sys.path[:0] = {[str(ROOT / 'coupling/python'), str(Path(__file__).parent)]!r}",
                "from test_client_python import *",
                f"client = Client(ClientOptions({self.endpoint!r}, 'test'))", "client.connect(AIR)",
                "client.send_mesh(CUBE)", end])
            subprocess.run([sys.executable, "-c", program], stderr=subprocess.DEVNULL, timeout=60)
            told, _ = server.communicate(timeout=60)
            expected = "the client's program has ended" if end.startswith("raise") else "the gas ran out"
            self.assertIn(expected, told, end)

    def test_generated_code_is_made_once_by_programs_that_start_together(self) -> None:
        environment = {**os.environ, "GIMDEM_PYTHON_PROTO": str(self.folder / "generated"),
                       "PYTHONPATH": str(ROOT / "coupling" / "python")}
        both = [subprocess.Popen([sys.executable, "-c", "import gimdem_client"], env=environment) for _ in range(2)]
        self.assertEqual([program.wait(60) for program in both], [0, 0])
        made = self.folder / "generated" / "gimdem" / "v1" / "session_pb2.py"
        before = made.stat().st_mtime_ns
        subprocess.run([sys.executable, "-c", "import gimdem_client"], env=environment, check=True)
        self.assertEqual(made.stat().st_mtime_ns, before)


if __name__ == "__main__":
    ClientInPython.build = Path(sys.argv.pop(1))
    unittest.main()
