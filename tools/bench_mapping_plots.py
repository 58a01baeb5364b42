# SPDX-License-Identifier: BSD-3-Clause
"""Plots of ./gimdem bench mapping."""
from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

from bench_mapping_meshes import known
from bench_plots import CROPPED, legend_below, saved

Rows = list[dict[str, str]]
PANELS = ("hexahedra-1", "hexahedra-1.76", "hexahedra-2.38", "hexahedra-4", "stretched-2", "stretched-4", "tetrahedra",
          "T", "polyhedra", "C", "D", "E")
COLOURS = ("#0b5394", "#6fa8dc", "#b45f06", "#38761d", "#cc0000", "#741b47", "#999999", "#000000", "#bf9000", "#45818e",
           "#e06666", "#674ea7")
MARKERS = "osD^vPX*<>hp"


@dataclass(frozen=True)
class Quantity:
    """A column of mapping-errors.csv and what it is called in plots."""

    name: str
    label: str
    scale: str = "log"


WRONG = Quantity("wrong_cells", "share of volume\nin wrong cells [1]")
RMS = Quantity("rms_error", "RMS error of\nthe solid fraction [1]")
JUMP = Quantity("jump_largest", "largest jump of a solid\nfraction in dp/100 [1]")
LARGEST = Quantity("largest_solid_fraction", "largest solid fraction\nof any cell [1]", "linear")
WALL = Quantity("wall_ratio", "solid in cells at walls,\nover that of exact [1]", "linear")


class Styles:
    """A colour and a marker for each method, the same in all plots."""

    def __init__(self, rows: Rows) -> None:
        self.methods = list(dict.fromkeys(row["method"] for row in rows))

    def of(self, method: str) -> dict[str, object]:
        place = self.methods.index(method)
        return {"color": COLOURS[place % len(COLOURS)], "marker": MARKERS[place % len(MARKERS)]}

    def legend(self, figure: plt.Figure) -> None:
        marks = [plt.Line2D([], [], ls="", ms=5, label=name, **self.of(name)) for name in self.methods]
        legend_below(figure, marks, 8)


def draw(errors: Rows, speed: Rows, folder: Path) -> list[Path]:
    """Draws all that there is data for; returns the files."""
    styles = Styles(errors + speed)
    with plt.rc_context(CROPPED):
        drawn = [
            draw_pareto(errors, speed, WRONG, styles, folder / "mapping-pareto-overlap.png"),
            draw_pareto(errors, speed, RMS, styles, folder / "mapping-pareto-packing.png"),
            draw_ratios(errors, styles, folder / "mapping-cubes.png"),
            draw_meshes(errors, (WRONG, RMS, JUMP), styles, folder / "mapping-meshes.png"),
            draw_meshes(errors, (LARGEST, WALL), styles, folder / "mapping-packing.png"),
        ]
    return [file for file in drawn if file]


def draw_pareto(errors: Rows, speed: Rows, quantity: Quantity, styles: Styles, path: Path) -> Path | None:
    """Error against time, a panel for each mesh; the line joins those that no other beats in both."""
    points = pareto_points(errors, speed, quantity.name)
    names = [name for name in PANELS if name in points] or sorted(points)[:9]
    if not names:
        return None
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(2.7 * columns, 2.2 * rows + 0.5), squeeze=False, sharex=True,
                                  sharey=True)
    least = min((error for name in names for _, error in points[name].values() if error > 0), default=1e-3)
    floor = least / 4  # where the exact method is drawn, whose error is zero
    for axes, name in zip(panels.flat, names):
        front = draw_front(axes, points[name], floor)
        for method, (time, error) in points[name].items():
            axes.plot(time, max(error, floor), ls="", ms=5, zorder=3, clip_on=False, **styles.of(method))
        axes.set(xscale="log", yscale="log", title=known()[name].label if name in known() else name, ylim=(floor, None))
        axes.annotate("0", (0, 0), (-4, 0), xycoords="axes fraction", textcoords="offset points", ha="right",
                      va="center", fontsize=7) if front else None
    for place, axes in enumerate(panels.flat):
        axes.set_visible(place < len(names))
        axes.tick_params(labelbottom=place + columns >= len(names))
    figure.supxlabel("time of a mapping [ns per particle], 17,563 particles, one thread", fontsize=9)
    figure.supylabel(quantity.label.replace("\n", " "), fontsize=9)
    styles.legend(figure)
    return saved(figure, path)


def draw_front(axes: plt.Axes, points: dict[str, tuple[float, float]], floor: float) -> bool:
    """Steps between the methods that are quickest for their error; true where the last of them is exact."""
    front: list[tuple[float, float]] = []
    for time, error in sorted(points.values()):
        if not front or error < front[-1][1]:
            front.append((time, error))
    axes.step([time for time, _ in front], [max(error, floor) for _, error in front], where="post", color="#bbbbbb",
              lw=0.8, zorder=1)
    return bool(front) and front[-1][1] <= 0


def pareto_points(errors: Rows, speed: Rows, name: str) -> dict[str, dict[str, tuple[float, float]]]:
    """Time [ns per particle] and error, by mesh and method."""
    times = {(row["mesh"], row["method"]): float(row["step_ms"]) * 1e6 / float(row["particles"])
             for row in speed if row["particles"] == "17563" and row["threads"] == "1"}
    points: dict[str, dict[str, tuple[float, float]]] = defaultdict(dict)
    for row in errors:
        if (row["mesh"], row["method"]) in times:
            points[row["mesh"]][row["method"]] = times[row["mesh"], row["method"]], float(row[name])
    return points


def draw_ratios(errors: Rows, styles: Styles, path: Path) -> Path | None:
    """Against a / dp on cubes."""
    cubes = [row for row in errors if row["family"] == "hexahedra"]
    if len({row["ratio"] for row in cubes}) < 2:
        return None
    figure, panels = plt.subplots(2, 2, figsize=(7, 5.6), sharex=True)
    for axes, quantity in zip(panels.flat, (WRONG, RMS, JUMP, WALL)):
        for method in styles.methods:
            line = sorted((float(row["ratio"]), float(row[quantity.name])) for row in cubes if row["method"] == method)
            line = [(x, y) for x, y in line if y > 0 or quantity.scale == "linear"]
            if line:
                axes.plot(*zip(*line), ms=3.5, **styles.of(method))
        axes.set(xscale="log", yscale=quantity.scale, ylabel=quantity.label)
        ratios = sorted({float(row["ratio"]) for row in cubes})
        axes.set_xticks([x for x in ratios if x not in (1.56, 3)], minor=False)
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
        axes.minorticks_off()
    for axes in panels[1]:
        axes.set_xlabel("a/dp [1]")
    styles.legend(figure)
    return saved(figure, path)


def draw_meshes(errors: Rows, quantities: tuple[Quantity, ...], styles: Styles, path: Path) -> Path | None:
    """Meshes that are not all alike, side by side."""
    names = [name for name in dict.fromkeys(row["mesh"] for row in errors)
             if not name.startswith("hexahedra-") or name == "hexahedra-1.76"]
    if not names:
        return None
    size = (max(5.0, 0.85 * len(names)), 1.9 * len(quantities) + 1)
    figure, panels = plt.subplots(len(quantities), 1, figsize=size, squeeze=False, sharex=True)
    for axes, quantity in zip(panels[:, 0], quantities):
        for place, method in enumerate(styles.methods):
            shift = 0.6 * (place / max(1, len(styles.methods) - 1) - 0.5)
            points = [(names.index(row["mesh"]) + shift, float(row[quantity.name])) for row in errors
                      if row["method"] == method and row["mesh"] in names]
            points = [(x, y) for x, y in points if y > 0 or quantity.scale == "linear"]
            if points:
                axes.plot(*zip(*points), ls="", ms=4, **styles.of(method))
        axes.set(yscale=quantity.scale, ylabel=quantity.label)
        if quantity.scale == "linear":
            axes.axhline(1, color="#888888", lw=0.7, ls="--", zorder=1)
        axes.grid(axis="x", visible=False)
        for border in range(1, len(names)):
            axes.axvline(border - 0.5, color="#dddddd", lw=0.6, zorder=0)
    panels[-1, 0].set_xticks(range(len(names)), [label_of(name) for name in names])
    panels[-1, 0].set_xlim(-0.5, len(names) - 0.5)
    styles.legend(figure)
    return saved(figure, path)


def label_of(name: str) -> str:
    """In two lines, the size of cubes left out: all these meshes have it about."""
    if name not in known():
        return name
    first, _, second = known()[name].label.partition(", ")
    return f"{first}\n{second}" if second else first.replace(" ", "\n", 1)
