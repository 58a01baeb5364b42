# SPDX-License-Identifier: BSD-3-Clause
"""Where server and client meet."""
from __future__ import annotations

import errno
import shutil
import socket
import tempfile
from pathlib import Path

from console import UserError

SOCKET_PATH_LIMIT = 107  # characters of sockaddr_un, without the closing zero
LISTENING = "0A"  # TCP_LISTEN of <netinet/tcp.h>, as /proc/net/tcp has it
ALL = {"*": "127.0.0.1", "0.0.0.0": "127.0.0.1", "[::]": "[::1]"}  # addresses of this machine, and one where it answers


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

    @property
    def for_client(self) -> str:
        """Where a client on this machine finds the server."""
        if self._is_file():
            return self.address
        host, port = self._host_and_port()
        return f"tcp://{ALL.get(host, host)}:{port}"

    def answers(self) -> bool:
        """Whether somebody listens."""
        try:
            if self._is_file():
                with socket.socket(socket.AF_UNIX) as probe:
                    probe.settimeout(1)
                    return probe.connect_ex(self._path()) in (0, errno.EAGAIN)
            host, port = self._host_and_port()
            with socket.create_connection((ALL.get(host, host).strip("[]"), port), timeout=1):
                return True
        except OSError:
            return False

    def bound(self) -> bool:
        """Whether the server has bound it. A look at what the system tells: a connection would be a peer to the server."""
        if self._is_file():
            return Path(self._path()).exists()
        port = f":{self._host_and_port()[1]:04X}"
        for table in ("/proc/net/tcp", "/proc/net/tcp6"):
            rows = [line.split() for line in Path(table).read_text().splitlines()[1:]] if Path(table).exists() else []
            if any(row[1].endswith(port) and row[3] == LISTENING for row in rows):
                return True
        return False

    def _is_file(self) -> bool:
        return self.address.startswith("ipc://")

    def _path(self) -> str:
        return self.address.removeprefix("ipc://")

    def _host_and_port(self) -> tuple[str, int]:
        host, _, port = self.address.removeprefix("tcp://").rpartition(":")
        try:
            return host, int(port)
        except ValueError:
            raise UserError(f"'{self.address}' is not an endpoint (neither ipc nor tcp://HOST:PORT); "
                            "see [coupling] endpoint in docs/user-guide.md", 2) from None

    def close(self) -> None:
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
