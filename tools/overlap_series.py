# SPDX-License-Identifier: BSD-3-Clause
"""What two runs of one bed are compared by: mean height, and the spectrum of the pressure."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from results import BedSeries

LEFT_OUT = 0.3  # of the time: the bed is not fluidised yet
BANDS = ((0, 3), (3, 10), (10, 50))  # [Hz]: bubbles, their harmonics, the power-law fall


def measures_of(folder: Path) -> dict[str, float]:
    """Of a run: mean bed height [m], and root mean square of the pressure [Pa] in each band of frequency."""
    series = BedSeries(folder / "bed.csv")
    inside = series["time"] >= LEFT_OUT * series["time"][-1]
    measures = {"bed_height": float(series["bed_height"][inside].mean())}
    for name in ("pressure_drop", *series.beginning_with("pressure_")):
        if name in ("pressure_force", "pressure_iterations") or name not in series:
            continue
        for low, high in BANDS:
            measures[f"{name}_{low}_{high}_Hz"] = band(series["time"][inside], series[name][inside], low, high)
    return measures


def band(time: np.ndarray, values: np.ndarray, low: float, high: float) -> float:
    """Root mean square of what a signal has between two frequencies, its mean taken out: Parseval's sum over the
    spectrum of the samples, under Hann's window, whose mean square of 3/8 is taken out."""
    samples = values - values.mean()
    step = float(np.median(np.diff(time)))
    power = np.abs(np.fft.rfft(samples * np.hanning(len(samples))))**2
    frequency = np.fft.rfftfreq(len(samples), step)
    inside = (frequency > low) & (frequency <= high)
    return float(np.sqrt(2 * power[inside].sum() / (3 / 8)) / len(samples))


def departure(values: list[float], spread_of: list[float]) -> float:
    """How far the mean of some runs is from that of others, in standard errors of the difference of two such means.

    Below 2 it is what chance does. The spread is that of `spread_of`, with one degree of freedom less than runs."""
    deviation = float(np.std(spread_of, ddof=1))
    error = deviation * np.sqrt(1 / len(values) + 1 / len(spread_of))
    return float(abs(np.mean(values) - np.mean(spread_of)) / error) if error > 0 else float("inf")
