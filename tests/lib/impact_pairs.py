# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Chung and Ooi 2011 (Granular Matter 13:643), tests 5, 7 and 8: their curves, as the port of these tests to Kratos has digitised them,
elastic oblique impacts integrated apart from any code, and runs of many pairs of spheres at once, far from each other."""

import dataclasses
import math

from granular_script import begin
from impact_tables import AL_ALLOY_4, STEPS_PER_CONTACT, Material, law
from talus_testing import Sphere, read_dump, write_sphere_data

STEEL, POLYETHYLENE = Material(2.08e11, .30, 7850.0), Material(1e9, .40, 1400.0)
RADIUS_5, SPEED_5, FRICTION_5 = 1e-5, 5.0, 0.3

# test 5, of steel, then of polyethylene: v_t/(mu v_n) of the patch before, that after, r w'/(mu v_n)
DIGITISED_5 = {
    "steel": [
        (.332, -.280, -.430), (.671, -.493, -.820), (1.009, -.747, -1.250), (1.335, -1.000, -1.664), (1.662, -1.267, -2.094),
        (2.000, -1.533, -2.524), (2.350, -1.813, -2.978), (2.991, -2.440, -3.904), (3.341, -2.693, -4.293), (4.006, -2.787, -4.837),
        (4.997, -2.000, -5.007), (6.000, -1.013, -5.006), (9.988, 3.013, -5.004)],
    "polyethylene": [
        (.344, -.293, -.438), (.671, -.573, -.901), (.997, -.880, -1.331), (1.347, -1.120, -1.761), (1.674, -1.440, -2.216),
        (2.012, -1.760, -2.670), (2.326, -2.053, -3.116), (2.991, -2.680, -4.050), (3.341, -2.947, -4.456), (3.994, -2.933, -4.934),
        (4.997, -2.000, -4.966), (5.988, -1.000, -4.958), (10.00, 3.000, -4.963)]}
# the same by finite elements, which have slip in a part of the patch
FINITE_ELEMENTS_5 = [
    (.586, -.027), (.876, -.080), (1.190, -.213), (1.553, -.373), (1.915, -.627), (2.314, -.947), (2.785, -1.253), (3.317, -1.520),
    (3.970, -1.720), (4.755, -1.707), (5.758, -1.200), (7.124, .133), (9.118, 2.147)]

# test 8: (7/2) mu (1+e) v_n/v_t, negative tangential restitution of the patch; cases A and B are one curve up to x = 6
DIGITISED_8 = [
    (.187, -.815), (.358, -.626), (.551, -.439), (.765, -.238), (.979, -.017), (1.21, .096), (1.49, .111), (1.77, .090), (2.09, .058),
    (2.52, .006), (2.99, -.049), (3.63, -.103)]



def force_words(material):
    """Of test 5: the tangential force grows by increments, and is half as stiff as Mindlin's for a rigid plane."""
    shear = material.young / (2 * (1 + material.poisson) * (2 - material.poisson))
    return f"tangential mindlin/force {4 * shear} 0.0 {FRICTION_5}"


def integrated(ratio, poisson, steps=20000):
    """(recoil, spin) of an elastic impact as in test 5, by the equations of hertz/material with multistep: mass 1, z'' = -z^(3/2), and
    4 (1 - nu)/(2 - nu) sqrt(z)/(4/3) for the stiffness of the tangential spring, whose length follows the limit of friction."""
    z, v, patch, spring, impulse, h = 0.0, 1.0, ratio, 0.0, 0.0, 4.0 / steps
    while z >= 0.0:
        limit, stiffness = z**1.5, 3 * (1 - poisson) / (2 - poisson) * math.sqrt(z)
        spring += patch * h
        if stiffness * abs(spring) > limit:
            spring = math.copysign(limit / stiffness, spring) if stiffness else 0.0
        impulse += stiffness * spring * h
        patch -= 3.5 * stiffness * spring * h
        v -= limit * h
        z += v * h
    return patch, -2.5 * impulse


SCRIPT = begin("si") + """
{pairs}
neighbor {skin} bin
fix step all nve/sphere/symplectic
timestep {dt}
thermo {steps}
dump d all custom {steps} pairs.out id vx vz omegay fz
dump_modify d format float %.17g sort id
run {steps}
"""


@dataclasses.dataclass
class Ball:
    """One of a pair; up: its speed along z."""
    material: tuple
    radius: float
    up: float = 0.0
    spin: float = 0.0

    def mass(self):
        return self.material.density * 4 / 3 * math.pi * self.radius**3

    def compliance(self):
        return (1 - self.material.poisson**2) / self.material.young


@dataclasses.dataclass
class Pair:
    """Two spheres that meet along z, and the coefficients of the impact. After collide(): after = [(v_x, v_z, w_y)] of both."""
    upper: Ball
    lower: Ball
    restitution: float
    friction: float
    more: str = ""

    def speed(self):
        return self.lower.up - self.upper.up

    def mass(self):
        return 1 / (1 / self.upper.mass() + 1 / self.lower.mass())

    def time(self):
        """Of contact, by Hertz."""
        modulus = 1 / (self.upper.compliance() + self.lower.compliance())
        radius = 1 / (1 / self.upper.radius + 1 / self.lower.radius)
        depth = (15 * self.mass() * self.speed()**2 / (16 * modulus * math.sqrt(radius)))**0.4
        return 2.9432750 * depth / self.speed()

    def patch(self, spins):
        """Tangential speed of the upper patch against the lower one if the spheres do not move along x."""
        return -self.upper.radius * spins[0] - self.lower.radius * spins[1]

    def restitution_of_patch(self):
        """Tangential speed of the patch after the impact over the one before it, negative as the curves have it."""
        (v1, _, w1), (v2, _, w2) = self.after
        return -(v1 - v2 + self.patch((w1, w2))) / self.patch((self.upper.spin, self.lower.spin))

    def spins_after_sliding(self):
        """Of both, where the patch slides to the end: the tangential impulse is mu times the normal one, m (1 + e) v_n."""
        impulse = self.friction * self.mass() * (1 + self.restitution) * self.speed()
        sign = math.copysign(1.0, self.patch((self.upper.spin, self.lower.spin)))
        return [ball.spin + sign * 2.5 * impulse / (ball.mass() * ball.radius) for ball in (self.upper, self.lower)]

    def words(self):
        return [law(ball.material, self.restitution, self.friction, self.more) for ball in (self.upper, self.lower)]


def collide(pairs, run, path):
    """Runs all pairs by run(script) in the folder of path(name)."""
    dt = min(pair.time() for pair in pairs) / STEPS_PER_CONTACT
    steps = int(2.0 * max(pair.time() for pair in pairs) / dt) + 10
    radius = max(ball.radius for pair in pairs for ball in (pair.upper, pair.lower))
    words = sorted({word for pair in pairs for word in pair.words()})
    spheres = []
    for n, pair in enumerate(pairs):
        gap = 2.5 * pair.speed() * dt
        for ball, word, place in zip((pair.upper, pair.lower), pair.words(), (pair.upper.radius + gap, -pair.lower.radius)):
            spheres.append(Sphere(((n + 0.5) * 4 * radius, 0, place), (0, 0, ball.up), (0, ball.spin, 0), 2 * ball.radius,
                                  ball.material.density, words.index(word) + 1))
    write_sphere_data(path("data"), ((0, 4 * radius * len(pairs)), (-4 * radius, 4 * radius), (-4 * radius, 4 * radius)), spheres,
                      types=len(words))
    run(SCRIPT.format(pairs="\n".join(f"pair_coeff {t} {t} {word}" for t, word in enumerate(words, 1)),
                      skin=0.2 * min(sphere.diameter for sphere in spheres), dt=repr(dt), steps=steps))
    last = read_dump(path("pairs.out"))[-1]
    for n, pair in enumerate(pairs):
        if last.column("fz")[2 * n + 1] != 0.0:
            raise AssertionError(f"pair {n + 1} is still in contact")
        pair.after = [tuple(last.column(key)[2 * n + k] for key in ("vx", "vz", "omegay")) for k in (1, 2)]


def equal_pairs(spins, way, more=""):
    """Test 7: two spheres that spin; way: -1 opposite, as there, +1 both the same way."""
    return [Pair(Ball(AL_ALLOY_4, 0.1, -0.2, w), Ball(AL_ALLOY_4, 0.1, 0.2, way * w), 0.5, 0.4, more) for w in spins]


def unequal_pairs(ratios, stiff, more=""):
    """Test 8: a sphere that spins and falls with .2 m/s, tangential speed over normal one as given, on one of five times its size and
    1000 times its density; stiff: how many times stiffer (case A: 1000, B: 1)."""
    large = AL_ALLOY_4._replace(young=stiff * AL_ALLOY_4.young, density=1000 * AL_ALLOY_4.density)
    return [Pair(Ball(AL_ALLOY_4, 0.1, -0.2, ratio * 0.2 / 0.1), Ball(large, 0.5), 0.5, 0.4, more) for ratio in ratios]
