# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=240 cost=15
"""What the page on heat says can be done with commands of LAMMPS: sources of heat, radiation, grains that grow with their temperature;
and walls of LAMMPS with a temperature."""

import math
import unittest

from heat_row import AT_WALL, BETWEEN, CAPACITY, CONDUCTIVITY, COUNT, DIAMETER, LAW, LENGTH, HeatRowCase
from talus_testing import SceneCase, Sphere, head, read_dump, thermo, write_sphere_data

SOURCE = 8e6    # power over volume
POWER = SOURCE * math.pi / 6 * DIAMETER**3
SOURCES = {"equal": f"fix source all add/heat constant {POWER!r}",
           "atom": f"variable q atom {SOURCE}*4/3*PI*radius^3\nfix source all add/heat constant v_q"}


# steps are made in the records where it moves something; here it would be nobody
INTEGRATOR = "group nobody empty\nfix step nobody nve/sphere/symplectic"


class Sources(HeatRowCase):

    def test_all_heat_arrives_at_the_walls(self):
        """Temperatures of a row of resistances, which lie on a parabola."""
        out = COUNT / 2 * POWER
        expected = [out / AT_WALL]
        for k in range(1, COUNT // 2):
            expected.append(expected[-1] + (out - k * POWER) / BETWEEN)
        expected += expected[::-1]
        middle = (COUNT - 1) / 2
        bent = [t + POWER / (2 * BETWEEN) * (k - middle)**2 for k, t in enumerate(expected)]
        self.assertLess(max(bent) - min(bent), 1e-12 * bent[0])
        for name, source in SOURCES.items():
            with self.subTest(name):
                frames, rows = self.heat(self.planes("temperature 0", "temperature 0") + source)
                self.assertAlmostEqual((rows[-1]["f_lo[21]"] + rows[-1]["f_hi[21]"]) / (COUNT * POWER), 1, delta=1e-9)
                for found, value in zip(frames[-1], expected, strict=True):
                    self.assertAlmostEqual(found, value, delta=1e-8 * value)

    def test_steps_stay_in_the_records(self):
        first = None
        for source, where in ("equal", "in the records"), ("atom", "variable q reads more than time"):
            for np in 1, 2:
                frames, _ = self.heat("\n".join([INTEGRATOR, self.planes("temperature 0", "temperature 0"), SOURCES[source]]), np=np,
                                      steps=500, every=500, rows=500)
                self.assertRegex(self.read("log.script"), f"steps without output .*{where}")
                first = first or frames
                if source == "equal":
                    self.assertEqual(frames, first)
                for one, other in zip(frames[-1], first[-1], strict=True):
                    self.assertAlmostEqual(one, other, delta=1e-9 * other)


WALLS = """
fix lo all wall/gran{suffix} granular {law} xplane 0 NULL temperature {lo}
fix hi all wall/gran{suffix} granular {law} xplane NULL {length!r} temperature {hi}
"""
# the words of pair granular for the same contacts
GRANULAR = f"hertz/material 1e6 0.9 0.3 tangential linear_nohistory 0 0 heat radius {CONDUCTIVITY}"
STOCK = f"pair_style granular\npair_coeff * * {GRANULAR}"


class WallsOfLammps(HeatRowCase):

    def walls(self, suffix, lo, hi):
        integrator = INTEGRATOR if suffix else ""
        return integrator + WALLS.format(suffix=suffix, law=GRANULAR, lo=lo, hi=hi, length=LENGTH)

    def test_between_two_temperatures(self):
        _, expected = self.steady(50.0, 10.0)
        for np in 1, 2:
            frames, _ = self.heat(self.walls("/talus", 50, 10), columns="ke", np=np)
            self.assertRegex(self.read("log.script"), "steps without output .*in the records")
            for found, value in zip(frames[-1], expected, strict=True):
                self.assertAlmostEqual(found, value, delta=1e-8)

    def test_steered_as_in_stock(self):
        """One wall becomes warmer."""
        steered = "variable warm equal 20+3*step*dt\n"
        options = {"columns": "ke", "steps": 400, "every": 100, "rows": 400, "start": 20.0}
        stock, _ = self.heat(steered + self.walls("", "v_warm", 10), pair=STOCK, **options)
        frames, _ = self.heat(steered + self.walls("/talus", "v_warm", 10), **options)
        self.assertRegex(self.read("log.script"), "steps without output .*in the records")
        self.assertGreater(stock[-1][0], 22.0)
        for one, other in zip(frames, stock, strict=True):
            for found, expected in zip(one, other, strict=True):
                self.assertAlmostEqual(found, expected, delta=1e-9)


class Radiation(SceneCase):

    def test_a_sphere_cools_in_the_cold(self):
        """m c dT/dt = -sigma A T^4."""
        radius, density, sigma = 1e-3, 2500.0, 5.670374e-8
        write_sphere_data(self.path("data"), ((-0.01, 0.01),) * 3, [Sphere((0, 0, 0), diameter=2 * radius, density=density)])
        self.run_lammps(head("si") + f"""
fix therm all property/atom temperature heatflow ghost yes
read_data data
pair_style gran/penalty
pair_coeff * * {LAW}
neighbor 0.001 bin
timestep 0.001
set group all temperature 1000
fix sky all add/heat quartic 0 {4 * math.pi * radius**2 * sigma!r}
fix heat all heat/flow constant {CAPACITY}
compute t all property/atom temperature
dump grains all custom 10000 grains id c_t
dump_modify grains format float %.17g
run 10000
""")
        mass = density * 4 / 3 * math.pi * radius**3
        rate = 4 * math.pi * radius**2 * sigma / (mass * CAPACITY)
        expected = (1000**-3 + 3 * rate * 10.0)**(-1 / 3)
        self.assertLess(expected, 800)
        self.assertAlmostEqual(read_dump(self.path("grains"))[-1].column("c_t")[1] / expected, 1, delta=1e-4)


GROWING = head("si", "f p p") + """
fix therm all property/atom temperature heatflow ghost yes
fix cold all property/atom d_cold
read_data data
pair_style {style}
pair_coeff * * {law} tangential linear_nohistory 0 0 heat radius 3000
neighbor 0.001 bin
timestep 1e-4
set group all temperature 300
variable diameter atom 2*radius
set group all d_cold v_diameter
{walls}
fix heat all heat/flow type 300 600
compute t all property/atom temperature
variable grown atom d_cold*(1+1e-4*(c_t-300))
compute mean all reduce ave c_t
thermo_style custom step c_mean
thermo 1000
run 2000 every 100 "set group all diameter v_grown"
write_dump all custom grains id radius mass c_t modify format float %.17g sort id
"""


class Growth(SceneCase):
    """Grains clamped between two warm walls, which are held in place: the force is that of the overlap that their growth makes."""

    LENGTH = 2 * 5e-3 - 2e-5

    def grow(self, suffix, **options):
        # of two types that warm at different rates, and do not touch
        grains = [Sphere((self.LENGTH / 2, y, 0.02), type=kind, diameter=0.01, density=2500.0)
                  for kind, y in ((1, 0.01), (2, 0.03))]
        write_sphere_data(self.path("data"), ((-0.01, self.LENGTH + 0.01), (0, 0.04), (0, 0.04)), grains)
        words = "hertz/material 1e7 0.9 0.3 tangential linear_nohistory 0 0 heat radius 3000"
        walls = f"""
fix lo all wall/gran granular {words} xplane 0 NULL temperature 400
fix hi all wall/gran granular {words} xplane NULL {self.LENGTH!r} temperature 400
fix move all nve/sphere
"""
        self.run_lammps(GROWING.format(style="granular", law="hertz/material 1e7 0.9 0.3", walls=walls),
                        arguments=suffix, **options)
        (frame,) = read_dump(self.path("grains"))
        return frame

    def test_grains_grow_with_their_temperature(self):
        stock = self.grow(())
        for np in 1, 2:
            with self.subTest(ranks=np):
                frame = self.grow(("-sf", "talus"), np=np)
                for i, radius in frame.column("radius").items():
                    warm = frame.column("c_t")[i]
                    self.assertGreater(warm, 310)
                    self.assertAlmostEqual(radius / 5e-3, 1 + 1e-4 * (warm - 300), delta=3e-4)    # 100 steps before
                    self.assertGreater(radius / 5e-3, 1.004)
                    self.assertAlmostEqual(radius / stock.column("radius")[i], 1, delta=1e-10)
                    self.assertAlmostEqual(warm / stock.column("c_t")[i], 1, delta=1e-10)
                    self.assertEqual(frame.column("mass")[i], stock.column("mass")[i])
                self.assertNotAlmostEqual(frame.column("radius")[1], frame.column("radius")[2], delta=1e-7)


if __name__ == "__main__":
    unittest.main()
