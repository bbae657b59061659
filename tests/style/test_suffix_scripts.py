#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Whole scripts with and without the suffix talus: the same thermo output and dumps, whatever else is in them."""

import os
import random
import unittest
from unittest import mock

from talus_testing import SceneCase, Sphere, max_difference, read_dump, thermo, write_sphere_data

BOX = ((0, 6), (0, 6), (-1, 12))

SCRIPT = """
units lj
boundary {boundary}
{before}
atom_style {atoms}
newton {newton}
comm_modify vel yes
{read}
group rest id > 40
{pair}
{bonds}
neighbor 0.3 bin
timestep 0.0005
fix 1 all {integrator}
fix 2 all gravity 1.0 chute 22.0
fix 3 all wall/gran hooke/history 20000.0 NULL 50.0 NULL 0.5 1 zplane 0.0 NULL
thermo_style custom step atoms ke press pxx pxz
thermo_modify format float %.17g norm no lost warn
thermo 20
dump d all custom 20 state id x y z vx vy vz fx fy fz tqx tqy tqz
dump_modify d format float %.17g
{commands}
"""
PAIR = "pair_style gran/hooke/history 20000.0 NULL 50.0 NULL 0.5 1\npair_coeff * *"


def grains():
    """A cubic packing, loose but for some contacts, in motion."""
    draw = random.Random(3)
    found = []
    for site in ((i, j, k) for k in range(7) for i in range(6) for j in range(6)):
        x = tuple(s + 0.5 + draw.uniform(-0.04, 0.04) for s in site)
        motion = [tuple(draw.gauss(0, 0.6) for _ in "xyz") for _ in "vw"]
        found.append(Sphere(x, *motion, diameter=draw.uniform(0.9, 1.08)))
    return found


class Scripts(SceneCase):

    def compare(self, commands, np=1, tolerance=1e-8, **options):
        """The log with the suffix, after both have been found equal."""
        settings = dict(boundary="p p f", before="", atoms="sphere", newton="on", read="read_data grains", pair=PAIR,
                        bonds="", integrator="nve/sphere", commands=commands)
        settings.update(options)
        results, frames = [], []
        for suffix in [], ["-sf", "talus"]:
            cwd = self.path("talus" if suffix else "stock")
            os.makedirs(cwd, exist_ok=True)
            write_sphere_data(os.path.join(cwd, "grains"), BOX, grains())
            results.append(self.run_lammps(SCRIPT.format(**settings), np=np, cwd=cwd, arguments=suffix))
            frames.append(read_dump(os.path.join(cwd, "state")))
        rows, others = (thermo(r.log) for r in results)
        self.assertGreater(len(rows), 1)
        self.assertEqual(len(rows), len(others))
        for a, b in zip(rows, others):
            for key in a:
                self.assertLessEqual(abs(a[key] - b[key]), tolerance * max(1.0, abs(a[key])), f"{key} at {a['Step']}")
        self.assertEqual(len(frames[0]), len(frames[1]))
        for a, b in zip(*frames):
            self.assertEqual(sorted(a.atoms), sorted(b.atoms))
            for column in a.columns[1:]:
                scale = max(1.0, *map(abs, a.column(column).values()))
                self.assertLessEqual(max_difference(a, b, [column]), tolerance * scale, f"{column} at {a.step}")
        return results[1].log

    @mock.patch.dict(os.environ, MALLOC_PERTURB_="0")    # LAMMPS sets the forces of the group alone
    def test_proxies_of_a_group(self):
        for np in 1, 2:
            log = self.compare("run 60", np=np, newton="off", before="", read="atom_modify first rest\nread_data grains",
                               bonds="neigh_modify include rest\ncomm_modify group rest")
            self.assertIn("comm_modify group", log)

    def refused(self, message, np=1, suffix=(), **options):
        settings = dict(boundary="p p f", before="", atoms="sphere", newton="off", read="read_data grains", pair=PAIR,
                        bonds="", integrator="nve/sphere", commands="run 1")
        settings.update(options)
        write_sphere_data(self.path("grains"), BOX, grains())
        log = self.run_lammps(SCRIPT.format(**settings), np=np, arguments=suffix, expect_error=True).log
        self.assertIn(message, log)

    def test_what_cannot_be_left_to_stock_is_an_error(self):
        """With the pair style of Talus itself, and with the suffix if it comes after a run."""
        group = "neigh_modify include rest\ncomm_modify group rest"
        first = "atom_modify first rest\nread_data grains"
        penalty = "pair_style gran/penalty\npair_coeff * * hooke 20000.0 50.0 tangential multistep NULL NULL 0.5"
        for np in 1, 2:
            self.refused("Pair style gran/penalty: 'comm_modify group' leaves out proxies: remove it", np, pair=penalty,
                         read=first, bonds=group)
            self.refused("Pair style gran/hooke/history: 'comm_modify group' leaves out proxies: it was accelerated in the "
                         "last run, so use 'suffix off'", np, ["-sf", "talus"], read=first,
                         commands=f"run 1\n{group}\nrun 1")

    def test_narrow_box(self):
        """Stock from the first run on, or with a warning if it becomes narrow later."""
        big = "set atom 252 diameter 3.2\nset atom 252 x 3.0 y 3.0 z 10.0"
        log = self.compare(f"{big}\nrun 40")
        self.assertRegex(log, r"pair gran/hooke/history +stock: the box is periodic in x")
        for np in 1, 2:
            log = self.compare(f"run 20\n{big}\nrun 40", np=np)
            self.assertIn("WARNING: Pair style gran/hooke/history: the box is periodic in x", log)
            self.assertRegex(log, r"pair gran/hooke/history +accelerated")


if __name__ == "__main__":
    unittest.main()
