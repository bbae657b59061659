# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 stay
"""gran/penalty with coefficients by type, under hybrid styles, with the omp suffix, in two dimensions, and
with commands between two runs: against the stock style with the same law, on 2 ranks."""

import unittest

from grain_bed import BED, FREEZE, MOTION, STOCK, TALUS, BedCase, grains
from talus_testing import Sphere, write_sphere_data


class Variants(BedCase):
    """The same bed with other laws, other sub-styles, another way to run."""

    def compare(self, stock, talus, commands=BED, **options):
        expected = self.simulate(stock, commands, **options)
        self.assert_same_motion(self.simulate(talus, commands, **options), expected)

    def test_coefficients_by_type(self):
        kinds = {(1, 1): "3000.0 {k} 20.0 {g} 0.5", (1, 2): "4000.0 {k} 30.0 {g} 0.1",
                 (2, 2): "5000.0 {k} 40.0 {g} 0.3"}
        stock = "pair_style hybrid" + "".join(
            f" gran/hooke/history {words.format(k='NULL', g='NULL')} 1" for words in kinds.values())
        for n, types in enumerate(kinds, start=1):
            stock += f"\npair_coeff {types[0]} {types[1]} gran/hooke/history {n}"
        talus = "pair_style gran/penalty"
        for (i, j), words in kinds.items():
            kn, kt, gn, gt, mu = words.format(k="NULL", g="NULL").split()
            talus += f"\npair_coeff {i} {j} hooke {kn} {gn} tangential multistep {kt} {gt} {mu}"
        self.compare(stock, talus)
        # 1 2 from 1 1 and 2 2: arithmetic mean, friction by the rule
        for rule, mu in (("min", 0.3), ("arithmetic", 0.4), ("geometric", 0.15 ** 0.5)):
            lines = talus.splitlines()
            mixed = "\n".join([lines[0] + " mix " + rule, lines[1], lines[3]])
            self.compare(stock.replace("0.1 1", f"{mu!r} 1"), mixed)

    def test_different_laws_in_one_scene(self):
        """hertz between grains, frictionless hooke with the base."""
        self.compare("pair_style hybrid gran/hertz/history 9000.0 NULL 20.0 NULL 0.5 1 "
                     "gran/hooke 3000.0 NULL 20.0 0.0 0.0 0\npair_coeff * 2 gran/hooke\n"
                     "pair_coeff 1 1 gran/hertz/history",
                     "pair_style gran/penalty\npair_coeff * 2 hooke 3000.0 20.0\n"
                     "pair_coeff 1 1 hertz 9000.0 20.0 tangential multistep NULL NULL 0.5")

    def test_pressure_units(self):
        """In units whose pressure is not force/distance^2, hertz converts kn and kt as the stock style.  Where
        force is not mass acceleration either, its damping is right; that of the stock style lacks a factor."""
        factor = 48.88821291**2    # mass acceleration in units of force
        self.compare(f"pair_style gran/hertz/history 6.0e8 4.0e8 {20 * factor!r} {10 * factor!r} 0.5 1\n"
                     "pair_coeff * *",
                     "pair_style gran/penalty\n"
                     "pair_coeff * * hertz 6.0e8 20.0 tangential multistep 4.0e8 10.0 0.5",
                     before="units real")

    def test_hybrid_overlay(self):
        soft = "soft 1.2\npair_coeff * * soft 5.0"
        stock = STOCK.replace("gran", "hybrid/overlay gran", 1).replace("* *", "* * gran/hooke/history")
        talus = TALUS.replace("gran", "hybrid/overlay gran", 1).replace("* *", "* * gran/penalty")
        self.compare(stock, talus)
        with_soft = [pair.replace("\n", f" {soft}\n", 1) for pair in (stock, talus)]
        self.compare(*with_soft)
        soft_first = [pair.replace("overlay ", f"overlay soft 1.2 ", 1) + "\npair_coeff * * soft 5.0"
                      for pair in (stock, talus)]
        self.compare(*soft_first)

    def test_omp_suffix(self):
        expected = self.simulate(STOCK, BED)
        found = self.simulate(TALUS, BED, arguments=("-sf", "omp", "-pk", "omp", "2"),
                              env={"OMP_NUM_THREADS": 2})
        self.assert_same_motion(found, expected)

    def test_two_dimensions(self):
        flat = [Sphere((x.x[0], x.x[2], 0), (x.v[0], x.v[2], 0), (0, 0, x.omega[2]), x.diameter,
                       type=x.type) for x in grains() if x.x[1] < 1]
        write_sphere_data(self.path("grains"), ((0, 6), (-2, 14), (-0.5, 0.5)), flat)
        self.compare(STOCK, TALUS, f"{BED}\nfix flat all enforce2d", before="dimension 2",
                     boundary="p f p")


class BetweenRuns(BedCase):
    """Commands between two runs; the history of contacts that stay must stay."""

    MOVE = f"fix step grains nve/sphere/symplectic\n{FREEZE}\nneigh_modify exclude group base base\n"
    DELETE = "group gone id 5:250:6\ngroup gone intersect gone grains\ndelete_atoms group gone"

    def in_place(self, pair, between):
        """Motion by place in space, so that IDs do not matter."""
        frame = self.simulate(pair, f"{self.MOVE}run 30\n{between}", steps=60)
        k = [frame.columns.index(c) for c in MOTION]
        return sorted(tuple(row[n] for n in k) for row in frame.atoms.values())

    def difference(self, run, other):
        self.assertEqual(len(run), len(other))
        return max(abs(a - b) for row, twin in zip(run, other) for a, b in zip(row, twin))

    def check(self, between, stock_between):
        expected = self.in_place(STOCK, stock_between)
        self.assertLess(self.difference(self.in_place(TALUS, between), expected), 1e-9)
        lost = self.in_place(TALUS, f"{between}\npair_style none\nrun 0\n{TALUS}")
        self.assertGreater(self.difference(lost, expected), 1e-4)    # the test can tell

    def test_delete_atoms(self):
        """The stock style loses history with `compress yes`, the default."""
        stock = self.DELETE + " compress no"
        self.check(stock, stock)
        self.check(self.DELETE, stock)

    def test_reset_atoms_id(self):
        self.check("reset_atoms id sort yes", "")
        self.check("reset_atoms id", "")

    def test_commands_that_move_particles_between_ranks(self):
        for between in ("balance 1.0 z 0.4", "run 0", "write_restart r", "write_data d",
                        "set type 1 density 1.0", "change_box all boundary p p f"):
            with self.subTest(between):
                self.check(between, "")

    def test_another_pair_style_and_back(self):
        """History ends with the style; nothing of it comes back."""
        other = STOCK.replace("hooke/history", "hooke")
        frames = [self.in_place(pair, f"{other}\nrun 10\n{pair}") for pair in (STOCK, TALUS)]
        self.assertLess(self.difference(*frames), 1e-9)

    def test_another_law_and_back(self):
        none = "pair_coeff * * hooke 3000.0 20.0"
        with_law = self.in_place(TALUS, f"{none}\nrun 10\n{TALUS.splitlines()[1]}")
        with_style = self.in_place(TALUS, f"{none}\nrun 10\npair_style none\nrun 0\n{TALUS}")
        self.assertLess(self.difference(with_law, with_style), 1e-9)


if __name__ == "__main__":
    unittest.main()
