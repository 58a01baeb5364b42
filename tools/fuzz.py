# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem fuzz: what comes off the wire, thrown at the coupling library by chance and by coverage."""
from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
from pathlib import Path

from build import FAILURE, locked
from console import ROOT, UserError, build_dir, say, shown

TARGETS = ("envelope", "mesh", "state_machine")
SOURCE = ROOT / "tests" / "fuzz"
MOST_BYTES = 1024  # of an input: a dozen messages
MOST_SECONDS = 60  # for one input, on a busy machine
INTERRUPTED = 72  # exit code of libFuzzer after a signal
EXECUTED = re.compile(r"^stat::number_of_executed_units:\s*(\d+)", re.MULTILINE)


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--target", choices=TARGETS, help="one of the targets (all)")
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--runs", metavar="N", type=int, help="executions of each target")
    length.add_argument("--seconds", metavar="S", type=int, default=60, help="time for each target (60)")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of the chance; 0: another one each time")
    parser.add_argument("--fast", action="store_true", help="look for inputs without sanitizers, three times as fast, "
                        "and run what was found under them afterwards")
    parser.add_argument("--keep", action="store_true", help="put what reaches new code into tests/fuzz/corpus")


def run(options: argparse.Namespace) -> int:
    folder = build_dir().parent / "fuzz"
    build(folder)
    programs = folder
    if options.fast:
        programs = folder.with_name("fuzz-fast")
        build(programs, "-DGIMDEM_FUZZ_SANITIZERS=OFF")
    targets = (options.target,) if options.target else TARGETS
    return max([fuzz(folder, programs, target, options) for target in targets])


def build(folder: Path, *settings: str) -> None:
    """By clang, which has libFuzzer, or else by g++, whose targets go by chance alone."""
    if os.environ.get("GIMDEM_NO_BUILD"):
        return
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / "build.log"
    compilers = ["clang", "clang++"] if shutil.which("clang++") else ["gcc", "g++"]
    with locked(folder / ".lock"), log.open("w") as out:
        if not (folder / "build.ninja").exists():
            say("fuzz", f"building the targets with {compilers[1]} in {shown(folder)}")
            call(["cmake", "-S", str(SOURCE), "-B", str(folder), "-G", "Ninja", f"-DCMAKE_C_COMPILER={compilers[0]}",
                  f"-DCMAKE_CXX_COMPILER={compilers[1]}", *settings], log, out)
        call(["ninja", "-C", str(folder), *(f"fuzz_{target}" for target in TARGETS)], log, out)


def call(command: list[str], log: Path, out) -> None:
    if subprocess.call(command, cwd=ROOT, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL) == 0:
        return
    lines = log.read_text(errors="replace").splitlines()
    first = next((line for line in lines if FAILURE.search(line)), "")
    raise UserError(f"the fuzz targets cannot be built ({first.strip()}); the whole log is {shown(log)}")


def fuzz(folder: Path, programs: Path, target: str, options: argparse.Namespace) -> int:
    """One target until its time is up or it finds something; returns the exit code."""
    kept = SOURCE / "corpus" / target
    found = folder / "corpus" / target
    findings = folder / "findings"
    for each in (kept, found, findings):
        each.mkdir(parents=True, exist_ok=True)
    length = f"-runs={options.runs}" if options.runs is not None else f"-max_total_time={options.seconds}"
    at = [f"-max_len={MOST_BYTES}", f"-timeout={MOST_SECONDS}", f"-artifact_prefix={findings}/{target}-"]
    corpus = [str(kept if options.keep else found), str(kept)]
    # Weighing inputs by the entropy of what they reach takes two thirds of the time: 162 executions a second, 406 without.
    program = programs / f"fuzz_{target}"
    is_whole = call_target([program, length, f"-seed={options.seed}", "-entropic=0", *at, *corpus],
                           programs / f"{target}.log", f"fuzz_executions_{target}")
    if is_whole and programs != folder:
        is_whole = call_target([folder / f"fuzz_{target}", "-runs=0", *at, *corpus], folder / f"{target}.log",
                               f"fuzz_executions_{target}_under_sanitizers")
    if not is_whole:
        say("fuzz", f"{target} has found something; its input is in {shown(findings)}")
    return 0 if is_whole else 1


def call_target(command: list, log: Path, figure: str) -> bool:
    """False if the target has found something: the end of its log is shown then."""
    with log.open("w") as out:
        code = subprocess.call([str(word) for word in command] + ["-print_final_stats=1"], stdout=out,
                               stderr=subprocess.STDOUT, env=environment())
    text = log.read_text(errors="replace")
    if executed := EXECUTED.search(text):
        print(f"figure: {figure} = {executed[1]} [1]", flush=True)
    if code == INTERRUPTED:
        raise KeyboardInterrupt
    if code != 0:
        print("\n".join(text.splitlines()[-60:]))
        print(f"the whole log is {shown(log)}")
    return code == 0


def environment() -> dict[str, str]:
    """Short stacks of allocations: they cost half of the time."""
    return {"ASAN_OPTIONS": "malloc_context_size=3:quarantine_size_mb=16", "UBSAN_OPTIONS": "print_stacktrace=1",
            **os.environ}
