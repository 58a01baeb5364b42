#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem bench overlap: its measures on signals that are known, and what it refuses."""
from __future__ import annotations

import sys
import tempfile
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

    def test_hold_nothing_of_the_mean(self) -> None:
        # Hann's window would put half of a mean into the first line of the spectrum, at 0.5 Hz.
        self.assertAlmostEqual(overlap_series.band(TIME, 300 + wave(5, 2), 0, 3) / (5 / np.sqrt(2)), 1, delta=1e-3)


class Measures(unittest.TestCase):
    def test_are_of_the_fluidised_bed_and_its_pressures(self) -> None:
        start = TIME < 0.59  # of two seconds, of which three tenths are left out
        columns = {"time": TIME, "bed_height": np.where(start, 9.0, 0.25), "pressure_drop": np.where(start, 1e6, wave(5, 2)),
                   "pressure_45mm": wave(2, 20), "pressure_force": TIME, "pressure_iterations": TIME}
        with tempfile.TemporaryDirectory() as folder:
            rows = np.array(list(columns.values())).T
            header = ",".join(f"{name} [1]" for name in columns)
            np.savetxt(Path(folder) / "bed.csv", rows, fmt="%.17g", delimiter=",", header=header, comments="")
            measures = overlap_series.measures_of(Path(folder))
        self.assertAlmostEqual(measures.pop("bed_height"), 0.25, delta=1e-12)
        # The window is cut from the waves where it happens to be: a hundredth for the slowest.
        self.assertAlmostEqual(measures["pressure_drop_0_3_Hz"] / (5 / np.sqrt(2)), 1, delta=2e-2)
        self.assertAlmostEqual(measures["pressure_45mm_10_50_Hz"] / (2 / np.sqrt(2)), 1, delta=2e-2)
        self.assertEqual(set(measures), {f"{name}_{band}_Hz" for name in ("pressure_drop", "pressure_45mm")
                                         for band in ("0_3", "3_10", "10_50")})


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
