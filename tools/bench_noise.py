# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench noise: how rough each mapping method makes the pressure of the coupled wachem bed.

A cell whose void fraction jumps as particles cross its faces makes the pressure jump with it. Measured is the standard
deviation of dp/dt above 50 Hz, of the mean pressure in the plane at 45 mm and of the pressure drop. It judges nothing.
Figures go to stdout, a table and plots to BUILD/bench/noise."""
from __future__ import annotations

import argparse
import csv
import json
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from bench_states import folder
from console import ROOT, UserError, say, shown

CASE = ROOT / "cases" / "wachem-bed"
METHODS = ("pcm", "divided", "gim", "fbsi", "exact")
GRIDS = ("A", "E")
SIGNALS = ("pressure_45mm", "pressure_drop")
COLUMNS = ("grid", "method", "simulated_s", *(f"{name}_noise_Pa_per_s" for name in SIGNALS), "void_fraction_min",
           "void_fraction_clips", "share_mapping", "wall_time_s")


def add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--until", type=float, default=1.0, metavar="T", help="noise, overlap: simulated time of a run [s] (1)")
    command.add_argument("--jobs", type=int, default=1, metavar="N", help="noise: runs at a time (1)")


def run(options: argparse.Namespace) -> int:
    if not options.until > 0:
        raise UserError(f"--until {options.until} is not a positive time", 2)
    if options.jobs < 1:
        raise UserError(f"--jobs {options.jobs} is no number of runs", 2)
    methods = options.method.split(",") if options.method else METHODS
    grids = options.mesh.split(",") if options.mesh else GRIDS
    place = folder() / "noise"
    place.mkdir(exist_ok=True)
    cases = {method: variant(method, place) for method in methods}
    rows = [Row(grid, method, options.until, options.device, cases[method]) for grid in grids for method in methods]
    with ThreadPoolExecutor(options.jobs) as pool:
        for row in pool.map(Row.run, rows):
            row.tell()
            write_table(rows, place / "noise.csv")
    import noise_plots  # needs matplotlib

    for file in [place / "noise.csv", *noise_plots.draw(rows, place)]:
        say("bench", shown(file))
    return 0


@dataclass
class Row:
    """One run: a grid with a method. A finished run is kept and not repeated."""

    grid: str
    method: str
    until: float
    device: str
    case: Path

    @property
    def folder(self) -> Path:
        return self.case.parent / f"{self.grid}-{self.method}-{self.until:g}s"

    def is_finished(self) -> bool:
        try:
            return json.loads((self.folder / "run.json").read_text()).get("outcome") == "finished"
        except (OSError, json.JSONDecodeError):
            return False

    def run(self) -> Row:
        if not self.is_finished():
            shutil.rmtree(self.folder, ignore_errors=True)
            command = [str(ROOT / "gimdem"), "run", str(self.case), "--grid", self.grid, "--until", repr(self.until),
                       "--threads", "1", "--device", self.device, "--output", str(self.folder)]
            log = self.case.parent / f"log.{self.folder.name}"
            with log.open("wb") as file:
                if subprocess.call(command, stdout=file, stderr=subprocess.STDOUT) != 0:
                    raise UserError(f"the run with {self.method} on grid {self.grid} failed; see {shown(log)}")
        return self

    def tell(self) -> None:
        for name, value in self.noise().items():
            print(f"figure: {name}_noise_{self.method.replace('-', '_')}_on_{self.grid} = {value:.4g} [Pa/s]",
                  flush=True)

    def noise(self) -> dict[str, float]:
        import noise_series  # needs numpy

        return noise_series.roughness_of(self.folder, SIGNALS)

    def values(self) -> list[str]:
        if not self.is_finished():
            return []
        from results import read_summary  # needs numpy

        figures = {figure.name: figure.value for figure in read_summary(self.folder)}
        numbers = [self.until, *self.noise().values(), *(figures.get(name, float("nan")) for name in (
            "void_fraction_min", "void_fraction_clips", "share_mapping", "wall_time"))]
        return [self.grid, self.method, *(f"{value:.6g}" for value in numbers)]


def variant(method: str, place: Path) -> Path:
    """The case with another method, a sample at each coupling step and no other output."""
    case = place / f"case-{method}"
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(CASE, case, ignore=shutil.ignore_patterns("runs", "settled", "meshes"))
    for kept in ("settled", "meshes"):
        (CASE / kept).mkdir(exist_ok=True)
        (case / kept).symlink_to(CASE / kept)
    text = (case / "case.toml").read_text()
    for key, value in (("method", f'"{method}"'), ("sample_interval", "1e-4"), ("particle_interval", "0.0")):
        text, count = re.subn(rf"^{key} = \S+", f"{key} = {value}", text, flags=re.MULTILINE)
        if count != 1:
            raise UserError(f"{shown(CASE / 'case.toml')} has {count} lines '{key} = ...' (one is needed)")
    (case / "case.toml").write_text(text)
    return case


def write_table(rows: list[Row], file: Path) -> None:
    with file.open("w", newline="") as out:
        table = csv.writer(out)
        table.writerow(COLUMNS)
        table.writerows(values for row in rows if (values := row.values()))
