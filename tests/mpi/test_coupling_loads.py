# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 cost=15 stay
"""Loads of large bodies between exchanges: the momentum that grains lose is what the body gets, to 1e-12, with every
integrator and motion, the same bits on 1, 2 and 4 ranks; angular impulses about a point; work; time."""

import math
import random
import unittest

from coupled_case import CoupledCase
from talus_testing import Sphere, begin, head, read_dump, write_sphere_data
from tossed_clumps import write_clumps

SCENE = begin(read="read_data grains", law="hooke 1e3 {damping} limit_damping", skin=0.3, dt="{dt}") + """
{integrator}
{more}
fix body all large/body box 0 0 0 4 4 4 inside contact hooke 1e3 {damping} limit_damping {friction} {move}
fix_modify body energy yes
variable mass equal mass(all)
variable px equal vcm(all,x)*mass(all)
variable py equal vcm(all,y)*mass(all)
variable pz equal vcm(all,z)*mass(all)
variable energy equal pe+ke
thermo_modify norm no
thermo 0
"""

MULTISTEP = "tangential multistep NULL 0 0.5"
INTEGRATORS = {
    "plain": "fix step all nve/sphere/symplectic start plain",
    "half": "fix step all nve/sphere/symplectic start half",
    "order 2": "fix step all nve/sphere/symplectic order 2",
    "verlet": "fix step all nve/sphere/talus",
    "stock": "fix step all nve/sphere",
    "shapes": "fix shapes all shape/gran type 1 box 0.7 0.6 0.5 density 1 orient random 11",
}
CLUMPS = head() + """
fix prop all property/atom mol ghost yes
read_data clumps fix prop NULL Molecules
group clumps molecule > 0
group singles subtract all clumps
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra clumps
pair_style gran/penalty
pair_coeff * * hooke 1e3 1 limit_damping
fix body all large/body box 4.5 4.5 4.5 9 9 9 inside contact hooke 1e3 1 limit_damping move external
fix move clumps {clumps}
fix single singles {singles}
timestep 0.001
variable px equal vcm(all,x)*mass(all)
variable py equal vcm(all,y)*mass(all)
variable pz equal vcm(all,z)*mass(all)
thermo_style custom step
thermo 0
"""
CLUMP_INTEGRATORS = {
    "plain": ("rigid/small/symplectic molecule start plain", "nve/sphere/symplectic start plain"),
    "half": ("rigid/small/symplectic molecule start half", "nve/sphere/symplectic start half"),
    "verlet": ("rigid/small/talus molecule", "nve/sphere/talus"),
    "stock": ("rigid/small molecule", "nve/sphere"),
}
MOTIONS = {
    "none": "",
    "external": "move external",
    "wiggle": "move wiggle 0.05 0 0.02 0.5",
    "free": "move free mass 20 inertia 30 30 30",
    "servo": "servo force 0 0 1 5 0.2",
}

# exchanges every EVERY steps; a body that is steered is a mass that moves by what it gets
LEDGER = """
import json, math, sys
from lammps import lammps
from talus import Partner
scene, out, every, exchanges, root, set_ups = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:7])
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(open(scene).read())
def told(*names):
    return [lmp.extract_variable(name) for name in names]
rows, mass, steered = [], 20.0, "move external" in open(scene).read()
with Partner(lmp, root) as partner:
    body = partner.body("body")
    body.watch()
    partner.advance(0)
    state, start = body.state, told("px", "py", "pz")
    for n in range(exchanges):
        if n == 10:
            lmp.command("timestep $(dt*0.75)")
        if set_ups and n % set_ups == 0:
            partner.set_up()
        partner.advance(every)
        load = body.load()
        if load:
            rows.append([x.hex() for x in (*load.impulse, *load.angular_impulse, load.work, load.time)])
        if steered:
            if load:
                for k in range(3):
                    state[7 + k] += load.impulse[k] / mass
                    state[k] += every * partner.dt * state[7 + k]
            body.put_state(state, every)
        momentum = told("px", "py", "pz")
        if load:
            rows[-1] += momentum + [every * partner.dt]
if lmp.extract_setting("world_rank") == max(root, 0):
    with open(out, "w") as file:
        json.dump([start, rows], file)
lmp.finalize()
"""

# in every step, from the outputs of the fix: what the sums have to be. first, before, after: for how long a load acts in the
# first step, in the others, and at the end of its own, over the time step
TWIN = """
import json, math, sys
from lammps import lammps
from talus import Partner
scene, out, every, exchanges = sys.argv[1], sys.argv[2], *map(int, sys.argv[3:5])
first, before, after = map(float, sys.argv[5:8])
POINT = 0.3, -0.2, 0.5
def instance():
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    lmp.commands_string(open(scene).read())
    return lmp
def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]
def turned(q, a):
    w, u = q[0], q[1:]
    t = [2*x for x in cross(u, a)]
    return [x + w*y + z for x, y, z in zip(a, t, cross(u, t))]
def target(n):
    t, a = n * every * 1e-3, 0.4 * n * every * 1e-3
    return [0.02*math.sin(9*t), 0.1*t, 0, math.cos(a/2), 0, math.sin(a/2)*0.6, math.sin(a/2)*0.8, 0.18*math.cos(9*t), 0.1, 0,
            0, 0.24, 0.32]
def rates(lmp):
    v = [lmp.extract_fix("body", 0, 1, k, 0) for k in range(19)]
    f, t, q, u, w = v[0:3], v[3:6], v[9:13], v[13:16], v[16:19]
    about = [x - y for x, y in zip(t, cross(turned(q, POINT), f))]
    return f + about + [sum(a*b for a, b in zip(f, u)) + sum(a*b for a, b in zip(t, w))]
steered = "move external" in open(scene).read()
lmp = instance()
found = []
with Partner(lmp) as partner:
    body = partner.body("body")
    body.watch(POINT)
    for n in range(exchanges):
        if steered:
            body.put_state(target(n + 1), every)
        partner.advance(every)
        load = body.load()
        found.append([*load.impulse, *load.angular_impulse, load.work, load.time])
lmp.close()
lmp = instance()
expected = []
with Partner(lmp) as partner:
    body = partner.body("body")
    partner.advance(0)
    now = rates(lmp)
    for n in range(exchanges):
        if steered:
            body.put_state(target(n + 1), every)
        sums = [[] for _ in range(7)]
        for step in range(every):
            last, share = now, before if n or step else first
            partner.advance(1)
            now = rates(lmp)
            for k in range(7):
                sums[k] += [partner.dt * share * last[k], partner.dt * after * now[k]]
        expected.append([math.fsum(one) for one in sums] + [every * partner.dt])
with open(out, "w") as file:
    json.dump([found, expected], file)
lmp.finalize()
"""

# a body at rest about whose reference point grains turn: [angular momentum of grains + angular impulses, flow]
TURNING = """
import json, math, sys
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(open(sys.argv[1]).read())
def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]
def angular_momentum():
    x, v, w, m, r = map(lmp.extract_atom, ("x", "v", "omega", "rmass", "radius"))
    parts = [[], [], []]
    for i in range(lmp.extract_global("nlocal")):
        for k, one in enumerate(cross(x[i][:3], v[i][:3])):
            parts[k] += [m[i]*one, 0.4*m[i]*r[i]*r[i]*w[i][k]]
    return [math.fsum(one) for one in parts]
sums, flow, rows = [0.0]*3, 0.0, []
with Partner(lmp) as partner:
    body = partner.body("body")
    body.watch()
    partner.advance(0)
    for n in range(40):
        rows.append([a + b for a, b in zip(angular_momentum(), sums)])
        partner.advance(7)
        given = body.load().angular_impulse
        sums = [a + b for a, b in zip(sums, given)]
        flow += math.hypot(*given)
json.dump([rows, flow], open(sys.argv[2], "w"))
lmp.finalize()
"""

# a box without losses that a partner shakes, with grains that do not touch each other: the largest change of the energy of grains and contacts together with the work
WORK = """
import json, math, sys
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(open(sys.argv[1]).read())
every = int(sys.argv[3])
worst = flow = given = 0.0
with Partner(lmp) as partner:
    body = partner.body("body")
    body.watch()
    partner.advance(0)
    first = lmp.extract_variable("energy")
    while partner.time < 0.3:
        t = partner.time + every*partner.dt
        body.put_state([0.05*(1 - math.cos(20*t)), 0, 0.01*(1 - math.cos(30*t)), 1, 0, 0, 0, math.sin(20*t), 0,
                        0.3*math.sin(30*t), 0, 0, 0], every)
        partner.advance(every)
        work = body.load().work
        given, flow = given + work, flow + abs(work)
        worst = max(worst, abs(lmp.extract_variable("energy") + given - first))
json.dump([worst, flow], open(sys.argv[2], "w"))
lmp.finalize()
"""

# state of all particles after some steps, with a body that is watched or not
WATCHED = """
import sys
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(open(sys.argv[1]).read())
with Partner(lmp) as partner:
    if sys.argv[2] == "yes":
        partner.body("body").watch()
    for n in range(5):
        partner.advance(40)
lmp.command(f"write_dump all custom {sys.argv[2]} id x y z vx vy vz omegax omegay omegaz modify format float %a")
lmp.finalize()
"""


def grains(n=3, spin=0.0, seed=3):
    draw = random.Random(seed)
    places = [1.56 * (k - 0.5 * (n - 1)) for k in range(n)]
    return [Sphere((x, y, z), tuple(draw.gauss(0, 4.0) for _ in "xyz"), tuple(draw.gauss(0, spin) for _ in "xyz"),
                   diameter=draw.uniform(0.8, 1.0)) for z in places for y in places for x in places]


class Loads(CoupledCase):

    def scene(self, integrator, move, damping=1, friction=MULTISTEP, dt=1e-3, more=""):
        name = "in.scene"
        self.write(name, SCENE.format(integrator=INTEGRATORS[integrator], move=MOTIONS[move], damping=damping,
                                      friction=friction, dt=dt, more=more))
        return name

    def setUp(self):
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-4, 4)), grains())

    def ledger(self, name, np=1, every=7, exchanges=40, root=-1, set_ups=17):
        """(rows of loads as text, largest drift of the sum of momenta over the flow, flow)."""
        self.drive(LEDGER, name, "rows", every, exchanges, root, set_ups, np=np)
        start, rows = self.read_json("rows")
        self.assertEqual(len(rows), exchanges)
        given, flow, drift = [0.0] * 3, 0.0, 0.0
        for row in rows:
            load, momentum, time = [float.fromhex(x) for x in row[:8]], row[8:11], row[11]
            self.assertAlmostEqual(load[7], time, delta=1e-15)
            given = [a + b for a, b in zip(given, load)]
            flow += math.hypot(*load[:3])
            drift = max(drift, math.hypot(*(a + b - c for a, b, c in zip(momentum, given, start))))
        return [row[:8] for row in rows], drift / flow, flow

    def test_momentum_goes_to_the_body(self):
        for integrator in INTEGRATORS:
            for move in MOTIONS:
                if integrator in ("order 2", "shapes") and move == "servo":
                    continue    # as any other
                with self.subTest(integrator, move=move):
                    _, drift, flow = self.ledger(self.scene(integrator, move))
                    print(f"{integrator:8} {move:8} drift {drift:.1e} of {flow:.1f}")
                    self.assertGreater(flow, 5.0)
                    self.assertLess(drift, 1e-12)

    def test_momentum_of_clumps(self):
        write_clumps(self.path("clumps"))
        for name, (clumps, singles) in CLUMP_INTEGRATORS.items():
            with self.subTest(name):
                self.write("in.clumps", CLUMPS.format(clumps=clumps, singles=singles))
                _, drift, flow = self.ledger("in.clumps", every=11)
                print(f"clumps, {name:6} drift {drift:.1e} of {flow:.1f}")
                self.assertGreater(flow, 10.0)
                self.assertLess(drift, 1e-12)

    def test_set_ups_change_no_bit(self):
        name = self.scene("plain", "external")
        self.assertEqual(self.ledger(name, set_ups=0)[0], self.ledger(name, set_ups=3)[0])

    def test_a_look_changes_no_bit(self):
        for move in ("none", "external"):
            name = self.scene("verlet", move)
            for watched in ("yes", "no"):
                self.drive(WATCHED, name, watched)
            (one, ), (other, ) = (read_dump(self.path(watched)) for watched in ("yes", "no"))
            self.assert_same_bits(one, other)

    def test_same_bits_on_any_ranks(self):
        for integrator, move in (("plain", "external"), ("verlet", "external"), ("order 2", "free"), ("half", "none")):
            name = self.scene(integrator, move)
            one, *others = [self.ledger(name, np, exchanges=25, root=root)
                            for np, root in ((1, -1), (2, -1), (4, -1), (4, 2))]
            for rows, drift, _ in others:
                with self.subTest(integrator, move=move):
                    self.assertEqual(rows, one[0])
                    self.assertLess(drift, 1e-12)

    def test_sums_of_every_step(self):
        kicks = {"plain": (1, 1, 0), "half": (0.5, 1, 0), "verlet": (0.5, 0.5, 0.5)}
        for integrator, shares in kicks.items():
            for move in ("external", "none"):
                self.drive(TWIN, self.scene(integrator, move), "sums", 9, 30, *shares)
                found, expected = self.read_json("sums")
                scale = [max(abs(row[k]) for row in expected) or 1.0 for k in range(8)]
                worst = max(abs(a - b) / s for one, other in zip(found, expected) for a, b, s in zip(one, other, scale))
                print(f"{integrator} {move}: impulses, angular impulses about a point, work, time differ by {worst:.1e}")
                self.assertLess(worst, 2e-13)
                self.assertNotEqual(found[0][0], 0.0, "there are contacts from the start")

    def test_angular_momentum_goes_to_the_body(self):
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-4, 4)), grains(spin=5.0))
        for integrator in sorted(set(INTEGRATORS) - {"shapes"}):    # whose inertia is not that of spheres
            # between grains, friction acts at the ends of both radii, which overlap: there it does not balance
            self.drive(TURNING, self.scene(integrator, "none"), "sums")
            rows, flow = self.read_json("sums")
            drift = max(math.hypot(*(a - b for a, b in zip(row, rows[0]))) for row in rows) / flow
            print(f"{integrator:8} angular momentum: drift {drift:.1e} of {flow:.1f}")
            self.assertGreater(flow, 5.0)
            self.assertLess(drift, 1e-12)

    def test_work_is_what_grains_lose(self):
        found = []
        for dt in (1e-3, 5e-4, 2.5e-4):
            self.drive(WORK, self.scene("verlet", "external", damping=0, friction="", dt=dt,
                                        more="neigh_modify exclude type 1 1"), "work", 5)
            worst, flow = self.read_json("work")
            print(f"dt {dt:g}: energy of grains and work differ by {worst / flow:.1e} of the work {flow:.1f}")
            self.assertGreater(flow, 5.0)
            found.append(worst / flow)
        # velocity Verlet: (omega dt)^2/8 of the energy of contacts, omega = sqrt(k/m) = 50, 30 times the work
        self.assertLess(found[0], 30 * 0.05**2 / 8)
        for rough, fine in zip(found, found[1:]):    # of second order in the time step
            self.assertAlmostEqual(rough / fine, 4.0, delta=0.8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
