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


def begin(units="lj", boundary="f f f", read="read_data data", law=None, skin=None, dt=None, **more):
    """Up to the pair style, with what is given of its coefficients, the skin and the time step."""
    given = {f"pair_coeff * * {law}": law, f"neighbor {skin} bin": skin, f"timestep {dt}": dt}
    return "\n".join([head(units, boundary, **more) + read, "pair_style gran/penalty",
                      *(line for line, value in given.items() if value is not None), ""])
