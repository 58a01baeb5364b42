# SPDX-License-Identifier: BSD-3-Clause
"""Cut a coupled run at random moments, go on from its last checkpoint, and compare the end with an uninterrupted run.

Usage: restart_kills.py [--moments N] [--seed S] [--kind K]
Prints `figure: restarts_bitwise_equal = N [1]`; the exit code is 0 if all of the N ends are equal to the bit.

At each moment the server, the client or ./gimdem itself (both, then) is killed by SIGKILL; the run that goes on may be
killed as well. Then the last checkpoint of the particles and the last time folder of the fluid must be, byte by byte,
those of the run that was not interrupted.
"""
from __future__ import annotations

import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from front_door import GIMDEM, ROOT

WACHEM = ROOT / "cases" / "wachem-bed"
UNTIL = 0.01  # [s], a hundred coupling steps
WRITE_INTERVAL = 0.001  # [s]
RECORD = Path("uniform") / "gimdemCheckpoint"  # differs in the session's number


@dataclass(frozen=True)
class Kind:
    """Of a run."""

    schedule: str
    adaptive: bool = False  # time steps by the Courant number
    text: bool = False  # fields as text
    ranks: int = 1

    def __str__(self) -> str:
        return (f"{self.schedule}{', adaptive steps' if self.adaptive else ''}{', fields as text' if self.text else ''}"
                f"{f', {self.ranks} ranks' if self.ranks > 1 else ''}")

    def options(self) -> list[str]:
        return ["--ranks", str(self.ranks)]


KINDS = (Kind("serial"), Kind("overlapped"), Kind("serial", adaptive=True),
         Kind("overlapped", adaptive=True, text=True), Kind("serial", ranks=2))


def substitute(file: Path, pattern: str, text: str) -> None:
    content, count = re.subn(pattern, text, file.read_text(), flags=re.MULTILINE)
    assert count == 1, f"{pattern} in {file}"
    file.write_text(content)


def make_case(folder: Path, kind: Kind) -> Path:
    """300 beads that fall into a coarse bed in which gas rises."""
    case = folder / "case"
    shutil.copytree(WACHEM, case, ignore=shutil.ignore_patterns("runs", "settled", "meshes"))
    for pattern, text in (
        (r"^count = .*$", "count = 300"), (r"^duration = .*$", "duration = 0.0"),
        (r"^timeout = .*$", "timeout = 10.0"), (r"^threads = .*$", "threads = 1"),
        (r"^particle_interval = .*$", "particle_interval = 0.0"), (r"^schedule = .*$", f'schedule = "{kind.schedule}"'),
        (r"^until = .*$", f"until = {UNTIL}"),
    ):
        substitute(case / "case.toml", pattern, text)
    for name, cells in (("nx", 9), ("ny", 1), ("nz", 25)):
        substitute(case / "system" / "blockMeshDict.B", rf"^{name} \d+;$", f"{name} {cells};")
    control = case / "system" / "controlDict"
    substitute(control, r"^writeInterval .*$", f"writeInterval {WRITE_INTERVAL};")
    if kind.adaptive:
        substitute(control, r"^adjustTimeStep .*$", "adjustTimeStep yes;")
        substitute(control, r"^maxDeltaT .*$", "maxDeltaT 1.3e-4;")
    if kind.text:
        substitute(control, r"^writeFormat .*$", "writeFormat ascii;")
    return case


def start(case: Path, *options: str) -> subprocess.Popen[bytes]:
    environment = {**os.environ, "GIMDEM_NO_BUILD": "1", "GIMDEM_NO_SETUP": "1", "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.Popen(
        [str(GIMDEM), "run", str(case), *options], env=environment, stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True,
    )


def newest_run(case: Path) -> Path:
    return sorted((case / "runs").iterdir())[-1]


def end_of(run: Path) -> dict[str, bytes]:
    """The last checkpoint and the last time folder of a run."""
    checkpoint = sorted((run / "checkpoints").iterdir())[-1]
    fluid = max((record.parents[1] for record in run.glob(f"*/{RECORD}")), key=lambda folder: float(folder.name))
    files = {path for path in fluid.rglob("*") if path.is_file()} - {fluid / RECORD}
    return {checkpoint.name: checkpoint.read_bytes(),
            **{str(path.relative_to(run)): path.read_bytes() for path in files}}


def differences(one: dict[str, bytes], other: dict[str, bytes]) -> list[str]:
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))


def processes_of(case: Path) -> dict[str, int]:
    """The living server and client of a case."""
    found = {}
    for entry in Path("/proc").iterdir():
        try:
            command = (entry / "cmdline").read_bytes() if entry.name.isdigit() else b""
        except OSError:
            continue
        words = command.split(b"\0")
        if str(case).encode() in command and words[0].endswith((b"/gimdem-server", b"/gimdemFoam")):
            found[Path(words[0].decode()).name] = int(entry.name)
    return found


def kill(process: subprocess.Popen[bytes], case: Path, victim: str) -> None:
    """One that is not alive yet, or any more, cannot be killed: then ./gimdem, whose children die with it."""
    pid = processes_of(case).get(victim, process.pid)
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def steps_of(run: Path) -> int:
    """So many steps a run has done; -1: it has not begun."""
    try:
        return len((run / "coupling.csv").read_bytes().splitlines()) - 1
    except OSError:
        return -1


def cut(case: Path, options: list[str], steps: int, victim: str, choose: random.Random) -> str:
    """Run, and kill at a random moment behind so many steps. Returns what was killed, or that nothing was."""
    runs_before = len(list((case / "runs").glob("*")))
    process = start(case, *options)
    while process.poll() is None and (len(list((case / "runs").glob("*"))) <= runs_before
                                      or steps_of(newest_run(case)) < steps):
        time.sleep(0.002)
    time.sleep(choose.uniform(0, 0.05))
    if process.poll() is not None:
        return "nothing"
    kill(process, case, victim)
    process.wait()
    while processes_of(case):
        time.sleep(0.01)
    return f"{victim} behind step {steps}"


def finish(case: Path, kind: Kind) -> None:
    """From the last checkpoint, or from the start where there is none."""
    process = start(case, *kind.options(), "--restart", "latest")
    _, err = process.communicate()
    if b"left a checkpoint" in err:
        process = start(case, *kind.options())
        _, err = process.communicate()
    if process.returncode != 0 and b"nothing is left to do" not in err:
        raise RuntimeError(err.decode())


def one_moment(folder: Path, kind: Kind, whole: dict[str, bytes], choose: random.Random) -> list[str]:
    case = make_case(folder, kind)
    story = []
    options = kind.options()
    steps = 95
    for _ in range(choose.choice((1, 1, 1, 2))):
        victim = choose.choice(("gimdem-server", "gimdemFoam", "gimdem"))
        steps = choose.randrange(0, steps)
        story.append(cut(case, options, steps, victim, choose))
        options = [*kind.options(), "--restart", "latest"]
        steps = max(1, 90 - steps)  # what is left
    finish(case, kind)
    # A run that was killed before its first checkpoint has none, and the one before it is the last.
    last = [run for run in sorted((case / "runs").iterdir()) if any(run.glob("checkpoints/step_*.h5"))][-1]
    different = differences(whole, end_of(last))
    print(f"  {kind}: killed {', '.join(story)}: {'equal' if not different else 'DIFFERENT: ' + ', '.join(different)}",
          flush=True)
    return different


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--moments", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", type=int, help="of KINDS, alone")
    parser.add_argument("--verbose", action="store_true", help="as every test here; it always tells what it does")
    options = parser.parse_args()
    choose = random.Random(options.seed)
    equal = 0
    wholes: dict[Kind, dict[str, bytes]] = {}
    with tempfile.TemporaryDirectory(prefix="gimdem-kills-") as root:
        for moment in range(options.moments):
            kind = KINDS[moment % len(KINDS) if options.kind is None else options.kind]
            if kind not in wholes:
                case = make_case(Path(root) / f"whole-{len(wholes)}", kind)
                process = start(case, *kind.options())
                _, err = process.communicate()
                if process.returncode != 0:
                    raise RuntimeError(err.decode())
                wholes[kind] = end_of(newest_run(case))
            folder = Path(root) / f"moment-{moment}"
            equal += not one_moment(folder, kind, wholes[kind], choose)
            shutil.rmtree(folder)
    print(f"figure: restarts_bitwise_equal = {equal} [1]")
    return 0 if equal == options.moments else 1


if __name__ == "__main__":
    sys.exit(main())
