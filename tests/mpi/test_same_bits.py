# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""One trajectory: a collapsing heap has the same bits however it is decomposed, rebuilt, sorted, restarted.

The reference is one uninterrupted run on one rank.  Compared are position, velocity, spin and stress
of every particle and force, overlap and friction (so the history) of every contact, at several steps;
-0 counts as 0.  The stock style in the same scene is the negative control."""

import os
import random
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import SceneCase, Sphere, read_dump, read_local, run_lammps, write_sphere_data

BOX = ((-1, 19), (-1, 7), (-1, 19))
STEPS, EVERY = 1500, 500     # beyond step 1000, where the order of sums is renewed
LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
PAIR = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
STOCK = "pair_style gran/hertz/history 4000.0 NULL 40.0 NULL 0.5 1\npair_coeff * *\n"

HEAD = """
units lj
boundary f f f
atom_style sphere
atom_modify map yes {sort}
newton off
comm_modify vel yes
processors {grid}
{comm}
"""
SKIN = "neighbor {skin} bin\nneigh_modify every 1 delay 0 {rebuild}\n"

# a floor, three walls that stay and one that is taken away
PHYSICS = """
timestep 0.002
fix step all nve/sphere/symplectic gravity 1.0 vector 0.1 0.05 -1.0
fix floor all large/body plane 0 0 0  0 0 1  contact {law}
fix xlo all large/body plane 0 0 0  1 0 0  contact {law}
fix ylo all large/body rectangle 9 0 9  0 1 0  1 0 0  20 20  contact {law}
fix yhi all large/body rectangle 9 6 9  0 -1 0  1 0 0  20 20  contact {law}
{gate}
compute pair all pair gran/penalty
compute stress all stress/atom NULL
compute ends all property/local patom1 patom2 cutoff radius
compute contact all pair/local dist force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 cutoff radius
thermo 500
"""
GATE = f"fix xhi all large/body plane 8 0 0  -1 0 0  contact {LAW}"
OUTPUT = """
dump atoms all custom {every} atoms.* id x y z vx vy vz omegax omegay omegaz c_stress[*] proc
dump_modify atoms format float %a
dump contacts all local {every} contacts.* index c_ends[*] c_contact[*]
dump_modify contacts format float %a
"""
RUN = f"run {STEPS}\n"


def physics(pair=PAIR, gate="", stats=True):
    text = PHYSICS.format(law=LAW, gate=gate)
    if not stats:
        text = text.replace("compute pair all pair gran/penalty\n", "")
        text = text.replace(" p11 cutoff", " cutoff")
    return pair + text


def head(sort="", grid="* * *", comm=""):
    return HEAD.format(sort=sort, grid=grid, comm=comm)


def skin(skin=0.1, rebuild="check yes"):
    return SKIN.format(skin=skin, rebuild=rebuild)


def output(every=EVERY):
    return OUTPUT.format(every=every)


def scene(data, pair=PAIR, middle="", run=RUN, stats=True, rebuild=None, **options):
    return (head(**options) + f"read_data {data}\n" + (rebuild or skin()) +
            physics(pair, stats=stats) + middle + output() + run)


def grains():
    """A jittered lattice of 720 spheres of diameter 0.7 to 1.3."""
    draw = random.Random(1)
    sites = [(i, j, k) for k in range(15) for j in range(6) for i in range(8)]
    draw.shuffle(sites)    # neighbours in space are not neighbours by number
    return [Sphere(tuple(s + 0.5 + draw.uniform(-0.1, 0.1) for s in site),
                   diameter=draw.uniform(0.7, 1.3)) for site in sites]


# ---- what is compared ------------------------------------------------------------------------

def bits(value):
    return (value + 0.0).hex()    # -0 + 0 = 0


def atoms_of(path):
    frame, = read_dump(path)
    return {tag: tuple(map(bits, row[:-1])) for tag, row in frame.atoms.items()}


def contact_of(row):
    """(tags, bits) of a contact as the particle with the lower tag sees it."""
    a, b, dist, force, *p = row[1:]
    sign = 1.0 if a < b else -1.0
    vectors = [sign * v for v in p[0:3] + p[4:10]]
    return (min(a, b), max(a, b)), tuple(map(bits, [dist, force, p[3], *vectors, *p[10:]]))


def contacts_of(path):
    frame, = read_local(path)
    return dict(map(contact_of, frame.rows))


def snapshot(folder, step):
    return {"particles": atoms_of(os.path.join(folder, f"atoms.{step}")),
            "contacts": contacts_of(os.path.join(folder, f"contacts.{step}"))}


def proc_of(folder, step):
    return read_dump(os.path.join(folder, f"atoms.{step}"))[0].column("proc")


def last_number(pattern, log):
    return float(re.findall(pattern, log)[-1])


class SameBits(SceneCase):
    """Every test runs one variant of the scene and compares it with the reference."""

    @classmethod
    def setUpClass(cls):
        cls.settled = cls.folder()
        cls.reference = cls.folder()
        cls.settle()
        result = run_lammps(scene(cls.data), cwd=cls.reference)
        cls.expected = {s: snapshot(cls.reference, s) for s in range(0, STEPS + 1, EVERY)}
        cls.reference_log = result.log

    @classmethod
    def folder(cls):
        name = tempfile.mkdtemp(prefix="talus-same-bits-")
        cls.addClassCleanup(shutil.rmtree, name, ignore_errors=True)
        return name

    @classmethod
    def settle(cls):
        write_sphere_data(os.path.join(cls.settled, "start"), BOX, grains())
        cls.data = os.path.join(cls.settled, "heap")
        run_lammps(head() + "read_data start\n" + skin() + physics(gate=GATE) +
                   "fix drag all viscous 0.2\nrun 6000\nwrite_data heap\n", cwd=cls.settled)

    def assert_same(self, step, folder=None):
        found = snapshot(folder or self.dir, step)
        for what, expected in self.expected[step].items():
            self.assertEqual(sorted(found[what]), sorted(expected), f"{what} at step {step}")
            wrong = [key for key in expected if found[what][key] != expected[key]]
            self.assertEqual(wrong, [], f"{len(wrong)} of {len(expected)} {what} at step {step}")

    def check(self, np=1, from_step=0, **options):
        log = self.run_lammps(scene(self.data, **options), np=np).log
        for step in range(from_step, STEPS + 1, EVERY):
            self.assert_same(step)
        self.assertEqual(last_number(r"Dangerous builds = (\d+)", log), 0)
        return log


if __name__ == "__main__":
    unittest.main()
