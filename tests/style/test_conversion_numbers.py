# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Lines of the pages on LIGGGHTS give its numbers: forces and impacts by its equations (tests/lib/liggghts_reference.py), where bodies
go, time steps, streams. What is from LAMMPS is compared with its own styles in test_conversion_pages.py."""

import dataclasses
import math
import re
import unittest

import body_meshes
from doc_tables import commands, page, rows
from liggghts_reference import Law, Sphere, collide, heat_flow
from talus_testing import SceneCase, head, read_dump, thermo

ROWS = [(commands(theirs), commands(ours)) for theirs, ours, *_ in rows(page("from_liggghts.md"), "LIGGGHTS")]
RADIUS, DENSITY, GAP, DT = 0.0015, 2500.0, 1e-7, 5e-7
# what the rows say
ONE_TYPE = Law((5e6, 5e6), (0.45, 0.45), 0.95, 0.05)
PAIRS = {(1, 1): Law((5e6, 5e6), (0.45, 0.45), 0.5, 0.2), (1, 2): Law((5e6, 1e8), (0.45, 0.3), 0.9, 0.8),
         (2, 2): Law((1e8, 1e8), (0.3, 0.3), 0.7, 0.4)}

BEGIN = head("si") + """
region box block -0.02 0.02 -0.02 0.02 -0.02 0.02
create_box 2 box
neighbor 0.0003 bin
timestep {dt!r}
"""
DUMP = "write_dump all custom state id x y z vx vy vz omegax omegay omegaz modify format float %.17g\n"


def row_of(*words):
    """The lines of Talus of the only row whose lines of LIGGGHTS end with such a one."""
    found = [ours for theirs, ours in ROWS if all(any(word in line for line in theirs) for word in words)]
    if len(found) != 1:
        raise AssertionError(f"{len(found)} rows have {words}")
    return found[0]


def ends_with(word):
    found = [ours for theirs, ours in ROWS if theirs[-1].endswith(word)]
    if len(found) != 1:
        raise AssertionError(f"{len(found)} rows end with {word}")
    return found[0]


def grain(x, v, w=(0.0, 0.0, 0.0)):
    return Sphere(x, v, w, RADIUS, DENSITY)


def atoms(spheres, types):
    text = ""
    for n, (one, kind) in enumerate(zip(spheres, types), 1):
        text += "create_atoms {} single {} {} {}\n".format(kind, *map(repr, one.x))
        text += f"set atom {n} diameter {2 * one.radius!r}\nset atom {n} density {one.density!r}\n"
        text += "set atom {} vx {!r} vy {!r} vz {!r}\n".format(n, *one.v) + "set atom {} omega {!r} {!r} {!r}\n".format(n, *one.w)
    return text


class Impacts(SceneCase):
    """An impact that slides, one that sticks, and one of a sphere that turns, with a wall and between two grains."""

    CASES = (((0.3, 0.1, -0.5), (0.0, 0.0, 0.0)), ((0.02, 0.0, -0.5), (0.0, 10.0, 0.0)), ((0.1, 0.0, -0.3), (20.0, -100.0, 30.0)))

    def run_impact(self, lines, spheres, types, more="", dt=DT):
        steps = round(2e-3 / dt)
        log = self.run_lammps(BEGIN.format(dt=dt) + atoms(spheres, types) + "\n".join(lines) + "\n" + more +
                              f"fix move all nve/sphere/symplectic\nrun {steps}\n" + DUMP).log
        frame, = read_dump(self.path("state"))
        keys = "vx vy vz omegax omegay omegaz".split()
        return [[frame.column(key)[n] for key in keys] for n in sorted(frame.atoms)], log

    def compare(self, law, lines, kinds, wall="", tolerance=0.045):
        """`tolerance`: of the tangential motion, over the speed, for the lever arm is R and not R - d/2."""
        for v, w in self.CASES:
            with self.subTest(v=v, wall=wall):
                if wall:
                    spheres = [grain((0.0, 0.0, RADIUS + GAP), v, w)]
                else:
                    spheres = [grain((0.0, 0.0, RADIUS + GAP / 2), tuple(0.5 * c for c in v), w),
                               grain((0.0, 0.0, -RADIUS - GAP / 2), tuple(-0.5 * c for c in v))]
                found, _ = self.run_impact(lines, spheres, kinds, wall)
                expected = [dataclasses.replace(one) for one in spheres]
                collide(law, *expected, dt=DT)
                speed = math.hypot(*v)
                for (vx, vy, vz, wx, wy, wz), one in zip(found, expected):
                    self.assertAlmostEqual(vz, one.v[2], delta=1e-3 * speed)
                    for mine, theirs in ((vx, one.v[0]), (vy, one.v[1]), (RADIUS * wx, RADIUS * one.w[0]),
                                         (RADIUS * wy, RADIUS * one.w[1]), (RADIUS * wz, RADIUS * one.w[2])):
                        self.assertAlmostEqual(mine, theirs, delta=tolerance * speed)

    def both(self, law, lines):
        wall, = ends_with("primitive type 1 zplane 0.0")
        self.compare(law, lines, [1], wall + "\n")
        self.compare(law, lines, [1, 1])

    def test_hertz(self):
        self.both(ONE_TYPE, row_of("poissonsRatio peratomtype 0.45", "peratomtypepair 1 0.95"))

    def test_hooke(self):
        law = dataclasses.replace(ONE_TYPE, model="hooke", characteristic_velocity=2.0)
        self.both(law, row_of("characteristicVelocity"))

    def test_no_history(self):
        self.both(dataclasses.replace(ONE_TYPE, tangential="no_history"), row_of("tangential no_history"))

    def test_rolling_friction(self):
        self.both(dataclasses.replace(ONE_TYPE, cdt=0.1), row_of("rolling_friction cdt"))

    def test_values_of_pairs(self):
        """Grains of two kinds, each with itself, with the other, and with a wall of either: nothing is taken from another pair."""
        lines = row_of("peratomtypepair 2")
        for (i, j), law in PAIRS.items():
            self.compare(law, lines, [i, j])
            for grains, wall in {(i, j), (j, i)}:
                self.compare(law, lines, [grains], f"fix wall all large/body plane 0 0 0  0 0 1  type {wall}\n")

    def test_wall_that_is_told_in_the_log(self):
        lines = row_of("peratomtypepair 2") + ["fix wall all large/body plane 0 0 0  0 0 1  type 2"]
        _, log = self.run_impact(lines, [grain((0, 0, RADIUS + GAP), (0, 0, -0.1))], [1], dt=1e-5)
        told = re.findall(r"Talus fix large/body wall: type (\d): (.*)", log)
        pairs = dict(re.findall(r"  types (\d 2): (.*)", log))
        self.assertEqual(told, [("1", pairs["1 2"]), ("2", pairs["2 2"])])
        self.assertIn("multistep spring; E and nu of both types; E_eff ", told[0][1])
        self.assertEqual(float(re.search(r" mu (\S+)", told[0][1]).group(1)), 0.8)
        for (_, text), law in zip(told, (PAIRS[1, 2], PAIRS[2, 2])):
            young = 1 / sum((1 - nu**2) / e for e, nu in zip(law.young, law.poisson))
            self.assertAlmostEqual(float(re.search(r"E_eff (\S+)", text).group(1)) / young, 1, delta=1e-5)

    def test_force_of_a_contact_that_slides_is_that_of_the_step(self):
        """A set-up without a step finds it again, whatever slid."""
        lines = row_of("poissonsRatio peratomtype 0.45", "peratomtypepair 1 0.95") + ends_with("primitive type 1 zplane 0.0")
        forces = "write_dump all custom {0} id fx fy fz tqx tqy tqz modify format float %.17g\n"
        more = ("fix move all nve/sphere/symplectic\nrun 300\n" + forces.format("before") + "run 0\n" + forces.format("after"))
        self.run_lammps(BEGIN.format(dt=1e-6) + atoms([grain((0, 0, RADIUS + GAP), (0.5, 0.2, -0.5))], [1]) + "\n".join(lines) + "\n" + more)
        (before,), (after,) = read_dump(self.path("before")), read_dump(self.path("after"))
        self.assertGreater(abs(before.column("fx")[1]), 0.0)
        self.assertGreater(before.column("fz")[1], 0.0)
        for key in "fx fy fz tqx tqy tqz".split():
            self.assertAlmostEqual(before.column(key)[1], after.column(key)[1], delta=2e-3 * abs(before.column("fz")[1]) * (RADIUS if "t" in key else 1))


class Heat(SceneCase):

    def check_flow(self, lines, real_overlap=1.0):
        """`real_overlap`: of grains that touch in the circle through which heat flows, over that in the run."""
        overlap = 1e-3 * RADIUS
        spheres = [grain((0.0, 0.0, RADIUS - overlap / 2), (0, 0, 0)), grain((0.0, 0.0, -RADIUS + overlap / 2), (0, 0, 0))]
        self.run_lammps(BEGIN.format(dt=1e-9) + atoms(spheres, [1, 1]) + "\n".join(lines) + "\n" +
                        "set atom 1 temperature 300\nset atom 2 temperature 310\nfix move all nve/sphere/symplectic\n" +
                        "compute flow all property/atom heatflow\ndump flow all custom 1 state id c_flow\ndump_modify flow format float %.17g\nrun 1\n")
        frame, *_ = read_dump(self.path("state"))    # of the set-up: nobody clears the flow
        expected = 10 * heat_flow((100.0, 100.0), RADIUS, RADIUS, real_overlap * overlap)
        self.assertAlmostEqual(frame.column("c_flow")[1] / expected, 1, delta=1e-3)
        self.assertAlmostEqual(frame.column("c_flow")[2] / expected, -1, delta=1e-3)

    def test_conduction(self):
        self.check_flow(ends_with("heattransfer"))

    def test_original_modulus(self):
        """Overlaps are those of the original modulus under the same force."""
        self.check_flow(ends_with("area_correction yes"), (5e6 / 7e10)**(2 / 3))


class Bodies(SceneCase):
    """Places and velocities of bodies by the formulas of move/mesh, at any time; and where walls are."""

    PAIR = row_of("poissonsRatio peratomtype 0.45", "peratomtypepair 1 0.95")
    SHOW = "thermo_style custom step " + " ".join(f"f_cad[{n}]" for n in range(7, 20)) + "\nthermo_modify format float %.12g\nthermo 50\n"
    STEPS, DT = 200, 1e-4

    def motion(self, lines):
        body_meshes.write_stl(self.path("drum.stl"), body_meshes.sphere((2.5, 2.5, 4), 12, 12))
        lone = [grain((0.015, 0.015, -0.015), (0, 0, 0))]
        log = self.run_lammps(BEGIN.format(dt=self.DT) + atoms(lone, [1]) + "\n".join([*self.PAIR, *lines]) + "\n" + self.SHOW +
                              f"fix move all nve/sphere/symplectic\nrun {self.STEPS}\n").log
        return {round(row["Step"]): [row[f"f_cad[{n}]"] for n in range(7, 20)] for row in thermo(log)}

    def assert_heights(self, lines, height, speed):
        found = self.motion(lines)
        start = found[0][2] - height(0.0)
        for step, (_, _, z, *_, ) in found.items():
            self.assertAlmostEqual(z - start, height(step * self.DT), delta=1e-6)
            self.assertAlmostEqual(found[step][9], speed(step * self.DT), delta=1e-3)

    def test_linear(self):
        lines, = [ours for theirs, ours in ROWS if len(theirs) == 1 and "linear 0. 0. -0.1" in theirs[0]]
        self.assert_heights(lines, lambda t: -0.1 * t, lambda t: -0.1)

    def test_linear_for_some_time(self):
        lines, = [[line.replace("1000", "100") for line in ours] for theirs, ours in ROWS if theirs[-1] == "unfix movecad"]
        self.assert_heights(lines, lambda t: -0.1 * min(t, 0.01), lambda t: -0.1 * (t < 0.01 - 1e-9))

    def test_wiggle(self):
        turn = 2 * math.pi / 0.1
        self.assert_heights(row_of("wiggle amplitude"), lambda t: 0.01 * math.sin(turn * t), lambda t: 0.01 * turn * math.cos(turn * t))

    def test_rotation(self):
        """About the axis by the right-hand rule, once in a period."""
        found = self.motion(row_of("period 5."))
        angle = 2 * math.pi * self.STEPS * self.DT / 5
        quaternion = found[self.STEPS][3:7]
        self.assertAlmostEqual(quaternion[0], math.cos(angle / 2), delta=1e-9)
        self.assertAlmostEqual(quaternion[3], math.sin(angle / 2), delta=1e-9)
        self.assertAlmostEqual(found[self.STEPS][12], 2 * math.pi / 5, delta=1e-9)

    def force_on(self, wall, x):
        self.run_lammps(BEGIN.format(dt=1e-6) + atoms([grain(x, (0, 0, 0))], [1]) + "\n".join([*self.PAIR, *wall]) +
                        "\nfix move all nve/sphere/symplectic\nrun 0\nwrite_dump all custom state id fx fy fz modify format float %.17g\n")
        frame, = read_dump(self.path("state"))
        return [frame.column(key)[1] for key in ("fx", "fy", "fz")]

    def test_walls_are_where_they_were(self):
        overlap = 0.01 * RADIUS
        expected = ONE_TYPE.stiffness_and_damping(RADIUS, 1.0, overlap)[0] * overlap
        for wall, x, direction in ((ends_with("type 1 zplane 0.0"), (0.001, 0.002, RADIUS - overlap), (0, 0, 1)),
                                   (ends_with("zcylinder 0.05 0. 0."), (0.005 - RADIUS + overlap, 0.0, 0.003), (-1, 0, 0))):
            force = self.force_on([line.replace("0.05 INF", "0.005 INF") for line in wall], x)
            for mine, n in zip(force, direction):
                self.assertAlmostEqual(mine / expected, n, delta=1e-9)


class Others(SceneCase):

    def test_time_step(self):
        """Rayleigh's and Hertz' of check/timestep/gran (G = Y/(2 (1 + nu)), rho), with the line for it."""
        lines = [*row_of("poissonsRatio peratomtype 0.45", "peratomtypepair 1 0.95"), *row_of("check/timestep/gran")]
        log = self.run_lammps(BEGIN.format(dt=1e-7) + atoms([grain((0, 0, 0), (0, 0, 0)), grain((0, 0, 0.0031), (0, 0, -0.5))], [1, 1]) +
                              "\n".join(lines) + "\nfix move all nve/sphere/symplectic\nthermo_style custom step c_ts[2] c_ts[3]\nrun 0\n").log
        last, = thermo(log)
        rayleigh = math.pi * RADIUS * math.sqrt(DENSITY / (5e6 / (2 * 1.45))) / (0.1631 * 0.45 + 0.8766)
        self.assertAlmostEqual(last["c_ts[2]"] / rayleigh, 1, delta=1e-5)
        mass, young = grain((0, 0, 0), (0, 0, 0)).mass / 2, 5e6 / (2 * (1 - 0.45**2))
        hertz = 2.87 * (mass**2 / (RADIUS / 2 * young**2 * 0.5))**0.2
        self.assertAlmostEqual(last["c_ts[3]"] / hertz, 1, delta=1e-5)

    def test_stream_and_packs(self):
        """As many spheres in a time, or at once, and of the sizes, as the line of LIGGGHTS says."""
        lines = row_of("particlerate 1000")
        box = BEGIN.format(dt=1e-4).replace("-0.02 0.02 -0.02 0.02 -0.02 0.02", "-0.1 0.1 -0.1 0.1 -0.1 0.1")
        pair = "\n".join(row_of("poissonsRatio peratomtype 0.45", "peratomtypepair 1 0.95"))
        stream = "\n".join([box, pair, *lines, "fix move all nve/sphere/symplectic", "thermo_style custom step atoms", "run 1000"])
        self.assertAlmostEqual(thermo(self.run_lammps(stream).log)[-1]["Atoms"], 100, delta=11)    # .1 s, made every 10 ms
        for words, expected in (("particles_in_region 100",), {0.0015: 100}), (("numberbased",), {0.0015: 70, 0.002: 30}):
            pack = "\n".join([box, pair, *row_of(*words), "write_dump all custom state id radius mass modify format float %.17g"])
            self.run_lammps(pack)
            frame, = read_dump(self.path("state"))
            radii = list(frame.column("radius").values())
            self.assertEqual(len(radii), 100)
            for radius, count in expected.items():
                self.assertAlmostEqual(sum(abs(r - radius) < 1e-9 for r in radii), count, delta=0 if len(expected) == 1 else 14)
            for radius, mass in zip(radii, frame.column("mass").values()):
                self.assertAlmostEqual(mass, 2500 * 4 / 3 * math.pi * radius**3, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
