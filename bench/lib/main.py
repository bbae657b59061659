# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Run one benchmark or validation: main.py FOLDER NAME [options], called by scripts/bench and scripts/validate, which prepare the
environment.

It is a file FOLDER/NAME.py with
    TITLE       heading of its section
    QUESTION    what is asked, one paragraph
    measure(bench)   runs everything and fills bench.section; see report.Section
`bench` is the Bench object below. Of a validation the section is a page, see pages.Page; it fails where a published number is
missed.
"""

import argparse
import dataclasses
import importlib.util
import os
import shutil
import sys
import tempfile
import time

import lammps
import machine
import pages
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
        self.section = KINDS[options.folder].section(name, module.TITLE, module.QUESTION, self)
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


@dataclasses.dataclass
class Kind:
    section: type
    out: str        # below the root
    report: str


KINDS = {"bench": Kind(report.Section, "bench", "REPORT.md"),
         "validate": Kind(pages.Page, os.path.join("doc", "validation"), "README.md")}


def default_out(options):
    """Figures of the tree come from complete runs only."""
    if options.quick or options.cases:
        return os.path.join(os.getcwd(), "out", options.folder)
    return os.path.join(machine.ROOT, KINDS[options.folder].out)


def load(name, folder="bench"):
    path = os.path.join(machine.ROOT, folder, name + ".py")
    spec = importlib.util.spec_from_file_location(f"{folder}_{name}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def parse(words):
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", choices=KINDS)
    parser.add_argument("name")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--cases")
    parser.add_argument("--out", type=os.path.abspath)
    parser.add_argument("--keep", action="store_true")
    return parser.parse_args(words)


def main(words):
    options = parse(words)
    module = load(options.name, options.folder)
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
    bench.note(f"done; report: {os.path.join(bench.out, KINDS[options.folder].report)}")
    missed = bench.section.failed()
    for each in missed:
        bench.note(f"missed: {', '.join(each.cells()[:3])}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
