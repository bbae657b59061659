# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""One and two particles with known answers: Chung & Ooi 2011 tests 1 and 2, MFIX-DEM 01, 02 and 04, and
the weight of spheres on a floor.  Tables of the figures are printed."""

import math
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, relative_difference, thermo, write_sphere_data

SCRIPT = begin("si", read="read_data particles", law="{law}", skin="{skin}") + """
fix step all nve/sphere/symplectic start half {gravity}
timestep {dt!r}
{more}
thermo_modify norm no format float %.17g
run {steps}
"""
GRAVITY = "gravity 9.81 vector 0 0 -1"


class CollisionCase(SceneCase):

    def simulate(self, spheres, law, dt, steps, more, gravity="", box=((-2, 2),) * 3):
        write_sphere_data(self.path("particles"), box, spheres)
        skin = 0.1 * spheres[0].diameter
        return self.run_lammps(SCRIPT.format(law=law, dt=dt, steps=steps, more=more,
                                             gravity=gravity, skin=skin)).log

    def positions(self):
        """[(step, {tag: height})] of the dump."""
        return [(frame.step, frame.column("z")) for frame in read_dump(self.path("heights"))]


def heights(every):
    return (f"dump z all custom {every} heights id z\n"
            "dump_modify z format float %.17g\nthermo 100000000\n")


# ---- Chung & Ooi 2011 ------------------------------------------------------------------------

# material: (E, nu, density, radius, speed, expected overlap, force, time)
SPHERE_ON_SPHERE = {
    "glass": (4.8e10, 0.20, 2800.0, 0.010, 10.0, 2.741127e-4, 1.069689e4, 4.0339e-5),
    "limestone": (2.0e10, 0.25, 2500.0, 0.010, 10.0, 3.683040e-4, 7.108241e3, 5.4201e-5),
}
SPHERE_ON_PLANE = {
    "Al alloy": (7.0e10, 0.30, 2699.0, 0.10, 0.2, 4.971718e-5, 1.136986e4, 7.3166e-4),
    "Mg alloy": (4.0e10, 0.35, 1800.0, 0.10, 0.2, 5.212329e-5, 7.232681e3, 7.6707e-4),
}
WATCH = """
thermo 1
thermo_style custom step v_overlap v_force
"""
PAIR_GAUGE = """
variable overlap equal {diameter!r}-sqrt((x[2]-x[1])^2+(y[2]-y[1])^2+(z[2]-z[1])^2)
variable force equal sqrt(fx[1]^2+fy[1]^2+fz[1]^2)
""" + WATCH
PLANE_GAUGE = """
fix plane all large/body plane 0.1 -0.2 0.3  1 2 2  contact {law}
variable overlap equal {radius!r}-(x[1]-0.1+2*(y[1]+0.2)+2*(z[1]-0.3))/3
variable force equal sqrt(f_plane[1]^2+f_plane[2]^2+f_plane[3]^2)
""" + WATCH


def along(direction, length, origin=(0.0, 0.0, 0.0)):
    size = math.sqrt(sum(d * d for d in direction))
    return tuple(o + length * d / size for o, d in zip(origin, direction))


def contact_time(rows, dt):
    """Between the two instants of zero overlap, by linear interpolation."""
    ends = []
    for a, b in zip(rows, rows[1:]):
        if (a["v_overlap"] < 0) != (b["v_overlap"] < 0):
            ends.append(a["Step"] + a["v_overlap"] / (a["v_overlap"] - b["v_overlap"]))
    begin, end = ends
    return (end - begin) * dt


class ChungOoi(CollisionCase):

    def check(self, name, material, log, dt):
        rows = thermo(log)
        found = (max(r["v_overlap"] for r in rows), max(r["v_force"] for r in rows),
                 contact_time(rows, dt))
        wrong = [relative_difference(a, b) for a, b in zip(found, material[5:])]
        print(f"{name:32}", *(f"{a:12.5e} ({100 * w:.4f} %)" for a, w in zip(found, wrong)))
        self.assertLess(max(wrong), 1e-3, name)

    def test_1_sphere_on_sphere(self):
        print(f"\n{'':32} largest overlap (m)     largest force (N)       contact time (s)")
        for name, material in SPHERE_ON_SPHERE.items():
            E, nu, density, r, speed, *_, time = material
            kn = 4 / 3 * E / (2 * (1 - nu * nu))
            dt, axis = time / 2000, (1, 2, -2)
            gap = 2 * r + 20.3 * 2 * speed * dt
            spheres = [Sphere(along(axis, s * gap / 2), along(axis, -s * speed), diameter=2 * r,
                              density=density) for s in (-1, 1)]
            log = self.simulate(spheres, f"hertz {kn!r} 0.0", dt, 2100,
                                PAIR_GAUGE.format(diameter=2 * r))
            self.check(f"1 {name} on {name}", material, log, dt)

    def test_2_sphere_on_rigid_plane(self):
        print()
        for name, material in SPHERE_ON_PLANE.items():
            E, nu, density, r, speed, *_, time = material
            law = f"hertz {4 / 3 * E / (1 - nu * nu)!r} 0.0"
            dt, normal = time / 2000, (1, 2, 2)
            start = along(normal, r + 20.3 * speed * dt, (0.1, -0.2, 0.3))
            sphere = Sphere(start, along(normal, -speed), diameter=2 * r, density=density)
            log = self.simulate([sphere], "hooke 1.0 0.0", dt, 2100,
                                PLANE_GAUGE.format(law=law, radius=r))
            self.check(f"2 {name} on rigid plane", material, log, dt)


# ---- MFIX-DEM (Garg et al. 2012) -------------------------------------------------------------

R, DENSITY, H0, G = 0.1, 2600.0, 0.5, 9.81
MASS = DENSITY * 4 / 3 * math.pi * R ** 3


class FallAndRebound:
    """Height of a sphere: free fall, damped oscillator in contact, free flight."""

    def __init__(self, kn, gn):
        self.w2, self.c = kn / MASS, gn / 2
        self.wd = math.sqrt(self.w2 - self.c ** 2)
        self.speed = math.sqrt(2 * G * (H0 - R))
        self.begin = self.speed / G
        self.sine = (-self.speed + self.c * G / self.w2) / self.wd
        low, high = 0.5 * math.pi / self.wd, 1.5 * math.pi / self.wd
        while high - low > 1e-15:
            middle = (low + high) / 2
            low, high = (middle, high) if self.pressed(middle) < 0 else (low, middle)
        self.end = self.begin + low
        self.rebound = (self.pressed(low + 1e-7) - self.pressed(low - 1e-7)) / 2e-7

    def pressed(self, t):
        wave = G / self.w2 * math.cos(self.wd * t) + self.sine * math.sin(self.wd * t)
        return math.exp(-self.c * t) * wave - G / self.w2

    def height(self, t):
        if t < self.begin:
            return H0 - G * t * t / 2
        if t < self.end:
            return R + self.pressed(t - self.begin)
        return R + self.rebound * (t - self.end) - G * (t - self.end) ** 2 / 2


class Mfix(CollisionCase):

    def test_01_free_fall_contact_and_rebound(self):
        kn, gn, dt = 1.0e4, 10.0, 5.0e-6
        exact = FallAndRebound(kn, gn)
        floor = f"fix floor all large/body plane 0 0 0 0 0 1 contact hooke {kn!r} {gn!r}\n"
        self.simulate([Sphere((0, 0, H0), diameter=2 * R, density=DENSITY)], "hooke 1.0 0.0", dt,
                      120000, floor + heights(80), GRAVITY)
        stages = {"free fall": (0, exact.begin), "contact": (exact.begin, exact.end),
                  "rebound": (exact.end, 0.6)}
        print()
        for stage, (begin, end) in stages.items():
            errors = [abs(z[1] - exact.height(step * dt)) for step, z in self.positions()
                      if begin <= step * dt <= end]
            print(f"MFIX 01 {stage:10} {begin:.5f} to {end:.5f} s: largest error of height "
                  f"{max(errors) / (2 * R):.1e} of a diameter")
            self.assertGreater(len(errors), 200)
            self.assertLess(max(errors), 1e-4 * 2 * R, stage)

    def test_02_bounce_heights(self):
        kn, restitution = 1.0e8, (0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
        w = math.sqrt(kn / MASS)
        dt = math.pi / w / 400
        floor, spheres = "fix floor all large/body plane 0 0 0 0 0 1", []
        for n, e in enumerate(restitution, start=1):
            gn = -2 * w * math.log(e) / math.hypot(math.pi, math.log(e))
            floor += f" contact types {n} hooke {kn!r} {gn!r}"
            spheres.append(Sphere((-2 + 0.5 * n, 0, H0), diameter=2 * R, density=DENSITY, type=n))
        self.simulate(spheres, "hooke 1.0 0.0", dt, int(2.6 / dt), floor + "\n" + heights(160), GRAVITY)
        found = self.positions()
        print("\nMFIX 02, heights of bounces; exact in brackets")
        for n, e in enumerate(restitution, start=1):
            tops = [b[n] for (_, a), (_, b), (_, c) in zip(found, found[1:], found[2:])
                    if a[n] < b[n] >= c[n] and b[n] > 1.02 * R][:4]
            exact = [R + e ** (2 * k) * (H0 - R) for k in range(1, len(tops) + 1)]
            print(f"e = {e}:", *(f"{a:.4f} ({b:.4f})" for a, b in zip(tops, exact, strict=True)))
            self.assertGreaterEqual(len(tops), 3, f"e = {e}")
            for a, b in zip(tops, exact, strict=True):
                self.assert_close(a, b, 5e-3, f"e = {e}: height {a} against {b}")

    def test_04_slip_to_roll(self):
        kn, mu, u0 = 1.0e7, 0.3, 1.5
        w = math.sqrt(kn / MASS)
        stop = 2 * u0 / (7 * mu * G)
        print(f"\nMFIX 04: slip ends after {stop:.5f} s, then u = {5 * u0 / 7:.5f} and w r = u")
        for friction in (f"multistep NULL {0.05 * w!r}", f"onestep NULL {50 * w!r}", f"dashpot {50 * w!r}"):
            law = f"hooke {kn!r} {0.5 * w!r} tangential {friction} {mu}"
            rest = R - MASS * G / kn
            spheres = [Sphere((-1.5, 0, rest), (u0, 0, 0), diameter=2 * R, density=DENSITY)]
            log = self.simulate(spheres, "hooke 1.0 0.0", 0.01 / w, int(2 * stop * 100 * w), f"""
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
variable u equal vx[1]
compute omega all property/atom omegay
compute spin all reduce sum c_omega
thermo 20
thermo_style custom step v_u c_spin f_floor[1]
""", GRAVITY)
            rows = thermo(log)
            limit = mu * MASS * G
            sliding = [row for row in rows if row["f_floor[1]"] > 0.99 * limit]
            found = sliding[-1]["Step"] * 0.01 / w, rows[-1]["v_u"], R * rows[-1]["c_spin"]
            print(f"  {friction.split()[0]:10} slip ends {found[0]:.5f} u {found[1]:.6f} w r {found[2]:.6f}")
            for value, exact, limit in zip(found, (stop, 5 * u0 / 7, 5 * u0 / 7), (5e-3, 1e-3, 1e-3), strict=True):
                self.assert_close(value, exact, limit, friction)


class ContainerForce(CollisionCase):

    def test_floor_carries_the_weight(self):
        law, dt = "hooke 2.0e4 5.0e2", 1e-3
        spheres = [Sphere((i, i, 0.55), density=5 / (math.pi / 6)) for i in range(-4, 4)]
        log = self.simulate(spheres, law, dt, 3000, f"""
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
thermo 10
thermo_style custom step f_floor[3] f_floor[20]
""", GRAVITY, ((-10, 10), (-10, 10), (-1, 5)))
        carried = {row["Step"] * dt: -row["f_floor[3]"] for row in thermo(log)}
        worst = max(abs(force - 392.4) for time, force in carried.items() if time >= 0.5)
        print(f"\nfloor carries {carried[3.0]:.6f} N of 392.4 N at 3 s; "
              f"at worst {worst:.1e} N off after 0.5 s")
        self.assertLess(worst, 1e-3 * 392.4)
        self.assertLess(abs(carried[3.0] - 392.4), 1e-3)
        self.assertEqual(thermo(log)[-1]["f_floor[20]"], 8)


if __name__ == "__main__":
    unittest.main()
