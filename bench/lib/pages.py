# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""doc/validation: a page for each problem with a published answer, and an index of them, replaced by scripts/validate."""

import dataclasses
import os
import re

import report

HEAD = """# Validation

Problems with answers that others have published or measured: `scripts/validate NAME` runs one, on all cores of the machine, and writes
its page again, with its picture. An input script that is named on a page can be run and changed: `scripts/run validate/in.NAME`.

| page | number | Talus | published | within |
|---|---|---|---|---|
"""


@dataclasses.dataclass
class Result:
    """A number that is compared with a published one, which it may miss by so much, or lies between two."""
    what: str
    found: float
    low: float
    high: float
    unit: str = ""
    scatter: float = float("nan")      # of the number over seeds

    def is_met(self):
        return self.low <= self.found <= self.high

    def cells(self):
        found = report.number(self.found) + ("" if self.scatter != self.scatter else f" +- {report.number(self.scatter)}")
        return [self.what, f"{found} {self.unit}".strip(), f"{report.number(self.low)} to {report.number(self.high)}",
                "yes" if self.is_met() else "**no**"]


class Page(report.Section):
    """A section that is a page of its own. Its CSV file and pictures stand beside it."""

    def __init__(self, name, title, question, bench):
        super().__init__(name, title, question, bench)
        self.results = []

    def result(self, *words, **more):
        self.results.append(Result(*words, **more))

    def failed(self):
        return [each for each in self.results if not each.is_met()]

    def command(self):
        return super().command().replace("scripts/bench", "scripts/validate")

    def _results(self):
        os.makedirs(self.bench.out, exist_ok=True)
        return self.bench.out

    def picture(self, file):
        return file

    def _summary(self):
        lines = ["| number | Talus | published | within |", "|---|---|---|---|"]
        return "\n".join(lines + ["| " + " | ".join(each.cells()) + " |" for each in self.results])

    def write(self):
        if self.rows:
            self._write_csv()
        parts = [f"# {self.title}", self.question.strip(), self._summary(), *self.blocks, self._stamp()]
        os.makedirs(self.bench.out, exist_ok=True)
        with open(os.path.join(self.bench.out, self.name + ".md"), "w") as file:
            file.write("\n\n".join(parts) + "\n")
        write_index(self.bench.out)


def write_index(folder):
    """From the tables of the pages that are there."""
    rows = []
    for name in sorted(os.listdir(folder)):
        if not name.endswith(".md") or name == "README.md":
            continue
        with open(os.path.join(folder, name)) as file:
            text = file.read()
        title = re.search(r"^# (.*)$", text, re.MULTILINE)[1]
        found = re.search(r"\| number \| Talus \| published \| within \|\n\|[-|]+\n((?:\|.*\n)*)", text)
        for k, row in enumerate(found[1].splitlines() if found else []):
            rows.append((f"| [{title}]({name}) " if k == 0 else "| ") + row)
    with open(os.path.join(folder, "README.md"), "w") as file:
        file.write(HEAD + "\n".join(rows) + "\n")
