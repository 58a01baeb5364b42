# SPDX-License-Identifier: BSD-3-Clause
"""Bridge to setup.sh, which must work where there is no python."""
from __future__ import annotations

import os
import subprocess

from console import ROOT, UserError


def setup(quiet: bool) -> None:
    """Install what is missing. GIMDEM_NO_SETUP=1: take the machine as it is."""
    if os.environ.get("GIMDEM_NO_SETUP"):
        return
    command = ["bash", str(ROOT / "tools" / "setup.sh")] + (["--quiet"] if quiet else [])
    if subprocess.call(command) != 0:
        raise UserError("")  # setup.sh has said why
