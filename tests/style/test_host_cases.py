#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 label=dem
"""The cases of LAMMPS' own unittest/granular, with the suffix: trajectories that the host's files hold, for newton on and off.

Only for hosts that have them, from 4 Jul 2026 on. Differences are relative to the largest vector of their kind in the
file, those of velocities also to that of the surfaces: a sphere that turns on a floor has velocities of 1e-14, of which no two builds of LAMMPS have the same digits."""

import glob
import os
import re
import unittest

from talus_testing import SceneCase, read_dump

DIRECTORY = os.path.join(os.environ.get("TALUS_LAMMPS_SOURCE", ""), "unittest", "granular", "tests")
KINDS = {"run_pos": "x y z", "run_vel": "vx vy vz", "run_torque": "tqx tqy tqz", "run_omega": "omegax omegay omegaz"}
TOLERANCE = 1e-10
OF_CLUMPS = 1e-4    # their spheres touch each other, if rounding says so: fix rigid/small of another host is 1e-5 off


def read_case(path):
    """Keys and their texts; lines of a block without their indentation."""
    with open(path) as file:
        text = file.read()
    keys = re.findall(r"^([a-z_]+):[ \t]*(?:! \|[-0-9]*)?(.*(?:\n[ ].*)*)", text, re.MULTILINE)
    return {key: "\n".join(line.strip() for line in words.strip().splitlines()) for key, words in keys}


def script(case, newton):
    lines = [f"newton {newton}", f"variable input_dir index {DIRECTORY}"]
    lines += [f"variable {line.split()[0]} index {line.split(maxsplit=1)[1]}" for line in case["variables"].splitlines()]
    lines += [case["pre_commands"], f"pair_style {case['pair_style']}"]
    lines += [f"pair_coeff {line}" for line in case["pair_coeff"].splitlines()]
    lines += [case["post_commands"], "thermo_modify lost ignore", "run 0 post no"]
    write = "write_dump all custom {} id " + " ".join(KINDS.values()) + " modify format float %.17g"
    for n, steps in enumerate(case["run_segments"].split()):
        lines += [f"run {steps} post no", write.format(f"end{n}")]
    return "\n".join(lines) + "\n"


class HostCases(SceneCase):

    def check(self, case):
        """Largest difference from the file."""
        frames = [read_dump(self.path(f"end{n}"))[-1] for n in range(len(case["run_segments"].split()))]
        expected, scales = {}, {}
        for kind in KINDS:
            rows = [line.split() for line in case[kind].splitlines()]
            expected[kind] = [(int(row[0]), int(row[1]), [float(v) for v in row[2:5]]) for row in rows]
            scales[kind] = max([1e-300] + [sum(v * v for v in vector)**0.5 for _, _, vector in expected[kind]])
        diameter = min(float(d) for d in re.findall(r"^diam\w* (\S+)", case["variables"], re.MULTILINE) or [1.0])
        scales["run_vel"] = max(scales["run_vel"], 0.5 * diameter * scales["run_omega"])
        worst = 0.0
        for kind, columns in KINDS.items():
            scale = scales[kind]
            for segment, tag, vector in expected[kind]:
                found = [frames[segment].column(c)[tag] for c in columns.split()]
                worst = max(worst, sum((a - b)**2 for a, b in zip(found, vector))**0.5 / scale)
        self.assertLess(worst, OF_CLUMPS if "fix rigid" in case["prerequisites"] else TOLERANCE)
        return worst

    def test_trajectories(self):
        left_out, found = [], {}
        for path in sorted(glob.glob(os.path.join(DIRECTORY, "*.yaml"))):
            name, case = os.path.basename(path), read_case(path)
            needed = case["prerequisites"]
            if "atom sphere" not in needed or "pair gran" not in needed or \
                    not {"run_vel", "run_omega", "post_commands"} <= set(case):
                left_out.append(name)
                continue
            for newton in "on", "off":
                with self.subTest(case=name, newton=newton):
                    log = self.run_lammps(script(case, newton), arguments=["-sf", "talus"]).log
                    self.assertRegex(log, rf"pair {case['pair_style'].split()[0]} +accelerated")
                    if "fix rigid" in needed:
                        self.assertRegex(log, r"rigid/small +accelerated")
                    if "wall/gran" in case["post_commands"]:
                        self.assertRegex(log, r"wall/gran(/region)? +accelerated")
                    found[name] = max(found.get(name, 0.0), self.check(case))
        print(f"\n{len(found)} files, largest difference {max(found.values()):.1e} "
              f"({max(found, key=found.get)}); not for these styles or without a trajectory that can be compared: {', '.join(left_out)}")
        self.assertGreater(len(found), 35)
        self.assertLess(len(left_out), 8)


if __name__ == "__main__":
    unittest.main()
