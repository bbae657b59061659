# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Settled beds and the input scripts that run them.

A bed is settled once in a box periodic in x and y (a tile of 12 500 spheres, 15 diameters deep),
laid out side by side to the size that is wanted, fenced by walls, and left to come to rest.  The
result is a data file in the cache, the same for all codes."""

import math
import multiprocessing
import os

import lammps
import machine

RECIPE = "1"          # part of the names in the cache: change it when a bed would come out different

D = 2.5e-3            # mean diameter (m), +- 5 %
DENSITY = 2500.0
KN, GN, MU = 4.0e6, 5.0e7, 0.5          # Hertz: Pa, 1/(m s), -
GRAVITY = 9.81
SKIN = 0.1 * D
DT = 1.0e-5           # about .054 of sqrt(m/k) of the lightest sphere at an overlap of 1 % of its radius

# the same stiffness from a material: kn = 4/3 E_eff, E_eff = E/(2 (1 - nu^2))
NU, RESTITUTION = 0.3, 0.5
YOUNG = 0.75 * KN * 2 * (1 - NU**2)

TILE_SITES, TILE_LAYERS = 25, 20
TILE = TILE_SITES**2 * TILE_LAYERS
WIDTH = 1.08 * D * TILE_SITES


def cache_path(name):
    os.makedirs(machine.CACHE, exist_ok=True)
    return os.path.join(machine.CACHE, f"{name}-{RECIPE}.data")


# ---- laws: the commands of each code ----------------------------------------------------------

HISTORY = f"hertz {KN} {GN} tangential multistep NULL NULL {MU}"
# stock: the displacement of contacts that slide follows the rule of pair granular and of LIGGGHTS
MATERIAL = f"hertz/material {YOUNG} {RESTITUTION} {NU} tangential multistep NULL NULL {MU} stock"
STOCK_HISTORY = f"hertz/history {KN} NULL {GN} NULL {MU} 1"
STOCK_GRANULAR = (f"hertz/material {YOUNG} {RESTITUTION} {NU} tangential mindlin NULL 1.0 {MU} "
                  "damping coeff_restitution")
FRICTIONLESS = f"hertz {KN} {GN}"


def talus(law=HISTORY, walls=True, gravity=GRAVITY, start="plain", materials=None):
    """Physics of a bed with Talus; materials: law of pair_coeff if it is not that of the walls."""
    text = f"pair_style gran/penalty\npair_coeff * * {materials or law}\n" \
           f"fix move all nve/sphere/symplectic start {start} gravity {gravity} vector 0 0 -1\n" \
           f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}\n"
    if walls:
        for name, place, normal in (("xlo", "$(xlo) 0 0", "1 0 0"), ("xhi", "$(xhi) 0 0", "-1 0 0"),
                                    ("ylo", "0 $(ylo) 0", "0 1 0"), ("yhi", "0 $(yhi) 0", "0 -1 0")):
            text += f"fix {name} all large/body plane {place} {normal} contact {law}\n"
    return text


def stock(pair=f"gran/{STOCK_HISTORY}", wall=STOCK_HISTORY, coeff="", walls=True):
    """The same with the styles of LAMMPS."""
    text = f"pair_style {pair}\npair_coeff * * {coeff}\n" \
           f"fix gravity all gravity {GRAVITY} vector 0 0 -1\nfix move all nve/sphere\n" \
           f"fix floor all wall/gran {wall} zplane 0.0 NULL\n"
    if walls:
        text += f"fix x all wall/gran {wall} xplane $(xlo) $(xhi)\n" \
                f"fix y all wall/gran {wall} yplane $(ylo) $(yhi)\n"
    return text


def stock_granular():
    return stock("granular", f"granular {STOCK_GRANULAR}", STOCK_GRANULAR)


def liggghts(box):
    (xlo, xhi), (ylo, yhi), _ = box
    text = f"""fix m1 all property/global youngsModulus peratomtype {YOUNG}
fix m2 all property/global poissonsRatio peratomtype {NU}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {RESTITUTION}
fix m4 all property/global coefficientFriction peratomtypepair 1 {MU}
pair_style gran model hertz tangential history
pair_coeff * *
fix gravity all gravity {GRAVITY} vector 0 0 -1
fix move all nve/sphere
"""
    for name, where in (("floor", "zplane 0.0"), ("xlo", f"xplane {xlo}"), ("xhi", f"xplane {xhi}"),
                        ("ylo", f"yplane {ylo}"), ("yhi", f"yplane {yhi}")):
        text += f"fix {name} all wall/gran model hertz tangential history primitive type 1 {where}\n"
    return text


# ---- scripts ----------------------------------------------------------------------------------

def neighbors(every):
    """Lists rebuilt every so many steps, in every code alike; 0: when particles have moved, as usual."""
    if every:
        return f"neigh_modify every {every} delay 0 check no\n"
    return "neigh_modify every 1 delay 0 check yes\n"


def script(data, physics, warm, steps, every=100, boundary="f f f", dt=DT, more="", style="sphere"):
    """Read a bed, run `warm` steps that do not count, then `steps` that do."""
    return (f"units si\natom_style {style}\natom_modify map array\nnewton off\ncomm_modify vel yes\n"
            f"boundary {boundary}\nread_data {data}\nneighbor {SKIN} bin\n{neighbors(every)}{physics}"
            f"timestep {dt}\nthermo 1000000\nthermo_modify norm no lost error\n{more}"
            f"run {warm}\nrun {steps}\n")


def liggghts_script(data, box, warm, steps, every=100):
    return (f"units si\natom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\n"
            f"boundary f f f\nread_data {data}\nneighbor {SKIN} bin\n{neighbors(every)}{liggghts(box)}"
            f"timestep {DT}\nthermo 1000000\nthermo_modify norm no lost error\nrun {warm}\nrun {steps}\n")


DUMP = "id diameter x y z vx vy vz omegax omegay omegaz"


def save_state(path):
    return f"write_dump all custom {path} {DUMP} modify format float %.17g sort id\n"


def state_rows(path, density=DENSITY):
    """Rows and velocities of the last frame of a dump with the columns DUMP, for write_data()."""
    frame = lammps.read_frames(path)[-1][1]
    columns = [frame[name] for name in DUMP.split()]
    rows = [(int(r[0]), 1, r[1], density, *r[2:5]) for r in zip(*columns)]
    return rows, [(int(r[0]), *r[5:]) for r in zip(*columns)]


# ---- making them ------------------------------------------------------------------------------

def scattered(k):
    """A number in 0 ... 1 that belongs to k."""
    value = math.sin(12.9898 * k) * 43758.5453
    return value - math.floor(value)


def tile_box():
    return (0.0, WIDTH), (0.0, WIDTH), (0.0, 1.08 * D * (TILE_LAYERS + 2))


def tile(bench):
    """Path of the settled tile."""
    path = cache_path("tile")
    if os.path.exists(path):
        return path
    bench.note(f"settling a tile of {TILE} spheres, once")
    s, rows = 1.08 * D, []
    for k in range(TILE):
        site = k % TILE_SITES, k // TILE_SITES % TILE_SITES, k // TILE_SITES**2
        shift = [0.03 * D * scattered(k + 7919 * (n + 1)) for n in range(3)]
        rows.append((k + 1, 1, D * (0.95 + 0.1 * scattered(k)), DENSITY,
                     *(s * (site[n] + (0.5 if n < 2 else 0.55)) + shift[n] for n in range(3))))
    lammps.write_data(bench.path("loose.data"), tile_box(), rows)
    lammps.run(bench.workdir, "tile", script("loose.data", talus(walls=False), 0, 25000, every=0, boundary="p p f")
               + save_state("tile.dump"))
    lammps.write_data(path, tile_box(), *state_rows(bench.path("tile.dump")))
    os.remove(bench.path("tile.dump"))
    return path


def read_data(path):
    """(box, rows, velocities) of a file by write_data()."""
    box, rows, velocities, into = [], [], [], None
    with open(path) as file:
        for line in file:
            words = line.split()
            if words in (["Atoms"], ["Velocities"]):
                into = rows if words == ["Atoms"] else velocities
            elif line.endswith("lo xhi\n") or line.endswith("lo yhi\n") or line.endswith("lo zhi\n"):
                box.append((float(words[0]), float(words[1])))
            elif words and into is not None:
                into.append((int(words[0]), *map(float, words[1:])))
    return tuple(box), rows, velocities


def layout(count):
    """Tiles in x and y, nearly square, at least `count` spheres."""
    tiles = -(-count // TILE)
    across = max(1, math.isqrt(tiles))
    return -(-tiles // across), across


def bed(bench, count, relax=3000):
    """Path of a bed of `count` spheres between floor and four walls, and its box."""
    path = cache_path(f"bed-{count}")
    if not os.path.exists(path):
        # in a process of its own: what that takes in memory would count as the peak of all that are started later
        maker = multiprocessing.get_context("fork").Process(target=make_bed, args=(bench, count, relax, path))
        maker.start()
        maker.join()
        if maker.exitcode:
            raise lammps.Failed(f"the bed of {count} spheres could not be made")
    with open(path) as file:
        head = [next(file).split() for _ in range(9)]
    return path, tuple((float(w[0]), float(w[1])) for w in head if len(w) == 4 and w[2].endswith("lo"))


def make_bed(bench, count, relax, path):
    _, rows, velocities = read_data(tile(bench))
    nx, ny = layout(count)
    bench.note(f"laying out and settling a bed of {count} spheres, once")
    margin = 0.53 * D    # the outermost centers are on the border of the tile
    box = ((-margin, nx * WIDTH + margin), (-margin, ny * WIDTH + margin), tile_box()[2])
    spheres = []
    for place in range(nx * ny):
        dx, dy = WIDTH * (place % nx), WIDTH * (place // nx)
        spheres += [(r[2], r[3], r[4] + dx, r[5] + dy, r[6], *v[1:]) for r, v in zip(rows, velocities)]
    # the surplus is taken from the top
    keep = sorted(sorted(range(len(spheres)), key=lambda k: spheres[k][4])[:count])
    lammps.write_data(bench.path("loose.data"), box, [(n + 1, 1, *spheres[k][:5]) for n, k in enumerate(keep)],
                      [(n + 1, *spheres[k][5:]) for n, k in enumerate(keep)])
    lammps.run(bench.workdir, "bed", script("loose.data", talus(), 0, relax, every=0)
               + save_state("bed.dump"), ranks=min(2, len(machine.cores())) if count > 1e5 else 1)
    lammps.write_data(path, box, *state_rows(bench.path("bed.dump")))
    for name in "bed.dump", "loose.data":
        os.remove(bench.path(name))


def tile_data(bench):
    """The tile itself, periodic in x and y: for comparisons without walls."""
    return tile(bench), tile_box()


def contacts(bench, count):
    """Contacts and candidate pairs per sphere of a bed."""
    more = ("compute pairs all pair gran/penalty\nthermo_style custom step c_pairs[1] c_pairs[2]\n"
            "variable contacts equal c_pairs[1]/atoms\nvariable pairs equal c_pairs[2]/atoms\n")
    text = script(bed(bench, count)[0], talus(), 0, 1, more=more)
    return lammps.run(bench.workdir, "state", text + 'print "RESULT ${contacts} ${pairs}"\n').printed("RESULT")[0]
