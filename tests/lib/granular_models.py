# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Random models of pair_style granular, as words of pair_coeff."""

NORMALS = "hooke", "hertz", "hertz/material", "dmt", "jkr"
COHESIVE = "dmt", "jkr"
MATERIAL = "hertz/material", "dmt", "jkr"
DAMPINGS = "velocity", "mass_velocity", "viscoelastic", "tsuji", "coeff_restitution"
NOT_COHESIVE = "tsuji", "coeff_restitution"
TANGENTIALS = ("linear_nohistory", "linear_history", "linear_history_classic", "mindlin_classic", "mindlin",
               "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
TAKE_NULL = "mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force"
ROLLINGS = "none", "sds"
TWISTINGS = "none", "marshall", "sds"


def allowed(normal, damping, tangential, twisting):
    """LAMMPS refuses some; and marshall without a spring divides by zero."""
    if normal in COHESIVE and damping in NOT_COHESIVE:
        return False
    return not (twisting == "marshall" and tangential == "linear_nohistory")


def combinations():
    return [(n, d, t, r, w) for n in NORMALS for d in DAMPINGS for t in TANGENTIALS for r in ROLLINGS for w in TWISTINGS
            if allowed(n, d, t, w)]


def synchronized(combination):
    """Those that allow synchronized_verlet, which LAMMPS has from 4 Jul 2026 on."""
    return combination[2] != "linear_nohistory"


def words(combination, rng, limit=False):
    """Of one model of these sub-models, with random numbers."""
    normal, damping, tangential, rolling, twisting = combination

    def number(low, high):
        return f"{rng.uniform(low, high):.6g}"

    damp = number(0.3, 0.95) if damping in NOT_COHESIVE else number(1.0, 20.0)
    text = {"hooke": f"hooke {number(1000, 3000)} {damp}",
            "hertz": f"hertz {number(3000, 10000)} {damp}",
            "hertz/material": f"hertz/material {number(5000, 20000)} {damp} {number(0.1, 0.45)}",
            "dmt": f"dmt {number(5000, 20000)} {damp} {number(0.1, 0.45)} {number(0.5, 10.0)}",
            "jkr": f"jkr {number(5000, 20000)} {damp} {number(0.1, 0.45)} {number(0.5, 10.0)}"}[normal]
    text += f" damping {damping} tangential {tangential}"
    if tangential != "linear_nohistory":
        null = tangential in TAKE_NULL and normal in MATERIAL and rng.random() < 0.5
        text += " NULL" if null else f" {number(500, 5000)}"
    text += f" {number(0.3, 1.5)} {number(0.1, 0.7)}"
    if rolling == "sds":
        text += f" rolling sds {number(200, 1000)} {number(1.0, 20.0)} {number(0.02, 0.3)}"
    if twisting != "none":
        text += f" twisting {twisting}"
    if twisting == "sds":
        text += f" {number(50, 500)} {number(0.5, 5.0)} {number(0.01, 0.2)}"
    if limit and normal not in COHESIVE:
        text += " limit_damping"
    return text
