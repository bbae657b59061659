# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=55
"""Energy audit: no collision, grazing ones included, leaves more kinetic energy than there was.

Angles 0 to 89 degrees from the normal, coefficients of friction 0 to 2, restitution 0.1 to 1, spins -50 to
50 rad/s, for every law, with and without limit_damping, of a sphere with a plane and of two unequal
spheres.  Each run holds thousands of collisions that do not see each other; coefficients go by type."""

import collections
import itertools
import math
import unittest

from talus_testing import SceneCase, Sphere, begin, part_of, read_dump, thermo, write_sphere_data

ANGLES = (*range(0, 90, 5), 89)
FRICTION = 0.0, 0.1, 0.3, 0.5, 1.0, 2.0
RESTITUTION = 0.1, 0.3, 0.5, 0.7, 0.9, 1.0
SPINS = -50.0, -20.0, -5.0, 0.0, 5.0, 20.0, 50.0
MATERIALS = list(itertools.product(FRICTION, RESTITUTION))    # one atom type each
SPEED, DENSITY, RADII = 2.0, 2500.0, (0.10, 0.07)
SPACING, GAP = 1.0, 1e-9
LIMIT = 1e-3    # of the kinetic energy before

Case = collections.namedtuple("Case", "angle spin type")
CASES = [Case(*c) for c in itertools.product(ANGLES, SPINS, range(1, len(MATERIALS) + 1))]

# friction keywords; kt, stiff, strong are replaced by numbers that suit the stiffness and the frequency,
# gt by NULL where a law has a default
MULTISTEP = "tangential multistep NULL {gt} {mu}"
PLAIN = {
    "none": "",
    "dashpot": "tangential dashpot {gt} {mu}",
    "onestep": "tangential onestep NULL {gt} {mu}",
    "multistep": MULTISTEP,
    "multistep, gt = 0": "tangential multistep NULL 0.0 {mu}",
    "multistep midpoint": MULTISTEP + " midpoint",
    "multistep, rolling, spinning": MULTISTEP + " rolling 0.2 spinning 0.2",
}
NUMBERS = {
    "dashpot, strong": "tangential dashpot {strong!r} {mu}",
    "onestep, stiff": "tangential onestep {stiff!r} NULL {mu}",
    "multistep, kt = 1.2 kn, gt = 0": "tangential multistep {kt!r} 0.0 {mu}",
    "multistep, kt = 1.2 kn": "tangential multistep {kt!r} NULL {mu}",
    "multistep midpoint, kt = 1.2 kn": "tangential multistep {kt!r} NULL {mu} midpoint",
    "multistep slider, strong": "tangential multistep NULL {strong!r} {mu} slider",
    "multistep slider midpoint, strong": "tangential multistep NULL {strong!r} {mu} midpoint slider",
}
FRICTION_WORDS = {    # of each normal law
    "hooke": {**PLAIN, **NUMBERS}, "hertz": {**PLAIN, **NUMBERS}, "flores": PLAIN,
    "hooke/material": PLAIN, "hertz/material": PLAIN, "flores/material": PLAIN,
    "plaincoulomb": {"own": ""}, "plaincoulomb/material": {"own": ""},
}
LIMITED = "none", "multistep", "own"    # run with limit_damping as well

EXACT = "hooke", "hertz", "hooke/material"    # restitution is that of the words

SCRIPT = begin("si", read="read_data {data}") + """
{coefficients}
neighbor 0.02 bin
fix step all nve/sphere/symplectic
{plane}
timestep {dt!r}
compute pair all pair gran/penalty
thermo {steps}
thermo_style custom step {contacts}
thermo_modify norm no
run {steps}
write_dump all custom {out} id mass radius vx vy vz omegax omegay omegaz modify format float %.17g
"""


def mass(radius):
    return DENSITY * 4 / 3 * math.pi * radius ** 3


# ---- damping for a wanted coefficient of restitution -------------------------------------------

def hertz_restitution(damping):
    """Of y'' = -sqrt(y) (y + damping y'), y(0) = 0, y'(0) = 1, until y = 0 again."""
    def slope(y, v):
        return v, -math.sqrt(max(y, 0.0)) * (y + damping * v)

    y, v, h = 0.0, 1.0, 0.01
    while y >= 0 and v > -1 and not (v < 0 and y < 1e-7):
        a = slope(y, v)
        b = slope(y + h / 2 * a[0], v + h / 2 * a[1])
        c = slope(y + h / 2 * b[0], v + h / 2 * b[1])
        d = slope(y + h * c[0], v + h * c[1])
        y, v = (s + h / 6 * (k + 2 * l + 2 * m + n) for s, k, l, m, n in zip((y, v), a, b, c, d))
    return -v


def hertz_damping(e):
    low, high = 0.0, 5.0
    for _ in range(30):
        middle = (low + high) / 2
        low, high = (middle, high) if hertz_restitution(middle) > e else (low, middle)
    return low


HERTZ_DAMPING = {e: hertz_damping(e) if e < 1 else 0.0 for e in RESTITUTION}


class Collision:
    """Numbers of one normal law for one effective mass and radius."""

    YOUNG, POISSON = 1.0e8, 0.25

    def __init__(self, normal, m, r):
        self.normal, self.m = normal, m
        material = 4 / 3 * self.YOUNG / (2 * (1 - self.POISSON ** 2))
        self.kn = {"hooke": 1.0e6, "hertz": 5.0e7, "flores": 5.0e7, "plaincoulomb": 1.0e7}.get(
            normal, material)
        if normal == "hooke":
            self.w = math.sqrt(self.kn / m)
        else:    # y = d/depth, time in depth/speed: depth^(5/2) = m speed^2/(kn sqrt(r))
            root = 1.0 if "plain" in normal else math.sqrt(r)
            self.depth = (m * SPEED ** 2 / (self.kn * root)) ** 0.4
            self.w = SPEED / self.depth
            self.scale = self.kn * self.depth / (m * SPEED)
        self.dt = math.pi / self.w / 100
        self.steps = {"hooke": 300, "flores": 2500, "flores/material": 2500}.get(normal, 800)

    def words(self, friction, mu, e, limited):
        unit = 1.0 if self.normal == "hooke" else self.scale / self.w
        gt = repr(0.5 * HERTZ_DAMPING[e] * self.scale) if self.normal == "flores" else "NULL"
        words = FRICTION_WORDS[self.normal][friction].format(
            mu=mu, gt=gt, kt=1.2 * self.kn, stiff=30 * self.kn, strong=5 * self.w * unit)
        own = f" {mu}" if "plain" in self.normal else ""
        return f"{self.normal} {self.normal_words(e)}{own} {words}{' limit_damping' * limited}"

    def normal_words(self, e):
        if "material" in self.normal:
            speed = "" if self.normal.startswith(("hertz", "plain")) else f" {SPEED}"
            return f"{self.YOUNG!r} {e} {self.POISSON}{speed}"
        return f"{self.kn!r} {self.gn(e)!r}"

    def gn(self, e):
        if self.normal == "hooke":
            return -2 * self.w * math.log(e) / math.hypot(math.pi, math.log(e))
        if self.normal == "flores":
            return 1.6 * (1 - e) / (e * SPEED) * self.kn / self.m
        return HERTZ_DAMPING[e] * self.scale * (self.m if "plain" in self.normal else 1.0)


# ---- scenes ----------------------------------------------------------------------------------

def places():
    side = math.ceil(math.sqrt(len(CASES)))
    return [(SPACING * (n % side), SPACING * (n // side)) for n in range(len(CASES))]


def spheres_on_plane():
    """Sphere n collides with the plane z = 0 as case n says."""
    r, found = RADII[0], []
    for case, (x, y) in zip(CASES, places()):
        angle = math.radians(case.angle)
        found.append(Sphere((x, y, r + GAP), (SPEED * math.sin(angle), 0, -SPEED * math.cos(angle)),
                            (0, case.spin, 0), 2 * r, DENSITY, case.type))
    return found


def pairs_of_spheres():
    """Spheres 2 n and 2 n + 1 collide as case n says; their center of mass is at rest."""
    found, masses = [], [mass(r) for r in RADII]
    for case, (x, y) in zip(CASES, places()):
        angle = math.radians(case.angle)
        for k, sign, turn in ((0, 1, 1.0), (1, -1, 0.3)):
            v = sign * SPEED * masses[1 - k] / sum(masses)
            found.append(Sphere((x, y, sign * (RADII[k] + GAP)),
                                (v * math.sin(angle), 0, -v * math.cos(angle)),
                                (0, turn * case.spin, 0), 2 * RADII[k], DENSITY, case.type))
    return found


def energy(m, r, *motion):
    v, w = motion[:3], motion[3:]
    return 0.5 * m * sum(c * c for c in v) + 0.2 * m * r * r * sum(c * c for c in w)


def energies(values, per_case):
    """Kinetic energy by case of [(mass, radius, v, omega), ...] in order of particles."""
    single = [energy(*value) for value in values]
    return [sum(single[n:n + per_case]) for n in range(0, len(single), per_case)]


SCENES = {"plane": (spheres_on_plane, 1), "pair": (pairs_of_spheres, 2)}


class EnergyAudit(SceneCase):

    def run_law(self, scene, collision, friction, limited):
        words = [collision.words(friction, mu, e, limited) for mu, e in MATERIALS]
        pair = "\n".join(f"pair_coeff {t} {t} {w}" for t, w in enumerate(words, start=1))
        body = " ".join(f"contact types {t} {w}" for t, w in enumerate(words, start=1))
        on_plane = scene == "plane"
        log = self.run_lammps(SCRIPT.format(
            data=scene, out="after", dt=collision.dt, steps=collision.steps,
            coefficients=pair,
            plane=f"fix plane all large/body plane 0 0 0 0 0 1 {body}" if on_plane else "",
            contacts="f_plane[20]" if on_plane else "c_pair[1]")).log
        begin, end = (row[key] for row in thermo(log) for key in row if key != "Step")
        # flores with a low restitution presses the spheres apart slowly, by creep
        last = 400 if "flores" in collision.normal else 0
        self.assertTrue(begin == 0 and end <= last, f"contacts at both ends: {begin}, {end}")
        frame, = read_dump(self.path("after"))
        return [frame.atoms[tag][1:] for tag in sorted(frame.atoms)]

    def audit(self, scene):
        make, per_case = SCENES[scene]
        spheres = make()
        side = SPACING * math.ceil(math.sqrt(len(CASES)))
        write_sphere_data(self.path(scene), ((-1, side), (-1, side), (-1, 1)), spheres)
        before = energies([(mass(s.diameter / 2), s.diameter / 2, *s.v, *s.omega) for s in spheres],
                          per_case)
        m, r = mass(RADII[0]), RADII[0]
        if scene == "pair":
            m, r = (a * b / (a + b) for a, b in ((m, mass(RADII[1])), RADII))
        print(f"\n{scene}: {len(CASES)} collisions for each law; largest gain of kinetic energy")
        laws = [(normal, friction, limited) for normal, known in FRICTION_WORDS.items()
                for friction in known for limited in ((0, 1) if friction in LIMITED else (0,))]
        for law in part_of(laws, 3, list(SCENES).index(scene)):
            after = energies(self.run_law(scene, Collision(law[0], m, r), *law[1:]), per_case)
            self.judge(law, before, after)

    def judge(self, law, before, after):
        gain, case = max((b / a - 1, case) for a, b, case in zip(before, after, CASES))
        mu, e = MATERIALS[case.type - 1]
        name = f"{law[0]}, {law[1]}{', limit_damping' if law[2] else ''}"
        print(f"{name:55}{gain:10.1e} at {case.angle} deg, spin {case.spin}, mu {mu}, e {e}")
        with self.subTest(name):
            self.assertLess(gain, LIMIT)
            self.assert_collisions_happened(law, before, after)

    def assert_collisions_happened(self, law, before, after):
        """Head-on without spin, energy falls to e^2, where limit_damping does not alter e."""
        for a, b, case in zip(before, after, CASES):
            if (case.angle, case.spin) == (0, 0.0) and law[0] in EXACT and not law[2]:
                self.assertAlmostEqual(b / a, MATERIALS[case.type - 1][1] ** 2, delta=0.02)

    def test_sphere_with_plane(self):
        self.audit("plane")

    def test_two_spheres(self):
        self.audit("pair")


if __name__ == "__main__":
    unittest.main()
