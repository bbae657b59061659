# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Every contact law: the same bits on 1, 2 and 4 ranks, and after a restart in a new process.

80 spheres collide with each other, a floor and two walls for 300 steps.  One process computes the scenes of all
laws, one after the other.  Compared are positions, velocities, spins, forces and torques of every sphere; -0 counts
as 0."""

import random
import unittest

from talus_testing import SceneCase, Sphere, head, max_difference, read_dump, write_sphere_data

HOOKE, HERTZ, FLORES = "hooke 1e4 20.0", "hertz 3e4 50.0", "flores 3e4 2e3"
COULOMB = "plaincoulomb 2e4 5.0 0.5"
HOOKE_M, HERTZ_M = "hooke/material 1e5 0.6 0.3 2.0", "hertz/material 1e5 0.6 0.3"
FLORES_M, COULOMB_M = "flores/material 1e5 0.6 0.3 2.0", "plaincoulomb/material 1e5 0.6 0.3 0.5"
DASHPOT, ONESTEP = "tangential dashpot NULL 0.5", "tangential onestep NULL NULL 0.5"
MULTISTEP = "tangential multistep NULL NULL 0.5"
RESIST = "rolling 0.1 spinning 0.1"
DELAYED = "rolling 0.1 delayed spinning 0.1 delayed"
WET, RABINOVICH, LUDING = "adhesion willett 0.5 20", "adhesion rabinovich 0.5 40", "luding 5e3 2e4 5e3 0.05 5.0"
EEPA = "eepa 1e5 0.6 0.3 50 0.4 1.0 1.4 2.0"
CONSTANT, DMT, PERKO = "adhesion constant 2.0", "adhesion dmt 5.0", "adhesion perko 8.0"

LAWS = [
    HOOKE, f"{HOOKE} {DASHPOT}", f"{HOOKE} {ONESTEP} {RESIST} limit_damping", f"{HOOKE} {MULTISTEP}",
    f"{HOOKE} {MULTISTEP} {DELAYED}", f"{HOOKE} {CONSTANT}", f"{HOOKE} {RESIST}",
    f"{HERTZ} {PERKO}", f"{HERTZ} {ONESTEP}", f"{HERTZ} {DASHPOT} spinning 0.2 {PERKO}",
    f"{HERTZ} {MULTISTEP} {RESIST} {DMT}",
    FLORES, f"{FLORES} tangential dashpot 50.0 0.5 {CONSTANT}",
    f"{FLORES} tangential multistep NULL 50.0 0.5 rolling 0.1 delayed",
    COULOMB, f"plaincoulomb 2e4 500.0 0.5 {DELAYED}", f"{COULOMB} {RESIST} {DMT} vmin 0.01 0.01 0.01",
    HOOKE_M, f"{HOOKE_M} {ONESTEP}", f"{HOOKE_M} {MULTISTEP}", f"{HOOKE_M} {MULTISTEP} {DELAYED} {PERKO}",
    f"{HERTZ_M} {DASHPOT} rolling 0.1", f"{HERTZ_M} {MULTISTEP} limit_damping",
    f"{HERTZ_M} {MULTISTEP} {DELAYED} {CONSTANT}",
    f"{FLORES_M} {ONESTEP} {RESIST}", f"{FLORES_M} {MULTISTEP}", f"{FLORES_M} {MULTISTEP} {DELAYED} {DMT}",
    COULOMB_M, f"{COULOMB_M} {RESIST} {CONSTANT}",
    f"{HERTZ_M} {MULTISTEP} {WET} fraction 0.01", f"{HOOKE} {RABINOVICH} volume 5e-3 viscosity 0.1 0.05",
    f"{HERTZ} tangential mindlin 3e4 1.0 0.5 rolling sds 1e3 5.0 0.1 twisting marshall {RABINOVICH} fraction 0.02",
    f"{LUDING} {MULTISTEP}", LUDING, f"{EEPA} {MULTISTEP} rolling 0.05", f"walton/braun 1e4 3e4 5.0 {MULTISTEP} {DELAYED} {WET} volume 2e-3",
    f"{HOOKE} {MULTISTEP} slider", f"{HERTZ_M} {MULTISTEP} stock", f"{HERTZ_M} {MULTISTEP} midpoint {RESIST}",
    # other laws between unlike types: law 1 1, law 1 2, law 2 2
    (f"{HERTZ_M} {MULTISTEP} {RESIST}", f"{HOOKE} {CONSTANT}", f"{HOOKE_M} {MULTISTEP} {DELAYED}"),
    (COULOMB, f"{FLORES_M} {MULTISTEP}", FLORES),
    (f"{HERTZ_M} {MULTISTEP} {WET} fraction 0.01", LUDING, f"{HOOKE} {MULTISTEP}"),
]

HEAD = "\nclear" + head("si")
PHYSICS = """
neighbor 0.1 bin
timestep 5e-4
fix step all nve/sphere/symplectic start half gravity 10.0 vector 0.2 0.1 -1
fix floor all large/body plane 0 0 -0.6 0 0 1 contact types 1 {first} contact types 2 {last}
fix xlo all large/body rectangle -0.7 0 0 1 0 0 0 1 0 20 20 contact types 1 {first} contact types 2 {last}
fix yhi all large/body plane 0 3.8 0 0 -1 0 contact types 1 {first} contact types 2 {last}
compute pair all pair gran/penalty
thermo 1000
thermo_style custom step c_pair[1]
"""
COLUMNS = "x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz".split()
WRITE = f"write_dump all custom {{name}} id {' '.join(COLUMNS)} proc modify format float %a\n"


def words_of(law):
    """Words for types 1 1, 1 2 and 2 2."""
    return (law,) * 3 if isinstance(law, str) else law


def pair(law):
    a, b, c = words_of(law)
    return f"pair_style gran/penalty\npair_coeff 1 1 {a}\npair_coeff 1 2 {b}\npair_coeff 2 2 {c}\n"


def physics(law):
    return PHYSICS.format(first=words_of(law)[0], last=words_of(law)[2])


def spheres():
    draw = random.Random(3)
    sites = [(i, j, k) for k in range(5) for j in range(4) for i in range(4)]
    draw.shuffle(sites)
    return [Sphere(tuple(s + draw.uniform(-0.1, 0.1) for s in site), tuple(draw.gauss(0, 3) for _ in "xyz"),
                   tuple(draw.gauss(0, 5) for _ in "xyz"), draw.uniform(0.8, 1.05), type=draw.choice((1, 2)))
            for site in sites]


def bits(value):
    return (value + 0.0).hex()    # -0 + 0 = 0


class AllLaws(SceneCase):

    def simulate(self, name, np, start, more=""):
        """One process for all laws; start(n, law): lines up to the end of the run. Returns the last states."""
        text = "".join(HEAD + start(n, law) + more.format(n=n) + WRITE.format(name=f"{name}.{n}")
                       for n, law in enumerate(LAWS))
        self.run_lammps(text, np=np, name=name, timeout=250)
        return [read_dump(self.path(f"{name}.{n}"))[-1] for n in range(len(LAWS))]

    @staticmethod
    def from_data(steps):
        return lambda n, law: f"read_data data\n{pair(law)}{physics(law)}run {steps} post no\n"

    @staticmethod
    def from_restart(steps, again):
        """The pair style and its words are in the restart file; giving them again is allowed."""
        return lambda n, law: (f"read_restart middle.{n}\n{pair(law) if again else ''}{physics(law)}"
                               f"run {steps} post no\n")

    def assert_all_same(self, frames, others, what):
        different = []
        for law, frame, other in zip(LAWS, frames, others, strict=True):
            for key in COLUMNS:
                mine, theirs = frame.column(key), other.column(key)
                if any(bits(mine[tag]) != bits(theirs[tag]) for tag in mine):
                    different.append((law, key, max_difference(frame, other, [key])))
        self.assertEqual(different, [], what)

    def test_ranks_and_restart(self):
        box = ((-3, 8), (-3, 6), (-1.5, 9))
        write_sphere_data(self.path("data"), box, spheres(), types=2)
        once = self.simulate("one", 1, self.from_data(300))
        self.assert_laws_act(once)
        for np in 2, 4:
            frames = self.simulate(f"ranks{np}", np, self.from_data(300))
            self.assertEqual(len(set(frames[0].column("proc").values())), np)
            self.assert_all_same(once, frames, f"{np} ranks against 1")

        for wrote, np, again in (2, 1, True), (1, 4, False):
            self.simulate("half", wrote, self.from_data(150), more="write_restart middle.{n}\n")
            frames = self.simulate(f"restarted{np}", np, self.from_restart(150, again))
            self.assert_all_same(once, frames, f"written by {wrote} ranks, restarted on {np}")
        print(f"\n{len(LAWS)} laws: same bits on 1, 2, 4 ranks and after restarts on 1 and 4 ranks")

    def assert_laws_act(self, frames):
        """No two laws give the same motion, spins change where there is friction, spheres change places."""
        start = {n: s for n, s in enumerate(spheres(), 1)}
        seen = set()
        for law, frame in zip(LAWS, frames, strict=True):
            seen.add(tuple(bits(value) for key in ("x", "omegax") for value in frame.column(key).values()))
            turned = sum(value != start[tag].omega[0] for tag, value in frame.column("omegax").items())
            frictionless = all("tangential" not in w and "plaincoulomb" not in w and "rolling" not in w
                               and "spinning" not in w and "viscosity" not in w for w in words_of(law))
            if frictionless:
                self.assertEqual(turned, 0, law)
            else:
                self.assertGreater(turned, 60, law)
            moved = max(abs(value - start[tag].x[0]) for tag, value in frame.column("x").items())
            self.assertGreater(moved, 0.4, law)
            self.assertLess(moved, 3.0, law)
        self.assertEqual(len(seen), len(LAWS))


if __name__ == "__main__":
    unittest.main()
