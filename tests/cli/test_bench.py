# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=hostless
"""scripts/bench and scripts/validate: their errors, report and pages, and what verdicts and fits are made of; nothing is run."""

import math
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

ROOT = os.environ["TALUS_SOURCE_DIR"]
os.environ.update(TALUS_ROOT=ROOT, TALUS_BUILD=os.environ["TALUS_BINARY_DIR"], TALUS_BENCH_HOST=os.environ["TALUS_LMP"],
                  TALUS_BENCH_CACHE=os.path.join(tempfile.gettempdir(), "unused"))
sys.path.insert(0, os.path.join(ROOT, "bench", "lib"))
import arrays
import errors
import function_stages
import lammps
import limits
import main
import pages
import paired
import projection
import report
import scenes
import two_cores
import verdict


class Command(unittest.TestCase):

    def said(self, *words, script="bench"):
        done = subprocess.run([os.path.join(ROOT, "scripts", script), *words], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=60, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_messages(self):
        self.assertEqual(self.said("--help")[0], 0)
        for words, part in ((("nonsense",), "no benchmark 'nonsense'; there are: accuracy"), ((), "which benchmark?"),
                            (("single", "--fast"), "unknown option '--fast'"), (("single", "--out"), "--out needs a value")):
            status, text = self.said(*words)
            self.assertEqual(status, 1)
            self.assertIn(part, text)


    def test_messages_of_validate(self):
        self.assertEqual(self.said("--help", script="validate")[0], 0)
        for words, part in ((("nonsense",), "no problem 'nonsense'; there are: chute"), ((), "which problem?"),
                            (("drum", "--fast"), "unknown option '--fast'"), (("drum", "--cases"), "--cases needs a value")):
            status, text = self.said(*words, script="validate")
            self.assertEqual(status, 1)
            self.assertIn(part, text)


class Pages(unittest.TestCase):

    def write(self, folder, name, found):
        bench = types.SimpleNamespace(out=folder, quick=False, cases=None, rounds=3, asked_rounds=None, clock=lambda: "1:00")
        page = pages.Page(name, f"Title of {name}", "Question?", bench)
        page.result("height", found, 1.0, 2.0, "m", scatter=0.1)
        page.result("width", 1.0, 0.0, 2.0)
        page.write()
        return page

    def test_page_and_index(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.write(folder, "good", 1.5).failed(), [])
            bad = self.write(folder, "bad", 2.5)
            self.assertEqual([each.what for each in bad.failed()], ["height"])
            with open(os.path.join(folder, "bad.md")) as file:
                text = file.read()
            self.assertTrue(text.startswith("# Title of bad\n"))
            self.assertIn("| height | 2.5 +- 0.1 m | 1 to 2 | **no** |", text)
            self.assertIn("repeat: `scripts/validate bad`", text)
            with open(os.path.join(folder, "README.md")) as file:
                index = file.read()
            self.assertIn("| [Title of good](good.md) | height | 1.5 +- 0.1 m | 1 to 2 | yes |", index)
            self.assertEqual(index.count("| | width | 1 | 0 to 2 | yes |"), 2)


class Report(unittest.TestCase):

    def write(self, folder, name, sentence, headline=None):
        bench = types.SimpleNamespace(out=folder, quick=False, cases=None, rounds=3, asked_rounds=3, clock=lambda: "1:00")
        section = report.Section(name, f"Title of {name}", "Question?", bench)
        section.text(sentence)
        section.record(a=1, b=2.5)
        if headline:
            section.headline(headline)
        section.write()
        with open(os.path.join(folder, "REPORT.md")) as file:
            return file.read()

    def test_sections_are_replaced_and_kept_in_order(self):
        with tempfile.TemporaryDirectory() as folder:
            self.write(folder, "stability", "old words", "a bad thing.")
            self.write(folder, "single", "first")
            text = self.write(folder, "stability", "new words")
            self.assertNotIn("old words", text)
            self.assertIn("repeat: `scripts/bench stability --rounds 3`", text)
            self.assertNotIn("a bad thing", text)
            self.assertLess(text.index("first"), text.index("new words"))
            self.assertEqual(text.count("## Title of stability"), 1)
            text = self.write(folder, "single", "second", "too slow.")
            self.assertLess(text.index("* too slow."), text.index("## Title"))
            with open(os.path.join(folder, "results", "single.csv")) as file:
                self.assertEqual(file.read(), "a,b\n1,2.5\n")


class Numbers(unittest.TestCase):

    def test_ratio_is_taken_round_by_round(self):
        found = paired.ratio(paired.Series([10.0, 40.0, 30.0]), paired.Series([5.0, 10.0, 10.0]))
        self.assertEqual((found.median, found.low, found.high), (3.0, 2.0, 4.0))

    def test_rounds_take_turns(self):
        calls = []
        paired.measure({name: lambda name=name: calls.append(name) or 1.0 for name in "ab"}, 2)
        self.assertEqual("".join(calls), "abba")

    def test_order_and_step_for_an_error(self):
        steps = [2.0**-k for k in range(8)]
        second = [h * h for h in steps]
        self.assertAlmostEqual(errors.order(steps, second), 2.0, places=9)
        self.assertAlmostEqual(errors.step_for(1e-3, steps, second), math.sqrt(1e-3), places=9)
        self.assertIsNone(errors.step_for(1e-6, steps, second))
        # a run that failed, or was good by chance, does not count
        self.assertLess(errors.step_for(1e-3, steps, [1e-9] * 3 + [math.inf] + second[4:]), steps[3])

    def test_an_error_beyond_the_finest_step_is_extrapolated(self):
        steps = [2.0**-k for k in range(8)]
        ladder = main.load("accuracy").Ladder([(h, dict.fromkeys(errors.QUANTITIES, h**2)) for h in steps], 10.0)
        within, beyond = ladder.needs(1e-2), ladder.needs(1e-8)
        self.assertTrue(within.measured)
        self.assertFalse(beyond.measured)
        self.assertAlmostEqual(beyond.dt, 1e-4, places=9)
        self.assertEqual([cell[0] for cell in beyond.cells()], ["~", "~"])

    def test_exact_impact_ends_without_attraction(self):
        """Velocity and position are continuous where the damped force has come to zero, and constant after."""
        state, h = scenes.exact_hooke(22.0), 1e-7
        gaps = [state(0.01 + 0.03 + 1e-4 * k)[0][1][0] for k in range(300)]
        rates = [(state(t + h)[0][1][0] - state(t - h)[0][1][0]) / (2 * h) for t in (0.02, 0.05, 0.055, 0.07)]
        for t, rate in zip((0.02, 0.05, 0.055, 0.07), rates):
            self.assertAlmostEqual(rate, state(t)[1][1][0], places=6)
        self.assertLess(max(abs(b - a) for a, b in zip(gaps, gaps[1:])), 1e-4)
        self.assertEqual(state(0.07)[1], state(0.2)[1])

    def test_limits_of_both_orders(self):
        for zeta in 0.1, 0.7:
            one, cage = (limits.Case("", "", *limits.cage(n), zeta=zeta) for n in (1, 12))
            self.assertAlmostEqual(limits.theory(one, 1), 2 * (math.sqrt(1 + zeta**2) - zeta), places=3)
            self.assertAlmostEqual(limits.theory(one, 2), 2.0, places=3)
            # four contacts' worth of damping in each direction, of which one is implicit
            spread = 2 * zeta * 0.75
            self.assertAlmostEqual(limits.theory(cage, 2), (math.sqrt(1 + 4 * spread**2) - 2 * spread), places=3)

    def test_loops_of_both_codes(self):
        new = "Loop time of 1.5 on 1 procs for 100 steps with 10 atoms\nPair    | 1.0 | 1.2 | 1.3 | 0.0 | 80\nOther | | 0.3 | | | 20\n"
        old = "Loop time of 3 on 1 procs for 100 steps with 10 atoms, finish time 0.1\nPair  time (%) = 2 (66)\nModfy time (%) = 0.5 (16)\n"
        first, second = lammps.read_loops(new + old)
        self.assertEqual((first.nanoseconds(), first.breakdown), (1.5e6, {"Pair": 1.2, "Other": 0.3}))
        self.assertEqual((second.seconds, second.breakdown), (3.0, {"Pair": 2.0, "Modify": 0.5}))


class Projection(unittest.TestCase):

    FOUND = projection.Measured({n: 50.0 for n in (10**4, 10**6, 10**9)}, 5e-9, 0.8)
    STOCK, DIRECT, OVERLAPPED = (projection.Exchange(6, 72, True, False), projection.Exchange(26, 72, False, False),
                                 projection.Exchange(26, 72, False, True))

    def efficiency(self, count, ranks, exchange):
        return projection.efficiency(count, ranks, exchange, self.FOUND)[2]

    def test_proxies_are_a_shell(self):
        proxies, sent = projection.proxies_of_cube(10**9)
        faces = 6 * (10**9 * math.pi * projection.beds.D**3 / (6 * projection.FILL))**(2 / 3)
        shell = faces * projection.REACH * projection.FILL * 6 / math.pi / projection.beds.D**3
        self.assertAlmostEqual(proxies / shell, 1.0, places=2)
        self.assertAlmostEqual(sent / shell, 1.0, places=2)

    def test_large_ranks_are_efficient(self):
        for exchange in self.STOCK, self.DIRECT, self.OVERLAPPED:
            values = [self.efficiency(count, 32, exchange) for count in (10**4, 10**6, 10**9)]
            self.assertEqual(values, sorted(values))
            self.assertTrue(0.0 < values[0] and 0.97 < values[-1] < 1.0, values)

    def test_what_costs(self):
        for count in 10**4, 10**6:
            self.assertLess(self.efficiency(count, 10**5, self.STOCK), self.efficiency(count, 32, self.STOCK))
            self.assertGreater(self.efficiency(count, 32, self.OVERLAPPED), self.efficiency(count, 32, self.DIRECT))

    def test_less_cannot_be_hidden_than_there_is(self):
        """A network that takes no time costs nothing but packing and contacts that are computed twice."""
        free = projection.Exchange(0, 0, False, True)
        proxies = projection.proxies_of_cube(10**6)[0]
        expected = 1 / (1 + 0.4 * proxies / 10**6 + 5e-9 * proxies / (50e-9 * 10**6))
        self.assertAlmostEqual(projection.efficiency(10**6, 1, free, self.FOUND)[2], expected, places=9)


class Profile(unittest.TestCase):
    """The stage of a function is that of the file it is defined in: no name of a function or class of src is said here."""

    TREE = {
        "contact/narrow_phase.h": "struct Look {\n  int k;\n};\n",
        "contact/narrow_phase.cpp": "namespace {\nVec4 near(int a)\n{\n}\n}\nvoid Look::at(int k) const\n{\n  call(k);\n}\n",
        "contact/sum.h": "class Look;\ntemplate <class T> class Sum : public Base {\n public:\n  void add(int);\n};\n",
        "particles/store.h": "struct alignas(64) Store {\n};\n",
        "particles/store.cpp": "const int *Store::read(int k)\n{\n}\n",
        "particles/store_motion.cpp": "void Store::move()\n{\n}\n",
        "base/loops.h": "template <class Body> void in_loops(int n, const Body &body)\n{\n}\nstruct Small {\n};\n",
        "fix/body/large_body_part.h": "class Part {\n};\n",
    }

    def test_functions_belong_to_the_stage_of_their_file(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in self.TREE.items():
                os.makedirs(os.path.join(folder, os.path.dirname(name)), exist_ok=True)
                with open(os.path.join(folder, name), "w") as file:
                    file.write(text)
            known = function_stages.places(folder)
        for stage, symbol in (
                ("narrow phase", "Talus::Look::at(int) const"),
                ("narrow phase", "Talus::(anonymous namespace)::near(int) [clone .cold]"),
                ("contact force", "void Talus::Sum<Talus::Small>::add(int)"),
                ("contact force", "Talus::Store::read(int)"),
                ("integration", "Talus::Store::move() [clone ._omp_fn.0]"),
                ("narrow phase", "void Talus::in_loops<Talus::Look::at(int) const::{lambda(int)#1}>(int)"),
                ("floor and walls", "LAMMPS_NS::Part::told(int)"),
                ("other", "Talus::Small::Small()"),
                ("other", "std::vector<int, std::allocator<int> >::push_back(int)")):
            self.assertEqual(function_stages.stage_of_own(symbol, known), stage, symbol)

    def test_functions_of_other_libraries(self):
        for stage, library, symbol in (
                ("contact force", "liblammps.so.0", "LAMMPS_NS::PairGranHertzHistory::compute(int, int)"),
                ("broad phase", "liblammps.so.0", "void LAMMPS_NS::NPairBin<1, 0, 0, 1, 1>::build(LAMMPS_NS::NeighList*)"),
                ("waiting", "mca_btl_vader.so", "0x0000000000004f94"),
                ("waiting", "lmp", "PMPI_Waitall"),
                ("other", "libc.so.6", "__memset_avx512_unaligned_erms")):
            self.assertEqual(function_stages.stage_of(library, symbol), stage, symbol)

    def test_every_stage_has_files(self):
        stages = set(map(function_stages.stage_of_place, function_stages.own_places().values()))
        self.assertEqual(stages - {None}, {stage for stage, _ in function_stages.PLACES})

    def test_functions_of_the_plugin_are_found(self):
        """Nearly all that its libraries define; the others are what compilers make."""
        listing = subprocess.run(["nm", "-C", os.path.join(os.environ["TALUS_BINARY_DIR"], "talusstyles.so")],
                                 capture_output=True, text=True, check=True).stdout
        symbols = [symbol.replace("(anonymous namespace)::", "") for symbol in re.findall(r" [tT] (.*)", listing)
                   if symbol.startswith("Talus::")]
        known = function_stages.own_places()
        lost = [s for s in symbols if not any(name in known for name in re.findall(r"\w+", s.split("(")[0])[1:])]
        self.assertGreater(len(symbols), 300)
        self.assertLess(len(lost), 0.1 * len(symbols), lost[:20])


class TwoCores(unittest.TestCase):

    def test_rounds_are_told_apart_by_the_time_of_a_line(self):
        distance = two_cores.Distance([0, 1])
        times = iter([50.0, 55.0, 52.0, 330.0, 320.0, 340.0, 60.0, 58.0])
        with unittest.mock.patch("two_cores.line_trip", lambda cores: next(times)):
            for case in ("ranks", "ranks", "threads", "threads"):
                self.assertEqual(distance.around(case, lambda c=case: c), case)
        self.assertEqual(distance.sort("ranks", [0.9, 0.8]), {"near": [0.9], "far": [], "changing": [0.8]})
        self.assertEqual(distance.sort("threads", [0.7, 1.0]), {"near": [1.0], "far": [0.7], "changing": []})
        self.assertEqual(distance.time("near"), 56.5)
        self.assertEqual(distance.time("far"), 330.0)

        text, (_, rows) = main.load("single").distance_blocks(distance, {"ranks": [0.9, 0.8], "threads": [0.7, 1.0]})
        self.assertIn("56 ns (near) or 330 ns (far)", text)
        self.assertEqual([row[:3] for row in rows], [["ranks", "near", 1], ["ranks", "changing", 1],
                                                     ["threads", "near", 1], ["threads", "far", 1]])

    def test_a_machine_that_does_not_change_needs_no_table(self):
        distance = two_cores.Distance([0, 1])
        distance.trips = {"threads": [(100.0, 110.0), (105.0, 150.0)]}
        self.assertEqual(len(main.load("single").distance_blocks(distance, {"threads": [0.9, 1.0]})), 1)


class Memory(unittest.TestCase):

    def test_sums_hold_what_is_counted(self):
        rows, sums = arrays.table(2.0, 3.0, 5, 3)
        self.assertEqual(len(rows), sum(map(len, (arrays.HOST, arrays.TALUS, arrays.STOCK))))
        stock = 16 + 4 * 3 + 48 + 36 + 28 * 3 + 28 * 4 + 24 * 3
        for phase in arrays.PHASES:
            self.assertAlmostEqual(sums["stock gran/hertz/history"][phase], stock)
        ours, always, pairs = sums["Talus"], 64 + 32 + 24 + 20 + 4 * 5, 8 * 3
        histories, listed, kept = 32 * 2 + 4.125 * 3, 8 * 2 + 4, 32 * 2
        self.assertAlmostEqual(ours[arrays.STEPS], always + pairs + histories + 4 * 2 + 32 + 32)
        self.assertAlmostEqual(ours[arrays.FILING], always + pairs + histories + listed)
        self.assertAlmostEqual(ours[arrays.LISTING], always + pairs + 8 + kept + listed + 4 + 36 + 4 * 3 + 8)

    def test_own_peak(self):
        before = lammps.own_peak()
        block = b"x" * (64 << 20)
        self.assertGreater(lammps.own_peak() - before, 32 << 20)
        del block
        self.assertEqual(lammps.measured_peak(types.SimpleNamespace(peak=1 << 40)), 1 << 40)
        with self.assertRaises(lammps.Failed):
            lammps.measured_peak(types.SimpleNamespace(peak=32 << 20))


class Verdicts(unittest.TestCase):
    """For every detector a failure that it catches."""

    GRAINS = verdict.Grains("hertz", 1e7, [0.5, 0.5], [500.0, 500.0])

    def judge(self, spoil=None, warnings=(), error="", frames=20):
        def frame(k):
            x = 1.0 + 0.01 * k
            found = {"x": [-x / 2, x / 2], "y": [0.0, 0.0], "z": [0.0, 0.0], "vx": [-1.0, 1.0]}
            found.update({key: [0.0, 0.0] for key in ("vy", "vz", "omegax", "omegay", "omegaz")})
            if spoil and k >= frames - 2:
                spoil(found)
            return k, found
        result = types.SimpleNamespace(warnings=lambda: list(warnings), error=lambda: error)
        return verdict.judge([frame(k) for k in range(frames)], result, self.GRAINS)

    def test_clean(self):
        outcome = self.judge()
        self.assertEqual((outcome.word(), outcome.faults()), ("stable", []))

    def test_energy(self):
        outcome = self.judge(lambda f: f.update(vx=[-1.001, 1.001]))
        self.assertEqual(outcome.word(), "silent")
        self.assertAlmostEqual(outcome.growth, 2e-3, places=4)
        self.assertEqual(self.judge(lambda f: f.update(vx=[-1.0002, 1.0002])).word(), "stable")

    def test_energy_of_a_contact(self):
        """A contact that is pressed holds 2/5 k sqrt(R) d^(5/2)."""
        (kinetic, elastic, _), overlap = verdict.energies(
            {"x": [-0.49, 0.49], **{key: [0.0, 0.0] for key in ("y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz")}},
            self.GRAINS)
        self.assertEqual(kinetic, 0.0)
        self.assertAlmostEqual(elastic, 0.4 * 1e7 * 0.5 * 0.02**2.5)
        self.assertAlmostEqual(overlap, 0.04)

    def test_overlap(self):
        self.assertIn("overlap 0.12 r", self.judge(lambda f: f.update(x=[-0.47, 0.47])).faults())

    def test_not_a_number(self):
        self.assertIn("not a number", self.judge(lambda f: f["y"].__setitem__(0, math.nan)).faults())

    def test_lost(self):
        self.assertIn("1 lost", self.judge(lambda f: [column.pop() for column in f.values()]).faults())

    def test_spheres_of_a_clump_do_not_touch_each_other(self):
        two = verdict.Grains("hooke", 1e3, [0.5] * 3, [1.0] * 3, clump=(1, 1, 2))
        x = [(0.0, 0.0, 0.0), (0.0, 0.0, 0.4), (0.0, 0.0, 1.3)]
        self.assertEqual([round(overlap, 12) for overlap, *_ in verdict.contacts(x, two)], [0.1])

    def test_account_of_a_run(self):
        """Rows that the run has printed: step, particles, kinetic, potential, elastic, overlap."""
        quiet = types.SimpleNamespace(warnings=lambda: [], error=lambda: "")
        rows = [(10.0 * k, 2.0, 5.0, 1.0, 0.0, 0.01) for k in range(20)]
        self.assertEqual(verdict.judge_account(rows, quiet, 2).word(), "stable")
        risen = [(*row[:2], row[2] + 0.01 * (row[0] > 150), *row[3:]) for row in rows]
        self.assertEqual(verdict.judge_account(risen, quiet, 2).faults(), ["energy +2.0e-03"])
        self.assertEqual(verdict.judge_account(risen, quiet, 2, driven=True).word(), "stable")
        self.assertEqual(verdict.judge_account(rows, quiet, 3).faults(), ["1 lost"])
        apart = [(*row[:5], 0.0) for row in rows]
        self.assertEqual(verdict.judge_account(apart, quiet, 2).word(), "stable")
        self.assertEqual(verdict.judge_account(apart, quiet, 2, meet=True).word(), "silent")
        self.assertEqual(verdict.judge_account(rows, quiet, 2, meet=True).word(), "stable")
        moved = types.SimpleNamespace(warnings=lambda: ["WARNING: Fix shape/gran: the surface of particle 2 moves by"], error=lambda: "")
        self.assertEqual(verdict.judge_account(apart, moved, 2, meet=True).word(), "warned")
        self.assertEqual(verdict.judge_account([*rows, (200.0, 2.0, 5.0, 1.0, 0.0, 0.3)], quiet, 2).faults(), ["overlap 0.30 r"])
        self.assertEqual(verdict.judge_account([*rows, (200.0, 2.0, math.nan, 1.0, 0.0, 0.0)], quiet, 2).faults(), ["not a number"])

    def test_what_was_said(self):
        deep = lambda f: f.update(x=[-0.47, 0.47])
        self.assertEqual(self.judge(deep, ["WARNING: Pair style gran/penalty: particles 1 and 2 overlap by .12"]).word(), "warned")
        self.assertEqual(self.judge(deep, ["WARNING: something else"]).word(), "silent")
        self.assertEqual(self.judge(deep, ["WARNING: Pair style gran/penalty: the box is periodic"]).word(), "silent")
        elastic = ["WARNING: Pair style gran/penalty: no contact has damping or friction: at this time step, 0.2 of"]
        self.assertEqual(self.judge(deep, elastic).word(), "silent", "it says nothing about an overlap")
        self.assertEqual(self.judge(lambda f: f.update(vx=[-1.001, 1.001]), elastic).word(), "warned")
        self.assertEqual(self.judge(error="ERROR: Lost atoms").word(), "stopped")
        self.assertEqual(self.judge(error="ERROR: no", frames=1).word(), "refused")


if __name__ == "__main__":
    unittest.main()
