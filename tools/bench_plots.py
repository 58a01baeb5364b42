# SPDX-License-Identifier: BSD-3-Clause
"""Plots of the DEM benchmarks."""
from __future__ import annotations

import statistics
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

from plot_run import STYLE

CROPPED = {**STYLE, "savefig.bbox": "tight"}  # for legends below the figure
Rows = list[dict[str, str]]


def draw(rows: Rows, features: list[tuple[str, str, float, float]], folder: Path) -> list[Path]:
    """Draws all that there is data for; returns the files."""
    with plt.rc_context(STYLE):
        drawn = [draw_growth(rows, folder), draw_features(features, folder), draw_peers(rows, folder)]
    return [file for file in drawn if file]


def draw_growth(rows: Rows, folder: Path) -> Path | None:
    lines: dict[tuple[str, str, str], dict[int, list[float]]] = defaultdict(lambda: defaultdict(list))
    for row in rows:
        if row["part"] == "growth":
            line = lines[row["device"], row["threads"], row["precision"]]
            line[int(row["particles"])].append(float(row["particle_steps_per_second"]))
    if not lines:
        return None
    figure, axes = plt.subplots(figsize=(5, 3.2))
    for (device, threads, precision), line in lines.items():
        where = "GPU" if device == "cuda" else f"{threads} thread{'s' if threads != '1' else ''}"
        counts = sorted(line)
        axes.plot(counts, [statistics.median(line[n]) / 1e6 for n in counts], "o-", ms=3, label=f"{where}, {precision}")
    axes.set(xscale="log", xlabel="particles", ylabel="million particle-steps per second", ylim=(0, None),
             title="bed at rest, periodic to the sides")
    axes.legend()
    return saved(figure, folder / "growth.png")


def draw_features(features: list[tuple[str, str, float, float]], folder: Path) -> Path | None:
    if not features:
        return None
    figure, axes = plt.subplots(figsize=(5, 0.5 + 0.3 * len(features)))
    for place, (name, scene, having, lacking) in enumerate(reversed(features)):
        axes.barh(place, having - lacking, color="#0b5394" if scene == "bed" else "#b45f06", height=0.6)
        axes.annotate(f" {100 * (having / lacking - 1):.0f} %", (max(having - lacking, 0), place), va="center")
    axes.set_yticks(range(len(features)), [f"{name} ({scene})" for name, scene, *_ in reversed(features)])
    axes.set(xlabel="cost [ns per particle-step]")
    axes.margins(x=0.15)
    return saved(figure, folder / "features.png")


def draw_peers(rows: Rows, folder: Path) -> Path | None:
    rates: dict[str, dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    for row in rows:
        if row["part"] == "peers":
            threads = "" if row["threads"] == "1" else f", {row['threads']} threads"
            name = f"gimdem {row['precision']}{threads}" if row["program"] == "gimdem" else row["program"]
            rates[row["scene"]][name].append(float(row["particle_steps_per_second"]) / 1e6)
    if not rates:
        return None
    figure, panels = plt.subplots(1, len(rates), figsize=(2.6 * len(rates), 2.8), squeeze=False)
    for axes, (scene, of_programs) in zip(panels[0], rates.items()):
        medians = [statistics.median(values) for values in of_programs.values()]
        axes.bar(range(len(medians)), medians, width=0.6)
        axes.set_xticks(range(len(medians)), of_programs, rotation=20, ha="right")
        axes.set(title=scene, ylabel="million particle-steps per second")
    return saved(figure, folder / "peers.png")


def legend_below(figure: plt.Figure, handles: list, columns: int) -> None:
    """One legend for all panels, in as many lines as it takes, of about the same length."""
    lines = -(-len(handles) // columns)
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=-(-len(handles) // lines),
                  columnspacing=1.2, handletextpad=0.4)


def saved(figure: plt.Figure, path: Path) -> Path:
    figure.savefig(path)
    plt.close(figure)
    return path
