# SPDX-License-Identifier: BSD-3-Clause
"""How fields travel, by the case file and by ./gimdem run --encoding, and what the summary tells of it."""
from __future__ import annotations

import unittest

from column_case import ColumnCaseTest


class Encodings(ColumnCaseTest):
    def bytes_of(self, *options: str) -> tuple[float, str]:
        """Bytes per step, and the last checkpoint."""
        folder = self.run_client("column-c", "--until", "0.02", *options)
        last = sorted((folder / "checkpoints").iterdir())[-1]
        return self.figures(folder)["bytes_per_step"], last.read_bytes().hex()

    def test_bytes_per_step_tell_what_was_chosen(self) -> None:
        self.edit("case.toml", r"^timeout = ", 'encodings = ["dense"]\ntimeout = ')
        dense, whole = self.bytes_of()
        sparse, same = self.bytes_of("--encoding", "sparse")
        rounded, other = self.bytes_of("--encoding", "dense,float32")
        print(f"figure: column_bytes_dense = {dense:.6g} [B]\nfigure: column_bytes_sparse = {sparse:.6g} [B]\n"
              f"figure: column_bytes_float32 = {rounded:.6g} [B]")
        # 15 cells, of which the settled bed fills 6 or 7: of 19 fluid and 5 solid numbers per cell, all travel or those of these
        # cells; the envelopes of the two messages are the same but for the runs of cells.
        self.assertLess(sparse, dense)
        self.assertLess(rounded, dense)
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
