# SPDX-License-Identifier: BSD-3-Clause
"""Start child processes that the terminal's Ctrl-C does not reach and that never outlive us."""
from __future__ import annotations

import ctypes
import os
import signal
import subprocess
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import IO, Union

PR_SET_PDEATHSIG = 1  # <linux/prctl.h>
Output = Union[int, IO[bytes], None]


def die_with(parent: int) -> Callable[[], None]:
    """What a new child runs before exec: the kernel kills it when `parent` dies, however that dies."""
    prctl = ctypes.CDLL(None, use_errno=True).prctl

    def arrange() -> None:
        prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # it died before the call above
            os._exit(1)

    return arrange


def spawn(
    command: Sequence[str], *, stdout: Output, stderr: Output, cwd: Path | None = None,
    env: Mapping[str, str] | None = None,
) -> subprocess.Popen[bytes]:
    """Start `command` in a session of its own, without standard input."""
    return subprocess.Popen(
        list(command), stdin=subprocess.DEVNULL, stdout=stdout, stderr=stderr, cwd=cwd, env=env,
        start_new_session=True, preexec_fn=die_with(os.getpid()),
    )


def kill_session(leader: int) -> None:
    """Kill a child that spawn() started and, at once, whatever it has started itself: mpirun, killed alone, would leave
    its ranks. The child must not have been waited for, so that its number still means it."""
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and os.getsid(int(entry.name)) == leader:
                os.kill(int(entry.name), signal.SIGKILL)
        except OSError:  # it has ended meanwhile, or belongs to somebody else
            continue


def run_logged(command: Sequence[str], log: Path, *, cwd: Path | None = None,
               env: Mapping[str, str] | None = None) -> int:
    """Run a helper to its end with all output in `log`; returns its exit code."""
    with log.open("wb") as out:
        child = spawn(command, stdout=out, stderr=subprocess.STDOUT, cwd=cwd, env=env)
        try:
            return child.wait()
        finally:
            if child.poll() is None:
                child.kill()
                child.wait()


def how_it_ended(name: str, code: int) -> str:
    """An exit code of Popen in words."""
    if code >= 0:
        return f"{name} ended with code {code}"
    try:
        meaning = signal.Signals(-code).name
    except ValueError:
        meaning = "unknown"
    return f"{name} was killed by signal {-code} ({meaning})"
