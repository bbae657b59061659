#!/usr/bin/env python3
# ctest: stay
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=55 timeout=300
"""Pair style granular with the suffix talus against the stock style: the same script, with and without -sf talus.

Particles are driven, so that both styles see the same positions and velocities: what differs are the contacts alone.
TALUS_GRANULAR_MODELS: number of models that are drawn at random (default 16, in long test runs 40)."""

import itertools
import os
import random
import re
import unittest

import granular_models
from talus_testing import SceneCase, Sphere, head, max_difference, part_of, read_dump, read_local, thermo, write_sphere_data

TOLERANCE = 5e-13
VECTORS = ("fx", "fy", "fz"), ("tqx", "tqy", "tqz")

DRIVEN = """
units lj
boundary f f f
newton {newton}
atom_style sphere
atom_modify map yes sort 0 0.0
comm_modify vel yes
read_data data
{shift}
pair_style granular
{coeffs}
neighbor {skin} bin
timestep 0.001
group some id 1:1000:2
fix drive some move wiggle {amplitude} 0.7
thermo 1000
thermo_modify lost ignore
compute one all pair/local dist force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 p12
compute who all property/local patom1 patom2
dump first all custom 1 first id fx fy fz tqx tqy tqz
dump_modify first format float %.17g
dump more all custom 333 more id fx fy fz tqx tqy tqz
dump_modify more format float %.17g
dump pairs all local 1000 pairs index c_who[*] c_one[*]
dump_modify pairs format float %.17g
run 1
undump first
run 999
"""


def packing(rng, count, sizes, types):
    """Spheres in a clump that overlap a little, at rest but for their spins."""
    edge = 0.8 * (sum(sizes) / len(sizes)) * count**(1 / 3)
    spheres = []
    while len(spheres) < count:
        d = rng.choice(sizes) * rng.uniform(0.9, 1.0)
        x = tuple(rng.uniform(0.0, edge) for _ in range(3))
        gaps = [(sum((a - b)**2 for a, b in zip(x, s.x))**0.5 - 0.5 * (d + s.diameter), min(d, s.diameter))
                for s in spheres]
        if any(gap < -0.1 * least for gap, least in gaps):
            continue
        if spheres and not any(gap < 0.0 for gap, least in gaps) and rng.random() < 0.8:
            edge *= 1.002
            continue
        omega = tuple(rng.gauss(0.0, 0.2) for _ in range(3))
        spheres.append(Sphere(x, (0.0,) * 3, omega, d, type=1 + len(spheres) % types))
    return spheres


def length(row):
    return sum(v * v for v in row)**0.5


def number_of_models():
    return int(os.environ.get("TALUS_GRANULAR_MODELS", 40 if os.environ.get("TALUS_LARGE_TESTS") else 16))


class Case(SceneCase):
    def run_suffix(self, suffix, name, text, **options):
        cwd = self.path(name)
        os.makedirs(cwd, exist_ok=True)
        data = os.path.join(cwd, "data")
        if os.path.exists(self.path("data")) and not os.path.exists(data):
            os.symlink(self.path("data"), data)
        return self.run_lammps(text, cwd=cwd, arguments=["-sf", "talus"] if suffix else [], **options)

    def is_new(self):
        log = self.run_lammps("run 0\n", expect_error=True).log
        return bool(re.search(r"LAMMPS \(.* 202[6-9]", log))

    def assert_accelerated(self, log):
        self.assertRegex(log, r"pair granular +accelerated")


NO_PARTICLES = head(map=None) + """
region box block 0 8 0 8 0 8
create_box 4 box
create_atoms 2 single 4 4 4
set group all diameter 1.5 density 1.0
pair_style granular
pair_coeff * * hertz/material 1e6 0.5 0.3 tangential mindlin NULL 1.0 0.5
neighbor 0.25 bin
fix move all nve/sphere
run 0
"""


class TestTypes(Case):
    def test_types_without_particles_have_the_largest_radius(self):
        """New memory is not zero here (MALLOC_PERTURB_): the cutoff would be 1e306."""
        for suffix in False, True:
            log = self.run_suffix(suffix, f"suffix_{suffix}", NO_PARTICLES, env={"MALLOC_PERTURB_": 128}).log
            self.assertRegex(log, r"master list distance cutoff = 1\.75\n")


class TestModels(Case):
    """Contacts one by one: forces and torques after one step, and after 1000 with their histories."""

    of_rolling = 1e-9

    def frames(self, name):
        return read_dump(self.path(f"{name}/first"))[-1:] + read_dump(self.path(f"{name}/more"))

    def compare_frames(self, stock, ours, again):
        """Particles that differ, where the stock style does not differ as much from itself in a box that was moved by
        a rounding error: of these a contact is at a threshold."""
        found, at_threshold = [], 0
        for n, (a, b) in enumerate(zip(stock, ours, strict=True)):
            self.assertEqual(a.step, b.step)
            for columns in VECTORS:
                where = [a.columns.index(c) for c in columns]
                pick = lambda frame: {tag: [row[k] for k in where] for tag, row in frame.atoms.items()}
                mine, theirs = pick(b), pick(a)
                scale = max(map(length, theirs.values()))
                for tag, row in theirs.items():
                    difference = length([p - q for p, q in zip(row, mine[tag])])
                    if difference <= TOLERANCE * scale:
                        continue
                    moved = pick(again()[n])[tag]
                    if difference <= 20 * length([p - q for p, q in zip(row, moved)]):
                        at_threshold += 1
                        continue
                    found.append((difference / scale, f"step {a.step}, particle {tag}, {columns[0]}...: {row}, but {mine[tag]}"))
        return sorted(found, reverse=True), at_threshold

    def compare_pairs(self, frame, other):
        """What compute pair/local says. Of what is odd in the order of the two particles the sign depends on it."""
        odd = {3, 4, 5, 12, 13, 14}    # behind distance and force: friction and separation, but not rolling

        def by_pair(frame):
            rows = {}
            for row in frame.rows:
                i, j = int(row[1]), int(row[2])
                values = [(-v if i > j and k + 1 in odd else v) for k, v in enumerate(row[3:])]
                rows[min(i, j), max(i, j)] = values
            return rows
        a, b = by_pair(frame), by_pair(other)
        touching = [k for k in a if any(a[k][2:])]
        self.assertEqual(sorted(touching), sorted(k for k in b if any(b[k][2:])))
        self.assertGreater(len(touching), 2)
        return a, b, touching

    def assert_same_pairs(self):
        stock, ours = (read_local(self.path(f"{n}/pairs"))[-1] for n in ("stock", "ours"))
        a, b, touching = self.compare_pairs(stock, ours)
        friction = max(length(a[k][2:6]) for k in touching)
        for first, last in (1, 2), (2, 6), (6, 10), (10, 11), (11, 14):
            if (first, last) in self.undefined:
                continue
            tolerance = self.of_rolling if (first, last) == (6, 10) else 1e-9
            scale = max(friction, *(length(a[k][first:last]) for k in touching))
            worst = max((length([p - q for p, q in zip(a[k][first:last], b[k][first:last])]), k) for k in touching)
            few = [k for k in touching if length([p - q for p, q in zip(a[k][first:last], b[k][first:last])]) > tolerance * scale]
            self.assertLessEqual(len(few), self.at_threshold,
                                 f"values {first} to {last} of pair {worst[1]}: {a[worst[1]]}, but {b[worst[1]]}")

    def check(self, coeffs, rng, sizes, types, newton, resists):
        write_sphere_data(self.path("data"), ((-10.0, 20.0),) * 3, packing(rng, 70, sizes, types), types)
        least = min(sizes)
        settings = dict(newton=newton, coeffs=coeffs, skin=0.4 if resists else 0.05, shift="",
                        amplitude=" ".join(f"{rng.uniform(-0.05, 0.05) * least:.6g}" for _ in range(3)))
        self.run_suffix(False, "stock", DRIVEN.format(**settings))
        log = self.run_suffix(True, "ours", DRIVEN.format(**settings)).log
        self.assert_accelerated(log)
        moved = []

        def again():
            if not moved:
                shift = "displace_atoms all move 3e-15 -3e-15 3e-15"
                self.run_suffix(False, "again", DRIVEN.format(**{**settings, "shift": shift}))
                moved.extend(self.frames("again"))
            return moved
        found, self.at_threshold = self.compare_frames(self.frames("stock"), self.frames("ours"), again)
        self.assertFalse(found, f"{len(found)} differ, at most by {found[0][0]:.1e}: {found[0][1]}" if found else "")
        self.assert_same_pairs()
        return self.at_threshold

    def draw(self, rng, number):
        """Every sub-model comes up as often as others of its kind."""
        every = granular_models.combinations()
        kinds = list(zip(*every))
        drawn = []
        while len(drawn) < number:
            choice = tuple(rng.choice(sorted(set(kind))) for kind in kinds)
            if granular_models.allowed(choice[0], choice[1], choice[2], choice[4]):
                drawn.append(choice)
        return drawn

    def test_models(self):
        rng = random.Random(20250204)
        number = number_of_models()
        self.check_models(rng, self.draw(rng, number))

    def test_synchronized(self):
        """Pairs of types may differ in it. In p5 to p7 of LAMMPS there is a part along the normal, which no torque has."""
        if not self.is_new():    # from 4 Jul 2026 on
            self.assert_unknown("synchronized_verlet")
            return
        self.of_rolling = 1e-3
        rng = random.Random(20260704)
        number = max(12, number_of_models() // 4)
        drawn = [c for c in self.draw(rng, 3 * number) if granular_models.synchronized(c)]
        self.check_models(rng, drawn[:number], "synchronized_verlet")

    def assert_unknown(self, keyword):
        """To LAMMPS and to us: the same message."""
        write_sphere_data(self.path("data"), ((-10.0, 20.0),) * 3, packing(random.Random(1), 20, (1.0,), 1), 1)
        text = DRIVEN.format(newton="on", skin=0.1, shift="", amplitude="0 0 0", coeffs="pair_coeff * * hertz/material "
                             f"1e4 5.0 0.3 tangential linear_history 1000 1.0 0.5 {keyword}")
        errors = [re.search(r"ERROR.*?: (.*)", self.run_suffix(suffix, "run", text, expect_error=True).log)[1]
                  for suffix in (False, True)]
        self.assertEqual(*errors)
        self.assertIn(keyword, errors[0])

    def check_models(self, rng, drawn, keyword=""):
        number, left_out = len(drawn), 0
        for n, combination in enumerate(drawn):
            types = 1 + n % 3
            sizes = ((1.0,), (0.1, 1.0))[n // 3 % 2]
            limit = n % 4 == 0
            each = [f"{granular_models.words(combination, rng, limit)} {keyword}" for _ in range(types)]
            coeffs = "".join(f"pair_coeff {t} {t} {w}\n" for t, w in enumerate(each, 1))
            other = None
            if types == 3 and n % 2:    # a pair of types with a model of its own
                other, = self.draw(rng, 1)
                coeffs += f"pair_coeff 1 2 {granular_models.words(other, rng)}\n"
            seed = rng.random()
            # a new list may have the other particle of a pair first, and then the stock style turns what is remembered of
            # rolling and twisting around
            resists = any(set(c[3:]) != {"none"} for c in (combination, other or combination))
            # memory that the stock style has not written
            self.undefined = {columns for place, columns in ((3, (6, 10)), (4, (10, 11)))
                              if "none" in (combination[place], (other or combination)[place])}
            newton = "off" if resists else ("on", "off")[n % 2]
            with self.subTest(n=n, models=combination, other=other, types=types, sizes=sizes, newton=newton):
                for name in "stock", "ours", "again":
                    for file in "first", "more", "pairs":
                        if os.path.exists(self.path(f"{name}/{file}")):
                            os.remove(self.path(f"{name}/{file}"))
                left_out += self.check(coeffs, random.Random(seed), sizes, types, newton, resists)
        print(f"{number} models, {left_out} forces at a threshold left out")
        self.assertLess(left_out, 10 * number)


class TestRefused(Case):
    """What the stock style refuses ends in its message."""

    def test_messages(self):
        write_sphere_data(self.path("data"), ((-10.0, 20.0),) * 3, packing(random.Random(1), 20, (1.0,), 2), 2)
        base = "pair_coeff * * hertz/material 1e4 5.0 0.3 tangential linear_history 1000 1.0 0.5"
        for coeffs in ("pair_coeff * * jkr 1e4 0.5 0.3 1.0 damping tsuji tangential mindlin NULL 1.0 0.5",
                       "pair_coeff * * dmt 1e4 0.5 0.3 1.0 tangential mindlin NULL 1.0 0.5 limit_damping",
                       "pair_coeff * * hooke 1e4 0.5 tangential mindlin NULL 1.0 0.5",
                       "pair_coeff * * hooke 1e4 0.5",
                       "pair_coeff * * hooke 1e4 0.5 damping none tangential linear_nohistory 1.0 0.5",
                       "pair_coeff * * hooke 1e4 0.5 tangential linear_history -2.0 1.0 0.5",
                       "pair_coeff * * unknown 1e4 0.5 tangential linear_nohistory 1.0 0.5",
                       f"{base}\npair_coeff 2 2 hooke 1e3 5.0 tangential linear_history 1000 1.0 0.5\n"
                       "pair_coeff 1 1 hertz 1e3 5.0 tangential mindlin 1000 1.0 0.5".replace("* *", "1 1"),
                       f"{base}\npair_coeff 2 2 hertz/material 1e4 5.0 0.3 tangential mindlin 1000 1.0 0.5".replace(
                           "* *", "1 1")):
            with self.subTest(coeffs=coeffs):
                text = DRIVEN.format(newton="on", coeffs=coeffs, skin=0.1, shift="", amplitude="0 0 0")
                errors = [re.search(r"ERROR.*?: (.*)", self.run_suffix(suffix, "run", text, expect_error=True).log)[1]
                          for suffix in (False, True)]
                self.assertEqual(*errors)


SCENE = """
units lj
boundary {boundary}
newton {newton}
{before}
{style}
comm_modify vel yes
{read}
atom_modify sort 0 0.0
pair_style granular
{coeffs}
neighbor 0.1 bin
timestep 0.001
fix step all nve/sphere
{more}
thermo_style custom step pe ke press pxy
thermo_modify format float %.17g norm no lost ignore
thermo {every}
dump state all custom {every} state id xu yu zu vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify state format float %.17g first yes
{run}
"""
ROLLS = "hertz/material 1e4 5.0 0.3 tangential mindlin NULL 1.0 0.5 rolling sds 500.0 10.0 0.1"
HISTORIES = {
    "linear": "hooke 2000.0 5.0 damping mass_velocity tangential linear_history 1000 1.0 0.5",
    "mindlin and rolling": ROLLS,
    "rescaled": "hertz 5000.0 5.0 tangential mindlin_rescale/force 1500 1.0 0.5 rolling sds 500.0 10.0 0.1",
    "twisting": ROLLS + " twisting marshall",
    "twisting alone": "hooke 2000.0 5.0 tangential linear_nohistory 1.0 0.5 twisting sds 200.0 1.0 0.1",
    "rolling alone": "hooke 2000.0 5.0 tangential linear_nohistory 1.0 0.5 rolling sds 500.0 10.0 0.1",
    "cohesive": "jkr 1e4 5.0 0.3 5.0 tangential mindlin NULL 1.0 0.5 rolling sds 500.0 10.0 0.1 twisting marshall",
    "synchronized": ROLLS + " twisting marshall synchronized_verlet",
    "cohesive and smooth in memory": "jkr 1e4 5.0 0.3 5.0 tangential linear_nohistory 1.0 0.5",
}


# The stock style turns histories of rolling and twisting around where a new list has the other particle of a pair first:
# with newton on it may at any rebuild, else only where particles are sorted or migrate.

def moving(seed, count=120, types=2, edge=4.5):
    """Grains in a box that is as wide as they need, in motion."""
    rng = random.Random(seed)
    spheres = packing(rng, count, (0.5, 0.9), types)
    far = max(max(s.x) for s in spheres)
    box = ((-0.02, max(edge, far + 0.02)),) * 3
    for s in spheres:
        s.v = tuple(rng.gauss(0.0, 0.5) for _ in range(3))
        s.omega = tuple(rng.gauss(0.0, 0.8) for _ in range(3))
    return spheres, box


class Moving(Case):
    def histories(self):
        """The word synchronized_verlet came with LAMMPS of 4 Jul 2026."""
        return {title: words for title, words in HISTORIES.items() if title != "synchronized" or self.is_new()}

    def setUp(self):
        super().setUp()
        spheres, self.box = moving(7)
        write_sphere_data(self.path("data"), self.box, spheres, 2)

    def scene(self, **options):
        settings = dict(boundary="s s s", newton="off", before="", style="atom_style sphere\natom_modify map yes", read="read_data data", more="", every=20, run="run 40",
                        coeffs="")
        settings.update(options)
        return SCENE.format(**settings)

    def assert_close_frames(self, frames, others, tolerance):
        self.assertEqual([f.step for f in frames], [f.step for f in others])
        for a, b in zip(frames, others):
            for group in ("xu", "yu", "zu"), ("vx", "vy", "vz"), ("omegax", "omegay", "omegaz"), *VECTORS:
                scale = max(max(map(abs, a.column(c).values())) for c in group)
                self.assertLessEqual(max_difference(a, b, group), tolerance * scale, f"{group[0]} at {a.step}")


class TestRestart(Moving):
    """The histories of one are those of the other."""

    def run_on(self, name, suffix, file, np, coeffs):
        """The stock style does not read its cutoff: so pair_style stands in the script once more; and pair_coeff with the
        word that restart files do not know."""
        coeffs = coeffs if "synchronized" in coeffs else ""
        text = self.scene(read=f"read_restart {file}", style="", coeffs=coeffs).replace("units lj\nboundary s s s\n", "")
        return self.run_suffix(suffix, name, text, np=np).log

    def test_crossing(self):
        for (title, words), np in part_of(itertools.product(self.histories().items(), (1, 2)), 3):
            if re.search("rolling|twisting", words) and np > 1:
                continue    # the stock style itself may turn these around
            with self.subTest(model=title, ranks=np):
                tag = f"{title.replace(' ', '-')}-{np}"
                run = "run 40\nwrite_restart restart\nrun 40"
                coeffs = f"pair_coeff * * {words}"
                text = self.scene(coeffs=coeffs, run=run)
                self.run_suffix(False, f"stock-{tag}", text, np=np)
                self.assert_accelerated(self.run_suffix(True, f"ours-{tag}", text, np=3 - np).log)
                whole = [f for f in read_dump(self.path(f"stock-{tag}/state")) if f.step > 40]
                for writer in "stock", "ours":
                    for suffix in False, True:
                        with self.subTest(writer=writer, reader="ours" if suffix else "stock"):
                            name = f"{writer}-{suffix}-{tag}"
                            log = self.run_on(name, suffix, self.path(f"{writer}-{tag}/restart"), np, coeffs)
                            self.assertEqual("Talus granular" in log, suffix)
                            self.assertRegex(log, "fix style: (NEIGH_HISTORY|CONTACT_STORE)")
                            frames = [f for f in read_dump(self.path(f"{name}/state")) if f.step > 40]
                            self.assert_close_frames(whole, frames, 1e-9)


class TestBits(Moving):
    """The same on any number of ranks and threads."""

    def test_ranks_and_threads(self):
        titles = [title for title in ("mindlin and rolling", "rescaled", "twisting", "cohesive", "synchronized")
                  if title in self.histories()]
        for title, boundary in part_of(itertools.product(titles, ("s s s", "p p p")), 3):
            with self.subTest(model=title, boundary=boundary):
                text = self.scene(coeffs=f"pair_coeff * * {HISTORIES[title]}", boundary=boundary, run="run 300", every=100)
                frames = []
                for np, threads in (1, 1), (2, 1), (4, 1), (1, 2), (2, 2):
                    name = f"{title.replace(' ', '-')}-{boundary[0]}-{np}-{threads}"
                    log = self.run_suffix(True, name, text, np=np, env={"OMP_NUM_THREADS": str(threads)}).log
                    self.assert_accelerated(log)
                    frames.append(read_dump(self.path(f"{name}/state")))
                for others in frames[1:]:
                    for a, b in zip(frames[0], others, strict=True):
                        self.assert_same_bits(a, b)


class TestMoving(Moving):
    """Particles in free motion, with walls."""

    def compare(self, tolerance=1e-9, **options):
        text = self.scene(**options)
        stock = self.run_suffix(False, "stock", text)
        ours = self.run_suffix(True, "ours", text)
        self.assert_close_frames(read_dump(self.path("stock/state")), read_dump(self.path("ours/state")), tolerance)
        for a, b in zip(thermo(stock.log), thermo(ours.log), strict=True):
            for key in a:
                self.assertLessEqual(abs(a[key] - b[key]), 1e-8 * max(1.0, abs(a[key])), f"{key} at {a['Step']}")
        return ours.log

    def test_models(self):
        for title, words in self.histories().items():
            with self.subTest(model=title):
                self.assert_accelerated(self.compare(coeffs=f"pair_coeff * * {words}"))

    def test_walls(self):
        """Walls use the contact models of LAMMPS itself."""
        low, high = self.box[0]
        walls = {"fix wall/gran": f"fix w all wall/gran granular {{words}} zplane {low} {high}",
                 "fix wall/gran/region": f"region w block {low} {high} {low} {high} {low} {high}\n"
                                         "fix w all wall/gran/region granular {words} region w"}
        for title in "mindlin and rolling", "twisting", "cohesive":
            for name, wall in walls.items():
                with self.subTest(model=title, wall=name):
                    log = self.compare(coeffs=f"pair_coeff * * {HISTORIES[title]}", more=wall.format(words=HISTORIES[title]))
                    self.assert_accelerated(log)
                    self.assertRegex(log, rf"{name.replace('fix ', 'fix w ')} +accelerated")
                    self.assertRegex(log, "steps without output +in the records")

    def test_cutoffs(self):
        """That of the style, of a pair of types, and the larger ones that contacts need."""
        words = HISTORIES["cohesive"]
        for style, coeff in ("granular 1.5", f"* * {words}"), ("granular", f"* * {words} cutoff 1.7"), ("granular 0.2", f"* * {words}"):
            text = self.scene(coeffs=f"pair_coeff {coeff}").replace("pair_style granular", f"pair_style {style}")
            cuts = [re.search("master list distance cutoff = (\\S+)", self.run_suffix(s, "run", text).log)[1] for s in (False, True)]
            self.assertGreaterEqual(float(cuts[1]), float(cuts[0]))

    def test_several_runs_and_time_steps(self):
        run = "run 20\ntimestep 0.0005\nrun 20\nrun 20 pre no\nvelocity all scale 0.1\nrun 20"
        for title in "linear", "mindlin and rolling", "rescaled", "twisting":
            with self.subTest(model=title):
                self.compare(coeffs=f"pair_coeff * * {HISTORIES[title]}", run=run, every=10)

    def test_radii_that_change(self):
        for every, amplitude in (1, 0.02), (10, 0.05):
            with self.subTest(every=every):
                more = (f"variable factor equal 1+{amplitude}*sin(step*0.05)\ngroup two type 2\n"
                        f"fix breathe two adapt {every} atom diameter v_factor scale yes")
                log = self.compare(coeffs=f"pair_coeff * * {HISTORIES['cohesive']}", more=more, run="run 100",
                                   style="atom_style sphere 1\natom_modify map yes")
                self.assert_accelerated(log)

    def test_rerun(self):
        """Contacts that have begun in one snapshot last in the next."""
        coeffs = f"pair_coeff * * {HISTORIES['cohesive']}"
        self.run_suffix(False, "stock", self.scene(coeffs=coeffs, run="run 200", every=10).replace("id xu yu zu", "id x y z"))
        frames = []
        for suffix in False, True:
            name = f"again-{suffix}"
            text = self.scene(coeffs=coeffs, every=10, run="rerun ../stock/state dump x y z vx vy vz box yes")
            self.run_suffix(suffix, name, text.replace("vx vy vz omegax omegay omegaz", "vx vy vz", 1))
            frames.append(read_dump(self.path(f"{name}/state")))
        self.assertEqual(len(frames[0]), 21)
        for a, b in zip(*frames, strict=True):
            for group in VECTORS:
                scale = max(max(map(abs, a.column(c).values())) for c in group)
                self.assertLessEqual(max_difference(a, b, group), 5e-13 * scale, f"{group[0]} at {a.step}")

    def test_models_that_change_between_runs(self):
        words = HISTORIES["mindlin and rolling"]
        log = self.compare(coeffs=f"pair_coeff * * {words}", run=f"run 20\npair_coeff 2 2 {words.replace('500.0', '900.0')}\nrun 20")
        self.assert_accelerated(log)
        run = f"run 20\npair_coeff 2 2 {HISTORIES['twisting']}\npair_coeff 1 2 {words}\nrun 20\nwrite_restart restart\nrun 5"
        self.assert_accelerated(self.run_suffix(True, "more", self.scene(coeffs=f"pair_coeff * * {words}", run=run)).log)


class TestHeat(Moving):
    """Temperatures and heat flows of particles, conduction in contacts and into walls."""

    MODELS = {
        "area": "hertz/material 1e4 0.3 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji heat area 5.0",
        "radius": "jkr 1e4 0.3 0.3 5.0 tangential linear_history 3000.0 1.0 0.5 heat radius 2.0",
        "hooke": "hooke 5e3 5.0 tangential linear_nohistory 1.0 0.5 damping velocity rolling sds 500.0 2.0 0.1 heat radius 3.0",
    }
    READ = "fix heat all property/atom temperature heatflow\nread_data data\n"
    FLOW = """set group all temperature 1.0
set type 2 temperature 4.0
fix flow all heat/flow constant 1.5
compute hot all property/atom temperature heatflow
dump heat all custom {every} heat id c_hot[1] c_hot[2]
dump_modify heat format float %.17g
"""

    def heated(self, words, more="", every=20, **options):
        return self.scene(coeffs=f"pair_coeff * * {words}", read=self.READ, every=every,
                          more=self.FLOW.format(every=every) + more, **options)

    def compare(self, words, tolerance=1e-9, **options):
        text = self.heated(words, **options)
        self.run_suffix(False, "stock", text)
        log = self.run_suffix(True, "ours", text).log
        self.assert_close_frames(read_dump(self.path("stock/state")), read_dump(self.path("ours/state")), tolerance)
        frames = read_dump(self.path("stock/heat"))
        for a, b in zip(frames, read_dump(self.path("ours/heat")), strict=True):
            for column in "c_hot[1]", "c_hot[2]":
                scale = max(map(abs, a.column(column).values()))
                self.assertLessEqual(max_difference(a, b, [column]), tolerance * scale, f"{column} at step {a.step}")
        self.assertGreater(max(map(abs, frames[-1].column("c_hot[2]").values())), 0.1)
        return log

    def test_models(self):
        for title, words in self.MODELS.items():
            for newton in "on", "off":
                if newton == "on" and "rolling" in words:
                    continue    # not the same in two runs of LAMMPS either
                with self.subTest(model=title, newton=newton):
                    log = self.compare(words, newton=newton)
                    self.assert_accelerated(log)
                    self.assertRegex(log, "steps without output +in the records")

    def test_after_one_step(self):
        for title, words in self.MODELS.items():
            with self.subTest(model=title):
                self.compare(words, tolerance=5e-13, run="run 1", every=1)

    def test_walls(self):
        low, high = self.box[0]
        turn = "variable hot equal 2.0+20*step*dt\n"
        walls = {"plane": f"fix w all wall/gran granular {{words}} zplane {low} {high} temperature 7.0",
                 "variable": turn + f"fix w all wall/gran granular {{words}} zplane {low} {high} temperature v_hot contacts",
                 "region": f"region w block {low} {high} {low} {high} {low} {high}\n"
                           "fix w all wall/gran/region granular {words} region w temperature 7.0 contacts"}
        words = self.MODELS["area"]
        for title, wall in walls.items():
            with self.subTest(wall=title):
                log = self.compare(words, more=wall.format(words=words) + "\n", run="run 200", every=50, tolerance=1e-8)
                self.assertRegex(log, r"fix w wall/gran(/region)? +accelerated")

    def test_pair_local(self):
        words = self.MODELS["area"]
        local = """compute one all pair/local dist force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 p12 p13
compute who all property/local patom1 patom2
dump pairs all local 20 pairs index c_who[*] c_one[*]
dump_modify pairs format float %.17g
"""
        # LAMMPS computes p13 with the temperatures of the last pair that it came across
        self.run_suffix(True, "ours", self.heated(words, more=local, newton="off", run="run 20"))
        flow = dict.fromkeys(range(1, 1000), 0.0)
        for row in read_local(self.path("ours/pairs"))[-1].rows:
            flow[int(row[1])] += row[-1]
            flow[int(row[2])] -= row[-1]
        heat = read_dump(self.path("ours/heat"))[-1].column("c_hot[2]")
        scale = max(map(abs, heat.values()))
        for tag, expected in heat.items():    # temperatures have gone on by one step
            self.assertLessEqual(abs(flow[tag] - expected), 0.02 * scale, f"particle {tag}")

    def test_ranks_and_threads(self):
        frames = []
        text = self.heated(self.MODELS["area"], run="run 300", every=100)
        for np, threads in (1, 1), (2, 1), (4, 1), (2, 2):
            name = f"heat-{np}-{threads}"
            self.assert_accelerated(self.run_suffix(True, name, text, np=np, env={"OMP_NUM_THREADS": str(threads)}).log)
            frames.append(read_dump(self.path(f"{name}/heat")) + read_dump(self.path(f"{name}/state")))
        for others in frames[1:]:
            for a, b in zip(frames[0], others, strict=True):
                self.assert_same_bits(a, b)

    def test_in_the_records(self):
        low, high = self.box[0]
        words = self.MODELS["area"]
        wall = f"variable hot equal 2.0+20*step*dt\nfix w all wall/gran granular {words} zplane {low} {high} temperature v_hot\n"
        each = ("compute warm all reduce ave c_hot[1]\nfix mean all ave/time 1 1 1 c_warm file means format ' %a'\n")
        for np in 1, 2:
            found = []
            for style in "run_style verlet/stock\n", "run_style verlet\n":
                text = self.heated(words, more=wall + each + "comm_proxy yes\n" + style, run="run 200", every=50)
                log = self.run_suffix(True, "ours", text, np=np).log
                found.append((read_dump(self.path("ours/heat")) + read_dump(self.path("ours/state")), self.read("ours/means")))
            self.assertRegex(log, "steps without output +in the records")
            for a, b in zip(found[0][0], found[1][0], strict=True):
                self.assert_same_bits(a, b)
            self.assertEqual(found[0][1], found[1][1])

    def test_wall_whose_temperature_reads_particles(self):
        low, high = self.box[0]
        words = self.MODELS["area"]
        wall = f"variable hot equal 2.0+vcm(all,x)\nfix w all wall/gran granular {words} zplane {low} {high} temperature v_hot\n"
        log = self.run_suffix(True, "ours", self.heated(words, more=wall, run="run 20")).log
        self.assertRegex(log, r"through the arrays of LAMMPS: fix w \(wall/gran\): variable hot reads more than time")

    def test_without_temperature(self):
        text = self.scene(coeffs=f"pair_coeff * * {self.MODELS['area']}")
        log = self.run_suffix(True, "ours", text, expect_error=True).log
        self.assertIn("requires atom style with temperature property", log)


class TestStock(Moving):
    """What is not accelerated is computed by the stock methods, and the log says why."""

    def reason(self, tolerance=1e-9, **options):
        text = self.scene(**options)
        logs = []
        for suffix in False, True:
            logs.append(self.run_suffix(suffix, "ours" if suffix else "stock", text).log)
        self.assert_close_frames(read_dump(self.path("stock/state")), read_dump(self.path("ours/state")), tolerance)
        return re.search("pair granular +(.*)", logs[1])[1]

    def test_mdr(self):
        words = "mdr 1e4 0.3 100.0 1.0 0.5 0.5 damping {} tangential linear_history 1000 1.0 0.5"
        coeffs = "pair_coeff * * " + words.format("mdr 1" if self.is_new() else "none")
        if self.is_new():    # which cannot find its own history
            log = self.run_suffix(True, "ours", self.scene(coeffs=coeffs, newton="off"), expect_error=True).log
            self.assertIn("Cannot find fix storing granular history", log)
        else:
            self.assertEqual("stock: normal model mdr", self.reason(coeffs=coeffs, newton="off"))

    def test_hybrid(self):
        text = self.scene(coeffs=f"pair_coeff * * zero\npair_coeff * * granular {ROLLS}", newton="off").replace(
            "pair_style granular", "pair_style hybrid/overlay zero 1.0 granular")
        logs = [self.run_suffix(s, "ours" if s else "stock", text).log for s in (False, True)]
        self.assert_close_frames(read_dump(self.path("stock/state")), read_dump(self.path("ours/state")), 1e-9)
        self.assertIn("Talus granular", logs[1])


if __name__ == "__main__":
    unittest.main()
