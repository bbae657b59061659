# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 stay
"""Lift and drag of rotation of grains in a fluid, talus.h: spin that decays, as stiff as it may be; grains that fall and turn; what
grains get by lift the fluid has lost; ranks, snapshots, several partners, clumps and shapes; words that are refused."""

import math
import random
import unittest

from coupled_case import CoupledCase, TWO_CLUMPS
from talus_testing import Sphere, head, write_sphere_data
from test_fluid_drag import HEAD

DT, DENSITY, FLUID, VISCOSITY = 0.001, 2.0, 1.0, 0.05
MASS = DENSITY * math.pi / 6
INERTIA = 0.1 * MASS    # of a sphere with the diameter 1

# without contacts, in a periodic box, in the records with friction and without
FREE = head(boundary="p p p") + """
read_data grains
{spin}
pair_style gran/penalty
pair_coeff * * hooke 1e3 0 {law}
neighbor 0.2 bin
timestep 0.001
{fix}
thermo 0
"""
SPIN = "set group all omega 1 -2 3"
FRICTION = "tangential multistep NULL NULL 0.5"


def free(law=FRICTION, spin=SPIN, fix="fix step all nve/sphere/symplectic"):
    return FREE.format(law=law, spin=spin, fix=fix)


class LiftCase(CoupledCase):

    def setUp(self):
        super().setUp()
        rng = random.Random(5)
        places = [(x, y, z) for x in (-3, -1, 1, 3) for y in (-3, -1, 1, 3) for z in (-3, 0)][:30]
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-5, 5)),
                          [Sphere([a + rng.uniform(-0.4, 0.4) for a in place], [rng.gauss(0, 1) for _ in place], diameter=1.0,
                                  density=DENSITY) for place in places])

    def said(self, program, np=1):
        self.drive(program, np=np)
        return self.read_json("said")

    def said_by(self, scene, body, **options):
        program = f"SCENE = {scene!r}\n" + HEAD + f"""
lmp, partner = scene(SCENE)
with partner:
    fluid = partner.fluid_grid((-4, -4, -5), (4, 4, 5), (2, 2, 2), "tophat 2")
    still = [[0.0, 0.0, 0.0]] * 8
""" + body + "\nlmp.finalize()\n"
        return self.said(program, **options)

    def test_spin_decays(self):
        """By 1/(1 + dt c/I) in a step of the first order, whatever c is; towards half of the vorticity."""
        body = """
    fluid.drag_law("stokes rotation", 1e-9, VISCOSITY)
    fluid.put(still, vorticity=[[0.4, 0.0, -0.8]] * 8)
    partner.advance(20)
    say(lmp, flat(partner.particles(list(partner.ids()), "omega")))
"""
        for viscosity in (0.05, 1e6):
            kept = (1 + DT * math.pi * viscosity / INERTIA) ** -20
            for scene in (free(), free("")):
                omega = self.said_by(scene, f"    VISCOSITY = {viscosity}" + body)
                for k, found in enumerate(omega):
                    rest = (0.2, 0.0, -0.4)[k % 3]
                    self.assertAlmostEqual(found, rest + ((1, -2, 3)[k % 3] - rest) * kept, delta=1e-12)

    def test_spin_of_the_second_order(self):
        """Kicks are those of drag: half of the first one with order 2; with velocity Verlet the half kicks of two steps as one, and
        at the end half of such a one."""
        body = """
    fluid.drag_law("stokes rotation", 1e-9, 0.05)
    fluid.put(still)
    partner.advance(400)
    say(lmp, flat(partner.particles([1], "omega")))
"""
        rate = DT * math.pi * 0.05 / INERTIA
        kept = (1 + rate) ** -399 / (1 + rate / 2)
        self.assertAlmostEqual(kept, math.exp(-400 * rate), delta=1e-3)
        law = "tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
        for fix, last in (("fix step all nve/sphere/symplectic order 2", 1.0), ("fix step all nve/sphere", 1 - rate / 2 / (1 + rate))):
            omega = self.said_by(free(law, fix=fix), body)
            self.assertAlmostEqual(omega[0], kept * last, delta=1e-12)
            self.assertAlmostEqual(omega[2], 3.0 * omega[0], delta=1e-12)

    def test_lift_is_exchanged(self):
        """What lift gives grains the fluid loses; its size and direction are those of the formulas."""
        body = """
    ids = list(partner.ids())
    fluid.drag_law("stokes" + WORDS, 1.0, 1e-3)
    before = partner.particles(ids, "v")
    fluid.put([[0.5, 0.0, 0.0]] * 8, vorticity=[[0.0, 0.0, -2.0]] * 8)
    partner.advance(10)
    after = partner.particles(ids, "v")
    lost = fluid.grains("exchange")
    say(lmp, [flat(before), flat(after), flat(lost), flat(partner.drag_impulses(ids))])
"""
        still = free(spin="set group all omega 0 0 3\nvelocity all set 0.1 0 0")
        for words, lift in (("", 0.0), (" saffman", 1.615 * math.sqrt(1e-3 / 2) * 0.4 * 2.0),
                            (" magnus", math.pi / 8 * 4.0 * 0.4)):
            for np in (1, 2):
                before, after, lost, impulses = self.said_by(still, f"    WORDS = {words!r}" + body, np=np)
                for d in range(3):
                    gained = MASS * sum(b - a for a, b in zip(before[d::3], after[d::3]))
                    self.assertAlmostEqual(gained, 80.0 * sum(lost[d::3]), delta=1e-12)
                    self.assertAlmostEqual(gained, sum(impulses[d::3]), delta=1e-12)
                for v in after[1::3]:    # drag takes 1 - exp(-dt c/m) of it
                    self.assertAlmostEqual(v, lift * 0.01 / MASS, delta=1e-4 * lift + 1e-12)

    def test_same_bits(self):
        """On ranks, over a snapshot, with two partners that share what one gives."""
        law = '    fluid.drag_law("wen/yu total saffman/mei magnus/oesterle rotation", 1.0, 0.01)\n'
        put = "put([[0.5, 0.1, -0.2]] * 8, vorticity=[[0.3 * k, 1.0, -2.0] for k in range(8)])\n"
        end = '    say(lmp, flat(partner.particles(list(partner.ids()), "v")) + flat(partner.particles(list(partner.ids()), "omega")))\n'
        plain = self.said_by(free(), law + "    fluid." + put + "    partner.advance(300)\n" + end)
        self.assertNotAlmostEqual(plain[91], -2.0, delta=0.1)
        for np, more in ((2, ""), (3, ""), (2, "    saved = partner.save()\n    partner.advance(77)\n    partner.restore(saved)\n")):
            self.assertEqual(self.said_by(free(), law + "    fluid." + put + more + "    partner.advance(300)\n" + end, np=np), plain)
        several = (law.replace("0.01)", "0.2)").replace("wen/yu", "stokes").replace("saffman/mei magnus/oesterle ", "")
                   + "    fluid." + put + """
    with Partner(lmp) as other:
        second = other.fluid_grid((-4, -4, -5), (4, 4, 5), (2, 2, 2), "tophat 2")
        second.drag_law("stokes total rotation", 1.0, 0.2)
        second.""" + put + "        partner.advance(300)\n" + end.replace("    say", "        say"))
        one = (law.replace("0.01)", "0.4)").replace("wen/yu", "stokes").replace("saffman/mei magnus/oesterle ", "") + "    fluid." + put
               + "    partner.advance(300)\n" + end)
        for found, expected in zip(self.said_by(free(), several, np=2), self.said_by(free(), one)):
            self.assertAlmostEqual(found, expected, delta=1e-9)

    def test_clumps_have_no_drag_of_rotation(self):
        scene = TWO_CLUMPS.format(move="fix move all rigid/small/symplectic molecule", thermo=0)
        program = f"SCENE = {scene!r}\n" + HEAD + """
lmp, partner = scene(SCENE)
with partner:
    fluid = partner.fluid_grid((-10, -10, -20), (10, 10, 20), (1, 1, 1))
    found = []
    for words in ("stokes", "stokes rotation"):
        start = partner.save()
        fluid.drag_law(words, 1.0, 0.1)
        fluid.put([[0.0, 0.0, 1.0]], vorticity=[[1.0, 0.0, 0.0]])
        partner.advance(40)
        found.append(flat(partner.particles([1, 2, 3, 4], "v")))
        partner.restore(start)
    say(lmp, found)
lmp.finalize()
"""
        without, with_rotation = self.said(program)
        self.assertEqual(without, with_rotation)

    def test_bad_words(self):
        body = """
    said = []
    def refusal(call):
        try:
            call()
            said.append("none")
        except TalusError as error:
            said.append(str(error))
    for words in ("stokes magnus magnus/oesterle", "stokes rotation rotation", "stokes lift", "stokes saffman"):
        refusal(lambda: fluid.drag_law(words, 1.0, 0.1))
    refusal(lambda: fluid.put(still))
    refusal(lambda: fluid.put(still, vorticity=[[0.0, 0.0, float("nan")]] * 8))
    say(lmp, said)
"""
        for np in (1, 2):
            said = self.said_by(free(), body, np=np)
            for found, expected in zip(said, (
                    "talus_set_drag_law: law: there is one of this kind already", "talus_set_drag_law: law: there is one of this kind already",
                    "talus_set_drag_law: law: unknown word 'lift', expected", "none", "talus_put_fluid: vorticity is NULL, and lift in shear "
                    "needs it: give the curl of the velocity", "talus_put_fluid: vorticity[2] is no finite number")):
                self.assertTrue(found.startswith(expected), found)


if __name__ == "__main__":
    unittest.main()
