# SPDX-License-Identifier: BSD-3-Clause
"""The one exception of the client."""
from __future__ import annotations

import enum


class Fault(enum.Enum):
    """Why a session ended; numbers of FaultKind on the wire."""

    USER = 1  # wrong options or an illegal call: nothing was sent, the session goes on
    VERSION = 2  # the peers speak different protocols
    PROTOCOL = 3  # a message that is malformed or not allowed in this state
    MESH = 4  # the mesh was refused
    TIMEOUT = 5  # the peer was silent, or did not answer in time
    PEER = 6  # the peer reported an error or disappeared
    ENDPOINT = 7  # the address cannot be reached or is not allowed


class CouplingError(Exception):
    """Tells the problem, why it is one, and what to do."""

    def __init__(self, fault: Fault, text: str) -> None:
        super().__init__(text)
        self.fault = fault
