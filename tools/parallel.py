# SPDX-License-Identifier: BSD-3-Clause
"""A fluid that several processes solve: cut the case, start the processes, put the results together."""
from __future__ import annotations

import hashlib
import re
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

import openfoam
from case_folder import CaseDescription
from console import UserError, shown
from process import run_logged
from rank_parts import DICTIONARY, identity, keep, processors, take, usable
from restart import RECORD, Restart

MOST = 32  # max_ranks of gimdem/coupling/Types.hpp
# Debian's and Ubuntu's OpenFOAM has neither scotch nor metis.
CUT = """FoamFile {{ version 2.0; format ascii; class dictionary; object decomposeParDict; }}
method simple;
simpleCoeffs {{ n ({} {} {}); delta 0.001; }}
"""
BOX = re.compile(r"Overall domain bounding box \(([^)]+)\) \(([^)]+)\)")
# For Open MPI on one machine, root or not, in a container or not, with more ranks than cores or not. What the user has
# set is left alone; another MPI does not know them.
MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_plm": "isolated",  # no ssh
    "OMPI_MCA_btl": "self,vader",  # no network
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",  # containers forbid it
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",  # the server needs cores too
    "OMPI_MCA_mpi_yield_when_idle": "1",
}


def check(ranks: int, client: str) -> None:
    if not 1 <= ranks <= MOST:
        raise UserError(f"--ranks {ranks} is impossible (1 to {MOST}); choose about as many as there are cores", 2)
    if ranks > 1 and client != "openfoam":
        who = "this case has no fluid" if client == "none" else f"the client {client} is one process"
        raise UserError(f"--ranks is for OpenFOAM, and {who}; leave it out", 2)
    if ranks > 1 and shutil.which("mpirun") is None:
        raise UserError("mpirun is not on the PATH (it starts the ranks); run ./gimdem setup, or leave out --ranks")


def decompose(folder: Path, ranks: int, restart: Restart | None) -> str:
    """Cut mesh and fields of a run, those that it begins with; returns one line about it. Where the run of before was
    cut the same way, its ranks' own fields are taken: those that were put together have lost the last digits."""
    dictionary = folder / DICTIONARY
    how = f"as {DICTIONARY} says"
    if not dictionary.exists():
        counts = cut(extents(folder), ranks)
        dictionary.write_text(CUT.format(*counts))
        how = " x ".join(map(str, counts))
    with dictionary.open("a") as text:
        text.write(f"\nnumberOfSubdomains {ranks}; // --ranks: the last entry counts\n")
    # Fields go through text twice, and a restart must find every digit.
    with (folder / "system" / "controlDict").open("a") as text:
        text.write("\nwritePrecision 17; // --ranks: the last entry counts\n")
    if restart and restart.state:
        time = restart.state.fluid.name
        if parts := usable(restart.state, dictionary, ranks):
            take(parts, time, folder)
            return f"the {ranks} ranks go on from their own fields"
        tool("decomposePar", ["-time", time, "-copyUniform"], folder)
        for part in processors(folder):
            list_files(part / time)
    else:
        tool("decomposePar", [], folder)
    return f"the mesh is cut for {ranks} ranks, {how}"


def extents(folder: Path) -> list[float]:
    """Of the mesh in x, y and z [m]."""
    tool("checkMesh", ["-noTopology", "-constant"], folder)
    box = BOX.search((folder / "log.checkMesh").read_text(errors="replace"))
    if not box:
        raise UserError(f"checkMesh told no bounding box (the mesh is cut along it); see {shown(folder)}/log.checkMesh, "
                        f"or give the case a {DICTIONARY}")
    low, high = ([float(word) for word in corner.split()] for corner in box.groups())
    return [b - a for a, b in zip(low, high)]


def cut(lengths: Sequence[float], ranks: int) -> tuple[int, int, int]:
    """Into how many parts along x, y and z, so that the cuts through a box of these lengths have the least area."""
    x, y, z = lengths

    def area(counts: tuple[int, int, int]) -> float:
        return (counts[0] - 1) * y * z + (counts[1] - 1) * x * z + (counts[2] - 1) * x * y

    ways = [(a, b, ranks // a // b) for a in range(1, ranks + 1) for b in range(1, ranks // a + 1)
            if ranks % (a * b) == 0]
    return min(ways, key=area)


def reconstruct(folder: Path, has_ended: bool = True) -> str:
    """Put the whole times of a run's ranks together, so that they are where one process would have written them;
    returns one line about it, empty if there is nothing. Of a run that has ended the parts are tidied away."""
    parts = processors(folder)
    if not parts:
        return ""
    times = whole_times(parts)
    if times:
        tool("reconstructPar", ["-time", ",".join(times)], folder)
    for time in times:
        join_records([part / time for part in parts], folder / time)
    if has_ended:
        keep(folder, parts)
    return f"{len(times)} times of {len(parts)} ranks put together"


def join_records(parts: Sequence[Path], whole: Path) -> None:
    """Of a time that is put together: it belongs to a checkpoint if all its parts belong to the same."""
    records = [(part / RECORD).read_text() if (part / RECORD).is_file() else "" for part in parts]
    if len(set(map(identity, records))) == 1 and all(records):
        list_files(whole)
    else:
        (whole / RECORD).unlink(missing_ok=True)


def list_files(time: Path) -> None:
    """Have the record of a time list the files that are there now, with size and checksum."""
    record = time / RECORD
    files = [file for file in sorted(time.rglob("*")) if file.is_file() and file != record]
    lines = [f'("{file.relative_to(time)}" "{file.stat().st_size}" "{hashlib.sha1(file.read_bytes()).hexdigest()}")'
             for file in files]
    text = record.read_text()
    part = record.with_suffix(".part")
    part.write_text(text[:text.index("files")] + "files (\n" + "\n".join(lines) + "\n);\n")
    part.replace(record)


def reconstruct_before_restart(case: CaseDescription, wanted: str | None) -> None:
    """What a launcher that was killed has left. The parts are kept: the run may be alive."""
    if wanted is None or case.client != "openfoam":
        return
    if wanted == "latest":
        folders = sorted((case.folder / "runs").glob("[0-9]*"))[-1:]
    else:
        folders = [Path(wanted).resolve().parents[1]] if Path(wanted).is_file() else []
    for folder in folders:
        reconstruct(folder, has_ended=False)


def whole_times(parts: Sequence[Path]) -> list[str]:
    """Names of the times that every rank has written to the end: with the same files, none of them empty."""
    def files(time: Path) -> set[str]:
        return {file.name for file in time.iterdir() if file.is_file() and file.stat().st_size > 0}

    def is_whole(name: str) -> bool:
        found = [files(part / name) if (part / name).is_dir() else set() for part in parts]
        return bool(found[0]) and all(one == found[0] for one in found)

    names = [folder.name for folder in parts[0].iterdir() if is_number(folder.name) and float(folder.name) > 0]
    return sorted((name for name in names if is_whole(name)), key=float)


def is_number(name: str) -> bool:
    try:
        float(name)
    except ValueError:
        return False
    return True


def tool(name: str, options: Sequence[str], folder: Path) -> None:
    log = folder / f"log.{name}"
    if shutil.which(name) is None:
        raise UserError(f"{name} is not on the PATH (--ranks needs it); run ./gimdem setup, or source OpenFOAM")
    if run_logged([name, "-case", str(folder), *options], log, env=openfoam.environment()) != 0:
        raise UserError(f"{name} failed: {openfoam.error_in(log) or 'no reason given'}; see {shown(log)}")


def command(client: Sequence[str], ranks: int) -> list[str]:
    """How to start a client as so many processes."""
    return list(client) if ranks == 1 else ["mpirun", "-np", str(ranks), *client, "-parallel"]


class Scratch:
    """Where MPI keeps its sockets and shared memory: a folder that goes with us, whatever the processes leave."""

    def __init__(self, ranks: int) -> None:
        self._folder = tempfile.mkdtemp(prefix="gimdem-mpi-") if ranks > 1 else None

    def environment(self, env: dict[str, str]) -> dict[str, str]:
        """That of the client, and what MPI needs."""
        if self._folder is None:
            return env
        return {**MPI, **env, "TMPDIR": self._folder}

    def remove(self) -> None:
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
