# SPDX-License-Identifier: BSD-3-Clause
"""Read what a run left: bed.csv, summary.json, run.json."""
from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from console import UserError, shown

HEADER = re.compile(r"^(?P<name>.*?)\s*\[(?P<unit>.*)\]$")


@dataclass
class Figure:
    """A named number."""

    name: str
    value: float
    unit: str

    def __str__(self) -> str:
        return f"figure: {self.name} = {self.value:.6g} [{self.unit}]"


class BedSeries:
    """bed.csv: columns by name, each with its unit."""

    def __init__(self, file: Path) -> None:
        try:
            header, *rows = file.read_text().splitlines()
        except (OSError, ValueError):
            raise UserError(f"{shown(file)} is absent or empty (the run wrote no sample); "
                            "give the folder of another run") from None
        parsed = [HEADER.match(title) for title in header.split(",")]
        names = [match["name"] if match else title for match, title in zip(parsed, header.split(","))]
        self.units = {name: match["unit"] if match else "1" for name, match in zip(names, parsed)}
        # The last row may be cut off where the run was killed.
        complete = [row.split(",") for row in rows if row.count(",") == len(names) - 1]
        table = np.array([[number(word) for word in row] for row in complete]).reshape(-1, len(names))
        self._columns = dict(zip(names, table.T))

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name]

    def __contains__(self, name: str) -> bool:
        return name in self._columns

    def __len__(self) -> int:
        return len(self["time"])

    def names(self) -> list[str]:
        return list(self._columns)

    def beginning_with(self, stem: str) -> list[str]:
        """Columns such as pressure_45mm, for the stem "pressure_": one per plane."""
        return [name for name in self._columns if name.startswith(stem)]


def number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return float("nan")


def read_json(file: Path) -> dict[str, Any]:
    """A JSON file, empty if absent."""
    try:
        content = json.loads(file.read_text())
    except OSError:
        return {}
    except json.JSONDecodeError:
        raise UserError(f"{shown(file)} is not JSON (damaged, or not of gimdem)") from None
    return content if isinstance(content, dict) else {}


def read_summary(folder: Path) -> list[Figure]:
    """What the server summed up; empty if the run did not get so far."""
    entries = read_json(folder / "summary.json").get("figures", [])
    return [Figure(e["name"], float("nan") if e["value"] is None else float(e["value"]), e["unit"]) for e in entries]
