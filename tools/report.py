# SPDX-License-Identifier: BSD-3-Clause
"""The end of a run: plots, figures, and where everything is."""
from __future__ import annotations

from pathlib import Path

from console import UserError, say, shown
from results import Figure


def print_results(folder: Path, wall_time: float) -> None:
    """Draw and sum up what the run left. A result that is missing is told, and the rest is shown."""
    has_samples = (folder / "bed.csv").exists()
    plots = drawn_plots(folder) if has_samples else []
    figures = figures_of_run(folder) if has_samples else []
    print(f"\nsummary of {shown(folder)} ({duration(wall_time)})")
    for figure in figures:
        print(figure)
    if not has_samples:
        print("no figures: the run ended before its first sample")
    print("results")
    paths = {
        "ParaView": folder / "results.pvd", "series": folder / "bed.csv", "summary": folder / "summary.json",
        "record": folder / "run.json", "logs": folder / "log.server",
    }
    for what, path in paths.items():
        if path.exists():
            print(f"  {what:<9} {shown(path)}")
    if plots:
        print(f"  {'plots':<9} {shown(folder / 'plots')}: {', '.join(file.name for file in plots)}", flush=True)


def drawn_plots(folder: Path) -> list[Path]:
    try:
        from plot_run import plot_run  # takes a second to load

        return plot_run(folder)
    except (UserError, ImportError) as error:
        say("plots", f"none: {error}")
        return []


def figures_of_run(folder: Path) -> list[Figure]:
    try:
        from analyse_run import figures_of

        return figures_of(folder)
    except (UserError, ImportError) as error:
        say("figures", f"none: {error}")
        return []


def duration(seconds: float) -> str:
    if seconds < 60:
        return f"{seconds:.1f} s"
    return f"{int(seconds // 60)} min {seconds % 60:.0f} s"
