# SPDX-License-Identifier: BSD-3-Clause
"""When a client's step did what, and the server's clock beside ours: docs/protocol.md, Clocks."""
from __future__ import annotations

import time
from pathlib import Path
from typing import Any

DRIFT = 15e-6  # by so much per second two clocks part at most, PHI of RFC 5905 [s/s]


def machine_number() -> int:
    """The first 64 bits of the boot id; 0 if the system tells none."""
    try:
        return int(Path("/proc/sys/kernel/random/boot_id").read_text().strip().replace("-", "")[:16], 16)
    except (OSError, ValueError):
        return 0


class StepRecord:
    """All times are of time.monotonic() [s]."""

    def __init__(self) -> None:
        self._best: tuple[float, float, float] | None = None  # offset, uncertainty, when it was taken
        self._same_machine = False
        self._current: dict[str, float] = {}
        self._complete: dict[str, float] = {}

    @staticmethod
    def stamp(hello: Any) -> None:
        hello.clock.sent, hello.clock.machine = time.monotonic(), machine_number()

    def heard(self, message: Any, sent: float, arrival: float) -> None:
        """A Welcome or SolidState, which answers what was sent then."""
        if not message.HasField("clock"):
            return
        clock = message.clock
        if clock.machine and clock.machine == machine_number():
            self._same_machine = True
        uncertainty = 0.5 * ((arrival - sent) - (clock.sent - clock.received))
        kept = self.offset(arrival)
        if uncertainty >= 0 and clock.received > 0 and not (kept and kept[1] <= uncertainty):
            self._best = 0.5 * ((sent - clock.received) + (arrival - clock.sent)), uncertainty, arrival

    def offset(self, now: float) -> tuple[float, float] | None:
        """Our clock minus the server's, and its uncertainty; None before the first exchange."""
        if self._best is None:
            return None
        offset, uncertainty, taken = self._best
        uncertainty += DRIFT * max(0.0, now - taken)
        return (0.0, 0.0) if self._same_machine and abs(offset) <= uncertainty else (offset, uncertainty)

    def begun(self, step: int, entered: float) -> None:
        self._current = {"step": step, "begun": entered, "wait_from": entered, "wait_to": entered}

    def resumed(self, left: float, waiting: float = 0.0, middle: float = 0.0) -> None:
        """begin_step() returns; so long of it was waiting, around that time."""
        self._current["resumed"] = left
        if waiting > 0:
            begin = max(self._current["begun"], min(middle - 0.5 * waiting, left - waiting))
            self._current.update(wait_from=begin, wait_to=begin + waiting)

    def ended(self, entered: float, left: float, waiting: float = 0.0) -> None:
        """end_step() returns, which completes the step."""
        self._current.update(ended=entered, closed=left)
        if waiting > 0:
            self._current.update(wait_from=entered, wait_to=entered + waiting)
        self._complete = self._current

    def put_into(self, times: Any) -> None:
        offset = self.offset(time.monotonic())
        if not self._complete or offset is None:
            return
        for name, value in self._complete.items():
            setattr(times, name, value)
        times.offset, times.uncertainty = offset
