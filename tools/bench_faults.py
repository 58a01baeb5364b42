# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench faults: starts and stops, faults and a soak of the two ends of a session."""
from __future__ import annotations

import argparse
import subprocess

from console import ROOT, build_dir, say


def add_options(parser: argparse.ArgumentParser) -> None:
    storm = parser.add_argument_group("of bench faults")
    storm.add_argument("--cycles", metavar="N", type=int, default=1000, help="sessions one after the other (1000)")
    storm.add_argument("--faults", metavar="N", type=int, default=200, help="random faults (200)")
    storm.add_argument("--soak", metavar="S", type=int, default=60, help="length of one long session [s] (60)")
    storm.add_argument("--seed", metavar="N", type=int, default=1, help="of the faults (1)")


def run(options: argparse.Namespace) -> int:
    say("bench", f"{options.cycles} cycles, {options.faults} faults, {options.soak} s of soak")
    command = [str(build_dir() / "bin" / "coupling_storm"), "--cycles", str(options.cycles), "--faults",
               str(options.faults), "--soak", str(options.soak), "--seed", str(options.seed)]
    return subprocess.call(command, cwd=ROOT)
