#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench overlap: its measures on signals that are known, and what it refuses."""
from __future__ import annotations

import sys
import unittest
from pathlib import Path

import numpy as np

from front_door import FrontDoorTest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools"))

import overlap_series

TIME = np.arange(0, 2, 1e-3)


def wave(amplitude: float, frequency: float) -> np.ndarray:
    return amplitude * np.sin(2 * np.pi * frequency * TIME)


class Bands(unittest.TestCase):
    def test_hold_the_root_mean_square_of_their_waves(self) -> None:
        signal = 300 + wave(5, 20) + wave(2, 6)
        # Hann's window puts a wave into three lines of the spectrum, all of them far within the band.
        self.assertAlmostEqual(overlap_series.band(TIME, signal, 10, 50) / (5 / np.sqrt(2)), 1, delta=1e-3)
        self.assertAlmostEqual(overlap_series.band(TIME, signal, 3, 10) / (2 / np.sqrt(2)), 1, delta=1e-3)
        self.assertLess(overlap_series.band(TIME, signal, 60, 400), 1e-3)


class Departure(unittest.TestCase):
    def test_is_counted_in_standard_errors_of_two_means(self) -> None:
        # Variance 5/3 of four runs with mean 2.5; one other run at 4.5: 2 / sqrt(5/3 (1 + 1/4)).
        serial = [1.0, 2.0, 3.0, 4.0]
        self.assertAlmostEqual(overlap_series.departure([4.5], serial), 2 / np.sqrt(5 / 3 * 5 / 4), delta=1e-12)
        self.assertEqual(overlap_series.departure(serial, serial), 0)


class Refusals(FrontDoorTest):
    def test_one_bed_has_no_spread(self) -> None:
        code, _, err = self.gimdem("bench", "overlap", "--beds", "1", patience=180)
        self.assertEqual(code, 2)
        self.assertIn("--beds 1 tells no spread", err)


if __name__ == "__main__":
    unittest.main()
