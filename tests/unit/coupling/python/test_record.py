# SPDX-License-Identifier: BSD-3-Clause
"""The Python client's estimate of the server's clock, and its record of a step: times go in, no clock is read."""
from __future__ import annotations

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "coupling" / "python"))
from gimdem_client.record import StepRecord, machine_number  # noqa: E402

ROUNDING = 1e-9  # of times near 1e5 s in doubles, summed a few times [s]


def answer(received: float, sent: float, machine: int = 0) -> SimpleNamespace:
    clock = SimpleNamespace(received=received, sent=sent, machine=machine)
    return SimpleNamespace(clock=clock, HasField=lambda name: name == "clock")


def exchange(record: StepRecord, at: float, offset: float, there: float, busy: float, back: float, machine: int = 0) -> None:
    """Our clock shows `offset` more than the server's; `at` is of the server's clock."""
    record.heard(answer(at + there, at + there + busy, machine), at + offset, at + there + busy + back + offset)


class Offset(unittest.TestCase):
    def test_is_exact_when_both_ways_take_equally_long(self) -> None:
        record = StepRecord()
        self.assertIsNone(record.offset(1.0))
        exchange(record, 1e5, -37.25, 0.25, 3.0, 0.25)
        offset, uncertainty = record.offset(1e5 + 3.5 - 37.25)
        self.assertAlmostEqual(offset, -37.25, delta=ROUNDING)
        self.assertAlmostEqual(uncertainty, 0.25, delta=ROUNDING)  # half of the round trip

    def test_grows_less_sure_by_15_millionths(self) -> None:
        record = StepRecord()
        exchange(record, 1e5, 5, 0.25, 3.0, 0.25)
        self.assertAlmostEqual(record.offset(1e5 + 3.5 + 5 + 1000)[1], 0.25 + 0.015, delta=ROUNDING)
        self.assertAlmostEqual(record.offset(1e5)[1], 0.25, delta=ROUNDING)  # and no surer before

    def test_keeps_the_better_of_two(self) -> None:
        record = StepRecord()
        exchange(record, 1e5, 5, 0.001, 3.0, 0.001)
        exchange(record, 1e5 + 10, 5, 2.0, 3.0, 0.0)  # would be wrong by a second
        self.assertAlmostEqual(record.offset(1e5 + 20)[0], 5, delta=ROUNDING)
        exchange(record, 1e5 + 30, 5, 0.0, 3.0, 0.0)
        self.assertLess(record.offset(1e5 + 40)[1], 1e-3)

    def test_pays_no_heed_to_times_that_cannot_be(self) -> None:
        record = StepRecord()
        record.heard(answer(5, 8), 10, 11)  # the server was busy for longer than the round trip
        record.heard(answer(0, 0), 10, 11)  # the server does not tell
        self.assertIsNone(record.offset(12))

    @unittest.skipIf(machine_number() == 0, "this system tells no boot id")
    def test_on_one_machine_is_none_unless_the_clocks_prove_otherwise(self) -> None:
        same, other = StepRecord(), StepRecord()
        exchange(same, 1e5, 0, 0.001, 0.1, 0.003, machine_number())
        exchange(other, 1e5, 50, 0.001, 0.1, 0.003, machine_number())
        self.assertEqual(same.offset(1e5), (0.0, 0.0))
        self.assertAlmostEqual(other.offset(1e5)[0], 50, delta=0.002)


class Waiting(unittest.TestCase):
    def waited(self, entered: float, left: float, waiting: float, middle: float) -> tuple[float, float]:
        record = StepRecord()
        record.begun(1, entered)
        record.resumed(left, waiting, middle)
        record.ended(left + 1, left + 1)
        times = SimpleNamespace()
        exchange(record, 1e5, 0, 0, 0, 0)
        record.put_into(times)
        return times.wait_from, times.wait_to

    def test_lies_around_the_middle_and_within_the_call(self) -> None:
        self.assertEqual(self.waited(10, 20, 4, 15), (13, 17))
        self.assertEqual(self.waited(10, 20, 4, 19), (16, 20))
        self.assertEqual(self.waited(10, 20, 4, 11), (10, 14))


if __name__ == "__main__":
    unittest.main()
