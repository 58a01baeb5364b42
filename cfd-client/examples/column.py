#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The solver of column.cpp in Python, coupled with coupling/python/gimdem_client.

Usage: column.py <endpoint> <run folder> [folder of keys], which has constant/column; writes column.csv (a line a step) and
profile.csv (a line a cell, at the end) there.
"""
from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "coupling" / "python"))
from gimdem_client import (Client, ClientOptions, CouplingError, FluidFields, FluidProperties, Mesh, Monitor,  # noqa: E402
                           Patch, SolidFields, Step)

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

    def write_profile(self, file: Path) -> None:
        lines = ["height,void_fraction,velocity,pressure"]
        for k in range(self.n):
            lines.append(f"{self.h * (k + 0.5)!r},{float(self.void_fraction[k])!r},"
                         f"{float(self.fields.velocity[k, 2])!r},{float(self.fields.pressure[k])!r}")
        file.write_text("\n".join(lines) + "\n")


def run(endpoint: str, folder: Path, keys: str) -> None:
    settings = read_settings(folder / "constant" / "column")
    n, dt = int(settings["cells"]), settings["time_step"]
    column = Column(n, settings["height"] / n, settings["width"] * settings["depth"], settings["density"])

    def inflow_at(t: float) -> float:
        return settings["inflow"] * min(1.0, t / settings["ramp_time"])

    with Client(ClientOptions(endpoint, "column-python", timeout=settings["timeout"], keys=keys)) as client, \
            (folder / "column.csv").open("w") as table:
        welcome = client.connect(FluidProperties(settings["density"], settings["viscosity"]))
        client.send_mesh(make_mesh(n, settings["width"], settings["depth"], settings["height"]))
        column.start(client.solid)
        column.advance(client.solid, inflow_at(0), dt)

        print("time,inflow,outflow,pressure_drop,applied_force", file=table)
        for i in range(1, round(welcome.end_time / dt) + 1):
            if client.stop_request:
                break
            monitors = [Monitor("applied_force_x", 0.0, "N"), Monitor("applied_force_y", 0.0, "N"),
                        Monitor("applied_force_z", column.applied_force, "N")]
            solid = client.begin_step(Step(i, dt * (i - 1), dt), column.fields, monitors)
            t = dt * i
            column.advance(solid, inflow_at(t), dt)
            client.end_step()
            print(f"{t!r},{inflow_at(t)!r},{column.outflow!r},{column.pressure_drop!r},{column.applied_force!r}",
                  file=table)
        column.write_profile(folder / "profile.csv")
        client.finish("stopped as asked" if client.stop_request else "end time reached")


def main() -> int:
    if len(sys.argv) not in (3, 4):
        print("usage: column.py <endpoint> <run folder> [folder of keys]", file=sys.stderr)
        return 2
    try:
        run(sys.argv[1], Path(sys.argv[2]), "".join(sys.argv[3:]))
        return 0
    except (CouplingError, OSError, KeyError) as error:
        print(f"column-python: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
