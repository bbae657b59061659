# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Fields of a grid as a time series for ParaView: one .vti file for each time, and a .pvd file that lists them."""

import os

import numpy


class Series:

    def __init__(self, folder, name, cells, edge):
        self.folder, self.name, self.cells, self.edge = folder, name, cells, edge
        self.rows = []
        os.makedirs(folder, exist_ok=True)

    def write(self, time, **fields):
        """Arrays [z][y][x], or [z][y][x][3]."""
        file_name = f"{self.name}.{len(self.rows)}.vti"
        extent = " ".join(f"0 {count}" for count in self.cells)
        heads, data, at = [], [], 0
        for field, values in fields.items():
            values = numpy.ascontiguousarray(values, dtype="<f4")
            heads.append(f'<DataArray type="Float32" Name="{field}" NumberOfComponents="{3 if values.ndim == 4 else 1}" '
                         f'format="appended" offset="{at}"/>\n')
            data.append(numpy.uint32(values.nbytes).tobytes() + values.tobytes())
            at += len(data[-1])
        with open(os.path.join(self.folder, file_name), "wb") as file:
            file.write(f'<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian">\n<ImageData WholeExtent="{extent}" '
                       f'Origin="0 0 0" Spacing="{self.edge} {self.edge} {self.edge}">\n<Piece Extent="{extent}">\n'
                       f'<CellData>\n{"".join(heads)}</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding="raw">\n_'.encode())
            file.write(b"".join(data) + b"\n</AppendedData>\n</VTKFile>\n")
        self.rows.append(f'<DataSet timestep="{time:.9g}" file="{file_name}"/>\n')
        with open(os.path.join(self.folder, self.name + ".pvd"), "w") as file:
            file.write(f'<VTKFile type="Collection" version="0.1">\n<Collection>\n{"".join(self.rows)}</Collection>\n</VTKFile>\n')
