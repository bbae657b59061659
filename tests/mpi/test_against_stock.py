# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 timeout=300
"""gran/penalty against the stock granular styles with the same law, particle by particle.

Both run the same script with fix nve/sphere from the same data file, on 1, 2 and 4 ranks."""

import collections
import math
import os
import random
import re
import unittest

from talus_testing import (SceneCase, Sphere, head, max_difference, part_of, read_dump, read_local, thermo,
                           write_sphere_data)

RANKS = 1, 2, 4
STEPS = 1000

# name: (stock pair_style, gran/penalty words); NULL asks both for the stock default of kt and gt
LAWS = {
    "hooke none": ("gran/hooke 1000.0 NULL 20.0 0.0 0.0 0", "hooke 1000.0 20.0"),
    "hooke dashpot": ("gran/hooke 2000.0 NULL 10.0 30.0 0.5 1",
                      "hooke 2000.0 10.0 tangential dashpot 30.0 0.5"),
    "hooke multistep": ("gran/hooke/history 2000.0 NULL 10.0 NULL 0.5 1",
                        "hooke 2000.0 10.0 tangential multistep NULL NULL 0.5"),
    "hertz none": ("gran/hertz/history 6000.0 NULL 150.0 0.0 0.0 0", "hertz 6000.0 150.0"),
    "hertz multistep": ("gran/hertz/history 10000.0 NULL 10.0 NULL 0.5 1",
                        "hertz 10000.0 10.0 tangential multistep NULL NULL 0.5"),
    "hooke multistep limit_damping": (
        "gran/hooke/history 2000.0 1500.0 20.0 30.0 0.3 1 limit_damping",
        "hooke 2000.0 20.0 tangential multistep 1500.0 30.0 0.3 limit_damping"),
    "hertz multistep limit_damping": (
        "gran/hertz/history 10000.0 8000.0 100.0 90.0 0.3 1 limit_damping",
        "hertz 10000.0 100.0 tangential multistep 8000.0 90.0 0.3 limit_damping"),
}

def same_damping_as_tsuji(e):
    """The restitution whose damping is the one that Tsuji's polynomial has at e: sqrt(5) |ln e|/sqrt(pi^2 + ln^2 e) in
    units of sqrt(m F/overlap)."""
    share = sum(c * e**k for k, c in enumerate((1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218))) / math.sqrt(5)
    return math.exp(-math.pi * share / math.sqrt(1 - share * share))


# the same of pair_style granular, without friction
GRANULAR = {
    "hertz/material": ("hertz/material 2e4 0.5 0.3 tangential linear_nohistory 0.0 0.0 damping coeff_restitution",
                       "hertz/material 2e4 0.5 0.3"),
    "hertz/material, tsuji": (
        "hertz/material 2e4 0.9 0.3 tangential linear_nohistory 0.0 0.0 damping tsuji",
        f"hertz/material 2e4 {same_damping_as_tsuji(0.9)!r} 0.3"),
}

# and with friction, for contacts that do not turn
MINDLIN = ("pair_style granular\npair_coeff * * hertz/material 2e4 1.0 0.3 tangential mindlin NULL 0.0 0.5 "
           "damping coeff_restitution", "pair_style gran/penalty\npair_coeff * * hertz/material 2e4 1.0 0.3 "
           "tangential multistep NULL 0.0 0.5")

SCRIPT = head(boundary="p p p") + """
read_data {data}
{pair}
neighbor 0.1 bin
timestep 0.001
fix step all nve/sphere
compute stress all stress/atom NULL
thermo_style custom step pxx pyy pzz pxy pxz pyz
thermo_modify format float %.17g norm no
thermo 20
variable when equal (step<1)+(step>=1)*(step<20)*20+(step>=20)*{steps}+(step>={steps})*1000
dump state all custom 1 state.* id xu yu zu fx fy fz tqx tqy tqz c_stress[*]
dump_modify state format float %.17g every v_when first yes
dump ranks all custom 50 ranks id proc
{more}
run {steps}
"""
CONTACTS = """
compute ends all property/local patom1 patom2 cutoff radius
dump ends all local 10 contacts index c_ends[*]
dump_modify ends format float %.0f
"""

VECTORS = {"force": ("fx", "fy", "fz"), "torque": ("tqx", "tqy", "tqz"),
           "stress": tuple(f"c_stress[{n}]" for n in range(1, 7))}
PRESSURE = "Pxx Pyy Pzz Pxy Pxz Pyz".split()


def stock(words):
    return f"pair_style {words}\npair_coeff * *"


def talus(words):
    return f"pair_style gran/penalty\npair_coeff * * {words}"


def grains():
    """2000 fast spheres of diameter 0.8 to 1.2 that overlap, in a periodic box, drifting."""
    draw = random.Random(2)
    sites = [(i, j, k) for i in range(20) for j in range(10) for k in range(10)]
    draw.shuffle(sites)
    return [Sphere(tuple(s + 0.5 + draw.uniform(-0.15, 0.15) for s in site),
                   tuple(draw.gauss(mean, 1.0) for mean in (2.0, 1.0, 1.0)),
                   tuple(draw.gauss(0, 3.0) for _ in "xyz"), draw.uniform(0.8, 1.2))
            for site in sites]


def pairs_that_do_not_turn(count):
    """Pairs of spheres so heavy that no force changes their motion: along the line between their centers, every other
    pair apart; with any rotation."""
    draw, spheres = random.Random(5), []
    for n in range(count):
        normal = [draw.gauss(0, 1) for _ in "xyz"]
        normal = [c / norm(normal) for c in normal]
        r = [draw.uniform(0.4, 0.6) for _ in range(2)]
        overlap, closing = (0.01, 0.2) if n % 2 else (0.06, -0.2)
        rate = 10 ** draw.uniform(-2, 0.5)
        for sign, radius in zip((-1, 1), r):
            place = sign * (sum(r) - overlap) / 2
            spheres.append(Sphere(
                tuple(c + place * x for c, x in zip((2 + 3 * (n % 5), 2 + 3 * (n // 5 % 5), 2 + 3 * (n // 25)), normal)),
                tuple(-sign * closing / 2 * x for x in normal), tuple(rate * draw.gauss(0, 1) for _ in "xyz"),
                2 * radius, density=1e15))
    return spheres


# ---- comparing -------------------------------------------------------------------------------

def norm(values):
    return math.sqrt(sum(v * v for v in values))


def worst(frame, reference, columns):
    """Largest difference of a vector or tensor over the particles, relative to its own length."""
    k = [frame.columns.index(c) for c in columns]
    return max(norm([row[n] - reference.atoms[tag][n] for n in k]) /
               (norm([reference.atoms[tag][n] for n in k]) or 1.0)
               for tag, row in frame.atoms.items())


def virial_difference(row, reference):
    size = norm([reference[key] for key in PRESSURE])
    return norm([row[key] - reference[key] for key in PRESSURE]) / size


def differences(run, reference, step):
    found = {what: worst(run.frames[step], reference.frames[step], columns)
             for what, columns in VECTORS.items()}
    found["virial"] = virial_difference(run.thermo[step], reference.thermo[step])
    return found


def distance(run, other):
    return max_difference(run.frames[STEPS], other.frames[STEPS], ("xu", "yu", "zu"))


def collisions(path):
    """Contacts that began and ended, by particle; those shorter than 10 steps may be missed."""
    count, begun, before = collections.Counter(), set(), None
    for frame in read_local(path):
        now = {(int(row[1]), int(row[2])) if row[1] < row[2] else (int(row[2]), int(row[1]))
               for row in frame.rows}
        if before is not None:
            for pair in (before - now) & begun:
                count.update(pair)
            begun = (begun | (now - before)) & now
        before = now
    return count


def crossings(path):
    frames = [frame.column("proc") for frame in read_dump(path)]
    return sum(a[tag] != b[tag] for a, b in zip(frames, frames[1:]) for tag in a)


Run = collections.namedtuple("Run", "folder log frames thermo")    # frames, thermo: by step


class AgainstStock(SceneCase):

    def scene(self, name, pair, np, steps, more=""):
        folder = self.path(f"{name}-{np}".replace(" ", "-"))
        os.mkdir(folder)
        log = self.run_lammps(SCRIPT.format(data="../grains", pair=pair, steps=steps, more=more),
                              np=np, cwd=folder).log
        frames = {step: read_dump(os.path.join(folder, f"state.{step}"))[0]
                  for step in sorted({0, 1, 20, steps}) if step <= steps}
        return Run(folder, log, frames, {row["Step"]: row for row in thermo(log)})

    def test_forces_torques_virial_stress(self):
        write_sphere_data(self.path("grains"), ((0, 20), (0, 10), (0, 10)), grains())
        print(f"\n{'relative difference from stock':52}", *(f"{w:>8}" for w in [*VECTORS, "virial"]))
        for law, (theirs, ours) in part_of(LAWS.items(), 1):
            reference = self.scene("stock " + law, stock(theirs), 1, 20)
            for np in RANKS if law == "hooke multistep" else RANKS[::2]:
                run = self.scene(law, talus(ours), np, 20)
                for step, limit in ((0, 1e-12), (20, 1e-11)):
                    found = differences(run, reference, step)
                    print(f"{f'{law}, {np} ranks, step {step}':52}",
                          *(f"{value:8.1e}" for value in found.values()))
                    for what, value in found.items():
                        self.assertLess(value, limit, f"{what}: {law}, {np} ranks, step {step}")
            if "none" not in law:
                self.assert_torque_acts(reference)

    def test_pair_granular(self):
        write_sphere_data(self.path("grains"), ((0, 20), (0, 10), (0, 10)), grains())
        print(f"\n{'relative difference from pair granular':52}  of force, stress")
        for law, (theirs, ours) in part_of(GRANULAR.items(), 1):
            reference = self.scene("granular " + law.replace("/", "-"),
                                   f"pair_style granular\npair_coeff * * {theirs}", 1, 20)
            run = self.scene(law.replace("/", "-"), talus(ours), 1, 20)
            for step, limit in (1, 1e-12), (20, 1e-11):
                found = {what: worst(run.frames[step], reference.frames[step], VECTORS[what]) for what in ("force", "stress")}
                print(f"{f'{law}, step {step}':52}", *(f"{v:8.1e}" for v in found.values()))
                self.assertLess(max(found.values()), limit, f"{law} {step}")

    def test_mindlin_of_pair_granular(self):
        """Its displacement is turned with the contact in another way than that of multistep, so that both laws are one
        only while the contact does not turn; its torque has the lever arm from the center to the middle of the overlap."""
        spheres = pairs_that_do_not_turn(50)
        write_sphere_data(self.path("grains"), ((0, 16), (0, 16), (0, 7)), spheres)
        reference, run = (self.scene(name, pair, 1, 200) for name, pair in zip(("mindlin", "multistep"), MINDLIN))
        force, torque = ([1 + k + 3 * n for k in range(3)] for n in (1, 2))
        sticking = sliding = 0
        for step in 1, 20, 200:
            self.assertLess(worst(run.frames[step], reference.frames[step], VECTORS["force"]), 1e-11, f"step {step}")
            for n in range(1, len(spheres), 2):
                theirs, ours = (frames[step].atoms for frames in (reference.frames, run.frames))
                apart = [a - b for a, b in zip(ours[n + 1][1:4], ours[n][1:4])]
                overlap = (spheres[n - 1].diameter + spheres[n].diameter) / 2 - norm(apart)
                self.assertGreater(overlap, 0.0)
                normal = abs(sum(ours[n][k] * x for k, x in zip(force, apart))) / norm(apart)
                slope = math.sqrt(max(sum(ours[n][k]**2 for k in force) - normal**2, 0.0)) / normal
                self.assertLess(slope, 0.5 * (1 + 1e-9))
                sliding += slope > 0.5 * (1 - 1e-6)
                sticking += 1e-3 < slope < 0.4
                for tag in n, n + 1:
                    radius = spheres[tag - 1].diameter / 2
                    expected = [ours[tag][k] * (1 - overlap / 2 / radius) for k in torque]
                    off = norm([theirs[tag][k] - e for k, e in zip(torque, expected)])
                    self.assertLess(off, 1e-9 * norm(expected), f"torque on {tag}, step {step}")
        print(f"contacts that slid {sliding}, that did not {sticking}")
        self.assertGreater(sliding, 30)
        self.assertGreater(sticking, 30)

    def assert_torque_acts(self, run):
        for step in (0, 20) if "dashpot" in run.folder else (20,):    # no displacement at first
            torques = [norm(row[7:10]) for row in run.frames[step].atoms.values()]
            self.assertGreater(sum(t > 0.1 for t in torques), len(torques) / 2)

    def test_positions_after_1000_steps(self):
        write_sphere_data(self.path("grains"), ((0, 20), (0, 10), (0, 10)), grains())
        print(f"\n{'positions after 1000 steps':28}{'on 1':>9}{'on 2':>9}{'on 4 ranks':>11}"
              f"{'stock 1-2':>11}   collisions  rebuilds  crossings")
        for law, (theirs, ours) in part_of(list(LAWS.items())[:5], 2, 2):
            reference = self.scene("stock " + law, stock(theirs), 1, STEPS)
            own = distance(self.scene("stock " + law, stock(theirs), 2, STEPS), reference)
            runs = [self.scene(law, talus(ours), np, STEPS, CONTACTS if np == 1 else "")
                    for np in RANKS]
            found = [distance(run, reference) for run in runs]
            count = collisions(os.path.join(runs[0].folder, "contacts"))
            fewest, mean = min(count[tag] for tag in range(1, 2001)), sum(count.values()) / 2000
            builds = int(re.findall(r"Neighbor list builds = (\d+)", runs[0].log)[-1])
            crossed = crossings(os.path.join(runs[2].folder, "ranks"))
            print(f"{law:28}{found[0]:9.1e}{found[1]:9.1e}{found[2]:11.1e}{own:11.1e}"
                  f"{fewest:5} to {mean:.1f} {builds:8}{crossed:11}")
            self.assertLess(max(found), 1e-9, law)
            self.assertGreaterEqual(fewest, 5, law)
            self.assertGreaterEqual(builds, 5, law)
            self.assertGreaterEqual(crossed, 500, law)

    def test_chute_of_the_host(self):
        bench = os.path.join(os.environ["TALUS_LAMMPS_SOURCE"], "bench")
        with open(os.path.join(bench, "in.chute")) as file:
            script = file.read()
        script = re.sub(r"data\.chute", os.path.join(bench, "data.chute"), script)
        script, n = re.subn(r"(?m)^pair_style.*\npair_coeff.*$", talus(
            "hooke 200000.0 50.0 tangential multistep NULL 0 0.5"), script)
        self.assertEqual(n, 1)
        for np in RANKS[::2]:
            row = thermo(self.run_lammps(script, np=np).log)[-1]
            print(f"chute on {np} ranks, step {row['Step']:.0f}: {row['KinEng']} {row['c_1']}")
            self.assertEqual((row["Step"], row["KinEng"], row["c_1"]), (100, 784292.08, 1571.0968))


if __name__ == "__main__":
    unittest.main()
