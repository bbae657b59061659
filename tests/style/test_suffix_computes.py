#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""compute penalty/stats and compute timestep/gran of pair styles of LAMMPS that are accelerated by the suffix."""

import math
import random
import unittest

from talus_testing import SceneCase, Sphere, head, thermo, write_sphere_data

SCENE = head("si", newton="{newton}") + """
read_data data
{pair}
neighbor 0.1 bin
timestep 2e-5
fix step all nve/sphere/symplectic
compute s all penalty/stats
compute t all timestep/gran
compute k all ke
compute r all erotate/sphere
thermo 100
thermo_style custom step c_k c_r c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6] c_s[7] c_t[1] c_t[2] c_t[3]
thermo_modify format float %.17g norm no
run {steps}
"""
ENERGIES = tuple(f"c_s[{n}]" for n in (4, 5, 6, 7))


def granular(words):
    return f"pair_style granular\npair_coeff * * {words}"


def heap():
    draw = random.Random(3)
    return [Sphere(tuple(0.97 * k + draw.uniform(-0.03, 0.03) for k in (i, j, k)),
                   tuple(draw.gauss(0, 1.0) for _ in "xyz"), tuple(draw.gauss(0, 4.0) for _ in "xyz"),
                   draw.uniform(0.85, 1.0), density=100.0) for i in range(4) for j in range(4) for k in range(4)]


class Computes(SceneCase):

    def run_scene(self, pair, steps=2000, suffix=True, newton="on", **options):
        return self.run_lammps(SCENE.format(pair=pair, steps=steps, newton=newton),
                               arguments=["-sf", "talus"] if suffix else [], **options).log

    def test_balance_of_energy(self):
        write_sphere_data(self.path("data"), ((-9, 13),) * 3, heap())
        for pair, dissipates in (
                ("pair_style gran/hooke/history 2e4 8e3 30.0 0.0 0.4 1\npair_coeff * *", (5, 6)),
                ("pair_style gran/hertz/history 4e5 3e5 100.0 50.0 0.4 1\npair_coeff * *", (5, 6)),
                ("pair_style gran/hooke 2e4 NULL 30.0 15.0 0.4 1\npair_coeff * *", (5, 6)),
                (granular("hertz/material 1e5 0.6 0.3 tangential mindlin NULL 0.7 0.4 damping tsuji rolling sds 2e3 20.0 0.2 "
                          "twisting marshall"), (5, 6, 7)),
                (granular("jkr 1e5 50.0 0.3 5.0 tangential linear_history 8e3 0.7 0.4"), (5, 6))):
            with self.subTest(pair):
                rows = thermo(self.run_scene(pair))
                totals = [row["c_k"] + row["c_r"] + sum(row[key] for key in ENERGIES) for row in rows]
                worst = max(abs(total - totals[0]) for total in totals) / totals[0]
                print(f"\n{pair.splitlines()[-1] if 'granular' in pair else pair.splitlines()[0]}: change of the sum {worst:.1e}")
                self.assertLess(worst, 2e-4)
                self.assertGreater(max(row["c_s[2]"] for row in rows), 10)
                for n in dissipates:
                    self.assertGreater(rows[-1][f"c_s[{n}]"], 1e-3 * totals[0], f"c_s[{n}]")

    def test_like_gran_penalty(self):
        """The same law under two names."""
        write_sphere_data(self.path("data"), ((-9, 13),) * 3, heap())
        law = "hertz/material 1e5 0.6 0.3 damping tsuji tangential mindlin NULL 0.7 0.4"
        of_suffix = thermo(self.run_scene(granular(law), steps=100))
        ours = thermo(self.run_scene(f"pair_style gran/penalty\npair_coeff * * {law}", steps=100, newton="off"))
        for a, b in zip(of_suffix, ours, strict=True):
            for key in a:
                self.assertLessEqual(abs(a[key] - b[key]), 1e-9 * abs(b[key]), f"{key} at {a['Step']:g}")

    def test_critical_time_step(self):
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, [Sphere((0, 0, 0), density=100.0), Sphere((0, 0, 2), density=100.0)])
        row = thermo(self.run_scene("pair_style gran/hooke/history 2e4 NULL 30.0 NULL 0.4 1\npair_coeff * *", steps=0))[0]
        self.assert_close(row["c_t[1]"], math.sqrt(100.0 * math.pi / 6 / 2 / 2e4), 1e-12)

    def test_refused(self):
        """Where LAMMPS itself computes the contacts."""
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, [Sphere((0, 0, 0)), Sphere((0, 0, 2))])
        hooke = "pair_style gran/hooke/history 2e4 NULL 30.0 NULL 0.4 1\npair_coeff * *"
        for pair, arguments in (hooke, []), (hooke, ["-sf", "talus"]):
            for compute in "penalty/stats", "timestep/gran":
                text = SCENE.format(pair=pair, steps=0, newton="off")
                other = {"penalty/stats": "compute t all timestep/gran\n", "timestep/gran": "compute s all penalty/stats\n"}[compute]
                text = text.replace(other, "").split("thermo_style")[0] + "run 0\n"
                if arguments:    # units in which force is not mass times acceleration
                    text = text.replace("units si", "units real")
                log = self.run_lammps(text, arguments=arguments, expect_error=True).log
                self.assertIn(f"Compute {compute} requires one pair style gran/penalty, or one that is accelerated by the suffix talus",
                              log)


if __name__ == "__main__":
    unittest.main()
