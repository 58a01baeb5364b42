# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench dem: speed of a DEM step, against other programs, numbers of particles, threads, features, sizes.

It measures and judges nothing. Figures go to stdout, a table and plots to BUILD/bench."""
from __future__ import annotations

import argparse
import subprocess

import bench_peers
import bench_scenes
from bench_program import PRECISIONS, benchmark, precisions
from bench_report import Report
from bench_states import folder
from console import say, shown

PARTS = ("peers", "growth", "features", "sizes")


def add_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--against", metavar="NAMES", default="",
                         help="dem: other programs to run beside it, of liggghts,lammps; installed with apt if absent")
    command.add_argument("--repeats", type=int, default=3, help="dem: rounds; medians are printed (3)")
    command.add_argument("--only", metavar="PARTS", default="",
                         help=f"dem: some of {','.join(PARTS)} (all, about ten minutes); mapping: errors,speed,stages")
    command.add_argument("--quick", action="store_true",
                         help="dem: fewer steps and particles, two rounds; mapping: fewer meshes and places")
    command.add_argument("--device", choices=("cpu", "cuda"), default="cpu",
                         help="dem: where our particles are; cuda: up to 4 million, without peers (cpu)")


def run(options: argparse.Namespace, parts: list[str]) -> int:
    peers = [name for name in options.against.split(",") if name]
    bench_peers.check(peers)
    if options.device == "cuda":
        reason = why_no_gpu()
        if reason:
            say("bench", f"skipped: {reason}")
            return 0
    for precision in PRECISIONS:
        if precision not in precisions():
            say("bench", f"precision {precision} is left out: this build has none")
    report = Report(folder())
    rounds = min(options.repeats, 2) if options.quick else options.repeats
    if "peers" in parts and options.device == "cpu":
        bench_peers.run(peers, rounds, options.quick, report)
    if "growth" in parts:
        bench_scenes.growth(options.device, rounds, options.quick, report)
    if "features" in parts:
        bench_scenes.features(options.device, rounds, options.quick, report)
    if "sizes" in parts:
        bench_scenes.sizes(options.device, rounds, report)
    for file in report.finish():
        say("bench", shown(file))
    return 0


def why_no_gpu() -> str:
    """What keeps the benchmark from a GPU; empty where nothing does."""
    tried = subprocess.run([benchmark(), "--device", "cuda", "--count", "1000", "--steps", "1", "--warm-up", "0"],
                           capture_output=True, text=True)
    return "" if tried.returncode == 0 else (tried.stderr.strip().splitlines() or ["no GPU"])[-1]
