# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The first lines of an input script for spheres of gran/penalty."""


def begin(units="si", boundary="f f f", data="data"):
    """Up to the pair style; arguments may be fields of a format string."""
    return f"""
units {units}
boundary {boundary}
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
read_data {data}
pair_style gran/penalty
"""
