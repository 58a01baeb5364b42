# SPDX-License-Identifier: BSD-3-Clause
"""A client that died in the middle of a run: whether it is started again, and from where."""
from __future__ import annotations

import signal
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Union

from restart import State, newest_whole

MOST_FROM_ONE = 2  # starts from one checkpoint: a client that dies there once more dies of what it computes
MOST = 20  # starts in one run
# Somebody has killed it, memory ran out, a machine or a library failed. Not SIGFPE, which numbers cause, and not SIGTERM and
# SIGINT, which mean that it should end.
DEATHS = (signal.SIGKILL, signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGILL, signal.SIGQUIT, signal.SIGHUP,
          signal.SIGPIPE, signal.SIGSYS)


def died(code: int) -> bool:
    """Of an exit code of Popen: by such a signal, itself or below a shell or mpirun."""
    return (-code if code < 0 else code - 128) in [int(number) for number in DEATHS]


@dataclass
class Comeback:
    """How one run's client comes back."""

    folder: Path  # of the run
    grace_time: float  # of the server [s]
    start: Callable[[State], subprocess.Popen[bytes]]
    error_in_log: Callable[[], str]  # the client's last words
    starts: list[str] = field(default_factory=list)  # from which checkpoints so far

    def again(self, code: int, hung: bool) -> Union[tuple[subprocess.Popen[bytes], str], str]:
        """The client that goes on and one line about it; or why there is none."""
        if not (hung or died(code)):
            return "this signal says that it should end, or that its numbers are wrong" if code < 0 else "it ended by itself"
        if not hung and self.error_in_log():
            return "its log tells an error, which would come again"
        state = newest_whole(self.folder)
        if state is None:
            return "this run has no checkpoint yet"
        name = state.checkpoint.name
        if self.starts.count(name) >= MOST_FROM_ONE:
            return f"it has died {MOST_FROM_ONE + 1} times behind {name}"
        if len(self.starts) >= MOST:
            return f"it was started again {MOST} times in this run"
        self.starts.append(name)
        return self.start(state), f"started again from {name}, {self.starts.count(name)} of {MOST_FROM_ONE} times from there"
