# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Grains on a jittered lattice over a floor of 9.5 x 7.2, each with a velocity of its own, and scenes with them."""

import os
import random

from talus_testing import SceneCase, Sphere, head, write_sphere_data

LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
SCENE = head(boundary="{boundary}", newton="{newton}") + """
read_data grains
{pair}
neighbor 0.1 bin
timestep 0.001
{movers}
fix floor all large/body plane 0 0 0  0 0 1  contact {law}
{more}
thermo_modify norm no lost ignore
dump all all custom {every} dump id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz {columns}
dump_modify all format float %a sort id
{run}
"""
PAIR = "pair_style gran/penalty\npair_coeff * * {law}"
MOVERS = "fix step all nve/sphere/symplectic start {start} gravity 4.0 vector 0.3 0.1 -1"


def tossed_grains(layers):
    draw = random.Random(4)
    return [Sphere(tuple(1.15 * s + 0.7 + draw.uniform(-0.1, 0.1) for s in (i, j, k)),
                   v=tuple(draw.uniform(-2.0, 2.0) for _ in "xyz"),
                   diameter=draw.uniform(0.7, 1.15))
            for i in range(8) for j in range(6) for k in range(layers)]


class TossedCase(SceneCase):
    """Three layers of them in a box that is open at the top and a little deeper than the floor."""

    types = 1    # they take turns

    def setUp(self):
        super().setUp()
        grains = tossed_grains(3)
        for k, grain in enumerate(grains):
            grain.type = 1 + k % self.types
        write_sphere_data(self.path("grains"), ((0, 9.5), (0, 7.2), (-0.5, 6.5)), grains)

    def run_tossed(self, np=1, threads=1, law=LAW, pair=PAIR, movers=MOVERS, start="plain", boundary="f f f", more="",
                   every=20, columns="", run="run 130", newton="off"):
        """The text of the dump and of the log."""
        script = SCENE.format(boundary=boundary, pair=pair.format(law=law), movers=movers.format(start=start), law=law,
                              more=more, every=every, columns=columns, run=run, newton=newton)
        log = self.run_lammps(script, np=np, env={"OMP_NUM_THREADS": str(threads)}).log
        frames = self.read("dump")
        os.remove(self.path("dump"))
        self.assertNotRegex(log, "Dangerous builds = [1-9]")    # a list that came too late voids every promise
        return frames, log
