# SPDX-License-Identifier: BSD-3-Clause
"""The launcher's reader of particle files against the server's writer. Argument: the program write_series."""
from __future__ import annotations

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools"))

from vtp import VtkFileError, read_particles, read_series

WRITER = sys.argv.pop(1)
COUNT = 20000


class ReaderMeetsWriter(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        subprocess.run([WRITER, cls.temporary.name], check=True)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.temporary.cleanup()

    def test_series_lists_particles_in_order_of_time(self) -> None:
        series = read_series(self.folder / "results.pvd", "particles")
        self.assertEqual([time for time, _ in series], [0.0, 0.5, 1.0])
        self.assertTrue(all(file.exists() for _, file in series))

    def test_values_are_those_written(self) -> None:
        number = np.arange(COUNT, dtype=float)  # exact in 32 bits
        for frame, (_, file) in enumerate(read_series(self.folder / "results.pvd", "particles")):
            data = read_particles(file)
            np.testing.assert_array_equal(data["position"], np.column_stack([0.5 * number, number + frame, -number]))
            np.testing.assert_array_equal(data["radius"], 0.25 * number)
            np.testing.assert_array_equal(data["velocity"], np.column_stack([number, 2 * number, 0 * number + frame]))
            np.testing.assert_array_equal(data["id"], COUNT - number)

    def test_another_file_is_refused(self) -> None:
        other = self.folder / "other.vtp"
        other.write_text("<VTKFile/>")
        with self.assertRaises(VtkFileError):
            read_particles(other)


if __name__ == "__main__":
    unittest.main()
