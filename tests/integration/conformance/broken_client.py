# SPDX-License-Identifier: BSD-3-Clause
"""The column client of cfd-client/examples with one thing broken on purpose.

Usage: broken_client.py WHAT <endpoint> <run folder>
"""
from __future__ import annotations

import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "cfd-client" / "examples"))
import column  # noqa: E402
from gimdem_client import Step, channel, client, messages  # noqa: E402

Client, Column = client.Client, column.Column


def changed(owner, name, change):
    """Replace a function by one that is given the original first."""
    original = getattr(owner, name)
    setattr(owner, name, lambda *arguments, **more: change(original, *arguments, **more))


def flip_a_face(make, *arguments):
    mesh = make(*arguments)
    mesh.face_points[-4:] = mesh.face_points[-4:][::-1].copy()
    return mesh


def use_the_solid_before(advance, self, solid, *arguments):
    advance(self, getattr(self, "before", solid), *arguments)
    self.before = solid


def halve_the_report(begin, self, step, fluid, monitors):
    for monitor in monitors:
        monitor.value *= 0.5
    return begin(self, step, fluid, monitors)


def skip_a_step(begin, self, step, *arguments):
    return begin(self, Step(step.number + (step.number > 3), step.time, step.dt), *arguments)


def shift_time(begin, self, step, *arguments):
    return begin(self, Step(step.number, step.time + (step.number > 3) * 0.1 * step.dt, step.dt), *arguments)


def cut_a_field(add, envelope, frames, fields, names, cell_count):
    add(envelope, frames, fields, names, cell_count)
    frames[0] = frames[0][:-8]


def leave_out_a_field(add, envelope, frames, fields, names, cell_count):
    add(envelope, frames, fields, dict(list(names.items())[1:]), cell_count)


def stop_early(finish, self, reason):
    finish(self, reason)
    sys.exit(0)


def exit_well(main):
    main()
    return 0


def hang_at_the_end(main):
    if main() != 0:
        time.sleep(1000)


def believe_any_version():
    changed(messages, "check_version", lambda check, envelope: None)


def beat_no_heart():
    changed(channel.Channel, "_connect", lambda connect, self, *arguments: setattr(self, "_interval", 1000)
            or connect(self, *arguments))
    changed(channel.Channel, "_take", lambda take, self, frames: take(self, frames) or setattr(self, "_interval", 1000))


def die_of_patience(begin, self, *arguments):
    self.options.step_time = 0.5
    return begin(self, *arguments)


class NeverAsked:
    """What a client that does not look sees."""

    def __get__(self, _client, _type=None):
        return None

    def __set__(self, _client, _value):
        pass


BREAK = {
    "mesh": lambda: changed(column, "make_mesh", flip_a_face),
    "time level": lambda: changed(Column, "advance", use_the_solid_before),
    "conservation": lambda: changed(Client, "begin_step", halve_the_report),
    "step number": lambda: changed(Client, "begin_step", skip_a_step),
    "step time": lambda: changed(Client, "begin_step", shift_time),
    "cut field": lambda: changed(messages, "add_fields", cut_a_field),
    "absent field": lambda: changed(messages, "add_fields", leave_out_a_field),
    "end": lambda: changed(column, "round", lambda _, number: 3),
    "stop": lambda: setattr(Client, "stop_request", NeverAsked()),
    "exit code": lambda: changed(column, "main", exit_well),
    "hang": lambda: changed(column, "main", hang_at_the_end),
    "version": believe_any_version,
    "heartbeat": beat_no_heart,
    "patience": lambda: changed(Client, "begin_step", die_of_patience),
}

if __name__ == "__main__":
    column.round = round  # so that it can be replaced there
    BREAK[sys.argv.pop(1)]()
    sys.exit(column.main())
