# SPDX-License-Identifier: BSD-3-Clause
"""Plain data that crosses the coupling border, as gimdem/coupling/Types.hpp has it. SI units."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Optional, Sequence

import numpy as np

SCHEDULES = {"serial": 1, "overlapped": 2, "iterated": 3}  # numbers on the wire
PATCH_KINDS = {"wall": 1, "open": 2, "symmetry": 3, "empty": 4, "cyclic": 5, "processor": 6}

# Components of each field of the cells.
FLUID_FIELDS = {"velocity": 3, "velocity_gradient": 9, "pressure_gradient": 3, "void_fraction_gradient": 3, "pressure": 1}
SOLID_FIELDS = {"void_fraction": 1, "momentum_source": 3, "drag_coefficient": 1, "drag_momentum": 3}


@dataclass
class ResumePoint:
    """Where a client goes on that stopped before; from a SavedCheckpoint."""

    session: int
    step: int
    time: float  # of the fluid [s]


@dataclass
class SavedCheckpoint:
    """What the server has saved."""

    session: int
    step: int  # the server's count, which goes on over restarts
    time: float  # of the particles [s]
    name: str  # of the file, without its folder


@dataclass
class ClientOptions:
    endpoint: str  # "ipc:///path/socket" or "tcp://127.0.0.1:port"
    name: str  # who we are, for messages and logs
    timeout: float = 30.0  # a peer silent for this long is dead [s]
    connect_time: float = 60.0  # how long connect() waits for a server to appear [s]
    step_time: float = 3600.0  # longest wait for the answer of a live server [s]
    schedule: Optional[str] = None  # "serial", "overlapped", "iterated"; None: the server's case file decides
    wants: Sequence[str] = ("void_fraction", "drag_coefficient", "drag_momentum")  # solid fields to receive
    iterates: bool = False  # the program calls iterate_step() if the schedule is iterated
    resume: Optional[ResumePoint] = None  # where to go on; None: a run begins
    keys: str = ""  # folder of keys, docs/security.md; empty: none, and this machine only


@dataclass
class FluidProperties:
    density: float  # [kg/m^3]
    viscosity: float  # dynamic [Pa s]


@dataclass
class Iteration:
    """How the schedule iterated repeats a step, theory.md (C.15) to (C.18)."""

    tolerance: float  # relative residual at which a step is accepted
    max_passes: int  # of a step
    relaxation: float  # factor of the first pass
    must_converge: bool  # else a step that did not is accepted as it is


@dataclass
class Welcome:
    """The server's answer to Hello."""

    server: str
    title: str
    schedule: str  # of SCHEDULES
    end_time: float  # [s]
    needs: list[str] = field(default_factory=list)  # fluid fields that this scene needs
    fluid_steps: int = 1  # equal fluid steps that a coupling step should have
    iteration: Optional[Iteration] = None  # of schedule iterated
    saves_checkpoints: bool = False  # save_checkpoint() is possible


@dataclass
class Patch:
    """A run of consecutive boundary faces."""

    name: str
    kind: str  # of PATCH_KINDS
    start_face: int
    face_count: int


@dataclass
class Mesh:
    """A polyhedral mesh in OpenFOAM's addressing: internal faces first, the normal of a face leaves its owner."""

    points: np.ndarray  # (n_points, 3) [m]
    face_offsets: np.ndarray  # (n_faces + 1,): face f has face_points[face_offsets[f]:face_offsets[f + 1]]
    face_points: np.ndarray
    owner: np.ndarray  # (n_faces,)
    neighbour: np.ndarray  # (n_internal_faces,)
    cell_count: int
    patches: list[Patch]


@dataclass
class Step:
    """One coupling step, time -> time + dt."""

    number: int  # 1, 2, ...
    time: float  # [s]
    dt: float  # [s]


@dataclass
class FluidFields:
    """The fluid at the beginning of a step; what the scene does not need may be None. velocity_gradient[cell, i, j],
    or [cell, 3 * i + j], is d(v_j)/d(x_i)."""

    velocity: Optional[np.ndarray] = None  # (n_cells, 3) [m/s]
    velocity_gradient: Optional[np.ndarray] = None  # (n_cells, 9) [1/s]
    pressure_gradient: Optional[np.ndarray] = None  # (n_cells, 3) [Pa/m]
    void_fraction_gradient: Optional[np.ndarray] = None  # (n_cells, 3) [1/m]
    pressure: Optional[np.ndarray] = None  # (n_cells,) [Pa]


@dataclass
class SolidFields:
    """What the particles do to the fluid; None where it was not asked for. The force per volume on fluid of velocity v is
    drag_momentum - drag_coefficient * v, theory.md (C.5) to (C.7)."""

    void_fraction: Optional[np.ndarray] = None  # (n_cells,), in (0, 1]
    momentum_source: Optional[np.ndarray] = None  # (n_cells, 3) [N/m^3]
    drag_coefficient: Optional[np.ndarray] = None  # (n_cells,) [kg/(m^3 s)]
    drag_momentum: Optional[np.ndarray] = None  # (n_cells, 3) [N/m^3]


@dataclass
class Monitor:
    """A named number about the last step, for logs."""

    name: str
    value: float
    unit: str = "1"


@dataclass
class Timings:
    """Where the fluid step spent its wall time."""

    compute: float = 0.0  # [s]
    output: float = 0.0  # [s]


@dataclass
class ExchangeTimes:
    """What the client measured of the coupling, summed over the run."""

    exchange: float = 0.0  # packing, sending, receiving [s]
    waiting: float = 0.0  # blocked while the server computes [s]
    bytes: float = 0.0  # sent and received
