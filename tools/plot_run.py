#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plots of a run: time series from bed.csv and snapshots of the particles, into RUN_DIR/plots.

    tools/plot_run.py RUN_DIR
"""
from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection

from console import UserError, run_script
from results import BedSeries, read_json
from vtp import VtkFileError, read_particles, read_series

STYLE = {
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.6, "lines.linewidth": 0.9,
    "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.5, "legend.frameon": False, "savefig.dpi": 200,
    "figure.constrained_layout.use": True, "axes.titlesize": 9, "axes.prop_cycle": plt.cycler(
        color=["#0b5394", "#b45f06", "#38761d", "#741b47", "#666666"]),
}
SNAPSHOTS = 6


@dataclass
class Panel:
    """One plot against time."""

    file: str
    stem: str  # of the columns: the name, or what comes before the plane's name
    label: str
    unit: str
    scale: float = 1.0  # from SI to `unit`


PANELS = (
    Panel("pressure", "pressure_", "gauge pressure", "Pa"),
    Panel("void_fraction", "void_fraction_", "void fraction (plane mean)", "1"),
    Panel("bed_height", "bed_height", "bed height", "mm", 1e3),
    Panel("pressure_drop", "pressure_drop", "pressure drop", "Pa"),
    Panel("kinetic_energy", "kinetic_energy", "kinetic energy", "J"),
)
NOT_A_PLANE = ("pressure_drop", "void_fraction_min", "void_fraction_max", "void_fraction_clips")


def main(arguments: list[str]) -> int:
    return run_script(__doc__, (1,), lambda run: plot_run(Path(run)), arguments)


def plot_run(folder: Path) -> list[Path]:
    """Draw all that the run has data for; returns the files."""
    series = BedSeries(folder / "bed.csv")
    reference = read_json(folder / "reference.json")
    plots = folder / "plots"
    plots.mkdir(exist_ok=True)
    with plt.rc_context(STYLE):
        drawn = [draw_panel(panel, series, reference, plots) for panel in PANELS] if len(series) > 1 else []
        drawn.append(draw_snapshots(folder, plots))
    return [file for file in drawn if file]


def columns_of(panel: Panel, series: BedSeries) -> list[str]:
    if not panel.stem.endswith("_"):
        return [panel.stem] if panel.stem in series else []
    return [name for name in series.beginning_with(panel.stem) if name not in NOT_A_PLANE]


def draw_panel(panel: Panel, series: BedSeries, reference: dict, plots: Path) -> Path | None:
    """One quantity against time, one line per plane."""
    columns = columns_of(panel, series)
    if not columns:
        return None
    figure, axes = plt.subplots(figsize=(6.3, 2.5))
    for name in columns:
        plane = name[len(panel.stem) :] if panel.stem.endswith("_") else ""
        line = axes.plot(series["time"], panel.scale * series[name], label=f"at {plane}" if plane else "this run")[0]
        draw_reference(axes, panel, reference.get(name), line.get_color())
    axes.set_xlabel("time [s]")
    axes.set_ylabel(panel.label if panel.unit == "1" else f"{panel.label} [{panel.unit}]")
    axes.set_xlim(series["time"][0], series["time"][-1])
    if len(axes.get_legend_handles_labels()[1]) > 1 or columns[0] != panel.stem:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1.18), ncol=4, borderaxespad=0)
    return save(figure, plots / f"{panel.file}.png")


def draw_reference(axes: plt.Axes, panel: Panel, value: dict | None, colour: str) -> None:
    """A published mean and its standard deviation, from the case's reference.json."""
    if not value:
        return
    mean, spread = panel.scale * value["mean"], panel.scale * value.get("deviation", 0)
    axes.axhline(mean, color=colour, linestyle="--", linewidth=0.8, label=f"{value['source']}: mean ± deviation")
    axes.axhspan(mean - spread, mean + spread, color=colour, alpha=0.1, linewidth=0)


def save(figure: plt.Figure, file: Path) -> Path:
    figure.savefig(file)
    plt.close(figure)
    return file


@dataclass
class Snapshot:
    """What the front view of one moment needs, the farthest particle first."""

    time: float
    across: np.ndarray
    height: np.ndarray
    radius: np.ndarray
    speed: np.ndarray

    @staticmethod
    def read(time: float, file: Path) -> Snapshot:
        data = read_particles(file)
        order = np.argsort(-data["position"][:, 1], kind="stable")
        position = data["position"][order]
        return Snapshot(time, position[:, 0], position[:, 2], data["radius"][order],
                        np.linalg.norm(data["velocity"][order], axis=1))


def draw_snapshots(folder: Path, plots: Path) -> Path | None:
    """Particles seen from the front, drawn to scale and coloured by speed, at even distances of time."""
    try:
        frames = read_series(folder / "results.pvd", "particles")
        chosen = sorted({round(i) for i in np.linspace(0, len(frames) - 1, min(SNAPSHOTS, len(frames)))})
        shots = [Snapshot.read(*frames[i]) for i in chosen]
    except OSError:
        return None
    except VtkFileError as error:
        raise UserError(f"the snapshots cannot be drawn: {error}") from None
    shots = [shot for shot in shots if len(shot.radius)]
    if not shots:
        return None
    return save(front_views(shots), plots / "snapshots.png")


def front_views(shots: list[Snapshot]) -> plt.Figure:
    left = min((s.across - s.radius).min() for s in shots)
    right = max((s.across + s.radius).max() for s in shots)
    bottom = min(0.0, *((s.height - s.radius).min() for s in shots))
    top = max((s.height + s.radius).max() for s in shots)
    # The fastest hundredth would wash out the colours of all others.
    fastest = max(np.percentile(np.concatenate([s.speed for s in shots]), 99), 1e-6)
    width = 9.0 / len(shots) if len(shots) > 3 else 2.2
    height = min(7.0, 0.85 * width * (top - bottom) / (right - left) + 0.7)
    figure, panels = plt.subplots(1, len(shots), figsize=(width * len(shots) + 0.8, height), sharey=True, squeeze=False)
    for axes, shot in zip(panels[0], shots):
        circles = draw_circles(axes, shot, fastest)
        axes.set(xlim=(1e3 * left, 1e3 * right), ylim=(1e3 * bottom, 1e3 * top), aspect="equal",
                 title=f"{shot.time:.3g} s", xlabel="x [mm]")
        axes.grid(False)
    panels[0][0].set_ylabel("z [mm]")
    figure.colorbar(circles, ax=panels[0].tolist(), label="particle speed [m/s]", extend="max", shrink=0.8, pad=0.01)
    return figure


def draw_circles(axes: plt.Axes, shot: Snapshot, fastest: float) -> EllipseCollection:
    """Lengths in mm, as the axes."""
    diameter = 2e3 * shot.radius
    circles = EllipseCollection(
        diameter, diameter, np.zeros_like(diameter), units="xy", transOffset=axes.transData,
        offsets=1e3 * np.column_stack([shot.across, shot.height]), array=shot.speed, cmap="viridis", linewidths=0.15,
        edgecolors="#00000060",
    )
    circles.set_clim(0, fastest)
    return axes.add_collection(circles)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
