# SPDX-License-Identifier: BSD-3-Clause
"""A small bed, cut out of cases/wachem-bed, that the real server and the real client run in seconds."""
from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

from front_door import ROOT, FrontDoorTest

WACHEM = ROOT / "cases" / "wachem-bed"


class RealCaseTest(FrontDoorTest):
    """self.case: the bed with 300 particles, not settled; the mesh and all else as in wachem-bed."""

    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case"
        shutil.copytree(WACHEM, self.case, ignore=shutil.ignore_patterns("runs", "settled", "meshes"))
        self.case_file = self.case / "case.toml"
        self.edit(r"^(mass|count) = .*$", "count = 300")
        self.edit(r"^duration = .*$", "duration = 0.0")
        self.edit(r"^timeout = .*$", "timeout = 3.0")
        dictionary = self.case / "constant" / "couplingProperties"
        dictionary.write_text(dictionary.read_text().replace("timeout     30;", "timeout     3;"))
        self.run_folder = self.case / "runs" / "0001"

    def edit(self, pattern: str, text: str) -> None:
        """Replace the one match of a pattern in case.toml."""
        content, count = re.subn(pattern, text, self.case_file.read_text(), flags=re.MULTILINE)
        self.assertEqual(count, 1, f"{pattern} in case.toml")
        self.case_file.write_text(content)

    def line_of(self, text: str) -> int:
        """Number of the first line of case.toml that contains `text`."""
        lines = self.case_file.read_text().splitlines()
        return next(number for number, line in enumerate(lines, 1) if text in line)

    def rows(self, folder: Path) -> int:
        """Samples in bed.csv."""
        try:
            return max(0, len((folder / "bed.csv").read_text().splitlines()) - 1)
        except OSError:
            return 0

    def figures(self, folder: Path) -> dict[str, float]:
        summary = json.loads((folder / "summary.json").read_text())
        return {figure["name"]: figure["value"] for figure in summary["figures"]}
