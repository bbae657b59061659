# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The input scripts for grains that LAMMPS comes with, and what `-sf talus` makes of each.

Used by tests/dropin and by bench/dropin.py. An input is run as it is, but for the lengths of its runs: see
shortened(). INPUTS says which there are; what lies in their folders and is not listed is an error (unlisted())."""

import dataclasses
import glob
import os
import re
import shutil

FOLDERS = "bench", "examples/bpm/pour", "examples/granregion", "examples/granular", "examples/pour"
OTHERS = {"bench/in." + name for name in ("chain", "chain.scaled", "eam", "lj", "rhodo", "rhodo.scaled")}

HEADING = "Talus: styles of this run"
STEPS = "steps without output"


@dataclasses.dataclass(frozen=True)
class StockInput:
    """name: path in the source tree of LAMMPS.  tables: what the log says, word by word, see read_expected().
    steps, long_steps: largest length of a run command, in the short and the long test.  every: steps between the
    frames that are compared, unless a run is shorter.  bench_steps: largest length in the benchmark.  exact: the thermodynamic output agrees
    in all digits over the first 100 steps.  rubs: tests at whose end spheres turn, as they do after contacts: short,
    long, both, never.  variables: for -var.  since: first version that has it.
    error: {version: error of that LAMMPS itself}.
    shared: {version: by how much that LAMMPS is wrong in a way that its twins share: positions in diameters, printed numbers of the
    largest of their column}.
    volume: by how much the pressure may be another one for a while where rebuilds that Talus makes of its own accord, every 1000 steps, give a
    box with shrink-wrapped sides another volume."""
    name: str
    tables: str
    steps: int
    every: int
    long_steps: int
    bench_steps: int
    exact: bool = False
    rubs: str = "both"
    variables: dict = dataclasses.field(default_factory=dict)
    since: int = 0
    error: dict = dataclasses.field(default_factory=dict)
    shared: dict = dataclasses.field(default_factory=dict)
    volume: float = 0.0

    @property
    def title(self):
        return os.path.basename(self.name)


# One paragraph for each table that differs from the one before it. Fixes that do not act within steps have no line.
INPUTS = [
    StockInput("bench/in.chute", """
pair gran/hooke/history           accelerated
fix 1 gravity                     accelerated
fix 2 freeze                      accelerated
fix 3 nve/sphere                  accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=100, every=100, long_steps=1000, bench_steps=100, exact=True),
    StockInput("bench/in.chute.scaled", """
pair gran/hooke/history           accelerated
fix 1 gravity                     accelerated
fix 2 freeze                      accelerated
fix 3 nve/sphere                  accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=20, every=100, long_steps=1000, bench_steps=100, exact=True, variables={"x": 2}),
    StockInput("examples/granregion/in.granregion.box", """
pair hybrid                       accelerated
fix container wall/gran/region    accelerated
fix 2 nve/sphere                  accelerated
fix 3 gravity                     accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=5000, every=500, long_steps=5000, bench_steps=5000),
    StockInput("examples/granregion/in.granregion.funnel", """
pair gran/hertz/history           accelerated
fix grav gravity                  accelerated
fix 1 nve/sphere                  accelerated
fix hopper3 wall/gran/region      accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=2000, every=1000, long_steps=20000, bench_steps=3000),
    StockInput("examples/granregion/in.granregion.mixer", """
pair gran/hertz/history           accelerated
fix grav gravity                  accelerated
fix 1 nve/sphere                  accelerated
fix mixwall wall/gran/region      accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=5000, every=1000, long_steps=100000, bench_steps=10000, rubs="long"),
    StockInput("examples/pour/in.pour", """
pair gran/hooke/history           accelerated
fix 1 nve/sphere                  accelerated
fix 2 gravity                     accelerated
fix zlower wall/gran              accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=5000, every=1000, long_steps=25000, bench_steps=10000),
    StockInput("examples/pour/in.pour.2d", """
pair gran/hertz/history           accelerated
fix 1 nve/sphere                  accelerated
fix 2 gravity                     accelerated
fix xwalls wall/gran              accelerated
fix ywalls wall/gran              accelerated
fix 3 enforce2d                   stock: no accelerated variant
run verlet                        accelerated
steps without output              in the records
""", steps=10000, every=500, long_steps=25000, bench_steps=25000),
    StockInput("examples/pour/in.pour.2d.molecule", """
pair gran/hertz/history           accelerated
fix 2 gravity                     accelerated
fix xwalls wall/gran              accelerated
fix ywalls wall/gran              accelerated
fix 3 rigid/small                 accelerated
fix 4 enforce2d                   stock: no accelerated variant
run verlet                        accelerated
steps without output              in the records
""", steps=10000, every=1000, long_steps=25000, bench_steps=25000),
    # later LAMMPS turns histories of rolling around where new neighbor lists turn a pair around
    StockInput("examples/granular/in.pour.drum", """
pair granular                     accelerated
fix 1 nve/sphere                  accelerated
fix grav gravity                  accelerated
fix 3 wall/gran/region            accelerated
fix 4 wall/gran/region            accelerated
run verlet                        accelerated
steps without output              in the records

pair granular                     accelerated
fix 1 nve/sphere                  accelerated
fix 3 wall/gran/region            accelerated
fix 4 wall/gran/region            accelerated
fix 5 wall/gran/region            accelerated
fix grav gravity                  accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=100, every=50, long_steps=100, bench_steps=1000,
               rubs="never"),
    StockInput("examples/granular/in.pour.flatwall", """
pair granular                     accelerated
fix 1 nve/sphere                  accelerated
fix grav gravity                  accelerated
fix 3 wall/gran                   accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=2000, every=500, long_steps=5000, bench_steps=5000),
    StockInput("examples/granular/in.pour.heat", """
pair granular                     accelerated
fix 2 nve/sphere                  accelerated
fix 3 heat/flow                   stock: no accelerated variant
fix grav gravity                  accelerated
fix 4 wall/gran/region            accelerated
fix 5 wall/gran/region            accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=4000, every=500, long_steps=10000, bench_steps=10000),
    StockInput("examples/granular/in.restitution", """
pair granular                     accelerated
fix 1 nve/sphere                  accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=200000, every=50000, long_steps=1000000, bench_steps=1000000, rubs="never"),
    StockInput("examples/granular/in.sync_verlet", """
pair granular                     accelerated
fix frz freeze                    accelerated
fix g gravity                     accelerated
fix 1 nve/sphere                  accelerated
fix 2 wall/gran                   accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=100000, every=20000, long_steps=300000, bench_steps=300000, since=20260704),
    StockInput("examples/granular/in.tableting.200", """
pair granular                     stock: normal model mdr
fix lowerPunch wall/gran/region   stock: the pair style is not accelerated
fix upperPunch wall/gran/region   stock: the pair style is not accelerated
fix die wall/gran/region          stock: the pair style is not accelerated
fix 1 nve/sphere                  stock: the pair style is not accelerated
fix grav gravity                  stock: the pair style is not accelerated
run verlet                        stock: the pair style is not accelerated
steps without output              through the arrays of LAMMPS: the pair style is not accelerated
""", steps=1000, every=250, long_steps=5000, bench_steps=3000,
               error={20260704: "Cannot find fix storing granular history"}),
    StockInput("examples/granular/in.triaxial.compaction.12", """
pair granular                     stock: normal model mdr
fix integr nve/sphere             stock: the pair style is not accelerated
fix plane_yz_pos wall/gran/region  stock: the pair style is not accelerated
fix plane_yz_neg wall/gran/region  stock: the pair style is not accelerated
fix plane_xz_pos wall/gran/region  stock: the pair style is not accelerated
fix plane_xz_neg wall/gran/region  stock: the pair style is not accelerated
fix plane_xy_pos wall/gran/region  stock: the pair style is not accelerated
fix plane_xy_neg wall/gran/region  stock: the pair style is not accelerated
run verlet                        stock: the pair style is not accelerated
steps without output              through the arrays of LAMMPS: the pair style is not accelerated
""", steps=10000, every=1000, long_steps=49900, bench_steps=49900,
               error={20260704: "Cannot find fix storing granular history"}),
    StockInput("examples/bpm/pour/in.bpm.pour", """
pair gran/hertz/history           accelerated
bond bpm/rotational               accelerated
fix 1 wall/gran                   accelerated
fix 2 wall/gran/region            accelerated
fix 3 gravity                     accelerated
fix 5 nve/bpm/sphere              accelerated
run verlet                        accelerated
steps without output              in the records
""", steps=5000, every=1000, long_steps=20000, bench_steps=10000,
               # angles come from a cosine: those of a new bond are up to 2e-8 in place of 0 in its second step, which damping by rates
               # of angles turns into motion; without damping of twist and bending 4e-9 is left of it
               shared={20260704: 3e-8}, volume=2e-4),
]


# ---- where they are ---------------------------------------------------------------------------

def of_version(version):
    """The inputs that LAMMPS of this version (yyyymmdd) has."""
    return [given for given in INPUTS if given.since <= version]


def present(source):
    """Names of all input scripts in the folders for grains of a source tree."""
    paths = [path for folder in FOLDERS for path in glob.glob(os.path.join(source, folder, "in.*"))]
    return {os.path.relpath(path, source) for path in paths} - OTHERS


def copy_companions(given, source, folder):
    """Put the files that an input may read into a folder: all that are next to it."""
    for path in glob.glob(os.path.join(source, os.path.dirname(given.name), "*")):
        if not os.path.basename(path).startswith(("log.", "in.")) and os.path.isfile(path):
            shutil.copy(path, folder)


def read_text(given, source):
    with open(os.path.join(source, given.name)) as file:
        return file.read()


# ---- scripts ----------------------------------------------------------------------------------

RUN = re.compile(r"^([ \t]*run[ \t]+)(\S+)(.*)$", re.MULTILINE)


def shortened(text, steps):
    """The script with no run longer than this. A length that is a variable becomes this number. All else stays."""
    def shorter(match):
        if match[2].isdigit() and int(match[2]) <= steps:
            return match[0]
        return f"{match[1]}{steps}{match[3]}    # instead of {match[2].strip('$')}"
    return RUN.sub(shorter, text)


TIME_STEP = re.compile(r"^([ \t]*timestep[ \t]+)(\S+)", re.MULTILINE)


def with_other_rounding(text):
    """The script with a time step that is larger by two roundings."""
    def longer(match):
        given = re.sub(r"^\$\{(\w+)\}$", r"v_\1", match[2])
        return f"{match[1]}$({given}*(1+4.4e-16):%.17g)"
    text, count = TIME_STEP.subn(longer, text)
    assert count, "the script has no command timestep"
    return text


def before_first_run(text, lines):
    """The script with these lines added."""
    place = RUN.search(text).start()
    return text[:place] + lines + text[place:]


# ---- what the log says ------------------------------------------------------------------------

INTERNAL_FIX = re.compile(r"fix [A-Z]+_[A-Z_]+\d* ")


def two_columns(line):
    """(what, verdict); the verdict is empty if two blanks are nowhere."""
    what, *verdict = re.split(r"\s{2,}", line.strip(), maxsplit=1)
    return what, "".join(verdict)


def read_tables(log):
    """Tables of the styles of a run in a log, each a list of (what, verdict); one that repeats the one before is left
    out, and so are fixes that LAMMPS and Talus add themselves."""
    tables, reading = [], False
    for line in log.splitlines():
        if line.rstrip() == HEADING:
            tables.append([])
            reading = True
        elif reading and line.startswith("  ") and line.strip():
            if not INTERNAL_FIX.match(line.strip()):
                tables[-1].append(two_columns(line))
        else:
            reading = False
    return [table for k, table in enumerate(tables) if k == 0 or table != tables[k - 1]]


def read_expected(text):
    """The same of a text with one paragraph for each table."""
    return [list(map(two_columns, block.splitlines())) for block in text.strip().split("\n\n")]


def differences(tables, expected):
    """Sentences on how the tables of a log differ from those expected; none if they fit."""
    if not tables:
        return [f"the log has no '{HEADING}': no style took the suffix, or the plugin was not loaded"]
    if len(tables) != len(expected):
        return [f"{len(tables)} different tables in the log instead of {len(expected)}"]
    found = []
    for k, (mine, theirs) in enumerate(zip(tables, expected), 1):
        if [what for what, _ in mine] != [what for what, _ in theirs]:
            found.append(f"table {k} lists {', '.join(what for what, _ in mine)} "
                         f"instead of {', '.join(what for what, _ in theirs)}")
            continue
        found += [f"table {k}: '{what}' is '{verdict}' instead of '{wanted}'"
                  for (what, verdict), (_, wanted) in zip(mine, theirs) if verdict != wanted]
    return found


def accelerated(log):
    """What the first table of a log says, in a few words: the styles that are accelerated, and where steps are made."""
    tables = read_tables(log)
    if not tables:
        return "nothing"
    styles = [what.split()[-1] for what, verdict in tables[0] if verdict == "accelerated"]
    counts = {style: styles.count(style) for style in styles}
    words = [f"{count} {style}" if count > 1 else style for style, count in counts.items()]
    records = any(what == STEPS and verdict == "in the records" for what, verdict in tables[0])
    return ", ".join(words or ["nothing"]) + ("; in the records" if records else "")
