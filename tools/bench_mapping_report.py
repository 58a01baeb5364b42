# SPDX-License-Identifier: BSD-3-Clause
"""What ./gimdem bench mapping leaves: lines `figure: ...`, mapping-errors.csv, mapping-speed.csv, mapping.md and plots.

A row of the files stays until it is measured again, so that a run may be made in parts."""
from __future__ import annotations

import csv
from pathlib import Path

from bench_mapping_meshes import Mesh, known

Row = dict[str, str]
ERRORS = ("wrong_cells", "rms_error", "jump_largest", "jump_mean", "largest_solid_fraction", "wall_ratio")
ERROR_COLUMNS = ("mesh", "family", "method", "cells", "ratio", *ERRORS)
STAGES = ("locate_ns", "weights_ns", "sums_ns")
SPEED = (*STAGES, "step_ms", "weights_per_particle", "bytes_per_particle")
SPEED_COLUMNS = ("mesh", "family", "method", "cells", "ratio", "particles", "threads", *SPEED)
UNITS = {"step_ms": "ms", "bytes_per_particle": "B"}
SHOWN = ("wrong_cells", "rms_error", "jump_largest", "wall_ratio", "step_ms", "bytes_per_particle")  # as figures
TABLES = (
    ("Share of a particle's volume in wrong cells", "wrong_cells", "{:.4f}"),
    ("RMS error of the solid fraction of a packing", "rms_error", "{:.4f}"),
    ("Largest jump of a solid fraction for a step of dp/100", "jump_largest", "{:.5f}"),
    ("Largest solid fraction of any cell", "largest_solid_fraction", "{:.2f}"),
    ("Solid in cells at walls, over that of `exact`", "wall_ratio", "{:.3f}"),
)


class Table:
    """A CSV file whose rows have a key."""

    def __init__(self, path: Path, columns: tuple[str, ...], key: tuple[str, ...]) -> None:
        self.path, self.columns, self.key = path, columns, key
        self.rows: dict[tuple[str, ...], Row] = {}
        if path.exists():
            with path.open(newline="") as file:
                for row in csv.DictReader(file):
                    if tuple(row) == columns:
                        self.rows[self.key_of(row)] = row

    def key_of(self, row: Row) -> tuple[str, ...]:
        return tuple(row[name] for name in self.key)

    def add(self, row: Row) -> None:
        """Takes a row, in place of one with the same key."""
        self.rows[self.key_of(row)] = {name: row[name] for name in self.columns}
        with self.path.open("w", newline="") as file:
            writer = csv.DictWriter(file, self.columns)
            writer.writeheader()
            writer.writerows(self.rows.values())


class MappingReport:
    def __init__(self, folder: Path, methods: list[str]) -> None:
        self.folder, self.methods = folder, methods
        self.errors = Table(folder / "mapping-errors.csv", ERROR_COLUMNS, ("mesh", "method"))
        self.speed = Table(folder / "mapping-speed.csv", SPEED_COLUMNS, ("mesh", "method", "particles", "threads"))

    def add_errors(self, mesh: Mesh, rows: list[Row]) -> None:
        for row in rows:
            self.errors.add({"mesh": mesh.name, "family": mesh.family, **row})
            self.print_figures(mesh, row, "")

    def add_speed(self, mesh: Mesh, rows: list[Row]) -> None:
        for row in rows:
            self.speed.add({"mesh": mesh.name, "family": mesh.family, **row})
            per_particle = sum(float(row[name]) for name in STAGES)
            where = f"_of_{row['particles']}"
            print(f"figure: mapping_ns_per_particle_{row['method']}_on_{mesh.name}{where} = {per_particle:.5g} [ns]")
            self.print_figures(mesh, row, where)

    def print_figures(self, mesh: Mesh, row: Row, where: str) -> None:
        for name in SHOWN:
            if name in row:
                print(f"figure: mapping_{name}_{row['method']}_on_{mesh.name}{where} = {row[name]} "
                      f"[{UNITS.get(name, '1')}]", flush=True)

    def bytes_per_particle(self, mesh: Mesh, method: str, count: int) -> float:
        """As measured with fewer particles; 0 where it was not."""
        found = [float(row["bytes_per_particle"]) for row in self.speed.rows.values()
                 if (row["mesh"], row["method"]) == (mesh.name, method) and int(row["particles"]) < count]
        return max(found, default=0.0)

    def finish(self) -> list[Path]:
        """Writes the tables and the plots of all that the files hold; returns all files."""
        files = [table.path for table in (self.errors, self.speed) if table.rows]
        if files:
            import bench_mapping_plots  # needs matplotlib

            files.append(self.folder / "mapping.md")
            files[-1].write_text(self.tables())
            files += bench_mapping_plots.draw(self.in_order(self.errors), self.in_order(self.speed), self.folder)
        return files

    def in_order(self, table: Table) -> list[Row]:
        """By mesh as they are listed, then by method."""
        names = list(known())

        def place(row: Row) -> tuple[int, int, str]:
            mesh = names.index(row["mesh"]) if row["mesh"] in names else len(names)
            method = self.methods.index(row["method"]) if row["method"] in self.methods else len(self.methods)
            return mesh, method, row["mesh"]

        return sorted(table.rows.values(), key=place)

    def tables(self) -> str:
        errors, speed = self.in_order(self.errors), self.in_order(self.speed)
        parts = [table_of(title, {(row["mesh"], row["method"]): text.format(float(row[name])) for row in errors},
                          self.methods) for title, name, text in TABLES]
        for count in sorted({int(row["particles"]) for row in speed}):
            some = [row for row in speed if int(row["particles"]) == count and row["threads"] == "1"]
            for title, value in ((f"Time of a mapping of {count:,} particles [ns per particle]", ns_per_particle),
                                 (f"Time of a mapping of {count:,} particles [ms]",
                                  lambda row: f"{float(row['step_ms']):.3g}"),
                                 (f"Memory of {count:,} particles [bytes per particle]",
                                  lambda row: f"{float(row['bytes_per_particle']):.0f}")):
                parts.append(table_of(title, {(row["mesh"], row["method"]): value(row) for row in some}, self.methods))
        return "\n".join(filter(None, parts))


def ns_per_particle(row: Row) -> str:
    return f"{sum(float(row[name]) for name in STAGES):.0f}"


def table_of(title: str, cells: dict[tuple[str, str], str], order: list[str]) -> str:
    """Meshes down, methods across; empty where there is nothing."""
    if not cells:
        return ""
    meshes = list(dict.fromkeys(mesh for mesh, _ in cells))
    methods = sorted({method for _, method in cells}, key=lambda name: order.index(name) if name in order else len(order))
    lines = [f"**{title}**", "", "| mesh | " + " | ".join(f"`{name}`" for name in methods) + " |",
             "|---|" + "---|" * len(methods)]
    for mesh in meshes:
        lines.append(f"| {mesh} | " + " | ".join(cells.get((mesh, method), "") for method in methods) + " |")
    return "\n".join(lines) + "\n"
