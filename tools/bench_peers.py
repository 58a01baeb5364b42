# SPDX-License-Identifier: BSD-3-Clause
"""Other programs on the same state in the same run: LIGGGHTS and LAMMPS with their own best settings.

Their skins were chosen by trial (tests/benchmarks/results.md); one process each, as one thread of ours."""
from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import bench_states
from bench_program import Measured, Setup, measure, median_rate, output, precisions
from bench_report import Report
from console import ROOT, UserError, say

PEERS = {"liggghts": ("liggghts", "liggghts"), "lammps": ("lmp", "lammps")}  # program, apt package
LOOP = re.compile(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms")


@dataclass(frozen=True)
class Contest:
    """One state, and how each program goes on from it."""

    name: str  # of tests/benchmarks/peers/NAME.PEER
    state: Path
    arguments: tuple[str, ...]  # of benchmark_dem
    skin: float  # of our list [m]
    peers_skin: float  # [m]
    warm_up: int
    steps: int

    def setup(self, precision: str, threads: int = 1) -> Setup:
        arguments = ("--data", str(self.state), "--skin", f"{self.skin / bench_states.RADIUS:.6g}", *self.arguments)
        return Setup(self.name, arguments, self.steps, self.warm_up, threads, precision)


def contests(quick: bool) -> list[Contest]:
    return [
        Contest("bed", bench_states.settled_bed(), (), 1e-4, 1e-4, 300, 300 if quick else 700),
        Contest("gas", bench_states.gas(), (*bench_states.GAS_SCENE, "--sides", "periodic"), 3e-4, 3e-4, 0,
                2000 if quick else 5000),
    ]


def check(names: Sequence[str]) -> None:
    """Installs what is absent."""
    for name in names:
        if name not in PEERS:
            raise UserError(f"no program {name} to compare with (there are {', '.join(PEERS)}); see --help", 2)
        program, package = PEERS[name]
        if shutil.which(program):
            continue
        say("bench", f"installing {package}")
        if subprocess.call(["apt-get", "install", "-y", "-qq", package], stdout=subprocess.DEVNULL) != 0:
            raise UserError(f"{program} is absent and cannot be installed here; apt-get install {package}")


def run(names: Sequence[str], rounds: int, quick: bool, report: Report) -> None:
    for contest in contests(quick):
        runs: dict[str, list[Measured]] = {}
        for turn in range(rounds):
            say("bench", f"{contest.name} against others, round {turn + 1} of {rounds}")
            for precision in precisions():
                for threads in (1, 2) if contest.name == "bed" else (1,):
                    setup = contest.setup(precision, threads)
                    name = precision if threads == 1 else f"{precision}, {threads} threads"
                    runs.setdefault(name, []).append(report.add("peers", setup, measure(setup)))
            for name in names:
                runs.setdefault(name, []).append(report.add("peers", contest.setup("double"), peer(name, contest)))
        print_figures(contest, names, runs, report)


def print_figures(contest: Contest, names: Sequence[str], runs: dict[str, list[Measured]], report: Report) -> None:
    for name, measured in runs.items():
        label = name if name in names else f"gimdem {name}"
        rates = [run.rate for run in measured]
        report.figure(f"dem_{contest.name}_rate[{label}]", median_rate(measured), "particle-steps/s",
                      f"({min(rates):.4g} to {max(rates):.4g})")
        if contest.name == "gas":
            report.figure(f"gas_kinetic_energy_at_end[{label}]", measured[-1].energy, "J")
    for precision in precisions():
        end = "" if precision == "double" else f"_{precision}"
        if contest.name == "bed":
            two = median_rate(runs[f"{precision}, 2 threads"])
            report.figure("dem_two_threads" + end, two / median_rate(runs[precision]), "1")
        for name in names:
            stem = f"dem_vs_{name}_gas{end}" if contest.name == "gas" else f"dem_vs_{name}_{precision}"
            report.figure(stem, median_rate(runs[precision]) / median_rate(runs[name]), "1")


def peer(name: str, contest: Contest) -> Measured:
    text = output([PEERS[name][0], "-in", str(ROOT / "tests" / "benchmarks" / "peers" / f"{contest.name}.{name}"),
                   "-log", "none", "-var", "data", str(contest.state), "-var", "skin", str(contest.peers_skin),
                   "-var", "warm", str(contest.warm_up), "-var", "steps", str(contest.steps)],
                  bench_states.folder())  # they may leave files behind
    loops = [loop for loop in LOOP.finditer(text) if int(loop[2]) == contest.steps]
    if not loops:
        raise UserError(f"{PEERS[name][0]} tells no loop time (another version?); run it by hand with {contest.name}")
    energies = re.findall(rf"^ *{contest.warm_up + contest.steps} +\d+ +(\S+)", text, re.MULTILINE)
    particles = int(loops[-1][3])
    return Measured(name, particles, 1e3 * float(loops[-1][1]) / contest.steps,
                    energy=float(energies[-1]) if energies else float("nan"))
