# SPDX-License-Identifier: BSD-3-Clause
"""Watch server and client until both have ended, whatever happens to either or to us."""
from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from types import FrameType

from comeback import Comeback, died
from process import how_it_ended, kill_session
from relay import Relay

POLL = 0.1  # [s]
LAST_WORDS = 3.0  # between asking a process to go and making it go [s]


@dataclass
class Child:
    """One of the two processes."""

    name: str
    process: subprocess.Popen[bytes]
    ended_at: float | None = None
    forced: bool = False
    dismissed: bool = False  # told to end, as nobody would come back

    def alive(self) -> bool:
        if self.process.poll() is None:
            return True
        if self.ended_at is None:
            self.ended_at = time.monotonic()
        return False

    @property
    def code(self) -> int:
        return self.process.returncode

    def tell(self, number: int) -> None:
        if not self.alive():
            return
        if number == signal.SIGKILL:
            kill_session(self.process.pid)
        else:
            self.process.send_signal(number)


@dataclass
class Outcome:
    """How the pair ended. No client: the server ended, or we were stopped, before the client was started; or the server
    was to be alone."""

    server: Child
    client: Child | None = None
    signal: int = 0  # that asked us to stop, 0: none
    killed: bool = False  # at the second signal
    alone: bool = False  # no client was wanted
    starts: int = 0  # of the client
    last_words: list[str] = field(default_factory=list)  # of the server

    def children(self) -> list[Child]:
        return [self.server] if self.client is None else [self.server, self.client]

    def first(self) -> Child:
        """Who ended first, hence where to look for the cause."""
        pair = sorted(self.children(), key=lambda child: child.ended_at or 0.0)
        # Both within one look: the one that failed is the cause.
        if pair[0].code == 0 and (pair[-1].ended_at or 0) - (pair[0].ended_at or 0) < 2 * POLL:
            return pair[-1]
        return pair[0]

    def good(self) -> bool:
        ended_well = all(child.code == 0 for child in self.children())
        return ended_well and not self.killed and (self.alone or self.client is not None or bool(self.signal))


class StopRequest:
    """Counts SIGINT, SIGTERM and SIGHUP instead of dying of them."""

    NUMBERS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

    def __init__(self) -> None:
        self.count = 0
        self.first = 0
        self._previous = {number: signal.signal(number, self._receive) for number in self.NUMBERS}

    def _receive(self, number: int, _frame: FrameType | None) -> None:
        self.count += 1
        self.first = self.first or number

    def restore(self) -> None:
        for number, handler in self._previous.items():
            signal.signal(number, handler)


class Supervisor:
    """Start the server, then the client; see both to their end."""

    def __init__(self, timeout: float, client_name: str, comeback: Comeback | None = None) -> None:
        self.client_name = client_name
        self._comeback = comeback
        self._losses = 0  # that we have dealt with
        self._lost_at = 0.0
        self.patience = timeout + 5  # for a process to notice that its peer, once connected, is gone [s]

    def run(
        self, start_server: Callable[[int], subprocess.Popen[bytes]], server_ready: Callable[[], bool],
        start_client: Callable[[], subprocess.Popen[bytes]] | None,
    ) -> Outcome:
        """Without `start_client` the server runs alone."""
        stop = StopRequest()
        relay = Relay()
        outcome: Outcome | None = None
        try:
            outcome = Outcome(Child("gimdem-server", start_server(relay.child_end)), alone=start_client is None)
            relay.child_started()
            while start_client and outcome.server.alive() and not server_ready() and not stop.count:
                relay.pump(POLL, alive=True)
            if start_client and outcome.server.alive() and not stop.count:
                outcome.client, outcome.starts = Child(self.client_name, start_client()), 1
            self._watch(outcome, relay, stop)
            outcome.last_words = relay.drain()
            return outcome
        finally:
            for child in outcome.children() if outcome else []:
                child.tell(signal.SIGKILL)
                child.process.wait()
            stop.restore()

    def _watch(self, outcome: Outcome, relay: Relay, stop: StopRequest) -> None:
        handled = 0
        while True:
            relay.pump(POLL, outcome.server.alive())
            alive = [child for child in outcome.children() if child.alive()]
            if not alive:
                return
            if stop.count > handled:
                handled = stop.count
                self._obey(outcome, stop)
            if self._comeback and not stop.count and self._takes_back(outcome, relay):
                continue
            if len(alive) < len(outcome.children()):
                ended = next(child for child in outcome.children() if child not in alive)
                patience = self.patience if relay.client_connected else LAST_WORDS
                if self._comeback and relay.client_connected and ended is outcome.client and died(ended.code):
                    patience += self._comeback.grace_time  # the server is in a long step, and will wait for a client
                self._hurry(alive[0], time.monotonic() - (ended.ended_at or 0.0), patience)

    def _takes_back(self, outcome: Outcome, relay: Relay) -> bool:
        """Has a client that the server has lost come back; False: there is nothing to do."""
        client, server = outcome.client, outcome.server
        if relay.losses == self._losses or client is None or server.dismissed or not server.alive():
            return False
        self._lost_at = self._lost_at or time.monotonic()
        if client.alive():  # it hangs, or is about to go
            if time.monotonic() - self._lost_at > LAST_WORDS:
                client.forced = True
                client.tell(signal.SIGKILL)
            return True
        self._losses, self._lost_at = relay.losses, 0.0
        ended = "hung and was killed" if client.forced else how_it_ended(client.name, client.code).split(" ", 1)[1]
        answer = self._comeback.again(client.code, client.forced)
        if isinstance(answer, str):
            relay.interject("client", f"{client.name} {ended}; not started again: {answer}")
            server.dismissed = True
            server.tell(signal.SIGTERM)
            return True
        process, how = answer
        relay.interject("client", f"{client.name} {ended}; {how}")
        outcome.client, outcome.starts = Child(client.name, process), outcome.starts + 1
        return True

    @staticmethod
    def _obey(outcome: Outcome, stop: StopRequest) -> None:
        """The server alone is asked to end: it tells the client, and both write what they have."""
        outcome.signal = stop.first
        if stop.count == 1:
            print("\nstopping: at the end of this step (once more: at once, and without results)", file=sys.stderr)
            outcome.server.tell(signal.SIGINT)
        else:
            outcome.killed = True
            for child in outcome.children():
                child.tell(signal.SIGKILL)

    @staticmethod
    def _hurry(child: Child, alone_for: float, patience: float) -> None:
        """A process whose peer is gone ends by itself; if not in time, it is made to."""
        if alone_for > patience + LAST_WORDS:
            child.forced = True
            child.tell(signal.SIGKILL)
        elif alone_for > patience and not child.forced:
            child.forced = True
            child.tell(signal.SIGTERM)
