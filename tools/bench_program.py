# SPDX-License-Identifier: BSD-3-Clause
"""Runs of benchmark_dem: what was asked of it and what it measured."""
from __future__ import annotations

import functools
import re
import statistics
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from console import UserError, build_dir

FIGURE = re.compile(r"^figure: (\w+) = (\S+) \[", re.MULTILINE)
PRECISIONS = ("double", "mixed")


@dataclass(frozen=True)
class Setup:
    """One way to run a scene."""

    scene: str  # what it is called in the CSV
    arguments: tuple[str, ...]  # of benchmark_dem
    steps: int
    warm_up: int
    threads: int = 1
    precision: str = "double"
    device: str = "cpu"


@dataclass(frozen=True)
class Measured:
    """One run. What a program does not tell is NaN."""

    program: str
    particles: int
    ms_per_step: float
    rebuilds: float = float("nan")
    pairs: float = float("nan")  # listed per particle
    contacts: float = float("nan")  # touching per particle
    bytes: float = float("nan")  # per particle
    energy: float = float("nan")  # kinetic, at the end [J]
    ms_per_rebuild: float = float("nan")

    @property
    def rate(self) -> float:
        """[particle-steps/s]"""
        return 1e3 * self.particles / self.ms_per_step

    @property
    def cost(self) -> float:
        """Time per particle-step [ns]"""
        return 1e9 / self.rate


def median_cost(runs: Sequence[Measured]) -> float:
    return statistics.median(run.cost for run in runs)


def median_rate(runs: Sequence[Measured]) -> float:
    return statistics.median(run.rate for run in runs)


def measure(setup: Setup) -> Measured:
    command = [benchmark(), *setup.arguments, "--steps", str(setup.steps), "--warm-up", str(setup.warm_up),
               "--threads", str(setup.threads), "--device", setup.device]
    if knows_precision():
        command += ["--precision", setup.precision]
    found = {name: float(value) for name, value in FIGURE.findall(output(command))}
    absent = float("nan")
    return Measured("gimdem", int(found["dem_particles"]), found["dem_ms_per_step"], found["dem_list_rebuilds"],
                    found["dem_pairs_per_particle"], found["dem_contacts_per_particle"], found["bytes_per_particle"],
                    found["dem_kinetic_energy"], found.get("dem_ms_per_rebuild", absent))


@functools.cache
def knows_precision() -> bool:
    return "--precision" in output([benchmark(), "--help"])


def precisions() -> tuple[str, ...]:
    """Those that this build can compute in."""
    return PRECISIONS if knows_precision() else PRECISIONS[:1]


def benchmark() -> str:
    return str(build_dir() / "bin" / "benchmark_dem")


def output(command: Sequence[str], folder: Path | None = None) -> str:
    """What a program prints; `folder`: where it runs."""
    result = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    if result.returncode != 0:
        last = (result.stdout + result.stderr).strip().splitlines()[-1:]
        raise UserError(f"{command[0]} failed ({' '.join(last)}); its command was {' '.join(command)}")
    return result.stdout
