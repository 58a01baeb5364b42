# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench exchange: what it costs that the fields of a step go to the other process and back.

Every way for them to travel, beside ZeroMQ alone with as many bytes, measured by turns in the same minute. Leaves
exchange.csv and exchange.png in BUILD/bench."""
from __future__ import annotations

import argparse
import csv
import io
import subprocess

from bench_mapping import folder_of
from console import UserError, build_dir, say, shown

DEFAULT = "ipc_shared_sparse"  # what ./gimdem run does
CASES = (("grid_a", (33, 3, 181)), ("grid_b", (26, 2, 140)))  # of cases/wachem-bed
OCCUPIED = 0.24  # share of the layers that hold particles: a bed of 0.12 m in a box of 0.5 m

Row = dict[str, str]


def run(options: argparse.Namespace) -> int:
    rows: list[Row] = []
    for case, cells in CASES[:1] if options.quick else CASES:
        say("bench", f"exchange of {case}")
        rows += measure(case, cells, 10 if options.quick else 40)
    print_figures(rows)
    table = folder_of(options) / "exchange.csv"
    with table.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    import bench_exchange_plot  # needs matplotlib

    for file in (table, bench_exchange_plot.draw(rows, table.parent)):
        say("bench", shown(file))
    return 0


def measure(case: str, cells: tuple[int, int, int], rounds: int) -> list[Row]:
    program = build_dir() / "bin" / "exchange_times"
    result = subprocess.run([str(program), "--cells", *map(str, cells), "--occupied", str(OCCUPIED), "--rounds", str(rounds)],
                            stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        raise UserError(f"{program} failed (see above); ./gimdem build")
    return [{"case": case, **row} for row in csv.DictReader(io.StringIO(result.stdout))]


def print_figures(rows: list[Row]) -> None:
    for row in rows:
        name = f"{row['case']}_{row['way']}"
        print(f"figure: exchange_bytes_{name} = {row['bytes']} [B]")
        print(f"figure: exchange_time_{name} = {row['us']} [us]  ({row['us_p10']} to {row['us_p90']})")
        print(f"figure: exchange_floor_{name} = {row['bare_us']} [us]  ({row['bare_us_p10']} to {row['bare_us_p90']})")
        print(f"figure: exchange_vs_floor_{name} = {ratio(row):.3f} [1]")
    default = next(row for row in rows if row["way"] == DEFAULT)
    print(f"figure: exchange_vs_floor = {ratio(default):.3f} [1]")


def ratio(row: Row) -> float:
    return float(row["us"]) / float(row["bare_us"])
