# SPDX-License-Identifier: BSD-3-Clause
"""Arrays in and out of messages, and the checks of docs/protocol.md: nothing off the wire is used before."""
from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import CouplingError, Fault
from .types import PATCH_KINDS, ClientOptions, Mesh
from .wire import F64, I32, MAJOR, Envelope

LOOPBACK = re.compile(r"tcp://(127\.\d{1,3}\.\d{1,3}\.\d{1,3}|localhost|\[::1\]):\d{1,5}")
ANYWHERE = re.compile(r"tcp://[^\s/]+:\d{1,5}")  # with keys
LONGEST_PATH = 107  # of a socket file
MIN_TIMEOUT = 0.1  # [s]


def user_fault(text: str) -> CouplingError:
    return CouplingError(Fault.USER, text)


def check_options(options: ClientOptions) -> None:
    endpoint = options.endpoint
    anywhere = options.keys and ANYWHERE.fullmatch(endpoint)
    if not LOOPBACK.fullmatch(endpoint) and not anywhere:
        if not endpoint.startswith("ipc://") or not 0 < len(endpoint) - len("ipc://") <= LONGEST_PATH:
            raise CouplingError(Fault.ENDPOINT, f'endpoint "{endpoint}" is no endpoint, or not of this machine (which takes keys); write '
                                "ipc:///path/of/socket (at most 107 characters) or tcp://127.0.0.1:port")
    if not options.name or len(options.name.encode()) > 256:
        raise user_fault("ClientOptions.name is empty or longer than 256 bytes; give the name of your solver")
    for name in ("timeout", "connect_time", "step_time"):
        if not MIN_TIMEOUT <= getattr(options, name) < float("inf"):
            raise user_fault(f"ClientOptions.{name} is {getattr(options, name)} (at least {MIN_TIMEOUT} s)")


def add_array(envelope: Envelope, frames: list[Any], name: str, values: np.ndarray, components: int) -> None:
    """Adds one array; `values` is contiguous, of type f8 or i4."""
    header = envelope.arrays.add()
    header.name = name
    header.type = F64 if values.dtype == np.dtype("<f8") else I32
    header.components = components
    header.count = values.size // components
    header.dense = True
    frames.append(values.tobytes())  # a copy: the program may change its array before it has left


def add_mesh(envelope: Envelope, frames: list[Any], mesh: Mesh) -> None:
    envelope.mesh.cell_count = mesh.cell_count
    for patch in mesh.patches:
        if patch.kind not in PATCH_KINDS:
            raise user_fault(f'patch "{patch.name}" has kind "{patch.kind}"; choose one of {", ".join(PATCH_KINDS)}')
        envelope.mesh.patches.add(name=patch.name, kind=PATCH_KINDS[patch.kind], start_face=patch.start_face,
                                  face_count=patch.face_count)
    points = np.ascontiguousarray(mesh.points, "<f8")
    if points.size % 3 or not np.isfinite(points).all():
        raise user_fault("Mesh.points is not finite, or has not 3 numbers for each point")
    add_array(envelope, frames, "points", points, 3)
    for name in ("face_offsets", "face_points", "owner", "neighbour"):
        add_array(envelope, frames, name, np.ascontiguousarray(getattr(mesh, name), "<i4"), 1)


def add_fields(envelope: Envelope, frames: list[Any], fields: Any, names: Mapping[str, int], cell_count: int) -> None:
    """The fields that the server needs, at their full size and finite."""
    for name, components in names.items():
        given = getattr(fields, name)
        values = np.ascontiguousarray(() if given is None else given, "<f8")
        if values.size != cell_count * components:
            raise user_fault(f'field "{name}" has {values.size} numbers (the mesh has {cell_count} cells, {components} '
                             f"each, so {cell_count * components}); pass the whole field, the peer needs it")
        if not np.isfinite(values).all():
            raise user_fault(f'field "{name}" has a number that is not finite (the solution has diverged); try a '
                             "smaller time step")
        add_array(envelope, frames, name, values, components)


def check_version(envelope: Envelope) -> None:
    if envelope.protocol_major == MAJOR:
        return
    said = f"; it said: {envelope.error.reason}" if envelope.WhichOneof("kind") == "error" else ""
    raise CouplingError(Fault.VERSION, f"the peer speaks protocol {envelope.protocol_major}.{envelope.protocol_minor} "
                        f"and this side speaks {MAJOR} (the first number must be the same); update the older side{said}")


def read_fields(envelope: Envelope, frames: list[bytes], names: Mapping[str, int], cell_count: int) -> dict[str, Any]:
    """The arrays of a SolidState: exactly those of `names`, each checked. Raises ValueError."""
    if len(envelope.arrays) != len(frames) or sorted(header.name for header in envelope.arrays) != sorted(names):
        raise ValueError(f"arrays {[header.name for header in envelope.arrays]} in {len(frames)} frames instead of "
                         f"{list(names)}")
    fields = {}
    for header, frame in zip(envelope.arrays, frames):
        shape = (cell_count, names[header.name])
        if header.type != F64 or (header.count, header.components) != shape or not header.dense or header.shared:
            raise ValueError(f'array "{header.name}" of {header.count} rows of {header.components} components')
        if len(frame) != 8 * shape[0] * shape[1]:
            raise ValueError(f'array "{header.name}" has {len(frame)} bytes (a truncated or padded frame)')
        values = np.frombuffer(frame, "<f8")
        if not np.isfinite(values).all():
            raise ValueError(f'field "{header.name}" has a number that is not finite')
        fields[header.name] = values.reshape(shape) if shape[1] > 1 else values
    return fields
