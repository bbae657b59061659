# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Clumps of spheres and convex particles in one scene: momentum and angular momentum are kept, and the same bits on any
ranks and threads, and on a mesh."""

import os
import unittest

import body_meshes
import tossed_clumps
from talus_testing import SceneCase, head, read_dump, thermo

SCENE = head() + """
comm_modify cutoff 4
fix which all property/atom mol ghost yes
{read}
group clumps type 1
group shapes type 2
neigh_modify exclude molecule/intra clumps every 1 delay 0 check yes
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * {law}
timestep 5e-4
fix move clumps rigid/small/symplectic molecule
fix shapes shapes shape/gran type 2 box 1.5 1.2 1.0 rounded 0.1 density 1 orient random 7
{commands}
thermo {every}
thermo_style custom step f_shapes[6] {columns}
thermo_modify norm no format float %.17g lost error
dump all all custom {steps} {dump} id type x y z vx vy vz omegax omegay omegaz radius mass f_shapes[1] f_shapes[2] &
    f_shapes[3] f_shapes[4]
dump_modify all sort id format float %.17g
"""
LAW = "hertz 1e4 40 tangential multistep NULL NULL 0.5"
MOLECULES = "read_data ../clumps fix which NULL Molecules"


class ShapesAndClumps(SceneCase):

    def scene(self, name, commands, np=1, law=LAW, columns="", every=100, read=MOLECULES, steps=2000,
              env=None, end=""):
        where = self.path(name)
        os.makedirs(where, exist_ok=True)
        script = SCENE.format(read=read, law=law, commands=commands, columns=columns, every=every,
                              dump="end", steps=steps) + (end or f"run {steps}")
        return where, self.run_lammps(script, np=np, cwd=where, env=env).log

    def setUp(self):
        tossed_clumps.write_clumps(self.path("clumps"), box=3 * ((-30, 39), ))
        body_meshes.write_stl(self.path("tank.stl"), body_meshes.box((-1, -1, -1), (10, 10, 10), 3))

    def test_momentum_is_kept(self):
        # L of clumps is that of their spheres, with 2/5 m R^2 of each; that of shapes about their centers is in the fix
        sums = {"px": "mass*vx", "py": "mass*vy", "pz": "mass*vz"}
        for d, (a, b) in zip("xyz", (("y", "z"), ("z", "x"), ("x", "y"))):
            sums["l" + d] = f"mass*({a}*v{b}-{b}*v{a})+(type==1)*0.4*mass*radius^2*c_w[{'xyz'.index(d) + 1}]"
        commands = "compute w all property/atom omegax omegay omegaz\n" + "\n".join(f"variable a{k} atom {v}\ncompute c{k} all reduce sum v_a{k}" for k, v in sums.items())
        columns = " ".join(f"c_c{k}" for k in sums) + " " + " ".join(f"f_shapes[{k}]" for k in (3, 4, 5))
        # torques of friction between spheres have arms of one radius each, as in LAMMPS, whatever the overlap is
        for law in LAW, "hertz 1e4 40":
            _, log = self.scene("thrown", commands, columns=columns, law=law)
            rows = thermo(log)
            self.assertGreater(max(row["f_shapes[6]"] for row in rows), 0)
            worst = turned = 0.0
            for d, k in zip("xyz", (3, 4, 5)):
                worst = max(worst, *(abs(row[f"c_cp{d}"] - rows[0][f"c_cp{d}"]) for row in rows))
                spin = [row[f"c_cl{d}"] + row[f"f_shapes[{k}]"] for row in rows]
                turned = max(turned, *(abs(s - spin[0]) for s in spin))
            print(f"momentum within {worst:.1e} of up to {max(abs(rows[0]['c_cp' + d]) for d in 'xyz'):.1f}, "
                  f"angular momentum within {turned:.1e} of {spin[0]:.1f}")
            self.assertLess(worst, 1e-12)
            if law != LAW:
                self.assertLess(turned, 1e-10)

    def test_bits(self):
        walls = f"fix tank all large/body mesh ../tank.stl inside contact {LAW}\n" \
                "fix g all gravity/talus 5 vector 0.2 0.1 -1"
        one, log = self.scene("one", walls)
        self.assertGreater(max(row["f_shapes[6]"] for row in thermo(log)), 1)
        for name, np, env in (("two", 2, None), ("four", 4, None), ("threads", 1, {"OMP_NUM_THREADS": "3"})):
            with self.subTest(name):
                where, _ = self.scene(name, walls, np=np, env=env)
                for mine, theirs in zip(read_dump(os.path.join(where, "end")), read_dump(os.path.join(one, "end"))):
                    self.assert_same_bits(mine, theirs)


if __name__ == "__main__":
    unittest.main()
