# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Meshes as STL files."""


def write(path, name, triangles):
    """triangles: three corners (x, y, z) each, counter-clockwise as seen from where particles are."""
    with open(path, "w") as file:
        file.write(f"solid {name}\n")
        for corners in triangles:
            vertices = "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*corner) for corner in corners)
            file.write(f"facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
        file.write(f"endsolid {name}\n")
