# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""compute timestep/gran against its formulas, and the warning of pair gran/penalty about large time steps."""

import math
import re
import unittest

from talus_testing import SceneCase, Sphere, begin, thermo, write_sphere_data

SCRIPT = begin("{units}") + """
{pairs}
{more}
neighbor 0.2 bin
fix step all nve/sphere/symplectic
timestep {dt!r}
{group}
compute t {name} timestep/gran
thermo_style custom step c_t[1] c_t[2] c_t[3] c_t[4] c_t[5] c_t[6]
thermo_modify format float %.17g norm no
thermo 1
run {steps}
"""
R = 0.5
RADII = 0.5, 0.3
DENSITIES = 1000.0, 2000.0
WARNING = r"WARNING: Pair style gran/penalty: the time step is (\S+) of the critical one \((\S+);"


def mass(type):
    return DENSITIES[type] * 4 / 3 * math.pi * RADII[type]**3


def sphere(type, x, v=(0, 0, 0)):
    return Sphere(x, v, diameter=2 * RADII[type], density=DENSITIES[type], type=type + 1)


def reduced(a, b):
    return a * b / (a + b)


def rayleigh(type, young, poisson):
    shear = young / (2 * (1 + poisson))
    return math.pi * RADII[type] * math.sqrt(DENSITIES[type] / shear) / (0.1631 * poisson + 0.8766)


def modulus(a, b):
    """Effective modulus of (E, nu), (E, nu)."""
    return 1 / ((1 - a[1]**2) / a[0] + (1 - b[1]**2) / b[0])


def hertz_time(types, young, speed):
    m, r = reduced(*map(mass, types)), reduced(*(RADII[t] for t in types))
    return 2.87 * (m * m / (r * young**2 * speed))**0.2


CLUMPS = begin("si", law="{law}") + """
{body}
fix prop all property/atom mol ghost yes
set atom 1*2 mol 1
set atom 3*4 mol 2
neigh_modify every 1 exclude molecule/intra all
neighbor 0.2 bin
fix move all {move}
compute t all timestep/gran
thermo_style custom step c_t[1] c_t[2] c_t[3] c_t[7]
thermo_modify format float %.17g norm no
timestep 1e-7
run 0
"""
# two touching unlike spheres, a third near one of them, all at rest but the third
OVERLAP, SPEED = 2e-3, 3.0
TOUCHING = [sphere(0, (0, 0, 0)), sphere(1, (RADII[0] + RADII[1] - OVERLAP, 0, 0)),
            sphere(0, (-1.1, 0, 0), (0, 0, SPEED))]
APART = [sphere(0, (0, 0, 0)), sphere(1, (3, 0, 0)), sphere(0, (0, 3, 0))]


class TimestepCompute(SceneCase):

    def compute(self, pairs, spheres, dt=1e-7, np=1, units="si", more="", group="", name="all", steps=0):
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, spheres, types=2)
        script = SCRIPT.format(pairs=pairs, dt=dt, units=units, more=more, group=group, name=name, steps=steps)
        self.log = self.run_lammps(script, np=np).log
        row = thermo(self.log)[0]
        return [row[f"c_t[{n}]"] for n in range(1, 7)]

    def check(self, what, pairs, spheres, expected, **options):
        """expected: contact, Rayleigh, Hertz"""
        dt = options.get("dt", 1e-7)
        for np in 1, 2:
            found = self.compute(pairs, spheres, np=np, **options)
            print(f"{what:34}{np:2} ranks " + "".join(f"{f:12.5e}/{e:.5e}" for f, e in zip(found, expected)))
            for f, e in zip(found, expected):
                self.assert_close(f, e, 1e-9, f"{what}: {found} against {expected}")
            for fraction, step in zip(found[3:], expected):
                self.assert_close(fraction, dt / step if step else 0.0, 1e-9, what)

    def of_clumps(self, gap, move, law="hooke 1e6 0", body="", np=1):
        """Of two dumbbells in a row, which are apart by so much."""
        d = 2 * RADII[0]
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, [sphere(0, (x, 0, 0), (v, 0, 0)) for x, v in
                          ((-d - 0.7, SPEED), (-d, SPEED), (gap, 0), (gap + 0.7, 0))], types=2)
        return thermo(self.run_lammps(CLUMPS.format(law=law, move=move, body=body), np=np).log)[0]

    def test_clumps_have_their_mass(self):
        """Whether they touch or not; for stability each sphere has its own."""
        m = mass(0)
        for move in "rigid/small/symplectic molecule", "rigid/small molecule", "rigid molecule":
            for np in 1, 2:
                for gap in -OVERLAP, 0.1:
                    with self.subTest(move, gap=gap, ranks=np):
                        row = self.of_clumps(gap, move, np=np)
                        self.assert_close(row["c_t[1]"], math.sqrt(m / 1e6), 1e-9)
                        self.assert_close(row["c_t[7]"], math.sqrt(4 * 0.5 * m / (4 * 1e6)), 1e-9)
        row = self.of_clumps(0.1, "rigid/small/symplectic molecule", body="fix b all large/body plane 0 0 -3 0 0 1 contact hooke 1e6 0")
        self.assert_close(row["c_t[1]"], math.sqrt(m / 1e6), 1e-9)    # two clumps: half the mass of one with the floor
        row = self.of_clumps(0.1, "rigid/small/symplectic molecule", body="fix b all large/body plane 0 0 -3 0 0 1 contact hooke 4e6 0")
        self.assert_close(row["c_t[1]"], math.sqrt(2 * m / 4e6), 1e-9)
        row = self.of_clumps(0.1, "rigid/small/symplectic molecule", "hertz/material 1e8 0.5 0.3")
        self.assert_close(row["c_t[2]"], rayleigh(0, 1e8, 0.3), 1e-9)
        self.assert_close(row["c_t[3]"], 2.87 * (m * m / (0.25 * modulus((1e8, 0.3), (1e8, 0.3))**2 * SPEED))**0.2, 1e-9)

    def test_hooke(self):
        """Only the contact time is defined: sqrt(m/kn), of contacts, else of the lightest pair."""
        pairs = "pair_coeff 1 1 hooke 1e6 10\npair_coeff 2 2 hooke 3e6 10"
        print()
        self.check("hooke", pairs, TOUCHING, (math.sqrt(reduced(mass(0), mass(1)) / 2e6), 0, 0))
        lightest = min(math.sqrt(reduced(mass(i), mass(j)) / k)
                       for i, j, k in ((0, 0, 1e6), (0, 1, 2e6), (1, 1, 3e6)))
        self.check("hooke, no contact", pairs, APART, (lightest, 0, 0))
        self.check("hooke without stiffness", "pair_coeff * * hooke 0.0 10", TOUCHING, (0, 0, 0))

    def test_hertz(self):
        """k = 3/2 kn sqrt(R d); E_eff = 3/4 kn; no Rayleigh time without a material."""
        pairs = "pair_coeff * * hertz 1e8 10"
        r = reduced(*RADII)
        contact = math.sqrt(reduced(mass(0), mass(1)) / (1.5 * 1e8 * math.sqrt(r * OVERLAP)))
        hertz = min(hertz_time(t, 0.75e8, SPEED) for t in ((0, 0), (0, 1), (1, 1)))
        print()
        self.check("hertz", pairs, TOUCHING, (contact, 0, hertz))
        # at 1 % of the smaller radius; nothing moves
        apart = min(math.sqrt(reduced(mass(i), mass(j)) / (1.5e8 * math.sqrt(
            reduced(RADII[i], RADII[j]) * 0.01 * min(RADII[i], RADII[j]))))
            for i, j in ((0, 0), (0, 1), (1, 1)))
        self.check("hertz, no contact, at rest", pairs, APART, (apart, 0, 0))
        self.check("flores", pairs.replace("hertz", "flores"), TOUCHING, (contact, 0, hertz))

    def test_hertz_material(self):
        materials = (1e8, 0.3), (5e8, 0.2)
        pairs = "\n".join(f"pair_coeff {t} {t} hertz/material {e} 0.5 {nu}" for t, (e, nu) in enumerate(materials, 1))
        young = modulus(*materials)
        contact = math.sqrt(reduced(mass(0), mass(1)) / (2 * young * math.sqrt(reduced(*RADII) * OVERLAP)))
        hertz = min(hertz_time((i, j), modulus(materials[i], materials[j]), SPEED)
                    for i, j in ((0, 0), (0, 1), (1, 1)))
        wave = min(rayleigh(t, *materials[t]) for t in (0, 1))
        print()
        self.check("hertz/material", pairs, TOUCHING, (contact, wave, hertz))
        self.check("flores/material", pairs.replace("hertz/material", "flores/material").replace("\n", " 1.0\n")
                   + " 1.0", TOUCHING, (contact, wave, hertz))

    def test_after_a_run(self):
        """The contacts are those of its last step, not what is left of them."""
        for law in "hertz 1e8 10", "hertz 1e8 10 tangential multistep NULL NULL 0.5":
            self.compute(f"pair_coeff * * {law}", TOUCHING, steps="5\nprint 'after $(c_t[1]:%.17g) $(c_t[3]:%.17g)'")
            last = thermo(self.log)[-1]
            after = re.search(r"^after (\S+) (\S+)", self.log, re.MULTILINE).groups()
            self.assertEqual(tuple(map(float, after)), (last["c_t[1]"], last["c_t[3]"]))

    def test_linear_and_plaincoulomb_materials(self):
        """hooke/material: kn from vchar; Rayleigh defined, Hertz not."""
        young, nu, speed = 1e8, 0.3, 2.0
        m, r, e = reduced(mass(0), mass(1)), reduced(*RADII), modulus((young, nu), (young, nu))
        scale = 16 / 15 * math.sqrt(r) * e
        kn = scale * (m * speed**2 / scale)**0.2
        wave = min(rayleigh(t, young, nu) for t in (0, 1))
        print()
        self.check("hooke/material", f"pair_coeff * * hooke/material {young} 0.5 {nu} {speed}", TOUCHING,
                   (math.sqrt(m / kn), wave, 0))
        self.check("plaincoulomb/material", f"pair_coeff * * plaincoulomb/material {young} 0.5 {nu} 0.5", TOUCHING,
                   (math.sqrt(m / (2 * e * math.sqrt(OVERLAP))), wave, 0))

    def test_numbers_of_the_warning(self):
        """What is told is above the limit, or nothing is; and only rules that are defined are."""
        pairs = "pair_coeff * * hooke 1e6 10"
        critical = math.sqrt(reduced(mass(0), mass(1)) / 1e6)
        for fraction, told in ((0.2, []), (0.2005, []), (0.2012, ["0.201"]), (0.25, ["0.25"])):
            self.compute(pairs, TOUCHING, dt=fraction * critical)
            self.assertEqual([found[0] for found in re.findall(WARNING, self.log)], told)
        self.assertRegex(self.log, r"critical one \((\S+); contact \1\): at most 0\.2 of it is advised")
        self.compute("pair_coeff * * hertz/material 1e8 0.5 0.3", TOUCHING, dt=critical)
        self.assertRegex(self.log, r"critical one \(\S+; contact \S+, Rayleigh \S+, Hertz \S+\): at most")

    def test_cure_of_instability(self):
        """Less damping is advised where it helps: not where the springs alone are too stiff."""
        cures = r"are stable with the damping of their contacts \(\S+\): (.*?)(?: \(src.*)?$"
        critical = math.sqrt(reduced(mass(0), mass(1)) / 1e6)
        for gn, fraction, cure in ((0.0, 2.0, "use a smaller one"), (10.0, 2.0, "use a smaller one"),
                                   (4000.0, 0.3, "use a smaller one, less damping (gt above all)")):
            self.compute(f"pair_coeff * * hooke 1e6 {gn} tangential multistep NULL NULL 0.5", TOUCHING, dt=fraction * critical)
            self.assertEqual(re.findall(cures, self.log, re.MULTILINE), [cure])

    def test_group(self):
        """The sizes of the group's particles count; the contacts are those of all."""
        pairs = "pair_coeff * * hertz/material 1e8 0.5 0.3"
        young = modulus((1e8, 0.3), (1e8, 0.3))
        contact = math.sqrt(reduced(mass(0), mass(1)) / (2 * young * math.sqrt(reduced(*RADII) * OVERLAP)))
        self.check("group of type 1", pairs, TOUCHING,
                   (contact, rayleigh(0, 1e8, 0.3), hertz_time((0, 0), young, SPEED)), group="group big type 1",
                   name="big")

    def test_group_of_a_body(self):
        """A large body counts for the particles that it can touch, in the compute's group."""
        floor = "fix floor big large/body plane 0 0 -4 0 0 1 contact hooke {k} 0.0"
        big = math.sqrt(mass(0) / 1e7)
        for k, group, expected in ((1e7, "all", big), (1e7, "small", math.sqrt(mass(1) / 1e4))):
            found = self.compute("pair_coeff * * hooke 1e4 0.0", APART, group="group small type 2", name=group,
                                 more="group big type 1\n" + floor.format(k=k))
            self.assert_close(found[0], expected if group == "all" else math.sqrt(reduced(mass(1), mass(1)) / 1e4),
                              1e-9, group)

    def test_units(self):
        """units real: force/mass is acceleration only after conversion, and stiffness is per pressure."""
        ftm2v = 1.0 / 48.88821291**2
        found = self.compute("pair_coeff * * hooke 100.0 0.0", TOUCHING, units="real")
        self.assert_close(found[0], math.sqrt(reduced(mass(0), mass(1)) / 100.0 / ftm2v), 1e-6)

    def warns(self, pairs, spheres, dt, more=""):
        self.compute(pairs, spheres, dt=dt, more=more)
        found = re.findall(WARNING, self.log)
        return found[0] if found else None

    def test_warning(self):
        """Visibly above a fifth of the smallest defined time step, not below, and not if nothing is defined."""
        cases = {"hooke": ("pair_coeff * * hooke 1e6 10", TOUCHING),
                 "hertz/material": ("pair_coeff * * hertz/material 1e8 0.5 0.3", TOUCHING),
                 "hertz/material, no contact": ("pair_coeff * * hertz/material 1e8 0.5 0.3", APART),
                 "hertz, no contact": ("pair_coeff * * hertz 1e8 10", APART)}
        for name, (pairs, spheres) in cases.items():
            smallest = min(t for t in self.compute(pairs, spheres)[:3] if t > 0)
            self.assertIsNone(self.warns(pairs, spheres, 0.2009 * smallest), name)
            fraction, critical = self.warns(pairs, spheres, 0.2012 * smallest)
            self.assertEqual(fraction, "0.201", name)
            self.assert_close(float(critical), smallest, 1e-3)
        self.assertIsNone(self.warns("pair_coeff * * hooke 0.0 0.0", APART, 1.0))

    def test_warning_appears_once_a_run(self):
        self.compute("pair_coeff * * hooke 1e6 10", APART, dt=1.0, steps=5)
        self.assertEqual(len(re.findall(WARNING, self.log)), 1)

    def test_particles_that_come_during_a_run(self):
        """A light particle is inserted; its density is fix deposit's, 1."""
        heavy = [sphere(0, (-4, -4, -4)), sphere(0, (4, 4, -4))]
        law, light = "pair_coeff * * hooke 1e6 10", 1.0 * 4 / 3 * math.pi * 0.5**3
        insert = "region hole block -1 1 -1 1 -1 1\nfix drops all deposit 1 {type} 3 4711 region hole\nneigh_modify check no"
        dt = 0.15 * math.sqrt(reduced(mass(0), mass(0)) / 1e6)
        for np in 1, 2:
            self.compute(law, heavy, dt=dt, steps=8, np=np, more=insert.format(type=1))
            (fraction, _), = re.findall(WARNING, self.log)
            self.assertAlmostEqual(float(fraction), dt / math.sqrt(light / 2 / 1e6), delta=0.01)
        self.compute(law, heavy, dt=dt, steps=8)
        self.assertEqual(re.findall(WARNING, self.log), [], "nothing has come")

    def test_contacts_of_bodies(self):
        """A stiff body alone: no pairs touch, so the law of the particles decides."""
        found = self.compute("pair_coeff * * hooke 1e4 10", [sphere(0, (0, 0, 0.499)), sphere(1, (3, 0, 3))],
                             more="fix f all large/body plane 0 0 0 0 0 1 contact hooke 1e8 0.0", dt=1e-4)
        print(f"\nbody: contact time reported {found[0]:.3e}, of the body's contact {math.sqrt(mass(0) / 1e8):.3e}, "
              f"warning: {bool(re.search(WARNING, self.log))}")
        self.assertGreater(found[0], 0.0)


if __name__ == "__main__":
    unittest.main()
