# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=180 stay
"""Sizes 1:30: the same bits on ranks, threads, across a restart, with the exchange of LAMMPS and in its multi mode; and a
particle is a proxy only where something can touch it."""

import re
import unittest

from talus_testing import SceneCase, head, read_dump

SMALL = 0.002
HEAD = head("si", "{sides} f", newton="{newton}")
FILL = HEAD + """region box block 0 0.08 0 0.08 0 0.13 units box
create_box 1 box
pair_style gran/hertz/history 1e6 NULL 5e3 NULL 0.5 1
pair_coeff * *
fill_region box 1 fraction 0.45 diameter {sizes} density 2500 seed 4711
write_data grains nocoeff
"""
SCENE = HEAD + """{read}
{modes}
pair_style gran/hertz/history 1e6 NULL 5e3 NULL 0.5 1
pair_coeff * *
timestep 1e-5
fix weight all gravity 9.81 vector 0.3 0 -1
fix move all nve/sphere
fix floor all wall/gran hertz/history 1e6 NULL 5e3 NULL 0.5 1 zplane 0 0.13
{more}
thermo 1000
run {steps}
"""
DUMP = "write_dump all custom dump id x y z vx vy vz omegax omegay omegaz modify format float %a sort id\ncomm_proxy info\n"
SIZES = {
    "two 1:10": f"discrete 2 {SMALL} 2000 {10 * SMALL} 4",
    "1:30": f"uniform {0.65 * SMALL} {19.5 * SMALL} mass",
}


class WideSizes(SceneCase):

    def fill(self, sizes, sides):
        self.run_lammps(FILL.format(sizes=sizes, sides=sides, newton="off"), np=1)

    def run_scene(self, np=1, sides="p p", newton="off", read="read_data grains", modes="neighbor 0.0005 bin", more="", steps=200,
                  threads=1, end=DUMP, check=False):
        more += "\ncomm_proxy yes\ncomm_proxy check yes" if check else ""
        script = SCENE.format(sides=sides, newton=newton, read=read, modes=modes, more=more, steps=steps) + end
        log = self.run_lammps(script, np=np, env={"OMP_NUM_THREADS": str(threads)}, arguments=["-sf", "talus"]).log
        return log, read_dump(self.path("dump"))[0]

    def test_same_bits(self):
        for name, sides in ("1:30", "p p"), ("1:30", "f f"), ("1:30", "p f"), ("two 1:10", "p f"):
            self.fill(SIZES[name], sides)
            _, first = self.run_scene(sides=sides)
            for options in ({"np": 2}, {"np": 4, "newton": "on"}, {"np": 2, "threads": 2}, {"np": 3, "more": "comm_proxy no"},
                            {"np": 2, "check": True},
                            {"np": 2, "modes": "neighbor 0.0005 multi\ncomm_modify mode multi"}):
                with self.subTest(sizes=name, sides=sides, **options):
                    self.assert_same_bits(first, self.run_scene(sides=sides, **options)[1])

    def test_restart(self):
        self.fill(SIZES["1:30"], "f f")
        # velocity Verlet begins each run with forces of its own
        _, whole = self.run_scene(np=2, sides="f f", steps=130, end="write_restart half\nrun 170\n" + DUMP)
        _, again = self.run_scene(np=3, sides="f f", read="read_restart half", steps=170)
        self.assert_same_bits(whole, again)

    def test_proxies(self):
        """In the slabs of LAMMPS, as thick as the largest sphere, there are several times as many."""
        proxies = re.compile(r"^  proxies +\S+ +(\S+)", re.MULTILINE)
        self.fill(SIZES["two 1:10"], "p p")
        for np in 1, 4:
            found = []
            for modes in "", "\ncomm_modify cutoff 0.0205":
                log, _ = self.run_scene(np=np, steps=0, modes="neighbor 0.0005 bin" + modes)
                found.append(float(proxies.search(log)[1]))
            self.assertLess(found[0], 0.6 * found[1])


if __name__ == "__main__":
    unittest.main()
