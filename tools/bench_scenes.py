# SPDX-License-Identifier: BSD-3-Clause
"""Benchmarks of our own: cost against the number of particles and threads, of each feature, and of unequal sizes."""
from __future__ import annotations

import statistics
from dataclasses import dataclass, replace
from itertools import product

import bench_states
from bench_program import Measured, Setup, measure, median_cost, median_rate, precisions
from bench_report import Report
from console import say

SKIN = ("--skin", "0.13")  # best for beds at rest
MANY_SIZES_SKIN = ("--skin", "0.8")  # the smallest fall about between the largest
FLOOR = ("--sides", "floor")
TILES = ((1, 1), (1, 3), (2, 3), (3, 4), (5, 6), (6, 10), (10, 12), (15, 15))  # of 17,563 particles each
LARGEST_TILES = {"cpu": 5, "cuda": 8}
PARTICLE_STEPS = 10_000_000  # timed, of each number of particles


@dataclass(frozen=True)
class Feature:
    """A scene with something, and without it."""

    name: str
    state: str  # bed | gas
    having: tuple[str, ...]
    lacking: tuple[str, ...] = ()
    at_rest_with: tuple[str, ...] = ()  # where the bed would move otherwise


# Without friction a bed hardly comes to rest: a long skin keeps the building of lists out of the comparison.
NO_FRICTION = ("--friction", "0", "--restitution", "0.3")
FRICTION = ("--friction", "0.3", "--restitution", "0.3")
FEATURES = (
    Feature("sliding friction", "bed", FRICTION, NO_FRICTION, NO_FRICTION),
    Feature("rolling friction CDT", "bed", ("--rolling", "cdt")),
    Feature("rolling friction EPSD", "bed", ("--rolling", "epsd")),
    Feature("cohesion SJKR", "bed", ("--cohesion", "sjkr")),
    Feature("two materials", "bed", ("--materials", "2")),
    Feature("two sizes", "bed", ("--size-step", "0.001")),
    Feature("drag", "bed", ("--drag",)),
    Feature("walls", "gas", ("--sides", "closed"), ("--sides", "none")),
    Feature("periodic borders", "gas", ("--sides", "periodic"), ("--sides", "none")),
)


def growth(device: str, rounds: int, quick: bool, report: Report) -> None:
    """Particle-steps per second against the number of particles, threads and precision.

    Beds on a floor, periodic to the sides: copies side by side are at rest as the one is, so that all build lists as
    often."""
    state = ("--data", str(bench_states.relaxed_bed(FLOOR)), *FLOOR, *SKIN)
    tiles = TILES[: LARGEST_TILES[device] - (1 if quick else 0)]
    ways = list(product((1, 2) if device == "cpu" else (1,), precisions()))
    runs: dict[tuple[int, int, str], list[Measured]] = {}
    for turn, (nx, ny) in product(range(rounds), tiles):
        particles = 17_563 * nx * ny
        say("bench", f"{particles} particles, round {turn + 1} of {rounds}")
        for threads, precision in ways:
            steps = max(40, PARTICLE_STEPS // particles // (4 if quick else 1))
            setup = Setup("bed tiled", (*state, "--tiles", str(nx), str(ny)), steps, 100, threads,
                          precision, device)
            runs.setdefault((particles, threads, precision), []).append(report.add("growth", setup, measure(setup)))
    for precision in precisions():
        end = "" if precision == "double" else f"_{precision}"
        few, many = 17_563, 17_563 * tiles[-1][0] * tiles[-1][1]
        report.figure(f"dem_rate_of_{many}_particles{end}", median_rate(runs[many, 1, precision]), "particle-steps/s")
        half_million = 17_563 * 30 if (5, 6) in tiles else many
        name = "dem_cost_growth_20k_to_" + ("500k" if (5, 6) in tiles else f"{many // 1000}k")
        report.figure(name + end,
                      median_cost(runs[half_million, 1, precision]) / median_cost(runs[few, 1, precision]), "1")


def features(device: str, rounds: int, quick: bool, report: Report) -> None:
    """What each feature costs: with and without it by turns."""
    for feature in FEATURES:
        if feature.name == "drag" and device == "cuda":
            say("bench", "drag is left out: without mapping it runs on the processor alone")
            continue
        setup = Setup("", start_of(feature), 150 if quick else 400, 50, device=device)
        say("bench", f"cost of {feature.name}")
        having = replace(setup, scene=f"{feature.state} with {feature.name}",
                         arguments=setup.arguments + feature.having)
        lacking = replace(setup, scene=f"{feature.state} without {feature.name}",
                          arguments=setup.arguments + feature.lacking)
        runs: tuple[list[Measured], list[Measured]] = ([], [])
        for _ in range(rounds):
            for side, one in zip(runs, (having, lacking)):
                side.append(report.add("features", one, measure(one)))
        report.add_feature(feature.name, feature.state, *runs)


def start_of(feature: Feature) -> tuple[str, ...]:
    if feature.state == "gas":
        return ("--data", str(bench_states.gas()), *bench_states.GAS_SCENE)
    law = feature.at_rest_with
    if law:
        return ("--data", str(bench_states.relaxed_bed(law)), "--skin", "0.5")
    return ("--data", str(bench_states.settled_bed()), *SKIN)


def sizes(device: str, rounds: int, report: Report) -> None:
    """Diameters from 1 to 10 against one diameter: beds at rest, and the building of their lists."""
    of_one = ("--data", str(bench_states.one_size()), *bench_states.ONE_SIZE_SCENE, *SKIN)
    of_many = ("--data", str(bench_states.many_sizes()), *bench_states.MANY_SIZES_SCENE, *MANY_SIZES_SKIN)
    one = Setup("bed of one size", of_one, 1000, 200, device=device)
    many = Setup("bed of diameters 1 to 10", of_many, 1000, 200, device=device)
    lists = ("--rebuilds", "40") if device == "cpu" else ()
    runs: tuple[list[Measured], list[Measured]] = ([], [])
    say("bench", "diameters from 1 to 10")
    for _ in range(rounds):
        for side, setup in zip(runs, (one, many)):
            setup = replace(setup, arguments=setup.arguments + lists)
            side.append(report.add("sizes", setup, measure(setup)))

    def ratio(value) -> float:
        return statistics.median(map(value, runs[1])) / statistics.median(map(value, runs[0]))

    report.figure("dem_ten_to_one_step_per_particle", ratio(lambda run: run.cost), "1")
    report.figure("dem_ten_to_one_step_per_contact", ratio(lambda run: run.cost / run.contacts), "1")
    if lists:
        report.figure("dem_ten_to_one_list_per_particle", ratio(lambda run: run.ms_per_rebuild / run.particles), "1")
        report.figure("dem_ten_to_one_list_per_pair",
                      ratio(lambda run: run.ms_per_rebuild / run.particles / run.pairs), "1")
