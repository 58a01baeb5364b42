#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How the bed of cases/rotating-drum stands in its drum:  tools/drum_angle.py RUN [FROM]

Means over the ParaView files of a run from the time FROM on (1.5 s): the angle of the bed's centre of mass about the
drum's axis, which is the slope of a straight surface, and what shows whether the drum holds and drags its bed.
"""
from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from console import UserError, run_script
from results import Figure
from vtp import read_particles, read_series

DRUM_RADIUS = 0.05  # [m]
DRUM_SPEED = 1.0  # of its bottom towards +x [rad/s]


def bed_of(file: Path) -> tuple[float, float, float]:
    """Angle of the centre of mass [degrees], how deep a particle is in the wall, in its radii, and how fast those at the
    wall go along with it, as a share of its speed."""
    particles = read_particles(file)
    position, radius = particles["position"].astype(float), particles["radius"].astype(float)
    mean = np.average(position, axis=0, weights=radius**3)
    distance = np.hypot(position[:, 0], position[:, 2])
    depth = (distance + radius - DRUM_RADIUS) / radius
    at_wall = depth > -0.1
    around = np.stack([-position[:, 2], position[:, 0]], axis=1) / distance[:, None]
    speed = np.sum(particles["velocity"][:, [0, 2]] * around, axis=1)[at_wall]
    return np.degrees(np.arctan2(mean[0], -mean[2])), depth.max(), speed.mean() / (DRUM_SPEED * DRUM_RADIUS)


def figures_of_drum(run: Path, begin: float) -> list[Figure]:
    files = [file for time, file in read_series(run / "results.pvd", "particles") if time >= begin]
    if not files:
        raise UserError(f"{run} has no particles from {begin} s on (the run is shorter); give an earlier time", 2)
    angle, depth, share = np.array([bed_of(file) for file in files]).T
    return [
        Figure("drum_angle", angle.mean(), "degree"), Figure("drum_angle_deviation", angle.std(), "degree"),
        Figure("drum_depth_max", depth.max(), "1"), Figure("drum_wall_layer_speed", share.mean(), "1"),
    ]


if __name__ == "__main__":
    sys.exit(run_script(__doc__, (1, 2), lambda run, begin="1.5": figures_of_drum(Path(run), float(begin)), sys.argv[1:]))
