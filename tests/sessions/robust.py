# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: no sequence of commands that LAMMPS survives without the suffix crashes or hangs, and what is wrong ends in a message:
words, STL files, restart files, calls of a partner."""

import functools
import os
import re

import changes
import mutation
import scenes
from pool import CRASH, HANG, OK, Session
from quantities import text

DOC = os.path.join(os.environ["TALUS_SOURCE_DIR"], "doc")

# separated by bars; commands that belong together by semicolons
OPERATIONS = """run 5|run 3|run 3 pre no|run 4 post no|run 7 pre no|run 0|run 6 every 2 NULL|write_restart session|clear;AGAIN|RESTART
group some id 1:3|group some id 2 4|group moving dynamic all every 2|group ball dynamic all region ball every 3;run 5 pre no
group moving static|region ball sphere 1 1 1 2 units box|region ball sphere 1 1 1 3 side out units box|region ball delete
region of_b0 delete|region of_b0 delete;run 2|region whole delete|@save s;region of_b0 delete;@restore s;@advance 3
comm_style tiled|comm_style tiled;balance 1.0 rcb|balance 1.0 shift xyz 5 1.0|balance 1.0 x uniform
comm_style tiled;balance 1.0 rcb;change_box all x final -8 8;run 5|fix even all balance 3 1.0 shift xyz 3 1.1
comm_style tiled;fix even all balance 5 1.0 rcb|unfix even|change_box all x final -8 8|change_box all boundary f f s
change_box all z scale 1.1 remap|change_box all triclinic|@advance 4;comm_style tiled;@advance 30|@save s;comm_style tiled;@restore s;@advance 5
delete_atoms group some compress no|delete_atoms group some|delete_atoms group all|reset_atoms id
create_atoms 1 single 0.1 0.2 6.5;set group all density 1.5|create_atoms 1 random 3 771 NULL overlap 1.0 maxtry 50
set group some type 1|set group all density 2|set group some diameter 0.7|velocity all set 0 0 -2|velocity some zero linear
displace_atoms all move 0.01 0 0.02|displace_atoms some random 0.01 0.01 0.01 123|timestep 1e-4|reset_timestep 0|neighbor 0.02 bin
neighbor 0 bin|neighbor 0.4 bin|neigh_modify every 3 delay 0 check no|neigh_modify exclude group some some|neigh_modify exclude none
fix ballwall all wall/gran/region hooke/history 1e4 NULL 20 NULL 0.5 1 region ball|unfix ballwall
fix ballwall all wall/gran/region hooke/history 1e4 NULL 20 NULL 0.5 1 region ball;run 5 pre no
fix ballbody all large/body region ball contact hooke 1e4 20|unfix ballbody|unfix b0|unfix b1|unfix step
fix low all wall/gran hertz/history 1e4 NULL 20 NULL 0.5 1 zplane -0.6 NULL|unfix low
fix low all wall/gran hertz/history 1e4 NULL 20 NULL 0.5 1 zplane -0.6 NULL;run 5 pre no
fix low all large/body plane 0 0 -0.6 0 0 1 contact hooke 1e4 20|fix low all large/body plane 0 0 -0.6 0 0 1 contact hooke 1e4 20;run 5 pre no
fix hold some freeze|fix hold some freeze;run 5 pre no|unfix hold|fix air all viscous 0.3|unfix air|fix push all addforce 0.1 0 0.2|unfix push
fix push all efield 0 0 1;run 3 pre no|fix grav all gravity 9.81 vector 0 0 -1|fix grav all gravity 9.81 vector 0 0 -1;run 5 pre no|unfix grav
fix_modify b0 virial yes energy yes|suffix talus|suffix off|pair_style none|PAIR|fix step all nve/sphere|fix step all nve/sphere/symplectic
run_style verlet|run_style verlet/stock|run_style verlet/proxy overlap yes|comm_proxy yes|comm_proxy no|comm_proxy auto|comm_proxy info
comm_proxy yes;comm_proxy check yes|comm_modify cutoff 2.5|neighbor 0.2 multi;comm_modify mode multi
compute rows all contact/gran/local id1 id2 fn;dump rows all local 2 rows index c_rows[1] c_rows[3]|undump rows
compute sum all penalty/stats;thermo_style custom step c_sum[2] c_sum[4]|thermo_style custom step atoms|dump see all custom 2 see id x fx
undump see|dump film all vtk/gran 3 film.pvd|undump film|dump see all custom 2 see id x y z;run 4;undump see;rerun see first 0 dump x y z
write_data session.data|fix many all pour/rate 5 1 ball 1.0 diameter 0.3 density 1 seed 5|unfix many
fix many all pour/rate 5 1 ball 5.0 diameter uniform 0.2 0.4 density 1 seed 5;run 12|fix more all deposit 4 1 3 771 region ball near 0.5;run 3
unfix more|atom_modify sort 1 0.5|atom_modify sort 0 0|info all out log|fix turn all deform 2 x erate 0.1 remap x|unfix turn
fix turn all deform 1 y erate 0.1 remap v|fix turn all deform 1 z final -3 9 remap none|fix press all press/berendsen iso 1 2 1|unfix press
set group all temperature 2|compute warmth all property/atom temperature;dump warm all custom 2 warm id c_warmth
minimize 1e-4 1e-4 3 3
fix press all deform/pressure 1 x pressure 5 0.1 max/rate 1 remap v|fix turn all deform 1 xy erate 0.3 remap v|change_box all x scale 0.99 remap
@advance 4|@save s|@restore s|@discard s|@set_up|@put_forces 1 0 0 3|@close|@watch b0;@advance 2;@load b0|@put_drag 1 0.3 0 0 1|@fluid stokes saffman magnus rotation
@other;@other_forces 2 0 0 1|@other_close""".replace("\n", "|").split("|")
OF_BONDS = """create_bonds single/bond 1 1 2|create_bonds single/bond 2 1 3;run 5 pre no|create_bonds many all all 1 0 1.0
special_bonds lj 0 1 1 coul 0 1 1;create_bonds many all all 1 0 1.0;special_bonds lj 0 1 1 coul 1 1 1|bond_coeff 1 1e3 1e3 50 50 9 9 9 9 0 0 0 0
delete_bonds all bond 1 remove|delete_bonds some multi remove special|delete_bonds all multi|delete_bonds some bond 2 any
delete_atoms group some bond yes|delete_atoms group some bond yes compress no|bond_style none|BONDS|special_bonds lj 1 1 1 coul 1 1 1
bond_style bpm/spring;bond_coeff * 5e3 0.1 3|bond_style bpm/spring volume/factor yes;bond_coeff * 5e3 0.1 3 100
special_bonds lj 0 0 0|bond_style bpm/rotational overlay/pair yes|fix move all nve/bpm/sphere|unfix step;fix step all nve/bpm/sphere
bond_style hybrid bpm/rotational harmonic|set group some quat/random 5|set group some bond 2|compute ties all nbond/atom;dump ties all custom 2 ties id c_ties
compute part all fragment/atom single yes;dump part all custom 3 part id c_part|compute long all bond/local dist engpot force
compute long all bond/local dist;dump long all local 2 long index c_long|fix snap all bond/break 2 1 1.02|fix glue all bond/create 3 1 1 1.1 1
DATA|DATA;run 3|reset_atoms id;run 4|reset_atoms mol|write_data session.data nocoeff|compute sum all penalty/stats;thermo_style custom step c_sum[1] ebond
write_restart session;run 3|set type 1 density 3;run 3|displace_atoms some random 0.3 0.3 0.3 5;run 6""".replace("\n", "|").split("|")


def draw(rng):
    """A session, and the part of it that is known to be good: what went before an error in it does not count."""
    return (rng.choice((sequence,) * 5 + (words, stl, restart))(rng),)


class Names:
    """What has been defined: most commands on what is not there would end the session at once."""
    MAKERS = {"fix": "f_", "dump": "d_", "compute": "c_", "region": "r_", "group": "g_", "@save": "s_"}
    TAKERS = {"unfix": "f_", "fix_modify": "f_", "undump": "d_", "uncompute": "c_", "@restore": "s_", "@discard": "s_", "@watch": "f_",
              "@load": "f_"}

    def __init__(self, lines):
        self.names, self.new_dump = {"g_all"}, False
        self.follow(lines)

    def allow(self, lines):
        for line in lines:
            words = line.split()
            if self.new_dump and "pre" in words:    # an error of LAMMPS on one rank only, for which others wait
                return False
            if words[0] in self.TAKERS and self.TAKERS[words[0]] + words[1] not in self.names:
                return False
            if words[0] in ("fix", "dump", "compute") and self.MAKERS[words[0]] + words[1] in self.names:
                return False
            if "some" in words and words[0] != "group" and "g_some" not in self.names:
                return False
            if words[0] == "region" and words[2] == "delete" and f"r_{words[1]}" not in self.names:
                return False
            if "ball" in words[3:] and "r_ball" not in self.names:
                return False
        return True

    def follow(self, lines):
        for line in lines:
            words = line.split()
            if words[0] in ("dump", "run"):
                self.new_dump = words[0] == "dump" or (self.new_dump and "pre" in words)
            if words[0] in ("clear", "@close"):
                self.names = {"g_all"} if words[0] == "clear" else {name for name in self.names if name[:2] != "s_"}
            elif words[0] in self.MAKERS and len(words) > 1:
                self.names.add(self.MAKERS[words[0]] + words[1])
            if words[0] in self.TAKERS and words[0][:2] in ("un", "@d") or words[-1] == "delete":
                self.names.discard(self.TAKERS.get(words[0], "r_") + words[1])


def sequence(rng):
    scene = scenes.any_scene(rng)
    again = [*scene.beginning(), *scene.physical()]
    start = [text(words) for words in scene.start if not text(words).startswith(("boundary", "fix"))]
    boundary, = (text(words) for words in scene.start if words[0] == "boundary")
    pair = [text(words) for words in scene.physics if str(words[0]).startswith("pair_")]
    places = {"AGAIN": again, "PAIR": pair,
              "RESTART": ["write_restart half", "clear", *start, *changes.read_restart(scene, "half"), *scene.physical(again=True)],
              "BONDS": [text(words) for words in scene.once if "create_bonds" not in words],
              "DATA": ["write_data half.data nocoeff", "clear", *start, boundary,
                       "read_data half.data extra/bond/per/atom 9 extra/special/per/atom 40", *scene.physical()]}
    lines, wanted = [*again, f"run {rng.choice((0, 3, 8))}"], rng.randint(2, 12)
    there = Names(lines)
    while wanted:
        parts = rng.choice(OF_BONDS if scene.once and rng.random() < 0.4 else OPERATIONS).split(";")
        if there.allow(parts) or (rng.random() < 0.01 and not there.new_dump):
            more = [line for part in parts for line in places.get(part, [part])]
            there.follow(more)
            lines += more
            wanted -= 1
    ranks, threads = rng.choice(((1, 1), (1, 1), (1, 2), (2, 1), (2, 1), (4, 1)))
    suffix = scene.words or rng.choice(((), ("-sf", "talus")))
    return Session([*lines, "run 4"], ranks, threads, suffix, scene.files())


# ---- words and files ------------------------------------------------------------------------------

@functools.cache
def _examples():
    lines = mutation.examples(DOC)
    return lines, sorted({word for line in lines for word in line.split()[1:]})


def of_script(script, files):
    session = Session([line for line in re.sub(r"&\s*\n\s*", " ", script).splitlines() if line.strip()], files=files)
    session.examines_numbers = True
    return session


def words(rng):
    """An example of the pages with words that are wrong."""
    lines, all_words = _examples()
    line = mutation.mutated(rng, rng.choice(lines), all_words)
    files = {name: mutation.text_stl(mutation.tetrahedron()) for name in ("drum.stl", "stone.stl")}
    session = of_script(mutation.PLACES[line.split()[0]](line), files)
    session.ranks = rng.choice((1, 1, 1, 2))
    return session


def stl(rng):
    (_, script, files), = mutation.stl_files(rng, 1, rng.randrange(3))
    return of_script(script, files)


# ---- restart files --------------------------------------------------------------------------------

class Damaged(Session):
    """Reads a restart file in which bits are wrong. writer: the session that makes it; flips: (where in it, 0 to 1, which bit)."""
    writer, flips = None, ()


def restart(rng):
    scene = scenes.any_scene(rng)
    start = [text(words) for words in scene.start if not text(words).startswith(("boundary", "fix"))]
    session = Damaged([*start, *changes.read_restart(scene, "half"), *scene.physical(again=True), "run 2"], 1, 1, scene.words, scene.files())
    session.writer = Session([*scene.beginning(), *scene.physical(), "run 12", "write_restart half"], words=scene.words,
                             files=scene.files(), keep=("half",))
    session.flips = tuple((rng.random(), rng.randrange(8)) for _ in range(rng.choice((1, 1, 2))))
    return session


def _with_file(run, session):
    written = run(session.writer)
    if written.kind != OK:
        return False
    data = bytearray(written.kept["half"])
    for at, bit in session.flips:
        data[int(at * len(data))] ^= 1 << bit
    session.files = {**session.files, "half": bytes(data)}
    return True


# ---- what must hold -------------------------------------------------------------------------------

def check(run, session):
    if isinstance(session, Damaged) and not _with_file(run, session):
        return "", [session]
    found = run(session)
    fault = changes.fault_of_failure(found)
    if found.kind == CRASH and not _is_ours(found.text):
        fault = ""
    if found.kind == HANG and isinstance(session, Damaged) and not _is_ours(found.text):    # it reads without end
        fault = ""
    if found.kind in (CRASH, HANG) and session.words and _fails_in_stock(run, session):
        fault = ""
    if found.kind == OK and not session.words:
        fault = mutation.fault_of_numbers(found.log) if session.examines_numbers else ""
    return fault, [session]


def _fails_in_stock(run, session):
    """Without the suffix; a script with styles of Talus ends in an error then."""
    lines = [line for line in session.lines if not line.startswith(("suffix", "@", "comm_proxy", "run_style"))]
    plain = Session(lines, session.ranks, session.threads, (), session.files)
    return run(plain).kind in (CRASH, HANG)


def _is_ours(text):
    """Whether a crash is not in LAMMPS: the innermost frame that Open MPI shows which is of one of the two libraries."""
    libraries = [os.path.basename(path) for path in re.findall(r"\[ *\d+\] ([^\s(]+)", text)]
    frames = [name for name in libraries if name.startswith(("liblammps", "libtalus", "talus"))]
    return not frames or not frames[0].startswith("liblammps")
