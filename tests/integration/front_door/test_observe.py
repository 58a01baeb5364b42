# SPDX-License-Identifier: BSD-3-Clause
"""Watching a run: trace.json, the structured logs and ./gimdem status, with the real pair."""
from __future__ import annotations

import json
import os
import shutil
import signal
import unittest
from pathlib import Path
from typing import Any

from front_door import ROOT
from real_case import RealCaseTest

PATIENCE = 150.0  # with a run on a machine whose cores are busy [s]
ROUNDING = 2.1e-3  # of two times written to 0.001 microseconds, and their difference [us]
SERVER, CLIENT = 1, 2


def events_of(file: Path) -> list[dict[str, Any]]:
    """Of a trace, whole or of a run that was killed: as Perfetto does, the closing bracket may be absent."""
    text = file.read_text().rstrip()
    return json.loads(text if text.endswith("]") else text + "]")


def lines_of(file: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in file.read_text().splitlines()]


class Traces(RealCaseTest):
    def slices(self, process: int) -> list[dict[str, Any]]:
        found = [event for event in events_of(self.run_folder / "trace.json")
                 if event["ph"] == "X" and event["pid"] == process]
        return sorted(found, key=lambda event: (event["ts"], -event["dur"]))

    def check_nested(self, process: int) -> None:
        """Steps do not overlap, and each part lies within its step, one after the other."""
        last_step, last_part = -1e300, -1e300
        for event in self.slices(process):
            end = event["ts"] + event["dur"]
            if event["name"] == "step":
                self.assertGreaterEqual(event["ts"], last_step - ROUNDING)
                number, last_step, last_part = event["args"]["step"], end, event["ts"]
            else:
                self.assertEqual(event["args"]["step"], number)
                self.assertGreaterEqual(event["ts"], last_part - ROUNDING, event)
                self.assertLessEqual(end, last_step + ROUNDING, event)
                last_part = end

    def sum_of(self, process: int, name: str) -> float:
        """Length of all slices of that name [s]."""
        return 1e-6 * sum(event["dur"] for event in self.slices(process) if event["name"] == name)

    def check(self, schedule: str) -> None:
        code, _, err = self.gimdem("run", self.case, "--until", "0.002", "--schedule", schedule, "--trace",
                                   patience=PATIENCE)
        self.assertEqual(code, 0, err)
        for process in (SERVER, CLIENT):
            self.check_nested(process)
            steps = [event["args"]["step"] for event in self.slices(process) if event["name"] == "step"]
            self.assertEqual(steps, list(range(1, 21)))
        figures = self.figures(self.run_folder)
        wall = figures["wall_time"]
        for process, name, figure in ((SERVER, "DEM", "share_dem"), (SERVER, "mapping", "share_mapping"),
                                      (SERVER, "output", "share_output")):
            # 20 slices, each written to a nanosecond.
            self.assertAlmostEqual(self.sum_of(process, name), figures[figure] * wall, delta=1e-7, msg=name)
        # The summary has 19 steps of the client: the last one's numbers come with Goodbye.
        last = {event["name"]: 1e-6 * event["dur"] for event in self.slices(CLIENT) if event["args"]["step"] == 20}
        self.assertAlmostEqual(self.sum_of(CLIENT, "CFD") - last["CFD"], figures["share_cfd"] * wall, delta=1e-7)
        self.check_order(schedule)
        counters = {event["name"] for event in events_of(self.run_folder / "trace.json") if event["ph"] == "C"}
        self.assertEqual(counters, {"void_fraction_min", "courant_max", "particle_steps_per_second"})
        self.assertGreater(figures["trace_cost"], 0)

    def check_order(self, schedule: str) -> None:
        """Both rows are on one clock: in a serial run the particles move while the client waits."""
        begin = {(event["pid"], event["name"], event["args"]["step"]): event["ts"]
                 for process in (SERVER, CLIENT) for event in self.slices(process)}
        for step in range(1, 21):
            moves = begin[(SERVER, "DEM", step)]
            self.assertGreater(moves, begin[(CLIENT, "step", step)])
            if schedule == "serial":
                self.assertGreater(begin[(CLIENT, "CFD", step)], begin[(SERVER, "mapping", step)])

    def test_serial(self) -> None:
        self.check("serial")

    def test_overlapped(self) -> None:
        self.check("overlapped")

    def test_every_fifth_step_and_three_of_them(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--until", "0.002", "--trace", "--trace-every", "5",
                                   "--trace-steps", "3", patience=PATIENCE)
        self.assertEqual(code, 0, err)
        for process in (SERVER, CLIENT):
            steps = [event["args"]["step"] for event in self.slices(process) if event["name"] == "step"]
            self.assertEqual(steps, [1, 6, 11])

    def test_none_unless_asked_for(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--until", "0.0003", patience=PATIENCE)
        self.assertEqual(code, 0, err)
        self.assertFalse((self.run_folder / "trace.json").exists())
        self.assertNotIn("trace_cost", self.figures(self.run_folder))


class Logs(RealCaseTest):
    def test_both_sides_are_on_one_clock(self) -> None:
        code, _, err = self.gimdem("run", self.case, "--until", "0.0005", patience=PATIENCE)
        self.assertEqual(code, 0, err)
        server = lines_of(self.run_folder / "log.jsonl")
        client = lines_of(self.run_folder / "log.client.jsonl")
        for line in server + client:
            self.assertEqual(set(line), {"time", "elapsed", "side", "level", "event", "message", "fields"})
            self.assertRegex(line["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{6}Z$")
            self.assertEqual(line["level"], "info")
        self.assertEqual({line["side"] for line in server}, {"server"})
        self.assertEqual({line["side"] for line in client}, {"client"})
        at = {(line["side"], line["event"]): line["elapsed"] for line in server + client}
        order = [("server", "listening"), ("server", "client_connected"), ("client", "mesh_accepted"),
                 ("client", "finished"), ("server", "finished")]
        times = [at[key] for key in order]
        self.assertEqual(times, sorted(times), order)
        self.assertGreater(at[("client", "connected")], at[("server", "listening")])
        fields = next(line for line in client if line["event"] == "connected")["fields"]
        self.assertEqual((fields["clock_offset_s"], fields["clock_uncertainty_s"]), (0, 0))


class Status(RealCaseTest):
    def start_running(self):
        process = self.start("run", self.case, "--until", "50", "--trace")
        self.wait_until(lambda: self.rows(self.run_folder) > 3 or process.poll() is not None, "samples", PATIENCE)
        self.assertIsNone(process.poll(), process.stderr.read() if process.poll() is not None else "")
        return process

    def pids(self, program: str) -> list[int]:
        return [pid for pid in self.processes() if os.readlink(f"/proc/{pid}/exe").endswith(f"/{program}")]

    def status(self, *target: object) -> dict[str, Any]:
        code, out, err = self.gimdem("status", *target, "--json")
        self.assertEqual(code, 0, err)
        return json.loads(out)

    def test_of_a_live_run_a_killed_one_and_none(self) -> None:
        code, _, err = self.gimdem("status", self.case)
        self.assertEqual(code, 2)
        self.assert_one_error(err, "neither an endpoint nor a run folder")

        process = self.start_running()
        first = self.status(self.run_folder)
        self.assertTrue(first["live"])
        self.assertEqual(first["folder"], str(self.run_folder.resolve()))
        self.assertEqual(first["client"], "gimdemFoam")
        self.assertEqual(first["activity"], "coupled steps")
        self.assertEqual(first["end_time_s"], 50)
        self.assertIn(first["state"], ("ready", "computing"))
        figures = {figure["name"]: figure["value"] for figure in first["figures"]}
        self.assertEqual(figures["particles"], 300)
        self.assertTrue(0 < figures["void_fraction_min"] < figures["void_fraction_max"] <= 1)
        self.assertLess(figures["momentum_imbalance"], 1e-12)
        self.assertGreater(figures["courant_max"], 0)
        self.assertGreater(first["memory_bytes"], 1e6)
        self.wait_until(lambda: self.status(self.run_folder)["steps_per_second"], "a speed")
        endpoint = json.loads((self.run_folder / "run.json").read_text())["settings"]["endpoint"]
        second = self.status(endpoint)
        self.assertGreater(second["step"], first["step"])
        self.assertGreater(second["time_left_s"], 0)

        # In words, of the newest run below the current folder, which is ours.
        code, out, err = self.gimdem("status")
        self.assertEqual(code, 0, err)
        self.assertIn("gimdem-server", out)
        self.assertRegex(out, r"momentum_imbalance = \S+ \[1\]")

        for pid in (process.pid, *self.pids("gimdem-server"), *self.pids("gimdemFoam")):
            os.kill(pid, signal.SIGKILL)
        process.communicate()
        self.wait_until(lambda: not self.processes(), "the end of all")
        gone = self.status(self.run_folder)
        self.assertFalse(gone["live"])
        self.assertEqual(gone["record"]["outcome"], "running")
        self.assertIn("elapsed", gone["last_event"])
        code, out, _ = self.gimdem("status", self.run_folder)
        self.assertEqual(code, 0)
        self.assertIn("gone: nobody answers", out)
        code, _, err = self.gimdem("status", endpoint)
        self.assertEqual(code, 1)
        self.assert_one_error(err, "nobody listens at")

        # What the killed run has traced can be read.
        self.assertFalse((self.run_folder / "trace.json").read_text().rstrip().endswith("]"))
        steps = {event["args"]["step"] for event in events_of(self.run_folder / "trace.json") if event["ph"] == "X"}
        self.assertGreater(len(steps), 3)
        for folder in (self.folder / "tmp").iterdir():  # the launcher could not tidy up
            for file in folder.iterdir():
                file.unlink()
            folder.rmdir()

    def test_of_a_run_without_a_fluid(self) -> None:
        case = self.folder / "alone"
        case.mkdir()
        shutil.copy(ROOT / "cases" / "settling-bed" / "case.toml", case)
        code, _, err = self.gimdem("run", case, "--until", "0.001", patience=PATIENCE)
        self.assertEqual(code, 0, err)
        status = self.status(case / "runs" / "0001")
        self.assertFalse(status["live"])
        self.assertEqual(status["record"]["outcome"], "finished")
        self.assertEqual(status["last_event"]["event"], "finished")
        code, _, err = self.gimdem("run", case, "--until", "0.001", "--trace")
        self.assertEqual(code, 2)
        self.assert_one_error(err, "has no fluid", "leave out --trace")


if __name__ == "__main__":
    unittest.main()
