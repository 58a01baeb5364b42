# SPDX-License-Identifier: BSD-3-Clause
"""run.json: what was run, by which versions, on which machine, when, and how it ended."""
from __future__ import annotations

import json
import os
import platform
import shlex
import subprocess
import sys
from collections.abc import Sequence
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from console import ROOT, server_binary


def now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="seconds")


def output_of(command: Sequence[str]) -> str:
    """First line of what a command prints, empty if it cannot tell."""
    try:
        done = subprocess.run(list(command), capture_output=True, text=True, timeout=10, cwd=ROOT,
                              stdin=subprocess.DEVNULL)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip().split("\n")[0] if done.returncode == 0 else ""


def processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.machine()


def machine() -> dict[str, Any]:
    return {
        "system": platform.platform(),
        "processor": processor(),
        "cores": len(os.sched_getaffinity(0)),
        "memory_bytes": os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"),
    }


def package_version(name: str) -> str:
    return output_of(["dpkg-query", "-W", "-f", "${Version}", name])


def versions() -> dict[str, str]:
    revision = output_of(["git", "rev-parse", "HEAD"])
    changed = output_of(["git", "status", "--porcelain", "--untracked-files=no"])
    return {
        "gimdem": output_of([str(server_binary()), "--version"]),
        "git_revision": revision + ("+changes" if revision and changed else ""),
        "openfoam": os.environ.get("WM_PROJECT_VERSION") or package_version("openfoam"),
        "python": platform.python_version(),
    }


class RunRecord:
    """Written when the run starts and again when it has ended."""

    def __init__(self, folder: Path, settings: dict[str, Any]) -> None:
        self._file = folder / "run.json"
        self._content: dict[str, Any] = {
            "command": shlex.join(["./gimdem", *sys.argv[1:]]),
            "settings": settings,
            "versions": versions(),
            "machine": machine(),
            "start": now(),
            "end": None,
            "outcome": "running",
        }
        self._write()

    def finish(self, outcome: str, wall_time: float, client_starts: int) -> None:
        self._content.update({"end": now(), "outcome": outcome, "wall_time_s": round(wall_time, 3),
                              "client_starts": client_starts})
        self._write()

    def _write(self) -> None:
        temporary = self._file.with_suffix(".tmp")
        temporary.write_text(json.dumps(self._content, indent=2) + "\n")
        temporary.replace(self._file)
