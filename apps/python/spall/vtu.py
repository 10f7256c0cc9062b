"""Reader of VTK XML unstructured grids (.vtu), without VTK.

It reads what Spall and deal.II write: one file, or the pieces of an index
(.pvtu), data as text, in base64 within the elements or appended (base64 or
raw), plain or compressed by zlib.
"""
from __future__ import annotations

import base64
import dataclasses
import pathlib
import re
import zlib
from typing import Any
from xml.etree import ElementTree

import numpy as np

from .errors import InputError, need

_TYPES = {"Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2",
          "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8",
          "Float32": "f4", "Float64": "f8"}


@dataclasses.dataclass
class Grid:
    """An unstructured grid. Data are by the names of the file, with units."""

    points: np.ndarray        #: (n_points, 3) [m]
    connectivity: np.ndarray  #: points of the cells, one after the other
    offsets: np.ndarray       #: end of each cell in ``connectivity``
    types: np.ndarray         #: VTK cell types: 1 vertex, 3 line, 5 triangle
    point_data: dict[str, np.ndarray]
    cell_data: dict[str, np.ndarray]

    @property
    def n_cells(self) -> int:
        return len(self.offsets)

    def cells(self, n_points: int) -> np.ndarray:
        """(n_cells, n_points): the points of cells that all have so many."""
        if self.n_cells * n_points != len(self.connectivity):
            raise InputError(f"cells have not {n_points} points each")
        return self.connectivity.reshape(-1, n_points)


class _File:
    """The XML head and the appended bytes of a file."""

    def __init__(self, path: pathlib.Path) -> None:
        self.path = path
        try:
            data = path.read_bytes()
        except FileNotFoundError:
            raise InputError(f"{path}: no such file") from None
        start = data.find(b"<AppendedData")
        self.appended, self.encoding = b"", "raw"
        if start >= 0:
            head = data[start:data.index(b">", start) + 1]
            first = data.index(b"_", start + len(head)) + 1
            self.appended = data[first:data.rindex(b"</AppendedData>")]
            found = re.search(rb'encoding="(\w+)"', head)
            self.encoding = found[1].decode() if found else "base64"
            data = data[:start] + b"</VTKFile>"
        try:
            self.root = ElementTree.fromstring(data)
        except ElementTree.ParseError as error:
            raise InputError(f"{path}: no VTK XML file: {error}") from None
        if self.root.get("type") != "UnstructuredGrid":
            raise InputError(f"{path}: is of type {self.root.get('type')}, "
                             "must be UnstructuredGrid")
        order = "<" if self.root.get("byte_order") != "BigEndian" else ">"
        self.order = order
        self.head_type = np.dtype(
            order + _TYPES[self.root.get("header_type", "UInt32")])
        compressor = self.root.get("compressor")
        if compressor not in (None, "vtkZLibDataCompressor"):
            raise InputError(f"{path}: compressed by {compressor}, must be "
                             "zlib")
        self.is_compressed = compressor is not None

    def array(self, element: Any) -> np.ndarray:
        """The numbers of a DataArray, one row per tuple."""
        kind = np.dtype(self.order + _TYPES[element.get("type")])
        width = int(element.get("NumberOfComponents") or 1)
        form = element.get("format", "ascii")
        if form == "ascii":
            values = np.array((element.text or "").split(), dtype=kind)
        elif form == "binary":
            text = "".join((element.text or "").split()).encode()
            values = np.frombuffer(self._from_base64(text), dtype=kind)
        else:
            rest = self.appended[int(element.get("offset")):]
            data = (self._from_base64(rest) if self.encoding == "base64"
                    else self._from_raw(rest))
            values = np.frombuffer(data, dtype=kind)
        values = values.astype(kind.newbyteorder("="))
        return values.reshape(-1, width) if width > 1 else values

    def _numbers(self, data: bytes, count: int) -> list[int]:
        return np.frombuffer(data, self.head_type, count).tolist()

    def _from_raw(self, data: bytes) -> bytes:
        size = self.head_type.itemsize
        first = self._numbers(data, 1)[0]
        if not self.is_compressed:
            return data[size:size + first]
        sizes = self._numbers(data[3 * size:], first)
        return _inflated(data[(3 + first) * size:], sizes)

    def _from_base64(self, text: bytes) -> bytes:
        size = self.head_type.itemsize
        if not self.is_compressed:
            # Some writers encode the length by itself, some with the data.
            n = _encoded(size)
            length = self._numbers(base64.b64decode(text[:n] + b"===")[:size],
                                   1)[0]
            if text[:n].endswith(b"="):
                return base64.b64decode(text[n:n + _encoded(length)])
            return base64.b64decode(text[:_encoded(size + length)])[size:]
        n_blocks = self._numbers(base64.b64decode(text[:4 * size]), 1)[0]
        n = _encoded((3 + n_blocks) * size)
        sizes = self._numbers(base64.b64decode(text[:n])[3 * size:], n_blocks)
        return _inflated(
            base64.b64decode(text[n:n + _encoded(sum(sizes))]), sizes)


def _encoded(n_bytes: int) -> int:
    """Characters of so many bytes in base64."""
    return -(-n_bytes // 3) * 4


def _inflated(data: bytes, sizes: list[int]) -> bytes:
    parts, start = [], 0
    for size in sizes:
        parts.append(zlib.decompress(data[start:start + size]))
        start += size
    return b"".join(parts)


def read_vtu(path: str | pathlib.Path) -> Grid:
    """The grid of a .vtu file, or of the pieces that a .pvtu file names.
    Throws InputError on a file that is none."""
    path = pathlib.Path(path)
    pieces = _named_pieces(path) if path.suffix == ".pvtu" else _pieces(path)
    if not pieces:
        raise InputError(f"{path}: has no piece")
    return pieces[0] if len(pieces) == 1 else _joined(pieces)


def _pieces(path: pathlib.Path) -> list[Grid]:
    file = _File(path)
    return [_piece(file, piece) for piece in file.root.iter("Piece")]


def _named_pieces(index: pathlib.Path) -> list[Grid]:
    try:
        root = ElementTree.parse(index).getroot()
    except FileNotFoundError:
        raise InputError(f"{index}: no such file") from None
    except ElementTree.ParseError as error:
        raise InputError(f"{index}: no index of pieces: {error}") from None
    return [grid for piece in root.iter("Piece")
            for grid in _pieces(index.parent / piece.get("Source", ""))]


def _piece(file: _File, piece: Any) -> Grid:
    points = file.array(piece.find("Points/DataArray"))
    cells = {one.get("Name"): file.array(one)
             for one in piece.findall("Cells/DataArray")}
    empty = np.zeros(0, dtype=np.int64)
    return Grid(points.reshape(-1, 3), cells.get("connectivity", empty),
                cells.get("offsets", empty), cells.get("types", empty),
                _data(file, piece, "PointData"), _data(file, piece, "CellData"))


def _data(file: _File, piece: Any, name: str) -> dict[str, np.ndarray]:
    return {one.get("Name"): file.array(one)
            for one in piece.findall(f"{name}/DataArray")
            if one.get("type") in _TYPES}


def _joined(pieces: list[Grid]) -> Grid:
    first_point = np.cumsum([0] + [len(one.points) for one in pieces])
    first_entry = np.cumsum([0] + [len(one.connectivity) for one in pieces])

    def all_of(name: str) -> dict[str, np.ndarray]:
        data = [getattr(one, name) for one in pieces]
        return {key: np.concatenate([one[key] for one in data])
                for key in data[0]}

    return Grid(
        np.concatenate([one.points for one in pieces]),
        np.concatenate([one.connectivity + start
                        for one, start in zip(pieces, first_point)]),
        np.concatenate([one.offsets + start
                        for one, start in zip(pieces, first_entry)]),
        np.concatenate([one.types for one in pieces]),
        all_of("point_data"), all_of("cell_data"))


def read_with_vtk(path: str | pathlib.Path) -> Any:
    """The same file as a vtkUnstructuredGrid, for the filters of VTK."""
    reading = need("vtkmodules.vtkIOXML", "reading a frame for VTK")
    is_index = pathlib.Path(path).suffix == ".pvtu"
    reader = (reading.vtkXMLPUnstructuredGridReader() if is_index
              else reading.vtkXMLUnstructuredGridReader())
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()
