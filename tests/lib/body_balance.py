# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Newton's third law between particles and large bodies: what a script adds to watch it, and how it is read."""

COLUMNS = "c_scale " + " ".join(f"v_{what}{axis}" for what in ("force", "torque") for axis in "xyz")


def script(bodies):
    """Commands that sum forces, and torques about the origin, over all particles and the fixes large/body named in
    `bodies`. Particles must feel nothing else; gravity of fix nve/sphere/symplectic is not in their force."""
    lines = ["variable scale atom abs(fx)+abs(fy)+abs(fz)", "compute scale all reduce sum v_scale"]
    for k, axis in enumerate("xyz"):
        a, b = (k + 1) % 3, (k + 2) % 3
        u, v = "xyz"[a], "xyz"[b]
        force = "+".join(f"f_{name}[{k + 1}]" for name in bodies)
        moment = "+".join(f"f_{name}[{k + 4}]+f_{name}[{a + 7}]*f_{name}[{b + 1}]-f_{name}[{b + 7}]*f_{name}[{a + 1}]"
                          for name in bodies)
        lines += [f"compute tq{axis} all property/atom tq{axis}",
                  f"variable moment{axis} atom {u}*f{v}-{v}*f{u}+c_tq{axis}",
                  f"compute sum{axis} all reduce sum f{axis} v_moment{axis}",
                  f"variable force{axis} equal c_sum{axis}[1]+{force}",
                  f"variable torque{axis} equal c_sum{axis}[2]+{moment}"]
    return "\n".join(lines) + "\n"


def worst(rows):
    """Largest of the sums over the sum of the sizes of all forces; rows: thermo output with COLUMNS."""
    return max(abs(row[name]) / row["c_scale"] for row in rows for name in COLUMNS.split()[1:])
