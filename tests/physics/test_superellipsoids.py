# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=200
"""Ellipsoids and superellipsoids: spheres as their limit, rocking and rolling with the frequency known by hand, spin,
what elastic impacts keep, bodies of all kinds under them, needles and plates, and the same bits on ranks, threads and
after a restart."""

import math
import os
import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

SCENE = begin(boundary="{boundary}", read="{read}", law="{law}", skin=0.2, dt="{dt!r}") + """
{commands}
thermo {every}
thermo_style custom step {columns}
thermo_modify norm no format float %.17g
{run}
"""
STATE = "x y z vx vy vz omegax omegay omegaz".split()
END = "write_dump all custom end id {} modify format float %a".format


def quat(axis, degrees):
    half = math.radians(degrees) / 2
    return "quat " + " ".join(repr(c) for c in (math.cos(half), *(math.sin(half) * a for a in axis)))


class SuperellipsoidCase(SceneCase):

    def simulate(self, particles, commands, steps, dt=1e-4, law="hooke 1e4 0", every=None, columns="f_s f_s[1] f_s[2]", types=None,
                 extra="", size=8.0, **options):
        write_sphere_data(self.path("grains"), 3 * ((-size, size),), particles, types)
        log = self.run_lammps(SCENE.format(boundary="f f f", read="read_data grains", law=law, dt=dt, commands=commands,
                                           every=every or steps, columns=columns, run=f"run {steps}")
                              + END(" ".join(STATE) + extra) + "\n", **options).log
        self.frame, = read_dump(self.path("end"))
        self.log = log
        return thermo(log)

    def of(self, name, tag=1):
        return self.frame.column(name)[tag]


class Limits(SuperellipsoidCase):

    def test_spheres(self):
        """27 that fall on each other and on a plane for 1000 steps: those of atom style sphere to 1e-12. With friction to the
        overlap over the radius: it acts half way between the surfaces, that of spheres at a radius from each center."""
        draw = random.Random(3)
        grains = [Sphere((1.02 * i + draw.uniform(-.01, .01), 1.02 * j + draw.uniform(-.01, .01), 0.51 + 1.02 * k),
                         v=(0, 0, -0.5), omega=tuple(draw.gauss(0, 1) for _ in "xyz"), density=1.0)
                  for i in range(3) for j in range(3) for k in range(3)]
        for law, delta in (("hooke 1e4 30", 1e-12), ("hertz 1e4 30", 1e-12), ("hooke 1e4 30 tangential multistep NULL NULL 0.5", 2e-2)):
            states = []
            for mover in ("fix s all shape/gran type 1 superellipsoid 0.5 0.5 0.5 2 2 density 1", "fix s all nve/sphere/symplectic"):
                self.simulate(grains, f"""{mover}
fix g all gravity/talus 10 vector 0.1 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}""", 1000, dt=2e-4, law=law, columns="ke")
                states.append({key: self.frame.column(key) for key in STATE})
            self.assertGreater(max(states[0]["vz"].values()), -1.5)    # free fall: -2.5
            self.assertGreater(states[0]["vz"][1], -0.5)
            worst = max(abs(states[0][key][tag] - states[1][key][tag]) for key in STATE for tag in range(1, 28))
            print(f"{law}: {worst:.1e}")
            self.assertLess(worst, delta)

    def test_mass_and_inertia(self):
        a, b, c = 0.9, 0.6, 0.4
        self.simulate([Sphere((0, 0, 0), v=(1, 0, 0), omega=(2.0, 0.0, 3.0))], f"fix s all shape/gran type 1 ellipsoid {a} {b} {c} density 3",
                      0, columns=" ".join(f"f_s[{k}]" for k in range(1, 6)), extra=" mass radius")
        mass = 4 * math.pi * a * b * c
        self.assert_close(self.of("mass"), mass, 1e-14)
        self.assert_close(self.of("radius"), a, 1e-15)
        row, = thermo(self.log)
        self.assert_close(row["f_s[2]"], 0.1 * mass * ((b * b + c * c) * 4 + (a * a + b * b) * 9), 1e-13)


class Rocking(SuperellipsoidCase):

    def period(self, spec, axis, friction, steps, gravity, mass, dt=1e-4, height=0.5, stiffness=2e5):
        """Of small oscillations on a plane, from the changes of sign of the angular velocity."""
        # damping takes away what vibrates, not what rolls
        law = f"hooke {stiffness} 100" + (f" tangential multistep {stiffness} 100 10" if friction else "")
        rows = self.simulate([Sphere((0, 0, height - mass * gravity / stiffness))], f"""
fix s all shape/gran type 1 {spec} density 1 orient {quat(axis, 0.3)} curvature volume
fix g all gravity/talus {gravity} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
compute spin all property/atom omega{'xyz'[axis.index(1)]}
compute w all reduce sum c_spin""", steps, dt=dt, law=law, every=20, columns="c_w")
        zeros = []
        for before, after in zip(rows, rows[1:]):
            if before["c_w"] * after["c_w"] < 0.0:
                part = before["c_w"] / (before["c_w"] - after["c_w"])
                zeros.append(before["Step"] + part * (after["Step"] - before["Step"]))
        zeros = zeros[1:]    # the first is the start
        self.assertGreater(len(zeros), 3)
        return 2 * dt * (zeros[-1] - zeros[0]) / (len(zeros) - 1)

    def test_ellipsoid_on_a_plane(self):
        """omega^2 = m g (R - c)/(I + m c^2) where friction holds the point, without c^2 where there is none."""
        a, b, c, g = 1.0, 0.8, 0.5, 4.0
        mass = 4 / 3 * math.pi * a * b * c
        for axis, other in (((0, 1, 0), a), ((1, 0, 0), b)):
            radius, inertia = other * other / c, 0.2 * mass * (other * other + c * c)
            for friction in True, False:
                expected = 2 * math.pi * math.sqrt((inertia + friction * mass * c * c) / (mass * g * (radius - c)))
                found = self.period(f"ellipsoid {a} {b} {c}", axis, friction, 60000 if friction else 45000, g, mass)
                print(f"rocking about {axis}, friction {friction}: period {found:.5f}, by hand {expected:.5f}")
                self.assert_close(found, expected, 2e-3)


class Impacts(SuperellipsoidCase):

    KINDS = {"ellipsoids": "ellipsoid 0.6 0.4 0.3 curvature volume density 1", "n = 4": "superellipsoid 0.5 0.4 0.35 4 4 density 1",
             "drums": "superellipsoid 0.4 0.4 0.5 8 2 density 1"}
    OTHERS = {"itself": None, "a sphere": "", "a box": "box 0.7 0.6 0.5 rounded 0.05 density 1 orient random 5"}

    def test_elastic_impacts_keep_energy_and_momentum(self):
        """Off the center, linear law, without friction: the energy to second order, momentum to rounding."""
        for kind, spec in self.KINDS.items():
            for name, other in self.OTHERS.items():
                with self.subTest(f"{kind} and {name}"):
                    of_second = spec + " orient random 9" if other is None else other
                    errors = []
                    for dt in 1e-4, 2.5e-5:
                        shapes = f"type 1 {spec} orient random 4" + (f" type 2 {of_second}" if of_second else "")
                        rows = self.simulate(
                            [Sphere((-0.8, 0.05, 0.05), v=(1.0, 0, 0), omega=(0.5, -1, 0.3)),
                             Sphere((0.8, -0.05, 0), v=(-1.0, 0.1, 0), omega=(1, 0.2, 0.7), diameter=0.9, type=2)], f"""
group balls type {3 if of_second else 2}
group first id 1
group second id 2
fix s all shape/gran {shapes}
fix b balls nve/sphere/symplectic
compute kb balls ke
compute rb balls erotate/sphere
variable e equal f_s[1]+f_s[2]+c_kb+c_rb
variable px equal mass[1]*vx[1]+mass[2]*vx[2]
variable py equal mass[1]*vy[1]+mass[2]*vy[2]""", round(1.6 / dt), dt=dt, types=3, every=round(0.002 / dt),
                            columns="v_e v_px v_py f_s[6]")
                        touched = [row["f_s[6]"] for row in rows]
                        self.assertGreater(max(touched), 0, "they meet")
                        self.assertEqual(touched[-1], 0, "and part")
                        errors.append(abs(rows[-1]["v_e"] / rows[0]["v_e"] - 1))
                        for key in "v_px", "v_py":
                            self.assertAlmostEqual(rows[-1][key], rows[0][key], delta=1e-12)
                    print(f"{kind} and {name}: energy to {errors[0]:.1e}, with a quarter of the step {errors[1]:.1e}")
                    self.assertLess(errors[0], 2e-3)
                    self.assertLess(errors[1], max(errors[0] / 6, 6e-6))

    def test_floors_of_all_kinds(self):
        """The same bounces on a plane, a box, a mesh, a rectangle, a room, and a cylinder's cap."""
        body_meshes.write_stl(self.path("floor.stl"), body_meshes.box((-5, -5, -1), (5, 5, 0), 4))
        floors = {"plane": "plane 0 0 0 0 0 1", "box": "box 0 0 -0.5 10 10 1 outside", "mesh": "mesh floor.stl",
                  "room": "box 0 0 5 10 10 10 inside", "rectangle": "rectangle 0 0 0 0 0 1 1 0 0 10 10",
                  "column": "cylinder 0 0 -1 0 0 1 6 2 outside", "can": "cylinder 0 0 3 0 0 1 6 6 inside"}
        for spec in "ellipsoid 0.6 0.4 0.3", "superellipsoid 0.5 0.4 0.35 4 3":
            found = {}
            for name, floor in floors.items():
                self.simulate([Sphere((0.1, 0.2, 0.62), v=(0.3, 0.1, -1.0), omega=(1, 2, 0))], f"""
fix s all shape/gran type 1 {spec} density 1 orient {quat((0.6, 0.8, 0), 35)}
fix floor all large/body {floor} contact hertz 1e5 20 tangential multistep NULL NULL 0.4""", 4000, dt=1e-4)
                found[name] = [self.of(key) for key in STATE]
            for name, state in found.items():
                for one, other, key in zip(state, found["plane"], STATE):
                    self.assertAlmostEqual(one, other, delta=1e-8, msg=f"{spec} on {name}: {key}")
            self.assertGreater(found["plane"][5], 0.0, "it bounces")

    def test_thin_ones_do_not_pass_through(self):
        """Needles and plates of 1:10, thrown into a box from inside and onto a cylinder: all stay, and come to rest."""
        for spec in "ellipsoid 0.5 0.05 0.05", "superellipsoid 0.4 0.4 0.04 3 2":
            draw = random.Random(8)
            grains = [Sphere((1.1 * i - 1.1, 1.1 * j - 1.1, 1.1 * k + 0.9), v=tuple(draw.gauss(0, 1) for _ in "xyz"),
                             omega=tuple(draw.gauss(0, 3) for _ in "xyz")) for i in range(3) for j in range(3) for k in range(5)]
            law = "hooke 2e4 500 tangential multistep NULL NULL 0.5"
            rows = self.simulate(grains, f"""
fix s all shape/gran type 1 {spec} density 1 orient random 5
fix g all gravity/talus 5 vector 0 0 -1
fix room all large/body box 0 0 4 3.4 3.4 8 inside contact {law}
fix bar all large/body cylinder 0 0 0 0 1 0 0.3 1 outside contact {law}
compute low all reduce min z
compute high all reduce max x
variable weight equal 5*mass(all)""", 30000, dt=1e-4, law=law, every=3000,
                                 columns="c_low c_high f_s[1] f_s[2] f_s[6] v_weight")
            self.assertGreater(rows[-1]["c_low"], 0.0)
            self.assertLess(rows[-1]["c_high"], 1.7)
            self.assertGreater(rows[-1]["f_s[6]"], 8)
            energy = [row["f_s[1]"] + row["f_s[2]"] for row in rows]
            self.assertLess(energy[-1], 0.06 * energy[0])
            # nothing is thrown out: no more than they had and the way down
            self.assertLess(max(energy), energy[0] + 3.0 * rows[0]["v_weight"])


class Floors(SuperellipsoidCase):
    """Floors of two triangles are planes, whatever the overlap."""

    FLOORS = {"plane": "plane 0 0 0 0 0 1", "mesh": "mesh floor.stl", "rectangle": "rectangle 0 0 0 0 0 1 1 0 0 6 6"}

    def write_floor(self):
        corners = (-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)
        body_meshes.write_stl(self.path("floor.stl"), [[corners[k] for k in tri] for tri in ((0, 1, 2), (0, 2, 3))])

    def test_at_rest_on_an_incline(self):
        """15 degrees, friction .5: it rocks and stays, with the same contact in the same steps as on the plane."""
        self.write_floor()
        found = {}
        for name, floor in self.FLOORS.items():
            law = "hooke 2e4 200 tangential multistep NULL NULL 0.5"
            rows = self.simulate([Sphere((0.7, -0.3, 0.1998))], f"""
fix s all shape/gran type 1 ellipsoid .5 .35 .2 density 1
fix g all gravity/talus 1 vector {math.sin(math.radians(15))!r} 0 {-math.cos(math.radians(15))!r}
fix floor all large/body {floor} contact {law}
variable lost equal f_floor[20]<0.5
fix lost all ave/time 1 5000 5000 v_lost""", 5000, dt=4e-4, law=law, columns="f_lost f_floor[1] f_floor[3]")
            found[name] = [self.of(key) for key in STATE] + [rows[-1]["f_lost"]]
        for name, state in found.items():
            print(name, "moved by", state[0] - 0.7, "without a contact", state[-1])
            for one, other in zip(state, found["plane"]):
                self.assertAlmostEqual(one, other, delta=1e-10, msg=name)
        self.assertLess(found["plane"][-1], 0.1)    # while it rocks
        self.assertLess(found["plane"][0] - 0.7, 0.01)

    def test_one_force_at_any_depth(self):
        """A needle and a thin disc at 45 degrees, from 1e-11 deep to half way through, on floors of triangles, of a box and caps."""
        self.write_floor()
        floors = self.FLOORS | {"box": "box 0 0 -2 9 9 4 outside", "cylinder": "cylinder 0 0 -2 0 0 1 4 4 outside",
                                "cone": "cone 0 0 -2 0 0 1 5 4 4 outside"}
        for spec, axis, height in (("ellipsoid .5 .025 .025", (0, 1, 0), math.sqrt((0.25 + 0.025**2) / 2)),
                                   ("ellipsoid .5 .5 .05", (1, 0, 0), math.sqrt((0.25 + 0.05**2) / 2))):
            for depth in 1e-11, 0.03, 0.33:
                for name, floor in floors.items():
                    row, = self.simulate([Sphere((0.31, 0.17, height - depth))], f"""
fix s all shape/gran type 1 {spec} density 1 orient {quat(axis, 45)}
fix floor all large/body {floor} contact hooke 2e4 0""", 0, law="hooke 2e4 0", columns="f_floor[1] f_floor[2] f_floor[3]")
                    self.assertAlmostEqual(row["f_floor[3]"] / (-2e4 * depth), 1, delta=max(1e-10, 1e-15 / depth), msg=f"{spec} {depth} {name}")
                    self.assertAlmostEqual(row["f_floor[1]"], 0, delta=1e-9)
                    self.assertAlmostEqual(row["f_floor[2]"], 0, delta=1e-9)

    def test_elastic_bounces_in_a_drum_of_facets(self):
        """All contacts are there, so the energy stays (to the time step, as in a round drum): 1e-3 of what it falls."""
        def at(k, y):
            angle = 2 * math.pi * k / 48
            return 3 * math.cos(angle), y, 3 * math.sin(angle)
        body_meshes.write_stl(self.path("drum.stl"), [tri for k in range(48) for tri in (
            (at(k, -4), at(k + 1, 4), at(k, 4)), (at(k, -4), at(k + 1, -4), at(k + 1, 4)))])
        for drum in "mesh drum.stl", "cylinder 0 0 0 0 1 0 3 8 inside":
            rows = self.simulate([Sphere((0.7, 0, -1))], f"""
fix s all shape/gran type 1 ellipsoid .5 .35 .2 density 1 orient quat 0.9233805 0.3077935 0.2051957 0.1025978
fix g all gravity/talus 1 vector 0 0 -1
fix drum all large/body {drum} contact hooke 2e4 0
variable e equal f_s+f_drum+mass[1]*z[1]""", 60000, law="hooke 2e4 0", every=2000, columns="v_e f_drum[20]")
            fall = 0.1466 * 2
            error = max(abs(row["v_e"] - rows[0]["v_e"]) for row in rows) / fall
            print(f"{drum}: energy to {error:.1e}")
            self.assertLess(error, 1e-3)

    def test_a_lens_in_a_drum_of_nearly_its_curvature(self):
        """Its radius where it is flat is 1.25: one place in a drum that is less curved."""
        for radius in 1.251, 1.26, 1.3:
            row, = self.simulate([Sphere((radius - 0.199, 0, 0))], f"""
fix s all shape/gran type 1 ellipsoid .5 .5 .2 density 1 orient {quat((0, 1, 0), 90)}
fix drum all large/body cylinder 0 0 0 0 0 1 {radius} 4 inside contact hooke 2e4 0""", 0, law="hooke 2e4 0", columns="f_drum[1] f_drum[20]")
            self.assertAlmostEqual(row["f_drum[1]"], 20, delta=1e-9)


class Bits(SuperellipsoidCase):

    LAW = "hertz 2e4 60 tangential multistep NULL NULL 0.5"

    def scene(self, name, np=1, commands="run 1500", read="read_data ../grains", env=None):
        where = self.path(name)
        os.makedirs(where, exist_ok=True)
        log = self.run_lammps(SCENE.format(boundary="f f f", read=read, law=self.LAW, dt=5e-4, every=500, columns="f_s f_s[6]",
                                           run=commands, commands=f"""
group balls type 4
fix step balls nve/sphere/symplectic
fix s all shape/gran type 1 ellipsoid 0.5 0.35 0.25 density 1 orient random 11 &
    type 2 superellipsoid 0.35 0.3 0.4 4 4 density 1 orient random 12 type 3 box 0.5 0.5 0.4 rounded 0.05 density 1 orient random 13
fix g all gravity/talus 15 vector 0.2 0.1 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {self.LAW}
fix stirrer all large/body mesh ../stirrer.stl contact {self.LAW} move rotate 4 4 0 0 0 1 3
fix post all large/body cylinder 6 2 0 0 0 1 0.5 2 outside contact {self.LAW}
fix sides all large/body cylinder 4 4 6 0 0 1 5.7 14 inside contact {self.LAW}""") + END(" ".join(STATE)) + "\n",
                              np=np, cwd=where, env=env).log
        return read_dump(os.path.join(where, "end"))[0], log

    def test_ranks_threads_and_restart(self):
        draw = random.Random(5)
        write_sphere_data(self.path("grains"), ((-2, 10), (-2, 10), (-1, 14)), [
            Sphere((1.1 * i + 1.5, 1.1 * j + 1.5, 1.2 * k + 1.4), v=tuple(draw.gauss(0, 0.7) for _ in "xyz"),
                   omega=tuple(draw.gauss(0, 1) for _ in "xyz"), diameter=draw.uniform(0.6, 1.0), type=draw.choice((1, 1, 2, 2, 3, 4)))
            for i in range(5) for j in range(5) for k in range(5)], types=4)
        body_meshes.write_stl(self.path("stirrer.stl"), body_meshes.box((2, 3.7, 0), (6, 4.3, 0.7), 4))
        once, log = self.scene("one")
        self.assertIn("steps without output              in the records", log)
        self.assertGreater(thermo(log)[-1]["f_s[6]"], 30)
        for np, threads in (4, 1), (1, 3), (2, 2):
            with self.subTest(ranks=np, threads=threads):
                self.assert_same_bits(self.scene(f"{np} {threads}", np, env={"OMP_NUM_THREADS": str(threads)})[0], once, STATE)
        self.scene("first", 2, commands="run 700\nwrite_restart half")
        self.assert_same_bits(self.scene("second", 4, "run 800", "read_restart ../first/half")[0], once, STATE)


if __name__ == "__main__":
    unittest.main()
