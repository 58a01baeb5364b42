# SPDX-License-Identifier: BSD-3-Clause
"""Figures 3 to 8 of the paper of the Gaussian Integral Method."""
from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

from bench_plots import CROPPED, legend_below, saved

Rows = list[dict[str, str]]
RATIOS = ("2", "4", "8", "16")
WHERE = {"-1": r"$\mu=r_c-r_p$", "0": r"$\mu=r_c$", "1": r"$\mu=r_c+r_p$"}
SHARE = r"$V_{p,i}/V_p$ [1]"


def draw(rows: Rows, folder: Path) -> list[Path]:
    by_figure: dict[int, Rows] = {number: [row for row in rows if row["figure"] == str(number)] for number in range(3, 9)}
    with plt.rc_context(CROPPED):
        files = [draw_gaussians(number, by_figure[number], shares(by_figure[6]), folder) for number in (3, 4, 5)]
        files += [draw_volume_ratios(by_figure[6], folder), draw_distances(by_figure[7], folder),
                  draw_coefficients(by_figure[8], folder)]
    return files


def line_of(rows: Rows, **which: str) -> tuple[list[float], list[float]]:
    """x and y of the rows with these entries."""
    some = [row for row in rows if all(row[name] == value for name, value in which.items())]
    return [float(row["x"]) for row in some], [float(row["y"]) for row in some]


def shares(rows: Rows) -> dict[tuple[str, str], float]:
    """At phi = 0.4, by position and volume ratio."""
    return {(row["position"], row["volume_ratio"]): float(row["y"]) for row in rows if row["phi"] == "0.4"}


def draw_gaussians(number: int, rows: Rows, share: dict[tuple[str, str], float], folder: Path) -> Path:
    figure, panels = plt.subplots(2, 2, figsize=(6.4, 4.6))
    position = str(number - 4)
    for axes, ratio in zip(panels.flat, RATIOS):
        x, shared = line_of(rows, curve="shared", volume_ratio=ratio)
        axes.plot(*line_of(rows, curve="particle", volume_ratio=ratio), color="#0b5394", label="particle")
        axes.plot(*line_of(rows, curve="cell", volume_ratio=ratio), color="#b45f06", label="cell")
        axes.fill_between(x, shared, color="#38761d", alpha=0.3, lw=0, label="shared")
        axes.set(title=f"$V_c/V_p={ratio}$,  $V_{{p,i}}/V_p={share[position, ratio]:.2f}$", ylim=(0, None))
        axes.grid(False)
    for axes in panels[1]:
        axes.set_xlabel(r"$x/r_p$ [1]")
    for axes in panels[:, 0]:
        axes.set_ylabel(r"$G\,r_p/V_p$ [1]")
    handles, _ = panels[0, 0].get_legend_handles_labels()
    legend_below(figure, handles, 3)
    figure.suptitle(rf"Figure {number}: {WHERE[position]}, $\phi=0.4$", fontsize=9)
    return saved(figure, folder / f"gim-figure-{number}.png")


def draw_volume_ratios(rows: Rows, folder: Path) -> Path:
    figure, panels = plt.subplots(3, 2, figsize=(6.4, 7.6), sharex=True)
    for line, position in zip(panels, WHERE):
        some = [row for row in rows if row["position"] == position]
        for axes, phis in zip(line, (coarse(some), fine(some))):
            draw_family(axes, some, phis, {})
            axes.set(ylim=(-0.03, 1.05), title=WHERE[position])
        line[0].set_ylabel(SHARE)
    for axes in panels[-1]:
        axes.set_xlabel(r"$V_c/V_p$ [1]")
    legends(panels)
    figure.suptitle("Figure 6", fontsize=9)
    return saved(figure, folder / "gim-figure-6.png")


def draw_distances(rows: Rows, folder: Path) -> Path:
    figure, panels = plt.subplots(4, 2, figsize=(6.4, 9.4), sharex=True, sharey=True)
    curves = [row for row in rows if row["curve"] == "ratio"]
    for line, ratio in zip(panels, RATIOS):
        for axes, phis in zip(line, (coarse(curves), fine(curves))):
            draw_family(axes, curves, phis, {"volume_ratio": ratio})
            axes.plot(*line_of(rows, curve="cap"), color="#cc0000", lw=1.6, label="cap inside")
            axes.plot(*line_of(rows, curve="cap_as_printed"), color="#cc0000", lw=0.8, ls=":", label="Eq. 26 as printed")
            axes.set_title(f"$V_c/V_p={ratio}$")
        line[0].set_ylabel(SHARE)
    for axes in panels[-1]:
        axes.set_xlabel(r"$\psi$ [1],  $\mu=r_c+\psi r_p$")
    legends(panels)
    figure.suptitle("Figure 7", fontsize=9)
    return saved(figure, folder / "gim-figure-7.png")


def draw_coefficients(rows: Rows, folder: Path) -> Path:
    figure, axes = plt.subplots(figsize=(4.6, 3.2))
    axes.plot(*line_of(rows, curve="best"), ls="", marker="o", ms=3.5, color="#0b5394", label="best by least squares")
    axes.plot(*line_of(rows, curve="eq27"), color="#cc0000", label=r"Eq. 27: $0.579\,(V_p/V_c)^{0.132}$")
    axes.plot(*line_of(rows, curve="trend"), color="#38761d", ls="--", label="power law through the points")
    axes.set(xlabel="$V_c/V_p$ [1]", ylabel=r"$\phi$ [1]", title="Figure 8")
    axes.legend()
    return saved(figure, folder / "gim-figure-8.png")


def coarse(rows: Rows) -> list[str]:
    return sorted(phi for phi in {row["phi"] for row in rows} if float(phi) * 10 % 1 < 1e-9 or float(phi) * 10 % 1 > 1 - 1e-9)


def fine(rows: Rows) -> list[str]:
    return sorted(phi for phi in {row["phi"] for row in rows} if 0.3 <= float(phi) <= 0.5)


def draw_family(axes: plt.Axes, rows: Rows, phis: list[str], which: dict[str, str]) -> None:
    """A curve for each coefficient, from dark to light."""
    for place, phi in enumerate(phis):
        colour = plt.get_cmap("viridis")(place / len(phis))
        axes.plot(*line_of(rows, phi=phi, **which), color=colour, label=rf"$\phi={float(phi):g}$")


def legends(panels) -> None:
    """One below each column, as all of its panels have the same curves."""
    for axes, columns in zip(panels[-1], (2, 3)):
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.28), ncols=columns, fontsize=7)
