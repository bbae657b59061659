# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 stay
"""Particles of another program's concern, talus.h: forces, torques, drag and heat by ID against analytic results, in the
records and in the arrays of LAMMPS; the same bits on any ranks and threads; drag impulses and fields that lose nothing;
errors."""

import math
import unittest

from coupled_case import CoupledCase, TWO_CLUMPS
from talus_testing import Sphere, begin, head, write_sphere_data

HEAD = """
import json, math, sys
from lammps import lammps
from talus import Partner, TalusError
words = ["-log", "log.driver", "-screen", "none", "-sf", "talus"]

def scene(text, root=-1):
    global says
    lmp = lammps(cmdargs=words)
    says = lmp.extract_setting("world_rank") == max(root, 0)
    lmp.commands_string(text)
    return lmp, Partner(lmp, root)

def say(result):
    if says:
        with open("said", "w") as file:
            json.dump(result, file)

def refusal(call, *words):
    try:
        call(*words)
    except TalusError as error:
        return str(error)
    return "none"

def as_lists(rows):
    return [[float(x) for x in row] if hasattr(row, "__len__") else float(row) for row in rows]
"""

FREE = head(map=None) + """
{extra}
region all block 0 20 0 20 0 40
create_box 1 all
create_atoms 1 single 5 5 20
create_atoms 1 single 15 5 20
create_atoms 1 single 15 15 20
create_atoms 1 single 5 15 20
set group all diameter 1 density 1
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0 {friction}
timestep 0.001
{move}
thermo {thermo}
"""
G, DT, MASS = 5.0, 0.001, math.pi / 6
GRAVITY = "gravity 5.0 vector 0 0 -1"
# kick of the first step and of the others; part of the last one that comes in the next step
INTEGRATORS = {
    "plain": ("fix step all nve/sphere/symplectic " + GRAVITY, 1.0, 0.0),
    "half": ("fix step all nve/sphere/symplectic start half " + GRAVITY, 0.5, 0.0),
    "order2": ("fix step all nve/sphere/symplectic order 2 " + GRAVITY, 0.5, 0.0),
    "verlet": ("fix weight all " + GRAVITY + "\nfix step all nve/sphere", 0.5, 0.5),
}

# a bed that is stirred by forces, torques and drag on some of its grains, put anew every few steps
BED = begin(boundary="p f f", read="read_data grains", law="hooke 1e4 20 tangential multistep NULL NULL 0.5", skin=0.2, dt=0.001,
            map=None) + """
{move}
fix floor all large/body box 0 0 4 8.2 6 8 inside contact hooke 1e4 20 tangential multistep NULL NULL 0.5
thermo {thermo}
"""
STIR = """
lmp, partner = scene({scene!r}, root={root})
with partner:
    ids, here = partner.ids(), partner.lives_here
    given = [0.0, 0.0, 0.0]
    first = None
    for n in range(20):
        if here:
            some = [int(i) for i in ids if (int(i) + n) % 3]
            force = [[0.2 * math.sin(0.3 * n + i), 0.1, 0.3 * math.cos(i)] for i in some]
            torque = [[0.05, 0.02 * math.cos(0.1 * i), 0.0] for i in some]
            dragged = [int(i) for i in ids if (int(i) + n) % 4]
            c = [10.0 ** (-1 + i % 5) for i in dragged]
            u = [[0.5 * math.sin(i), 0.3, 1.0] for i in dragged]
        else:
            some = force = torque = dragged = c = u = None
        partner.put_forces(some, force, torque)
        partner.put_drag(dragged, c, u)
        partner.advance(17)
    state = [partner.particles(ids, name) for name in ("x", "v", "omega")]
    impulses = partner.drag_impulses(ids)
    say([[[x.hex() for x in row] for row in as_lists(rows)] for rows in [*state, impulses]] if here else None)
lmp.close()
"""


def grains():
    return [Sphere((-3.5 + 1.0 * i, -2.4 + 0.96 * j, 0.5 + 0.97 * k), diameter=0.9 + 0.02 * ((i + j + k) % 5))
            for k in range(3) for j in range(6) for i in range(8)]


class Particles(CoupledCase):

    def drive(self, body, np=1, threads=1):
        """What a Python program says."""
        super().drive(HEAD + body + "lmp.finalize()\n", np=np, env={"OMP_NUM_THREADS": threads})
        return self.read_json("said")

    def log(self):
        return self.read("log.driver")

    def free(self, integrator, thermo=0, friction="tangential multistep NULL NULL 0.5", extra=""):
        return FREE.format(move=INTEGRATORS[integrator][0], thermo=thermo, friction=friction, extra=extra)

    # ---- analytic answers

    def expected(self, integrator, steps, force=(0.0, 0.0, 0.0), c=0.0, u=(0.0, 0.0, 0.0), mass=MASS):
        """Velocity and drag impulse after so many steps from rest, by the rule as doc/coupling.md tells it."""
        _, first, at_end = INTEGRATORS[integrator]
        v, impulse = [0.0] * 3, [0.0] * 3

        def drag(time):
            return [c * (u[d] - v[d] - time * (force[d] / mass - (G if d == 2 else 0.0))) / (1.0 + time * c / mass)
                    for d in range(3)]

        def kick(time, of_drag):
            for d in range(3):
                v[d] += time * ((force[d] + of_drag[d]) / mass - (G if d == 2 else 0.0))
                impulse[d] += time * of_drag[d]

        held = drag(first * DT)
        kick(first * DT, held)
        for _ in range(steps - 1):
            held = drag(DT)
            kick(DT, held)
        if at_end:
            kick(at_end * DT, drag(DT))
        return v, impulse

    def test_free_particles(self):
        """Force, torque, drag that is weak and one of c dt/m = 1000, with each integrator, in the records and the arrays."""
        stiff = 1e3 * MASS / DT
        body = """
result = {}
for name, text in SCENES.items():
    lmp, partner = scene(text)
    with partner:
        ids = partner.ids()
        partner.put_forces([1, 2], [[1, 2, 3], [0.1, 0.2, 0.3]], [[0.5, 0.25, 0], [0, 0, 0]])
        partner.put_drag([2, 3], [2.0, STIFF], [[0, 0.5, 1], [1, 0, 0]])
        partner.advance(40)
        result[name] = [as_lists(partner.particles(ids, "v")), as_lists(partner.particles(ids, "omega")),
                        as_lists(partner.drag_impulses(ids))]
    lmp.close()
say(result)
"""
        scenes = {f"{name} {thermo}": self.free(name, thermo) for name in INTEGRATORS for thermo in (0, 1)}
        result = self.drive(f"SCENES = {scenes!r}\nSTIFF = {stiff!r}\n" + body)
        for name in INTEGRATORS:
            self.assertEqual(result[name + " 0"], result[name + " 1"], "records and arrays")
            v, omega, impulse = result[name + " 0"]
            cases = {1: {"force": (1, 2, 3)}, 2: {"force": (0.1, 0.2, 0.3), "c": 2.0, "u": (0, 0.5, 1)},
                     3: {"c": stiff, "u": (1, 0, 0)}, 4: {}}
            for tag, case in cases.items():
                expected_v, expected_impulse = self.expected(name, 40, **case)
                for d in range(3):
                    self.assertAlmostEqual(v[tag - 1][d], expected_v[d], delta=2e-15 * 40, msg=f"{name} {tag}")
                    self.assertAlmostEqual(impulse[tag - 1][d], expected_impulse[d], delta=2e-15 * 40)
            time = DT * (39 + INTEGRATORS[name][1] + INTEGRATORS[name][2])
            inertia = 0.4 * MASS * 0.25
            for found, torque in zip(omega[0], (0.5, 0.25, 0.0)):
                self.assertAlmostEqual(found, time * torque / inertia, delta=1e-13)
        self.assertIn("in the records", self.log())
        self.assertNotIn("through the arrays", self.log())

    def test_terminal_velocity(self):
        """m g/c below that of the fluid to 1e-12, also with c dt/m = 1000, and of particles that start at any velocity."""
        body = """
lmp, partner = scene(SCENE)
with partner:
    c = [1.0, 20.0, 400.0, 1e3 * MASS / 0.001]
    partner.put_drag([1, 2, 3, 4], c, [[0.3, 0, 0.5]] * 4)
    lmp.command("velocity all set 0.1 -3 2")
    partner.advance(20000)
    say([[x, v] for x, v in zip(c, as_lists(partner.particles([1, 2, 3, 4], "v")))])
lmp.close()
"""
        for name in ("plain", "verlet"):
            text = self.free(name, extra="").replace("0 20 0 20 0 40", "-50 50 -50 50 -500 500")
            for c, v in self.drive(f"SCENE = {text!r}\nMASS = {MASS!r}\n" + body):
                for found, expected in zip(v, (0.3, 0.0, 0.5 - MASS * G / c)):
                    self.assertAlmostEqual(found, expected, delta=1e-12, msg=f"{name}, coefficient {c}")

    def test_held_and_replaced(self):
        """Loads act until they are put again, also none; the same ones put again change nothing."""
        body = """
def run(again, steps=3):
    global lmp
    lmp, partner = scene(SCENE)
    with partner:
        ids = partner.ids()
        for n in range(12 // steps):
            if n == 0 or again:
                partner.put_forces([4, 1], [[1, 2, 3], [-1, 0, 1]])
                partner.put_drag([1, 3, 2], [2.0, 5.0, 7.0], [[0, 0.5, 1]] * 3)
            partner.advance(steps)
        first = as_lists(partner.particles(ids, "v"))
        partner.put_drag()
        partner.put_forces([2], [[0, 0, MASS * 5.0]])
        partner.advance(10)
        second = as_lists(partner.particles(ids, "v"))
    with Partner(lmp) as partner:
        partner.advance(10)
        third = as_lists(partner.particles(ids, "v"))
    lmp.close()
    return first, second, third
say([run(False), run(True), run(False, 12)])
"""
        once, again, whole = self.drive(f"SCENE = {self.free('plain')!r}\nMASS = {MASS!r}\n" + body)
        self.assertEqual(once, whole)
        for rows, others in zip(once, again):
            for row, other in zip(rows, others):
                for a, b in zip(row, other):
                    self.assertAlmostEqual(a, b, delta=1e-14)
        first, second, third = once
        fall = G * 10 * DT
        for tag in (1, 3, 4):
            self.assertAlmostEqual(second[tag - 1][2], first[tag - 1][2] - fall, delta=1e-14)
        self.assertAlmostEqual(second[1][2], first[1][2], delta=1e-14)
        for tag in (1, 2, 3, 4):    # without a partner there are no loads
            self.assertAlmostEqual(third[tag - 1][2], second[tag - 1][2] - fall, delta=1e-14)

    def test_torques_without_friction(self):
        """Steps in the records know no rotation then: such runs go through the arrays while a torque acts."""
        body = """
lmp, partner = scene(SCENE)
with partner:
    partner.put_forces([1], [[1, 0, 0]])
    partner.advance(10)
    partner.put_forces([1], [[1, 0, 0]], [[0, 0.5, 0]])
    partner.advance(10)
    partner.put_forces()
    partner.advance(10)
    say([as_lists(partner.particles([1], name)[0]) for name in ("v", "omega")])
lmp.close()
"""
        v, omega = self.drive(f"SCENE = {self.free('plain', friction='').replace(GRAVITY, '')!r}\n" + body)
        self.assertAlmostEqual(v[0], 20 * DT / MASS, delta=1e-14)
        self.assertAlmostEqual(omega[1], 10 * DT * 0.5 / (0.1 * MASS), delta=1e-14)
        lines = [line for line in self.log().splitlines() if "steps without output" in line]
        self.assertEqual(["in the records" in line for line in lines], [True, False, True])
        self.assertIn("fix TALUS_LOADS (EXTERNAL_LOADS): it turns particles and the contacts between them do not", lines[1])

    def test_another_time_step(self):
        """A new time step between runs, or by fix dt/reset: drag goes with it, and impulses are those that particles got."""
        body = """
lmp, partner = scene(SCENE)
with partner:
    partner.put_drag([1, 2], [20.0, 900.0], [[1.0, 0.5, 0.0]] * 2)
    partner.put_forces([1], [[0.3, 0, 0]])
    partner.advance(5)
    partner.advance(0)
    v = as_lists(partner.particles([1, 2], "v"))
    lmp.command("timestep 0.002")
    partner.advance(1)
    later = as_lists(partner.particles([1, 2], "v"))
    partner.advance(6)
    say([v, later, as_lists(partner.particles([1, 2], "v")), as_lists(partner.drag_impulses([1, 2]))])
lmp.close()
"""
        reset = "fix longer all dt/reset 3 0.0001 0.003 0.0005 units box\n"
        for name, more in (("plain", ""), ("verlet", ""), ("half", ""), ("plain", reset), ("verlet", reset)):
            text = self.free(name).replace(GRAVITY, "gravity 0.0 vector 0 0 -1" if name == "verlet" else "")
            text = text.replace("fix step", more + "fix step")
            v, later, last, impulse = self.drive(f"SCENE = {text!r}\n" + body)
            if not more and name == "plain":
                for k, (c, force) in enumerate(((20.0, 0.3), (900.0, 0.0))):
                    x = 0.002 * c / MASS
                    self.assertAlmostEqual(later[k][0], (v[k][0] + 0.002 * force / MASS + x) / (1 + x), delta=1e-14)
            for k in (0, 1):
                self.assertAlmostEqual(MASS * last[k][1], impulse[k][1], delta=1e-14, msg=name + more)

    def test_heat(self):
        body = """
lmp, partner = scene(SCENE)
with partner:
    partner.put_heat([2, 3], [3.0, -1.0])
    partner.advance(50)
    partner.put_heat()
    partner.advance(50)
    T = dict(zip(lmp.extract_atom("id")[:4], lmp.extract_atom("temperature")[:4]))
    say([T[i] for i in (1, 2, 3, 4)])
lmp.close()
"""
        extra = "fix heated all property/atom temperature heatflow ghost yes"
        text = self.free("plain").replace("set group all", extra + "\nset group all temperature 1.5\nset group all") + \
            "fix warm all heat/flow constant 2.0\n"
        found = self.drive(f"SCENE = {text!r}\n" + body)
        for temperature, flow in zip(found, (0.0, 3.0, -1.0, 0.0)):
            self.assertAlmostEqual(temperature, 1.5 + 50 * DT * flow / (2.0 * MASS), delta=1e-13)

    # ---- bits

    def bed(self, thermo=0, verlet=False):
        return BED.format(move="fix weight all " + GRAVITY + "\nfix step all nve/sphere" if verlet else
                          INTEGRATORS["plain"][0], thermo=thermo)

    def test_same_bits(self):
        """On 1, 2 and 4 ranks, a partner on all or one of them, and 2 threads; in the records and in the arrays."""
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), grains())
        for verlet in (False, True):
            results = {}
            for np, threads, root, thermo in ((1, 1, -1, 0), (1, 1, -1, 1), (1, 2, -1, 0), (2, 1, -1, 0), (4, 1, 2, 0)):
                if verlet and (np, threads) == (4, 1):
                    continue
                text = STIR.format(scene=self.bed(thermo, verlet), root=root)
                results[np, threads, root, thermo] = self.drive(text, np, threads)
                self.assertIn("in the records", self.log())
            first = results[1, 1, -1, 0]
            for key, result in results.items():
                self.assertEqual(result, first, f"verlet {verlet}: ranks, threads, root, thermo {key}")

    def test_saved_loads(self):
        """Restored runs have the loads of the snapshot, with all bits, whatever was put in between; so have impulses."""
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), grains())
        body = """
def put(partner, ids, n):
    some = [i for i in ids if (i + n) % 3]
    partner.put_forces(some, [[0.2 * math.sin(0.3 * n + i), 0.1, 0.3] for i in some], [[0.05, 0.02, 0]] * len(some))
    some = [i for i in ids if (i + n) % 4]
    partner.put_drag(some, [10.0 ** (-1 + i % 5) for i in some], [[0.5 * math.sin(i), 0.3, 1.0] for i in some])
lmp, partner = scene(SCENE)
with partner:
    ids, found = list(partner.ids()), []
    first = partner.save()
    for n in (0, 1):
        put(partner, ids, n)
        partner.advance(30)
    saved = partner.save()
    for change in (False, True, False):
        if change:
            put(partner, ids, 9)
            partner.advance(13)
        partner.restore(saved)
        partner.advance(11)
        put(partner, ids, 2)
        partner.advance(40)
        found.append([as_lists(rows) for rows in partner.particles(ids, "x", "v", "omega")] + [
            as_lists(partner.drag_impulses(ids)), as_lists(partner.field((-4, -4, -1), (4, 4, 9), (1, 1, 1), "exchange")[0][0])])
    partner.restore(first)
    say([found, as_lists(partner.drag_impulses(ids))])
lmp.close()
"""
        for verlet in (False, True):
            results = [self.drive(f"SCENE = {self.bed(verlet=verlet)!r}\n" + body, np) for np in (1, 2)]
            (one, *others), impulses = results[0]
            self.assertEqual(others, [one, one])
            self.assertEqual(results[1], results[0])
            self.assertEqual(impulses, [[0.0] * 3] * len(impulses))

    # ---- what is lost

    def test_momentum(self):
        """Grains that collide in a box without gravity: what drag has given them is what they have got."""
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), grains())
        body = """
lmp, partner = scene(SCENE)
with partner:
    ids = partner.ids()
    m = [float(x) for x in partner.particles(ids, "mass")]
    def momentum():
        v = as_lists(partner.particles(ids, "v"))
        return [math.fsum(m[k] * v[k][d] for k in range(len(m))) for d in range(3)]
    total, taken, of_field = [0.0] * 3, [0.0] * 3, [0.0] * 3
    partner.put_drag(ids, [0.3 + 0.1 * (int(i) % 7) for i in ids], [[0.4 * math.sin(i), 0.3, 0.1 * math.cos(i)] for i in ids])
    lo, hi, cells = (-4, -4, -1), (4, 4, 9), (4, 4, 5)
    worst = 0.0
    for n in range(15):
        partner.advance(23)
        for row in as_lists(partner.drag_impulses(ids)):
            taken = [a + b for a, b in zip(taken, row)]
        field = partner.field(lo, hi, cells, "exchange", width=WIDTH)
        for plane in field:
            for line in plane:
                for cell in as_lists(line):
                    of_field = [a + b * 8.0 for a, b in zip(of_field, cell)]
        now = momentum()
        scale = max(map(abs, now))
        worst = max([worst] + [abs(now[d] - taken[d]) / scale for d in range(3)] +
                    [abs(of_field[d] - taken[d]) / scale for d in range(3)])
    say([worst, now])
lmp.close()
"""
        for name in ("plain", "verlet"):
            move = {"plain": "fix step all nve/sphere/symplectic", "verlet": "fix step all nve/sphere"}[name]
            text = BED.format(move=move, thermo=0)
            text = "\n".join(line for line in text.splitlines() if not line.startswith("fix floor"))
            worst, now = self.drive(f"SCENE = {text!r}\nWIDTH = 2.5\n" + body, np=2 if name == "plain" else 1)
            self.assertLess(worst, 1e-12, name)
            self.assertGreater(now[1], 1.0)

    def test_fields(self):
        """Sums over cells are those over particles inside, to 1e-12; without width by cell; periodic: moved by a cell,
        the field of grains moved by as much; the same bits on two ranks."""
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)),
                          [Sphere(s.x, (0.1 * s.x[1], 1.0, s.x[0] * s.x[2]), diameter=s.diameter) for s in grains()])
        body = """
lmp, partner = scene(SCENE)
def flat(nested):
    for one in nested:
        if hasattr(one, "__len__"):
            yield from flat(one)
        else:
            yield float(one)
with partner:
    ids = partner.ids()
    x, v, m, r = (as_lists(partner.particles(ids, name)) for name in ("x", "v", "mass", "radius"))
    result = []
    for lo, hi, cells, width in (((-4, -4, -1), (4, 4, 9), (4, 5, 5), 0.0), ((-4, -4, -1), (4, 4, 9), (4, 4, 5), 2.5),
                                 ((-2.5, -1, 0.2), (2.5, 2, 2.2), (5, 3, 4), 1.0), ((-2, -4, -1), (6, 4, 9), (4, 4, 5), 2.5),
                                 ((-2.5, -1, 0.2), (2.5, 2, 2.2), (5, 3, 4), 7.0)):
        solid, momentum = partner.field(lo, hi, cells, "solid", "momentum", width=width)
        volume = math.prod((b - a) / n for a, b, n in zip(lo, hi, cells))
        def inside(p):
            q = [(p[0] - lo[0]) % 8.0 + lo[0], p[1], p[2]]
            return all(a <= y <= b for a, y, b in zip(lo, q, hi))
        some = [k for k in range(len(m)) if inside(x[k])]
        expected = [math.fsum(4 / 3 * math.pi * r[k] ** 3 for k in some)] + [math.fsum(m[k] * v[k][d] for k in some)
                                                                             for d in range(3)]
        found = [volume * math.fsum(flat(solid))] + [volume * math.fsum(list(flat(momentum))[d::3]) for d in range(3)]
        result.append([len(some), expected, found, [y.hex() for y in flat(solid)], [y.hex() for y in flat(momentum)]])
        if width == 0.0:
            by_hand = [0.0] * 100
            for k in range(len(m)):
                cell = [int((x[k][d] - lo[d]) / (hi[d] - lo[d]) * cells[d]) for d in range(3)]
                by_hand[(cell[2] * 5 + cell[1]) * 4 + cell[0]] += 4 / 3 * math.pi * r[k] ** 3 / volume
            result.append([list(flat(solid)), by_hand])
    say(result)
lmp.close()
"""
        text = f"SCENE = {BED.format(move='fix step all nve/sphere/symplectic', thermo=0)!r}\n" + body
        result, on_two = self.drive(text), self.drive(text, np=2)
        self.assertEqual(result, on_two)
        for found, expected in zip(*result.pop(1)):
            self.assertAlmostEqual(found, expected, delta=1e-13)
        for count, expected, found, *_ in result:
            self.assertGreater(count, 10)
            for one, other in zip(expected, found):
                self.assertAlmostEqual(one, other, delta=1e-12 * max(map(abs, expected)))
        cells = [[float.fromhex(x) for x in result[k][3]] for k in (1, 3)]
        for n, value in enumerate(cells[0]):    # the grid begins one cell later, along the period
            moved = n - n % 4 + (n - 1) % 4
            self.assertAlmostEqual(value, cells[1][moved], delta=1e-13)

    # ---- other particles

    def test_frozen_and_still(self):
        """Particles that do not move bear drag and stay."""
        text = self.free("plain").replace("fix step all",
                                          "group still id 2\nfix ice still freeze\ngroup rest id 1 4\nfix step rest")
        body = """
lmp, partner = scene(SCENE)
with partner:
    partner.put_drag([2, 3], [2.0, 3.0], [[1, 0, 0], [0, 2, 0]])
    partner.put_forces([2, 3], [[1, 1, 1]] * 2, [[1, 1, 1]] * 2)
    partner.advance(10)
    say([as_lists(partner.particles([2, 3], "v")), as_lists(partner.drag_impulses([2, 3]))])
lmp.close()
"""
        for thermo in (0, 1):
            v, impulse = self.drive(f"SCENE = {text.replace('thermo 0', f'thermo {thermo}')!r}\n" + body)
            self.assertEqual(v, [[0.0] * 3] * 2)
            for found, expected in zip(impulse, ([10 * DT * 2.0, 0, 0], [0, 10 * DT * 6.0, 0])):
                for a, b in zip(found, expected):
                    self.assertAlmostEqual(a, b, delta=1e-15)

    def test_shapes(self):
        """Convex particles bear loads as spheres do."""
        text = FREE.format(extra="", friction="tangential multistep NULL NULL 0.5", thermo=0, move="""
fix shapes all shape/gran type 1 box 0.8 0.7 0.6 density 1 orient random 11
fix weight all """ + GRAVITY)
        body = """
lmp, partner = scene(SCENE)
with partner:
    partner.put_forces([1], [[0, 0, 1]], [[0, 0.01, 0]])
    partner.put_drag([1, 2], [2.0, 500.0], [[1, 0, 0], [0, 0.5, 1]])
    partner.advance(40)
    say([as_lists(partner.particles([1, 2], name)) for name in ("v", "mass", "omega")] + [as_lists(partner.drag_impulses([1, 2]))])
lmp.close()
"""
        v, mass, omega, impulse = self.drive(f"SCENE = {text!r}\n" + body)
        self.assertIn("in the records", self.log())
        self.assertGreater(abs(omega[0][1]), 0.01)
        self.assert_close(mass[0], 0.8 * 0.7 * 0.6, 1e-12)
        cases = {"force": (0, 0, 1), "c": 2.0, "u": (1, 0, 0)}, {"c": 500.0, "u": (0, 0.5, 1)}
        for k, case in enumerate(cases):
            expected_v, expected_impulse = self.expected("plain", 40, mass=mass[k], **case)
            for d in range(3):
                self.assertAlmostEqual(v[k][d], expected_v[d], delta=1e-13)
                self.assertAlmostEqual(impulse[k][d], expected_impulse[d], delta=1e-13)

    def clumps(self, move, thermo):
        return TWO_CLUMPS.format(move=move, thermo=thermo)

    def test_clumps(self):
        """Two clumps of two spheres: one sinks with drag on both, the other one is turned by torques. With velocity Verlet the
        first half kick is without loads."""
        body = """
result = {}
for name, text in SCENES.items():
    lmp, partner = scene(text)
    with partner:
        refused = refusal(partner.put_drag, [1, 3], [1.0, 0.6 / 0.001], [[0, 0, 0]] * 2)
        partner.put_drag([1, 2], [3.0, 3.0], [[0, 0, 1.0]] * 2)
        partner.put_forces([3, 4], None, [[0, 0.01, 0], [0, 0.02, 0]])
        partner.advance(40)
        result[name] = [as_lists(partner.particles([1, 2, 3, 4], what)) for what in ("v", "omega")] + [
            as_lists(partner.drag_impulses([1, 2])), refused]
    lmp.close()
say(result)
"""
        moves = {"symplectic": "fix move all rigid/small/symplectic molecule " + GRAVITY,
                 "verlet": f"fix weight all {GRAVITY}\nfix move all rigid/small molecule",
                 "stock": f"fix weight all {GRAVITY}\nsuffix off\nfix move all rigid/small molecule"}
        scenes = {f"{name} {thermo}": self.clumps(move, thermo) for name, move in moves.items() for thermo in (0, 1)}
        result = self.drive(f"SCENES = {scenes!r}\n" + body)
        mass, c, u, inertia = 0.5, 3.0, 1.0, 2 * (0.4 * 0.5 * 0.25 + 0.5 * 0.16)
        for name in moves:
            self.assertEqual(result[name + " 0"], result[name + " 1"], name)
            v, omega, impulses, refused = result[name + " 0"]
            self.assertTrue(refused.startswith("talus_put_drag: particle 3 belongs to a clump"), refused)
            sinks, impulse, drag = 0.0, 0.0, 0.0
            time = 40 * DT
            for _ in range(40):
                if name == "symplectic":
                    drag = 2 * c * (u - sinks)
                    sinks += DT * (drag / (2 * mass) - G)
                    impulse += DT * drag
                else:
                    sinks += 0.5 * DT * (drag / (2 * mass) - G)
                    impulse += 0.5 * DT * drag
                    drag = 2 * c * (u - sinks)
                    sinks += 0.5 * DT * (drag / (2 * mass) - G)
                    impulse += 0.5 * DT * drag
            if name != "symplectic":
                time -= 0.5 * DT
            for k in (0, 1):
                self.assertAlmostEqual(v[k][2], sinks, delta=1e-13, msg=name)
                self.assertAlmostEqual(impulses[k][2], 0.5 * impulse, delta=1e-13, msg=name)
            for k in (2, 3):
                self.assertAlmostEqual(omega[k][1], time * 0.03 / inertia, delta=1e-12, msg=name)

    def test_fixes_that_come_later(self):
        """Loads act after them; what is deleted takes its loads along."""
        body = """
lmp, partner = scene(SCENE)
with partner:
    partner.put_forces([1, 2, 3, 4], [[0, 0, 1]] * 4)
    partner.put_drag([1, 3], [1.0] * 2, [[1.0, 0, 0]] * 2)
    partner.advance(5)
    lmp.command("fix late all setforce 0 0 0")
    lmp.command("group out id 2 3")
    lmp.command("delete_atoms group out compress no")
    partner.set_up()
    before = as_lists(partner.particles([1, 4], "v"))
    partner.advance(5)
    say([before, as_lists(partner.particles([1, 4], "v")), refusal(partner.drag_impulses, [3])])
lmp.close()
"""
        before, after, refused = self.drive(f"SCENE = {self.free('plain').replace(GRAVITY, '')!r}\n" + body, np=2)
        self.assertAlmostEqual(after[1][2] - before[1][2], 5 * DT / MASS, delta=1e-15)
        self.assertAlmostEqual(1 - after[0][0], (1 - before[0][0]) / (1 + DT / MASS) ** 5, delta=1e-15)
        self.assertEqual(refused, "talus_get_drag_impulses: there is no particle 3")

    # ---- errors

    def test_errors(self):
        body = """
lmp, partner = scene(SCENE, root=ROOT)
me = lmp.extract_setting("world_rank")
def only(*given):
    return given if partner.lives_here else [()] * len(given)
with partner:
    partner.advance(2)
    nan = float("nan")
    say([
        refusal(partner.put_forces, *only([1, 99], [[0, 0, 0]] * 2)),
        refusal(partner.put_drag, *only([3, 1, 3], [1, 1, 1], [[0, 0, 0]] * 3)),
        refusal(partner.put_drag, *only([3], [0.0], [[0, 0, 0]])),
        refusal(partner.put_drag, *only([3], [1.0], [[0, nan, 0]])),
        refusal(partner.put_heat, *only([3], [1.0])),
        refusal(partner.put_forces, *only([1, 2, 3, 4, 5], [[0, 0, 0]] * 5)),
        refusal(partner.drag_impulses, *only([98])),
        refusal(lambda: partner.field((0, 0, 0), (20, 20, 40), (10, 10, 10), "solid", width=1.0)),
        refusal(lambda: partner.field((0, 0, 0), (20, 20, 40), (10, 0, 10), "solid")),
        refusal(lambda: partner.field((0, 30, 0), (20, 20, 40), (10, 10, 10), "solid")),
        refusal(lambda: partner.put_forces([1] if partner.lives_here else ())),
    ])
    partner.put_drag(*only([3], [1.0], [[0, 0, 0]]))
    partner.advance(2)
lmp.close()
"""
        respa = self.free("verlet").replace("fix step", "suffix off\nfix step").replace(
            "gran/penalty", "gran/hooke 1e3 NULL 0 NULL 0 0").replace("hooke 1e3 0 tangential multistep NULL NULL 0.5", "") + "run_style respa 2 2\n"
        said = self.drive(f"SCENE = {respa!r}\n" + """
lmp, partner = scene(SCENE)
with partner:
    partner.put_forces([1], [[0, 0, 1]])
    say(refusal(partner.advance, 1))
lmp.close()
""")
        self.assertIn("do not act with run_style respa: use run_style verlet", said)
        expected = ["talus_put_forces: there is no particle 99", "talus_put_drag: particle 3 is given twice",
                    "talus_put_drag: coefficient[0] of particle 3 is 0, expected more than 0",
                    "talus_put_drag: fluid_velocity[1] is no finite number",
                    "talus_put_heat: particles have no temperature", "talus_put_forces: n is 5, expected 0 to 4",
                    "talus_get_drag_impulses: there is no particle 98",
                    "talus_get_field: width is 1, less than the edge 2 of cells along x",
                    "talus_get_field: cells along y are 0", "talus_get_field: hi is not larger than lo along y",
                    "talus_put_forces: force and torque are both NULL"]
        for np, root in ((1, -1), (2, -1), (2, 0)):
            found = self.drive(f"SCENE = {self.free('plain')!r}\nROOT = {root}\n" + body, np)
            for text, beginning in zip(found, expected):
                self.assertTrue(text.startswith(beginning), f"{text!r} instead of {beginning!r}")


if __name__ == "__main__":
    unittest.main()
