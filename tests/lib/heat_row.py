# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Ten spheres in a row between two walls, through which heat flows; positions are fixed."""

import math

from talus_testing import SceneCase, Sphere, head, read_dump, thermo, write_sphere_data

COUNT, DIAMETER, OVERLAP = 10, 0.01, 1e-4
DENSITY, CONDUCTIVITY, CAPACITY = 2500.0, 3000.0, 300.0
MASS = DENSITY * math.pi / 6 * DIAMETER**3
LENGTH = COUNT * (DIAMETER - OVERLAP) - OVERLAP    # the walls are pressed in as much
BETWEEN = 2 * CONDUCTIVITY * math.sqrt(DIAMETER / 4 * OVERLAP)    # power over difference of temperature
AT_WALL = 2 * CONDUCTIVITY * math.sqrt(DIAMETER / 2 * OVERLAP)
LAW = f"hertz/material 1e6 0.9 0.3 heat radius {CONDUCTIVITY}"
PAIR = f"pair_style gran/penalty\npair_coeff * * {LAW}"
SCENE = head("si", "f p p") + """
fix therm all property/atom temperature heatflow ghost yes
read_data spheres
{pair}
neighbor 0.001 bin
timestep 0.01
set group all temperature {start}
{more}
fix heat all heat/flow constant {capacity}
thermo_style custom step {columns}
thermo_modify format float %.17g
thermo {thermo}
compute t all property/atom temperature
dump grains all custom {every} grains id c_t
dump_modify grains sort id format float %.17g
run {steps}
"""
PLANES = """
fix lo all large/body plane 0 0 0 1 0 0 contact {law} {lo}
fix hi all large/body plane {length} 0 0 -1 0 0 contact {law} {hi}
"""


class HeatRowCase(SceneCase):

    def setUp(self):
        start = DIAMETER / 2 - OVERLAP
        spheres = [Sphere((start + k * (DIAMETER - OVERLAP), 0.02, 0.02), diameter=DIAMETER, density=DENSITY) for k in range(COUNT)]
        write_sphere_data(self.path("spheres"), ((-0.01, LENGTH + 0.01), (0, 0.04), (0, 0.04)), spheres)

    def heat(self, more="", start=0.0, pair=PAIR, columns="f_lo[21] f_hi[21]", steps=5000, every=5000, rows=5000, **options):
        """Temperatures by sphere in the dumps, and rows of thermo output."""
        log = self.run_lammps(SCENE.format(pair=pair, start=start, more=more, capacity=CAPACITY, columns=columns, steps=steps,
                                           every=every, thermo=rows), **options).log
        return [[row[1] for _, row in sorted(frame.atoms.items())] for frame in read_dump(self.path("grains"))], thermo(log)

    def planes(self, lo, hi):
        return PLANES.format(law=LAW, length=LENGTH, lo=lo, hi=hi)

    def steady(self, lo, hi):
        """Flow from lo to hi, and the temperatures."""
        flow = (lo - hi) / (2 / AT_WALL + (COUNT - 1) / BETWEEN)
        return flow, [lo - flow * (1 / AT_WALL + k / BETWEEN) for k in range(COUNT)]
