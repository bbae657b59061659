# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200 stay
"""Clumps against large bodies of every kind, each with an answer; masses and inertia that are given, with numbers by hand."""

import itertools
import math
import unittest

import body_meshes
from talus_testing import SceneCase, head, max_difference, read_dump, thermo

MOTION = "x y z vx vy vz omegax omegay omegaz".split()
LAW = "hooke 2e4 30 tangential multistep NULL 10 0.3"
BOX = head() + """
fix prop all property/atom mol ghost yes
region box block -10 10 -10 10 -10 10
create_box 2 box
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra all
timestep {dt!r}
thermo_style custom step
"""
END = """
run {steps}
write_dump all custom last id {motion} modify format float %.17g sort id
"""
AGAIN = head() + """
read_restart state
fix prop all property/atom mol ghost yes
pair_style gran/penalty
pair_coeff * * {law}
neigh_modify exclude molecule/intra all
timestep {dt!r}
thermo_style custom step
fix move all rigid/small/symplectic molecule {words}
"""


def spheres_at(places, molecule=1, first=1, diameter=1.0, mass=0.5):
    """Commands that make spheres of a clump."""
    lines = []
    for n, place in enumerate(places, first):
        lines += ["create_atoms 1 single " + " ".join(map(repr, place)),
                  f"set atom {n} diameter {diameter} mass {mass} mol {molecule}"]
    return "\n".join(lines) + "\n"


class BodyCase(SceneCase):

    def end(self, spheres, body, move="rigid/small/symplectic molecule start half", velocity="1 0.3 -0.5", spin="0 2 1",
            steps=1500, np=1, law=LAW, gravity="gravity 10 vector 0 0 -1", dt=4.0e-4, more=""):
        """Where spheres of a clump, or one sphere, are at the end."""
        moves = f"velocity all set {velocity}\nset group all omega {spin}\nfix move all {move} {gravity}\n"
        self.log = self.run_lammps(BOX.format(law=law, dt=dt) + spheres + moves + body.replace("LAW", law) + "\n" + more +
                                   END.format(steps=steps, motion=" ".join(MOTION)), np=np).log
        frame, = read_dump(self.path("last"))
        return frame


class Bodies(BodyCase):
    dumbbell = spheres_at([(-0.35, 0.1, 1.2), (0.35, -0.1, 1.0)])

    def test_meshes_boxes_and_regions_are_floors_like_a_plane(self):
        """It slides and rolls on them."""
        plane = self.end(self.dumbbell, "fix b all large/body plane 0 0 0 0 0 1 contact LAW")
        self.assertLess(max(plane.column("z").values()), 0.75)    # it has fallen over
        self.assertGreater(min(plane.column("x").values()), -0.2)
        body_meshes.write_stl(self.path("floor.stl"),
                              body_meshes.grid(lambda i, j: (2.0 * i - 9.0, 2.0 * j - 9.0, 0.0), 9, 9))
        for body in ("mesh floor.stl", "box 0 0 -1 18 18 2 outside", "box 0 0 4 18 18 8 inside",
                     "rectangle 0 0 0 0 0 1 1 0 0 18 18"):
            for np in 1, 2:
                with self.subTest(body=body, ranks=np):
                    other = self.end(self.dumbbell, f"fix b all large/body {body} contact LAW", np=np)
                    self.assertLess(max_difference(plane, other, MOTION), 1e-9)
        region = "region r block -9 9 -9 9 0 9\nfix b all large/body region r contact LAW"
        self.assertLess(max_difference(plane, self.end(self.dumbbell, region), MOTION), 1e-9)

    def test_in_a_drum_a_dumbbell_along_the_axis_moves_as_one_sphere(self):
        """Twice the mass on twice the springs."""
        pair = spheres_at([(1.0, -0.5, -1.1), (1.0, 0.5, -1.1)])
        one = spheres_at([(1.0, 0.0, -1.1)])
        law = "hooke 2e4 0 tangential multistep NULL 0 0.3"
        for body in ("fix b all large/body cylinder 0 0 0 0 1 0 2 INF inside contact LAW",
                     "region r cylinder y 0 0 2 -10 10\nfix b all large/body region r contact LAW"):
            clump = self.end(pair, body, velocity="0 0 0", spin="0 0 0", law=law)
            sphere = self.end(one, body, move="nve/sphere/symplectic start half", velocity="0 0 0", spin="0 0 0", law=law)
            for column in "x", "z", "vx", "vz", "omegay":
                for tag in 1, 2:
                    self.assertAlmostEqual(clump.column(column)[tag], sphere.column(column)[1], delta=1e-9)
            self.assertGreater(abs(sphere.column("omegay")[1]), 0.1)

    def test_momentum_goes_to_a_free_body(self):
        """What the clump has lost the box has."""
        clump = spheres_at([(-0.35, 0.1, 1.2), (0.35, -0.1, 1.0)], mass=0.5)
        frame = self.end(clump, "fix b all large/body box 0 0 -1 3 3 2 outside contact LAW move free mass 5 inertia 4 5 6",
                         gravity="", velocity="0 0 -2", steps=1000, more="thermo_style custom step f_b[14] f_b[15] f_b[16]\n"
                         "thermo_modify format float %.17g\n")
        total = [0.0, 0.0, 0.0]
        for tag in 1, 2:
            for d, v in enumerate(("vx", "vy", "vz")):
                total[d] += 0.5 * frame.column(v)[tag]
        last = thermo(self.log)[-1]
        body = [5.0 * last[f"f_b[{n}]"] for n in (14, 15, 16)]
        self.assertLess(body[2], -0.5)
        # the initial velocity is that of the center: both spheres had it
        for found, expected in zip((a + b for a, b in zip(total, body)), (0.0, 0.0, -2.0)):
            self.assertAlmostEqual(found, expected, delta=1e-12)


class GivenMasses(BodyCase):
    """Spheres that overlap, with mass, center and moments of their own: other answers than the spheres would give."""

    center, v, l, moment = (0.1, 0.05, 1.0), (0.5, -0.2, 0.1), 0.3, 0.4
    places = [(-0.3, 0.0, 1.0), (0.4, 0.2, 1.1)]
    in_free_motion = dict(gravity="", steps=2000, dt=1e-3, law="hooke 2e4 0")

    def start_freely(self, words, more=""):
        with open(self.path("bodies"), "w") as file:
            file.write(f"1\n1 1.5 {' '.join(map(repr, self.center))} 0.2 0.3 {self.moment} 0 0 0 "
                       f"{' '.join(map(repr, self.v))} 0 0 {self.l} 0 0 0\n")
        return self.end(spheres_at(self.places), "", f"rigid/small/symplectic molecule infile bodies {words}", more=more,
                        **self.in_free_motion)

    def assert_free_motion(self, frame, time):
        """It turns about the axis z of its inertia at L/I, and its center, which is that of no sphere, goes straight on."""
        angle = time * self.l / self.moment
        for tag, place in enumerate(self.places, 1):
            a, b, c = (p - q for p, q in zip(place, self.center))
            arm = math.cos(angle) * a - math.sin(angle) * b, math.sin(angle) * a + math.cos(angle) * b, c
            for n, column in enumerate("xyz"):
                self.assertAlmostEqual(frame.column(column)[tag], self.center[n] + time * self.v[n] + arm[n], delta=1e-11)
            self.assertAlmostEqual(frame.column("omegaz")[tag], self.l / self.moment, delta=1e-12)

    def test_free_motion_by_hand(self):
        self.assert_free_motion(self.start_freely(""), 2.0)

    def test_a_restart_with_another_order_or_start_keeps_them(self):
        for old, new in itertools.permutations(("start plain", "start half", "order 2"), 2):
            with self.subTest(old=old, new=new):
                for before in old, new:
                    self.start_freely(old, "run 500\nwrite_restart state")
                    self.run_lammps(AGAIN.format(words=before, **self.in_free_motion) + "write_restart state")    # before a run
                    self.run_lammps(AGAIN.format(words=new, **self.in_free_motion) + "run 700\n" +
                                    END.format(motion=" ".join(MOTION), steps=800), np=2)
                    frame, = read_dump(self.path("last"))
                    self.assert_free_motion(frame, 2.0)

    def test_a_restart_before_the_first_run(self):
        """Nothing is known of clumps then but which spheres they have."""
        scene = dict(gravity="", velocity="0.2 0 0.1", spin="1 2 0.5", steps=500)
        expected = self.end(spheres_at(self.places), "", **scene)
        self.end(spheres_at(self.places), "", **dict(scene, more="write_restart state"))
        options = dict(law=LAW, dt=4.0e-4, words="start half")
        self.run_lammps(AGAIN.format(**options) + END.format(motion=" ".join(MOTION), steps=500), np=2)
        frame, = read_dump(self.path("last"))
        self.assertLess(max_difference(frame, expected, MOTION), 1e-12)
        self.assertGreater(abs(frame.column("omegaz")[1]), 0.1)

    def test_an_impact_by_hand(self):
        """Without friction and damping, on the sphere at the end of a rod: e = 1, with 1/m = 1/M + a^2/I."""
        mass, moment, arm, v = 2.0, 0.6, 0.4, 1.0
        self.write("bodies", f"1\n1 {mass} 0 0 1 0.7 {moment} 0.6 0 0 0 0 0 {-v} 0 0 0 0 0 0\n")
        frame = self.end(spheres_at([(-arm, 0.0, 0.52), (arm, 0.0, 1.48)]), "fix b all large/body plane 0 0 0 0 0 1 contact LAW",
                         move="rigid/small/symplectic molecule start half infile bodies", gravity="", steps=6000, dt=5e-6,
                         law="hooke 2e6 0")
        push = 2.0 * v / (1.0 / mass + arm**2 / moment)
        self.assertAlmostEqual(frame.column("omegay")[1], arm * push / moment, delta=2e-3)
        middle = 0.5 * (frame.column("vz")[1] + frame.column("vz")[2])
        self.assertAlmostEqual(middle, push / mass - v, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
