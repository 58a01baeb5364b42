# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench overlap: what the overlapped schedule saves on the wachem bed, and whether it changes the bed.

Serial runs from beds that were packed with other random numbers tell how much runs differ by chance; the overlapped
runs begin from the same beds. Figures go to stdout, all numbers to BUILD/bench/overlap. It judges nothing."""
from __future__ import annotations

import argparse
import csv
import json
import re
import shutil
import subprocess
from pathlib import Path

from bench_states import folder
from console import ROOT, UserError, say, shown

CASE = ROOT / "cases" / "wachem-bed"
SCHEDULES = ("serial", "overlapped")
TIMES = ("overlap_efficiency", "overlap_vs_max", "lag_force", "lag_solid_fraction", "wall_time_per_simulated_second")


def add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--beds", type=int, default=4, metavar="N", help="overlap: beds packed at random (4)")


def run(options: argparse.Namespace) -> int:
    if not options.until > 0:
        raise UserError(f"--until {options.until} is not a positive time", 2)
    if options.beds < 2:
        raise UserError(f"--beds {options.beds} tells no spread (it takes two beds at least)", 2)
    place = folder() / "overlap"
    place.mkdir(exist_ok=True)
    grid = options.mesh or "B"
    runs = {schedule: [finished_run(schedule, seed, grid, options.until, place) for seed in range(1, options.beds + 1)]
            for schedule in SCHEDULES}
    tell(runs, place / "overlap.csv")
    return 0


def finished_run(schedule: str, seed: int, grid: str, until: float, place: Path) -> Path:
    """Folder of a run; one that has finished is kept and not repeated."""
    result = place / f"{schedule}-{grid}-{until:g}s-{seed}"
    try:
        if json.loads((result / "run.json").read_text()).get("outcome") == "finished":
            return result
    except (OSError, json.JSONDecodeError):
        pass
    shutil.rmtree(result, ignore_errors=True)
    command = [str(ROOT / "gimdem"), "run", str(bed(seed, place)), "--grid", grid, "--until", repr(until),
               "--threads", "1", "--schedule", schedule, "--output", str(result)]
    log = place / f"log.{result.name}"
    with log.open("wb") as file:
        if subprocess.call(command, stdout=file, stderr=subprocess.STDOUT) != 0:
            raise UserError(f"the {schedule} run of bed {seed} failed; see {shown(log)}")
    return result


def bed(seed: int, place: Path) -> Path:
    """The case with a bed of its own and no ParaView files."""
    case = place / f"case-{seed}"
    if case.exists():
        return case
    shutil.copytree(CASE, case, ignore=shutil.ignore_patterns("runs", "settled", "meshes"))
    text = (case / "case.toml").read_text()
    for key, value in (("seed", str(seed)), ("particle_interval", "0.0")):
        text, count = re.subn(rf"^{key} = \S+", f"{key} = {value}", text, flags=re.MULTILINE)
        if count != 1:
            raise UserError(f"{shown(CASE / 'case.toml')} has {count} lines '{key} = ...' (one is needed)")
    (case / "case.toml").write_text(text)
    return case


def tell(runs: dict[str, list[Path]], file: Path) -> None:
    from overlap_series import departure, measures_of  # needs numpy
    from results import read_summary

    rows = {name: [measures_of(result) for result in results] for name, results in runs.items()}
    for name in rows["serial"][0]:
        serial, overlapped = ([row[name] for row in rows[schedule]] for schedule in SCHEDULES)
        print(f"figure: overlapped_to_serial_{name} = {sum(overlapped) / sum(serial):.4g} [1]")
        print(f"figure: overlapped_departure_{name} = {departure(overlapped, serial):.3g} [standard errors]")
    for schedule, results in runs.items():
        summaries = [{figure.name: figure.value for figure in read_summary(result)} for result in results]
        for name in TIMES:
            values = [summary[name] for summary in summaries]
            print(f"figure: {schedule}_{name} = {sum(values) / len(values):.4g}", flush=True)
        for row, summary in zip(rows[schedule], summaries):
            row.update({name: summary[name] for name in TIMES})
    with file.open("w", newline="") as out:
        table = csv.writer(out)
        table.writerow(("schedule", "bed", *rows["serial"][0]))
        for schedule in SCHEDULES:
            table.writerows((schedule, k, *row.values()) for k, row in enumerate(rows[schedule], 1))
    say("bench", shown(file))
