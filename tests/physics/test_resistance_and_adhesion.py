# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Rolling and spinning resistance and adhesion of gran/penalty and fix large/body against closed forms.

Cases of one test share a run, far from each other: every case has an atom type of its own."""

import math
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, read_local, write_sphere_data

R, RHO, G = 0.5, 2000.0, 9.81
MASS = RHO * 4 / 3 * math.pi * R**3
KN = 1e7                    # overlap at rest about 1e-3 r
GN = 100.0                  # 1/s
DT = 1e-4
HOOKE = f"hooke {KN} {GN}"

SCRIPT = begin("si") + """
{pairs}
{more}
neighbor 0.1 bin
timestep {dt}
thermo {steps}
dump d all custom {every} out id x y z vx vy vz omegax omegay omegaz fx fy fz
dump_modify d format float %.17g sort id
run {steps}
"""
GRAVITY = f"fix step all nve/sphere/symplectic gravity {G} vector 0 0 -1"


def mass(radius, density=RHO):
    return density * 4 / 3 * math.pi * radius**3


def place(n):
    """Center of case n, far from all others."""
    return 4.0 * (n % 8), 4.0 * (n // 8), 0.0


class Scene(SceneCase):

    def simulate(self, laws, spheres, more, steps, dt=DT, every=None):
        """One type for each law (words of pair_coeff t t); returns the frames."""
        write_sphere_data(self.path("data"), ((-5, 40), (-5, 40), (-6, 6)), spheres, types=len(laws))
        pairs = "\n".join(f"pair_coeff {t} {t} {w}" for t, w in enumerate(laws, 1))
        pairs += "".join(f"\npair_coeff {a} {b} hooke 1.0 0.0" for a in range(1, len(laws) + 1)
                         for b in range(a + 1, len(laws) + 1))
        self.run_lammps(SCRIPT.format(pairs=pairs, more=more, dt=repr(dt), steps=steps,
                                      every=every or steps))
        return read_dump(self.path("out"))


def floor(laws):
    """A plane z = 0 with the law of each type as it is."""
    return (GRAVITY + "\nfix floor all large/body plane 0 0 0 0 0 1 "
            + " ".join(f"contact types {t} {w}" for t, w in enumerate(laws, 1)))


def resting(n, laws_overlap, omega, v=(0, 0, 0)):
    x, y, _ = place(n)
    return Sphere((x, y, R - laws_overlap), v, omega, diameter=2 * R, density=RHO, type=n + 1)


REST = MASS * G / KN    # overlap of a sphere at rest, hooke


class OnPlane(Scene):

    def decay(self, cases, steps=14000, every=50):
        """cases: [(law words, overlap, omega, v)]; frames of spheres at rest on a plane."""
        laws = [case[0] for case in cases]
        spheres = [resting(n, *case[1:]) for n, case in enumerate(cases)]
        return self.simulate(laws, spheres, floor(laws), steps, every=every)

    def assert_line(self, what, frames, tag, column, start, rate, until, unit=None, after=0.0):
        """A column falls linearly from `start`, and stays at zero from step * DT = until on.
        Frames before `after` do not count."""
        unit = unit or abs(start)
        worst = 0.0
        compared = [frame for frame in frames if frame.step * DT >= after]
        self.assertGreater(len(compared), 10, what)
        for frame in compared:
            time = frame.step * DT
            expected = start - math.copysign(rate, start) * time if time < until else 0.0
            worst = max(worst, abs(frame.column(column)[tag] - expected) / unit)
        print(f"{what:44} rate {rate:10.5f}  stops at {until:7.4f} s  worst difference {worst:.1e}")
        self.assertLess(worst, 1e-3, what)

    def test_rolling(self):
        """On a frictionless plane: I w' = -mu_r r m g, so w = w0 - (5/2) mu_r g t/r.  Rolling without slip
        with friction F: m r w' = F, I w' = -F r - mu_r r m g, so w = w0 - (5/7) mu_r g t/r and v = r w."""
        print()
        stick = "tangential multistep NULL NULL 0.8"
        cases = [
            ("slipping", HOOKE + " rolling 0.02", 2.5 * 0.02, (0, 0.9, 0), (0, 0, 0)),
            ("slipping, oblique axis", HOOKE + " rolling 0.02", 2.5 * 0.02, (0.36, 0.48, 0), (0, 0, 0)),
            ("slipping, after friction that is zero", HOOKE + " tangential dashpot 1.0 0.0 rolling 0.01",
             2.5 * 0.01, (0, -0.5, 0), (0, 0, 0)),
            ("rolling, multistep", HOOKE + f" {stick} rolling 0.02", 5 / 7 * 0.02, (0, 0.3, 0),
             (0.3 * R, 0, 0)),
            ("rolling, dashpot", HOOKE + " tangential dashpot 1e3 0.8 rolling 0.02", 5 / 7 * 0.02,
             (0, 0.3, 0), (0.3 * R, 0, 0)),
            ("rolling, spinning resistance beside it", HOOKE + f" {stick} rolling 0.02 spinning 0.1",
             5 / 7 * 0.02, (0, 0.3, 0), (0.3 * R, 0, 0)),
        ]
        frames = self.decay([(law, REST, w, v) for _, law, _, w, v in cases])
        for tag, (what, _, factor, omega, v) in enumerate(cases, 1):
            speed = math.hypot(*omega)
            rate = factor * G / R
            settled = 0.2 if v[0] else 0.0    # the tangential spring swings in
            for column, start in zip(("omegax", "omegay"), omega):
                if start:
                    self.assert_line(what, frames, tag, column, start, rate * abs(start) / speed,
                                     speed / rate, unit=speed, after=settled)
            if v[0]:
                rolls = [f for f in frames if f.step * DT < speed / rate]    # then it rocks on its spring
                self.assert_line("   its velocity", rolls, tag, "vx", v[0], rate * R, speed / rate,
                                 after=settled)
                self.assertLess(abs(frames[-1].column("vx")[tag]), 0.02 * v[0])
                for frame in frames:    # angular momentum about the contact, whatever friction does
                    time = frame.step * DT
                    mean = (2 / 5 * R * frame.column("omegay")[tag] + frame.column("vx")[tag]) / (7 / 5 * R)
                    if time < speed / rate - 0.01:
                        self.assertAlmostEqual(mean, speed - rate * time, delta=1e-9)

    def test_slope_with_order_2(self):
        """Below arctan(mu_r) a sphere rests, above it rolls with 5/7 g (sin a - mu_r cos a)."""
        angle = math.atan(0.3)
        with_impact = "hooke/material 1e9 0.5 0.3 1.0"    # remembers the speed of the impact as well
        laws = [f"{normal} tangential multistep NULL NULL 0.5 slider midpoint rolling {mu_r} spinning 0.1 limit_damping"
                for normal in (HOOKE, with_impact) for mu_r in (0.4, 0.1)]
        gravity = ("fix step all nve/sphere/symplectic order 2 "
                   f"gravity {G} vector {math.sin(angle)} 0 {-math.cos(angle)}")
        frames = {frame.step: frame for frame in self.simulate(
            laws, [resting(n, REST, (0, 0, 0)) for n in range(4)], floor(laws).replace(GRAVITY, gravity), 20000, every=10000)}
        x, v, w = (lambda step, tag, column=column: frames[step].column(column)[tag] for column in ("x", "vx", "omegay"))
        rolls = 5 / 7 * G * (math.sin(angle) - 0.1 * math.cos(angle))
        for held, rolling in (1, 2), (3, 4):
            self.assertLess(abs(x(20000, held) - x(10000, held)), 1e-12)
            self.assertLess(max(abs(v(20000, held)), abs(w(20000, held))), 1e-12)
            self.assertAlmostEqual((v(20000, rolling) - v(10000, rolling)) / (10000 * DT), rolls, delta=1e-6 * rolls)
            self.assertAlmostEqual(R * w(20000, rolling), v(20000, rolling), delta=1e-4 * v(20000, rolling))

    def test_stop_within_the_threshold(self):
        """What remains after a stop is less than the threshold of speed and one kick."""
        frames = self.decay([(HOOKE + f" rolling 0.02 vmin 1e-4 {roll} 1e-4", REST, (0, 0.1, 0), (0, 0, 0))
                             for roll in (1e-2, 1e-3, 1e-4, 0.0)])
        kick = 2.5 * 0.02 * G * DT
        print()
        for tag, roll in enumerate((1e-2, 1e-3, 1e-4, 0.0), 1):
            left = [abs(f.column("omegay")[tag]) * R for f in frames if f.step * DT > 0.2]
            print(f"threshold {roll:7}: speed left after the stop {min(left):.2e} to {max(left):.2e}, "
                  f"one kick {kick:.2e}")
            self.assertLessEqual(max(left), max(roll, kick) * 1.001)

    def test_spinning(self):
        """I w' = -mu_s r_c m g with the circle of the cut, r_c^2 = 2 r d - d^2.  With another spin beside
        it only the part w_n/|w| counts: w_n' = -(rate) w_n/sqrt(w_n^2 + w_t^2)."""
        print()
        circle = math.sqrt(2 * R * REST - REST**2)
        rate = 2.5 * 0.3 * circle * G / R**2
        words = HOOKE + " spinning 0.3"
        frames = self.decay([(words, REST, (0, 0, 0.9), (0, 0, 0)),
                             (words, REST, (0, 0, -0.5), (0, 0, 0)),
                             (words, REST, (0.1, 0, 0.1), (0, 0, 0))])
        self.assert_line("spinning", frames, 1, "omegaz", 0.9, rate, 0.9 / rate)
        self.assert_line("spinning, other sense", frames, 2, "omegaz", -0.5, rate, 0.5 / rate)

        normal, worst, h = 0.1, 0.0, 1e-5
        for before, frame in zip(frames, frames[1:]):
            for _ in range(round((frame.step - before.step) * DT / h)):
                middle = normal - h / 2 * rate * normal / math.hypot(normal, 0.1)
                normal -= h * rate * middle / math.hypot(middle, 0.1)
            worst = max(worst, abs(frame.column("omegaz")[3] - normal) / 0.1)
            self.assertEqual(frame.column("omegax")[3], 0.1)
        print(f"spinning beside a tangential spin: worst difference {worst:.1e}, at the end {normal:.4f}")
        self.assertLess(worst, 1e-3)

    def test_thresholds(self):
        """Just below its threshold each resistance is off, just above it is on.  Only `delayed` resistance has a
        threshold by default (here of over-damped contacts, which do not wait)."""
        words, over_damped = HOOKE + " rolling 0.02 spinning 0.3 vmin 1e-4 {0} {1}", f"hooke {KN} 250.0"
        cases = [(words.format(1e-3, 9.0), (0, 0.999e-3 / R, 0), False),
                 (words.format(1e-3, 9.0), (0, 1.001e-3 / R, 0), True),
                 (words.format(9.0, 0.02), (0, 0, 0.01999), False),
                 (words.format(9.0, 0.02), (0, 0, 0.02001), True),
                 (HOOKE + " rolling 0.02", (0, 1e-9 / R, 0), True),
                 (HOOKE + " spinning 0.3", (0, 0, 1e-9), True),
                 (over_damped + " rolling 0.02 delayed", (0, 0.999e-4 / R, 0), False),
                 (over_damped + " rolling 0.02 delayed", (0, 1.001e-4 / R, 0), True),
                 (over_damped + " spinning 0.3 delayed", (0, 0, 0.999e-4), False),
                 (over_damped + " spinning 0.3 delayed", (0, 0, 1.001e-4), True)]
        first, last = self.decay([(law, REST, w, (0, 0, 0)) for law, w, _ in cases], steps=2, every=2)
        for tag, (law, _, acts) in enumerate(cases, 1):
            changed = any(first.column(c)[tag] != last.column(c)[tag] for c in ("omegay", "omegaz"))
            self.assertEqual(changed, acts, law)

    def test_slip_threshold_of_plaincoulomb(self):
        """mu F_n tanh(5 v) from the threshold on, nothing below."""
        kn = MASS * G / math.sqrt(1e-3)**3    # overlap 1e-3
        law = f"plaincoulomb {kn!r} 0.0 0.5 vmin 0.01 1e-4 1e-4"
        first, = self.decay([(law, 1e-3, (0, 0, 0), (0.00999, 0, 0)),
                             (law, 1e-3, (0, 0, 0), (0.01001, 0, 0))], steps=0)
        self.assertEqual(first.column("fx")[1], 0.0)
        self.assert_close(first.column("fx")[2], -0.5 * MASS * G * math.tanh(0.05005), 1e-9)

    def test_delayed(self):
        """Nothing before the contact is older than pi sqrt(m/(k (1-z^2))), z the damping ratio; from then on
        as without delay.  An over-damped contact resists at once, and so does one without memory never
        unless it is over-damped."""
        free = "tangential multistep NULL 0.0 0.0"
        hertz = 1e8
        rest = (MASS * G / hertz / math.sqrt(R))**(2 / 3)
        def duration(k, g):
            ratio = g / (2 * MASS * math.sqrt(k / MASS))
            return math.pi * math.sqrt(MASS / (k * (1 - ratio**2))) if ratio < 1 else 0.0
        weak = 1e4 * MASS
        cases = [    # words, overlap, seconds before resistance acts
            (f"hooke {weak} {GN} {free} rolling 0.02 delayed", G / 1e4, duration(weak, MASS * GN)),
            (f"hooke {weak} 0.0 {free} rolling 0.02 delayed", G / 1e4, duration(weak, 0.0)),
            (f"hooke {weak} 150.0 {free} rolling 0.02 delayed", G / 1e4, duration(weak, MASS * 150.0)),
            (f"hooke {weak} 201.0 {free} rolling 0.02 delayed", G / 1e4, 0.0),
            (f"hooke {weak} 0.0 {free} rolling 0.02", G / 1e4, 0.0),
            (f"hertz {hertz} 50.0 {free} rolling 0.02 delayed", rest,
             duration(hertz * math.sqrt(R), math.sqrt(rest * R) * MASS * 50.0 / rest**0.25)),
            (f"hooke {weak} 0.0 tangential dashpot 0.0 0.0 rolling 0.02 delayed", G / 1e4, math.inf),
            (f"hooke {weak} 201.0 tangential onestep 1.0 0.0 0.0 rolling 0.02 delayed", G / 1e4, 0.0),
        ]
        rate = 2.5 * 0.02 * G / R
        frames = self.decay([(law, overlap, (0, 0.2, 0), (0, 0, 0)) for law, overlap, _ in cases],
                            steps=1000, every=1)
        print()
        for tag, (law, _, delay) in enumerate(cases, 1):
            w = [frame.column("omegay")[tag] for frame in frames]
            began = next((n - 1 for n, value in enumerate(w) if value != 0.2), math.inf) * DT
            print(f"{law:70} acts after {began:.4f} s, rule {delay:.6f} s")
            if delay == 0.0:
                self.assertEqual(began, 0.0)
            elif delay == math.inf:
                self.assertEqual(began, math.inf)
            else:
                # the force of the set-up does not age the contact
                self.assertGreater(began + 1e-12, delay)
                self.assertLess(began, delay + 2.5 * DT)
            if began < math.inf:
                self.assert_close(0.2 - w[-1], rate * (1000 * DT - began), 1e-6)

    def test_delayed_spinning(self):
        """The same gate for both resistances."""
        weak = 1e4 * MASS
        law = f"hooke {weak} 0.0 tangential multistep NULL 0.0 0.0 rolling 0.02 delayed spinning 0.3 delayed"
        frames = self.decay([(law, G / 1e4, (0, 0.2, 0), (0, 0, 0)), (law, G / 1e4, (0, 0, 0.2), (0, 0, 0))],
                            steps=500, every=1)
        began = [next(f.step for f in frames if f.column(c)[tag] != 0.2)
                 for tag, c in ((1, "omegay"), (2, "omegaz"))]
        self.assertEqual(began[0], began[1])


class Pairs(Scene):
    """Two spheres pressed against each other, with no tangential force, or one hung on the other."""

    FORCE = 2000.0

    def test_resistance(self):
        """Rolling: I_i w_i' = -r_i mu_r F, until r_1 w_1 + r_2 w_2 = 0.  Spinning: I_i w_i' = -+ mu_s r_c F,
        until the spins are equal."""
        r1, r2, mu_r, mu_s = 0.5, 0.3, 0.02, 0.3
        m1, m2 = mass(r1), mass(r2)
        i1, i2 = 0.4 * m1 * r1**2, 0.4 * m2 * r2**2
        overlap = self.FORCE / KN
        d = r1 + r2 - overlap
        x = (d * d + r1 * r1 - r2 * r2) / (2 * d)
        circle = math.sqrt(r1 * r1 - x * x)
        spheres = []
        for n, omega in enumerate(((0, 0, 0.5), (0, 0.3, 0), (0.5, 0, 0))):
            cx, cy, cz = place(n)
            spheres.append(Sphere((cx, cy, cz), (0, 0, 0), omega, 2 * r1, RHO, 1))
            spheres.append(Sphere((cx + d, cy, cz), (0, 0, 0), (0, 0, 0), 2 * r2, RHO, 1))
        law = HOOKE + f" rolling {mu_r} spinning {mu_s}"
        more = ("fix step all nve/sphere/symplectic\ngroup left id 1 3 5\ngroup right id 2 4 6\n"
                f"fix l left addforce {self.FORCE} 0 0\nfix r right addforce {-self.FORCE} 0 0")
        frames = self.simulate([law], spheres, more, 3000, every=30)

        def expected(time, start, a1, a2, speed_of):
            """Constant torques a1, a2 (angular accelerations) until speed_of(w1, w2) vanishes."""
            until = speed_of(start, 0.0) / -speed_of(-a1, -a2)
            t = min(time, until)
            return start - a1 * t, -a2 * t

        print()
        for pair, column, start in ((0, "omegaz", 0.5), (1, "omegay", 0.3), (2, "omegax", 0.5)):
            spin = pair == 2
            a1 = (mu_s * circle if spin else r1 * mu_r) * self.FORCE / i1
            a2 = (-mu_s * circle if spin else r2 * mu_r) * self.FORCE / i2
            worst = 0.0
            for frame in frames:
                w = expected(frame.step * DT, start, a1, a2,
                             (lambda p, q: p - q) if spin else (lambda p, q: r1 * p + r2 * q))
                found = frame.column(column)[2 * pair + 1], frame.column(column)[2 * pair + 2]
                worst = max(worst, *(abs(f - e) / start for f, e in zip(found, w)))
            print(f"pair, {'spinning' if spin else 'rolling'} {column}: at the end "
                  f"{found[0]:.5f} {found[1]:.5f}, closed form {w[0]:.5f} {w[1]:.5f}, worst {worst:.1e}")
            self.assertLess(worst, 1e-3)


# adhesive laws: words, force for radii r and r
F_A = 500.0
R_EFF = R / 2
ADHESIONS = {
    "constant": (f"adhesion constant {F_A}", F_A),
    "dmt": (f"adhesion dmt {F_A}", F_A * math.sqrt(R_EFF)),
    "perko": (f"adhesion perko {F_A}", F_A * R_EFF),
}
E_STAR = 1e8 / (1 - 0.09) / 2
NORMALS = {    # words, overlap under a force F of two equal spheres
    "hooke": (HOOKE, lambda f: f / KN),
    "hertz": ("hertz 1e8 100.0", lambda f: (f / (1e8 * math.sqrt(R_EFF)))**(2 / 3)),
    "hertz/material": ("hertz/material 1e8 0.2 0.3",
                       lambda f: (f / (4 / 3 * E_STAR * math.sqrt(R_EFF)))**(2 / 3)),
    "flores": ("flores 1e8 1e6", lambda f: (f / (1e8 * math.sqrt(R_EFF)))**(2 / 3)),
}


class Adhesion(Scene):

    def cases(self):
        return [(f"{normal} {adhesion}", f"{words} {more}", depth(force), force)
                for normal, (words, depth) in NORMALS.items()
                for adhesion, (more, force) in ADHESIONS.items()]

    def pairs(self, overlaps):
        spheres = []
        for n, overlap in enumerate(overlaps):
            x, y, z = place(n)
            spheres.append(Sphere((x, y, z), (0, 0, 0), (0, 0, 0), 2 * R, RHO, n + 1))
            spheres.append(Sphere((x + 2 * R - overlap, y, z), (0, 0, 0), (0, 0, 0), 2 * R, RHO, n + 1))
        return spheres

    def test_equilibrium_overlap(self):
        """Two spheres that hold each other: the elastic force balances the adhesive one."""
        cases = self.cases()
        frames = self.simulate([law for _, law, _, _ in cases],
                               self.pairs([1.1 * overlap for *_, overlap, _ in cases]),
                               "fix step all nve/sphere/symplectic\nfix drag all viscous 3000", 30000)
        x = frames[-1].column("x")
        print()
        for n, (name, _, overlap, _) in enumerate(cases):
            found = 2 * R - (x[2 * n + 2] - x[2 * n + 1])
            print(f"{name:26} overlap {found:.6e}, law {overlap:.6e}")
            self.assert_close(found, overlap, 1e-3, name)

    def test_pull_off(self):
        """Separation at constant speed: the largest tension is the adhesive force, where the overlap
        vanishes, and nothing remains behind it."""
        cases = self.cases()
        damped = [law.replace(HOOKE, f"hooke {KN} 0.0").replace("1e8 100.0", "1e8 0.0")
                  .replace("1e8 0.2 0.3", "1e8 1.0 0.3").replace("1e8 1e6", "1e8 0.0")
                  for _, law, _, _ in cases]
        steps = 4000
        speeds = [1.02 * overlap / (steps * DT) for *_, overlap, _ in cases]
        ids = " ".join(str(2 * n + 2) for n in range(len(cases)))
        more = (f"group right id {ids}\ngroup left subtract all right\nfix l left move linear 0 0 0\n"
                + "".join(f"group r{n} id {2 * n + 2}\nfix r{n} r{n} move linear {v!r} 0 0\n"
                          for n, v in enumerate(speeds)))
        frames = self.simulate(damped, self.pairs([o for *_, o, _ in cases]), more, steps, every=1)
        print()
        for n, (name, _, overlap, force) in enumerate(cases):
            fx = [f.column("fx")[2 * n + 1] for f in frames]
            peak = max(fx)
            gap = frames[fx.index(peak)].column("x")[2 * n + 2] - place(n)[0] - 2 * R
            print(f"{name:26} pull-off force {peak:10.5f}, law {force:10.5f}, overlap there {-gap:.1e}")
            self.assert_close(peak, force, 1e-3, name)
            self.assertLess(peak, force * (1 + 1e-9))
            self.assertLess(-gap, 1e-3 * overlap)
            self.assertEqual(fx[-1], 0.0)
            self.assertLess(abs(fx[0]), 1e-6 * force)

    def test_hanging_sphere(self):
        """Under a ceiling a sphere of 0.999 times the weight of the adhesive force stays, one of 1.001 falls.
        R_eff of a sphere on a body is r."""
        laws, spheres = [], []
        for words, force in (("constant", F_A), ("dmt", F_A * math.sqrt(R)), ("perko", F_A * R)):
            for factor in 0.999, 1.001:
                density = factor * force / G / (4 / 3 * math.pi * R**3)
                x, y, _ = place(len(laws))
                overlap = max(1 - factor, 0.0) * force / KN
                spheres.append(Sphere((x, y, -R + max(overlap, 1e-9)), (0, 0, 0), (0, 0, 0), 2 * R, density,
                                      len(laws) + 1))
                laws.append(f"hooke {KN} {GN} adhesion {words} {F_A}")
        more = floor(laws).replace("plane 0 0 0 0 0 1", "plane 0 0 0 0 0 -1")
        last = self.simulate(laws, spheres, more, 5000)[-1]
        for n in range(len(laws)):
            z = last.column("z")[n + 1]
            if n % 2 == 0:
                self.assertGreater(z, -R, laws[n])
            else:
                self.assertLess(z, -R - 1e-4, laws[n])

    def test_pair_local(self):
        """Pair::single(): force along the line of centers with adhesion, as in f."""
        spheres = [Sphere((s * (R - 1e-4), 0, 0), (-0.1 * s, 0, 0), diameter=2 * R, density=RHO) for s in (-1, 1)]
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, spheres)
        for words in f"constant {F_A}", f"dmt {F_A}", f"perko {F_A}":
            self.run_lammps(SCRIPT.format(
                pairs=f"pair_coeff * * {HOOKE} adhesion {words}", more="compute c all pair/local dist fx force\n"
                "dump c all local 1 local index c_c[*]\ndump_modify c format float %.17g", dt=DT, steps=0, every=1))
            (_, distance, fx, force), = read_local(self.path("local"))[0].rows
            frame, = read_dump(self.path("out"))
            push = KN * (2 * R - distance) + MASS / 2 * GN * 0.2
            pull = F_A * {"constant": 1, "dmt": math.sqrt(R_EFF), "perko": R_EFF}[words.split()[0]]
            self.assert_close(abs(fx), abs(push - pull), 1e-12, words)
            self.assert_close(abs(fx), abs(frame.column("fx")[1]), 1e-12, words)
            self.assert_close(abs(force), abs(fx), 1e-12, words)

    def test_sticking_speed(self):
        """hooke with adhesion F: m x'' = -kn x - m gn x' + F from x = 0 on.  Slower than a critical speed the
        pair never opens; just above it does."""
        reduced, force = MASS / 2, F_A
        b, rest = GN / 2, force / KN
        frequency = math.sqrt(KN / reduced - b * b)

        def lowest(speed):
            """Smallest overlap after the first maximum."""
            # x = rest + exp(-b t) (A cos + B sin); x(0) = 0, x'(0) = speed
            A, B = -rest, (speed - b * rest) / frequency
            def x(t):
                return rest + math.exp(-b * t) * (A * math.cos(frequency * t) + B * math.sin(frequency * t))
            period = 2 * math.pi / frequency
            return min(x(period * (0.3 + 0.9 * n / 20000)) for n in range(20001))

        low, high = 0.0, 1.0
        for _ in range(40):
            middle = (low + high) / 2
            low, high = (middle, high) if lowest(middle) > 0 else (low, middle)
        factors = (0.9, 0.99, 0.998, 1.002, 1.01, 1.1)
        spheres = []
        for n, factor in enumerate(factors):
            x, y, z = place(n)
            spheres.append(Sphere((x, y, z), (factor * low / 2, 0, 0), (0, 0, 0), 2 * R, RHO, 1))
            spheres.append(Sphere((x + 2 * R + 1e-9, y, z), (-factor * low / 2, 0, 0), (0, 0, 0), 2 * R, RHO, 1))
        dt = 1e-6
        steps = int(1.5 * 2 * math.pi / frequency / dt)
        last = self.simulate([f"{HOOKE} adhesion constant {F_A}"], spheres, "fix step all nve/sphere/symplectic",
                             steps, dt=dt)[-1].column("x")
        open_ = [last[2 * n + 2] - last[2 * n + 1] > 2 * R for n in range(len(factors))]
        print(f"\nsticking speed {low:.6f} m/s; open at {factors}: {open_}")
        self.assertEqual(open_, [factor > 1 for factor in factors])


if __name__ == "__main__":
    unittest.main()
