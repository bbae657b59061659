# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""REPORT.md: a head, and one section for each benchmark between markers, replaced by the benchmark."""

import csv
import os
import re

import machine

ORDER = ("single", "dropin", "stages", "bits", "memory", "profile", "scaling", "exchange", "needs", "bodies", "shapes", "sizes", "outputs",
         "accuracy", "timestep", "stability")
HEAD = """# Benchmarks

Written by `scripts/bench NAME`; every section says when, where and with which versions, and how to repeat it.
Ratios come from runs that took turns on the same core.
"""


def _markers(name):
    return f"<!-- begin {name} -->", f"<!-- end {name} -->"


class Section:
    """Collects text, tables and plots of one benchmark; write() puts them into the report."""

    def __init__(self, name, title, question, bench):
        self.name, self.title, self.question, self.bench = name, title, question, bench
        self.blocks = []
        self.headlines = []      # what the first paragraph of the report must say
        self.rows = []           # of the CSV file
        self.loads = [machine.load()]

    # ---- filling

    def text(self, paragraph):
        self.blocks.append(paragraph.strip())

    def heading(self, words):
        self.blocks.append(f"### {words}")

    def headline(self, sentence):
        self.headlines.append(sentence.strip())

    def table(self, columns, rows):
        """A Markdown table; rows: lists of things to print."""
        lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
        lines += ["| " + " | ".join(number(cell) for cell in row) + " |" for row in rows]
        self.blocks.append("\n".join(lines))

    def record(self, **values):
        """One row of the CSV file, which has the union of all columns."""
        self.rows.append(values)

    def plot(self, suffix, caption, draw):
        """draw(pyplot) fills a figure; saved as NAME[-suffix].svg. Left out without matplotlib."""
        import plot
        file = self.name + (f"-{suffix}" if suffix else "") + ".svg"
        if plot.save(os.path.join(self._results(), file), draw):
            self.blocks.append(f"![{caption}]({self.picture(file)})\n\n*{caption}*")
        else:
            self.blocks.append(f"*(No plot: {caption}. matplotlib is not installed.)*")

    def failed(self):
        """What makes the command fail: nothing, since a benchmark only reports."""
        return []

    # ---- writing

    def picture(self, file):
        """Its address in the text."""
        return f"results/{file}"

    def _results(self):
        path = os.path.join(self.bench.out, "results")
        os.makedirs(path, exist_ok=True)
        return path

    def _write_csv(self):
        columns = list(dict.fromkeys(key for row in self.rows for key in row))
        with open(os.path.join(self._results(), self.name + ".csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, columns, lineterminator="\n")
            writer.writeheader()
            writer.writerows(self.rows)

    def _stamp(self):
        self.loads.append(machine.load())
        lines = machine.stamp()
        lines.append(f"load average {self.loads[0]:.2f} when it began; {self.bench.rounds} rounds; "
                     f"took {self.bench.clock()} minutes; repeat: `{self.command()}`")
        if self.bench.quick or self.bench.cases:
            lines.append("**quick or partial run: figures are not to be quoted**")
        return "\n".join(f"* {line}" for line in lines)

    def command(self):
        words = ["scripts/bench", self.name]
        if self.bench.quick:
            words.append("--quick")
        if self.bench.asked_rounds:
            words += ["--rounds", str(self.bench.asked_rounds)]
        if self.bench.cases:
            words += ["--cases", f"'{self.bench.cases[0]}'"]
        return " ".join(words)

    def _text(self):
        begin, end = _markers(self.name)
        comments = [f"<!-- headline {sentence} -->" for sentence in self.headlines]
        parts = [f"## {self.title}", self._stamp(), self.question.strip(), *self.blocks]
        return "\n".join([begin, *comments]) + "\n" + "\n\n".join(parts) + f"\n{end}\n"

    def write(self):
        if self.rows:
            self._write_csv()
        os.makedirs(self.bench.out, exist_ok=True)
        path = os.path.join(self.bench.out, "REPORT.md")
        sections = read_sections(path)
        sections[self.name] = self._text()
        with open(path + ".new", "w") as file:
            file.write(compose(sections))
        os.replace(path + ".new", path)


def read_sections(path):
    """{name: text with its markers} of an existing report."""
    if not os.path.exists(path):
        return {}
    with open(path) as file:
        text = file.read()
    return {match[1]: match[0] for match in
            re.finditer(r"<!-- begin (\w+) -->\n.*?<!-- end \1 -->\n", text, re.DOTALL)}


def compose(sections):
    """Head with the headlines of all sections, then the sections in their order."""
    found = [sentence for name in ORDER if name in sections
             for sentence in re.findall(r"<!-- headline (.*?) -->", sections[name])]
    head = HEAD + ("\n" + "\n".join(f"* {sentence}" for sentence in found) + "\n" if found else "")
    return "\n".join([head, *(sections[name] for name in ORDER if name in sections)])


def number(value):
    """For a table: three or four figures that count."""
    if isinstance(value, float):
        if value != value:
            return "-"
        if value == 0.0 or 1e-2 <= abs(value) < 1e4:
            return f"{value:.4g}"
        return f"{value:.2e}"
    return str(value)
