# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""compute penalty/stats: each of its energies in a case with a closed form, its counts, and the balance of
a collapsing, damped, frictional heap: kinetic + elastic + gravitational + dissipated = constant."""

import math
import random
import unittest

from talus_testing import SceneCase, Sphere, begin, thermo, write_sphere_data

CANDIDATES, CONTACTS, OVERLAP, ELASTIC, NORMAL, TANGENTIAL, RESISTANCE = (f"c_s[{n}]" for n in range(1, 8))
ENERGIES = (ELASTIC, NORMAL, TANGENTIAL, RESISTANCE)
G = 9.81

SCRIPT = begin("{units}", law="{pair}") + """
{more}
neighbor {skin} bin
timestep {dt}
compute s all penalty/stats
compute t all timestep/gran
compute k all ke
compute r all erotate/sphere
thermo_style custom step c_k c_r {gravity} c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6] c_s[7] &
    c_t[1] c_t[2] c_t[3]
thermo_modify format float %.17g norm no
thermo {every}
{run}
"""


def mass(radius, density=1000.0):
    return density * 4 / 3 * math.pi * radius**3


class Case(SceneCase):

    def simulate(self, pair, spheres, steps, dt, more="", skin=0.1, every=None, np=1, gravity="", run=None,
                 box=5):
        write_sphere_data(self.path("data"), ((-box, box),) * 3, spheres)
        script = SCRIPT.format(units="si", pair=pair, more=more or "fix step all nve/sphere/symplectic", skin=skin,
                               dt=repr(dt), every=every or max(steps, 1), gravity=gravity,
                               run=run or f"run {steps}")
        self.log = self.run_lammps(script, np=np, timeout=250).log
        return thermo(self.log)


class Units(SceneCase):

    def test_restitution_in_all_units(self):
        """e of the material laws needs force = mass acceleration, which real, metal and electron units do not
        have: masses are converted.  What damping and friction take is the loss of kinetic energy."""
        print("\nrestitution, dissipated/lost energy")
        for units, young, speed in (("si", 1e8, 1.0), ("real", 1e5, 1e-5), ("metal", 1e5, 1e-2),
                                    ("electron", 1e9, 1e-6)):
            for law in f"hertz/material {young} 0.5 0.3", f"hooke/material {young} 0.5 0.3 {2 * speed}":
                spheres = [Sphere((0, 0, s * 50.001), (0, 0, -s * speed), diameter=100.0, density=1.0, type=1)
                           for s in (-1, 1)]
                write_sphere_data(self.path("data"), ((-300, 300),) * 3, spheres)
                dt = "$(c_t[1]/100)" if law.startswith("hooke") else "$(0.01*c_t[3])"
                more = "fix step all nve/sphere/symplectic"
                script = SCRIPT.format(pair=law, more=more, units=units, skin=1.0, dt="1e-9", every=100000, gravity="",
                                       run=f"run 0\ntimestep {dt}\nrun 4000")
                last = thermo(self.run_lammps(script).log)
                first, last = last[0], last[-1]
                self.assertEqual(last[CONTACTS], 0.0)
                e = math.sqrt(last["c_k"] / first["c_k"])
                print(f"{units:10}{law:40}{e:10.6f}{last[NORMAL] / (first['c_k'] - last['c_k']):12.6f}")
                self.assertAlmostEqual(e, 0.5, delta=3e-3)
                self.assert_close(last[NORMAL], first["c_k"] - last["c_k"], 1e-3)


class EachEntry(Case):

    def test_damped_impact(self):
        """(1-e^2) m v^2/2 goes into normal damping, nothing into the rest."""
        print("\ndissipated by one impact: found, (1-e^2) m v^2/2, lost kinetic energy")
        r, v = 0.5, 2.0
        m = mass(r)
        for e in 0.1, 0.5, 0.9:
            for law, dt in ((f"hertz/material 1e8 {e} 0.3", 5e-6),
                            (f"hertz/material 1e8 {e} 0.3 limit_damping", 5e-6),
                            ("flores 1e8 1e6", 5e-6),
                            (f"hooke/material 1e8 {e} 0.3 2.0", 5e-6)):
                rows = self.simulate(law, [Sphere((0, 0, -r - 1e-3), (0, 0, v), density=1000.0),
                                           Sphere((0, 0, r + 1e-3), (0, 0, -v), density=1000.0)], 14000, dt)
                first, last = rows[0], rows[-1]
                self.assertEqual(last[CONTACTS], 0.0)
                lost = first["c_k"] - last["c_k"]
                expected = (1 - e * e) * m * v * v
                print(f"{law:40}{last[NORMAL]:12.4f}{expected:12.4f}{lost:12.4f}")
                self.assert_close(last[NORMAL], lost, 1e-4)
                if "flores" not in law:    # which has no e
                    self.assert_close(last[NORMAL], expected, 2e-3)
                for other in (ELASTIC, TANGENTIAL, RESISTANCE):
                    self.assertEqual(last[other], 0.0)

    def test_impact_on_a_body(self):
        r, v, e = 0.5, 2.0, 0.5
        law = f"hertz/material 1e8 {e} 0.3"
        rows = self.simulate(law, [Sphere((0, 0, r + 1e-3), (0, 0, -v), density=1000.0)], 8000, 5e-6,
                             more="fix step all nve/sphere/symplectic\n"
                             f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}")
        self.assert_close(rows[-1][NORMAL], (1 - e * e) * mass(r) * v * v / 2, 2e-3)

    def test_sliding_sphere(self):
        """A sphere that slides until it rolls loses 2/7 of its kinetic energy to friction."""
        r, v, m = 0.5, 1.0, mass(0.5)
        kn = 1e7
        print("\nfriction of a sphere from sliding to rolling over 2/7 of m v^2/2; spring, damping")
        for tangential in ("multistep NULL NULL 0.3", "dashpot 1e3 0.3", "onestep NULL 1e3 0.3"):
            law = f"hooke {kn} 1e3 tangential {tangential}"
            rows = self.simulate(law, [Sphere((0, 0, r - m * G / kn), (v, 0, 0), density=1000.0)], 40000, 2e-5,
                                 more=f"fix step all nve/sphere/symplectic gravity {G} vector 0 0 -1\n"
                                 f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}")
            last = rows[-1]
            expected = 2 / 7 * m * v * v / 2
            spring = last[ELASTIC] - 0.5 * (m * G)**2 / kn
            print(f"{tangential:26}{last[TANGENTIAL] / expected:10.6f}{spring:12.2e}{last[NORMAL]:12.2e}")
            self.assert_close(last[TANGENTIAL], expected, 1e-3)
            self.assertLess(abs(spring), 1e-3 * expected)
            self.assertLess(abs(last[NORMAL]), 1e-6 * expected)
            self.assert_close(last["c_k"] + last["c_r"], 5 / 7 * m * v * v / 2, 1e-3)

    def test_elastic_energy(self):
        """Two overlapping spheres, before the first step."""
        d, r_eff = 1e-3, 0.25
        material = 4 / 3 * (1e8 / (1 - 0.09) / 2) * math.sqrt(r_eff)
        m = mass(0.5, 1.0) / 2
        scale = 16 / 15 * math.sqrt(r_eff) * 1e8 / (1 - 0.09) / 2
        linear = scale * (m * 4.0 / scale)**0.2    # hooke/material with vchar 2
        cases = {
            "hooke 1e6 0.0": 0.5 * 1e6 * d**2,
            "hooke 1e6 0.0 adhesion constant 20.0": 0.5 * 1e6 * d**2 - 20.0 * d,
            "hooke 1e6 0.0 adhesion dmt 20.0": 0.5 * 1e6 * d**2 - 20.0 * 0.5 * d,
            "hooke 1e6 0.0 adhesion perko 20.0": 0.5 * 1e6 * d**2 - 20.0 * 0.25 * d,
            "hertz 1e8 0.0": 0.4 * 1e8 * math.sqrt(r_eff) * d**2.5,
            "flores 1e8 0.0": 0.4 * 1e8 * math.sqrt(r_eff) * d**2.5,
            "plaincoulomb 1e6 0.0 0.5": 0.4 * 1e6 * d**2.5,
            "hertz/material 1e8 0.5 0.3": 0.4 * material * d**2.5,
            "flores/material 1e8 0.5 0.3 1.0": 0.4 * material * d**2.5,
            "hooke/material 1e8 0.5 0.3 2.0": 0.5 * linear * d**2,
            "plaincoulomb/material 1e8 0.5 0.3 0.5": 0.4 * material / math.sqrt(r_eff) * d**2.5,
        }
        for law, expected in cases.items():
            row, = self.simulate(law, [Sphere((0, 0, 0)), Sphere((0, 1 - d, 0))], 0, 1e-6)
            self.assert_close(row[ELASTIC], expected, 1e-9, law)
            self.assert_close(row[OVERLAP], d / 0.5, 1e-9, law)

    def test_elastic_energy_of_the_tangential_spring(self):
        """A sphere that rests on a slope and may not turn: kn d^2/2 + kt s^2/2 with s = m g sin/kt."""
        r, m, kn, kt = 0.5, mass(0.5), 1e6, 5e5
        law = f"hooke {kn} 1e2 tangential multistep {kt} 60.0 0.9"
        rows = self.simulate(law, [Sphere((0, 0, r - 1e-3), density=1000.0)], 20000, 1e-4,
                             more=f"fix step all nve\nfix g all gravity {G} vector 0.3 0 -0.4\n"
                             f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}")
        self.assert_close(rows[-1][ELASTIC], 0.5 * (m * G)**2 * (0.64 / kn + 0.36 / kt), 1e-6)

    def test_resistance(self):
        """Rolling and spinning without friction: what the spin loses."""
        r, m, kn = 0.5, mass(0.5), 1e7
        law = f"hooke {kn} 1e2 rolling 0.02 spinning 0.2"
        floor = (f"fix step all nve/sphere/symplectic gravity {G} vector 0 0 -1\n"
                 f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}")
        for omega in (0, 1.0, 0), (0, 0, 1.0), (0.6, 0, 0.8):
            rows = self.simulate(law, [Sphere((0, 0, r - m * G / kn), omega=omega, density=1000.0)], 3000, 1e-4,
                                 more=floor)
            lost = rows[0]["c_r"] - rows[-1]["c_r"]
            self.assertGreater(lost, 0.05 * rows[0]["c_r"])
            self.assert_close(rows[-1][RESISTANCE], lost, 1e-6)
            self.assertEqual(rows[-1][TANGENTIAL], 0.0)

    def test_sliding_at_a_given_speed(self):
        """Friction against a frozen sphere does work at the rate mu F v, damping none."""
        law = "hooke 1e6 0.0 tangential dashpot 1e9 0.5"
        spheres = [Sphere((0, 0, 0)), Sphere((0, 0, 0.999), omega=(0, 3.0, 0), density=1e9)]
        rows = self.simulate(law, spheres, 100, 1e-6, more="group base id 1\nfix hold base freeze\n"
                             "fix step all nve/sphere/symplectic")
        expected = 0.5 * 1e6 * 1e-3 * 3.0 * 0.5 * 100e-6
        self.assert_close(rows[-1][TANGENTIAL], expected, 1e-6)

    def test_counts(self):
        """Three spheres in a row, the last two only near, and the first on a plane as well: by rank."""
        spheres = [Sphere((0, 0, 0.499)), Sphere((0.99, 0, 0.6)), Sphere((1.0, 1.05, 0.6), diameter=1.0),
                   Sphere((-3, 0, 3))]
        distance = math.hypot(0.99, 0.101)
        for np in 1, 2, 4:
            row, = self.simulate("hooke 1e6 0.0", spheres, 0, 1e-6, np=np, skin=0.2,
                                 more="fix step all nve/sphere/symplectic\n"
                                 "fix floor all large/body plane 0 0 0 0 0 1 contact hooke 1e6 0.0")
            self.assertEqual(row[CANDIDATES], 2.0)
            self.assertEqual(row[CONTACTS], 2.0)
            self.assert_close(row[OVERLAP], (1 - distance) / 0.5, 1e-9)

    def test_largest_overlap_with_a_body(self):
        for np in 1, 2:
            row, = self.simulate("hooke 1e6 0.0", [Sphere((0, 0, 0.495)), Sphere((0.999, 0, 0.495))], 0, 1e-6, np=np,
                                 more="fix step all nve/sphere/symplectic\n"
                                 "fix floor all large/body plane 0 0 0 0 0 1 contact hooke 1e6 0.0")
            self.assert_close(row[OVERLAP], 0.01, 1e-9)

    def test_a_new_compute_begins_at_zero(self):
        """And an old one goes on."""
        spheres = [Sphere((0, 0, 0.499), (0, 0, -1.0), density=1000.0),
                   Sphere((0.999, 0, 0.6), density=1000.0)]
        rows = self.simulate("hooke 1e6 50.0", spheres, 20, 1e-6, every=20, run="""run 20
compute s2 all penalty/stats
thermo_style custom step c_k c_r c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6] c_s[7] c_s2[5]
thermo_modify format float %.17g norm no
run 20
uncompute s2
compute s2 all penalty/stats
run 0""", more="fix step all nve/sphere/symplectic\n"
                             "fix floor all large/body plane 0 0 0 0 0 1 contact hooke 1e6 50.0")
        first, begin, end, again = rows[1:]
        self.assertGreater(first[NORMAL], 0.0)
        self.assertEqual(begin["c_s2[5]"], 0.0)
        self.assertEqual(begin[NORMAL], first[NORMAL])
        self.assert_close(end["c_s2[5]"], end[NORMAL] - first[NORMAL], 1e-9)
        self.assertEqual(again["c_s2[5]"], 0.0)
        self.assertEqual(again[NORMAL], end[NORMAL])


LAW = "hertz/material 1e7 0.5 0.3 tangential multistep NULL NULL 0.5 rolling 0.05 spinning 0.05"
WALL = "hertz 1e7 1e6 tangential multistep NULL NULL 0.3"
HEAP = f"""fix step all nve/sphere/symplectic start half gravity {G} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}
fix w1 all large/body plane  0.08 0 0 -1 0 0 contact {WALL}
fix w2 all large/body plane -0.02 0 0  1 0 0 contact {WALL}
fix w3 all large/body plane 0  0.05 0 0 -1 0 contact {WALL}
fix w4 all large/body plane 0 -0.005 0 0  1 0 contact {WALL}
"""


def heap():
    """A loose column of 200 spheres that falls apart."""
    draw = random.Random(5)
    sites = [(i, j, k) for k in range(10) for j in range(4) for i in range(5)]
    return [Sphere(tuple(0.012 * (s + 0.5) + draw.uniform(-0.001, 0.001) for s in site),
                   diameter=draw.uniform(0.008, 0.0095), density=2500.0) for site in sites]


class Heap(Case):

    TIME = 0.25

    def collapse(self, fraction, np=1, law=LAW):
        """Thermo output at a time step that is a fraction of the smallest critical one."""
        dt = fraction * self.critical
        steps = round(self.TIME / dt / 50) * 50
        return self.simulate(law, heap(), steps, dt, more=HEAP.replace(LAW, law), skin=0.002,
                             every=steps // 50, gravity="f_step", np=np, box=0.2)

    def setUp(self):
        """The smallest critical time step of the whole collapse, by a coarse run."""
        self.critical = 4e-4
        rows = self.collapse(0.05)
        self.critical = min(row[f"c_t[{n}]"] for row in rows for n in (1, 2, 3) if row[f"c_t[{n}]"] > 0)

    @staticmethod
    def total(row):
        return row["c_k"] + row["c_r"] + row["f_step"] + sum(row[key] for key in ENERGIES)

    def deviation(self, rows):
        start = self.total(rows[0])
        return max(abs(self.total(row) / start - 1) for row in rows)

    def test_balance(self):
        print(f"\nsmallest critical time step {self.critical:.3e} s")
        deviations = []
        for fraction in 0.2, 0.1, 0.05, 0.025, 0.0125:
            rows = self.collapse(fraction)
            deviations.append(self.deviation(rows))
            first, last = rows[0], rows[-1]
            shares = " ".join(f"{last[key] / first['f_step']:.4f}" for key in ("c_k", "c_r", "f_step", *ENERGIES))
            print(f"dt {fraction:7} critical: largest deviation {deviations[-1]:.2e}; at the end, of the initial "
                  f"energy: kinetic, rotation, height, elastic, damping, friction, resistance {shares}")
            self.assertGreater(last[NORMAL], 0.05 * first["f_step"])
            self.assertGreater(last[TANGENTIAL], 0.02 * first["f_step"])
            self.assertGreater(last[RESISTANCE], 0.001 * first["f_step"])
        orders = [math.log2(a / b) for a, b in zip(deviations, deviations[1:])]
        print("orders: " + " ".join(f"{order:.2f}" for order in orders))
        self.assertLess(deviations[1], 1e-3)
        self.assertGreater(math.log2(deviations[0] / deviations[-1]) / 4, 1.8)

    def test_other_integrators(self):
        """Second order as well: with order 2, and where the fix of LAMMPS moves particles in its arrays."""
        law = "hertz/material 1e7 0.5 0.3 limit_damping tangential multistep NULL NULL 0.5 slider midpoint"
        second = HEAP.replace(LAW, law).replace(WALL, law).replace("start half", "order 2")
        own = f"nve/sphere/symplectic start half gravity {G} vector 0 0 -1"
        stock = HEAP.replace(own, f"nve/sphere\nfix weight all gravity {G} vector 0 0 -1\n"
                             f"variable pot equal {G}*mass(all)*xcm(all,z)")
        for name, its_law, more in ("order 2", law, second), ("nve/sphere", LAW, stock):
            deviations = []
            for fraction in 0.1, 0.05:
                dt = fraction * self.critical
                steps = round(self.TIME / dt / 50) * 50
                gravity = "f_step" if more is second else "v_pot"
                rows = self.simulate(its_law, heap(), steps, dt, more=more, skin=0.002, every=steps // 50,
                                     gravity=gravity, box=0.2)
                for row in rows:
                    row["f_step"] = row[gravity]
                deviations.append(self.deviation(rows))
            print(f"\n{name}: largest deviations {deviations[0]:.2e} {deviations[1]:.2e}")
            self.assertLess(deviations[0], 1.5e-3)
            self.assertLess(deviations[1], deviations[0] / 3)

    def test_same_on_two_ranks(self):
        once, twice = self.collapse(0.1), self.collapse(0.1, np=2)
        worst = 0.0
        for a, b in zip(once, twice, strict=True):
            self.assertEqual((a[CANDIDATES], a[CONTACTS]), (b[CANDIDATES], b[CONTACTS]))
            self.assertEqual(a[OVERLAP], b[OVERLAP])
            for key in ("c_k", "c_r", "f_step", *ENERGIES):
                worst = max(worst, abs(a[key] - b[key]) / once[0]["f_step"])
        print(f"\nenergies on 1 and 2 ranks: largest difference {worst:.1e} of the initial energy")
        self.assertLess(worst, 1e-12)


if __name__ == "__main__":
    unittest.main()
