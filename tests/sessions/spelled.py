# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A session as text that a user can run: an input script, or a program where a partner takes part; with its files."""


FLUID = """low, high, _, _, _, periodic, _ = lmp.extract_box()
room = [0.0 if along else 5.0 for along in periodic]
fluid = partner.fluid_grid([a - b for a, b in zip(low, room)], [a + b for a, b in zip(high, room)], (2, 2, 2), "tophat 1")
fluid.drag_law("{all}", 0.1, 0.05)
fluid.put([[0.3, 0.0, 0.5]] * 8, vorticity=[[0.2, -0.5, 1.0]] * 8)"""
CALLS = {"fluid": FLUID, "advance": "partner.advance({0})", "save": "{0} = partner.save()", "restore": "partner.restore({0})",
         "discard": "{0}.discard()", "set_up": "partner.set_up()", "close": "partner.close(); partner = Partner(lmp)",
         "put_forces": "partner.put_forces([{0}], [{rest}])", "put_drag": "partner.put_drag([{0}], [{1}], [{last}])",
         "put_state": "partner.body('{0}').put_state([{state}], {steps})", "watch": "partner.body('{0}').watch()",
         "other": "other = Partner(lmp)", "other_forces": "other.put_forces([{0}], [{rest}])", "other_close": "other.close()",
         "load": "partner.body('{0}').load()"}


def _call(name, words):
    return CALLS[name].format(*words, all=" ".join(words), rest=", ".join(words[1:]), last=", ".join(words[2:]), state=", ".join(words[1:-1]),
                              steps=words[-1] if words else "")


def spelled(session):
    coupled = any(line.startswith("@") for line in session.lines)
    ranks = f"mpirun -np {session.ranks} " if session.ranks > 1 else ""
    threads = f"OMP_NUM_THREADS={session.threads} " if session.threads > 1 else ""
    if coupled:
        command = f"scripts/run program.py -np {session.ranks} -nt {session.threads}"
        body = ["from lammps import lammps", "from talus import Partner", f"lmp = lammps(cmdargs={list(session.words)!r})", "partner = None"]
        for line in session.lines:
            if line.startswith("@"):
                name, *words = line[1:].split()
                body += ["partner = partner or Partner(lmp)", _call(name, words)]
            else:
                body.append(f"lmp.command({line!r})")
    else:
        command = f"{threads}{ranks}build/lmp {' '.join(session.words)} -in in.session"
        body = session.lines
    files = "".join(f"\n# ---- file {name}\n" + (data.decode(errors="replace") if len(data) < 6000 and b"\0" not in data
                                                  else f"# {len(data)} bytes") for name, data in session.files.items())
    return f"# ---- {command}\n" + "\n".join(body) + files + "\n"
