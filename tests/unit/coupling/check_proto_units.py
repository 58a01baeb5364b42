#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fails on a numeric field of a .proto file whose comment lacks "Unit: ..." or "Shape: ...".

Usage: check_proto_units.py <folder with .proto files>

The comment stands at the end of the field's line or on the lines above it. Each message and enum needs a comment too.
"""
import pathlib
import re
import sys

NUMBERS = "double float int32 int64 uint32 uint64 sint32 sint64 fixed32 fixed64 sfixed32 sfixed64".split()
FIELD = re.compile(r"^\s*(?:optional |repeated )?(" + "|".join(NUMBERS) + r")\s+(\w+)\s*=\s*\d+\s*;(.*)$")
BLOCK = re.compile(r"^(message|enum)\s+(\w+)")


def faults_of(text):
    """What is wrong in the text of one file, as (line number, words)."""
    faults = []
    comment = ""  # the comment lines just above
    for number, line in enumerate(text.splitlines(), start=1):
        if line.strip().startswith("//"):
            comment += line.strip()[2:]
            continue
        field = FIELD.match(line)
        if field:
            described = comment + field.group(3)
            for word in ("Unit:", "Shape:"):
                if not re.search(word + r"\s*\S", described):
                    faults.append((number, f'field "{field.group(2)}" has no "{word} ..."'))
        block = BLOCK.match(line)
        if block and not comment:
            faults.append((number, f'{block.group(1)} "{block.group(2)}" has no comment'))
        comment = ""
    return faults


def check_self():
    """The check itself must see red."""
    good = "// A thing.\nmessage A {\n  double x = 1;  // Unit: m. Shape: scalar.\n  // Unit: 1. Shape: (n,).\n"
    good += "  repeated int32 n = 2;\n  string name = 3;\n}\n"
    assert faults_of(good) == [], faults_of(good)
    assert len(faults_of(good.replace("Unit: m", ""))) == 1
    assert len(faults_of(good.replace("Shape: (n,)", ""))) == 1
    assert len(faults_of(good.replace("// A thing.\n", ""))) == 1
    assert len(faults_of(good + "// B.\nmessage B {\n  optional fixed64 y = 1;\n}\n")) == 2


def main():
    check_self()
    files = sorted(pathlib.Path(sys.argv[1]).rglob("*.proto"))
    faults = [(path, *fault) for path in files for fault in faults_of(path.read_text())]
    for path, number, words in faults:
        print(f"{path}:{number}: {words}; say it in a comment, as the other fields do")
    fields = sum(len(FIELD.findall(line)) for path in files for line in path.read_text().splitlines())
    print(f"{fields} numeric fields in {len(files)} files, {len(faults)} faults")
    return 1 if faults or not fields else 0


if __name__ == "__main__":
    sys.exit(main())
