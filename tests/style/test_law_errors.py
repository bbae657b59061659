# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=900 stay
"""Every refusal of the words of a contact law, in pair_coeff gran/penalty and in fix large/body, and of the computes
that go with them: its text and the word it points at, on 1 and 2 ranks."""

import concurrent.futures
import math
import re
import tempfile
import unittest

from talus_testing import SceneCase, head, marked_word, ranks_of_refusal, thermo

BOX = head("si", "p p p") + """
region box block -4 4 -4 4 -4 4
create_box 2 box
create_atoms 1 single -2 0 0
create_atoms 2 single 2 0 0
set group all diameter 1 density 1
pair_style gran/penalty
"""
PLANE = "fix floor all large/body plane 0 0 -4 0 0 1 "
GOOD = "hertz/material 1e6 0.5 0.3"
LAWS = "hooke, hertz, flores, plaincoulomb, hooke/material, hertz/material, flores/material, " \
       "plaincoulomb/material, dmt, jkr, luding, walton/braun or eepa"
KEYWORDS = "expected tangential, damping, rolling, spinning, twisting, adhesion, heat, vmin or limit_damping"
TANGENTIAL = "none, dashpot, onestep, multistep, linear_nohistory, linear_history, linear_history_classic, mindlin, " \
             "mindlin/force, mindlin_rescale, mindlin_rescale/force or mindlin_classic"
DAMPING = "mass_velocity, viscoelastic, none, velocity, tsuji or coeff_restitution"
TWISTING = "stopping, marshall or sds"
ADHESIONS = "constant, dmt, perko, willett or rabinovich"

NOT_NEGATIVE, POSITIVE, UNIT = r"\(a number >= 0\)", r"\(a number > 0\)", r"\(a number from 0 to 1\)"
POISSON = r"\(a number above -1, up to 0.5\)"

# arguments of each normal law: name in messages, range, a good word, bad words
E = ("Young's modulus E", POSITIVE, "1e6", ("0", "-1", "x", "1e999", "nan"))
RESTITUTION = ("restitution e", UNIT, "0.5", ("-0.1", "1.1", "x"))
NU = ("Poisson's ratio nu", POISSON, "0.3", ("-1", "0.51", "x"))
VCHAR = ("characteristic speed vchar", POSITIVE, "1.0", ("0", "-1", "x"))
KN = ("kn", NOT_NEGATIVE, "1e3", ("-1", "x", "inf"))
GN = ("gn", NOT_NEGATIVE, "2.0", ("-1", "x"))
GAMMA = ("gamma", NOT_NEGATIVE, "0.1", ("-0.5", "x"))
LOADING = (("stiffness k1 of loading", POSITIVE, "1e3", ("0", "x")), ("stiffness k2 of unloading", POSITIVE, "5e3", ("0", "inf")))
MU = ("mu", NOT_NEGATIVE, "0.5", ("-0.5", "x"))
ARGUMENTS = {
    "hooke": (KN, GN), "hertz": (KN, GN), "flores": (KN, GN), "plaincoulomb": (KN, GN, MU),
    "hooke/material": (E, RESTITUTION, NU, VCHAR), "hertz/material": (E, RESTITUTION, NU),
    "flores/material": (E, RESTITUTION, NU, VCHAR), "plaincoulomb/material": (E, RESTITUTION, NU, MU),
    "dmt": (E, GN, NU, GAMMA), "jkr": (E, GN, NU, GAMMA),
    "luding": (*LOADING, ("adhesive stiffness kc", NOT_NEGATIVE, "1e3", ("-1", "x")), ("plasticity depth phi", POSITIVE, "0.05", ("0",)), GN),
    "walton/braun": (*LOADING, GN),
    "eepa": (E, RESTITUTION, NU, GAMMA, ("plasticity ratio lambda", r"\(a number from 0 to 0.999\)", "0.5", ("1", "-0.1")),
             ("pull-off force f0", NOT_NEGATIVE, "0.1", ("-1", "x")), ("exponent n", r"\(a number from 1 to 3\)", "1.5", ("0.9", "4")),
             ("exponent chi", r"\(a number from 1 to 10\)", "2.0", ("0", "inf"))),
}
KT = ("kt", NOT_NEGATIVE, "1e3", ("-1", "x"))
GT = ("gt", NOT_NEGATIVE, "2.0", ("-1", "x"))
KT_OR_NULL, XT = ("kt", NOT_NEGATIVE, "NULL", ("-1", "x")), ("xt", NOT_NEGATIVE, "1.0", ("-1", "NULL"))
SDS = ("k", "gamma", "mu")
KEYWORD_ARGUMENTS = {
    "tangential dashpot": (GT, MU), "tangential onestep": (KT, GT, MU), "tangential multistep": (KT, GT, MU),
    "rolling": (("mu_r", NOT_NEGATIVE, "0.1", ("-0.1", "delayed")),),
    "spinning": (("mu_s", NOT_NEGATIVE, "0.1", ("-0.1", "NULL")),),
    "tangential linear_nohistory": (XT, MU), "tangential linear_history": (KT, XT, MU),
    "tangential linear_history_classic": (KT, XT, MU), "tangential mindlin": (KT_OR_NULL, XT, MU),
    "tangential mindlin_rescale/force": (KT_OR_NULL, XT, MU),
    "rolling sds": tuple((f"{name}_roll", NOT_NEGATIVE, "1.0", ("-1", "x")) for name in SDS),
    "twisting sds": tuple((f"{name}_twist", NOT_NEGATIVE, "1.0", ("-1", "x")) for name in SDS),
    "twisting stopping": (("mu_s", NOT_NEGATIVE, "0.1", ("-0.1",)),),
    "adhesion constant": (("adhesive force F", NOT_NEGATIVE, "1.0", ("-1", "x")),),
    "adhesion dmt": (("adhesion W", NOT_NEGATIVE, "1.0", ("-1",)),),
    "heat radius": (("heat", NOT_NEGATIVE, "1.0", ("-1", "x")),), "heat area": (("heat", NOT_NEGATIVE, "1.0", ("-1",)),),
    "heat gas": (("conductivity k of the grains", POSITIVE, "1.0", ("0", "x")), ("conductivity of the gas", POSITIVE, "0.02", ("0",)),
                 ("radius of the column over that of the grain", POSITIVE, "0.5", ("-1",)), ("reach over the radius", POSITIVE, "0.4", ("0",))),
    "adhesion perko": (("adhesion S", NOT_NEGATIVE, "1.0", ("-1",)),),
    "vmin": (("slip speed", NOT_NEGATIVE, "1e-4", ("-1", "x")), ("roll speed", NOT_NEGATIVE, "1e-4", ("-1",)),
             ("spin speed", NOT_NEGATIVE, "1e-4", ("-1", "limit_damping"))),
}


def argument_cases(words, arguments):
    """Words with one argument too few, and with one bad argument, at every position."""
    for n, (name, unit, _, bad) in enumerate(arguments):
        before = [a[2] for a in arguments[:n]]
        yield " ".join([words, *before]), f"missing {name} {unit}", (words.split() + before)[-1]
        for word in bad:
            after = [a[2] for a in arguments[n + 1:]]
            yield (" ".join([words, *before, word, *after]), f"expected {name} {unit} instead of '{word}'", word)


def law_cases():
    """(words of a contact, what the message says, the word it points at)"""
    yield "hook 1e3 2.0", f"unknown normal law 'hook', expected {LAWS}", "hook"
    yield "material 1e3 2.0", f"unknown normal law 'material', expected {LAWS}", "material"
    for law, arguments in ARGUMENTS.items():
        yield from argument_cases(law, arguments)
        good = " ".join([law, *(a[2] for a in arguments)])
        yield f"{good} 7.0", None, "7.0"    # surplus: text depends on the command
    for words, arguments in KEYWORD_ARGUMENTS.items():
        for case in argument_cases(f"{GOOD} {words}", arguments):
            yield case
    yield f"{GOOD} tangential", f"missing tangential law: {TANGENTIAL}", "tangential"
    yield f"{GOOD} tangential hertz", f"unknown tangential law 'hertz', expected {TANGENTIAL}", "hertz"
    yield f"{GOOD} tangential tanh 0.5", "unknown tangential law 'tanh'", "tanh"
    yield f"{GOOD} tangential none 0.5", None, "0.5"
    yield "hooke 1e3 2.0 tangential multistep 1e3", "missing gt", "1e3"
    yield "hooke 1e3 2.0 tangential multistep 0.0 2.0 0.5", "tangential multistep needs kt > 0", "0.0"
    yield "hooke 0.0 2.0 tangential multistep NULL 2.0 0.5", "tangential multistep needs kt > 0", "NULL"
    for mode in "dashpot", "onestep NULL", "multistep 1e3":
        yield (f"flores 1e3 2.0 tangential {mode} NULL 0.5", "expected a number for gt instead of NULL: gn of "
               "flores has another unit", "NULL")
    for words, surplus in ("midpoint midpoint", "midpoint"), ("stock slider", "slider"), ("slider slider", "slider"), ("spring stock", "stock"):
        yield (f"{GOOD} tangential multistep NULL NULL 0.5 {words}",
               f"surplus word '{surplus}' after tangential multistep", surplus)
    for words in "spring midpoint", "midpoint spring":
        yield (f"{GOOD} tangential multistep NULL NULL 0.5 {words}", "'spring' is a rule for the plain update: remove 'midpoint'",
               words.split()[-1])
    yield f"{GOOD} tangential dashpot NULL 0.5 slider", None, "slider"
    yield ("hooke/material 1e6 0.5 0.3 1.0 tangential multistep 1e3 NULL 0.5",
           "expected NULL for kt: hooke/material takes kt = kn", "1e3")
    yield ("hooke/material 1e6 0.5 0.3 1.0 tangential onestep 1e3 NULL 0.5",
           "expected NULL for kt: hooke/material takes kt = kn", "1e3")
    yield f"{GOOD} tangential multistep NULL NULL NULL", "expected mu .* instead of 'NULL'", "NULL"
    for law in "plaincoulomb 1e3 2.0 0.5", "plaincoulomb/material 1e6 0.5 0.3 0.5":
        name = law.split()[0]
        for mode in "multistep NULL NULL 0.5", "none":
            yield (f"{law} tangential {mode}",
                   f"'{name}' has a tangential force of its own: remove 'tangential'", "tangential")
    for keyword in ("tangential none", "rolling 0.1", "spinning 0.1", "adhesion dmt 1.0", "heat area 1.0", "vmin 0 0 0",
                    "limit_damping"):
        word = keyword.split()[0]
        yield f"{GOOD} {keyword} {keyword}", f"'{word}' given twice", word
    yield f"{GOOD} rolling 0.1 spinning 0.1 rolling 0.2", "'rolling' given twice", "rolling"
    both = "rolling and spinning must both be delayed, or both not"
    yield f"{GOOD} tangential multistep NULL NULL 0.5 rolling 0.1 delayed spinning 0.1", both, "0.1"
    yield f"{GOOD} tangential multistep NULL NULL 0.5 rolling 0.1 spinning 0.1 delayed", both, "delayed"
    yield f"{GOOD} adhesion", f"missing adhesion: {ADHESIONS}", "adhesion"
    yield f"{GOOD} heat volume 1.0", "unknown heat 'volume', expected radius, area or gas", "volume"
    yield (f"{GOOD} adhesion jkr 1.0", f"unknown adhesion 'jkr', expected {ADHESIONS}", "jkr")
    yield f"{GOOD} adhesion 1.0", f"unknown adhesion '1.0', expected {ADHESIONS}", "1.0"
    yield from granular_cases()
    yield from wet_and_plastic_cases()
    yield f"{GOOD} delayed", None, "delayed"
    yield f"{GOOD} rolling 0.1 delayed delayed", None, "delayed"
    yield f"{GOOD} limit_damping yes", None, "yes"
    yield f"{GOOD} foo", None, "foo"


def wet_and_plastic_cases():
    wet = f"{GOOD} adhesion willett"
    yield wet, "missing surface tension gamma", "willett"
    yield f"{wet} -0.1 20 volume 1e-3", "expected surface tension gamma", "-0.1"
    yield f"{wet} 0.1 95 volume 1e-3", "expected contact angle in degrees", "95"
    yield f"{wet} 0.1 20 1e-3", "unknown volume of the bridge '1e-3', expected volume or fraction", "1e-3"
    yield f"{wet} 0.1 20 volume 0", "expected volume of the bridge", "0"
    yield f"{wet} 0.1 20 fraction x", "expected fraction of the particles' volume", "x"
    yield f"{wet} 0.1 20 fraction 0.01 viscosity 1.0", "missing least gap over the effective radius", "1.0"
    yield f"{wet} 0.1 20 fraction 0.01 viscosity -1.0 0.1", "expected viscosity eta", "-1.0"
    yield f"{wet} 0.1 20 fraction 0.01 viscosity 1.0 0", "expected least gap over the effective radius", "0"
    for word in "0", "1.01", "-0.1", "x":
        yield f"{wet} 0.1 20 volume 1e-3 share {word}", "expected share of the liquid between the particles", word
    yield f"{wet} 0.1 20 volume 1e-3 share", "missing share of the liquid between the particles", "share"
    yield f"{wet} 0.1 20 volume 1e-3 share 1 share 1", None, "share"
    yield "luding 1e3 1e3 0 0.1 2.0", "k2 of unloading must be larger than k1", "1e3"
    yield "luding 1e3 5e3 -1 0.1 2.0", "expected adhesive stiffness kc", "-1"
    yield "luding 1e3 5e3 0 0 2.0", "expected plasticity depth phi", "0"
    yield "luding 1e3 5e3 0 0.1 2.0 adhesion perko 1.0", "'luding' has adhesion of its own", "adhesion"
    yield "luding 1e3 5e3 0 0.1 2.0 limit_damping", "cannot limit damping with a cohesive normal law, luding", "limit_damping"
    yield "walton/braun 1e3 5e2 2.0", "k2 of unloading must be larger than k1", "5e2"


def granular_cases():
    """Of the words of LAMMPS' pair granular."""
    yield f"{GOOD} damping", f"missing damping: {DAMPING}", "damping"
    for word in "restitution", "flores":
        yield f"{GOOD} damping {word}", f"unknown damping '{word}', expected {DAMPING}", word
    yield f"{GOOD} twisting", f"missing twisting law: {TWISTING}", "twisting"
    yield f"{GOOD} twisting 0.1", f"unknown twisting law '0.1', expected {TWISTING}", "0.1"
    yield f"{GOOD} spinning sds", r"expected mu_s \(a number >= 0\) instead of 'sds'", "sds"
    # the second number, read when the damping is known
    yield "hertz/material 1e6 1.5 0.3 damping tsuji", f"expected restitution eta {UNIT} instead of '1.5'", "1.5"
    yield ("hertz/material 1e6 1.5 0.3 tangential none damping coeff_restitution",
           f"expected restitution eta {UNIT} instead of '1.5'", "1.5")
    yield "hooke 1e6 1.5 damping tsuji", f"expected restitution eta {UNIT} instead of '1.5'", "1.5"
    yield "hertz/material 1e6 1.5 0.3 tangential none", f"expected restitution e {UNIT} instead of '1.5'", "1.5"
    yield "hertz/material 1e6 1.5 0.3 foo", f"expected restitution e {UNIT} instead of '1.5'", "1.5"
    for arguments in "flores 1e3 2.0", "plaincoulomb 1e3 2.0 0.5", "flores/material 1e6 0.5 0.3 1.0", \
                     "plaincoulomb/material 1e6 0.5 0.3 0.5":
        yield (f"{arguments} damping none", f"'{arguments.split()[0]}' has a damping of its own: remove 'damping'", "damping")
    for name, why in ("none", "damping none has no tangential"), ("tsuji", "it is half of the normal"), \
                     ("coeff_restitution", "it is half of the normal"):
        yield (f"{GOOD} tangential multistep NULL 7.5 0.4 damping {name}", f"expected NULL for gt: .*{why}", "7.5")
        yield f"{GOOD} damping {name} tangential dashpot 7.5 0.4", f"expected NULL for gt: .*{why}", "7.5"
    for name in "linear_history", "linear_history_classic":
        yield f"{GOOD} tangential {name} NULL 1.0 0.5", "expected a number for kt instead of NULL", "NULL"
    yield ("hertz 1e6 2.0 tangential mindlin NULL 1.0 0.5",
           "expected a number for kt instead of NULL: hertz has no material to take it from", "NULL")
    marshall = "twisting marshall takes its coefficients from the tangential law: add 'tangential' with one of"
    yield f"{GOOD} twisting marshall", marshall, "marshall"
    yield f"{GOOD} twisting marshall tangential multistep NULL NULL 0.5", marshall, "marshall"
    both = "'spinning' and 'twisting' are two words for one torque: remove one"
    yield f"{GOOD} twisting sds 1 2 3 spinning 0.1", both, "spinning"
    yield f"{GOOD} spinning 0.1 twisting sds 1 2 3", both, "twisting"
    for law in "dmt 1e6 2.0 0.3 0.1", "jkr 1e6 2.0 0.3 0.1", "eepa 1e6 0.5 0.3 0.1 0.5 0 1.5 1.5":
        name = law.split()[0]
        for damping in "tsuji", "coeff_restitution":
            yield (f"{law} damping {damping}", f"cannot use damping {damping} with a cohesive normal law, {name}", damping)
        yield f"{law} limit_damping", f"cannot limit damping with a cohesive normal law, {name}", "limit_damping"
        yield f"{law} adhesion dmt 1.0", f"'{name}' has adhesion of its own: remove 'adhesion'", "adhesion"
    yield ("hooke/material 1e6 0.5 0.3 1.0 tangential mindlin NULL 1.0 0.5 rolling 0.1 delayed twisting marshall "
           "damping velocity foo", None, "foo")


PAIR = f"pair_coeff * * {GOOD}\n"

# lines after the box, what the message says, the word it points at
OTHERS = [
    ("pair_style gran/penalty foo", "pair_style gran/penalty: unknown word 'foo', expected mix", "foo"),
    ("pair_style gran/penalty mix", "missing rule: min, arithmetic or geometric", "mix"),
    ("pair_style gran/penalty mix max", "unknown rule 'max', expected min", "max"),
    ("pair_style gran/penalty mix min 1", "surplus word '1'", "1"),
    ("pair_coeff * *", "expected two types and a contact law", None),
    ("pair_coeff 1 1 hooke 1e3 2.0\nrun 0", "All pair coeffs are not set", None),
    ("pair_coeff 1 1 hooke 1e3 2.0\npair_coeff 2 2 hertz 1e3 2.0\nrun 0",
     r"types 1 \(hooke \+ none\) and 2 \(hertz \+ none\) have different laws: add 'pair_coeff 1 2 ...'", None),
    ("pair_coeff 1 1 hooke 1e3 2.0 rolling 0.1\npair_coeff 2 2 hooke 1e3 2.0\nrun 0",
     "have different laws: add 'pair_coeff 1 2 ...'", None),
    ("pair_coeff 1 1 hooke 1e3 2.0 adhesion constant 1.0\npair_coeff 2 2 hooke 1e3 2.0\nrun 0",
     "have different laws: add 'pair_coeff 1 2 ...'", None),
    ("pair_coeff * * hooke 1e3 2.0 heat area 1.0\nrun 0", "heat is conducted between particles that have a "
     "temperature: add 'fix ID all property/atom temperature heatflow ghost yes'", None),
    # E and nu of types
    ("pair_coeff * * hertz/material NULL 0.5 NULL", "E and nu = NULL are those of types I and J in 'pair_coeff I J' with I < J: "
     "write numbers for types 1 and 1", None),
    (f"{PAIR}pair_coeff 1 2 hertz/material NULL 0.5 0.3", "expected NULL for Poisson's ratio nu, as for Young's modulus E, instead of '0.3'", "0.3"),
    (f"pair_coeff 1 1 hooke 1e3 2.0\npair_coeff 2 2 {GOOD}\npair_coeff 1 2 hertz/material NULL 0.5 NULL\nrun 0",
     "E and nu of types 1 and 2 are NULL, and type 1 has no material to take them from: set 'pair_coeff 1 1'", None),
    # large/body
    (f"{PAIR}{PLANE} contact hertz/material NULL 0.5 NULL", "fix large/body contact: E and nu = NULL are those of two types of particles, "
     "in pair_coeff: write numbers, or give the body a 'type'", "hertz/material"),
    (f"{PAIR}{PLANE} type", "fix large/body type: missing atom type", "type"),
    (f"{PAIR}{PLANE} type 3", "fix large/body type: there are 2 atom types: make one for the body in create_box", "3"),
    *((f"{PAIR}{PLANE} {words}", "the laws of a body are those of 'type', once, or of 'contact': remove one", marked) for words, marked in
      (("type 2 type 1", "type"), ("type 2 contact hooke 1 1", "contact"), ("contact hooke 1 1 type 2", "type"))),
    (f"pair_style none\n{PLANE} type 2\nrun 0", "Fix large/body floor: the body has the laws of type 2, and there is none for types 1 and 2: "
     "set 'pair_style gran/penalty' and 'pair_coeff 1 2 ...'", None),
    (f"pair_coeff * * hooke 1e3 2.0\n{PLANE} contact {GOOD}\nrun 0",
     "Fix large/body floor: the material law hertz/material needs the material of particles of type 1", None),
    (f"pair_coeff 1 1 {GOOD}\npair_coeff 1 2 hooke 1e3 2.0\npair_coeff 2 2 hooke 1e3 2.0\n{PLANE} contact {GOOD}\n"
     "run 0", "needs the material of particles of type 2", None),
    (f"pair_style none\n{PLANE} contact {GOOD}\nrun 0", "needs the material of particles of type 1", None),
    (f"{PAIR}{PLANE}", "no contact law for particles of type 1", None),
    (f"{PAIR}{PLANE} contact types 2 {GOOD}", "no contact law for particles of type 1", None),
    (f"{PAIR}{PLANE} contact types", "missing types", "types"),
    (f"{PAIR}{PLANE} contact", "missing normal law", "contact"),
    (f"{PAIR}{PLANE} contact hertz 1e6 2.0 heat area 1.0", "fix large/body: a law with 'heat', and the body has no "
     "temperature: add 'temperature T', or remove 'heat'", None),
    (f"{PAIR}{PLANE} contact hertz 1e6 2.0 temperature 300\nrun 0", "it has a temperature, and no law of its contacts conducts heat: "
     "add 'heat radius'", None),
    (f"{PAIR}{PLANE} contact hertz 1e6 2.0 heat area 1.0 temperature 300\nrun 0", "particles that have a temperature: add "
     "'fix ID all property/atom temperature heatflow ghost yes'", None),
    (f"{PAIR}{PLANE} contact hertz 1e6 2.0 heat area 1.0 temperature hot", "expected temperature T", "hot"),
    (f"{PAIR}{PLANE} contact hertz 1e6 2.0 heat area 1.0 temperature v_t\nrun 0", "variable 't' does not exist", None),
    (f"{PAIR}{PLANE} contact hertz 1e6 2.0 heat area 1.0 temperature NULL", "expected temperature T", "NULL"),
    # computes
    (f"{PAIR}compute s all penalty/stats foo", "compute penalty/stats: surplus word 'foo'", "foo"),
    (f"{PAIR}group one id 1\ncompute s one penalty/stats", "expected group all instead of 'one'", "one"),
    (f"{PAIR}compute t all timestep/gran foo", "compute timestep/gran: surplus word 'foo'", "foo"),
    ("pair_style none\ncompute s all penalty/stats\nrun 0", "requires one pair style gran/penalty", None),
    ("pair_style none\ncompute t all timestep/gran\nrun 0", "requires one pair style gran/penalty", None),
    ("pair_style gran/hooke/history 1e3 NULL 1.0 NULL 0.5 1\npair_coeff * *\ncompute s all penalty/stats\nrun 0",
     "requires one pair style gran/penalty", None),
]

ACCEPTED = [
    *(" ".join([law, *(a[2] for a in arguments)]) for law, arguments in ARGUMENTS.items()),
    *(f"{GOOD} damping {name} tangential multistep NULL NULL 0.5"
      for name in ("none", "velocity", "mass_velocity", "viscoelastic", "tsuji", "coeff_restitution")),
    "hertz/material 1e6 50.0 0.3 damping velocity tangential multistep NULL 3.0 0.5",
    "hooke 1e3 0 damping coeff_restitution", "hooke 1e3 1 damping tsuji limit_damping adhesion dmt 1.0",
    "dmt 1e6 2.0 0.3 0.1 twisting marshall rolling sds 1 2 3 tangential mindlin_rescale NULL 1.0 0.5 damping mass_velocity",
    f"{GOOD} spinning 0.1 rolling sds 1 2 3", f"{GOOD} rolling 0.1 twisting marshall tangential linear_nohistory 1.0 0.5",
    *(" ".join([GOOD, words, *(a[2] for a in arguments)]) for words, arguments in KEYWORD_ARGUMENTS.items() if not words.startswith("heat")),
    "hertz/material 1e6 0 0.5", "hertz/material 1e6 1 0", "hertz/material 1e6 1 -0.99",
    "flores/material 1e6 0 0.3 1e-9", "hooke 0 0", "hooke 0.0 0.0 tangential dashpot 1.0 0.5",
    "hertz/material 1e6 0.5 0.3 tangential multistep 1e6 0.5 0.5",
    "hooke/material 1e6 0.5 0.3 1.0 tangential multistep NULL 0.5 0.5",
    "luding 1e3 5e3 2e3 0.05 2.0 tangential multistep NULL NULL 0.5", "walton/braun 1e3 5e3 2.0 tangential multistep 1e3 NULL 0.5",
    "eepa 1e6 0.5 0.3 0.1 0 0 1 1 tangential multistep 1e5 NULL 0.5", "eepa 1e6 20 0.3 0.1 0.999 2 1.2 7 damping mass_velocity",
    "luding 1e3 5e3 2e3 0.05 2.0 damping velocity", "walton/braun 1e3 5e3 2.0 adhesion constant 1.0",
    f"{GOOD} adhesion willett 0.1 20 volume 1e-3", f"{GOOD} adhesion rabinovich 0.1 20 fraction 0.01 viscosity 0.1 0.01",
    "plaincoulomb 1e3 2.0 0.0 rolling 0.1 delayed spinning 0.1 delayed adhesion perko 1.0 vmin 0 0 0 limit_damping",
    f"{GOOD} tangential multistep NULL NULL 0.5 spring rolling 0.1",
    "limit_damping".join(["hooke 1e3 2.0 ", " spinning 0.1 tangential none"]),
    "hertz 1e3 2.0 tangential none rolling 0.0 spinning 0.0",
]


class LawErrors(SceneCase):

    def log_of(self, script, np, expect_error=True):
        with tempfile.TemporaryDirectory(dir=self.dir) as folder:
            return self.run_lammps(script, np=np, expect_error=expect_error, timeout=60, cwd=folder).log

    def assert_errors(self, cases, expected_start):
        """cases: (lines after the box, message, marked word); two processes at a time."""
        cases = list(cases)
        jobs = [(case, np) for n, case in enumerate(cases) for np in ranks_of_refusal(n)]
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            logs = list(pool.map(lambda job: self.log_of(f"{BOX}{job[0][0]}\n", job[1]), jobs))
        for ((lines, message, word), np), log in zip(jobs, logs):
            with self.subTest(lines=lines, ranks=np):
                error, = re.findall(r"^ERROR.*", log, re.MULTILINE)
                self.assertRegex(error, f"^ERROR: {expected_start}.*{message}")    # not "ERROR on proc"
                self.assertEqual(marked_word(log), word)
        print(f"\n{len(cases)} refusals, {len(jobs) - len(cases)} of them on 2 ranks, too")

    def test_pair_coeff(self):
        self.assert_errors(((f"pair_coeff * * {words}", message or f"unknown word '{word}', {KEYWORDS}", word)
                            for words, message, word in law_cases()), "pair_coeff gran/penalty: ")

    def test_contact_of_a_large_body(self):
        """The same parser: one case of each kind, and what is behind a contact."""
        cases = [case for n, case in enumerate(law_cases()) if n % 4 == 0 or case[1] is None]
        self.assert_errors(((f"{PAIR}{PLANE} contact {words}",
                             message or f"unknown word '{word}', expected contact, type, two-sided, move, servo, surface_velocity, gravity, load, temperature, "
                             "pressure, wear, vtk, or in a contact "
                             "tangential, damping, rolling, spinning, twisting, adhesion, heat, vmin or limit_damping", word)
                            for words, message, word in cases), "fix large/body")

    def test_under_pair_hybrid(self):
        self.assert_errors([
            ("pair_style hybrid/overlay gran/penalty\npair_coeff * * gran/penalty hooke 1e3", "missing gn", "1e3"),
            ("pair_style hybrid/overlay gran/penalty\npair_coeff * * gran/penalty hooke 1e3 -2.0",
             "expected gn .* instead of '-2.0'", "-2.0"),
            ("pair_style hybrid/overlay gran/penalty\npair_coeff * * gran/penalty hooke 1e3 2.0 foo",
             "unknown word 'foo'", "foo")], "pair_coeff gran/penalty: ")

    def test_others(self):
        self.assert_errors(OTHERS, "")

    def test_accepted(self):
        """Laws that are accepted see the contact of two spheres and those with the plane, and compute finite numbers."""
        for words in ACCEPTED:
            with self.subTest(words):
                log = self.run_lammps(f"{BOX}pair_coeff * * {words}\n{PLANE} contact {words}\n"
                                      "set atom 2 x -1.1\ndisplace_atoms all move 0 0 -3.55 units box\n"
                                      "fix step all nve/sphere/symplectic\n"
                                      "compute s all penalty/stats\ncompute t all timestep/gran\n"
                                      "thermo_style custom step c_s[2] c_s[4] c_t[1] ke\ntimestep 1e-6\nrun 2\n").log
                rows = thermo(log)
                self.assertEqual([row["Step"] for row in rows], [0, 2])
                self.assertEqual(rows[0]["c_s[2]"], 3)
                for row in rows:
                    self.assertTrue(all(map(math.isfinite, row.values())), row)


if __name__ == "__main__":
    unittest.main()
