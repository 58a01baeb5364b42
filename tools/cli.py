# SPDX-License-Identifier: BSD-3-Clause
"""The commands of ./gimdem."""
from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import bench_dem
import bench_exchange
import bench_faults
import bench_gim
import bench_mapping
import bench_noise
import bench_overlap
import fuzz
import meshes
import run_case
import run_options
import status
from build import build
from console import ROOT, UserError, build_dir, say, shown
from packages import setup

SKIPPED_LABELS = "slow|gpu|benchmark"  # need minutes, a graphics card, a quiet machine
TEST_JOBS = "2"


def parser() -> argparse.ArgumentParser:
    """Each command's options; `function` carries it out and returns the exit code."""
    top = argparse.ArgumentParser(prog="gimdem", description="client-server CFD-DEM co-simulation")
    commands = top.add_subparsers(dest="command", required=True)

    def add(name: str, function, text: str) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=text, description=text)
        command.set_defaults(function=function)
        return command

    run_options.add_options(add("run", run_case.run, "install what is missing, build, run a case, plot and sum up"))
    meshes.add_options(add("mesh", meshes.run, "make the mesh of a case without running it"))
    status.add_options(add("status", status.run, "how a run stands: speed, balance, time left"))
    add("test", run_tests, f"build everything and run the tests, except {SKIPPED_LABELS}; further options go to ctest")
    bench = add("bench", run_benchmarks, "run the benchmarks")
    bench.add_argument("name", nargs="?",
                       help="dem, mapping, noise, overlap, faults, exchange, gim-figures (the figures of the method's paper), or a part of a program's name")
    bench_dem.add_options(bench)
    bench_mapping.add_options(bench)
    bench_noise.add_options(bench)
    bench_overlap.add_options(bench)
    bench_faults.add_options(bench)
    fuzz.add_options(add("fuzz", fuzz.run, "throw random messages at the coupling library, with sanitizers"))
    keys = add("keys", make_keys, "make keys for a server and a client on different machines")
    keys.add_argument("folder", metavar="DIR", help="a new folder")
    figures = add("figures", show_figures, "print the figures of a run, or of two side by side")
    figures.add_argument("run", metavar="RUN_DIR", type=Path)
    figures.add_argument("compare", metavar="RUN_DIR2", type=Path, nargs="?")
    figures.add_argument("--from", dest="begin", metavar="T", type=float, default=0.4, help="means from [s] (0.4)")
    figures.add_argument("--to", dest="end", metavar="T", type=float, default=1.0, help="means to [s] (1.0)")
    add("plot", draw_plots, "draw the plots of a run again").add_argument("run", metavar="RUN_DIR", type=Path)
    add("build", build_all, "build everything")
    add("clean", clean, "remove what was built; runs are kept")
    return top


def build_all(_options: argparse.Namespace) -> int:
    setup(quiet=True)
    build()
    return 0


def run_tests(options: argparse.Namespace) -> int:
    build_all(options)
    command = ["ctest", "--test-dir", str(build_dir()), "--output-on-failure", "-j", TEST_JOBS]
    if not any(word in options.rest for word in ("-L", "-LE", "-R", "--label-regex", "--tests-regex")):
        command += ["-LE", SKIPPED_LABELS]
    return subprocess.call(command + options.rest, cwd=ROOT)


def run_benchmarks(options: argparse.Namespace) -> int:
    build_all(options)
    if options.name == "dem":
        return bench_dem.run(options, parts_of(options, bench_dem.PARTS))
    if options.name == "mapping":
        return bench_mapping.run(options, parts_of(options, bench_mapping.PARTS))
    if options.name == "noise":
        return bench_noise.run(options)
    if options.name == "exchange":
        return bench_exchange.run(options)
    if options.name == "overlap":
        return bench_overlap.run(options)
    if options.name == "faults":
        return bench_faults.run(options)
    if options.name == "gim-figures":
        return bench_gim.run(options)
    found = {path.name: path for path in sorted((build_dir() / "bin").glob("*benchmark*"))}
    if options.name:
        found = {name: path for name, path in found.items() if options.name in name}
    if not found:
        raise UserError(f"there is no benchmark {options.name or 'yet'}; they are built from tests/benchmarks", 2)
    for name, path in found.items():
        say("bench", name)
        code = subprocess.call([str(path)], cwd=ROOT)
        if code != 0:
            return code
    return 0


def parts_of(options: argparse.Namespace, known: Sequence[str]) -> list[str]:
    """Of a benchmark: those of --only, or all."""
    parts = [name for name in options.only.split(",") if name]
    for name in parts:
        if name not in known:
            raise UserError(f"no part {name} of the benchmark (there are {', '.join(known)}); see --help", 2)
    return parts or list(known)


def make_keys(options: argparse.Namespace) -> int:
    setup(quiet=True)
    build(("gimdem-keys",))
    code = subprocess.call([str(build_dir() / "bin" / "gimdem-keys"), options.folder])
    if code == 0:
        say("keys", f"made in {options.folder}; docs/security.md tells which machine needs which file")
    return code


def show_figures(options: argparse.Namespace) -> int:
    setup(quiet=True)
    import analyse_run  # needs numpy, which setup() sees to

    return analyse_run.show_figures(options)


def draw_plots(options: argparse.Namespace) -> int:
    setup(quiet=True)
    import plot_run  # needs matplotlib

    return plot_run.main([str(options.run)])


def clean(_options: argparse.Namespace) -> int:
    folder = build_dir()
    if folder.exists():
        if not (folder / "CMakeCache.txt").exists() and any(folder.iterdir()):
            raise UserError(f"{shown(folder)} is no build folder (it has no CMakeCache.txt); "
                            "remove it by hand if it is one")
        shutil.rmtree(folder)
        say("clean", f"removed {shown(folder)}")
    return 0


def main(arguments: list[str]) -> int:
    top = parser()
    options, rest = top.parse_known_args(arguments)
    if rest and options.command != "test":
        top.error(f"unknown option {' '.join(rest)}; ./gimdem {options.command} --help lists those that there are")
    options.rest = rest
    try:
        return options.function(options)
    except UserError as error:
        if str(error):
            print(f"gimdem: error: {error}", file=sys.stderr)
        return error.code
    except OSError as error:  # a full disk, a folder that is somebody else's
        print(f"gimdem: error: {error.filename or 'a file'}: {error.strerror} (the launcher needs it); "
              "see to it and try again", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\ngimdem: interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
