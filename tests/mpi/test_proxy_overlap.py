# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""gran/penalty: the same bits with the stock exchange, the direct one, and the direct one overlapped.

With walls, run style verlet of LAMMPS is compared as well; in periodic boxes only runs with the same rebuild
schedule are the same (wrapping rounds), so there verlet/proxy is compared with itself.  All runs of
the direct exchange are checked: proxies hold NaN while they are under way."""

import re
import unittest

from talus_testing import SceneCase, read_dump, thermo, write_sphere_data
from tossed_grains import LAW as FRICTION, tossed_grains

LAWS = {"friction": FRICTION, "frictionless": "hertz 4000.0 40.0",
        "rolling": FRICTION + " rolling 0.1"}
SCENE = """
log log.{name}
units lj
boundary {boundary}
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
processors {grid}
read_data grains
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.1 bin
neigh_modify {rebuild}
timestep 0.001
fix step all nve/sphere/symplectic gravity 4.0 vector 0.3 0.1 -1
fix floor all large/body plane 0 0 0  0 0 1  contact {law}
{walls}
{exchange}
{middle}
compute spin all erotate/sphere
thermo 100
thermo_style custom step ke c_spin pxx pxy f_floor[3]
thermo_modify format float %.17g norm no
dump all all custom 100 dump.{name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify all format float %a
run {steps}
comm_proxy info
clear
"""
WALLS = """
fix xlo all large/body plane 0 0 0  1 0 0  contact {law}
fix ylo all large/body plane 0 0 0  0 1 0  contact {law}
fix xhi all large/body plane 9.5 0 0  -1 0 0  contact {law}
fix yhi all large/body plane 0 7.2 0  0 -1 0  contact {law}
"""
EXCHANGES = {
    "stock": "comm_proxy no\nrun_style verlet/stock",
    "direct": "comm_proxy yes\ncomm_proxy check yes\nrun_style verlet/stock",
    "blocking": "comm_proxy yes\ncomm_proxy check yes\nrun_style verlet/proxy overlap no",
    "overlapped": "comm_proxy yes\ncomm_proxy check yes\nrun_style verlet/proxy overlap yes",
    "no proxies": "comm_proxy no",
    "automatic": "",
}
STEPS = 300


def scene(exchange, law="friction", boundary="f f f", grid="* * *", steps=STEPS, middle="",
          rebuild="every 1 delay 0 check yes", name=None):
    law = LAWS[law]
    return SCENE.format(name=name or exchange.replace(" ", "-"), law=law, boundary=boundary,
                        grid=grid, steps=steps, middle=middle, rebuild=rebuild,
                        exchange=EXCHANGES[exchange],
                        walls=WALLS.format(law=law) if boundary == "f f f" else "")


class Overlap(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((-0.1, 9.6), (-0.1, 7.3), (-0.1, 20)), tossed_grains(7))

    def run_all(self, exchanges, ranks, threads=1, **options):
        """{exchange: (frames, rows, builds, log)} of runs in one process."""
        script = "".join(scene(exchange, **options) for exchange in exchanges)
        arguments = ("-pk", "omp", threads) if threads > 1 else ()
        self.run_lammps(script, np=ranks, arguments=arguments,
                        env={"OMP_WAIT_POLICY": "passive"} if threads > 1 else None)
        found = {}
        for exchange in exchanges:
            name = exchange.replace(" ", "-")
            log = self.read("log." + name)
            builds = int(re.search(r"Neighbor list builds = (\d+)", log).group(1))
            self.assertGreater(builds, 5)
            if "check no" not in log:
                self.assertIn("Dangerous builds = 0", log)
            found[exchange] = read_dump(self.path("dump." + name)), thermo(log), builds, log
        return found

    def assert_same(self, found, exchanges, with_sums=True):
        frames, rows, builds, _ = found[exchanges[0]]
        self.assertEqual(len(frames), 4)
        for other in exchanges[1:]:
            for mine, theirs in zip(found[other][0], frames, strict=True):
                self.assert_same_bits(mine, theirs)
            if with_sums and found[other][2] == builds:
                for row, wanted in zip(found[other][1], rows, strict=True):
                    for key, value in wanted.items():    # another order of sums, over pairs or over ranks
                        self.assertLessEqual(abs(row[key] - value),
                                             1e-10 if key[0] == "P" else 1e-13 * abs(value), key)

    def assert_overlapped(self, log, ranks):
        updates, overlapped = re.search(r"Talus exchange: (\d+) updates of proxies, (\d+)", log).groups()
        self.assertGreater(int(updates), STEPS // 2)
        self.assertEqual(updates, overlapped)
        self.assertNotIn("overlap is off", log)
        share = re.search(r"share computed without proxies +(\S+) +(\S+)", log).group(2)
        self.assertGreater(float(share), 0.25)

    def test_walls(self):
        for ranks in 1, 2, 4:
            for law in LAWS if ranks == 2 else ["friction"]:
                with self.subTest(ranks=ranks, law=law):
                    found = self.run_all(list(EXCHANGES), ranks, law=law)
                    self.assert_same(found, list(EXCHANGES))
                    self.assertEqual(found["stock"][2], found["direct"][2])
                    self.assertEqual(found["overlapped"][2], found["blocking"][2])
                    self.assertEqual(found["overlapped"][2], found["no proxies"][2])
                    self.assert_overlapped(found["overlapped"][3], ranks)

    def test_periodic(self):
        for ranks in 1, 2, 4:
            with self.subTest(ranks=ranks):
                found = self.run_all(list(EXCHANGES), ranks, boundary="p p f")
                self.assert_same(found, ["stock", "direct"])
                self.assert_same(found, ["overlapped", "blocking", "no proxies", "automatic"])
                self.assert_overlapped(found["overlapped"][3], ranks)

    def test_any_number_of_ranks(self):
        """Also the schedule of rebuilds."""
        found = {}
        for ranks in 1, 2, 4:
            found[ranks] = self.run_all(["overlapped"], ranks, boundary="p p f")["overlapped"]
        self.assert_same(found, [1, 2, 4], with_sums=False)
        self.assertEqual(found[1][2], found[2][2])
        self.assertEqual(found[1][2], found[4][2])

    def test_threads(self):
        found = self.run_all(["stock", "overlapped"], 2)
        threaded = self.run_all(["overlapped"], 2, threads=2)
        self.assert_same({**found, "threads": threaded["overlapped"]},
                         ["stock", "overlapped", "threads"], with_sums=False)
        self.assert_overlapped(threaded["overlapped"][3], 2)

    def test_rebuild_settings(self):
        chosen = ["overlapped", "blocking"]
        builds = {}
        for rebuild in "every 7 delay 0 check no", "every 2 delay 4 check yes", "every 1 delay 5":
            found = self.run_all(chosen, 2, boundary="p p f", rebuild=rebuild)
            self.assert_same(found, chosen)
            builds[rebuild] = found["overlapped"][2]
        self.assertEqual(builds["every 7 delay 0 check no"], STEPS // 7)

    def test_load_balancing_and_sorting(self):
        chosen = ["stock", "overlapped", "blocking"]
        for middle in "fix even all balance 50 1.0 shift xz 10 1.05", "atom_modify sort 20 0.0":
            found = self.run_all(chosen, 4, middle=middle)
            self.assert_same(found, chosen)

    def test_split_runs(self):
        """Also without set-up in between, and of single steps."""
        whole = self.run_all(["overlapped"], 2)["overlapped"]
        split = scene("overlapped", steps="100\nrun 99 pre no\nrun 1 pre no\nrun 100 pre no")
        self.run_lammps(split, np=2)
        frames = {frame.step: frame for frame in read_dump(self.path("dump.overlapped"))}
        for frame in whole[0]:
            self.assert_same_bits(frames[frame.step], frame)


if __name__ == "__main__":
    unittest.main()
