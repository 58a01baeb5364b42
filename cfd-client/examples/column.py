#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The solver of column.cpp in Python, coupled with coupling/python/gimdem_client.

Usage: column.py <endpoint> <run folder> [folder of keys] [--restart <state>]; the run folder has constant/column.
Writes column.csv (a line a step), profile.csv (a line a cell, at the end) and states/, from which it goes on, there.
"""
from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Optional, TextIO

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "coupling" / "python"))
from gimdem_client import (Client, ClientOptions, CouplingError, FluidFields, FluidProperties, Mesh, Monitor,  # noqa: E402
                           Patch, ResumePoint, SavedCheckpoint, SolidFields, Step)

GRAVITY = -9.81  # along z [m/s^2]


def read_settings(file: Path) -> dict[str, float]:
    """constant/column: a name and a number a line; # begins a comment."""
    lines = (line.split("#")[0].split() for line in file.read_text().splitlines())
    return {words[0]: float(words[1]) for words in lines if words}


def make_mesh(n: int, width: float, depth: float, height: float) -> Mesh:
    """n cells above each other: level k has the points 4 k .. 4 k + 3, anticlockwise seen from above."""
    points = [corner + (height * k / n,) for k in range(n + 1) for corner in ((0, 0), (width, 0), (width, depth), (0, depth))]
    level = np.arange(4)
    inside = [(k - 1, 4 * k + level) for k in range(1, n)]
    ends = [(0, level[[0, 3, 2, 1]]), (n - 1, 4 * n + level)]
    sides = [(k, 4 * k + np.array([s, (s + 1) % 4, 4 + (s + 1) % 4, 4 + s])) for k in range(n) for s in range(4)]
    faces = inside + ends + sides
    return Mesh(
        points=np.array(points), face_offsets=4 * np.arange(len(faces) + 1),
        face_points=np.concatenate([face for _, face in faces]), owner=np.array([owner for owner, _ in faces]),
        neighbour=np.arange(1, n), cell_count=n,
        patches=[Patch("inlet", "open", n - 1, 1), Patch("outlet", "open", n, 1), Patch("walls", "wall", n + 1, 4 * n)],
    )


class Column:
    """The gas. Only the last of a vector's three components, along z, is not 0 here."""

    def __init__(self, cells: int, cell_height: float, area: float, density: float) -> None:
        self.n, self.h, self.area, self.density = cells, cell_height, area, density
        self.void_fraction = np.zeros(cells)
        self.fields = FluidFields(velocity=np.zeros((cells, 3)), velocity_gradient=np.zeros((cells, 9)),
                                  pressure_gradient=np.zeros((cells, 3)), void_fraction_gradient=np.zeros((cells, 3)),
                                  pressure=np.zeros(cells))
        self.pressure_drop = 0.0  # from inlet to outlet [Pa]
        self.applied_force = 0.0  # of the particles on the gas, along z [N]
        self.outflow = 0.0  # superficial velocity at the outlet [m/s]

    def start(self, solid: SolidFields) -> None:
        self.void_fraction = solid.void_fraction.copy()

    def advance(self, solid: SolidFields, inflow: float, dt: float) -> None:
        """The gas at the end of a step in which that solid holds and gas comes in at that velocity."""
        flux = inflow
        self.applied_force = 0.0
        for k in range(self.n):
            alpha = float(solid.void_fraction[k])
            flux_above = flux - self.h * (alpha - float(self.void_fraction[k])) / dt
            v = 0.5 * (flux + flux_above) / alpha
            source = float(solid.drag_momentum[k, 2]) - float(solid.drag_coefficient[k]) * v
            self.fields.velocity[k, 2] = v
            self.fields.pressure_gradient[k, 2] = self.density * GRAVITY + source / alpha
            self.applied_force += source * (self.area * self.h)
            flux = flux_above
        self.void_fraction = solid.void_fraction.copy()
        self.outflow = flux
        self._integrate_pressure()
        self._differentiate()

    def _integrate_pressure(self) -> None:
        """From the outlet, where it is 0, downwards."""
        above = 0.0
        for k in reversed(range(self.n)):
            rise = -float(self.fields.pressure_gradient[k, 2]) * self.h
            self.fields.pressure[k] = above + 0.5 * rise
            above += rise
        self.pressure_drop = above

    def _differentiate(self) -> None:
        """Gradients: from the cells on either side, one-sided at the ends."""
        k = np.arange(self.n)
        below, above = np.maximum(k - 1, 0), np.minimum(k + 1, self.n - 1)
        distance = self.h * (above - below)
        v = self.fields.velocity[:, 2]
        self.fields.velocity_gradient[:, 8] = (v[above] - v[below]) / distance
        self.fields.void_fraction_gradient[:, 2] = (self.void_fraction[above] - self.void_fraction[below]) / distance

    def lines(self) -> list[str]:
        """All that the next step needs, beside what follows from it."""
        cells = zip(self.void_fraction, self.fields.velocity[:, 2], self.fields.pressure_gradient[:, 2])
        return [f"applied_force {self.applied_force!r}",
                *(" ".join(repr(float(value)) for value in cell) for cell in cells)]

    def read(self, lines: list[str]) -> None:
        self.applied_force = float(lines[0].split()[1])
        cells = np.array([[float(word) for word in line.split()] for line in lines[1:]])
        self.void_fraction, self.fields.velocity[:, 2], self.fields.pressure_gradient[:, 2] = cells.T.copy()
        self._integrate_pressure()
        self._differentiate()

    def write_profile(self, file: Path) -> None:
        lines = ["height,void_fraction,velocity,pressure"]
        for k in range(self.n):
            lines.append(f"{self.h * (k + 0.5)!r},{float(self.void_fraction[k])!r},"
                         f"{float(self.fields.velocity[k, 2])!r},{float(self.fields.pressure[k])!r}")
        file.write_text("\n".join(lines) + "\n")


def write_state(folder: Path, saved: SavedCheckpoint, time: float, steps: int, column: Column) -> None:
    """Where the gas goes on: a text that names the particles' checkpoint, then the resume point, then the column. The file is
    there once it is whole and on disk. steps: of the gas since the run began."""
    lines = [f"checkpoint {saved.name}", f"session {saved.session}", f"step {saved.step}", f"time {time!r}",
             f"steps {steps}", *column.lines(), "end"]
    (folder / "states").mkdir(exist_ok=True)
    file = folder / "states" / f"{steps:09d}.state"
    part = file.with_suffix(".state.part")
    with part.open("w") as out:
        out.write("\n".join(lines) + "\n")
        out.flush()
        os.fsync(out.fileno())
    part.rename(file)


def read_state(file: Path, column: Column) -> tuple[ResumePoint, int]:
    """The resume point and the number of steps of the gas since the run began; the column goes on from there."""
    try:
        lines = file.read_text().splitlines()
        if lines[-1] != "end":
            raise ValueError("it is cut short")
        session, step, time, steps = (line.split()[1] for line in lines[1:5])
        column.read(lines[5:-1])
        return ResumePoint(int(session), int(step), float(time)), int(steps)
    except (ValueError, IndexError) as error:
        raise OSError(f"{file} cannot be read, or is of another column: {error}") from None


def open_table(file: Path, time: float) -> TextIO:
    """column.csv; of a run that goes on in its folder, without the lines behind that time."""
    kept, last = [], -1.0
    for line in file.read_text().splitlines()[1:] if file.exists() else []:
        t = float(line.split(",")[0] or "inf")
        if last < t <= time:
            kept.append(line)
            last = t
    table = file.open("w")
    print("time,inflow,outflow,pressure_drop,applied_force", *kept, sep="\n", file=table)
    return table


def run(endpoint: str, folder: Path, keys: str, restart: Optional[Path]) -> None:
    settings = read_settings(folder / "constant" / "column")
    n, dt = int(settings["cells"]), settings["time_step"]
    column = Column(n, settings["height"] / n, settings["width"] * settings["depth"], settings["density"])

    def inflow_at(t: float) -> float:
        return settings["inflow"] * min(1.0, t / settings["ramp_time"])

    resume, begin = read_state(restart, column) if restart else (None, 0)
    complete = resume.step if resume else 0  # the newest checkpoint of which we have a state
    with Client(ClientOptions(endpoint, "column-python", timeout=settings["timeout"], keys=keys, resume=resume)) as client, \
            open_table(folder / "column.csv", resume.time if resume else 0.0) as table:
        welcome = client.connect(FluidProperties(settings["density"], settings["viscosity"]))
        client.send_mesh(make_mesh(n, settings["width"], settings["depth"], settings["height"]))
        if not resume:
            column.start(client.solid)
            column.advance(client.solid, inflow_at(0), dt)

        steps, steps_per_state = round(welcome.end_time / dt), max(1, round(settings["save_interval"] / dt))
        for i in range(begin + 1, steps + 1):
            if client.stop_request:
                break
            monitors = [Monitor("applied_force_x", 0.0, "N"), Monitor("applied_force_y", 0.0, "N"),
                        Monitor("applied_force_z", column.applied_force, "N")]
            solid = client.begin_step(Step(i - begin, dt * (i - 1), dt), column.fields, monitors)
            t = dt * i
            column.advance(solid, inflow_at(t), dt)
            client.end_step()
            print(f"{t!r},{inflow_at(t)!r},{column.outflow!r},{column.pressure_drop!r},{column.applied_force!r}",
                  file=table)
            if welcome.saves_checkpoints and (i % steps_per_state == 0 or i == steps or client.stop_request):
                table.flush()
                saved = client.save_checkpoint(t, complete)
                write_state(folder, saved, t, i, column)
                complete = saved.step
        column.write_profile(folder / "profile.csv")
        client.finish("stopped as asked" if client.stop_request else "end time reached")


def main() -> int:
    words, restart = sys.argv[1:], None
    if len(words) > 2 and words[-2] == "--restart":
        restart = Path(words[-1])
        words = words[:-2]
    if len(words) not in (2, 3):
        print("usage: column.py <endpoint> <run folder> [folder of keys] [--restart <state>]", file=sys.stderr)
        return 2
    try:
        run(words[0], Path(words[1]), "".join(words[2:]), restart)
        return 0
    except (CouplingError, OSError, KeyError) as error:
        print(f"column-python: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
