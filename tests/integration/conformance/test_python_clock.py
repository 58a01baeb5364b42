# SPDX-License-Identifier: BSD-3-Clause
"""What the Python client tells of times, to a server on this machine and to one whose clock shows something else."""
from __future__ import annotations

import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path
from typing import Any

import numpy as np
import zmq

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "coupling" / "python"), str(ROOT / "cfd-client" / "examples")]
from column import make_mesh  # noqa: E402
from gimdem_client import Client, ClientOptions, FluidFields, FluidProperties, Step, Timings  # noqa: E402
from gimdem_client.record import machine_number  # noqa: E402
from gimdem_client.wire import F64, Envelope  # noqa: E402

CELLS = 3
STEPS = 4
BUSY = 0.03  # of each answer [s]


class RawServer(threading.Thread):
    """The least that a server does; its clock shows `ahead` more than this machine's."""

    def __init__(self, endpoint: str, schedule: int, ahead: float, machine: int) -> None:
        super().__init__()
        self.ahead, self.machine, self.schedule = ahead, machine, schedule
        self.times: list[Any] = []  # StepTimes that the client told
        self.last: Any = None  # LastStep
        self.sums = (0.0, 0.0)  # exchange and waiting as it last told
        self.socket = zmq.Context.instance().socket(zmq.ROUTER)
        self.socket.bind(endpoint)

    def clock(self) -> float:
        return time.monotonic() + self.ahead

    def send(self, peer: bytes, envelope: Any, arrays: int = 0) -> None:
        envelope.protocol_major, envelope.session = 1, 7
        frames = []
        if arrays:
            envelope.arrays.add(name="void_fraction", type=F64, components=1, count=CELLS, dense=True)
            frames = [np.full(CELLS, 0.5).tobytes()]
        self.socket.send_multipart([peer, envelope.SerializeToString(), *frames])

    def answer_step(self, peer: bytes, fluid: Any, arrived: float) -> None:
        if fluid.fluid_state.HasField("previous_times"):
            self.times.append(fluid.fluid_state.previous_times)
        self.sums = (fluid.fluid_state.exchange, fluid.fluid_state.waiting)
        time.sleep(BUSY)
        envelope = Envelope(step=fluid.step)
        envelope.solid_state.busy_time = self.clock() - arrived
        envelope.solid_state.clock.received, envelope.solid_state.clock.sent = arrived, self.clock()
        self.send(peer, envelope, 1)

    def run(self) -> None:
        while True:
            peer, first, *_ = self.socket.recv_multipart()
            arrived = self.clock()
            message = Envelope.FromString(first)
            kind = message.WhichOneof("kind")
            envelope = Envelope()
            if kind == "hello":
                welcome = envelope.welcome
                welcome.server, welcome.schedule, welcome.end_time = "raw server", self.schedule, 1.0
                welcome.clock.received, welcome.clock.sent = arrived, self.clock()
                welcome.clock.machine = self.machine
                self.send(peer, envelope)
            elif kind == "mesh":
                envelope.mesh_accepted.cell_count = CELLS
                self.send(peer, envelope)
                envelope = Envelope()
                envelope.solid_state.busy_time = 0
                self.send(peer, envelope, 1)
            elif kind == "fluid_state":
                self.answer_step(peer, message, arrived)
            elif kind == "goodbye":
                self.last = message.goodbye.last_step
                self.socket.close(0)
                return


class Clocks(unittest.TestCase):
    def check(self, schedule: int, ahead: float, machine: int) -> RawServer:
        with tempfile.TemporaryDirectory(prefix="gimdem-test-") as folder:
            endpoint = f"ipc://{folder}/socket"
            server = RawServer(endpoint, schedule, ahead, machine)
            server.start()
            with Client(ClientOptions(endpoint, "clock test", wants=("void_fraction",))) as client:
                client.connect(FluidProperties(1.2, 1.8e-5))
                client.send_mesh(make_mesh(CELLS, 0.01, 0.01, 0.03))
                for n in range(1, STEPS + 1):
                    client.begin_step(Step(n, 0.001 * (n - 1), 0.001), FluidFields())
                    time.sleep(0.01)
                    client.end_step(Timings(compute=0.01))
                told = client.exchange_times
                client.finish("done")
            server.join()
        times = [*server.times, server.last.times]
        self.assertEqual([at.step for at in times], list(range(1, STEPS + 1)))
        self.assertEqual(server.last.compute, 0.01)
        before = 0.0
        for at in times:
            stations = [before, at.begun, at.resumed, at.ended, at.closed]
            self.assertEqual(stations, sorted(stations))
            call = (at.begun, at.resumed) if schedule == 1 else (at.ended, at.closed)
            # Sums of two times since the machine's start are exact to 1e-10 s or so.
            self.assertGreaterEqual(at.wait_from, call[0] - 1e-9)
            self.assertLessEqual(at.wait_to, call[1] + 1e-9)
            before = at.closed
        self.assertAlmostEqual(sum(at.wait_to - at.wait_from for at in times), told.waiting, delta=1e-8 * STEPS)
        return server

    def test_serial_on_one_machine(self) -> None:
        server = self.check(1, 0.0, machine_number())
        self.assertEqual((server.last.times.offset, server.last.times.uncertainty), (0, 0))
        self.assertGreaterEqual(server.sums[1], BUSY * (STEPS - 1), "it waited for each answer")

    def test_overlapped_between_two_machines(self) -> None:
        server = self.check(2, 1000.0, machine_number() + 1)
        last = server.last.times
        self.assertGreater(last.uncertainty, 0)
        self.assertLess(last.uncertainty, 1.0, "ipc is faster than that, on a busy machine too")
        self.assertLessEqual(abs(last.offset + 1000.0), last.uncertainty + 1e-9)


if __name__ == "__main__":
    unittest.main()
