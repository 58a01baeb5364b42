# SPDX-License-Identifier: BSD-3-Clause
"""What the DEM benchmarks leave: lines `figure: ...`, BUILD/bench/dem.csv, features.md and plots."""
from __future__ import annotations

import csv
import statistics
from pathlib import Path

from bench_program import Measured, Setup, median_cost

COLUMNS = ("part", "scene", "program", "device", "threads", "precision", "particles", "steps", "ms_per_step",
           "particle_steps_per_second", "pairs_per_particle", "contacts_per_particle", "list_rebuilds",
           "ms_per_rebuild", "bytes_per_particle", "kinetic_energy")


class Report:
    """Takes measurements as they come; every row is in the file at once, should a later run fail."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.rows: list[dict[str, str]] = []
        self.features: list[tuple[str, str, float, float]] = []  # name, scene, cost with and without [ns]
        with (folder / "dem.csv").open("w", newline="") as file:
            csv.writer(file).writerow(COLUMNS)

    def add(self, part: str, setup: Setup, run: Measured) -> Measured:
        values = (part, setup.scene, run.program, setup.device, setup.threads, setup.precision, run.particles,
                  setup.steps, run.ms_per_step, run.rate, run.pairs, run.contacts, run.rebuilds, run.ms_per_rebuild,
                  run.bytes, run.energy)
        row = dict(zip(COLUMNS, map(text_of, values)))
        self.rows.append(row)
        with (self.folder / "dem.csv").open("a", newline="") as file:
            csv.DictWriter(file, COLUMNS).writerow(row)
        return run

    def figure(self, name: str, value: float, unit: str, remark: str = "") -> None:
        print(f"figure: {name} = {value:.4g} [{unit}] {remark}".rstrip(), flush=True)

    def add_feature(self, name: str, scene: str, having: list[Measured], lacking: list[Measured]) -> None:
        """Runs of a scene with and without a feature, by turns: the ratio of neighbours, whatever the machine does
        between one pair and the next."""
        ratio = statistics.median(one.cost / other.cost for one, other in zip(having, lacking))
        cost = median_cost(lacking)
        self.features.append((name, scene, cost * ratio, cost))
        self.figure(f"dem_cost_of_{name.lower().replace(' ', '_')}", ratio - 1, "1",
                    f"(of {cost:.0f} ns per particle-step, {scene})")

    def finish(self) -> list[Path]:
        """Writes the table and the plots; returns all files."""
        files = [self.folder / "dem.csv"]
        if self.features:
            files.append(self.folder / "features.md")
            files[-1].write_text(feature_table(self.features))
        import bench_plots  # needs matplotlib

        return files + bench_plots.draw(self.rows, self.features, self.folder)


def text_of(value: str | int | float) -> str:
    """Empty for NaN."""
    if not isinstance(value, float):
        return str(value)
    return f"{value:.6g}" if value == value else ""


def feature_table(features: list[tuple[str, str, float, float]]) -> str:
    lines = ["| feature | scene | without [ns] | with [ns] | cost [ns] | cost |", "|---|---|---|---|---|---|"]
    for name, scene, having, lacking in features:
        lines.append(f"| {name} | {scene} | {lacking:.0f} | {having:.0f} | {having - lacking:.0f} | "
                     f"{100 * (having / lacking - 1):.0f} % |")
    return "\n".join(lines) + "\n"
