# SPDX-License-Identifier: BSD-3-Clause
"""How fields travel, by the case file and by ./gimdem run --encoding, and what the summary tells of it."""
from __future__ import annotations

import unittest

from column_case import ColumnCaseTest


class Encodings(ColumnCaseTest):
    def run_with(self, *options: str) -> tuple[float, bytes, int]:
        """Bytes per step, the last checkpoint, and the number of cells without particles at the end."""
        folder = self.run_client("column-c", "--until", "0.02", *options)
        last = sorted((folder / "checkpoints").iterdir())[-1]
        void_fractions = [float(line.split(",")[1]) for line in (folder / "profile.csv").read_text().splitlines()[1:]]
        return self.figures(folder)["bytes_per_step"], last.read_bytes(), void_fractions.count(1.0)

    def test_bytes_per_step_tell_what_was_chosen(self) -> None:
        self.edit("case.toml", r"^timeout = ", 'encodings = ["dense"]\ntimeout = ')
        dense, whole, empty = self.run_with()
        sparse, same, _ = self.run_with("--encoding", "sparse")
        rounded, other, _ = self.run_with("--encoding", "dense,float32")
        print(f"figure: column_bytes_dense = {dense:.6g} [B]\nfigure: column_bytes_sparse = {sparse:.6g} [B]\n"
              f"figure: column_bytes_float32 = {rounded:.6g} [B]")
        # 19 numbers of the fluid and 5 of the solid in each of 15 cells; twenty fluids and twenty-one solids. The
        # envelopes differ by the names of the types and by runs of cells, some ten bytes a message.
        self.assertLess(abs(dense - rounded - 4 * 15 * (19 + 5 * 21 / 20)), 20)
        # Sparse leaves out the cells without particles; the fluid travels for those beside particles too, two at most.
        self.assertGreater(dense - sparse, 8 * 24 * (empty - 2))
        self.assertLess(dense - sparse, 8 * 24 * (empty + 1))
        self.assertEqual(same, whole, "sparse is the same to the bit")
        self.assertNotEqual(other, whole, "float32 rounds")

    def test_mistakes_are_told(self) -> None:
        for text, part in (("sparce", "there is no 'sparce'"), ("sparse,dense", "exclude each other"), ("", "there is no ''")):
            code, _, err = self.gimdem("run", self.case, "--encoding", text)
            self.assertEqual(code, 2, err)
            self.assert_one_error(err, part)
        self.edit("case.toml", r"^timeout = ", 'encodings = ["sparce"]\ntimeout = ')
        code, _, err = self.gimdem("run", self.case)
        self.assertEqual(code, 1, err)
        self.assert_one_error(err, 'did you mean "sparse"?')


if __name__ == "__main__":
    unittest.main()
