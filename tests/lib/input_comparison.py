# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Input scripts of LAMMPS, run by plain LAMMPS and with -sf talus on 1 and 2 ranks, compared.

Contacts amplify rounding, by orders of magnitude with each impact. What may differ is therefore measured: by plain
LAMMPS on 1 and 2 ranks, and by its twin, plain LAMMPS with a time step that differs by two roundings. Positions and
the numbers that the script prints have to agree within what these differ by."""

import concurrent.futures
import os

import stock_inputs
from talus_testing import SceneCase, read_dump, run_lammps

PLAIN, TWIN, TALUS = "plain", "twin", "talus"
RANKS = 1, 2

POSITION = 1e-11        # diameters: roundings of steps without contacts
CHAOS = 1e-3            # diameters: positions that differ so much say nothing any more
PRINTED = 1e-7          # of the largest value of a column: what rounding leaves of 8 printed digits
AHEAD = 30.0            # times the spread of plain LAMMPS up to the next line or frame

# digits for all bits; positions in the box, whenever lists were rebuilt
FRAMES = """dump talus_frames all custom {every} talus_frames id radius x y z omegax omegay omegaz
dump_modify talus_frames format float %.17g pbc yes
"""
CLOCKS = {"CPU", "T/CPU", "S/CPU", "CPULeft"}


def source():
    return os.environ["TALUS_LAMMPS_SOURCE"]


def version():
    return int(os.environ["TALUS_LAMMPS_VERSION"])


# ---- runs -------------------------------------------------------------------------------------

class Run:
    """One run of an input: log, numbers printed, frames."""

    def __init__(self, given, steps, folder, code, ranks, error):
        self.folder = os.path.join(folder, f"{code}-{ranks}")
        os.mkdir(self.folder)
        stock_inputs.copy_companions(given, source(), self.folder)
        text = stock_inputs.shortened(stock_inputs.read_text(given, source()), steps)
        if code == TWIN:
            text = stock_inputs.with_other_rounding(text)
        text = stock_inputs.before_first_run(text, FRAMES.format(every=min(given.every, steps)))
        done = run_lammps(text, np=ranks, variables=given.variables, cwd=self.folder, name=given.title[3:],
                          arguments=["-sf", "talus"] if code == TALUS else [], expect_error=bool(error), timeout=1200,
                          env={} if code == TALUS else {"LAMMPS_PLUGIN_PATH": ""})
        self.log = done.log
        if not error:
            self.printed = printed(self.log)
            self.frames = read_dump(os.path.join(self.folder, "talus_frames"))


def run_all(given, steps, folder, error):
    """{(code, ranks): Run}; those on one rank side by side."""
    def one(code, ranks):
        return Run(given, steps, folder, code, ranks, error)

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        alone = {code: pool.submit(one, code, 1) for code in (PLAIN, TALUS, TWIN)}
        runs = {(code, 1): future.result() for code, future in alone.items()}
    return {**runs, **{(code, 2): one(code, 2) for code in (PLAIN, TALUS)}}


def is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def printed(log):
    """Thermodynamic output: list of {column: word as printed}, without clocks. Its first line comes after that on
    memory; columns may have any order."""
    rows, columns, title_is_next = [], None, False
    for line in log.splitlines():
        words = line.split()
        if line.startswith("Per MPI rank memory"):
            title_is_next = True
        elif title_is_next:
            columns, title_is_next = words, False
        elif line.startswith("Loop time of"):
            columns = None
        elif columns and len(words) == len(columns) and is_number(words[0]):
            rows.append({name: word for name, word in zip(columns, words) if name not in CLOCKS})
    return rows


# ---- numbers ----------------------------------------------------------------------------------

def column(run, name):
    return [float(row.get(name, "nan")) for row in run.printed]


def distances(run, other, name, scale):
    """Line by line, over the scale of the column."""
    return [abs(a - b) / scale for a, b in zip(column(run, name), column(other, name))]


def largest_up_to_next(values):
    return [max(values[:k + 2]) for k in range(len(values))]


def farthest(frame, other):
    """Largest distance along an axis of the particles of two frames, in diameters; CHAOS if they are not the same."""
    if sorted(frame.atoms) != sorted(other.atoms):
        return CHAOS
    radius, far = frame.column("radius"), 0.0
    for key in "xyz":
        its = other.column(key)
        far = max([far, *(abs(value - its[tag]) / (2 * radius[tag]) for tag, value in frame.column(key).items())])
    return far


class InputCase(SceneCase):
    """A test method for each input is added by tests_of()."""

    def compare(self, given, steps, rubs):
        error = given.error.get(version())
        runs = run_all(given, steps, self.dir, error)
        if error:
            for key, run in runs.items():
                self.assertIn(error, run.log, key)
            return
        with self.subTest("numbers"):
            for ranks in RANKS:
                self.check_particles(given, runs, ranks)
                self.check_printed(given, runs, ranks)
            if rubs:
                self.assertTrue(any(map(any, (row[-3:] for row in runs[TALUS, 1].frames[-1].atoms.values()))),
                                "nothing rotates: the runs are too short for contacts")
        with self.subTest("table"):
            for ranks in RANKS:
                self.check_table(given, runs[TALUS, ranks].log, ranks)

    def check_particles(self, given, runs, ranks):
        shared = given.shared.get(version(), 0.0)
        plain, talus = runs[PLAIN, ranks], runs[TALUS, ranks]
        self.assertEqual([f.step for f in plain.frames], [f.step for f in talus.frames])
        spread = [max(farthest(frame, f) for f in others) for frame, *others
                  in zip(*(runs[key].frames for key in ((PLAIN, 1), (PLAIN, 2), (TWIN, 1))))]
        for frame, ours, most in zip(plain.frames, talus.frames, largest_up_to_next(spread)):
            if most >= CHAOS:
                break
            self.assertEqual(sorted(frame.atoms), sorted(ours.atoms), f"IDs at step {frame.step} on {ranks} ranks")
            self.assertLessEqual(farthest(frame, ours), POSITION + AHEAD * max(most, shared),
                                 f"positions at step {frame.step} on {ranks} ranks")

    def check_printed(self, given, runs, ranks):
        plain, talus = runs[PLAIN, ranks], runs[TALUS, ranks]
        self.assertTrue(plain.printed, "nothing was printed")
        if given.exact:
            self.assertEqual(plain.printed[:2], talus.printed[:2])
        self.assertEqual([row.keys() for row in plain.printed], [row.keys() for row in talus.printed])
        for name in plain.printed[-1]:
            scale = max(map(abs, column(plain, name))) or 1.0
            spread = [max(two) for two in zip(*(distances(runs[PLAIN, 1], runs[key], name, scale)
                                                for key in ((PLAIN, 2), (TWIN, 1))))]
            allowed = [PRINTED + AHEAD * max(value, given.shared.get(version(), 0.0)) for value in largest_up_to_next(spread)]
            more = given.volume if name in ("Pxx", "Pyy", "Pzz") else 0.0
            for k, off in enumerate(distances(plain, talus, name, scale)):
                self.assertLessEqual(off, allowed[k] + more, f"{name} in line {k + 1} of the output on {ranks} ranks")

    def check_table(self, given, log, ranks):
        found = stock_inputs.differences(stock_inputs.read_tables(log), stock_inputs.read_expected(given.tables))
        if found:
            self.fail("\n  ".join([f"the log of {given.name} on {ranks} ranks, {self.dir}:", *found]))


def tests_of(length):
    """A class of tests with a method for each input.  length: "short" or "long"."""
    def of_input(given):
        steps = given.steps if length == "short" else given.long_steps
        return lambda self: self.compare(given, steps, given.rubs in (length, "both"))

    def all_listed(self):
        self.assertEqual(stock_inputs.present(source()), {given.name for given in stock_inputs.of_version(version())})

    methods = {"test_" + given.title[3:].replace(".", "_"): of_input(given) for given in stock_inputs.of_version(version())}
    return type("Inputs", (InputCase,), {**methods, "test_no_input_is_left_out": all_listed})
