# SPDX-License-Identifier: BSD-3-Clause
"""States that the DEM benchmarks start from: made by the engine itself, once, and kept in BUILD/bench."""
from __future__ import annotations

from pathlib import Path

from bench_program import benchmark, output
from console import build_dir, say

RADIUS = 0.7725e-3  # [m]
BED_BOX = ("0.09", "0.008", "0.5")
GAS_BOX = ("0.04836",) * 3  # solid fraction 0.3
GAS_SCENE = ("--box", *GAS_BOX, "--gravity", "0")
MANY_SIZES_STEP = "8e-6"  # [s]: a fifth of the Rayleigh time of the smallest
# 5000 beads on a floor, periodic to the sides: of one diameter, and of diameters from 1 to 10, uniform by number.
ONE_SIZE_SCENE = ("--box", "0.021", "0.021", "0.075", "--sides", "floor")
MANY_SIZES_SCENE = ("--box", "0.014", "0.014", "0.048", "--sides", "floor", "--dt", MANY_SIZES_STEP)
SETTLING = ("--start", "random", "--count", "5000", "--restitution", "0.3")


def folder() -> Path:
    made = build_dir() / "bench"
    made.mkdir(parents=True, exist_ok=True)
    return made


def settled_bed() -> Path:
    """17,563 beads at rest in the box of cases/wachem-bed."""
    return made("bed.settled.data", "settling the bed, a minute or two",
                "--box", *BED_BOX, "--warm-up", "27000")


def relaxed_bed(options: tuple[str, ...]) -> Path:
    """The same bed at rest with other options of benchmark_dem."""
    name = "-".join(word.strip("-") for word in options)
    return made(f"bed-{name}.settled.data", f"letting the bed come to rest with {' '.join(options)}", "--box",
                *BED_BOX, "--data", str(settled_bed()), *options, "--warm-up", "10000")


def gas() -> Path:
    """17,563 beads that fly about, 0.1 m/s per axis."""
    return made("gas.data", "making the gas", *GAS_SCENE, "--sides", "periodic", "--spacing", "1.86e-3", "--jitter",
                "1.5e-4", "--speed", "0.1", "--warm-up", "0", "--dt", "1e-12")


def one_size() -> Path:
    return made("one-size.settled.data", "settling 5000 beads of one size", *SETTLING, *ONE_SIZE_SCENE, "--warm-up",
                "20000")


def many_sizes() -> Path:
    return made("many-sizes.settled.data", "settling 5000 beads of diameters from 1 to 10", *SETTLING,
                *MANY_SIZES_SCENE, "--size-ratio", "10", "--warm-up", "40000")


def made(name: str, what: str, *arguments: str) -> Path:
    state = folder() / name
    if not state.exists():
        say("bench", what)
        part = state.with_suffix(".part")
        output([benchmark(), "--threads", "2", "--steps", "1", *arguments, "--write", str(part)])
        part.rename(state)
    return state
