# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench mapping: every mapping method on every mesh, its errors against the exact overlap, time and memory.

It measures and judges nothing. Figures go to stdout, CSV, tables and plots to BUILD/bench."""
from __future__ import annotations

import argparse
import csv
import io
import subprocess
from pathlib import Path

from bench_mapping_meshes import Mesh, choose
from bench_mapping_report import STAGES, MappingReport, Row
from bench_states import folder
from console import UserError, build_dir, say, shown

PARTS = ("errors", "speed", "stages")
COUNTS = (17_563, 1_000_000)  # particles that are timed
MOST_BYTES = 6e9  # a method that needs more for its weights is left out


def add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--mesh", metavar="NAMES", default="",
                         help="mapping: some meshes, or folders with an OpenFOAM mesh of a box (all, see docs/mapping.md); "
                              "noise: grids of the wachem bed (A,E)")
    command.add_argument("--method", metavar="NAMES", default="", help="mapping, noise: some methods (all; pcm,divided,gim,fbsi,exact)")
    command.add_argument("--particles", metavar="NUMBERS", default="",
                         help=f"mapping: how many are timed ({','.join(map(str, COUNTS))})")
    command.add_argument("--to", metavar="FOLDER", type=Path,
                         help="mapping, gim-figures: where CSV, tables and plots go (BUILD/bench)")


def run(options: argparse.Namespace, parts: list[str]) -> int:
    methods = [name for name in options.method.split(",") if name]
    known = method_names()
    for name in methods:
        if name not in known:
            raise UserError(f"no method {name} (there are {', '.join(known)}); see --help", 2)
    counts = counts_of(options)
    report = MappingReport(folder_of(options), known)
    for mesh in choose(options.mesh, options.quick):
        some = ["--methods", ",".join(methods or known)]
        if "errors" in parts:
            say("bench", f"errors on {mesh.label}")
            quick = ["--places", "1000", "--lines", "30", "--sweeps", "20"] if options.quick else []
            report.add_errors(mesh, rows_of("mapping_errors", [*mesh.arguments(), *some, *quick]))
        for count in counts if "speed" in parts else ():
            rounds = 1 if options.quick or count > COUNTS[0] else options.repeats
            measure_speed(mesh, count, methods or known, rounds, report)
    for file in report.finish():
        say("bench", shown(file))
    if "stages" in parts and not methods and not options.mesh:
        return subprocess.call([str(build_dir() / "bin" / "benchmark_mapping")])
    return 0


def folder_of(options: argparse.Namespace) -> Path:
    if not options.to:
        return folder()
    options.to.mkdir(parents=True, exist_ok=True)
    return options.to


def counts_of(options: argparse.Namespace) -> list[int]:
    words = [word for word in options.particles.split(",") if word]
    for word in words:
        if not word.isdecimal() or int(word) < 1:
            raise UserError(f"--particles {word} is no number of particles (whole, positive); see --help", 2)
    return [int(word) for word in words] or list(COUNTS[:1] if options.quick else COUNTS)


def measure_speed(mesh: Mesh, count: int, methods: list[str], rounds: int, report: MappingReport) -> None:
    """All methods by turns, the least times of all rounds.

    Methods whose memory for fewer particles tells that it would not do are left out."""
    fit = [name for name in methods if report.bytes_per_particle(mesh, name, count) * count < MOST_BYTES]
    for name in methods:
        if name not in fit:
            say("bench", f"{name} is left out: {count} particles on {mesh.label} take it more than {MOST_BYTES:.0e} bytes")
    if fit:
        say("bench", f"time of {count} particles on {mesh.label}")
        arguments = [*mesh.arguments(), "--methods", ",".join(fit), "--count", str(count), "--seconds", "0.1"]
        report.add_speed(mesh, least([rows_of("mapping_speed", arguments) for _ in range(rounds)]))


def least(rounds: list[list[Row]]) -> list[Row]:
    """Each stage at its quickest: what else the machine does only adds."""
    rows = []
    for of_method in zip(*rounds):
        times = {name: min(float(row[name]) for row in of_method) for name in STAGES}
        step = sum(times.values()) * float(of_method[0]["particles"]) * 1e-6
        texts = {name: f"{time:.5g}" for name, time in times.items()}
        rows.append({**of_method[0], **texts, "step_ms": f"{step:.5g}"})
    return rows


def rows_of(program: str, arguments: list[str]) -> list[Row]:
    """What a program prints as CSV; what it says of methods that it leaves out goes to stderr."""
    command = [str(build_dir() / "bin" / program), *arguments]
    result = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        raise UserError(f"{program} failed (see above); its command was {' '.join(command)}")
    return list(csv.DictReader(io.StringIO(result.stdout)))


def method_names() -> list[str]:
    """Of mapping_method_names: those that are in the program."""
    command = [str(build_dir() / "bin" / "mapping_errors"), "--list"]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    except (OSError, subprocess.CalledProcessError) as error:
        raise UserError(f"{command[0]} does not run ({error}); ./gimdem build") from None
