# SPDX-License-Identifier: BSD-3-Clause
"""The case of the small clients, cut down to a second, and its clients through ./gimdem."""
from __future__ import annotations

import json
import re
import shutil
import tempfile
from pathlib import Path

from front_door import ROOT, FrontDoorTest

CASE = ROOT / "cases" / "column-bed"
CLIENTS = ("column-cpp", "column-c", "column-python")


class ColumnCaseTest(FrontDoorTest):
    """self.case: column-bed, settled by the first run of this program."""

    settled = tempfile.TemporaryDirectory(prefix="gimdem-test-settled-")

    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case"
        shutil.copytree(CASE, self.case, ignore=shutil.ignore_patterns("runs", "settled"))
        shutil.copytree(self.settled.name, self.case / "settled")
        self.edit("case.toml", r"^particle_interval = .*$", "particle_interval = 0.0")

    def tearDown(self) -> None:
        if (self.case / "settled").exists():
            shutil.copytree(self.case / "settled", self.settled.name, dirs_exist_ok=True)
        super().tearDown()

    def edit(self, name: str, pattern: str, text: str) -> None:
        """Replace the one match of a pattern in a file of the case."""
        file = self.case / name
        content, count = re.subn(pattern, text, file.read_text(), flags=re.MULTILINE)
        self.assertEqual(count, 1, f"{pattern} in {name}")
        file.write_text(content)

    def run_client(self, name: str, *options: object) -> Path:
        """A run that must end well; returns its folder."""
        before = set((self.case / "runs").glob("*"))
        code, _, err = self.gimdem("run", self.case, "--client", name, *options, patience=120)
        self.assertEqual(code, 0, err)
        (folder,) = set((self.case / "runs").glob("*")) - before
        return folder

    @staticmethod
    def figures(folder: Path) -> dict[str, float]:
        summary = json.loads((folder / "summary.json").read_text())
        return {figure["name"]: figure["value"] for figure in summary["figures"]}
