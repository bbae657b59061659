# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""A body on a slope: fix large/body plane z = 0 with gravity tilted by an angle a.

    multistep    below tan a = mu it comes to rest where the spring carries it, d = m g sin a/kt, and stays
    dashpot      creeps at v = m g sin a/gt
    onestep      creeps at v = m g sin a/(kt dt + gt)
    plaincoulomb creeps at v = artanh(tan a/mu)/5
    all          above tan a = mu it slides with the acceleration g (sin a - mu cos a)

Spheres that cannot roll are moved by the host's fix nve, which leaves spins alone; a clump of three
spheres (fix rigid/small) cannot roll by itself.  A sphere that rolls against rolling resistance rests
as well, unless its resistance has a threshold of speed."""

import math
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, write_sphere_data

R, RHO, G, MU = 0.5, 2000.0, 9.81, 0.5
MASS = RHO * 4 / 3 * math.pi * R**3
KN, KT, GN, GT = 1e7, 4e6, 100.0, 200.0    # GT: overdamped, so that friction does not overshoot
DT = 2e-4
STEPS = 100000

SCRIPT = begin("si") + """
{pairs}
fix floor all large/body plane 0 0 0 0 0 1 {contacts}
neighbor 0.1 bin
{move}
timestep {dt}
thermo {every}
dump d all custom {every} out id x y z vx vy vz omegay
dump_modify d format float %.17g sort id
run {steps}
"""


def gravity(tangent):
    """Words of fix gravity for a slope that falls towards +x."""
    return f"gravity {G} vector {tangent!r} 0 -1"


class Slope(SceneCase):

    def simulate(self, laws, tangent, steps, every=None, move="nve", spheres=None):
        """laws: words for each type; one sphere of each by default, in contact under its own weight."""
        cos = 1 / math.hypot(1, tangent)
        if not spheres:
            spheres = [Sphere((0, 3 * n, R - overlap), diameter=2 * R, density=RHO, type=n + 1)
                       for n, (_, overlap) in enumerate((law, rest(law, cos)) for law in laws)]
        write_sphere_data(self.path("data"), ((-10, 2000), (-9, 3 * len(spheres) + 9), (-3, 3)), spheres,
                          types=len(laws))
        moves = {"nve": f"fix step all nve\nfix g all {gravity(tangent)}",
                 "symplectic": f"fix step all nve/sphere/symplectic {gravity(tangent)}"}
        pairs = "\n".join(f"pair_coeff {i} {j} hooke {KN} {GN}" for i in range(1, len(laws) + 1)
                          for j in range(i, len(laws) + 1))
        if any("material" in law for law in laws):
            own = [law if "material" in law else f"hertz/material 1e8 0.5 0.3 tangential multistep NULL NULL {MU}"
                   for law in laws]
            pairs += "".join(f"\npair_coeff {t} {t} {w}" for t, w in enumerate(own, 1))
        contacts = " ".join(f"contact types {t} {w}" for t, w in enumerate(laws, 1))
        self.run_lammps(SCRIPT.format(pairs=pairs, contacts=contacts, move=moves[move], dt=repr(DT),
                                      steps=steps, every=every or steps), timeout=1500)
        return read_dump(self.path("out"))


def rest(law, cos):
    """Overlap at which a law carries the weight of a sphere."""
    words = law.split()
    force, name = MASS * G * cos, words[0]
    if name == "hooke":
        return force / KN
    if name == "plaincoulomb":
        return (force / float(words[1]))**(2 / 3)
    modulus = 0.75 * float(words[1])
    if name == "hertz/material":
        # both bodies of one material: E* = E/2/(1-nu^2)
        modulus = float(words[1]) / 2 / (1 - float(words[3])**2)
    return (force / (4 / 3 * modulus * math.sqrt(R)))**(2 / 3)


MULTISTEP = {
    "hooke": f"hooke {KN} {GN} tangential multistep {KT} {GT} {MU}",
    "hooke, defaults": f"hooke {KN} {GN} tangential multistep NULL NULL {MU}",
    "hertz": f"hertz 1e8 2000.0 tangential multistep NULL NULL {MU}",
    "flores": f"flores 1e8 2e6 tangential multistep NULL 2000.0 {MU}",
    "hertz/material": f"hertz/material 1e8 0.5 0.3 tangential multistep NULL NULL {MU}",
    "flores/material": f"flores/material 1e8 0.5 0.3 1.0 tangential multistep NULL NULL {MU}",
    "hooke/material": f"hooke/material 1e8 0.5 0.3 1.0 tangential multistep NULL NULL {MU}",
}


class Rests(Slope):

    STEPS = STEPS

    def creep(self, frames, tag, after):
        """Largest distance from the last position, from a fraction of the run on."""
        late = [f for f in frames if f.step >= after * self.STEPS]
        last = late[-1]
        return max(math.dist([f.column(c)[tag] for c in "xyz"], [last.column(c)[tag] for c in "xyz"])
                   for f in late)

    def test_multistep_holds_a_sphere_that_cannot_roll(self):
        print(f"\ncreep over radius from a fifth of {self.STEPS} steps on; way down the slope")
        for tangent in (0.1, 0.3, 0.45, 0.49):
            frames = self.simulate(list(MULTISTEP.values()), tangent, self.STEPS, self.STEPS // 20)
            for tag, name in enumerate(MULTISTEP, 1):
                creep, way = self.creep(frames, tag, 0.2), frames[-1].column("x")[tag]
                print(f"tan a {tangent:5} {name:18}{creep / R:10.1e}{way / R:12.3e}")
                self.assertLess(creep, 1e-6 * R, name)
                if name == "hooke" and tangent < 0.49:    # near the limit it slips first
                    sin = tangent / math.hypot(1, tangent)
                    self.assert_close(way, MASS * G * sin / KT, 1e-3)

    def test_multistep_holds_a_clump(self):
        """Three spheres of one rigid body, which stand on the slope."""
        corners = [(math.cos(a), math.sin(a)) for a in (0.3, 0.3 + 2 * math.pi / 3, 0.3 + 4 * math.pi / 3)]
        spheres, lines = [], []
        for n in range(3):
            spheres += [Sphere((R * c, 6 * n + R * s, R - 1e-6), diameter=2 * R, density=RHO, type=n + 1)
                        for c, s in corners]
        laws = [MULTISTEP[name] for name in ("hooke", "hertz", "hooke, defaults")]
        molecules = "\n".join(f"group c{n} type {n + 1}\nset group c{n} mol {n + 1}" for n in range(3))
        print(f"\nclump: creep over radius from a fifth of {self.STEPS} steps on")
        for tangent in (0.3, 0.45):
            write_sphere_data(self.path("data"), ((-10, 200), (-9, 30), (-3, 3)), spheres)
            moves = (f"fix molecule all property/atom mol\n{molecules}\n"
                     f"neigh_modify exclude molecule/intra all\nthermo_style custom step\n"
                     f"fix g all {gravity(tangent)}\nfix step all rigid/small molecule")
            self.run_lammps(SCRIPT.format(
                pairs=f"pair_coeff * * hooke {KN} {GN}", move=moves, dt=repr(DT), steps=self.STEPS,
                contacts=" ".join(f"contact types {t} {w}" for t, w in enumerate(laws, 1)),
                every=self.STEPS // 20), timeout=1500)
            frames = read_dump(self.path("out"))
            for n, name in enumerate(("hooke", "hertz", "hooke, defaults")):
                creep = max(self.creep(frames, 3 * n + k, 0.2) for k in (1, 2, 3))
                print(f"tan a {tangent:5} {name:18}{creep / R:10.1e}")
                self.assertLess(creep, 1e-6 * R, name)

    def test_resistance_holds_a_sphere_that_can_roll(self):
        """mu_r > tan a: it neither slips nor rolls."""
        laws = {name: f"{words} rolling 0.4" for name, words in MULTISTEP.items()}
        print(f"\na sphere that can roll, mu_r .4: creep over radius from a fifth of {self.STEPS} steps on")
        for tangent in (0.1, 0.3, 0.39):
            frames = self.simulate(list(laws.values()), tangent, self.STEPS, self.STEPS // 20, move="symplectic")
            for tag, name in enumerate(laws, 1):
                creep = self.creep(frames, tag, 0.2)
                print(f"tan a {tangent:5} {name:18}{creep / R:10.1e}")
                self.assertLess(creep, 1e-6 * R, name)

    def test_thresholds_and_delayed_resistance_let_it_creep(self):
        """A sphere goes on at the threshold of speed of `vmin roll`; `delayed` resistance, of constant size,
        leaves it what it does in one time step, 5/2 mu_r g dt."""
        thresholds = (1e-3, 1e-4, 1e-5)
        laws = [f"{MULTISTEP['hooke']} rolling 0.4 vmin 0 {roll} 0" for roll in thresholds]
        laws += [f"{MULTISTEP['hooke']} rolling 0.4 delayed vmin 0 {roll} 0" for roll in thresholds]
        tangent, steps, kick = 0.2, 20000, 2.5 * 0.4 * G * DT
        frames = self.simulate(laws, tangent, steps, steps // 20, move="symplectic")
        print(f"\ncreep of a rolling sphere, tan a {tangent}, mu_r .4; 5/2 mu_r g dt = {kick:.1e} m/s")
        for tag, law in enumerate(laws, 1):
            first, last = frames[len(frames) // 5], frames[-1]
            speed = abs(last.column("x")[tag] - first.column("x")[tag]) / ((last.step - first.step) * DT)
            print(f"{' '.join(law.split()[8:]):40}{speed:10.2e} m/s")
            roll = thresholds[(tag - 1) % 3]
            self.assertLess(speed, roll + (kick if "delayed" in law else 2.5 * G * tangent * DT))
            self.assertGreater(speed, 0.1 * roll)


class Creeps(Slope):

    def speed(self, frames, tag):
        first, last = frames[len(frames) // 2], frames[-1]
        return (last.column("x")[tag] - first.column("x")[tag]) / ((last.step - first.step) * DT)

    def test_laws_without_memory_creep(self):
        kn = MASS * G / 1e-3**1.5
        for tangent in (0.1, 0.3, 0.45):
            weight, sin = MASS * G, tangent / math.hypot(1, tangent)
            cases = {
                "dashpot": (f"hooke {KN} {GN} tangential dashpot 1e4 {MU}", weight * sin / (MASS * 1e4)),
                "dashpot, default gt": (f"hooke {KN} 2e3 tangential dashpot NULL {MU}",
                                        weight * sin / (MASS * 1e3)),
                "onestep": (f"hooke {KN} {GN} tangential onestep {KT} {GT} {MU}",
                            weight * sin / (KT * DT + MASS * GT)),
                "onestep, no dashpot": (f"hooke {KN} {GN} tangential onestep 4e7 0.0 {MU}",
                                        weight * sin / (4e7 * DT)),
                "plaincoulomb": (f"plaincoulomb {kn!r} 1e4 {MU}", math.atanh(tangent / MU) / 5),
            }
            laws = [law for law, _ in cases.values()]
            frames = self.simulate(laws, tangent, 20000, 1000)
            print(f"\ntan a {tangent}: creep in m/s, closed form")
            for tag, (name, (_, expected)) in enumerate(cases.items(), 1):
                found = self.speed(frames, tag)
                print(f"{name:22}{found:12.6f}{expected:12.6f}")
                self.assert_close(found, expected, 1e-4, name)


class Slides(Slope):

    def test_above_the_angle_of_friction(self):
        """x = a t^2/2 with a = g (sin a - mu cos a), once the spring is at its limit."""
        kn = MASS * G / 1e-3**1.5
        laws = {**MULTISTEP,
                "dashpot": f"hooke {KN} {GN} tangential dashpot 1e6 {MU}",
                "onestep": f"hooke {KN} {GN} tangential onestep {KT} {GT} {MU}",
                "plaincoulomb": f"plaincoulomb {kn!r} 1e4 {MU}"}
        steps = 20000
        for tangent in (0.55, 0.8, 1.2):
            size = math.hypot(1, tangent)
            expected = G * (tangent - MU) / size
            frames = self.simulate(list(laws.values()), tangent, steps, steps // 10)
            print(f"\ntan a {tangent}: acceleration over g (sin a - mu cos a)")
            for tag, name in enumerate(laws, 1):
                first, last = frames[5], frames[-1]
                found = (last.column("vx")[tag] - first.column("vx")[tag]) / ((last.step - first.step) * DT)
                print(f"{name:22}{found / expected:10.6f}")
                self.assert_close(found, expected, 1e-3, name)

    def test_a_free_sphere_rolls_or_slides(self):
        """tan a < 7/2 mu: rolls with 5/7 g sin a; above: slides, and spins up with 5/2 mu g cos a/r."""
        laws = [MULTISTEP["hooke"], MULTISTEP["hertz"], MULTISTEP["hertz/material"]]
        print("\na free sphere: tan a, acceleration over the closed form, spin-up over the closed form")
        for tangent in (0.3, 1.0, 1.7, 1.8, 2.5):
            size = math.hypot(1, tangent)
            rolls = tangent < 3.5 * MU
            a = 5 / 7 * G * tangent / size if rolls else G * (tangent - MU) / size
            alpha = a / R if rolls else 2.5 * MU * G / size / R
            frames = self.simulate(laws, tangent, 10000, 1000, move="symplectic")
            for tag in 1, 2, 3:
                first, last = frames[5], frames[-1]
                time = (last.step - first.step) * DT
                found = [(last.column(c)[tag] - first.column(c)[tag]) / time for c in ("vx", "omegay")]
                print(f"{tangent:6}{found[0] / a:10.6f}{found[1] / alpha:10.6f}")
                self.assert_close(found[0], a, 1e-3)
                self.assert_close(found[1], alpha, 1e-3)

    def test_a_sphere_rolls_against_resistance(self):
        """mu_r < tan a: a = 5/7 g (sin a - mu_r cos a)."""
        laws = [f"{MULTISTEP[name]} rolling 0.1" for name in ("hooke", "hertz", "hertz/material")]
        print("\nrolling against mu_r .1: tan a, acceleration over the closed form")
        for tangent in (0.15, 0.3, 0.6):
            expected = 5 / 7 * G * (tangent - 0.1) / math.hypot(1, tangent)
            frames = self.simulate(laws, tangent, 10000, 1000, move="symplectic")
            for tag in 1, 2, 3:
                first, last = frames[5], frames[-1]
                found = (last.column("vx")[tag] - first.column("vx")[tag]) / ((last.step - first.step) * DT)
                print(f"{tangent:6}{found / expected:10.6f}")
                self.assert_close(found, expected, 1e-3)


if __name__ == "__main__":
    unittest.main()
