# SPDX-License-Identifier: BSD-3-Clause
"""The options of ./gimdem run."""
from __future__ import annotations

import argparse

from clients import CLIENTS

ENCODINGS = ("sparse", "dense", "float32", "lz4")


EXAMPLES = """examples:
  ./gimdem run cases/wachem-bed --schedule overlapped      both solvers at work at once
  ./gimdem run cases/wachem-bed --restart latest           go on from the last checkpoint
  ./gimdem run cases/wachem-bed --grace-time 600           a client that is killed is started again
  ./gimdem run cases/column-bed --client column-python     another fluid solver

docs/user-guide.md explains each option. One that stands in case.toml too wins over it."""


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = EXAMPLES
    parser.add_argument("case", metavar="CASE_DIR", help="a folder with a case.toml")
    parser.add_argument("--client", metavar="NAME", help="who solves the fluid (default: as case.toml says): "
                        f"{', '.join(CLIENTS)}, or the path of a program of yours (docs/write-a-client.md)")
    parser.add_argument("--schedule", choices=("serial", "overlapped", "iterated"),
                        help="who waits for whom (case.toml)")
    parser.add_argument("--device", choices=("auto", "cuda", "cpu"), default="auto",
                        help="where the particles are computed")
    parser.add_argument("--precision", choices=("double", "mixed"), help="of the contact laws (case.toml)")
    parser.add_argument("--grid", metavar="X", help="mesh variant of the case (case.toml)")
    parser.add_argument("--until", metavar="T", type=positive, help="simulated time [s] (case.toml)")
    parser.add_argument("--grace-time", metavar="T", type=not_negative,
                        help="how long a client that died may take to come back [s]; it is started again (case.toml)")
    parser.add_argument("--encoding", metavar="WORDS", type=encodings,
                        help=f"how fields travel, e.g. sparse,lz4: {', '.join(ENCODINGS)} (case.toml)")
    parser.add_argument("--keys", metavar="DIR", help="folder made by ./gimdem keys, for both programs (case.toml)")
    parser.add_argument("--threads", metavar="N", type=count, help="threads of the server; 0: all cores (case.toml)")
    parser.add_argument("--ranks", metavar="N", type=count, default=1,
                        help="processes that solve the fluid, with MPI (1)")
    parser.add_argument("--restart", metavar="FILE",
                        help="go on from a checkpoint, or from the latest of the case: --restart latest")
    parser.add_argument("--trace", action="store_true", help="write trace.json, which Perfetto opens")
    parser.add_argument("--trace-steps", metavar="N", type=count, default=1000, help="coupling steps in it (1000)")
    parser.add_argument("--trace-every", metavar="K", type=positive_count, default=1, help="of every K-th step (1)")
    parser.add_argument("--output", metavar="DIR", help="run folder; must be new or empty (CASE_DIR/runs/NNNN)")


def positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return value


def not_negative(text: str) -> float:
    value = float(text)
    if not 0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not 0 or a positive number")
    return value


def encodings(text: str) -> list[str]:
    words = text.split(",")
    unknown = [word for word in words if word not in ENCODINGS]
    if unknown:
        raise argparse.ArgumentTypeError(f"there is no '{unknown[0]}' (there are {', '.join(ENCODINGS)})")
    if "sparse" in words and "dense" in words:
        raise argparse.ArgumentTypeError("sparse and dense exclude each other")
    return words


def count(text: str) -> int:
    if int(text) < 0:
        raise argparse.ArgumentTypeError(f"{text} is negative")
    return int(text)


def positive_count(text: str) -> int:
    if int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not 1 or more")
    return int(text)
