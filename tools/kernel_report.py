#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Registers, stack, spills and occupancy of the CUDA kernels, as a Markdown table for docs/gpu.md.

    cmake --preset cuda -DGIMDEM_CUDA_REPORT=ON
    cmake --build build/cuda --target gimdem_cuda > build.log
    tools/kernel_report.py build.log

Occupancy is the share of the 64 warps of an H100's multiprocessor (compute capability 9.0: 65,536 registers, given out
to warps in units of 256) that fit with the kernel's registers in blocks of 128 threads.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ENTRY = re.compile(r"Compiling entry function '(\S+)' for")
FRAME = re.compile(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads")
USED = re.compile(r"Used (\d+) registers")


def main() -> int:
    rows = {}
    name, stack, spilled = "", 0, 0
    for line in Path(sys.argv[1]).read_text().splitlines():
        if match := ENTRY.search(line):
            name = match[1]
        elif match := FRAME.search(line):
            stack, spilled = int(match[1]), int(match[2]) + int(match[3])
        elif (match := USED.search(line)) and name:
            rows[readable(name)] = (int(match[1]), stack, spilled)
    print("| kernel | registers | stack [B] | spills [B] | occupancy |")
    print("|---|---|---|---|---|")
    for kernel, (registers, stack, spilled) in sorted(rows.items(), key=lambda row: (-row[1][0], row[0])):
        print(f"| `{kernel}` | {registers} | {stack} | {spilled} | {occupancy(registers):.0%} |")
    return 0


def readable(symbol: str) -> str:
    text = subprocess.run(["c++filt", symbol], capture_output=True, text=True, check=True).stdout.strip()
    text = re.sub(r"^.*launch<(.*)>\(.*$", r"\1", text)
    for qualifier in ("gimdem::", "exec::", "detail::"):
        text = text.replace(qualifier, "")
    return text.replace(" >", ">").strip()


def occupancy(registers: int) -> float:
    warps_of_block = 4
    registers_of_warp = -(-registers * 32 // 256) * 256
    blocks = 65536 // registers_of_warp // warps_of_block
    return min(64, blocks * warps_of_block) / 64


if __name__ == "__main__":
    sys.exit(main())
