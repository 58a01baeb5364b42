# SPDX-License-Identifier: BSD-3-Clause
"""./gimdem status: how a run stands, told by its server, or by what it has written if the server is gone."""
from __future__ import annotations

import argparse
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from console import ROOT, UserError, server_binary, shown, tail_of

FOLDERS_OF_RUNS = ("runs", "*/runs", "cases/*/runs")  # where a run without --output may be, from here or the project


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("target", metavar="ENDPOINT|RUN_DIR", nargs="?",
                        help="a server's endpoint or a run folder (the newest run of a case below this folder)")
    parser.add_argument("--json", action="store_true", help="one JSON object, for programs")
    parser.add_argument("--keys", metavar="DIR", help="folder of keys, for a server that has some (those of the run)")
    parser.add_argument("--patience", metavar="S", type=float, default=5.0, help="wait for the answer so long [s] (5)")


@dataclass
class Record:
    """run.json of a run folder."""

    folder: Path
    content: dict[str, Any]

    @property
    def endpoint(self) -> str:
        return str(self.content.get("settings", {}).get("endpoint", ""))

    @property
    def keys(self) -> str:
        return str(self.content.get("settings", {}).get("keys") or "")


def run(options: argparse.Namespace) -> int:
    if options.target and "://" in options.target:
        return ask_to_terminal(options.target, options)
    record = read_record(Path(options.target)) if options.target else newest_record()
    options.keys = options.keys or record.keys
    if is_server_of(record, options):
        return ask_to_terminal(record.endpoint, options)
    print(json.dumps(as_object(record)) if options.json else as_text(record))
    return 0


def read_record(folder: Path) -> Record:
    try:
        return Record(folder.resolve(), json.loads((folder / "run.json").read_text()))
    except OSError:
        raise UserError(f"{shown(folder)} is neither an endpoint nor a run folder (it has no run.json); "
                        "give tcp://HOST:PORT, ipc:///PATH or a folder made by ./gimdem run", 2) from None
    except ValueError:
        raise UserError(f"{shown(folder / 'run.json')} cannot be read (it is damaged); ask the endpoint instead") from None


def newest_record() -> Record:
    """The newest run below the current folder, or else of the project's cases."""
    for place in (Path.cwd(), ROOT):
        files = [file for pattern in FOLDERS_OF_RUNS for file in place.glob(f"{pattern}/*/run.json")]
        if files:
            return read_record(max(files, key=lambda file: file.stat().st_mtime).parent)
    raise UserError("no run was found here; give the endpoint of a server or a run folder", 2)


def ask(endpoint: str, options: argparse.Namespace, *more: str) -> list[str]:
    if not server_binary().exists():
        raise UserError(f"{shown(server_binary())} is absent (it asks the server); run ./gimdem build")
    keys = ["--keys", options.keys] if options.keys else []
    return [str(server_binary()), "--status", endpoint, "--patience", str(options.patience), *keys, *more]


def ask_to_terminal(endpoint: str, options: argparse.Namespace) -> int:
    done = subprocess.run(ask(endpoint, options, *(["--json"] if options.json else [])), stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode != 0:
        raise UserError(done.stderr.strip().removeprefix("gimdem-server: "))
    return 0


def is_server_of(record: Record, options: argparse.Namespace) -> bool:
    """Whether a server answers at the endpoint of the run, and is its own: a tcp port may be another run's by now."""
    if record.content.get("outcome") != "running" or record.content.get("settings", {}).get("client") == "none":
        return False
    done = subprocess.run(ask(record.endpoint, options, "--json"), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return False
    folder = json.loads(done.stdout).get("folder")
    return not folder or Path(folder).resolve() == record.folder


def last_event(folder: Path) -> dict[str, Any] | None:
    """Of the server's log; its last line may be cut."""
    for line in reversed(tail_of(folder / "log.jsonl", 20).splitlines()):
        try:
            event = json.loads(line)
        except ValueError:
            continue
        if isinstance(event, dict):
            return event
    return None


def as_object(record: Record) -> dict[str, Any]:
    return {"live": False, "folder": str(record.folder), "record": record.content,
            "last_event": last_event(record.folder)}


def as_text(record: Record) -> str:
    content, event = record.content, last_event(record.folder)
    alone = content.get("settings", {}).get("client") == "none"
    outcome = content.get("outcome", "unknown")
    lines = [("run", f"{shown(record.folder)}, {outcome}, from {content.get('start')} to {content.get('end') or 'now'}")]
    if outcome == "running" and alone:
        lines.append(("server", "a run without a fluid has no endpoint to ask; this is what it has written"))
    elif outcome == "running":
        lines.append(("server", f"gone: nobody answers for this run at {record.endpoint} (it was killed, with its "
                                "launcher, or is not ready yet)"))
    if event:
        lines.append(("last", f"{event.get('time')} {event.get('event')}: {event.get('message')}"))
        speed = event.get("fields", {}).get("wall_per_simulated")
        if speed:
            lines.append(("speed", f"{speed:.3g} s per simulated second"))
    return "\n".join(f"{label:<10}{text}" for label, text in lines)
