# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Contact laws drawn at random, as words of pair_coeff and of `contact`, for grains of diameter and density 1 or so."""

import granular_models
from quantities import line, number

STIFFNESS, PRESSURE, RATE = (0, 1, -2), (-1, 1, -2), (0, 0, -1)
RATE_BY_LENGTH, RATE_BY_AREA = (-1, 0, -1), (-2, 0, -1)
SPEED, FORCE, TORQUE = (1, 0, -1), (1, 1, -2), (2, 1, -2)
CONDUCTIVITY, BY_AREA, HEAT_CAPACITY = (1, 1, -3), (0, 1, -3), (2, 0, -2)    # of one unit of temperature
TENSION, VOLUME, VISCOSITY = (0, 1, -2), (3, 0, 0), (-1, 1, -1)
RESISTING = "rolling", "spinning", "twisting"


def some(rng, low, high, *units):
    """A number of five digits."""
    return number(float(f"{rng.uniform(low, high):.5g}"), *units)


def _normal(rng, name):
    """Words, and the units of gt (None: it has to be NULL)."""
    kn, e, nu = some(rng, 4e3, 2e4, *STIFFNESS), some(rng, 0.3, 0.95), some(rng, 0.1, 0.45)
    pressure, young = some(rng, 6e3, 3e4, *PRESSURE), some(rng, 1e4, 6e4, *PRESSURE)
    return {
        "hooke": (line(kn, some(rng, 5, 60, *RATE)), RATE),
        "hertz": (line(pressure, some(rng, 5, 60, *RATE_BY_LENGTH)), RATE_BY_LENGTH),
        "flores": (line(pressure, some(rng, 100, 2e3, *RATE_BY_AREA)), RATE_BY_LENGTH),
        "hooke/material": (line(young, e, nu, some(rng, 0.5, 2.0, *SPEED)), None),
        "hertz/material": (line(young, e, nu), None),
        "flores/material": (line(young, e, nu, some(rng, 0.5, 2.0, *SPEED)), None),
        "dmt": (line(young, some(rng, 5, 60, *RATE_BY_LENGTH), nu, some(rng, 0.5, 10, 0, 1, -2)), None),
        "jkr": (line(young, some(rng, 5, 60, *RATE_BY_LENGTH), nu, some(rng, 0.5, 10, 0, 1, -2)), None),
        "luding": (line(some(rng, 4e3, 1e4, *STIFFNESS), some(rng, 1.5e4, 3e4, *STIFFNESS), some(rng, 0, 8e3, *STIFFNESS),
                        some(rng, 0.01, 0.1), some(rng, 0, 30, *RATE)), RATE),
        "walton/braun": (line(some(rng, 4e3, 1e4, *STIFFNESS), some(rng, 1.1e4, 3e4, *STIFFNESS), some(rng, 0, 30, *RATE)), RATE),
    }[name]


COHESIVE = "dmt", "jkr"
PLASTIC = "luding", "walton/braun"
ADHESIVE = *COHESIVE, "luding"    # of their own
NORMALS = "hooke", "hertz", "flores", "hooke/material", "hertz/material", "flores/material"
MATERIALS = NORMALS[3:]


def _tangential(rng, normal, gt):
    mu = some(rng, 0.1, 0.7)
    if rng.random() < 0.12:
        return ()
    if rng.random() < 0.2 and normal not in COHESIVE:
        damping = some(rng, 5, 30, *gt) if gt else "NULL"
        return line("tangential dashpot", damping, mu)
    kinds = ("multistep",) * 3 + ("onestep", "linear_history", "mindlin", "linear_nohistory")
    kind = "mindlin" if normal in COHESIVE else rng.choice(kinds)
    xt = some(rng, 0.3, 1.2)
    if kind == "linear_nohistory":
        return line("tangential", kind, xt, mu)
    if kind == "linear_history":
        return line("tangential", kind, some(rng, 1e3, 5e3, *STIFFNESS), xt, mu)
    if kind == "mindlin":
        kind += rng.choice(("", "/force", "_rescale", "_rescale/force"))
        return line("tangential", kind, some(rng, 2e3, 1e4, *PRESSURE), xt, mu)
    damping = some(rng, 5, 30, *gt) if normal == "flores" else "NULL"
    rule = rng.choice(("", "midpoint", "stock", "slider", "slider midpoint")) if kind == "multistep" else ""
    return line("tangential", kind, "NULL", damping, mu, rule.split())


def _resistance(rng, tangential):
    found = ()
    if rng.random() < 0.3:
        found = line("rolling", some(rng, 0.02, 0.2))
        if rng.random() < 0.3:
            found = line("rolling sds", some(rng, 200, 1e3, *STIFFNESS), some(rng, 1, 20, 0, 1, -1), some(rng, 0.02, 0.3))
    if rng.random() < 0.2:
        found = line(found, "spinning", some(rng, 0.02, 0.2))
    elif rng.random() < 0.15:
        found = line(found, "twisting sds", some(rng, 50, 500, *TORQUE), some(rng, 0.5, 5, 2, 1, -1), some(rng, 0.01, 0.2, 1, 0, 0))
    return found


def _adhesion(rng):
    """Keyword adhesion and its words, or none."""
    kind = rng.random()
    if kind < 0.15:
        return line("adhesion constant", some(rng, 1, 20, *FORCE))
    if kind > 0.3:
        return ()
    return _bridges(rng)


def _bridges(rng):
    amount = line("volume", some(rng, 5e-4, 5e-3, *VOLUME)) if rng.random() < 0.5 else line("fraction", some(rng, 1e-3, 1e-2))
    model = "adhesion willett" if rng.random() < 0.5 else "adhesion rabinovich"
    words = line(model, some(rng, 0.2, 4, *TENSION), some(rng, 0, 80), amount)
    if rng.random() < 0.5:
        words = line(words, "viscosity", some(rng, 0.01, 0.2, *VISCOSITY), some(rng, 0.01, 0.1))
    return words


def wet(rng):
    """Of particles that have liquid, which bridges take from them."""
    normal = rng.choice(NORMALS)
    words, gt = _normal(rng, normal)
    tangential = _tangential(rng, normal, gt)
    return line(normal, words, tangential, _resistance(rng, tangential), _bridges(rng), "share", some(rng, 0.2, 1))


def law(rng, shapes=False, normal=None):
    """Words of any law; shapes: of those that particles with a shape may have."""
    normal = normal or rng.choice(NORMALS if shapes else NORMALS + COHESIVE + PLASTIC)
    words, gt = _normal(rng, normal)
    tangential = _tangential(rng, normal, gt)
    more = () if shapes else _resistance(rng, tangential)
    if normal not in ADHESIVE:
        if not shapes:
            more = line(more, _adhesion(rng))
        elif rng.random() < 0.15:
            more = line(more, "adhesion constant", some(rng, 1, 20, *FORCE))
        if rng.random() < 0.3:
            more = line(more, "limit_damping")
    return line(normal, words, tangential, more)


def of_second_order(rng, normal):
    """One that the integrator with `order 2` takes."""
    words, _ = _normal(rng, normal)
    return line(normal, words, "tangential multistep NULL NULL", some(rng, 0.1, 0.7), "slider midpoint limit_damping")


def heat(rng):
    """Keyword heat of a law."""
    if rng.random() < 0.5:
        return line("heat radius", some(rng, 1, 20, *CONDUCTIVITY))
    return line("heat area", some(rng, 1, 20, *BY_AREA))


def elastic(rng, normal="hooke"):
    """Without damping and friction: the force is that of an energy."""
    units = STIFFNESS if normal == "hooke" else PRESSURE
    return line(normal, some(rng, 4e3, 2e4, *units), "0")


# ---- of LAMMPS ----------------------------------------------------------------------------------

def stock(rng):
    """Pair style, its words for a wall, and whether the wall takes them behind `granular`."""
    style = rng.choice(("gran/hooke", "gran/hooke/history", "gran/hertz/history"))
    units, rate = (PRESSURE, RATE_BY_LENGTH) if "hertz" in style else (STIFFNESS, RATE)
    words = line(some(rng, 4e3, 2e4, *units), rng.choice(("NULL", some(rng, 2e3, 5e3, *units))), some(rng, 5, 60, *rate),
                 rng.choice(("NULL", some(rng, 5, 30, *rate))), some(rng, 0.1, 0.7), rng.choice("01"))
    if rng.random() < 0.2:
        words = line(words, "limit_damping")
    return style, words


def granular(rng):
    """Words of pair_style granular, in these units only."""
    return line(granular_models.words(rng.choice(granular_models.combinations()), rng, rng.random() < 0.2))
