# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Error against run time: what a time step costs in accuracy, and what an accuracy costs in time."""

import concurrent.futures
import dataclasses
import math

import accuracy_statistics
import errors
import machine
import methods
import paired
import plot
import report
import scenes

TITLE = "Error against run time"
QUESTION = """Which error does a time step make, with which law and which start, and how long does it take to get a
result with a given error, with Talus and with other codes? Small scenes are run with time steps over two decades and
more, and compared with an exact solution or a converged one; run times are measured with thousands of copies of the
same scene side by side, pinned to one core, in the same call."""

REFERENCE = 12      # the converged solution has the time step of the coarsest over 2^12
# run time of the faster stock style over that of order 2, in scenes that dissipate
AIMED_AT = {1e-3: 4.0, 1e-4: 10.0}
DISSIPATING = ("hooke damped", "mixed", "stack", "cluster")


def converged(bench, scene, law):
    """(states, Richardson's estimate of their error) of the law of some methods."""
    if scene.exact and law == "talus":
        states = []
        for time in (scene.middle, scene.time):
            x, v = scene.exact(time)
            states.append(methods.State(x, v, [(0.0, 0.0, 0.0)] * len(x), None))
        fine = methods.simulate(bench, scene, methods.SECOND_ORDER, scene.step / 2**REFERENCE)
        for exact, run in zip(states, fine):
            exact.f = run.f
        return states, 0.0
    method = methods.finest(law, scene)
    runs = [methods.simulate(bench, scene, method, scene.step / 2**k) for k in (REFERENCE - 1, REFERENCE)]
    return runs[1], errors.motion(errors.of(scene, runs[0], runs[1]))


def errors_of_scene(bench, scene, pool):
    """{method: [(dt, errors or None)]}, and {law: estimate of the error of its reference}."""
    names = methods.methods_for(scene)
    steps = scene.time_steps()
    laws = list(dict.fromkeys(methods.law_of(name, scene) for name in names))
    references = dict(zip(laws, pool.map(lambda law: converged(bench, scene, law), laws)))

    def one(job):
        name, dt = job
        try:
            states = methods.simulate(bench, scene, name, dt)
        except methods.Broken:
            return None
        return errors.of(scene, states, references[methods.law_of(name, scene)][0])
    jobs = [(name, dt) for name in names for dt in steps]
    results = dict(zip(jobs, pool.map(one, jobs)))
    return ({name: [(dt, results[name, dt]) for dt in steps] for name in names},
            {law: estimate for law, (_, estimate) in references.items()})


def costs_of_scenes(bench, wanted):
    """{scene: {method: ns per particle and step}}, in turn on one core."""
    core, found = paired.one_core(), {}
    for scene in wanted:
        bench.note(f"time of a step: {scene.name}")
        series = paired.measure({name: (lambda name=name: methods.step_cost(bench, scene, name, core))
                                 for name in methods.methods_for(scene)}, bench.size(3, 1))
        found[scene.name] = {name: s.median for name, s in series.items()}
    return found


class Ladder:
    """Errors of one method in one scene over the time steps, and what a step costs."""

    def __init__(self, points, nanoseconds):
        self.steps = [dt for dt, _ in points]
        self.by_quantity = {q: [e[q] if e else math.inf for _, e in points] for q in errors.QUANTITIES}
        self.motion = [errors.motion(e) if e else math.inf for _, e in points]
        self.nanoseconds = nanoseconds

    def order(self, quantity=None):
        return errors.order(self.steps, self.by_quantity[quantity] if quantity else self.motion)

    def seconds(self, dt):
        """Run time of one simulated second of one particle (s)."""
        return 1e-9 * self.nanoseconds / dt

    def needs(self, target):
        """Need for an error; beyond the finest time step by the fitted order; None without one."""
        dt = errors.step_for(target, self.steps, self.motion)
        if dt:
            return Need(dt, self.seconds(dt), True)
        order, finest = self.order(), min(zip(self.steps, self.motion))
        if not order or not target < finest[1] < math.inf:
            return None
        dt = finest[0] * (target / finest[1])**(1 / order)
        return Need(dt, self.seconds(dt), False)


@dataclasses.dataclass
class Need:
    """Time step and run time of one simulated second of one particle (s) for an error."""
    dt: float
    seconds: float
    measured: bool      # or extrapolated

    def cells(self):
        mark = "" if self.measured else "~"
        return [mark + report.number(self.dt), mark + report.number(self.seconds)]


# ---- tables -----------------------------------------------------------------------------------

def cell(value):
    return "rounding" if value is None else f"{value:.2f}"


def table_of_orders(section, results):
    rows = []
    for scene, ladders in results:
        for name, ladder in ladders.items():
            expected = scene.order[methods.family(name)]
            found = ladder.order()
            rows.append([scene.name, name, expected, cell(found),
                         *(cell(ladder.order(q)) for q in errors.QUANTITIES)])
    section.heading("Orders")
    section.table(["scene", "method", "expected", "motion", *errors.QUANTITIES], rows)
    section.text("""Slope of the logarithms over the finer half of the time steps; `rounding`: the errors are no larger
than that. motion: the largest of position, velocity and angular velocity, each relative to way and speed of the impact. Expected
is what theory says for the least accurate part: both starts and velocity Verlet are of second order for forces that
depend on positions only, if nothing acts at the start; forces that depend on velocity are computed with one that is
half a step old, which leaves first order, and with `order 2` second. A higher order than expected means that the coefficient of the lower one is
small there. Velocities of `half` and `order 2` are moved to the time of the positions by half a kick.""")


def explain_orders(section, results):
    """Every scene and method whose order is below theory by more than a quarter."""
    low = [(scene, name, ladder) for scene, ladders in results for name, ladder in ladders.items()
           if ladder.order() is not None and ladder.order() < scene.order[methods.family(name)] - 0.25]
    if not low:
        section.text("No fitted order is below the expected one by more than .25.")
        return
    section.text("Below the expected order by more than .25: " + "; ".join(
        f"{scene.name} with {name} ({ladder.order():.2f})" for scene, name, ladder in low) + ".")
    if any(scene.law.mu and "midpoint" not in name and scene.order["half"] == 2 for scene, name, _ in low):
        section.text("""In frictional scenes without damping this is the update of the tangential displacement: the methods
differ in nothing else from those with `midpoint`, whose order is in the row beside. The first step of a contact counts
whole, though the contact began within it, and directions are those of the end of the step.""")
    if any("midpoint" in name or name == methods.SECOND_ORDER for _, name, _ in low):
        section.text("""With `midpoint` and `order 2` the force in the middle of the contact is of second order (column force); what follows the
contact is not: a contact that sticks ends with a displacement left in its spring, whose stiffness goes to zero as the
square root of the overlap, and a force that ends like a square root is integrated to order 1.5.""")


def best(ladders, names, target):
    """(name, Need) of the fastest of some methods, of those first that get there within their time steps."""
    found = [(name, ladders[name].needs(target)) for name in names if name in ladders]
    found = [item for item in found if item[1]]
    return min(found, key=lambda item: (not item[1].measured, item[1].seconds), default=None)


def times(theirs, ours):
    """Ratio of the run times of two (name, Need)."""
    ratio = theirs[1].seconds / ours[1].seconds
    return ("" if theirs[1].measured and ours[1].measured else "~") + f"{ratio:.1f}", ratio


def table_of_costs(section, results):
    """The one table: time steps and run times for a given error, and ratios."""
    rows, slow, missed = [], {}, []
    for scene, ladders in results:
        for target in errors.TARGETS:
            ours, stock = best(ladders, methods.TALUS_METHODS, target), best(ladders, ("stock", "granular"), target)
            second, first = best(ladders, [methods.SECOND_ORDER], target), best(ladders, methods.FIRST_ORDER, target)
            row = [scene.name, f"{target:.0e}", *([ours[0], *ours[1].cells()] if ours else ["not reached", "", ""])]
            for theirs in (second, first, *(best(ladders, [name], target) for name in methods.OTHER_METHODS)):
                row += [*theirs[1].cells(), times(theirs, ours)[0]] if theirs and ours else ["-"] * 3
            rows.append(row)
            if not stock or not ours:
                continue
            if scene.law.mu and times(stock, ours)[1] < 4:
                slow.setdefault(scene.name, []).append((f"{target:.0e}", times(stock, ours)[0]))
            if scene.name in DISSIPATING and target in AIMED_AT and times(stock, second)[1] < AIMED_AT[target]:
                missed.append(f"{scene.name} {times(stock, second)[0]} in place of {AIMED_AT[target]:g} at {target:.0e}")
    section.heading("What an accuracy costs")
    columns = ["scene", "error", "Talus with", "dt", "s"]
    for other in (methods.SECOND_ORDER, "order 1", *methods.OTHER_METHODS):
        columns += [f"{other}: dt", "s", "times"]
    section.table(columns, rows)
    section.text("""dt (s): largest time step with which the motion has this error at the end, and with every smaller one
as well; s: run time in seconds for one simulated second of one particle. Talus with: the fastest of our methods that gets
there; order 1: the fastest of those without `order 2`; times: run time over that of the fastest of ours. `~`: the finest time
step of the scene does not get there, what would is extrapolated with the fitted order (table below). `-`: has no such law. In
scenes with damping no contact attracts (`limit_damping`), in every code. Where friction has a dashpot (`mixed`, `roll`, `cluster`),
sliding follows the rule `slider` with `order 2`, and the stock rule else: each is compared with the converged solution of its own law.
Talus is run with its run style, which
changes no bit of these scenes. A sphere of the impacts has half a pair in the neighbor list and touches during half of the time, so that
most of the time is that of moving spheres through memory, which differs less between codes than that of contacts does. In a
settled bed, with 3.5 pairs and 2.2 contacts for each sphere, it differs by more (section on one core).""")
    section.text("""Without damping and friction all methods are of second order, and `order 2` is worth nothing: the errors of
`hooke`, `hertz`, `chain` are those of the middle of the contact, not of its ends. `slip` is the same: a contact that slides from beginning to
end in one direction has no first-order error. In `stick` the spring that is left at the end limits the order, with every method.""")
    if missed:
        section.headline("accuracy: order 2 against the faster stock style, run time at equal error: " + "; ".join(missed) + ".")
    if slow:
        section.headline("accuracy: at equal error Talus takes more than a quarter of the run time of the faster stock style in these "
                         "small frictional scenes (run time of stock over that of Talus, at each error): "
                         + "; ".join(name + " " + ", ".join(f"{ratio} at {target}" for target, ratio in found)
                                     for name, found in slow.items()) + ".")


def table_of_steps(section, results, costs):
    names = list(dict.fromkeys(name for _, ladders in results for name in ladders))
    section.heading("Time of a step")
    section.table(["scene", *names], [[scene.name] + [costs[scene.name].get(name, float("nan")) for name in names]
                                      for scene, _ in results])
    section.text("ns per particle and step: copies of the scene at 1/32 of its coarsest time step, rebuilds included.")


def table_of_references(section, estimates):
    section.heading("References")
    section.table(["scene", "law", "error of the reference"],
                  [[name, law, "exact solution" if value == 0.0 else f"{value:.1e}"]
                   for name, found in estimates.items() for law, value in found.items()])
    section.text(f"""The converged solutions have the coarsest time step over 2^{REFERENCE}; their error is estimated by the
difference from twice that time step, which is at least the error itself. Talus and `gran/*` have one reference (`talus`), by
Talus with `order 2`, or with `half` and `midpoint` where friction has a dashpot, and `order 2` its own (`slider`). Pair granular and LIGGGHTS, whose lever arm of friction is the distance to the middle of
the overlap, have their own in scenes with friction.""")


# ---- plots ------------------------------------------------------------------------------------

def draw(plt, results, against_time):
    columns = 3
    rows = -(-(len(results) + 1) // columns)    # one more for the legend
    _, grid = plt.subplots(rows, columns, figsize=(9, 2.6 * rows), squeeze=False)
    order = methods.TALUS_METHODS + methods.OTHER_METHODS
    for k, (scene, ladders) in enumerate(results):
        axes = grid[k // columns][k % columns]
        for name, ladder in ladders.items():
            x = [ladder.seconds(dt) for dt in ladder.steps] if against_time else ladder.steps
            points = [(a, b) for a, b in zip(x, ladder.motion) if 0 < b < math.inf]
            axes.loglog(*zip(*points), label=name, **plot.style(order.index(name)))
        axes.set_title(scene.name, fontsize=9)
        axes.set_xlabel("run time of 1 s, per particle (s)" if against_time else "time step (s)")
        axes.set_ylabel("error of motion")
    for k in range(len(results), rows * columns):
        grid[k // columns][k % columns].axis("off")
    handles = {label: handle for row in grid for axes in row for handle, label in zip(*axes.get_legend_handles_labels())}
    grid[-1][-1].legend(handles.values(), handles.keys(), loc="center")


# ---- all --------------------------------------------------------------------------------------

def measure(bench):
    section = bench.section
    wanted = [s for s in scenes.deterministic() if bench.wants(s.name)]
    if bench.quick:
        for scene in wanted:
            scene.levels = min(scene.levels, 7)
    results, estimates = [], {}
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        for scene in wanted:
            bench.note(f"errors: {scene.name}")
            ladders, estimates[scene.name] = errors_of_scene(bench, scene, pool)
            results.append([scene, ladders])
    costs = costs_of_scenes(bench, wanted)
    for item in results:
        scene, points = item
        item[1] = {name: Ladder(points[name], costs[scene.name][name]) for name in points}
        for name, ladder in item[1].items():
            for k, dt in enumerate(ladder.steps):
                section.record(scene=scene.name, method=name, dt=dt, seconds=ladder.seconds(dt), motion=ladder.motion[k],
                               **{q: ladder.by_quantity[q][k] for q in errors.QUANTITIES})
    if results:
        section.table(["scene", "what"], [[scene.name, scene.what] for scene, _ in results])
        table_of_costs(section, results)
        section.plot("time", "Error of the motion against run time", lambda plt: draw(plt, results, True))
        table_of_orders(section, results)
        explain_orders(section, results)
        section.plot("step", "Error of the motion against the time step", lambda plt: draw(plt, results, False))
        table_of_steps(section, results, costs)
        table_of_references(section, estimates)
    accuracy_statistics.measure(bench)
