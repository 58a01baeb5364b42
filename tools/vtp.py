# SPDX-License-Identifier: BSD-3-Clause
"""Read the particle files of a run: VTK XML with raw appended data, zlib-compressed or not. Needs numpy only."""
from __future__ import annotations

import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import numpy as np

DTYPES = {
    "Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4",
    "UInt32": "u4", "Int64": "i8", "UInt64": "u8",
}
APPENDED = b"<AppendedData"


class VtkFileError(Exception):
    """The file is not one that we can read."""


def read_particles(file: Path) -> dict[str, np.ndarray]:
    """The arrays of a .vtp file by name, shape=(n,) or (n, components); the points are called "position"."""
    root, read = open_file(file)
    arrays = {element.get("Name", ""): read(element) for element in root.findall(".//PointData/DataArray")}
    arrays["position"] = read(only(root, ".//Points/DataArray", file))
    return arrays


def read_cells(file: Path) -> dict[str, np.ndarray]:
    """The cell fields of a .vtu file by name; the means of each cell's points are called "centre"."""
    root, read = open_file(file)
    arrays = {element.get("Name", ""): read(element) for element in root.findall(".//CellData/DataArray")}
    points = read(only(root, ".//Points/DataArray", file)).astype(float)
    corners = read(only(root, ".//Cells/DataArray[@Name='connectivity']", file))
    ends = read(only(root, ".//Cells/DataArray[@Name='offsets']", file))
    starts = np.concatenate(([0], ends[:-1]))
    arrays["centre"] = np.add.reduceat(points[corners], starts) / (ends - starts)[:, None]
    return arrays


def open_file(file: Path) -> tuple[ElementTree.Element, BlockReader]:
    """The XML of a file and what reads its arrays."""
    content = file.read_bytes()
    start = content.find(APPENDED)
    if start < 0:
        raise VtkFileError(f"{file} has no appended data")
    blob = content[content.index(b"_", content.index(b">", start)) + 1 :]
    root = ElementTree.fromstring(content[:start] + b"</VTKFile>")
    return root, BlockReader(root, blob)


def only(root: ElementTree.Element, path: str, file: Path) -> ElementTree.Element:
    found = root.find(path)
    if found is None:
        raise VtkFileError(f"{file} has no {path.removeprefix('.//')}")
    return found


def read_series(pvd: Path, group: str) -> list[tuple[float, Path]]:
    """Times [s] and files of a .pvd whose path begins with `group`, e.g. "particles", in order of time."""
    entries = ElementTree.parse(pvd).getroot().iter("DataSet")
    found = [(float(entry.get("timestep", "0")), entry.get("file", "")) for entry in entries]
    return sorted((time, pvd.parent / name) for time, name in found if name.startswith(group))


class BlockReader:
    """Turns a DataArray element into the array that its offset points to."""

    def __init__(self, root: ElementTree.Element, blob: bytes) -> None:
        self._blob = blob
        self._order = "<" if root.get("byte_order") == "LittleEndian" else ">"
        self._header = np.dtype(self._order + DTYPES[root.get("header_type", "UInt32")])
        self._compressor = root.get("compressor")
        if self._compressor not in (None, "vtkZLibDataCompressor"):
            raise VtkFileError(f"compressed by {self._compressor}, which is not known here")

    def __call__(self, element: ElementTree.Element) -> np.ndarray:
        if element.get("format") != "appended":
            raise VtkFileError(f"array {element.get('Name')} is not appended")
        offset = int(element.get("offset", "0"))
        data = self._inflate(offset) if self._compressor else self._plain(offset)
        values = np.frombuffer(data, self._order + DTYPES[element.get("type", "Float32")])
        components = int(element.get("NumberOfComponents", "1"))
        return values.reshape(-1, components) if components > 1 else values

    def _numbers(self, offset: int, count: int) -> list[int]:
        return [int(n) for n in np.frombuffer(self._blob, self._header, count, offset)]

    def _plain(self, offset: int) -> bytes:
        (size,) = self._numbers(offset, 1)
        begin = offset + self._header.itemsize
        return self._blob[begin : begin + size]

    def _inflate(self, offset: int) -> bytes:
        """[blocks, block size, size of a partial last block, compressed sizes ...] then the blocks."""
        (blocks,) = self._numbers(offset, 1)
        sizes = self._numbers(offset, 3 + blocks)[3:]
        position = offset + (3 + blocks) * self._header.itemsize
        parts = []
        for size in sizes:
            parts.append(zlib.decompress(self._blob[position : position + size]))
            position += size
        return b"".join(parts)
