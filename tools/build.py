# SPDX-License-Identifier: BSD-3-Clause
"""Build with CMake and Ninja: quiet, and quick where nothing is to be done."""
from __future__ import annotations

import fcntl
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from console import ROOT, UserError, build_dir, say, shown

PROGRESS = re.compile(r"\[(\d+)/(\d+)\] ")
FAILURE = re.compile(r"^FAILED: |: (fatal )?error: |CMake Error|^ninja: error|undefined reference")


def build(targets: Sequence[str] = ()) -> None:
    """Bring `targets` (all, if empty) up to date. GIMDEM_NO_BUILD=1: trust what is there."""
    if os.environ.get("GIMDEM_NO_BUILD"):
        return
    folder = build_dir()
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "build.log"
    with locked(folder / ".lock"):
        if not (folder / "build.ninja").exists():
            configure(folder, log)
        compile_targets(folder, list(targets), log)


def is_built_with_cuda() -> bool:
    """Whether the build folder was configured with the backend for GPUs."""
    cache = build_dir() / "CMakeCache.txt"
    return cache.exists() and "GIMDEM_CUDA:BOOL=ON" in cache.read_text()


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Two builds in one folder take turns."""
    with path.open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say("build", f"waiting for another build in {shown(path.parent)}")
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def configure(folder: Path, log: Path) -> None:
    say("build", f"configuring in {shown(folder)}")
    command = ["cmake", "--preset", "release", "-S", str(ROOT), "-B", str(folder)]
    with log.open("w") as out:
        code = subprocess.call(command, cwd=ROOT, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    if code != 0:
        # A half-written build.ninja would make the next call skip this step.
        (folder / "build.ninja").unlink(missing_ok=True)
        fail("cmake could not configure", log)


def compile_targets(folder: Path, targets: list[str], log: Path) -> None:
    """Run ninja; its output goes to the log, its progress to one line."""
    command = ["ninja", "-C", str(folder), *targets]
    environment = {**os.environ, "NINJA_STATUS": "[%f/%t] "}
    start = time.monotonic()
    last_shown = start
    steps = 0
    with log.open("a") as out, subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True,
        errors="replace", env=environment,
    ) as ninja:
        assert ninja.stdout is not None
        for line in ninja.stdout:
            out.write(line)
            progress = PROGRESS.match(line)
            if progress:
                steps += 1
                last_shown = show_progress(progress, last_shown)
        code = ninja.wait()
    if steps and sys.stderr.isatty():
        print(file=sys.stderr)
    if code != 0:
        fail("the build failed", log)
    if steps > 1:
        say("build", f"done in {time.monotonic() - start:.0f} s (log: {shown(log)})")


def show_progress(progress: re.Match[str], last_shown: float) -> float:
    """Rewrite one line on a terminal; elsewhere a line every 30 s. Returns when it was last shown."""
    now = time.monotonic()
    text = f"build:    {progress[1]} of {progress[2]}"
    if sys.stderr.isatty():
        print(f"\r{text}", end="", file=sys.stderr, flush=True)
        return now
    if now - last_shown < 30:
        return last_shown
    print(text, file=sys.stderr, flush=True)
    return now


def fail(what: str, log: Path) -> None:
    """Raise, after showing the part of the log that tells why."""
    lines = log.read_text(errors="replace").splitlines()
    first = next((i for i, line in enumerate(lines) if FAILURE.search(line)), max(0, len(lines) - 25))
    excerpt = lines[first : first + 25]
    print("\n".join(excerpt), file=sys.stderr)
    raise UserError(f"{what}; the whole log is {shown(log)}")
