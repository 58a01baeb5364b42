# SPDX-License-Identifier: BSD-3-Clause
"""Where server and client meet."""
from __future__ import annotations

import errno
import shutil
import socket
import tempfile
from pathlib import Path
from typing import Union

from console import UserError

SOCKET_PATH_LIMIT = 107  # characters of sockaddr_un, without the closing zero
Address = Union[str, tuple[str, int]]


class Endpoint:
    """The address of one run: as the case gives it, or private to the run where it says "ipc"."""

    def __init__(self, wanted: str) -> None:
        self._folder: Path | None = None
        self.address = self._private() if wanted == "ipc" else wanted
        if not self._folder:
            self._check_free()

    def _private(self) -> str:
        """A socket file in a fresh folder that only we may enter."""
        self._folder = Path(tempfile.mkdtemp(prefix="gimdem-"))
        if len(str(self._folder / "socket")) > SOCKET_PATH_LIMIT:
            self._folder.rmdir()
            self._folder = Path(tempfile.mkdtemp(prefix="gimdem-", dir="/tmp"))
        return f"ipc://{self._folder}/socket"

    def _check_free(self) -> None:
        """Somebody else's server must not get our client."""
        if self.answers():
            raise UserError(f"the endpoint {self.address} is in use (another run or program listens there); wait for "
                            "it to end, or change [coupling] endpoint in case.toml")

    def answers(self) -> bool:
        """Whether somebody listens."""
        family, address = self._socket_address()
        with socket.socket(family) as probe:
            probe.settimeout(1)
            try:
                return probe.connect_ex(address) in (0, errno.EAGAIN)
            except OSError:
                return False

    def _socket_address(self) -> tuple[int, Address]:
        if self.address.startswith("ipc://"):
            return socket.AF_UNIX, self.address[len("ipc://") :]
        host, _, port = self.address[len("tcp://") :].rpartition(":")
        try:
            return socket.AF_INET, (host, int(port))
        except ValueError:
            raise UserError(f"'{self.address}' is not an endpoint (neither ipc nor tcp://HOST:PORT); "
                            "see [coupling] endpoint in docs/user-guide.md", 2) from None

    def bound(self) -> bool:
        """Whether the server has bound it. A look at the socket file: a connection would be a peer to the server."""
        if self.address.startswith("ipc://"):
            return Path(self.address[len("ipc://") :]).exists()
        return self.answers()

    def close(self) -> None:
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
