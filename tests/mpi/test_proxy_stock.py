# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Stock styles under `comm_proxy yes`: dumps and thermo output are those of the stock exchange, bit for bit."""

import os
import re
import unittest

from talus_testing import SceneCase, head

STEPS = 70

# like bench/in.chute of LAMMPS: grains on frozen ones, periodic along the chute
CHUTE = head(boundary="p p fs", map=None) + """
lattice sc 0.8
region box block -0.5 9.5 -0.5 7.5 -0.5 9
create_box 2 box
region floor block INF INF INF INF -0.5 0.4
region grains block INF INF INF INF 0.6 7
create_atoms 2 region floor
create_atoms 1 region grains
set group all diameter 1.0 density 1.0
displace_atoms all random 0.05 0.05 0.05 77
reset_atoms id sort yes
pair_style gran/hooke/history 2000.0 NULL 50.0 NULL 0.5 0
pair_coeff * *
timestep 0.005
neighbor 0.1 bin
neigh_modify delay 0 every 1 check yes
group bottom type 2
group active type 1
neigh_modify exclude group bottom bottom
velocity active set 1.5 0.3 -0.5
fix 1 all gravity 1.0 chute 26.0
fix 2 bottom freeze
fix 3 active nve/sphere
"""
# simple shear of a periodic box, with a thermostat that draws from all velocities
SHEAR = """
units lj
atom_style atomic
lattice fcc 0.8442
region box prism 0 5 0 5 0 5 0 0 0
create_box 1 box
create_atoms 1 box
displace_atoms all random 0.05 0.05 0.05 77
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0 2.5
neighbor 0.2 bin
fix 1 all nve
fix 2 all deform 1 xy erate 0.05 remap x
"""
ORTHOGONAL_SHEAR = SHEAR.replace("prism 0 5 0 5 0 5 0 0 0", "block 0 5 0 5 0 5").replace(
    "xy erate 0.05", "x erate 0.05 y erate -0.05")
BONDS = """
units lj
atom_style bond
newton on
lattice sc 0.9
region box block 0 8 0 8 0 8
create_box 1 box bond/types 1 extra/bond/per/atom 8 extra/special/per/atom 60
create_atoms 1 box
displace_atoms all random 0.05 0.05 0.05 77
mass 1 1.0
pair_style lj/cut 1.8
pair_coeff 1 1 1.0 1.0
bond_style harmonic
bond_coeff 1 30.0 1.1
special_bonds lj 0 1 1
neighbor 0.3 bin
create_bonds many all all 1 0.5 1.02
velocity all create 1.0 87287 loop geom
fix 1 all nve
"""
HYBRID = head(boundary="p p p", map=None) + """
lattice sc 0.9
region box block 0 8 0 8 0 8
create_box 2 box
create_atoms 1 box
set group all diameter 1.0 density 1.0
set group all type/fraction 2 0.5 991
displace_atoms all random 0.05 0.05 0.05 77
pair_style hybrid/overlay gran/hooke/history 200.0 NULL 50.0 NULL 0.5 0 soft 1.5
pair_coeff * * gran/hooke/history
pair_coeff 1 2 soft 3.0
pair_coeff 1 1 soft 0.0
pair_coeff 2 2 soft 1.0
velocity all create 2.0 87287 loop geom
neighbor 0.2 bin
timestep 0.002
fix 1 all nve/sphere
compute clusters all cluster/atom 1.1
compute most all reduce max c_clusters
"""
WALLS = CHUTE.replace("p p fs", "f f f").replace("fix 1", """
fix xwall all wall/gran hooke/history 2000.0 NULL 50.0 NULL 0.5 0 xplane -0.53 10.2
fix ywall all wall/gran hooke/history 2000.0 NULL 50.0 NULL 0.5 0 yplane -0.53 8.07
fix 1""")
SCENES = {"chute": CHUTE, "shear box": SHEAR, "orthogonal shear": ORTHOGONAL_SHEAR, "bonds": BONDS,
          "hybrid": HYBRID, "walls": WALLS}
OUTPUT = """
thermo 10
thermo_style custom step temp epair etotal press pxy {more}
thermo_modify format float %.17g norm no
dump all all custom 10 dump.{name}.* id type x y z ix iy iz vx vy vz fx fy fz {spin}
dump_modify all format float %a
run {steps}
run 15 pre no
"""


def script(scene, proxies, name):
    text = SCENES[scene] + OUTPUT.format(
        more="c_most" if "c_clusters" in SCENES[scene] else "", steps=STEPS, name=name,
        spin="omegax omegay omegaz tqx tqy tqz" if "sphere" in SCENES[scene] else "")
    if proxies:
        text = text.replace("thermo 10\n", "comm_proxy yes\nthermo 10\n", 1)
    return f"log log.{name}\n" + text + "clear\n"


class Stock(SceneCase):

    def results(self, name):
        """What the run printed and dumped, as text; how often lists were made."""
        log = self.read("log." + name)
        numbers = [line for line in log.splitlines() if re.match(r"[\s\d.e+-]+$", line)]
        dumps = {}
        for file_name in sorted(os.listdir(self.dir)):
            if file_name.startswith(f"dump.{name}."):
                dumps[file_name.split(".")[2]] = self.read(file_name)
        builds = [int(n) for n in re.findall(r"Neighbor list builds = (\d+)", log)]
        return numbers, dumps, builds

    def check(self, ranks):
        names = {(scene, proxies): scene.replace(" ", "-") + ("-proxies" if proxies else "-stock")
                 for scene in SCENES for proxies in (False, True)}
        self.run_lammps("".join(script(*key, name) for key, name in names.items()), np=ranks)
        for scene in SCENES:
            with self.subTest(scene=scene, ranks=ranks):
                numbers, dumps, builds = self.results(names[scene, True])
                expected = self.results(names[scene, False])
                self.assertGreater(len(numbers), STEPS // 10)
                self.assertGreater(len(dumps), STEPS // 10)
                self.assertGreater(builds[0], 1)
                self.assertEqual(builds, expected[2])
                self.assertEqual(numbers, expected[0])
                self.assertEqual(sorted(dumps), sorted(expected[1]))
                for step, text in expected[1].items():
                    self.assertEqual(dumps[step], text, step)

    def test_one_rank(self):
        self.check(1)

    def test_two_ranks(self):
        self.check(2)

    def test_four_ranks(self):
        self.check(4)

    def test_eight_ranks(self):
        self.check(8)


if __name__ == "__main__":
    unittest.main()
