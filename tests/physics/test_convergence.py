# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Orders of convergence that the accuracy benchmark finds, in short: a change that loses one fails here.

Two spheres of diameter 1 m and 1000 kg/m^3 meet at 1 m/s, .01 m apart at the beginning."""

import math
import unittest

from talus_testing import SceneCase, Sphere, read_dump, write_sphere_data

MASS = 1000 * math.pi / 6
STEP, TIME = 1 / 64, 8 / 64       # coarsest time step: a quarter of the impact
LEVELS = (3, 4, 5, 6, 7)          # time steps STEP/2^k
REFERENCE = 11

HERTZ = 1.0e7
MINDLIN = 3 * (1 - 0.3) / (2 - 0.3) * HERTZ
FRICTION = "tangential multistep"

SCRIPT = """
clear
units si
boundary f f f
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
read_data data
neighbor 0.1 bin
pair_style gran/penalty
pair_coeff * * {law}
fix move all nve/sphere/symplectic {start}
{more}timestep {dt!r}
thermo 100000
run {steps}
write_dump all custom end.{name} id x y z vx vy vz omegax omegay omegaz modify format float %.17g
"""


class Convergence(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, [
            Sphere((-0.505, 0, 0), (0.5, 0.4, 0), (0, 0, 1.0), density=1000.0),
            Sphere((0.505, 0, 0), (-0.5, -0.4, 0), (0, 0, 1.0), density=1000.0)])

    more = ""       # lines of the script, which may name the {law}

    def motion(self, runs):
        """The final positions, velocities and spins of runs (law, start, k) with the time step STEP/2^k."""
        script = "".join(SCRIPT.format(law=law, start=start if "order" in start else f"start {start}",
                                       more=self.more.format(law=law), dt=STEP / 2**k,
                                       steps=round(TIME / STEP) * 2**k, name=n)
                         for n, (law, start, k) in enumerate(runs))
        self.run_lammps(script)
        ends = []
        for n in range(len(runs)):
            frame, = read_dump(self.path(f"end.{n}"))
            ends.append([frame.atoms[tag] for tag in (1, 2)])
        return ends

    def order(self, law, start="half", reference=None, reference_start=None, seen=None):
        """(slope of log error of the motion over log dt, finest error) against a run with a very fine step. `seen`:
        only that many of the columns, 3: positions."""
        runs = [(law, start, k) for k in LEVELS] + [(reference or law, reference_start or start, REFERENCE)]
        *coarse, exact = self.motion(runs)
        errors = [max(abs(a - b) for row, other in zip(end, exact) for a, b in list(zip(row[1:], other[1:]))[:seen])
                  for end in coarse]
        x = [-k * math.log(2) for k in LEVELS]
        y = [math.log(e) for e in errors]
        mx, my = sum(x) / len(x), sum(y) / len(y)
        slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx)**2 for a in x)
        print(f"{law}, start {start}: order {slope:.2f}, errors " + " ".join(f"{e:.1e}" for e in errors))
        return slope, errors[-1]

    def test_half_start_is_of_second_order_under_a_force(self):
        """Spheres that are pressed together are let go: without the half kick the error is of first order."""
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, [
            Sphere((-0.49, 0, 0), density=1000.0), Sphere((0.49, 0, 0), density=1000.0)])
        law = f"hertz {HERTZ} 0.0"
        order, finest = self.order(law)
        self.assertGreater(order, 1.75)
        self.assertLess(finest, 1e-4)
        order, coarse = self.order(law, "plain", reference_start="half")
        self.assertGreater(order, 0.8)
        self.assertLess(order, 1.5)        # otherwise the half kick has lost its reason
        self.assertGreater(coarse, 5 * finest)

    def test_sliding_is_of_second_order(self):
        order, finest = self.order(f"hertz {HERTZ} 0.0 {FRICTION} {MINDLIN} 0.0 0.1")
        self.assertGreater(order, 1.75)
        self.assertLess(finest, 3e-5)

    def test_midpoint_sticks_with_second_order_and_the_plain_update_does_not(self):
        law = f"hertz {HERTZ} 0.0 {FRICTION} {MINDLIN} 0.0 10.0"
        order, finest = self.order(law + " midpoint")
        self.assertGreater(order, 1.6)
        self.assertLess(finest, 2e-4)
        order, coarse = self.order(law, reference=law + " midpoint")
        self.assertGreater(order, 0.8)
        self.assertLess(order, 1.5)        # otherwise midpoint has lost its reason
        self.assertGreater(coarse, 5 * finest)

    def test_damped_friction(self):
        """Of first order in the end, with a small coefficient: at these time steps it looks like second."""
        for start in "plain", "half":
            order, finest = self.order(f"hertz {HERTZ} 150.0 {FRICTION} {MINDLIN} 75.0 0.3", start)
            self.assertGreater(order, 1.5)
            self.assertLess(finest, 5e-5)

    def test_order_2(self):
        """Impacts with damping and friction; velocities in free flight are those of any time."""
        friction = f"{FRICTION} {MINDLIN} 75.0 0.3 slider midpoint limit_damping"
        for law in (f"hertz {HERTZ} 150.0 limit_damping", f"hertz {HERTZ} 150.0 {friction}",
                    "hooke 7e5 30.0 limit_damping", f"hooke 7e5 30.0 {FRICTION} 2e5 15.0 0.2 slider midpoint limit_damping",
                    f"hertz/material 1e7 0.6 0.3 {FRICTION} NULL NULL 0.3 slider midpoint limit_damping"):
            order, finest = self.order(law, "order 2")
            self.assertGreater(order, 1.6)     # of one impact: where it begins within a step varies
            _, today = self.order(law, "half", reference_start="order 2")
            self.assertLess(finest, 0.2 * today)

    def test_order_2_on_a_floor(self):
        """Positions only: velocities under way are half a time step old."""
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, [
            Sphere((0, 0, 0.502), (0.3, 0.1, -0.5), (0, 0, 1.0), density=1000.0),
            Sphere((0.03, 0.02, 1.51), (0, 0, -0.7), (0, 1.0, 0), density=1000.0)])
        self.more = "unfix move\nfix move all nve/sphere/symplectic order 2 gravity 9.81 vector 0 0 -1\n" \
                    "fix floor all large/body plane 0 0 0  0 0 1 contact {law}\n"
        for law in (f"hertz {HERTZ} 150.0", "hooke 7e5 30.0"):
            order, _ = self.order(f"{law} {FRICTION} NULL NULL 0.3 slider midpoint limit_damping", "order 2", seen=3)
            self.assertGreater(order, 1.8)


if __name__ == "__main__":
    unittest.main()
