# SPDX-License-Identifier: BSD-3-Clause
"""Pass the server's stderr on to our terminal, and keep its error lines for the report at the end."""
from __future__ import annotations

import errno
import fcntl
import os
import re
import select
import sys
import termios
import tty

ERROR_LINE = re.compile(r"^\s*(gimdem-server: )?error: ", re.IGNORECASE)
CLEAR_LINE = "\r\x1b[K"


class Relay:
    """One end of the server's stderr. A terminal gets a terminal, so that the progress line can rewrite itself."""

    def __init__(self) -> None:
        self.on_terminal = sys.stderr.isatty()
        self.reader, self.child_end = self._open_terminal() if self.on_terminal else os.pipe()
        os.set_blocking(self.reader, False)
        self.errors: list[str] = []
        self.last_line = ""
        self._pending = ""
        self._at_line_start = True

    @staticmethod
    def _open_terminal() -> tuple[int, int]:
        master, slave = os.openpty()
        tty.setraw(slave)  # no translation of what passes
        try:
            size = fcntl.ioctl(sys.stderr.fileno(), termios.TIOCGWINSZ, b"\0" * 8)
            fcntl.ioctl(slave, termios.TIOCSWINSZ, size)
        except OSError:
            pass
        return master, slave

    def child_started(self) -> None:
        """Close our copy of the child's end, or we would never see the end of its output."""
        os.close(self.child_end)

    def pump(self, patience: float) -> None:
        """Wait up to `patience` [s] for output and pass it on."""
        ready, _, _ = select.select([self.reader], [], [], patience)
        if not ready:
            return
        data = self._read()
        if data:
            self._take(data.decode(errors="replace"))
        else:
            select.select([], [], [], patience)  # the other end is closed: nothing more to wait for

    def drain(self) -> None:
        """Pass on what is left after the child has ended."""
        while data := self._read():
            self._take(data.decode(errors="replace"))
        self._take("\n" if self._pending else "")
        if not self._at_line_start:
            self._write("\n")
        os.close(self.reader)

    def _read(self) -> bytes:
        try:
            return os.read(self.reader, 65536)
        except BlockingIOError:
            return b""
        except OSError as error:
            if error.errno == errno.EIO:  # a terminal's way to say: closed
                return b""
            raise

    def _take(self, text: str) -> None:
        self._pending += text
        *lines, self._pending = self._pending.split("\n")
        for line in lines:
            self._line(line)
        visible = self._pending.rsplit("\r", 1)[-1]
        if self.on_terminal and self._pending and not ERROR_LINE.match(visible) and not "error: ".startswith(visible):
            self._write(self._pending)  # the progress line, which has no end
            self.last_line = visible
            self._pending = ""

    def _line(self, line: str) -> None:
        visible = line.rsplit("\r", 1)[-1].rstrip()
        if ERROR_LINE.match(visible) or (self.errors and line.startswith("  ")):
            self.errors.append(ERROR_LINE.sub("", visible).strip())
            return
        if visible:
            self.last_line = visible
        self._write(line + "\n")

    def _write(self, text: str) -> None:
        sys.stderr.write(text)
        sys.stderr.flush()
        self._at_line_start = text.endswith("\n")
