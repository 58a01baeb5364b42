#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a run: what the server summed up, and time means over the fluidised bed.

    tools/analyse_run.py RUN_DIR [--from T] [--to T] [--compare RUN_DIR2]

Prints a line `figure: name = value [unit]` each; with --compare, both runs side by side.
"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from console import UserError
from results import BedSeries, Figure, read_json, read_summary

START = 0.4  # of a run is left out of means: the bed has to come to its steady motion first
NOT_AVERAGED = ("time", "void_fraction_max", "void_fraction_clips", "momentum_imbalance", "volume_imbalance",
                "continuity_error", "pressure_iterations")  # the worst or the sum counts: the server's figures have it


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("run", metavar="RUN_DIR", type=Path, help="folder of a run")
    parser.add_argument("--from", dest="begin", metavar="T", type=float, 
                        help="means from [s] (0.4 of the time up to --to)")
    parser.add_argument("--to", dest="end", metavar="T", type=float, help="means to [s] (the end)")
    parser.add_argument("--compare", metavar="RUN_DIR2", type=Path, help="a second run, shown beside the first")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser)
    try:
        return show_figures(parser.parse_args(arguments))
    except UserError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.code


def show_figures(options: argparse.Namespace) -> int:
    figures = figures_of(options.run, options.begin, options.end)
    if options.compare is None:
        for figure in figures:
            print(figure)
    else:
        others = figures_of(options.compare, options.begin, options.end)
        print_side_by_side(options.run, figures, options.compare, others)
    return 0


def figures_of(folder: Path, begin: float | None = None, end: float | None = None) -> list[Figure]:
    """All figures of a run; those that the server gives come first and win."""
    series = BedSeries(folder / "bed.csv")
    figures = read_summary(folder)
    known = {figure.name for figure in figures}
    figures += [figure for figure in time_means(series, begin, end) if figure.name not in known]
    return figures + force_balance({figure.name: figure.value for figure in figures})


def time_means(series: BedSeries, begin: float | None = None, end: float | None = None) -> list[Figure]:
    """Mean and standard deviation of each column over [begin, end]; none where the run did not get there."""
    time = series["time"]
    end = time[-1] if end is None and len(time) else end
    begin = START * end if begin is None and end is not None else begin
    if begin is None or end is None:
        return []
    # Times are sums of steps: let rounding not decide about the ends.
    inside = (time >= begin - 1e-9) & (time <= end + 1e-9)
    if inside.sum() < 2:
        return []
    figures = [Figure("mean_from", float(time[inside][0]), "s"), Figure("mean_to", float(time[inside][-1]), "s")]
    for name in series.names():
        values = series[name][inside]
        if name in NOT_AVERAGED or not np.isfinite(values).all():
            continue
        figures.append(Figure(f"mean_{name}", float(values.mean()), series.units[name]))
        figures.append(Figure(f"deviation_{name}", float(values.std()), series.units[name]))
    return figures


def force_balance(values: dict[str, float]) -> list[Figure]:
    """What holds the bed up, per area, beside the mean pressure drop; none where a term is missing.

    Newton's second law of all particles, upwards: rate of momentum = fluid forces - weight + wall forces.
    """
    try:
        area = values["inlet_area"]
        weight = values["bed_weight_per_area"]
        acceleration = values["mean_momentum_rate"] / area
        walls = -values["mean_wall_force"] / area  # that the particles exert on the walls
        gas = values["gas_weight_per_area"]  # the pressure includes its static part
        drop = values["mean_pressure_drop"]
    except KeyError:
        return []
    needed = weight + acceleration + walls + gas
    return [
        Figure("balance_weight", weight, "Pa"), Figure("balance_acceleration", acceleration, "Pa"),
        Figure("balance_walls", walls, "Pa"), Figure("balance_gas", gas, "Pa"), Figure("balance_needed", needed, "Pa"),
        Figure("pressure_drop_to_needed", drop / needed, "1"),
    ]


def print_side_by_side(first: Path, left: list[Figure], second: Path, right: list[Figure]) -> None:
    """A table of both runs and the change from the first to the second."""
    print(f"{'':<40} {schedule_of(first):>14} {schedule_of(second):>14} {'change':>9}")
    others = {figure.name: figure for figure in right}
    for figure in left:
        other = others.get(figure.name)
        if other is None:
            continue
        change = f"{100 * (other.value / figure.value - 1):+.2f} %" if figure.value else ""
        print(f"{f'{figure.name} [{figure.unit}]':<40} {figure.value:>14.6g} {other.value:>14.6g} {change:>9}")


def schedule_of(folder: Path) -> str:
    """What tells two runs of one case apart, or the folder's name."""
    return read_json(folder / "run.json").get("settings", {}).get("schedule", folder.name)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
