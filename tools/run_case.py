# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem run: from a case folder to results."""
from __future__ import annotations

import argparse
import signal
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import parallel
from build import build, is_built_with_cuda
from case_folder import CaseDescription, check_grid, describe, find_case_file
from clients import Program, find_client
from comeback import Comeback
from console import UserError, say, server_binary, shown
from endpoint import Endpoint
from process import how_it_ended, spawn
from record import RunRecord
from report import print_results
from restart import Restart, State, find_restart
from run_folder import copy_case, make_run_folder
from packages import setup
from supervise import Child, Outcome, Supervisor


def run(options: argparse.Namespace) -> int:
    """The whole job; returns the exit code."""
    refuse_what_is_to_come(options.client, options.device)
    case_file = find_case_file(options.case)
    setup(quiet=True)
    build(("gimdem-server",))
    case = choose(describe(case_file), options)
    client = None if case.client == "none" else find_client(case.client)
    if client:
        if client.targets:
            build(client.targets)
        client.check(case)
    endpoint = Endpoint(case.endpoint)
    try:
        return run_in_folder(case, client, options, endpoint)
    finally:
        endpoint.close()


def refuse_what_is_to_come(client: str | None, device: str) -> None:
    """Options whose meaning is settled but that nothing implements here."""
    if client == "reference":
        raise UserError("the reference client is not part of this version; use --client openfoam", 2)
    if client not in (None, "none"):
        find_client(client)
    if device == "cuda" and not is_built_with_cuda():
        raise UserError("this build computes particles on the CPU only; use --device cpu, or leave it out, or build "
                        "with CUDA as docs/gpu.md says", 2)


def check_client(case: CaseDescription, options: argparse.Namespace) -> None:
    if case.client == "none" and options.client:
        raise UserError(f"{shown(case.file)} has no fluid (client = \"none\"); leave out --client", 2)
    if case.client == "none" and options.trace:
        raise UserError(f"{shown(case.file)} has no fluid (a trace shows the steps of two programs); leave out --trace",
                        2)


def choose(case: CaseDescription, options: argparse.Namespace) -> CaseDescription:
    """The case as the command line changes it."""
    if options.grid:
        check_grid(case, options.grid)
    check_client(case, options)
    case.grid = options.grid or case.grid
    case.client = options.client or case.client
    case.schedule = options.schedule or case.schedule
    case.until = options.until or case.until
    case.grace_time = case.grace_time if options.grace_time is None else options.grace_time
    case.encodings = options.encoding or []
    case.keys = str(Path(options.keys).resolve()) if options.keys else case.keys
    case.device = options.device
    case.precision = options.precision
    refuse_what_is_to_come(case.client, "auto")
    parallel.check(options.ranks, case.client)
    return case


@dataclass
class Run:
    """One run in its folder."""

    case: CaseDescription
    client: Program | None  # None: particles alone
    folder: Path
    endpoint: Endpoint
    threads: int | None
    restart: Restart | None = None
    ranks: int = 1
    trace: list[str] = field(default_factory=list)  # options of the server

    @property
    def client_log(self) -> Path:
        return self.folder / f"log.{self.client.name if self.client else 'none'}"

    @property
    def server_log(self) -> Path:
        return self.folder / "log.server"

    def settings(self) -> dict[str, Any]:
        return {
            "case": str(self.case.file), "client": self.case.client, "grid": self.case.grid,
            "schedule": self.case.schedule, "until": self.case.until, "threads": self.threads,
            "endpoint": self.endpoint.for_client, "keys": self.case.keys, "restart": str(self.restart.checkpoint) if self.restart else None,
            "ranks": self.ranks, "grace_time": self.case.grace_time,
            "encodings": self.case.encodings or "of case.toml",
        }

    def start_server(self, stderr: int) -> subprocess.Popen[bytes]:
        command = [
            str(server_binary()), "--case", str(self.case.file), "--run", str(self.folder), "--endpoint",
            self.endpoint.address, "--until", repr(self.case.until), "--schedule", self.case.schedule,
            "--device", self.case.device,
        ]
        if self.case.precision is not None:
            command += ["--precision", self.case.precision]
        if self.threads is not None:
            command += ["--threads", str(self.threads)]
        if self.restart:
            command += ["--restart", str(self.restart.checkpoint)]
        if self.case.keys:
            command += ["--keys", self.case.keys]
        for name in self.case.encodings:
            command += ["--encoding", name]
        command += ["--grace-time", repr(self.case.grace_time), *self.trace]
        with self.server_log.open("ab") as log:
            return spawn(command, stdout=log, stderr=stderr)

    def start_client(self, scratch: parallel.Scratch, state: State | None) -> subprocess.Popen[bytes]:
        """That goes on from a state, or begins."""
        assert self.client is not None
        alone = self.client.start_command(self.folder, self.endpoint.for_client, self.case.keys)
        alone += state.options() if state else []
        command = parallel.command(alone, self.ranks)
        environment = {**self.client.environment(), "GIMDEM_CLIENT_LOG": str(self.folder / "log.client.jsonl")}
        with self.client_log.open("ab") as log:
            return spawn(command, stdout=log, stderr=subprocess.STDOUT, cwd=self.folder,
                         env=scratch.environment(environment))

    def carry_out(self) -> Outcome:
        """Both processes, to their end."""
        scratch = parallel.Scratch(self.ranks)
        try:
            if self.client is None:
                return Supervisor(self.case.timeout, "").run(self.start_server, self.endpoint.bound, None)
            supervisor = Supervisor(self.case.timeout, self.client.name, self.comeback(scratch))
            first = self.restart.state if self.restart else None
            return supervisor.run(self.start_server, self.endpoint.bound, lambda: self.start_client(scratch, first))
        finally:
            scratch.remove()


    def comeback(self, scratch: parallel.Scratch) -> Comeback | None:
        """How the client is started again if it dies; the server waits for one process only."""
        if self.case.grace_time == 0 or self.ranks > 1:
            return None
        return Comeback(self.folder, self.case.grace_time, lambda state: self.start_client(scratch, state),
                        lambda: self.client.error_in(self.client_log))


def run_in_folder(case: CaseDescription, client: Program | None, options: argparse.Namespace, endpoint: Endpoint) -> int:
    parallel.reconstruct_before_restart(case, options.restart)
    restart = find_restart(case, options.restart)
    run = Run(case, client, make_run_folder(case, options.output), endpoint, options.threads, restart, options.ranks,
              trace_options(options))
    what = "particles alone" if client is None else f"{client.name}, grid {case.grid or 'as it is'}, {case.schedule}"
    say("case", case.title)
    say("run", f"{shown(run.folder)}: {what}, until {case.until:g} s")
    copy_case(case, run.folder)
    if restart:
        restart.copy_fluid(run.folder)
        say("restart", shown(restart.checkpoint))
    if client:
        say("mesh", client.make_mesh(case, run.folder))
    if run.ranks > 1 and case.grace_time > 0:
        say("note", "a fluid on several ranks that dies is not started again (grace_time); go on with --restart latest")
    if run.ranks > 1:
        say("ranks", parallel.decompose(run.folder, run.ranks, restart))
    record = RunRecord(run.folder, run.settings())
    start = time.monotonic()
    outcome = run.carry_out()
    wall_time = time.monotonic() - start
    record.finish(in_words(outcome), wall_time, outcome.starts)
    if run.ranks > 1 and not outcome.killed:
        say("ranks", parallel.reconstruct(run.folder))
    if outcome.killed or not (outcome.good() or outcome.signal):
        raise UserError(failure(outcome, run), exit_code(outcome))
    for word in outcome.last_words:
        say("server", word)
    print_results(run.folder, wall_time)
    if outcome.signal:
        say("stopped", f"by {signal.Signals(outcome.signal).name}, before the end")
    return exit_code(outcome)


def trace_options(options: argparse.Namespace) -> list[str]:
    if not options.trace:
        return []
    return ["--trace-steps", str(options.trace_steps), "--trace-every", str(options.trace_every)]


def in_words(outcome: Outcome) -> str:
    if outcome.killed:
        return "killed"
    if outcome.good():
        return "stopped" if outcome.signal else "finished"
    return "failed"


def exit_code(outcome: Outcome) -> int:
    """0, 1, or the shell's convention for a signal."""
    if outcome.signal:
        return 128 + outcome.signal
    return 0 if outcome.good() else 1


def failure(outcome: Outcome, run: Run) -> str:
    """One message with both reasons."""
    if outcome.killed:
        return f"killed at once, as asked; what was written until then is in {shown(run.folder)}"
    first = outcome.first()
    lines = [f"the run failed: {how_it_ended(first.name, first.code)}"]
    for child in outcome.children():
        told = " ".join(outcome.last_words) if child is outcome.server else run.client.error_in(run.client_log)
        reason = told or reason_without_words(child, child is first)
        lines += [f"  {child.name}: {reason}"] if reason else []
    logs = [log for log in (run.server_log, run.client_log) if log.exists() and log.stat().st_size]
    lines += [f"  logs: {', '.join(shown(log) for log in logs)}"] if logs else []
    return "\n".join(lines)


def reason_without_words(child: Child, is_first: bool) -> str:
    """For a process that left no message; how the first one ended has been said."""
    if child.dismissed:
        return "was told to end, as its client would not come back; its last checkpoint is kept"
    if child.forced:
        return "did not notice that its peer was gone, and was ended"
    return "" if child.code == 0 or is_first else f"{how_it_ended(child.name, child.code)} without a message"
