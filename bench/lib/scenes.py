# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Small scenes for the study of errors: spheres of diameter 1 m and 1000 kg/m^3, impact velocity 1 m/s.

A Scene is data; methods.py turns it into input scripts for every code."""

import dataclasses
import math
import random

R, DENSITY = 0.5, 1000.0
MASS = DENSITY * math.pi / 6
INERTIA = 0.4 * MASS * R * R
NU = 0.3
KT_OF_KN = 3 * (1 - NU) / (2 - NU)      # Mindlin: 8 G_eff over 4/3 E_eff, the same in all codes
SPEED = 1.0


@dataclasses.dataclass
class Law:
    """Coefficients of gran/hooke/history or gran/hertz/history; mu = 0: no tangential force. With hertz/material kn is Young's
    modulus and gn the restitution; Poisson's ratio is NU, kt and gt follow from them (gt > 0: has a dashpot)."""
    kind: str
    kn: float
    gn: float = 0.0
    kt: float = 0.0
    gt: float = 0.0
    mu: float = 0.0

    def contact_time(self, speed=SPEED):
        """Duration of an undamped impact of two spheres (s)."""
        if self.kind == "hooke":
            return math.pi * math.sqrt(MASS / 2 / self.kn)
        kn = self.kn if self.kind == "hertz" else 4 / 3 * self.kn / (2 * (1 - NU**2))
        depth = (1.25 * MASS / 2 * speed**2 / (kn * math.sqrt(R / 2)))**0.4
        return 2.943 * depth / speed


@dataclasses.dataclass
class Scene:
    """positions, velocities, spins: lists of triples. step: the coarsest time step; time and middle
    are multiples of it. floor: a plane at z = 0 with the same law."""
    name: str
    what: str
    law: Law
    positions: list
    velocities: list
    step: float
    time: float
    middle: float
    spins: list = None
    gravity: float = 0.0
    floor: bool = False
    box: tuple = ((-40.0, 40.0),) * 3
    periodic: str = "f f f"
    copy_axes: tuple = (1, 2)
    copy_distance: tuple = (2.0, 2.0)
    exact: object = None            # function: time -> (positions, velocities) if known
    levels: int = 9                 # time steps step, step/2, ... step/2^(levels-1)
    order: dict = dataclasses.field(default_factory=dict)      # what theory says, by kind of method

    def __post_init__(self):
        self.spins = self.spins or [(0.0, 0.0, 0.0)] * len(self.positions)

    def time_steps(self):
        return [self.step / 2**k for k in range(self.levels)]

    def length(self):
        """Scale of position errors: the way at impact velocity during a contact."""
        return SPEED * self.law.contact_time()


SECOND = {"plain": 1, "half": 2, "order 2": 2, "verlet": 2}
FIRST = {"plain": 1, "half": 1, "order 2": 2, "verlet": 1}

HOOKE = 7.0e5
HERTZ = 1.0e7


def _impact(name, what, law, tangential=0.0, spin=0.0, exact=None, order=None):
    """Two spheres, .01 apart, approach at speed 1."""
    return Scene(name, what, law, [(-0.505, 0, 0), (0.505, 0, 0)],
                 [(0.5, tangential / 2, 0), (-0.5, -tangential / 2, 0)], spins=[(0, 0, spin)] * 2,
                 step=1 / 64, time=8 / 64, middle=3 / 64, exact=exact, order=order or SECOND)


def exact_hooke(gn):
    """Solution of the head-on impact of _impact() with a linear law that does not attract."""
    omega = math.sqrt(2 * HOOKE / MASS)
    zeta = gn / (2 * omega)
    damped = omega * math.sqrt(1 - zeta * zeta)

    def state(time):
        t = time - 0.01
        end = (math.pi - 2 * math.atan(zeta * omega / damped)) / damped      # no force any more, overlap still
        if t <= 0:
            gap, rate = 0.01 - time, -1.0
        elif t <= end:
            decay = math.exp(-zeta * omega * t)
            gap = -decay * math.sin(damped * t) / damped
            rate = decay * (zeta * omega * math.sin(damped * t) / damped - math.cos(damped * t))
        else:
            decay = math.exp(-zeta * omega * end)
            rate = decay * (zeta * omega * math.sin(damped * end) / damped - math.cos(damped * end))
            gap = rate * (t - end) - decay * math.sin(damped * end) / damped
        half = 0.5 * (1 + gap)
        return [(-half, 0, 0), (half, 0, 0)], [(-0.5 * rate, 0, 0), (0.5 * rate, 0, 0)]
    return state


def slip_to_roll():
    kn = 100 * HOOKE
    law = Law("hooke", kn, 40.0, 2 / 7 * kn, 20.0, 0.3)
    return Scene("roll", "sphere put down on a floor at speed 1 slides, then rolls (linear, damped)", law,
                 [(0, 0, R - MASS * 10 / kn)], [(1.0, 0, 0)], step=0.004, time=0.24, middle=0.048, gravity=10.0,
                 floor=True, box=((-40.0, 40.0), (-40.0, 40.0), (-1.0, 4.0)), copy_axes=(0, 1),
                 copy_distance=(3.0, 2.0), levels=8, order=FIRST)


def stack():
    law = Law("hertz", HERTZ, 150.0)
    return Scene("stack", "two spheres on a floor come down on each other (Hertz, damped)", law,
                 [(0, 0, 0.505), (0, 0, 1.515)], [(0, 0, -0.5), (0, 0, -1.0)], step=1 / 64, time=16 / 64,
                 middle=6 / 64, gravity=10.0, floor=True, box=((-40.0, 40.0), (-40.0, 40.0), (-1.0, 6.0)),
                 copy_axes=(0, 1), order=FIRST)


def chain(length=20):
    return Scene("chain", f"row of {length} touching spheres hit at one end (Hertz, elastic)", Law("hertz", HERTZ),
                 [(k - length / 2, 0, 0) for k in range(length)], [(1.0, 0, 0)] + [(0, 0, 0)] * (length - 1),
                 step=1 / 64, time=24 / 64, middle=12 / 64, copy_axes=(1, 2), order=SECOND)


def cluster():
    """200 spheres on jittered sites that fly towards their center and spin."""
    draw = random.Random(11)
    sites = sorted(((i, j, k) for i in range(-4, 5) for j in range(-4, 5) for k in range(-4, 5)),
                   key=lambda s: (s[0]**2 + s[1]**2 + s[2]**2, s))[:200]
    places = [tuple(1.12 * c + draw.uniform(-0.05, 0.05) for c in s) for s in sites]
    return Scene("cluster", "200 spheres fly at each other (Hertz, damped, friction)",
                 Law("hertz", HERTZ, 150.0, KT_OF_KN * HERTZ, 75.0, 0.3), places,
                 [tuple(-0.4 * c for c in x) for x in places], spins=[tuple(draw.gauss(0, 1) for _ in "xyz") for _ in places],
                 step=1 / 128, time=32 / 128, middle=16 / 128, copy_axes=(1, 2), copy_distance=(12.0, 12.0), order=FIRST)


def impacts():
    friction = dict(kt=KT_OF_KN * HERTZ)
    return [
        _impact("hooke", "head-on, linear, elastic", Law("hooke", HOOKE), exact=exact_hooke(0.0)),
        _impact("hooke damped", "head-on, linear, damped", Law("hooke", HOOKE, 10.0), exact=exact_hooke(10.0),
                order=FIRST),
        _impact("hertz", "head-on, Hertz, elastic", Law("hertz", HERTZ)),
        _impact("hertz damped", "head-on, Hertz, damped", Law("hertz", HERTZ, 150.0), order=FIRST),
        _impact("stick", "oblique, Hertz, mu 10: sticks", Law("hertz", HERTZ, mu=10.0, **friction), 0.8, 1.0),
        _impact("slip", "oblique, Hertz, mu .1: slides", Law("hertz", HERTZ, mu=0.1, **friction), 0.8, 1.0),
        _impact("mixed", "oblique, Hertz, mu .3, damped: sticks and slides",
                Law("hertz", HERTZ, 150.0, gt=75.0, mu=0.3, **friction), 0.8, 1.0, order=FIRST),
    ]


def deterministic():
    return impacts() + [slip_to_roll(), stack(), chain(), cluster()]


# ---- statistical scenes: motion is chaotic, averages are not ------------------------------------

def gas(seed, count=500):
    """Granular gas: volume fraction .15, e = .8, linear contacts so stiff that they are binary."""
    draw = random.Random(seed)
    side = (count * math.pi / 6 / 0.15)**(1 / 3)
    n = math.ceil(count**(1 / 3))
    places = [tuple(side * (c + 0.5) / n for c in (k % n, k // n % n, k // n**2)) for k in range(count)]
    speeds = [[draw.gauss(0, 1) for _ in "xyz"] for _ in places]
    mean = [sum(v[d] for v in speeds) / count for d in range(3)]
    speeds = [tuple(v[d] - mean[d] for d in range(3)) for v in speeds]
    kn = 100 * HOOKE
    zeta = -math.log(0.8) / math.hypot(math.pi, math.log(0.8))
    law = Law("hooke", kn, 2 * zeta * math.sqrt(2 * kn / MASS))
    step = law.contact_time() / 4
    return Scene("gas", "500 spheres in a periodic box cool down (linear, e = .8)", law, places, speeds, step=step,
                 time=round(6 / step / 64) * 64 * step, middle=step, box=((0.0, side),) * 3, periodic="p p p", levels=6)


def haff(time, count=500, fraction=0.15, e=0.8, energy=3.0):
    """Kinetic energy over the initial one by Haff's law with Enskog's frequency of collisions; energy: <v^2>."""
    density = fraction * 6 / math.pi
    g = (1 - fraction / 2) / (1 - fraction)**3
    frequency = 4 * math.sqrt(math.pi) * density * g * math.sqrt(energy / 3)
    return 1 / (1 + time * (1 - e * e) / 6 * frequency)**2


def bed(seed, count=500):
    """A column, periodic in x and y, falls on a floor and comes to rest."""
    draw = random.Random(seed)
    places = []
    for k in range(count):
        site = (k % 6, k // 6 % 6, k // 36)
        places.append(tuple(1.02 * (c + 0.55) + draw.uniform(-0.009, 0.009) for c in site))
    kn = 1.0e9
    law = Law("hertz", kn, 1.0e4, 2 / 7 * kn, 5.0e3, 0.5)
    return Scene("bed", "500 spheres settle on a floor (Hertz, damped, friction)", law, places,
                 [tuple(draw.gauss(0, 1.0) for _ in "xyz") for _ in places], step=law.contact_time() / 4,
                 time=1600 * law.contact_time() / 4, middle=law.contact_time(), gravity=10.0, floor=True,
                 box=((0.0, 6.12), (0.0, 6.12), (-1.0, 30.0)), periodic="p p f", levels=6)
