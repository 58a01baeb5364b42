#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench noise: its measure on signals that are known, and what it refuses."""
from __future__ import annotations

import sys
import unittest
from pathlib import Path

import numpy as np

from front_door import FrontDoorTest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools"))

import noise_series

TIME = np.arange(0, 1, 1e-4)


def wave(amplitude: float, frequency: float) -> np.ndarray:
    return amplitude * np.sin(2 * np.pi * frequency * TIME)


class Roughness(unittest.TestCase):
    def test_is_that_of_the_fast_wave(self) -> None:
        # The slow one has fifty times the amplitude; Hann's window keeps what it leaks below 1e-3.
        slope = 3 * 2 * np.pi * 200 / np.sqrt(2)
        self.assertAlmostEqual(noise_series.roughness(TIME, wave(3, 200) + wave(150, 3)) / slope, 1, delta=2e-3)

    def test_leaves_out_what_is_slow(self) -> None:
        self.assertLess(noise_series.roughness(TIME, wave(1, 30)), 1e-3 * 2 * np.pi * 30)

    def test_is_the_same_whatever_the_mean(self) -> None:
        rough = noise_series.roughness(TIME, wave(3, 200))
        self.assertAlmostEqual(noise_series.roughness(TIME, 1e7 + wave(3, 200)) / rough, 1, delta=1e-6)

    def test_leaves_out_the_start(self) -> None:
        pressure = np.where(TIME < 0.19, wave(1000, 500), wave(3, 200))
        self.assertAlmostEqual(noise_series.roughness(TIME, pressure) / (3 * 2 * np.pi * 200 / np.sqrt(2)), 1, delta=2e-3)


class Refusals(FrontDoorTest):
    def test_a_time_that_is_not_positive(self) -> None:
        code, _, err = self.gimdem("bench", "noise", "--until", "-1", patience=180)
        self.assertEqual(code, 2)
        self.assertIn("--until -1.0 is not a positive time", err)

    def test_a_number_of_runs_that_is_none(self) -> None:
        code, _, err = self.gimdem("bench", "noise", "--jobs", "0", patience=180)
        self.assertEqual(code, 2)
        self.assertIn("--jobs 0 is no number of runs", err)


if __name__ == "__main__":
    unittest.main()
