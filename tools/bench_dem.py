# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench dem: speed of a DEM step, as a ratio to other programs on the same state in the same run."""
from __future__ import annotations

import argparse
import re
import shutil
import statistics
import subprocess
from pathlib import Path

from console import ROOT, UserError, build_dir, say

PEERS = {"liggghts": ("liggghts", "liggghts"), "lammps": ("lmp", "lammps")}  # program, apt package
WARM_UP, STEPS = 300, 700
SETTLING_STEPS = 27000
SKIN = 1e-4  # [m], the peers' best on this bed; ours is the same length
SKIN_IN_RADII = SKIN / 0.7725e-3


def add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--against", metavar="NAMES", default="",
                         help="dem: other programs to run beside it, of liggghts,lammps; installed with apt if absent")
    command.add_argument("--repeats", type=int, default=3, help="dem: rounds; medians are printed (3)")


def run(options: argparse.Namespace) -> int:
    peers = [name for name in options.against.split(",") if name]
    for name in peers:
        if name not in PEERS:
            raise UserError(f"no program {name} to compare with (there are {', '.join(PEERS)}); see --help", 2)
        install(name)
    state = settled_state()
    rates: dict[str, list[float]] = {}
    for turn in range(options.repeats):
        say("bench", f"round {turn + 1} of {options.repeats}")
        rates.setdefault("gimdem", []).append(own_rate(state, threads=1))
        rates.setdefault("gimdem, 2 threads", []).append(own_rate(state, threads=2))
        for name in peers:
            rates.setdefault(name, []).append(peer_rate(name, state))
    medians = {name: statistics.median(values) for name, values in rates.items()}
    for name, rate in medians.items():
        spread = f"{min(rates[name]):.4g} to {max(rates[name]):.4g}"
        print(f"figure: dem_rate[{name}] = {rate:.4g} [particle-steps/s] ({spread})")
    print(f"figure: dem_two_threads = {medians['gimdem, 2 threads'] / medians['gimdem']:.3g} [1]")
    for name in peers:
        print(f"figure: dem_vs_{name}_double = {medians['gimdem'] / medians[name]:.3g} [1]")
    return 0


def install(name: str) -> None:
    program, package = PEERS[name]
    if shutil.which(program):
        return
    say("bench", f"installing {package}")
    if subprocess.call(["apt-get", "install", "-y", "-qq", package], stdout=subprocess.DEVNULL) != 0:
        raise UserError(f"{program} is absent and cannot be installed here; apt-get install {package}")


def settled_state() -> Path:
    """17,563 beads at rest, made once by the engine itself from a lattice (a minute or two)."""
    state = build_dir() / "bench" / "bed.settled.data"
    if not state.exists():
        say("bench", f"settling the bed, {SETTLING_STEPS} steps")
        state.parent.mkdir(parents=True, exist_ok=True)
        part = state.with_suffix(".part")
        output([benchmark(), "--threads", "2", "--warm-up", str(SETTLING_STEPS), "--steps", "1", "--write", str(part)])
        part.rename(state)
    return state


def own_rate(state: Path, threads: int) -> float:
    text = output([benchmark(), "--data", str(state), "--threads", str(threads), "--warm-up", str(WARM_UP), "--steps",
                   str(STEPS), "--skin", f"{SKIN_IN_RADII:.6g}"])
    return float(re.search(r"dem_particle_steps_per_second = (\S+)", text).group(1))


def peer_rate(name: str, state: Path) -> float:
    text = output([PEERS[name][0], "-in", str(ROOT / "tests" / "benchmarks" / "peers" / f"bed.{name}"), "-log", "none",
                   "-var", "data", str(state), "-var", "skin", str(SKIN), "-var", "warm", str(WARM_UP), "-var", "steps",
                   str(STEPS)])
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", text)
    seconds, steps, particles = next(loop for loop in reversed(loops) if int(loop[1]) == STEPS)
    return int(steps) * int(particles) / float(seconds)


def benchmark() -> str:
    return str(build_dir() / "bin" / "benchmark_dem")


def output(command: list[str]) -> str:
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        last = (result.stdout + result.stderr).strip().splitlines()[-1:]
        raise UserError(f"{' '.join(command[:1])} failed ({' '.join(last)})")
    return result.stdout
