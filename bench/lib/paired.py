# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Comparison of run times on a machine whose speed drifts.

All variants run one after the other in each round, pinned to the same core, every second round in
reverse order.  Ratios are taken within a round, and medians over the rounds."""

import dataclasses
import statistics

import machine


@dataclasses.dataclass
class Series:
    """Values of one variant, one for each round."""
    values: list

    @property
    def median(self):
        return statistics.median(self.values)


@dataclasses.dataclass
class Ratio:
    """Median, smallest and largest of the ratios of all rounds."""
    median: float
    low: float
    high: float

    def __str__(self):
        return f"{self.median:.2f} ({self.low:.2f} to {self.high:.2f})"


def one_core():
    """The core that single-core measurements are pinned to: not the first one, which serves interrupts."""
    return [machine.cores()[-1]]


def measure(variants, rounds):
    """variants: {name: function that runs it and returns a number}.  Returns {name: Series}."""
    series = {name: Series([]) for name in variants}
    order = list(variants)
    for k in range(rounds):
        for name in order if k % 2 == 0 else reversed(order):
            series[name].values.append(variants[name]())
    return series


def ratio(numerator, denominator):
    """numerator/denominator, round by round."""
    each = [a / b for a, b in zip(numerator.values, denominator.values)]
    return Ratio(statistics.median(each), min(each), max(each))
