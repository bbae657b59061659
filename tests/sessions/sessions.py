# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Random sessions of LAMMPS and relations that hold for them whatever they contain.

    python3 tests/sessions/sessions.py --endless                       until it is stopped
    python3 tests/sessions/sessions.py --count 200 --relation same_bits
    python3 tests/sessions/sessions.py --relation same_bits --seed 17     one case again

What fails is printed as the smallest input that does. The plugin is that of build/ (TALUS_BUILD_DIR: another one)."""

import argparse
import collections
import concurrent.futures
import itertools
import json
import os
import random
import signal
import subprocess
import sys
import time
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [HERE, os.path.join(ROOT, "tests", "lib")]


def take_environment():
    """That of the tests, where this is not one of them."""
    if "TALUS_LMP" in os.environ:
        return
    build = os.environ.get("TALUS_BUILD_DIR", os.path.join(ROOT, "build"))
    told = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", "-R", "^mpi/test_sessions$"], check=True,
                          capture_output=True, text=True).stdout
    test, = json.loads(told)["tests"]
    pairs, = [one["value"] for one in test["properties"] if one["name"] == "ENVIRONMENT"]
    os.environ.update(pair.split("=", 1) for pair in pairs)


take_environment()

import gradients
import like_stock
import robust
import same_bits
import surfaces
import symmetry
from known import known
from pool import CRASH, HANG, Pool
from shrink import shrink
from spelled import spelled

# cases of each in a round
SHARES = {same_bits: 4, robust: 4, like_stock: 2, surfaces: 3, gradients: 2, symmetry: 3}
RELATIONS = {relation.__name__: relation for relation in SHARES}
SHRINKING = 60.0    # seconds
SHORT = 10.0        # for one that is known to
PATIENCE = 180.0    # for a session that is taken to hang


class Judge:
    """Runs cases, and remembers how many."""

    def __init__(self, pool, shrinking=SHRINKING):
        self.pool, self.shrinking = pool, shrinking
        self.cases, self.known, self.faults = collections.Counter(), collections.Counter(), collections.Counter()
        self.begin = time.monotonic()

    def summary(self):
        return (f"{sum(self.cases.values())} cases {dict(self.cases)}, {sum(self.pool.kinds.values())} sessions of LAMMPS "
                f"{dict(self.pool.kinds)} in {time.monotonic() - self.begin:.0f} s; faults {dict(self.faults)}; known {dict(self.known)}")

    def sure(self, session):
        """What crashes or hangs has to do so in a process of its own."""
        found = self.pool.run(session)
        if found.kind in (CRASH, HANG):
            found = self.pool.run(session, fresh=True, limit=PATIENCE)
        return found

    def soon(self, session):
        """Where a hang was found, one that is made smaller does not get as long."""
        return self.pool.run(session, limit=SHORT)

    def judge(self, name, seed):
        """Empty, or the text of a fault."""
        relation = RELATIONS[name]
        self.cases[name] += 1
        case = relation.draw(random.Random(f"{name} {seed}"))
        try:
            fault, sessions = relation.check(self.sure, *case)
        except Exception:
            self.faults[name] += 1
            return f"{name} {seed}: the test itself failed\n{traceback.format_exc()}"
        if not fault:
            return ""
        reason = known(name, fault, sessions)
        if reason:
            self.known[reason] += 1
            return ""
        self.faults[name] += 1
        again = self.soon if fault.startswith(HANG) else self.pool.run
        case, _ = shrink(relation, again, case, fault, self.shrinking)
        at_last, small = relation.check(again, *case)
        said = at_last or "once and not again: " + fault
        return f"== {name} {seed}: {said}\n\n" + "\n".join(spelled(session) for session in (small if at_last else sessions))


def rounds(first, names=None):
    """(relation, seed), for ever."""
    for n in itertools.count(first):
        for relation, share in SHARES.items():
            if not names or relation.__name__ in names:
                for k in range(share):
                    yield relation.__name__, n * share + k


def judge_many(cases, jobs, judge, told):
    """Faults of all, each told as soon as it is found."""
    faults = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as threads:
        waiting = set()
        for case in itertools.chain(cases, [None]):
            while waiting and (case is None or len(waiting) >= 2 * jobs):
                done, waiting = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
                for fault in filter(None, (future.result() for future in done)):
                    faults.append(fault)
                    told(fault)
            if case is not None:
                waiting.add(threads.submit(judge.judge, *case))
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--endless", action="store_true", help="until it is stopped")
    parser.add_argument("--count", type=int, default=100, help="how many cases")
    parser.add_argument("--first", type=int, default=0, help="round to begin with")
    parser.add_argument("--relation", action="append", choices=RELATIONS, help="only this one; may be repeated")
    parser.add_argument("--seed", type=int, help="only this case of the relation")
    parser.add_argument("--jobs", type=int, default=1, help="how many at a time")
    parser.add_argument("--shrink", type=float, default=SHRINKING, help="seconds for making a fault smaller")
    words = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended from outside"))    # and with it the processes of the pool
    with Pool() as pool:
        judge = Judge(pool, words.shrink)
        if words.seed is not None:
            cases = [(name, words.seed) for name in words.relation or RELATIONS]
        else:
            cases = rounds(words.first, words.relation)
            cases = told_now_and_then(cases if words.endless else itertools.islice(cases, words.count), judge)
        try:
            judge_many(cases, words.jobs, judge, lambda fault: print(fault, flush=True))
        except KeyboardInterrupt:
            pass
        print(judge.summary())
    return 1 if judge.faults else 0


def told_now_and_then(cases, judge, seconds=300):
    """The same, and every few minutes how many it has been."""
    last = time.monotonic()
    for case in cases:
        if time.monotonic() > last + seconds:
            last = time.monotonic()
            print(judge.summary(), flush=True)
        yield case


if __name__ == "__main__":
    sys.exit(main())
