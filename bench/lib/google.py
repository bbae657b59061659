# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Programs of this folder that are made with Google Benchmark."""

import json
import os
import subprocess

import lammps
import machine
import paired

LEFT_OUT = "Left out: Google Benchmark was not found when Talus was built (Debian: libbenchmark-dev)."


def run(bench, name, seconds):
    """{(function, spheres): results, one for each round}; all functions in every round, in random order, each for at
    least these seconds of what it times. None without the program."""
    program = os.path.join(machine.BUILD, "bench", name)
    if not os.path.exists(program):
        return None
    out = bench.path(name + ".json")
    command = ["taskset", "-c", str(paired.one_core()[0]), program, f"--benchmark_out={out}", "--benchmark_out_format=json",
               f"--benchmark_min_time={seconds}", f"--benchmark_repetitions={bench.rounds}",
               "--benchmark_enable_random_interleaving=true"]
    if bench.quick:
        command.append("--benchmark_filter=/(3000|50000)(/|$)")
    # the parts of several threads one after the other: their work is asked for, not what the machine makes of it
    done = subprocess.run(command, env=dict(os.environ, OMP_THREAD_LIMIT="1"), capture_output=True, text=True, check=False)
    if done.returncode:
        raise lammps.Failed(f"{program}: {done.stderr[-1500:]}")
    found = {}
    with open(out) as file:
        for result in json.load(file)["benchmarks"]:
            if result["run_type"] == "iteration":
                function, size = result["run_name"].removesuffix("/manual_time").rsplit("/", 1)
                found.setdefault((function, int(size)), []).append(result)
    return found
