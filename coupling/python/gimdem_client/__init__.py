# SPDX-License-Identifier: BSD-3-Clause
"""The CFD side of a coupled run in Python: what Client.hpp is, without anything to build.

    with Client(ClientOptions(endpoint, "mySolver")) as client:
        welcome = client.connect(FluidProperties(density, viscosity))       # Hello -> Welcome
        client.send_mesh(mesh)                                # Mesh -> MeshAccepted, then the solid at t = 0
        while ...:                                            # both schedules, same loop
            solid = client.begin_step(step, fluid, monitors)  # the solid to use in this fluid step
            ...                                               # solve the fluid t -> t + dt
            client.end_step()
        client.finish("end time reached")                     # Goodbye

Needs pyzmq, protobuf, numpy and, for its first import, protoc. SI units; arrays of numpy with a row for each cell.
Each call raises CouplingError on a fault. Fields travel as plain frames, never through shared memory; one process solves the
fluid. Schedule iterated: iterate_step() between begin_step() and end_step() repeats the step. save_checkpoint() between two
steps, and ClientOptions.resume: to go on after a stop, docs/write-a-client.md, 5.
"""
from .client import Client
from .errors import CouplingError, Fault
from .types import (ClientOptions, ExchangeTimes, FluidFields, FluidProperties, Iteration, Mesh, Monitor, Patch, ResumePoint,
                    SavedCheckpoint, SolidFields, Step, Timings, Welcome)

__all__ = [
    "Client", "ClientOptions", "CouplingError", "ExchangeTimes", "Fault", "FluidFields", "FluidProperties", "Iteration",
    "Mesh", "Monitor", "Patch", "ResumePoint", "SavedCheckpoint", "SolidFields", "Step", "Timings", "Welcome",
]
