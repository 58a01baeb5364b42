# SPDX-License-Identifier: BSD-3-Clause
"""One session with a server, in the order of docs/protocol.md."""
from __future__ import annotations

import atexit
import math
import time
from collections.abc import Sequence
from typing import Any, NoReturn, Optional

from . import messages
from .channel import Channel, Ending, Letter
from .errors import CouplingError, Fault
from .keys import read_keys
from .record import StepRecord
from .types import (FLUID_FIELDS, SCHEDULES, SOLID_FIELDS, ClientOptions, ExchangeTimes, FluidFields, FluidProperties,
                    Iteration, Mesh, Monitor, SavedCheckpoint, SolidFields, Step, Timings, Welcome)
from .wire import MAJOR, MINOR, Envelope

LINGER = 1.0  # for the last words to leave [s]
# In which state each call is legal.
LEGAL = {
    "connect": ("created",), "send_mesh": ("welcomed",), "begin_step": ("ready",), "save_checkpoint": ("ready",),
    "iterate_step": ("iterating",), "end_step": ("solving", "overlapping", "iterating"),
    "finish": ("created", "welcomed", "ready", "solving", "overlapping", "iterating", "finished"),
}
# Of begin_step(): the state while it waits, and the one after it.
STEPPING = {"serial": ("waiting", "solving"), "overlapped": ("overlapping", "overlapping"),
            "iterated": ("awaiting", "iterating")}


class Client:
    """Not thread-safe: one Client, one thread."""

    def __init__(self, options: ClientOptions) -> None:
        messages.check_options(options)
        unknown = [name for name in options.wants if name not in SOLID_FIELDS]
        if unknown or not options.wants or (options.schedule and options.schedule not in SCHEDULES):
            raise messages.user_fault(f"ClientOptions.wants or .schedule is unknown ({unknown or options.schedule}); fields "
                                      f"are {list(SOLID_FIELDS)}, schedules {list(SCHEDULES)}")
        self.options = options
        self._keys = read_keys(options.keys) if options.keys else None
        self.welcome: Optional[Welcome] = None
        self.solid = SolidFields()  # the last one received
        self.stop_request: Optional[str] = None  # why the server asks for an orderly end
        self.exchange_times = ExchangeTimes()
        self._wants = {name: SOLID_FIELDS[name] for name in SOLID_FIELDS if name in options.wants}
        self._state = "created"
        self._progress = 0
        self._step = Step(0, 0.0, 0.0)
        self._pass = 0
        self._residual = 0.0  # of the last pass of the step before
        self._session = 0
        self._cell_count = 0
        self._previous = Timings()
        self._last_fault = ""
        self._record = StepRecord()
        self._channel: Optional[Channel] = None

    def __enter__(self) -> Client:
        return self

    def __exit__(self, kind: Any, error: Any, _traceback: Any) -> None:
        self.abort(str(error) or kind.__name__ if error else "the client ended without finish()")

    # The calls of Client.hpp ------------------------------------------------------------------------------------------

    def connect(self, fluid: FluidProperties) -> Welcome:
        self._require("connect")
        options = self.options
        self._channel = Channel(options.endpoint, options.timeout, self._heartbeat, self._keys)
        atexit.register(self.abort, "the client's program has ended")
        self._advance("greeting")
        envelope = Envelope()
        hello = envelope.hello
        hello.name, hello.density, hello.viscosity = options.name, fluid.density, fluid.viscosity
        hello.wants.extend(self._wants)
        hello.schedule = SCHEDULES.get(options.schedule or "", 0)
        hello.timeout = options.timeout
        hello.iterates = options.iterates
        if options.resume:
            hello.resume.session, hello.resume.step = options.resume.session, options.resume.step
            hello.resume.time = options.resume.time
        self._record.stamp(hello)
        self._sent_at = time.monotonic()
        self._send(envelope)
        if not self._channel.wait_for_contact(options.connect_time):
            why = "the keys do not fit, or only one side has any" if self._channel.misfit else \
                "none runs there, or it is not a gimdem server"
            self._fail(Fault.ENDPOINT, f"no server has answered at {options.endpoint} within {options.connect_time:g} s "
                       f"({why}); start gimdem-server with the same endpoint and keys that belong together")
        told, _, arrival = self._receive("welcome")
        self._record.heard(told.welcome, self._sent_at, arrival)
        self._session = told.session
        self._advance("welcomed")
        self.welcome = self._read_welcome(told.welcome)
        return self.welcome

    def send_mesh(self, mesh: Mesh) -> None:
        self._require("send_mesh")
        envelope, frames = Envelope(), []
        messages.add_mesh(envelope, frames, mesh)
        self._cell_count = int(mesh.cell_count)
        self._advance("meshing")
        self._send(envelope, frames)
        accepted = self._receive("mesh_accepted")[0].mesh_accepted
        if accepted.cell_count != self._cell_count:
            self._fail(Fault.PROTOCOL, f"the server counted {accepted.cell_count} cells instead of {self._cell_count}")
        self._advance("accepted")
        self._take_solid()
        self._advance("ready")

    def begin_step(self, step: Step, fluid: FluidFields, monitors: Sequence[Monitor] = ()) -> SolidFields:
        """The solid that the fluid step must use."""
        self._require("begin_step")
        self._send_fluid(step, 0, self._residual, fluid, monitors)
        return self.solid

    def iterate_step(self, estimate: FluidFields, residual: float = 0.0) -> SolidFields:
        """Schedule iterated: the server goes back to the beginning of the step and repeats it in this estimate of the
        fluid at its end. residual: relative, of the pass that is given up."""
        self._require("iterate_step")
        self._send_fluid(self._step, self._pass + 1, residual, estimate, ())
        return self.solid

    def end_step(self, timings: Timings = Timings(), residual: float = 0.0) -> None:
        entered = time.monotonic()
        self._require("end_step")
        self._previous, self._residual, waiting = timings, residual, 0.0
        if self._overlaps():
            busy, arrival = self._take_solid()
            # What the server computed before we came to wait cost us nothing.
            waiting = self._count(entered, min(busy, max(0.0, arrival - entered)))
        self._record.ended(entered, time.monotonic(), waiting)
        self._advance("ready")

    def save_checkpoint(self, time_now: float, complete_step: int = 0) -> SavedCheckpoint:
        """Has the server save its state of now; returns when that is safe on disk. The fluid's state of now belongs to it:
        write it, then remember what is returned, for ClientOptions.resume. time_now: where the last step ended.
        complete_step: step of the newest checkpoint to which a fluid is whole, 0: none."""
        self._require("save_checkpoint")
        if not self.welcome.saves_checkpoints:
            raise messages.user_fault("this server saves no checkpoints (Welcome.saves_checkpoints); go on without")
        envelope = Envelope()
        envelope.checkpoint.time, envelope.checkpoint.complete_step = time_now, complete_step
        self._advance("saving")
        self._send(envelope)
        saved = self._receive("checkpoint_saved")[0].checkpoint_saved
        self._advance("ready")
        return SavedCheckpoint(self._session, saved.step, saved.time, saved.name)

    def finish(self, reason: str) -> None:
        """Orderly end: Goodbye."""
        self._require("finish")
        if self._state not in ("created", "finished"):
            envelope = Envelope()
            envelope.goodbye.reason = reason
            last = envelope.goodbye.last_step
            self._record.put_into(last.times)
            last.compute, last.output = self._previous.compute, self._previous.output
            self._send(envelope)
        self._advance("finished")
        self._close()

    def abort(self, reason: str) -> None:
        """Tell the server why we stop; does nothing after an end."""
        if self._state not in ("finished", "failed"):
            self._tell(Fault.USER, reason)
            self._fall(reason)
        self._close()

    # ------------------------------------------------------------------------------------------------------------------

    def _overlaps(self) -> bool:
        return self.welcome.schedule == "overlapped"

    def _send_fluid(self, step: Step, number: int, residual: float, fluid: FluidFields,
                    monitors: Sequence[Monitor]) -> None:
        """One pass of a step; unless both compute at once, takes its answer."""
        entered = time.monotonic()
        envelope, frames = Envelope(step=step.number, iteration=number), []
        state = envelope.fluid_state
        state.step.number, state.step.time, state.step.dt = step.number, step.time, step.dt
        if number > 0:
            state.rewind.residual = residual
        else:
            state.residual = residual
        for monitor in monitors:
            if not math.isfinite(monitor.value):
                raise messages.user_fault(f'monitor "{monitor.name}" is {monitor.value} (it must be finite)')
            state.monitors.add(name=monitor.name, value=monitor.value, unit=monitor.unit)
        state.previous.compute, state.previous.output = self._previous.compute, self._previous.output
        state.exchange, state.waiting = self.exchange_times.exchange, self.exchange_times.waiting
        self._record.put_into(state.previous_times)
        needs = {name: FLUID_FIELDS[name] for name in FLUID_FIELDS if name in self.welcome.needs}
        messages.add_fields(envelope, frames, fluid, needs, self._cell_count)
        self._step, self._pass = step, number
        meanwhile, after = STEPPING[self.welcome.schedule]
        self._advance(meanwhile)
        self._sent_at = time.monotonic()  # not later than the message leaves: the clocks' offset is bounded by it
        self._send(envelope, frames)
        sent = time.monotonic()
        self._record.begun(step.number, entered)
        if self._overlaps():
            return self._record.resumed(sent)
        busy, arrival = self._take_solid()
        self._advance(after)
        waiting = self._count(entered, busy)
        self._record.resumed(time.monotonic(), waiting, 0.5 * (sent + arrival))

    def _read_welcome(self, told: Any) -> Welcome:
        schedules = {number: name for name, number in SCHEDULES.items()}
        unknown = [name for name in told.needs if name not in FLUID_FIELDS]
        if told.schedule not in schedules or unknown or not math.isfinite(told.end_time):
            self._fail(Fault.PROTOCOL, f"Welcome: schedule {told.schedule}, end time {told.end_time}, unknown fields "
                       f"{unknown}; the two programs do not fit together, see docs/protocol.md")
        how = told.iteration
        iteration = Iteration(how.tolerance, how.max_passes, how.relaxation, how.must_converge)
        return Welcome(told.server, told.title, schedules[told.schedule], told.end_time, list(told.needs),
                       max(1, told.fluid_steps), iteration if schedules[told.schedule] == "iterated" else None,
                       told.saves_checkpoints)

    def _take_solid(self) -> tuple[float, float]:
        """Receives the solid of the current step; returns how long the server was busy [s], and when it arrived."""
        envelope, frames, arrival = self._receive("solid_state")
        try:
            if (envelope.step, envelope.iteration) != (self._step.number, self._pass):
                raise ValueError(f"it answers step {envelope.step}, pass {envelope.iteration}")
            self.solid = SolidFields(**messages.read_fields(envelope, frames, self._wants, self._cell_count))
        except ValueError as error:
            self._fail(Fault.PROTOCOL, f"SolidState from {self._peer()} is unusable: {error} ({self._here()}); the two "
                       "programs do not fit together, see docs/protocol.md")
        state = envelope.solid_state
        self._record.heard(state, self._sent_at, arrival)
        self.stop_request = state.stop_reason if state.stop_requested else None
        return state.busy_time, arrival

    def _count(self, entered: float, busy: float) -> float:
        """Returns how long we waited [s]."""
        call = time.monotonic() - entered
        waiting = min(call, busy)
        self.exchange_times.waiting += waiting
        self.exchange_times.exchange += call - waiting
        self.exchange_times.bytes = float(self._channel.bytes)
        return waiting

    def _receive(self, kind: str) -> Letter:
        """The next message, which must be of that kind."""
        item = self._channel.receive(self.options.step_time)
        if item is None:
            self._fail(Fault.TIMEOUT, f"{self._peer()} has not sent {kind} within {self.options.step_time:g} s "
                       f"({self._here()}); see what it is doing, or allow more time")
        if isinstance(item, Ending):
            self._fail_by_ending(item, kind)
        if isinstance(item, Exception):
            self._fail(Fault.PROTOCOL, f"{self._peer()} sent something unusable: {item} ({self._here()})")
        envelope = item[0]
        try:
            messages.check_version(envelope)
        except CouplingError as error:
            self._fail(error.fault, str(error))
        came = envelope.WhichOneof("kind")
        if came == "error":
            self._fail_by_peer(envelope.error, kind)
        if came != kind or (kind != "welcome" and envelope.session != self._session):
            self._fail(Fault.PROTOCOL, f"{came} of session {envelope.session} from {self._peer()} is out of order "
                       f"({self._here()}, waiting for {kind}); the two programs do not fit together")
        return item

    def _fail_by_peer(self, error: Any, awaited: str) -> NoReturn:
        known = {fault.value: fault for fault in (Fault.MESH, Fault.VERSION)}
        fault = known.get(error.fault, Fault.PEER)
        what = "refused the mesh" if fault is Fault.MESH else "ended the run"
        text = (f'server "{error.name}" {what}: {error.reason} (it was in state {error.state}); {self._us()} was waiting '
                f"for {awaited} {self._here()}")
        self._fall(text)
        raise CouplingError(fault, text)

    def _fail_by_ending(self, ending: Ending, awaited: str) -> NoReturn:
        waiting = f"{self._us()} was waiting for {awaited} {self._here()}"
        if ending.silence is not None:
            self._fail(Fault.TIMEOUT, f"{self._peer()} at {self.options.endpoint} has been silent for {ending.silence:.3g} s "
                       f"(time-out {self.options.timeout:g} s); {waiting}; see whether it was stopped or hangs")
        if ending.refused:
            self._fail(Fault.ENDPOINT, f"{self._peer()} at {self.options.endpoint} has turned us away (it does not know our key); "
                       f"{waiting}; have its user put our client.public among its clients, see docs/security.md")
        self._fail(Fault.PEER, f"{self._peer()} at {self.options.endpoint} has disappeared (its connection broke"
                   f"{', ' + ending.detail if ending.detail else ''}); {waiting}; its own output should tell why")

    def _fail(self, fault: Fault, text: str) -> NoReturn:
        """Ends the session: tells the server, and raises."""
        self._tell(fault, text)
        self._fall(text)
        raise CouplingError(fault, text)

    def _tell(self, fault: Fault, reason: str) -> None:
        if self._channel and self._channel.contact.is_set():
            self._channel.send([self._error_frame(reason, fault)])

    def _error_frame(self, reason: str, fault: Fault = Fault.USER) -> bytes:
        envelope = Envelope(step=self._step.number)
        envelope.error.fault = fault.value
        envelope.error.reason = reason[:8192]
        envelope.error.state, envelope.error.name = self._state, self.options.name
        return self._stamped(envelope)

    def _heartbeat(self) -> bytes:
        envelope = Envelope(step=self._step.number)
        beat = envelope.heartbeat
        beat.state, beat.progress, beat.timeout = self._state, self._progress, self.options.timeout
        beat.name = self.options.name
        return self._stamped(envelope)

    def _send(self, envelope: Envelope, frames: Sequence[Any] = ()) -> None:
        self._channel.send([self._stamped(envelope), *frames])

    def _stamped(self, envelope: Envelope) -> bytes:
        envelope.protocol_major, envelope.protocol_minor = MAJOR, MINOR
        envelope.session = self._session
        envelope.step = envelope.step or self._step.number
        return envelope.SerializeToString()

    def _require(self, call: str) -> None:
        if self._state in LEGAL[call]:
            return
        why = f" after the fault: {self._last_fault}" if self._state == "failed" else ""
        raise messages.user_fault(f"{call}() is illegal {self._here()}{why}; keep to the order of calls that "
                                  "gimdem_client/__init__.py shows")

    def _advance(self, state: str) -> None:
        self._state = state
        self._progress += 1

    def _fall(self, why: str) -> None:
        self._last_fault = why
        self._advance("failed")

    def _close(self) -> None:
        if self._channel:
            self._channel.close(LINGER)
            atexit.unregister(self.abort)

    def _here(self) -> str:
        return f"in state {self._state}, step {self._step.number}"

    def _us(self) -> str:
        return f'client "{self.options.name}"'

    def _peer(self) -> str:
        heard = self._channel.last_heartbeat if self._channel else None
        name = self.welcome.server if self.welcome else heard.heartbeat.name if heard else ""
        return f'server "{name}"' if name else "the server"

