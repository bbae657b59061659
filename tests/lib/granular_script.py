# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The first lines of an input script for spheres. Arguments may be fields of a format string."""


def head(units="lj", boundary="f f f", map="yes", newton="off", style="sphere"):
    """Up to where particles come from."""
    return f"""
units {units}
boundary {boundary}
atom_style {style}
{f"atom_modify map {map}" if map else ""}
newton {newton}
comm_modify vel yes
"""


def begin(units="si", boundary="f f f", data="data"):
    """Up to the pair style."""
    return head(units, boundary) + f"read_data {data}\npair_style gran/penalty\n"
