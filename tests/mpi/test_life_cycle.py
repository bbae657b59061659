# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A whole session in one process: run, balance, change_box, write_restart, run, clear, read_restart, run.

The restarted half must repeat the first one, and both the session without an interruption."""

import math
import unittest

import session_scene
from session_scene import PAIR, START
from talus_testing import SceneCase, read_dump, thermo, write_sphere_data

PHYSICS = session_scene.PHYSICS.format(ylo=session_scene.RECTANGLE) + """
compute spin all erotate/sphere
compute pair all pair gran/penalty
thermo 50
thermo_style custom step ke c_spin c_pair[1] pxx pxy f_floor[3] f_xlo[1]
thermo_modify norm no format float %.17g
"""
BEGIN = START + "read_data grains\n" + PAIR + PHYSICS + "run 300\n"
CHANGES = """
balance 1.0 shift xz 10 1.0
change_box all x final -2 40 y final -2 20 z final -2 30
"""
AGAIN = "clear\n" + START + "read_restart half\n"
END = "write_dump all custom {name} id x y z vx vy vz omegax omegay omegaz modify format float %a\n"


class LifeCycle(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), session_scene.BOX, session_scene.grains(1.2))

    def assert_same_rows(self, rows, reference):
        self.assertEqual([row["Step"] for row in rows], [row["Step"] for row in reference])
        for row, expected in zip(rows, reference):
            size = max(abs(expected[key]) for key in ("Pxx", "f_floor[3]"))
            for key, value in expected.items():
                self.assertFalse(math.isnan(value), key)
                self.assertLess(abs(row[key] - value), 1e-11 * size, f"{key} at {row['Step']}")

    def frame(self, name):
        return read_dump(self.path(name))[0]

    def test_session(self):
        session = (BEGIN + CHANGES + "write_restart half\nrun 200\n" + AGAIN + PHYSICS + "run 200\n" +
                   CHANGES.splitlines()[2] + "\nrun 200\n" + END.format(name="after"))
        whole = BEGIN + CHANGES + "run 400\n" + END.format(name="whole")
        for np in 1, 4:
            with self.subTest(ranks=np):
                rows = thermo(self.run_lammps(session, np=np).log)
                first, second = rows[7:12], rows[12:17]    # 300 to 500, twice
                self.assertEqual([first[0]["Step"], second[0]["Step"]], [300, 300])
                self.assert_same_rows(second, first)
                reference = thermo(self.run_lammps(whole, np=np).log)
                self.assert_same_rows(first, reference[7:12])
                self.assert_same_rows(rows[17:22], reference[11:16])    # 500 to 700
                self.assertGreater(reference[-1]["c_pair[1]"], 100)
                self.assert_same_bits(self.frame("after"), self.frame("whole"))

    def test_forces_after_what_happens_between_runs(self):
        """A set-up gives the forces of the last step again: of positions, velocities and displacements of the springs."""
        wide = "change_box all x final -2 40 y final -2 20 z final -2 60\n"
        added = "create_atoms 1 single 5 5 55\ngroup added id > 336\ndelete_atoms group added compress no\n"
        forces = "write_dump all custom {} id fx fy fz tqx tqy tqz modify format float %a sort id\n"
        ways = {
            "nothing": "",
            "balance": "balance 1.0 shift xz 10 1.0\n",
            "balance twice": "balance 1.0 shift z 10 1.0\nbalance 1.0 shift xz 10 1.0\n",
            "write_restart": "write_restart half\n",
            "added and deleted": wide + added,
            "periodic": wide + "change_box all boundary p p f\n",
            "periodic, balance": wide + "balance 1.0 shift xz 10 1.0\nchange_box all boundary p f f\n",
        }
        for np in 1, 2, 4:
            script = BEGIN
            for n, commands in enumerate(ways.values()):
                script += forces.format(f"before{n}") + commands + "run 0\n" + forces.format(f"after{n}")
                if "boundary" in commands:
                    script += "change_box all boundary f f f\n"
                script += "run 20\n"
            self.run_lammps(script, np=np)
            for n, name in enumerate(ways):
                with self.subTest(ranks=np, way=name):
                    before, after = self.frame(f"before{n}"), self.frame(f"after{n}")
                    self.assertGreater(sum(torque != 0.0 for torque in before.column("tqx").values()), 100)
                    if "balance" not in name:
                        self.assert_same_bits(before, after)
                        continue
                    for key in before.columns:    # the command goes to fractions of the box and back
                        mine, theirs = before.column(key), after.column(key)
                        size = max(map(abs, mine.values()))
                        for tag, value in mine.items():
                            self.assertLess(abs(theirs[tag] - value), 1e-9 * size, f"{key} of atom {tag}")

    def test_plugin_survives_clear(self):
        """Found through LAMMPS_PLUGIN_PATH, styles are there again after each clear."""
        scene = BEGIN.replace("run 300", "run 50")
        for np in 1, 2:
            with self.subTest(ranks=np):
                rows = thermo(self.run_lammps("clear\n".join([scene, scene, scene]), np=np).log)
                self.assertEqual(len(rows), 6)
                self.assert_same_rows(rows[2:4], rows[:2])
                self.assert_same_rows(rows[4:6], rows[:2])

    def test_clear_at_any_time(self):
        """Right after each command; the process must live to the end."""
        lines = [line for line in (BEGIN + CHANGES).splitlines() if line]
        box = next(n for n, line in enumerate(lines) if line.startswith("read_data"))
        script = "".join("\n".join(lines[:n]) + "\nclear\n" for n in range(box + 1, len(lines) + 1))
        log = self.run_lammps(script.replace("run 300", "run 2") + 'print "END REACHED"\n', np=2).log
        self.assertIn("END REACHED", log.splitlines())

    def test_history_of_other_particles_is_refused(self):
        """Deleted between read_restart and what reads the history: pair style and large body."""
        self.run_lammps(BEGIN.replace("run 300", "run 20") + "write_restart half\n")
        bodies = [line for line in PHYSICS.splitlines() if "large/body" in line]
        physics = "\n".join(line.replace("f_floor[3] f_xlo[1]", "") for line in PHYSICS.splitlines()
                            if line not in bodies)
        delete = "group one id 1\ndelete_atoms group one compress no\n"
        cases = {
            f"{delete}{physics}\nrun 0\n": "Pair style gran/penalty: particles were added or deleted between "
                                           "read_restart and the first run",
            f"{delete}{bodies[0]}\n": "Pair style gran/penalty: particles were added or deleted between "
                                      "read_restart and the first run",
            f"pair_style none\n{delete}{bodies[0]}\n": "Fix large/body: particles were added or deleted between "
                                                       "read_restart and the first run",
        }
        for np in 1, 2:
            for commands, message in cases.items():
                log = self.run_lammps(START + "read_restart half\n" + commands, np=np, expect_error=True).log
                self.assertIn(message, " ".join(log.split()))
            self.run_lammps(START + f"read_restart half\n{physics}\nrun 0\n{delete}run 0\n", np=np)


if __name__ == "__main__":
    unittest.main()
