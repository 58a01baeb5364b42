# SPDX-License-Identifier: BSD-3-Clause
"""Pass the server's stderr on to our terminal, and keep its last words for the report at the end."""
from __future__ import annotations

import errno
import fcntl
import os
import re
import select
import sys
import termios
import time
import tty

from console import say

CLEAR_LINE = "\x1b[K"
OWN_LINE = re.compile(r"^gimdem-server: ")  # its errors and its news; an error is the last thing that it says
CONNECTED = re.compile(r"^gimdem-server: .* connected$")
LOST = re.compile(r"^gimdem-server: .* for a client that goes on$")
BEHIND = re.compile(r"(?<=.)gimdem-server: ")  # on a terminal, behind the progress line, which has no end
NEWS_AFTER = 0.5  # a line after which the server lives on for so long is no error [s]


class Relay:
    """One end of the server's stderr. A terminal gets a terminal, so that the progress line can rewrite itself."""

    def __init__(self) -> None:
        self.on_terminal = sys.stderr.isatty()
        self.reader, self.child_end = self._open_terminal() if self.on_terminal else os.pipe()
        os.set_blocking(self.reader, False)
        self.client_connected = False
        self.losses = 0  # of clients that the server waits for
        self._held: list[str] = []  # the server's own words, until it is clear that it lives on
        self._held_since = 0.0
        self._pending = ""  # of a line that is not complete
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

    def pump(self, patience: float, alive: bool) -> None:
        """Wait up to `patience` [s] for output and pass it on. alive: whether the server is."""
        ready, _, _ = select.select([self.reader], [], [], patience)
        data = self._read() if ready else b""
        if data:
            self._take(data.decode(errors="replace"))
        elif ready:
            time.sleep(patience)  # the other end is closed: nothing more to wait for
        if self._held and alive and time.monotonic() - self._held_since > NEWS_AFTER:
            self._release()

    def interject(self, label: str, text: str) -> None:
        """A line of our own between those of the server."""
        self._release()
        if not self._at_line_start:
            self._write("\n")
        say(label, text)

    def drain(self) -> list[str]:
        """Pass on what is left after the server has ended; returns its last words, which are not passed on."""
        while data := self._read():
            self._take(data.decode(errors="replace"))
        self._take("\n" if self._pending else "")
        if not self._at_line_start:
            self._write("\n")
        os.close(self.reader)
        return [OWN_LINE.sub("", line).strip() for line in self._held]

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
        visible = self._pending.rsplit("\r", 1)[-1].removeprefix(CLEAR_LINE)
        if self.on_terminal and self._pending and not "gimdem-server: ".startswith(visible[:15]):
            self._release()
            self._write(self._pending)  # the progress line, which has no end
            self._pending = ""

    def _line(self, line: str) -> None:
        visible = line.rsplit("\r", 1)[-1].removeprefix(CLEAR_LINE).rstrip()
        begin = BEHIND.search(visible) if self.on_terminal else None
        if begin:
            self._write(visible[:begin.start()] + "\n")
            line = visible = visible[begin.start():]
        if OWN_LINE.match(visible):
            self._release()
        if CONNECTED.match(visible):
            self.client_connected = True
        if LOST.match(visible):
            self.losses += 1
        if OWN_LINE.match(visible) or (self._held and visible.startswith("  ")):
            self._held.append(visible)
            self._held_since = time.monotonic()
        else:
            self._release()
            self._write(line + "\n")

    def _release(self) -> None:
        """What was held back was no last word."""
        held, self._held = self._held, []
        if held and not self._at_line_start:
            self._write("\n")
        for line in held:
            self._write(line + "\n")

    def _write(self, text: str) -> None:
        sys.stderr.write(text)
        sys.stderr.flush()
        self._at_line_start = text.endswith("\n")
