# SPDX-License-Identifier: BSD-3-Clause
"""Plots of ./gimdem bench noise."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

from plot_run import STYLE
from results import BedSeries

if TYPE_CHECKING:
    from bench_noise import Row


def draw(rows: list[Row], folder: Path) -> list[Path]:
    with plt.rc_context(STYLE):
        return [draw_bars(rows, folder / "noise.png"), draw_signals(rows, folder / "pressure.png")]


def draw_bars(rows: list[Row], file: Path) -> Path:
    grids = sorted({row.grid for row in rows})
    methods = list(dict.fromkeys(row.method for row in rows))
    figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
    width = 0.8 / len(grids)
    for k, grid in enumerate(grids):
        noise = {row.method: row.noise()["pressure_45mm"] for row in rows if row.grid == grid}
        places = np.arange(len(methods)) + (k - (len(grids) - 1) / 2) * width
        axes.bar(places, [noise.get(method, np.nan) for method in methods], 0.9 * width, label=f"grid {grid}")
    axes.set_xticks(range(len(methods)), methods)
    axes.set_yscale("log")
    axes.set_ylabel("deviation of d$p$/d$t$ above 50 Hz [Pa/s]")
    axes.set_title("Pressure noise at 45 mm by mapping method", fontsize=10)
    axes.legend()
    figure.savefig(file)
    plt.close(figure)
    return file


def draw_signals(rows: list[Row], file: Path) -> Path:
    """A fiftieth of a second of each signal, one above the other."""
    grids = sorted({row.grid for row in rows})
    figure, panels = plt.subplots(1, len(grids), figsize=(4.5 * len(grids), 4.5), squeeze=False, layout="constrained")
    for panel, grid in zip(panels[0], grids):
        some = [row for row in rows if row.grid == grid]
        for k, row in enumerate(some):
            series = BedSeries(row.folder / "bed.csv")
            last = series["time"] >= series["time"][-1] - 0.02
            pressure = series["pressure_45mm"][last]
            (line,) = panel.plot(1e3 * series["time"][last], pressure - pressure.mean() - 150 * k, lw=0.8)
            panel.annotate(row.method, (1.01, -150 * k), xycoords=("axes fraction", "data"), color=line.get_color(),
                           va="center")
        panel.set_title(f"grid {grid}", fontsize=10)
        panel.set_xlabel("time [ms]")
        panel.set_ylabel("pressure at 45 mm [Pa], each 150 lower")
    figure.savefig(file)
    plt.close(figure)
    return file
