# SPDX-License-Identifier: BSD-3-Clause
"""A client's part of a folder of keys: docs/security.md."""
from __future__ import annotations

import re
import stat
from dataclasses import dataclass
from pathlib import Path

from .errors import CouplingError, Fault

KEY = r'^\s*{}\s*=\s*"([^"\s]{{40}})"'  # 40 characters of Z85
READ_BY_OTHERS = stat.S_IRGRP | stat.S_IROTH
WRITTEN_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


@dataclass
class Keys:
    server: bytes  # its public key
    public: bytes
    secret: bytes


def read_keys(folder: str) -> Keys:
    path = Path(folder)
    own = read_file(path / "client.secret", READ_BY_OTHERS | WRITTEN_BY_OTHERS)
    server = read_file(path / "server.public", WRITTEN_BY_OTHERS)
    return Keys(server["public"], own["public"], own.get("secret", b""))


def read_file(file: Path, forbidden: int) -> dict[str, bytes]:
    """The keys in a file; forbidden: permissions that it must not give."""
    try:
        mode = file.stat().st_mode
        text = file.read_text()
    except OSError as error:
        raise refusal(f"the keys {file} cannot be read ({error.strerror}); make them with ./gimdem keys, or copy them from "
                      "the server's machine") from None
    if mode & forbidden:
        raise refusal(f"the keys {file} are open to other users of this machine (mode {mode & 0o777:o}); chmod 600 it")
    keys = {name: found[1].encode() for name in ("public", "secret") if (found := re.search(KEY.format(name), text, re.M))}
    if "public" not in keys or (file.suffix == ".secret" and "secret" not in keys):
        raise refusal(f"{file} holds no keys of 40 characters; make some with ./gimdem keys")
    return keys


def refusal(text: str) -> CouplingError:
    return CouplingError(Fault.USER, f"{text} (docs/security.md)")
