# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Reads what Talus writes for ParaView: VTK's XML files with raw appended data, without a library of VTK."""

import os
import struct
import xml.etree.ElementTree as ElementTree

_CODES = {"Float64": "d", "Int64": "q"}


class Piece:
    """points: [(x, y, z)]; cells: kind -> [[indices of points]]; point_data, cell_data: name -> list of numbers or
    tuples; time."""

    def __init__(self, path):
        with open(path, "rb") as file:
            content = file.read()
        begin = content.index(b'<AppendedData encoding="raw">')
        start = content.index(b"_", begin) + 1
        end = content.rindex(b"\n</AppendedData>")
        assert b"<!-- written by Talus " + os.environ["TALUS_VERSION"].encode() + b" -->" in content[:200]
        root = ElementTree.fromstring(content[:begin] + b"</VTKFile>")
        assert root.attrib["type"] == "PolyData" and root.attrib["header_type"] == "UInt64"
        self._order = "<" if root.attrib["byte_order"] == "LittleEndian" else ">"
        self._data, self._used = content[start:end], 0
        self.time = self._read(root.find("PolyData/FieldData/DataArray"))[0]
        piece = root.find("PolyData/Piece")
        count = int(piece.attrib["NumberOfPoints"])
        self.points = self._tuples(piece.find("Points/DataArray"))
        self.point_data = {a.attrib["Name"]: self._tuples(a) for a in piece.findall("PointData/DataArray")}
        self.cell_data = {a.attrib["Name"]: self._tuples(a) for a in piece.findall("CellData/DataArray")}
        self.cells = {}
        for kind in ("Verts", "Lines", "Polys"):
            cells = int(piece.attrib["NumberOf" + kind])
            if piece.find(kind) is None:
                assert cells == 0
                continue
            corners, offsets = map(self._read, piece.findall(f"{kind}/DataArray"))
            begins = [0, *offsets][:-1]
            self.cells[kind] = [list(corners[a:b]) for a, b in zip(begins, offsets)]
            assert len(self.cells[kind]) == cells and sorted(corners) == list(range(count))
            for values in self.cell_data.values():
                assert len(values) == cells
        assert len(self.points) == count
        for values in self.point_data.values():
            assert len(values) == count
        assert self._used == len(self._data), "bytes that no array tells of"

    def _read(self, array):
        offset = int(array.attrib["offset"])
        size, = struct.unpack_from(self._order + "Q", self._data, offset)
        code = _CODES[array.attrib["type"]]
        self._used += 8 + size
        return struct.unpack_from(f"{self._order}{size // 8}{code}", self._data, offset + 8)

    def _tuples(self, array):
        values, n = self._read(array), int(array.attrib["NumberOfComponents"])
        return list(values) if n == 1 else list(zip(*[iter(values)] * n))


def read_part(path):
    """A .vtp file, or all pieces of a .pvtp file, as [Piece]."""
    if path.endswith(".vtp"):
        return [Piece(path)]
    root = ElementTree.parse(path).getroot()
    assert root.attrib["type"] == "PPolyData"
    pieces = [Piece(os.path.join(os.path.dirname(path), p.attrib["Source"])) for p in root.iter("Piece")]
    for tag, data in (("PPointData", "point_data"), ("PCellData", "cell_data")):
        told = [a.attrib["Name"] for a in root.findall(f"PPolyData/{tag}/PDataArray")]
        for piece in pieces:
            assert told == list(getattr(piece, data)), (told, list(getattr(piece, data)))
    return pieces


def read_series(path):
    """[(time, {name of part: path})] of a .pvd file."""
    steps = {}
    for entry in ElementTree.parse(path).getroot().iter("DataSet"):
        steps.setdefault(float(entry.attrib["timestep"]), {})[entry.attrib["name"]] = os.path.join(
            os.path.dirname(path), entry.attrib["file"])
    return sorted(steps.items())
