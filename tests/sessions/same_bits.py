# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: one trajectory. Outputs, ranks, threads, grids, sorting, and in boxes that are not periodic also the skin, rebuilds,
division into runs and restarts leave its bits as they are."""

import dataclasses
import random

import changes
import scenes
from pool import OK, Session
from quantities import text
from scene import not_finite, same_bits


@dataclasses.dataclass
class Plan:
    """How a scene is run: what the variations below change."""
    scene: object
    ranks: int = 1
    threads: int = 1
    grid: str = ""                                               # of processors
    beginning: list = dataclasses.field(default_factory=list)    # after the start: settings
    before_run: list = dataclasses.field(default_factory=list)
    program: list = dataclasses.field(default_factory=list)
    resume: tuple = ()    # (place in the program, ranks) of what another process makes first

    def session(self):
        """Of all that is made in one process."""
        scene = self.scene
        start = [text(words) for words in scene.start]
        lines = [*start, *self.settings(), *scene.beginning()[len(start):], *scene.physical(), *self.before_run, *self.program,
                 *scene.seen("end")]
        return Session(lines, self.ranks, self.threads, scene.words, scene.files())

    def settings(self):
        return [*([self.grid] if self.grid else []), *self.beginning]

    def again(self):
        """From a restart file up to the run."""
        start = [text(words) for words in self.scene.start if not text(words).startswith(("boundary", "fix"))]
        return [*start, *self.settings(), *changes.read_restart(self.scene, "half"), *self.scene.physical(again=True),
                *self.before_run]

    def sessions(self):
        """One, or two if another process makes the beginning."""
        if not self.resume:
            return [self.session()]
        place, ranks = self.resume
        writer = dataclasses.replace(self, ranks=ranks, grid="", program=[*self.program[:place], "write_restart half"]).session()
        writer.keep = ("half",)
        reader = Session([*self.again(), *self.program[place:], *self.scene.seen("end")], self.ranks, self.threads,
                         self.scene.words, self.scene.files())
        return [writer, reader]


def plan_of(scene):
    return Plan(scene, program=scene.steps())


# ---- variations: each changes a plan; periodic says whether it holds in periodic boxes ------------

def ranks(rng, plan):
    plan.ranks = rng.choice((2, 2, 2, 4))
    if rng.random() < 0.5:
        plan.grid = "processors " + rng.choice({2: ("2 1 1", "1 2 1", "1 1 2"), 4: ("4 1 1", "1 2 2", "2 1 2")}[plan.ranks])


def threads(rng, plan):
    plan.threads = 2
    plan.beginning.append("package omp 2")


def sorting(rng, plan):
    """A sort makes neighbor lists, which in a triclinic box rounds positions."""
    if any("triclinic" in words for words in plan.scene.beginning()):
        return
    plan.beginning.append(rng.choice(("atom_modify sort 0 0", "atom_modify sort 1 0.7", "atom_modify sort 7 0")))


def newton(rng, plan):
    if not plan.scene.traits & {"host", "bonded"}:
        plan.beginning.append("newton on")


def exchange(rng, plan):
    plan.before_run.append(rng.choice(("comm_proxy no", "comm_proxy yes", "run_style verlet/stock", "run_style verlet/proxy overlap yes",
                                       "run_style verlet/proxy overlap no", "run_style verlet", "comm_style tiled",
                                       "comm_modify cutoff 2.5", "comm_modify cutoff 3.5")))


def outputs(rng, plan):
    scene = plan.scene
    for n in range(rng.choice((1, 1, 2, 3))):
        plan.before_run += changes.output(rng, scene, n)


def neighbors(rng, plan):
    skins = "neighbor 0.02 bin", "neighbor 0.2 bin", "neighbor 0.5 bin", "neighbor 0.3 nsq", "neigh_modify every 1 delay 0 check no"
    seldom = "neigh_modify every 3 delay 0 check no", "neigh_modify delay 2 every 2"
    if "bonded" in plan.scene.traits:    # bridges ask for more where lists are those of LAMMPS
        skins = skins[1:]
    none = any(words.startswith("neighbor 0.0 ") for words in plan.scene.physical())
    plan.before_run.append(rng.choice(skins if none else skins + seldom))


def _first_run(plan):
    """Place and length of the first run in the program."""
    for n, step in enumerate(plan.program):
        if step.startswith("run ") and len(step.split()) == 2:
            return n, int(step.split()[1])
    return None, 0


def division(rng, plan):
    n, steps = _first_run(plan)
    if steps > 1:
        first = rng.randint(1, steps - 1)
        second = f"run {steps - first}" + rng.choice(("", "", " pre no", " post no", " every 3 NULL"))
        between = rng.choice(([], ["run 0"], ["write_data written"], ["write_restart written"]))
        plan.program[n:n + 1] = [f"run {first}", *([] if "pre" in second else between), second]


def restart(rng, plan):
    n, steps = _first_run(plan)
    if steps > 1:
        first = rng.randint(1, steps - 1)
        plan.program[n:n + 1] = [f"run {first}", "write_restart half", "clear", *plan.again(), f"run {steps - first}"]


def restart_elsewhere(rng, plan):
    """Another process with another number of ranks makes the beginning."""
    n, steps = _first_run(plan)
    if steps > 1:
        first = rng.randint(1, steps - 1)
        plan.program[n:n + 1] = [f"run {first}", f"run {steps - first}"]
        plan.resume = n + 1, rng.choice((1, 1, 2))


def _pause(plan):
    """Place of the second of two runs that follow each other."""
    n, _ = _first_run(plan)
    return n + 1 if n is not None and plan.program[n + 1:n + 2] and plan.program[n + 1].startswith("run ") else None


def restart_in_pause(rng, plan):
    n = _pause(plan)
    if n:
        plan.program[n:n] = ["write_restart half", "clear", *plan.again()]


def restart_in_pause_elsewhere(rng, plan):
    n = _pause(plan)
    if n:
        plan.resume = n, rng.choice((1, 1, 2))


def save_and_restore(rng, plan):
    n, steps = _first_run(plan)
    stresses = any("stress/atom" in words for words in plan.before_run)    # not to be read before the next step
    if steps > 1 and not stresses:
        first = rng.randint(0, steps - 1)
        more = rng.randint(1, 30)
        plan.program[n:n + 1] = [f"@advance {first}", "@save a", f"@advance {more}", "@restore a", f"@advance {steps - first}"]


def windows(rng, plan):
    """A partner advances, now and then a step of none."""
    n, steps = _first_run(plan)
    if steps:
        cuts = sorted(rng.randint(0, steps) for _ in range(rng.randint(1, 4)))
        plan.program[n:n + 1] = [f"@advance {b - a}" for a, b in zip((0, *cuts), (*cuts, steps))]


SETTINGS = ranks, ranks, threads, sorting, newton, exchange, outputs, outputs
PROGRAMS = save_and_restore, windows, division, restart, restart_elsewhere    # one of them at most, behind the settings
IN_PAUSE = restart_in_pause, restart_in_pause_elsewhere    # for scenes of two runs, which may not be one
AMONG_SUMS = exchange, outputs, outputs                    # where sums with rounding decide on the motion


def with_pause(rng, scene):
    """Its first run in two."""
    n, words = next((n, words) for n, words in enumerate(scene.program) if words[0] == "run")
    first = rng.randint(1, words[1] - 1)
    return scene.but(program=(*scene.program[:n], ("run", first), ("run", words[1] - first), *scene.program[n + 1:]))


def programs_of(scene):
    """fix deform looks at the length of a run. fix nve/sphere and nve/bpm/sphere end a step with forces that a set-up has not; wiggle
    begins its time anew and fix rigid its bodies where a file is read; histories of bonds are not saved in memory."""
    if "deform" in scene.traits:
        return ()
    if not scene.traits & {"host", "bonded"}:
        return PROGRAMS[:2] if "periodic" in scene.traits else PROGRAMS
    again = () if scene.traits & {"wiggle", "clumps"} else IN_PAUSE
    return PROGRAMS[1 if "bonded" in scene.traits else 0:2] + again


def draw(rng):
    """A scene, and names of variations with their seeds."""
    scene = changes.lifecycle(rng, scenes.any_scene(rng))
    programs = programs_of(scene)
    if restart_in_pause in programs:
        scene = with_pause(rng, scene)
    settings = AMONG_SUMS if "pressure" in scene.traits else SETTINGS if "periodic" in scene.traits else (*SETTINGS, neighbors)
    if "tilted" in scene.traits:    # a rebuild rounds positions there, and run_style verlet/stock has others
        settings = tuple(one for one in settings if one is not exchange)
    chosen = list(dict.fromkeys(rng.choices(settings, k=rng.choice((0, 1, 1, 2, 3)))))
    if programs and (not chosen or rng.random() < 0.4):
        chosen.append(rng.choice(programs))
    return scene, tuple((variation.__name__, rng.randrange(10**6)) for variation in chosen)


def check(run, scene, chosen):
    """The fault, or empty; sessions that show it."""
    plain, plan = plan_of(scene).session(), plan_of(scene)
    for name, seed in chosen:
        globals()[name](random.Random(seed), plan)
    expected = run(plain)
    if expected.kind != OK:
        return changes.fault_of_failure(expected), [plain]
    if not_finite(expected.seen):
        return "", [plain]
    *earlier, varied = plan.sessions()
    for session in earlier:
        found = run(session)
        if found.kind != OK:
            return changes.fault_of_failure(found) or f"refused: {found.text}", [plain, session]
        varied.files.update(found.kept)
    found = run(varied)
    if found.kind != OK:
        return changes.fault_of_failure(found) or f"refused: {found.text}", [plain, *earlier, varied]
    difference = same_bits(expected.seen, found.seen)
    return f"other bits: {difference}" if difference else "", [plain, *earlier, varied]
