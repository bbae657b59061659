# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 timeout=120
"""compute contact/gran/local, contact/gran/atom, dissipation/gran/atom: contacts of particles and large bodies as
data. Forces and torques of the rows are those of the particles; energies by particle are those of penalty/stats."""

import collections
import random
import re
import unittest

from granular_script import begin
from talus_testing import (SceneCase, Sphere, marked_word, read_dump, read_local, thermo,
                           write_sphere_data)

LAW = "hertz/material 1e7 0.5 0.3 tangential multistep NULL NULL 0.5 rolling 0.05 spinning 0.05"
WORDS = ("id1 id2 body part x1 y1 z1 x2 y2 z2 px py pz nx ny nz overlap force fn ft fx fy fz tx ty tz eng "
         "h1 h2 h3 h4 h5 h6 h7 h8 h20").split()
BED = begin("si", boundary="{boundary}", law=LAW, skin=0.002, dt=2e-5) + f"""
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix tank all large/body box 0.025 0.02 0.1 0.05 0.04 0.2 inside contact {LAW}
fix stone all large/body box 0.025 0.02 0.0 0.012 0.012 0.016 outside contact {LAW}
compute rows all contact/gran/local {" ".join(WORDS)}
compute number all contact/gran/atom
compute lost all dissipation/gran/atom
compute sum all reduce sum c_lost[1] c_lost[2] c_lost[3]
compute s all penalty/stats
thermo_style custom step c_s[2] c_s[5] c_s[6] c_s[7] c_sum[1] c_sum[2] c_sum[3]
thermo_modify format float %.17g norm no
"""
DUMPS = """
dump rows all local {every} rows index c_rows[*]
dump_modify rows format line "%.0f{numbers}"
dump atoms all custom {every} atoms id fx fy fz tqx tqy tqz c_number[1] c_number[2] c_number[3] c_lost[1] c_lost[2] c_lost[3]
dump_modify atoms format float %.17g
""".replace("{numbers}", " %.17g" * len(WORDS))


def grains():
    draw = random.Random(3)
    return [Sphere(tuple(0.0095 * (s + 0.5) + draw.uniform(-0.0004, 0.0004) for s in site),
                   diameter=draw.uniform(0.0085, 0.0094), density=2500.0, v=(0.2, 0.1, -0.5))
            for site in ((i, j, k) for k in range(1, 6) for j in range(4) for i in range(5))]


def named(frame):
    return [dict(zip(["index", *WORDS], row)) for row in frame.rows]


class Bed(SceneCase):

    def run_bed(self, np=1, boundary="f f f", run="run 1500", data=True, **options):
        if data:
            write_sphere_data(self.path("data"), ((-0.001, 0.051), (-0.001, 0.041), (-0.01, 0.1)), grains())
        script = BED.format(boundary=boundary) + DUMPS.format(every=500) + "thermo 500\n" + run
        self.log = self.run_lammps(script, np=np, **options).log
        return [named(f) for f in read_local(self.path("rows"))], read_dump(self.path("atoms")), thermo(self.log)

    def assert_rows_are_those_of_particles(self, rows, frame):
        """Newton's third law included: the force on the second particle is the opposite one."""
        radius = {s.id or n + 1: s.diameter / 2 for n, s in enumerate(grains())}
        force, torque = collections.defaultdict(lambda: [0.0] * 3), collections.defaultdict(lambda: [0.0] * 3)
        count = collections.Counter()
        for row in rows:
            self.assertEqual(row["body"] == 0, row["id2"] > 0)
            count[row["id1"], row["body"] > 0] += 1
            for d, axis in enumerate("xyz"):
                force[row["id1"]][d] += row["f" + axis]
                torque[row["id1"]][d] += row["t" + axis]
                if row["id2"]:
                    force[row["id2"]][d] -= row["f" + axis]
            if row["id2"]:
                count[row["id2"], False] += 1
        scale = max(abs(row["force"]) for row in rows)
        alone = {tag for tag in frame.atoms if all(row["id2"] != tag for row in rows)}
        for tag, values in frame.atoms.items():
            self.assertEqual(tuple(values[7:10]),
                             (count[tag, False] + count[tag, True], count[tag, False], count[tag, True]))
            for d in range(3):
                self.assertLess(abs(force[tag][d] - values[1 + d]), 1e-9 * scale)
                if tag in alone:    # else there are torques as a second particle
                    self.assertLess(abs(torque[tag][d] - values[4 + d]), 1e-9 * scale * radius[tag])

    def test_rows(self):
        """On any number of ranks, also across a periodic border."""
        for boundary in "f f f", "p p f":
            first = None
            for np in (1, 2, 3) if boundary == "f f f" else (1, 2):
                rows, frames, steps = self.run_bed(np, boundary)
                for its_rows, frame, step in zip(rows[1:], frames[1:], steps[1:], strict=True):
                    self.assert_rows_are_those_of_particles(its_rows, frame)
                    self.assertEqual(len(its_rows), step["c_s[2]"])
                key = lambda row: (row["id1"], row["id2"], row["body"], row["part"], row["nx"])
                last = sorted(rows[-1], key=key)
                self.assertGreater(sum(row["body"] > 0 for row in last), 10)
                self.assertGreater(sum(row["h1"] != 0 for row in last), 10)
                self.assertEqual({row["body"] for row in last}, {0.0, 1.0, 2.0})
                if first:
                    for a, b in zip(first, last, strict=True):
                        for word in WORDS:
                            if "p" in boundary and word[0] in "xyz":
                                continue
                            self.assertAlmostEqual(a[word], b[word], delta=1e-9 * max(1.0, abs(a[word])), msg=word)
                first = first or last

    def test_rows_of_second_order(self):
        """Of contacts that begin or end as well: their forces are those of one step."""
        law = LAW.replace("0.5 rolling", "0.5 slider midpoint rolling") + " limit_damping adhesion constant 1e-3"
        script = BED.format(boundary="f f f").replace(LAW, law).replace("symplectic", "symplectic order 2")
        write_sphere_data(self.path("data"), ((-0.001, 0.051), (-0.001, 0.041), (-0.01, 0.1)), grains())
        self.run_lammps(script + "run 900\n" + DUMPS.format(every=3) + "thermo 500\nrun 300")
        frames, every = read_dump(self.path("atoms")), [named(f) for f in read_local(self.path("rows"))]
        ended = [row for rows in every for row in rows if row["overlap"] <= 0]
        self.assertGreater(sum(row["force"] != 0 for row in ended), 10)
        self.assertEqual({row["eng"] for row in ended}, {0.0})
        for rows, frame in zip(every, frames, strict=True):
            self.assert_rows_are_those_of_particles(rows, frame)

    def test_energies_by_particle(self):
        """Sums are those of penalty/stats; steps are made in the records all the same."""
        for np, threads in (1, 1), (2, 1), (1, 2), (2, 2):
            for boundary in "f f f", "p p f":
                *_, steps = self.run_bed(np, boundary, env={"OMP_NUM_THREADS": str(threads)})
                self.assertRegex(self.log, "steps without output +in the records")
                last = steps[-1]
                scale = last["c_s[5]"]
                self.assertGreater(scale, 0)
                for n in 1, 2, 3:
                    self.assertGreater(last[f"c_s[{4 + n}]"], 1e-3 * scale)
                    self.assertLess(abs(last[f"c_sum[{n}]"] - last[f"c_s[{4 + n}]"]), 1e-12 * scale)

    def test_restart(self):
        """Energies by particle go on; those of penalty/stats begin anew."""
        _, whole, _ = self.run_bed(run="run 1500\nwrite_restart half\nrun 500")
        script = BED.format(boundary="f f f").replace("read_data data", "read_restart half")
        self.run_lammps(script + DUMPS.format(every=500) + "thermo 500\nrun 500", np=2)
        again = read_dump(self.path("atoms"))[-1]
        for tag, values in whole[-1].atoms.items():
            for a, b in zip(values[10:], again.atoms[tag][10:], strict=True):
                self.assertAlmostEqual(a, b, delta=1e-12 * abs(values[10]))

    def test_gone_when_nobody_asks(self):
        """A compute that begins later counts from then on, whatever has been asked before."""
        _, _, steps = self.run_bed(run="run 500\nundump atoms\nuncompute sum\nuncompute lost\nuncompute s\n"
                                   "thermo_style custom step\nrun 500\ncompute s all penalty/stats\n"
                                   "compute lost all dissipation/gran/atom\n"
                                   "compute sum all reduce sum c_lost[1] c_lost[2] c_lost[3]\n"
                                   "thermo_style custom step c_s[5] c_s[6] c_s[7] c_sum[1] c_sum[2] c_sum[3]\n"
                                   "thermo_modify format float %.17g norm no\nrun 500")
        begin_row, end = steps[-2], steps[-1]
        for n in 1, 2, 3:
            self.assertEqual(begin_row[f"c_s[{4 + n}]"], 0.0)
            self.assertLess(abs(begin_row[f"c_sum[{n}]"]), 1e-12 * end["c_s[5]"])
            self.assertLess(abs(end[f"c_sum[{n}]"] - end[f"c_s[{4 + n}]"]), 1e-12 * end["c_s[5]"])

    def test_after_a_run(self):
        """The contacts of its last step."""
        rows, *_ = self.run_bed(run="run 1500\nundump rows\nwrite_dump all local later index c_rows[*] modify format line "
                                f'"%.0f{" %.17g" * len(WORDS)}"')
        later, = read_local(self.path("later"))
        self.assertEqual(sorted(tuple(r.values())[1:] for r in rows[-1]), sorted(row[1:] for row in later.rows))

    def test_behind_runs_that_go_on(self):
        """A program that takes ten steps at a time, without set-ups, and asks in between: as in one run, on any ranks."""
        write = f'write_dump all local later.{{}} index c_rows[*] modify format line "%.0f{" %.17g" * len(WORDS)}"\n'
        parts = "".join(f"run 10 pre no post no\n{write.format(1500 + 10 * k)}" for k in range(1, 21))
        whole, *_ = self.run_bed(run="undump rows\ndump rows all local 10 rows index c_rows[*]\n"
                                 f'dump_modify rows format line "%.0f{" %.17g" * len(WORDS)}"\nrun 1700')
        for np in 1, 2:
            self.run_bed(np, run=f"undump rows\nrun 1500\n{parts}")
            for k in range(1, 21):
                frame, = read_local(self.path(f"later.{1500 + 10 * k}"))
                self.assertEqual(sorted(tuple(row.values())[1:] for row in named(frame)),
                                 sorted(tuple(row.values())[1:] for row in whole[150 + k]), (np, k))

    def test_after_something_has_changed(self):
        """Contacts of the last step are told as they acted in it, whatever commands have changed since; those of a body that is
        gone are refused."""
        end = "run 1510\nundump rows\n"
        write = f"""write_dump all local later index c_rows[*] modify format line "%.0f{' %.17g' * len(WORDS)}"\n"""

        def rows_after(change, np):
            self.run_bed(np, run=end + change + write)
            frame, = read_local(self.path("later"))
            return sorted(row[1:] for row in frame.rows)

        sent = "displace_atoms all move 0 0 1e-5\nchange_box all z final -0.01 0.2\n"
        changes = ("set atom 7 omega 0 0 1\nset atom 7 diameter 0.0088\ntimestep 1e-5\n"
                   f"pair_coeff * * {LAW.replace('1e7', '2e7')}\n")
        for np in 1, 2:
            acted = rows_after("", np)
            self.assertGreater(len(acted), 40)
            self.assertEqual(acted, rows_after((sent if np == 1 else "") + changes, np))
            with self.assertRaisesRegex(AssertionError, "contacts of the last run cannot be listed(.|\n)*use 'run 0' before"):
                rows_after("unfix stone\n" if np == 1 else sent, np)
        self.run_bed(run=f"{end}unfix stone\nrun 0\n{write}")

    def test_after_a_body_was_moved(self):
        steered = BED.format(boundary="f f f").replace(f"outside contact {LAW}", f"outside contact {LAW} move external")
        found = []
        for moved in "", "fix_modify stone state 0.025 0.02 0.001 1 0 0 0 0 0 0 0 0 0\n":
            write_sphere_data(self.path("data"), ((-0.001, 0.051), (-0.001, 0.041), (-0.01, 0.1)), grains())
            self.run_lammps(f"{steered}run 1500\n{moved}write_dump all local later index c_rows[*]")
            frame, = read_local(self.path("later"))
            found.append(sorted(frame.rows))
        self.assertTrue(any(row[3] == 2 for row in found[0]))
        self.assertEqual(*found)

    def test_after_particles_have_gone(self):
        """A file is written, which sends particles to other ranks: rows name the same particles. Some are deleted: rows
        could name others, and are refused."""
        write = ("write_dump all local {} index c_rows[*] modify format line " + f'"%.0f{" %.17g" * len(WORDS)}"\n')
        end, found = "run 1510\nundump rows\n", []    # step 1510 has not been asked for during the run
        for np, before in (1, ""), (1, "write_restart state\n"), (2, "write_restart state\n"):
            self.run_bed(np, run=f"{end}{before}{write.format('later')}")
            frame, = read_local(self.path("later"))
            found.append(sorted((row["id1"], row["id2"], row["body"], row["part"]) for row in named(frame)))
        self.assertGreater(len(found[0]), 40)
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])
        delete = f"{end}group some id 1:100:7\ndelete_atoms group some compress no\n"
        for np in 1, 2:
            with self.assertRaisesRegex(AssertionError, "contacts of the last run cannot be listed(.|\n)*use 'run 0' before"):
                self.run_bed(np, run=delete + write.format("later"))
            self.run_bed(np, run=f"{delete}run 0\n{write.format('later')}")
            names = {row["id1"] for frame in read_local(self.path("later")) for row in named(frame)}
            self.assertGreater(len(names), 20)
            self.assertFalse(names & set(range(1, 101, 7)))


class Account(SceneCase):

    def test_leaves_the_forces_of_a_set_up(self):
        """Each step is a run of its own, and so has a set-up, also where contacts have just ended."""
        spheres = [Sphere((1.5 * k - 12, 0, height), v=(0, 0.1, -1)) for k in range(16)
                   for height in (0.51 + 0.007 * k, 1.55 + 0.011 * k)]
        write_sphere_data(self.path("data"), ((-14, 14), (-2, 2), (-1, 9)), spheres)
        for law in "hooke 4000 20 tangential multistep 2e3 5 0.5 slider midpoint", "hertz 5e4 40 tangential multistep NULL NULL 0.5 slider midpoint":
            frames = []
            for asks in "", "compute s all penalty/stats\ncompute lost all dissipation/gran/atom\n":
                log = self.run_lammps(begin("si", law=f"{law} limit_damping") + f"""
fix step all nve/sphere/symplectic order 2 gravity 10 vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law} limit_damping
neighbor 0.1 bin
timestep 1e-3
{asks}compute f all reduce sum fz
thermo_style custom step c_f {"c_s[5]" if asks else ""}
variable k loop 250
label again
run 1
next k
jump SELF again
write_dump all custom end{len(asks)} id x y z vx vy vz omegax omegay omegaz modify format float %.17g
""").log
                frames.append(read_dump(self.path(f"end{len(asks)}"))[0])
            self.assertGreater(thermo(log)[-1]["c_s[5]"], 0)
            self.assert_same_bits(*frames)


class TwoContacts(SceneCase):

    def test_numbers(self):
        """One between particles of different size, one with a plane, one with a part of a mesh-like body."""
        spheres = [Sphere((0, 0, 0.49), id=7), Sphere((0, 0.74, 0.49), diameter=0.5, id=3)]
        write_sphere_data(self.path("data"), ((-2, 2),) * 3, spheres)
        log = self.run_lammps(begin("si", law="hooke 1000.0 0.0") + f"""
fix step all nve/sphere/symplectic
fix floor all large/body plane 0 0 0 0 0 1 contact hooke 500.0 0.0
timestep 1e-5
compute rows all contact/gran/local {" ".join(WORDS)}
compute one all contact/gran/local overlap
dump rows all local 1 rows index c_rows[*]
dump one all local 1 one index c_one
run 0""").log
        self.assertNotIn("WARNING", log)
        pair, floor = sorted(named(read_local(self.path("rows"))[0]), key=lambda row: row["body"])
        expect = {"id1": 3, "id2": 7, "body": 0, "part": 0, "y1": 0.74, "y2": 0.0, "py": 0.495, "ny": 1.0, "overlap": 0.01,
                  "fn": 10.0, "fy": 10.0, "force": 10.0, "ft": 0.0, "eng": 0.05}
        for word, value in expect.items():
            self.assertAlmostEqual(pair[word], value, delta=1e-5, msg=word)
        expect = {"id1": 7, "id2": 0, "body": 1, "part": 0, "z1": 0.49, "z2": 0.0, "pz": 0.0, "nz": 1.0, "overlap": 0.01,
                  "fn": 5.0, "fz": 5.0, "eng": 0.025}
        for word, value in expect.items():
            self.assertAlmostEqual(floor[word], value, delta=1e-5, msg=word)
        self.assertEqual([round(row[1], 6) for row in read_local(self.path("one"))[0].rows], [0.01, 0.01])

    def test_groups(self):
        """Both particles have to be members."""
        spheres = [Sphere((0.99 * n, 0, 0), id=n + 1) for n in range(3)]
        write_sphere_data(self.path("data"), ((-2, 4),) * 3, spheres)
        self.run_lammps(begin("si", law="hooke 1000.0 0.0") + """
fix step all nve/sphere/symplectic
group some id 1 2
compute rows some contact/gran/local id1 id2
compute number some contact/gran/atom
dump rows all local 1 rows index c_rows[1] c_rows[2]
dump atoms all custom 1 atoms id c_number[1]
run 0""")
        self.assertEqual([row[1:] for row in read_local(self.path("rows"))[0].rows], [(1, 2)])
        self.assertEqual([read_dump(self.path("atoms"))[0].atoms[t][1] for t in (1, 2, 3)], [1, 2, 0])


class Refused(SceneCase):

    def test_words(self):
        write_sphere_data(self.path("data"), ((-2, 2),) * 3, [Sphere((0, 0, 0))])
        pair = "pair_coeff * * hooke 1000.0 0.0\n"
        for words, message, mark in (
                ("contact/gran/local", "compute contact/gran/local: expected at least one of id1 id2 body part", None),
                ("contact/gran/local id1 foo", "compute contact/gran/local: unknown value 'foo': expected some of id1", "foo"),
                ("contact/gran/atom foo", "compute contact/gran/atom: surplus word 'foo'", "foo"),
                ("dissipation/gran/atom foo", "compute dissipation/gran/atom: surplus word 'foo'", "foo")):
            result = self.run_lammps(f"{begin('si')}{pair}compute c all {words}", expect_error=True)
            self.assertIn(message, result.log)
            if mark:
                self.assertEqual(marked_word(result.log), mark)
        for style in "contact/gran/local id1", "contact/gran/atom", "dissipation/gran/atom":
            result = self.run_lammps(f"{begin('si')}pair_style none\ncompute c all {style}\nrun 0", expect_error=True)
            self.assertRegex(result.log, re.escape(style.split()[0]) + " requires a pair style of Talus")
        result = self.run_lammps(f"{begin('si')}{pair}compute c all dissipation/gran/atom\nunfix c_DISSIPATION_STORE\nrun 0",
                                 expect_error=True)
        self.assertIn("its internal fix c_DISSIPATION_STORE has been deleted: remove the unfix command", result.log)


if __name__ == "__main__":
    unittest.main()
