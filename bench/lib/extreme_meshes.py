# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Extreme ways of a mesh that deforms under grains, and what becomes of them. As a program: moves the sheet of one scene, whose
number it is given; it is a partner of LAMMPS by python/talus.py.

50 spheres of diameter and density 1 on a sheet of 512 triangles that is 8 wide, between four planes."""

import dataclasses
import math
import os
import random
import subprocess
import sys
import tempfile

SIZE, CELLS = 8.0, 16
DT = 2e-4                 # .12 of the critical one
STIFFNESS = 1.0e5
LOSSY = f"hooke {STIFFNESS} 60.0 tangential multistep NULL NULL 0.5"
ELASTIC = f"hooke {STIFFNESS} 0.0"
TIMEOUT = 300

SCRIPT = """units lj
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
boundary f f f
region box block -2 10 -2 10 -8 20
create_box 1 box
lattice custom 1.0 a1 1.05 0 0 a2 0 1.05 0 a3 0 0 1.05 basis 0 0 0 origin 0 0 {lift}
region fill block 1.5 6.9 1.5 6.9 0.2 {top} units box
create_atoms 1 region fill
set group all diameter 1.0
set group all density 1.0
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes
pair_style gran/penalty
pair_coeff * * {law}
timestep {dt}
fix step all nve/sphere/symplectic order {order} gravity 10.0 vector 0 0 -1
fix body all large/body mesh sheet.stl two-sided contact {law} move vertices
fix left all large/body plane 0 0 0 1 0 0 contact {law}
fix right all large/body plane 8 0 0 -1 0 0 contact {law}
fix front all large/body plane 0 0 0 0 1 0 contact {law}
fix back all large/body plane 0 8 0 0 -1 0 contact {law}
{more}
compute contacts all penalty/stats
compute ke all ke
compute turning all erotate/sphere
variable kinetic equal c_ke+c_turning
fix account all print 10 "Account $(step) $(atoms) $(v_kinetic) $(f_step) $(c_contacts[4]) $(c_contacts[3])"
thermo 1000
thermo_style custom step atoms c_contacts[3]
thermo_modify norm no lost warn
"""


@dataclasses.dataclass
class Scene:
    """way: (x, t) -> (place, velocity) of a vertex, or all of [x] at once. every: steps between exchanges."""
    name: str
    way: object
    exchanges: int = 400
    every: int = 10
    law: str = LOSSY
    dt: float = DT
    lift: float = 0.5
    more: str = ""
    velocities: bool = True


# ---- ways: of all vertices x at time t, places and velocities ------------------------------------

def wave(height, number, rate):
    """Runs along x; the amplitude grows in the first .05."""
    def way(x, t):
        share, growing = min(1.0, t / 0.05), 1.0 / 0.05 if t < 0.05 else 0.0
        places, speeds = [], []
        for p in x:
            phase = number * p[0] - rate * t
            places.append((p[0], p[1], share * height * math.sin(phase)))
            speeds.append((0.0, 0.0, growing * height * math.sin(phase) - share * height * rate * math.cos(phase)))
        return places, speeds
    return way


def rise(speed):
    return lambda x, t: ([(p[0], p[1], speed * t) for p in x], [(0.0, 0.0, speed)] * len(x))


def belt(speed):
    return lambda x, t: (x, [(speed, 0.0, 0.0)] * len(x))


def stretch(rate):
    middle = SIZE / 2
    return lambda x, t: ([(middle + (p[0] - middle) * math.exp(rate * t), *p[1:]) for p in x],
                         [(rate * (p[0] - middle) * math.exp(rate * t), 0.0, 0.0) for p in x])


def shaken(amplitude):
    draw = random.Random(1)
    return lambda x, t: ([tuple(c + amplitude * draw.gauss(0, 1) for c in p) for p in x], None)


def jumping(height, period):
    return lambda x, t: ([(p[0], p[1], height if round(t / period) % 2 else 0.0) for p in x], None)


def one_vertex(move):
    """The one nearest to the middle."""
    def way(x, t):
        nearest = min(range(len(x)), key=lambda k: math.dist(x[k], (SIZE / 2, SIZE / 2, x[k][2])))
        return [move(p, t) if k == nearest else p for k, p in enumerate(x)], None
    return way


def same_place(x, _t):
    return [x[0], x[0], *x[2:]], None


PRESS = "fix top all large/body plane 0 0 2.2 0 0 -1 contact {law}"
SCENES = [
    Scene("sheet at rest", lambda x, t: (x, [(0.0, 0.0, 0.0)] * len(x))),
    Scene("wave", wave(0.3, 1.5, 10.0)), Scene("fast wave", wave(0.3, 1.5, 60.0)), Scene("short steep wave", wave(0.5, 6.0, 30.0)),
    Scene("elastic wave", wave(0.1, 1.5, 10.0), law=ELASTIC), Scene("wave, dt .5 critical", wave(0.1, 1.5, 10.0), dt=8e-4),
    Scene("wave, dt 2 critical", wave(0.1, 1.5, 10.0), dt=3.2e-3, exchanges=100),
    Scene("rises at 30", rise(30.0), exchanges=30), Scene("rises at 300", rise(300.0), exchanges=60, every=1),
    Scene("rises at 3000", rise(3000.0), exchanges=10, every=1),
    Scene("falls away", rise(-5.0), exchanges=150), Scene("belt at 10", belt(10.0)), Scene("belt at 1e6", belt(1e6)),
    Scene("stretches", stretch(2.0), exchanges=300), Scene("stretches fast", stretch(20.0), exchanges=100),
    Scene("vertices shake by .003", shaken(0.003)), Scene("vertices shake by .02", shaken(0.02)),
    Scene("vertices shake by .1", shaken(0.1)), Scene("vertices shake by .5", shaken(0.5)),
    Scene("jumps by .05", jumping(0.05, 10 * DT)), Scene("jumps by .5", jumping(0.5, 10 * DT)),
    Scene("jumps by .5 in a step", jumping(0.5, DT), every=1),
    Scene("a spike grows", one_vertex(lambda p, t: (p[0], p[1], 6.0 * min(0.5, t)))),
    Scene("a vertex is pulled over its neighbors", one_vertex(lambda p, t: (p[0] + 2.5 * t, *p[1:]))),
    Scene("a vertex is no number", one_vertex(lambda p, t: (p[0], p[1], math.nan))), Scene("two vertices at one place", same_place),
    Scene("grains deep in the sheet", lambda x, t: (x, None), lift=0.3), Scene("pressed against a plane", rise(0.8), more=PRESS, exchanges=800),
]


def write_sheet(path):
    import stl
    h = SIZE / CELLS
    squares = [[((i + a) * h, (j + b) * h, 0.0) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))] for i in range(CELLS) for j in range(CELLS)]
    stl.write(path, "sheet", [corners for a, b, c, d in squares for corners in ((a, b, c), (a, c, d))])


def move(scene, order):
    """In the present folder; a refusal of the interface goes to the file `refused`."""
    from lammps import lammps
    from talus import Partner, TalusError
    law = scene.law
    if order == 2:
        law = law.replace("0.5", "0.5 slider midpoint") + (" limit_damping" if "tangential" in law else "")
    host = lammps(cmdargs=["-screen", "none", "-log", "log.scene"])
    host.commands_string(SCRIPT.format(law=law, dt=scene.dt, order=order, lift=scene.lift / 1.05, top=2.0, more=scene.more.format(law=law)))
    try:
        with Partner(host) as partner:
            body = partner.body("body")
            x = [tuple(p) for p in body.mesh[0]]
            for n in range(1, scene.exchanges + 1):
                places, speeds = scene.way(x, n * scene.every * scene.dt)
                body.put_vertices([c for p in places for c in p], [c for v in speeds for c in v] if speeds else None, scene.every)
                partner.advance(scene.every)
    except TalusError as refused:
        with open("refused", "w") as file:
            file.write(str(refused))
    host.close()


def run(bench, number, order):
    """Outcome of SCENES[number]."""
    import lammps
    import machine
    import verdict
    folder = tempfile.mkdtemp(prefix="sheet-", dir=bench.workdir)
    write_sheet(os.path.join(folder, "sheet.stl"))
    library = os.path.dirname(machine.STOCK_LMP)
    env = dict(os.environ, LAMMPS_PLUGIN_PATH=machine.BUILD, OMPI_MCA_btl="self", OMPI_MCA_ess_singleton_isolated="1",
               LD_LIBRARY_PATH=":".join([library, machine.BUILD, os.environ.get("LD_LIBRARY_PATH", "")]),
               PYTHONPATH=":".join(os.path.join(top, "python") for top in (machine.HOST_SOURCE, machine.ROOT)))
    done = subprocess.run([sys.executable, os.path.abspath(__file__), str(number), str(order)], cwd=folder, env=env, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=TIMEOUT, check=False)
    log = lammps.Result(_read(folder, "log.scene"), done.stdout, done.returncode, 0.0, 0)
    rows, refusal = log.printed("Account"), _read(folder, "refused")
    if not rows and not refusal:
        raise lammps.Failed(f"moved sheet: {SCENES[number].name}\n{done.stdout[-1500:]}{log.log[-1500:]}")
    outcome = verdict.judge_account(rows, log, int(rows[0][1]) if rows else 0, driven=True)
    outcome.error = outcome.error or refusal
    return outcome


def _read(folder, name):
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return ""
    with open(path) as file:
        return file.read()


if __name__ == "__main__":
    del sys.path[0]      # there lammps is another module
    move(SCENES[int(sys.argv[1])], int(sys.argv[2]))
