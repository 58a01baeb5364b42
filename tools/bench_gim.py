# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench gim-figures: Figures 3 to 8 of the paper of the Gaussian Integral Method, from this code.

Leaves gim-figures.csv with all curves and gim-figure-3.png ... gim-figure-8.png in BUILD/bench."""
from __future__ import annotations

import argparse
import csv
import io
import subprocess

from bench_mapping import folder_of
from console import UserError, build_dir, say, shown

PRINTED = {4: ("0.24", "0.28", "0.34", "0.44"), 5: ("0.02", "0.03", "0.05", "0.08")}  # in the paper's text


def run(options: argparse.Namespace) -> int:
    program = build_dir() / "bin" / "gim_curves"
    result = subprocess.run([str(program)], stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        raise UserError(f"{program} failed (see above); ./gimdem build")
    rows = list(csv.DictReader(io.StringIO(result.stdout)))
    table = folder_of(options) / "gim-figures.csv"
    table.write_text(result.stdout)
    print_figures(rows)
    import bench_gim_plots  # needs matplotlib

    for file in [table, *bench_gim_plots.draw(rows, table.parent)]:
        say("bench", shown(file))
    return 0


def print_figures(rows: list[dict[str, str]]) -> None:
    """The numbers that the paper's text and trend line tell."""
    for row in rows:
        ratio = row["volume_ratio"]
        if row["figure"] == "6" and row["phi"] == "0.4" and ratio in ("2", "4", "8", "16"):
            number = 4 + int(row["position"])
            text = f"  (paper: {PRINTED[number][('2', '4', '8', '16').index(ratio)]})" if number in PRINTED else "  (paper: 1.0)"
            print(f"figure: gim_figure_{number}_at_{ratio} = {float(row['y']):.4f} [1]{text}")
        if row["figure"] == "8" and row["curve"] in ("best", "eq27") and ratio in ("2", "4", "8", "16", "32"):
            print(f"figure: gim_figure_8_{row['curve']}_at_{ratio} = {float(row['y']):.4f} [1]")
