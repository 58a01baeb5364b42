# SPDX-License-Identifier: BSD-3-Clause
"""The Python code of proto/gimdem/v1, which protoc writes when it is absent or older than what it is made from.

It lies in build/python of the repository, or where GIMDEM_PYTHON_PROTO points to.
"""
from __future__ import annotations

import fcntl
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROTO = ROOT / "proto"
FOLDER = Path(os.environ.get("GIMDEM_PYTHON_PROTO") or ROOT / "build" / "python")


def generate() -> None:
    """Bring the generated code up to date; two programs that start at once take turns."""
    sources = sorted((PROTO / "gimdem" / "v1").glob("*.proto"))
    if is_current(sources):
        return
    FOLDER.mkdir(parents=True, exist_ok=True)
    with (FOLDER / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if is_current(sources):
            return
        command = ["protoc", f"--proto_path={PROTO}", f"--python_out={FOLDER}", *map(str, sources)]
        try:
            subprocess.run(command, check=True, stdin=subprocess.DEVNULL)
        except FileNotFoundError:
            raise ImportError("protoc is absent (gimdem_client needs it once, to read proto/); run ./gimdem setup, or "
                              "install protobuf-compiler") from None


def is_current(sources: list[Path]) -> bool:
    targets = [FOLDER / "gimdem" / "v1" / f"{source.stem}_pb2.py" for source in sources]
    try:
        return all(target.stat().st_mtime >= source.stat().st_mtime for source, target in zip(sources, targets))
    except OSError:
        return False


generate()
sys.path.insert(0, str(FOLDER))
from gimdem.v1 import error_pb2, fields_pb2, session_pb2  # noqa: E402

sys.path.remove(str(FOLDER))
Envelope = session_pb2.Envelope
Error = error_pb2.Error
F64 = fields_pb2.ELEMENT_TYPE_F64
I32 = fields_pb2.ELEMENT_TYPE_I32
MAJOR = 1
MINOR = 1
