# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Plots that can be read in gray: series differ by marker, dash and shade, not by hue."""

STYLES = [
    {"color": "0.0", "marker": "o", "linestyle": "-"},
    {"color": "0.0", "marker": "s", "linestyle": "--"},
    {"color": "0.3", "marker": "^", "linestyle": "-"},
    {"color": "0.3", "marker": "D", "linestyle": ":"},
    {"color": "0.55", "marker": "v", "linestyle": "-"},
    {"color": "0.55", "marker": "x", "linestyle": "--"},
    {"color": "0.55", "marker": "+", "linestyle": ":"},
    {"color": "0.7", "marker": "*", "linestyle": "-."},
]


def style(k, **more):
    return {**STYLES[k % len(STYLES)], "markersize": 5, "linewidth": 1.1, **more}


def save(path, draw):
    """False if matplotlib is not there."""
    try:
        import matplotlib
    except ImportError:
        return False
    matplotlib.use("svg")
    from matplotlib import pyplot
    # the same figures give the same file
    matplotlib.rcParams.update({"svg.hashsalt": "talus", "axes.axisbelow": True, "font.size": 9, "axes.grid": True, "grid.color": "0.85",
                                "legend.fontsize": 7, "svg.fonttype": "none", "figure.constrained_layout.use": True})
    draw(pyplot)
    pyplot.savefig(path, metadata={"Date": None})
    pyplot.close("all")
    return True
