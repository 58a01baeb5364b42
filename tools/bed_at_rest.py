#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a bed at rest in a slow stream: its pressure drop against drag laws, and whether neighbouring cells alternate.

    tools/bed_at_rest.py RUN_DIR

The mesh must be a stack of equal layers of cells along z. For each layer the law is solved with all its cells in parallel:
one pressure gradient, each cell's flow as its own void fraction lets it, the sum of flows being what enters. The result is
summed over the layers; nothing of the run enters but the void fraction. docs/theory.md, (F.5).
"""
from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Callable

import numpy as np

from console import UserError, run_script
from results import BedSeries, Figure, read_summary
from vtp import read_cells, read_series

Law = Callable[[np.ndarray, np.ndarray], np.ndarray]


def beetstra(void: np.ndarray, reynolds: np.ndarray) -> np.ndarray:
    """F of Beetstra et al. (2007), theory.md (D.17) as printed in the paper's Eq. 10."""
    solid = 1 - void
    inertia = (1 / void + 3 * solid * void + 8.4 * reynolds**-0.343) / (
        1 + 10 ** (3 * solid) * reynolds ** (-(1 + 4 * solid) / 2))
    return 10 * solid / void**2 + void**2 * (1 + 1.5 * np.sqrt(solid)) + 0.413 * reynolds / (24 * void**2) * inertia


def ergun(void: np.ndarray, reynolds: np.ndarray) -> np.ndarray:
    """F of Ergun (1952), theory.md (F.5)."""
    return 150 * (1 - void) / (18 * void**2) + 1.75 * reynolds / (18 * void**2)


def layer_gradient(law: Law, void: np.ndarray, superficial: float, gas: dict[str, float]) -> float:
    """-dP/dz [Pa/m] that drives the mean flow `superficial` [m/s] through cells of equal area side by side."""
    void = np.minimum(void, 1 - 1e-12)

    def gradient(flow: np.ndarray) -> np.ndarray:
        reynolds = gas["density"] * flow * gas["diameter"] / gas["viscosity"]
        return 18 * gas["viscosity"] * (1 - void) * law(void, reynolds) * flow / (void * gas["diameter"] ** 2)

    def flow_at(drive: float) -> np.ndarray:
        low, high = np.full_like(void, 1e-12), np.full_like(void, 1e3)
        for _ in range(80):
            middle = np.sqrt(low * high)
            low, high = np.where(gradient(middle) < drive, middle, low), np.where(gradient(middle) < drive, high, middle)
        return low

    low, high = 1e-9, 1e7
    for _ in range(80):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if flow_at(middle).mean() < superficial else (low, middle)
    return low


def alternation(values: np.ndarray, wavelength: float = 2) -> float:
    """Amplitude of what alternates from cell to cell along the first axis, the worst of all columns.

    The projection on exp(2 pi i k / wavelength), for 2 cells on (-1)^k, under a Hann window: smooth changes cancel, an
    amplitude a that alternates gives a.
    """
    count = values.shape[0]
    window = np.hanning(count + 2)[1:-1]
    wave = np.exp(2j * np.pi * np.arange(count) / wavelength)
    return float(np.abs(np.tensordot(window * wave, values, axes=(0, 0))).max() / window.sum())


def stack(cells: dict[str, np.ndarray], name: str) -> np.ndarray:
    """A field as shape=(layers, columns, ...), layers upwards."""
    centre = cells["centre"]
    order = np.lexsort((np.round(centre[:, 0], 7), np.round(centre[:, 1], 7), np.round(centre[:, 2], 7)))
    layers = len(np.unique(np.round(centre[:, 2], 7)))
    if len(order) % layers:
        raise UserError("the cells of this run are no stack of layers along z; use a case with a hexahedral block")
    return cells[name][order].reshape(layers, len(order) // layers, *cells[name].shape[1:])


def figures_at_rest(run: Path) -> list[Figure]:
    """The figures of the last frame of a run."""
    known = {figure.name: figure.value for figure in read_summary(run)}
    gas = {"density": known["fluid_density"], "viscosity": known["fluid_viscosity"],
           "diameter": known["mean_particle_diameter"]}
    time, file = read_series(run / "results.pvd", "cells")[-1]
    cells = read_cells(file)
    void, pressure = stack(cells, "void_fraction"), stack(cells, "pressure")
    flow = stack(cells, "velocity")[:, :, 2] * void
    height = np.diff(stack(cells, "centre")[:, 0, 2]).mean()
    superficial = float(flow.mean())

    # Above the bed the gas carries nothing but itself: its static gradient.
    static = -float(stack(cells, "pressure_gradient")[-10:, :, 2].mean()) * height * len(void)
    drop = BedSeries(run / "bed.csv")["pressure_drop"][-1] - static
    laws = {law.__name__: height * sum(layer_gradient(law, layer, superficial, gas) for layer in void if layer.min() < 1)
            for law in (beetstra, ergun)}
    # Inside the bed only: at its surface pressure and flow bend, which is no alternation.
    inside = slice(2, int(0.85 * known["settled_height"] / height))
    return [
        Figure("at_rest_time", time, "s"), Figure("superficial_velocity", superficial, "m/s"),
        Figure("at_rest_pressure_drop", drop, "Pa"),
        Figure("beetstra_pressure_drop", laws["beetstra"], "Pa"), Figure("ergun_pressure_drop", laws["ergun"], "Pa"),
        Figure("at_rest_to_beetstra", drop / laws["beetstra"], "1"),
        Figure("pressure_alternation", alternation(pressure[inside]) / drop, "1"),
        Figure("flow_alternation", alternation(flow[inside]) / superficial, "1"),
        # A checkerboard would stand out among its neighbours; the true scatter of the bed dies away towards two cells.
        Figure("flow_wave_of_2.2_cells", alternation(flow[inside], 2.2) / superficial, "1"),
        Figure("flow_wave_of_2.5_cells", alternation(flow[inside], 2.5) / superficial, "1"),
        Figure("void_fraction_alternation", alternation(void[inside]), "1"),
    ]


if __name__ == "__main__":
    sys.exit(run_script(__doc__, (1,), lambda run: figures_at_rest(Path(run)), sys.argv[1:]))
