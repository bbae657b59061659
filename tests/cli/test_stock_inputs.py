# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the tests of the inputs of LAMMPS read and write themselves: scripts with shorter runs, tables of a log."""

import unittest

import stock_inputs

LOG = """Setting up Verlet run ...
Talus: styles of this run
  pair gran/hooke/history           accelerated
  fix NEIGH_HISTORY_HH0 NEIGH_HISTORY  stock: keeps the history
  fix ins pour                      stock: inserts particles
  run verlet                        accelerated
  steps without output              through the arrays of LAMMPS: fix ins (pour)
Per MPI rank memory allocation (min/avg/max) = 1 | 1 | 1 Mbytes
"""
EXPECTED = """
pair gran/hooke/history  accelerated
fix ins pour             stock: inserts particles
run verlet               accelerated
steps without output     through the arrays of LAMMPS: fix ins (pour)
"""


class Scripts(unittest.TestCase):

    def test_only_lengths_of_runs_change(self):
        text = "run 100\nfix run all nve\n  run\t${n} every 10\nrun 5000\nvariable run equal 7000\n"
        self.assertEqual(stock_inputs.shortened(text, 500),
                         "run 100\nfix run all nve\n  run\t500 every 10    # instead of {n}\n"
                         "run 500    # instead of 5000\nvariable run equal 7000\n")
        self.assertEqual(stock_inputs.before_first_run("a\nrun 1\nrun 2\n", "b\n"), "a\nb\nrun 1\nrun 2\n")


class Tables(unittest.TestCase):

    def found(self, log, expected=EXPECTED):
        return stock_inputs.differences(stock_inputs.read_tables(log), stock_inputs.read_expected(expected))

    def test_tables_that_fit(self):
        self.assertEqual(self.found(LOG), [])
        self.assertEqual(self.found(2 * LOG), [], "a table that is the one before")

    def test_tables_that_do_not(self):
        for log, part in (("", "the log has no 'Talus: styles of this run'"),
                          (LOG + LOG.replace("verlet   ", "respa   "), "2 different tables in the log instead of 1"),
                          (LOG.replace("fix ins pour", "fix in pour"), "lists pair gran/hooke/history, fix in pour"),
                          (LOG.replace("stock: inserts particles", "accelerated"), "'accelerated' instead of 'stock: "),
                          (LOG.replace("stock: inserts particles", "stock"), "'stock' instead of 'stock: inserts"),
                          (LOG.replace("run verlet                        accelerated", "run verlet"),
                           "'' instead of 'accelerated'"),
                          (LOG.replace("through the arrays of LAMMPS: fix ins (pour)", "in the records"),
                           "'in the records' instead of 'through the arrays of LAMMPS: fix ins (pour)'")):
            sentences = self.found(log)
            self.assertEqual(len(sentences), 1, sentences)
            self.assertIn(part, sentences[0])

    def test_every_expected_table_can_be_read(self):
        for given in stock_inputs.INPUTS:
            for table in stock_inputs.read_expected(given.tables):
                self.assertEqual(table[-1][0], stock_inputs.STEPS, given.name)
                for what, verdict in table:
                    self.assertRegex(verdict, r"^(accelerated|stock: .+|in the records|through the arrays of LAMMPS: .+"
                                              r"|sub-styles of Talus .+)$", f"{given.name}: {what}")

    def test_in_a_few_words(self):
        self.assertEqual(stock_inputs.accelerated(LOG), "gran/hooke/history, verlet")
        self.assertEqual(stock_inputs.accelerated(""), "nothing")


if __name__ == "__main__":
    unittest.main()
