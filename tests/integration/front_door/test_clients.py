# SPDX-License-Identifier: BSD-3-Clause
"""The small clients of cfd-client/examples with the real server: swapped by one word, equal to the last bit, and right."""
from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from front_door import ROOT, FrontDoorTest

sys.path.insert(0, str(ROOT / "tools"))
from clients import find_client  # noqa: E402

CASE = ROOT / "cases" / "column-bed"
BUILD = Path(os.environ.get("GIMDEM_BUILD_DIR") or ROOT / "build" / "release")
CLIENTS = ("column-cpp", "column-c", "column-python")
GRAVITY = 9.81  # [m/s^2]


class Clients(FrontDoorTest):
    settled = tempfile.TemporaryDirectory(prefix="gimdem-test-settled-")  # the bed of the first run, for the later ones

    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case"
        shutil.copytree(CASE, self.case, ignore=shutil.ignore_patterns("runs", "settled"))
        shutil.copytree(self.settled.name, self.case / "settled")
        self.settings = {line.split()[0]: float(line.split()[1]) for line in self.lines("constant/column")}

    def tearDown(self) -> None:
        shutil.copytree(self.case / "settled", self.settled.name, dirs_exist_ok=True)
        super().tearDown()

    def lines(self, name: str) -> list[str]:
        return [line for line in (self.case / name).read_text().splitlines() if line and not line.startswith("#")]

    def set(self, **values: float) -> None:
        """Change constant/column."""
        self.settings.update(values)
        text = "".join(f"{name} {value!r}\n" for name, value in self.settings.items())
        (self.case / "constant" / "column").write_text(text)

    def run_pair(self, name: str, until: float, schedule: str = "serial") -> Path:
        """Server and client, started as the launcher does it, without its plots; returns the run folder."""
        folder = self.folder / f"{schedule} run of {name}"
        shutil.copytree(self.case / "constant", folder / "constant")
        endpoint = f"ipc://{self.folder}/{name}.socket"
        command = [BUILD / "bin" / "gimdem-server", "--case", self.case / "case.toml", "--run", folder, "--endpoint",
                   endpoint, "--until", str(until), "--schedule", schedule]
        with (folder / "log.server").open("w") as log:
            server = subprocess.Popen([str(word) for word in command], stdout=log, stderr=log)
        try:
            client = subprocess.run(find_client(name).start_command(folder, endpoint, ""), capture_output=True, text=True,
                                    timeout=200)
            self.assertEqual(client.returncode, 0, client.stderr)
            self.assertEqual(server.wait(60), 0, (folder / "log.server").read_text())
        finally:
            server.kill()
            server.wait()
        return folder

    @staticmethod
    def table(file: Path) -> dict[str, list[float]]:
        with file.open() as lines:
            rows = list(csv.reader(lines))
        return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}

    def mean(self, values: list[float]) -> float:
        return sum(values) / len(values)

    def test_all_give_the_same_bits_and_carry_the_bed(self) -> None:
        until = 0.25  # the bed is fluidised since 0.16 s
        folders = [self.run_pair(name, until) for name in CLIENTS]
        one = self.table(folders[0] / "column.csv")
        self.assertEqual(len(one["time"]), 250)
        for folder in folders[1:]:
            # The same operations in the same order: the particles, which amplify any rounding, would show a difference.
            self.assertEqual(self.table(folder / "column.csv"), one)
            self.assertEqual(self.table(folder / "profile.csv"), self.table(folders[0] / "profile.csv"))
        self.check_forces(folders[0], one)

    def check_forces(self, folder: Path, column: dict[str, list[float]]) -> None:
        """Newton's third law over the column: what the gas loses in pressure bears the gas and the beads.

        From F.2 without inertia, summed over the cells: drop = (drag + pressure force on the beads) / area +
        density g * sum(alpha V) / area.
        """
        bed = self.table(folder / "bed.csv")
        area = self.settings["width"] * self.settings["depth"]
        beads = 400 * 3.141592653589793 / 6 * 2e-3**3  # [m^3]
        gas = self.settings["density"] * GRAVITY * (area * self.settings["height"] - beads) / area
        drop = self.mean(column["pressure_drop"])
        borne = self.mean([(a + b) / area for a, b in zip(bed["drag_force [N]"], bed["pressure_force [N]"])][1:]) + gas
        print(f"figure: column_pressure_drop = {drop:.6g} [Pa]\nfigure: column_borne = {borne:.6g} [Pa]")
        # The server's forces are means over a step, with the gas of its beginning: 1 % is 3 steps of the ramp's 200.
        self.assertLess(abs(drop / borne - 1), 0.01)
        # In a column of constant volume as much gas leaves as comes in; a few roundings of 1 m/s.
        worst = max(abs(a - b) for a, b in zip(column["inflow"], column["outflow"]))
        self.assertLess(worst, 1e-13)

    def test_overlapped(self) -> None:
        one, other = (self.table(self.run_pair(name, 0.03, "overlapped") / "column.csv")
                      for name in ("column-c", "column-python"))
        self.assertEqual(one, other)

    def test_fixed_bed_has_the_pressure_drop_of_the_drag_law(self) -> None:
        self.set(inflow=0.3, ramp_time=0.02)
        folder = self.run_pair("column-cpp", 0.06)
        profile = self.table(folder / "profile.csv")
        height = self.settings["height"] / self.settings["cells"]
        law = sum(height * self.beetstra(alpha, 0.3) for alpha in profile["void_fraction"])
        drop = self.table(folder / "column.csv")["pressure_drop"][-1]
        static = self.settings["density"] * GRAVITY * self.settings["height"]
        print(f"figure: fixed_bed_pressure_drop = {drop - static:.6g} [Pa]\nfigure: fixed_bed_law = {law:.6g} [Pa]")
        # The law at each bead takes the void fraction carried to it, the reference that of its cell: 3 % in
        # cases/bed-at-rest; the surface is a fifth of this bed, which is 22 mm high.
        self.assertLess(abs((drop - static) / law - 1), 0.06)

    def beetstra(self, alpha: float, superficial: float) -> float:
        """Pressure gradient of a uniform bed, theory.md F.5 [Pa/m]; Beetstra et al., AIChE J. 53 (2007) 489, eq. 21."""
        solid, diameter = 1 - alpha, 2e-3
        if solid < 1e-12:
            return 0.0
        reynolds = self.settings["density"] * superficial * diameter / self.settings["viscosity"]
        rise = (1 / alpha + 3 * solid * alpha + 8.4 * reynolds**-0.343) / (
            1 + 10 ** (3 * solid) * reynolds ** (-(1 + 4 * solid) / 2))
        drag = (10 * solid / alpha**2 + alpha**2 * (1 + 1.5 * solid**0.5) + 0.413 * reynolds / (24 * alpha**2) * rise)
        return 18 * self.settings["viscosity"] * solid * drag * superficial / (alpha * diameter**2)

    def test_any_program_can_be_the_client(self) -> None:
        mine = self.folder / "my-solver"
        mine.write_text(f'#!/bin/sh\nexec "{BUILD}/bin/column-cpp" "$@"\n')
        mine.chmod(0o755)
        folder = self.folder / "run of mine"
        code, _, err = self.gimdem("run", self.case, "--client", mine, "--until", "0.002", "--output", folder)
        self.assertEqual(code, 0, err)
        self.assertTrue((folder / "log.my-solver").exists())
        self.assertEqual(len(self.table(folder / "column.csv")["time"]), 2)

    def test_failure_of_the_client_is_told(self) -> None:
        for name in CLIENTS[1:]:
            (self.case / "constant" / "column").rename(self.case / "constant" / "away")
            code, _, err = self.gimdem("run", self.case, "--client", name)
            self.assertEqual(code, 1, err)
            self.assert_one_error(err, f"{name} ended with code 1", "constant/column")
            (self.case / "constant" / "away").rename(self.case / "constant" / "column")

    def test_unknown_client_is_refused(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--client", "coulmn")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "coulmn", "column-cpp")
        code, _, err = self.gimdem("run", self.case, "--client", "./absent")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "absent is not a program")


if __name__ == "__main__":
    unittest.main()
