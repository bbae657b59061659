# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 timeout=400
"""Periodic boxes that are driven by stress: the strength of a crystal, input/in.element, and lengths beside those of LAMMPS."""

import os
import re
import unittest

from talus_testing import SceneCase

# FCC along its axes at constant lateral stress: layers slide when (C. Thornton, Geotechnique 29, 441 (1979))
#   sigma_z / sigma_x = 2 (1 + mu) / (1 - mu)
CRYSTAL = """
units si
newton off
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p p p
lattice fcc 1.4135e-3 origin 0.25 0.25 0.25
region box block 0 {cells}
create_box 1 box
create_atoms 1 box
set type 1 diameter 1.0e-3 density 2500
{pair}
neighbor 1e-4 bin
fix move all nve/sphere
timestep 2.5e-7
compute contact all pressure NULL virial
variable ratio equal 2*c_contact[3]/(c_contact[1]+c_contact[2])
thermo_style custom step lx ly lz c_contact[1] c_contact[3] v_ratio
thermo_modify norm no format float %.15g
thermo 100
fix drive all deform/pressure 1 x pressure 1e5 {gain} y pressure 1e5 {gain} z pressure 1e5 {gain} max/rate 5 remap {remap}
run 4000
unfix drive
fix drive all deform/pressure 1 z trate -1.0 x pressure 1e5 {gain} y pressure 1e5 {gain} max/rate 5 remap {remap}
run {steps}
"""
STOCK = """pair_style granular
pair_coeff * * hertz/material 1e10 0.5 0.3 tangential mindlin NULL 1.0 {mu} damping coeff_restitution"""
OWN = """pair_style gran/penalty
pair_coeff * * hertz/material 1e10 0.5 0.3 tangential mindlin NULL 1.0 {mu}"""
GAIN = 2e-3


class ElementTests(SceneCase):

    def rows(self, pair, mu, cells, steps, remap, **options):
        script = CRYSTAL.format(pair=pair.format(mu=mu), cells=cells, gain=GAIN, steps=steps, remap=remap)
        log = self.run_lammps(script, **options).log
        runs = re.findall(r"^ +Step .*\n((?: +[\d.e+-]+)+\n)+", log, re.M)
        self.assertEqual(len(runs), 2)
        return [[float(word) for word in line.split()] for line in log.splitlines() if re.match(r"^ +\d+( +[\d.e+-]+){6}$", line)]

    def test_strength_of_a_crystal(self):
        for mu, steps in (0.0, 4000), (0.3, 6000), (0.5, 9000):
            expected = 2 * (1 + mu) / (1 - mu)
            rows = self.rows(OWN, mu, "3 0 4 0 5", steps, "v")
            begin = next(row for row in rows if row[0] == 4000)
            peak = max(row[6] for row in rows if row[0] > 4000)
            print(f"mu {mu}: peak of the ratio of stresses {peak:.3f}, by theory {expected:.3f}")
            self.assertAlmostEqual(begin[4], 1e5, delta=200)
            self.assertAlmostEqual(begin[5], 1e5, delta=200)
            self.assertAlmostEqual(peak, expected, delta=0.02 * expected)

    def test_lengths_of_a_small_box_are_those_of_stock(self):
        """Of less than three diameters, with the suffix; `remap x`, since LAMMPS' speeds of sides are wrong with v."""
        for np in 1, 2:
            stock = self.rows(STOCK, 0.3, "2 0 2 0 3", 1000, "x", np=np)
            found = self.rows(STOCK, 0.3, "2 0 2 0 3", 1000, "x", np=np, arguments=("-sf", "talus"))
            self.assertEqual(len(found), len(stock))
            for mine, theirs in zip(found, stock):
                for k in 1, 2, 3:
                    self.assertAlmostEqual(mine[k] / theirs[k], 1, delta=1e-9)


class Scene(SceneCase):
    """input/in.element, small."""

    def measured(self, test, **variables):
        with open(os.path.join(os.environ["TALUS_SOURCE_DIR"], "input", "in.element")) as file:
            log = self.run_lammps(file.read(), variables={"test": test, "number": 400, "stress": 1e5, "strain": 0.06, "rate": 12, "out": self.dir, **variables}).log
        end = log.rsplit("\n--- ", 1)[1]
        print(end)
        x, z = map(float, re.search(r"stress along x and y, z +(\S+) (\S+) Pa", end).groups())
        with open(self.path("element.txt")) as file:
            rows = [list(map(float, line.split())) for line in file if line[0] != "#"]
        return x, z, rows

    def test_triaxial(self):
        x, z, _ = self.measured("triaxial")
        self.assertAlmostEqual(x, 1e5, delta=5e3)
        self.assertGreater(z, 2e5)

    def test_oedometer(self):
        x, z, rows = self.measured("oedometer")
        self.assertGreater(z, 5e5)
        self.assertGreater(z / x, 1.2)
        self.assertGreater(rows[-1][4], rows[0][4] + 0.02)

    def test_volume(self):
        _, _, rows = self.measured("volume")
        self.assertAlmostEqual(rows[-1][4], rows[0][4], delta=1e-4)

    def test_isotropic(self):
        x, z, rows = self.measured("isotropic", target=3e5)
        self.assertAlmostEqual(x, 3e5, delta=6e3)
        self.assertAlmostEqual(z, 3e5, delta=6e3)
        self.assertGreater(rows[-1][5], rows[0][5])


if __name__ == "__main__":
    unittest.main()
