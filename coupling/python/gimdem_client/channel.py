# SPDX-License-Identifier: BSD-3-Clause
"""The thread that owns the socket: it talks to the server, heartbeats included, whatever the program is doing.

A call that holds Python's global lock for longer than the time-out (a C extension that does not release it) keeps this
thread from talking, and the server takes us for dead: raise both time-outs then.
"""
from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from typing import Optional, Union

import zmq
from zmq.utils.monitor import recv_monitor_message

from .keys import Keys
from .wire import Envelope

BEATS_PER_TIMEOUT = 5  # docs/protocol.md, Time-outs
MAX_FRAME_BYTES = 4 << 30
MISFITS = zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL | zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL  # of the keys, or only one side has any
REFUSAL = zmq.EVENT_HANDSHAKE_FAILED_AUTH  # the server does not know our key


class Ending:
    """Why nothing more will come."""

    def __init__(self, silence: Optional[float] = None, detail: str = "", refused: bool = False) -> None:
        self.silence = silence  # [s], None: the connection broke
        self.detail = detail
        self.refused = refused  # the server has turned us away


Letter = tuple[Envelope, list[bytes], float]  # with the time of its arrival


class Channel:
    def __init__(self, endpoint: str, timeout: float, heartbeat: Callable[[], bytes],
                 keys: Optional[Keys] = None) -> None:
        self.contact = threading.Event()  # the server has said something
        self.misfit = False  # of the keys: a handshake has failed
        self.last_heartbeat: Optional[Envelope] = None  # of the server
        self.bytes = 0
        self._timeout = timeout
        self._interval = timeout / BEATS_PER_TIMEOUT
        self._heartbeat = heartbeat
        self._incoming: queue.Queue[Union[Letter, Ending, Exception]] = queue.Queue()
        self._outgoing: queue.SimpleQueue[list[bytes]] = queue.SimpleQueue()
        self._news = threading.Event()  # contact, or an end before it
        self._closing = False
        self._ended = False
        self._context = zmq.Context()
        self._socket = self._connect(endpoint, keys)
        self._monitor = self._socket.get_monitor_socket(zmq.EVENT_HANDSHAKE_SUCCEEDED | zmq.EVENT_DISCONNECTED | MISFITS | REFUSAL)
        self._wakeup, self._woken = self._pair()
        self._thread = threading.Thread(target=self._run, name="gimdem channel", daemon=True)
        self._thread.start()

    def send(self, frames: list[bytes]) -> None:
        self.bytes += sum(len(frame) for frame in frames)
        self._outgoing.put(frames)
        self._wakeup.send(b"")

    def wait_for_contact(self, patience: float) -> bool:
        """False: nobody has answered within `patience` [s]. True: receive() has the answer, or the end."""
        return self._news.wait(patience)

    def receive(self, patience: float) -> Union[Letter, Ending, Exception, None]:
        """The next thing that came; None: nothing within `patience` [s]."""
        try:
            item = self._incoming.get(timeout=max(0.0, patience))
        except queue.Empty:
            return None
        if not isinstance(item, tuple):
            self._incoming.put(item)  # an end stays the end
        return item

    def close(self, linger: float) -> None:
        """Ends the thread; waits `linger` [s] at most for the last words to leave."""
        if self._closing:
            return
        self._closing = True
        self._wakeup.send(b"")
        self._thread.join()
        listens = self.contact.is_set() and not self._ended
        self._socket.disable_monitor()
        for each in (self._wakeup, self._woken, self._monitor):
            each.close(linger=0)
        self._socket.close(linger=int(1000 * linger) if listens else 0)
        self._context.term()

    def _connect(self, endpoint: str, keys: Optional[Keys]) -> zmq.Socket:
        socket = self._context.socket(zmq.DEALER)
        socket.linger = 0
        socket.sndhwm = socket.rcvhwm = 0
        socket.maxmsgsize = MAX_FRAME_BYTES
        socket.reconnect_ivl = 20
        socket.ipv6 = "[" in endpoint
        if keys:
            socket.curve_serverkey, socket.curve_publickey, socket.curve_secretkey = keys.server, keys.public, keys.secret
        socket.connect(endpoint)
        return socket

    def _pair(self) -> tuple[zmq.Socket, zmq.Socket]:
        first, second = self._context.socket(zmq.PAIR), self._context.socket(zmq.PAIR)
        first.bind("inproc://wakeup")
        second.connect("inproc://wakeup")
        return first, second

    def _run(self) -> None:
        try:
            self._talk()
        except Exception as error:  # the program's thread must not wait in vain
            self._end(Ending(detail=str(error)))

    def _talk(self) -> None:
        poller = zmq.Poller()
        for socket in (self._socket, self._monitor, self._woken):
            poller.register(socket, zmq.POLLIN)
        greeted = False
        last_turn = last_heard = next_beat = time.monotonic()
        while not self._closing:
            until = min(next_beat, last_heard + self._timeout if self.contact.is_set() and not self._ended else next_beat)
            poller.poll(1000 * max(0.0, until - time.monotonic()) + 1)
            while self._woken.poll(0):
                self._woken.recv()
            broke, greeted = self._connection_broke(greeted)
            self._send_queued()
            now = time.monotonic()
            if now - last_turn > 3 * self._interval:
                last_heard = now  # we were stopped ourselves
            last_turn = now
            if self._receive_all():
                if not self.contact.is_set():
                    next_beat = now
                    self.contact.set()
                    self._news.set()
                last_heard = now
            if broke:
                self._end(Ending())
            if self.contact.is_set() and now >= next_beat:
                self._socket.send(self._heartbeat())
                next_beat = now + self._interval
            if not self.contact.is_set():
                next_beat = now + self._interval
            elif now - last_heard > self._timeout:
                self._end(Ending(silence=now - last_heard))
        self._send_queued()

    def _connection_broke(self, greeted: bool) -> tuple[bool, bool]:
        """Whether the connection broke, and whether there has been one: before, ZeroMQ tries again by itself."""
        broke = False
        while self._monitor.poll(0):
            event = recv_monitor_message(self._monitor)["event"]
            self.misfit = self.misfit or bool(event & MISFITS)
            if event == REFUSAL:
                self._end(Ending(refused=True))
            greeted = greeted or event == zmq.EVENT_HANDSHAKE_SUCCEEDED
            broke = broke or (greeted and event == zmq.EVENT_DISCONNECTED)
        return broke, greeted

    def _send_queued(self) -> None:
        while not self._outgoing.empty():
            frames = self._outgoing.get()
            if not self._ended:  # ZeroMQ would keep it for whoever opens the endpoint next
                self._socket.send_multipart(frames, copy=False)

    def _receive_all(self) -> bool:
        """Whether anything came."""
        came = False
        while self._socket.poll(0):
            frames = self._socket.recv_multipart()
            came = True
            self.bytes += sum(len(frame) for frame in frames)
            self._take(frames)
        return came

    def _take(self, frames: list[bytes]) -> None:
        envelope = Envelope()
        try:
            envelope.ParseFromString(frames[0])
        except Exception as error:  # protobuf's DecodeError has had several homes
            self._incoming.put(ValueError(f"an envelope of {len(frames[0])} bytes that cannot be read ({error})"))
            return
        if envelope.WhichOneof("kind") != "heartbeat":
            self._incoming.put((envelope, frames[1:], time.monotonic()))
            return
        self.last_heartbeat = envelope
        told = envelope.heartbeat.timeout
        if told >= 0.1:
            self._interval = min(self._interval, told / BEATS_PER_TIMEOUT)

    def _end(self, ending: Ending) -> None:
        if not self._ended:
            self._ended = True
            self._incoming.put(ending)
            self._news.set()
