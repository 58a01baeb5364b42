# SPDX-License-Identifier: BSD-3-Clause
"""How rough a signal of a run is."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from results import BedSeries

LOWEST = 50.0  # [Hz]
LEFT_OUT = 0.2  # of the time: the bed is not fluidised yet


def roughness_of(folder: Path, names: tuple[str, ...]) -> dict[str, float]:
    series = BedSeries(folder / "bed.csv")
    return {name: roughness(series["time"], series[name]) for name in names}


def roughness(time: np.ndarray, pressure: np.ndarray) -> float:
    """Standard deviation of dp/dt [Pa/s] from the frequencies above 50 Hz, after the start-up.

    By Parseval's sum over the spectrum of the samples, under Hann's window, whose mean square of 3/8 is taken out."""
    inside = time >= LEFT_OUT * time[-1]
    samples = pressure[inside] - pressure[inside].mean()
    step = float(np.median(np.diff(time[inside])))
    spectrum = np.fft.rfft(samples * np.hanning(len(samples)))
    frequency = np.fft.rfftfreq(len(samples), step)
    slope = np.where(frequency > LOWEST, 2 * np.pi * frequency * np.abs(spectrum), 0.0)
    return float(np.sqrt(2 * np.sum(slope**2) / (3 / 8)) / len(samples))
