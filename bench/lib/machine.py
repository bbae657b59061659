# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Where things are and what they run on.  The environment comes from scripts/bench."""

import os
import re
import shutil
import subprocess
import time


def _required(name):
    value = os.environ.get(name)
    if not value:
        raise SystemExit(f"{name} is not set: run benchmarks through scripts/bench")
    return value


ROOT = _required("TALUS_ROOT")
BUILD = _required("TALUS_BUILD")
TALUS_LMP = os.path.join(BUILD, "lmp")    # the host with the plugin loaded
STOCK_LMP = _required("TALUS_BENCH_HOST")                    # the same host without it
BODY_LMP = os.environ.get("TALUS_BENCH_BODY_HOST", "")       # a host with package BODY, or none
ASPHERE_LMP = os.environ.get("TALUS_BENCH_ASPHERE_HOST", "")    # a newer one with package ASPHERE, or none
HOST_SOURCE = os.environ.get("TALUS_BENCH_SOURCE", "")
CACHE = _required("TALUS_BENCH_CACHE")
LIGGGHTS = shutil.which("liggghts")


def cores():
    """Numbers of the cores that this process may use."""
    return sorted(os.sched_getaffinity(0))


def load():
    return os.getloadavg()[0]


def _output(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""


def describe_cpu():
    with open("/proc/cpuinfo") as file:
        text = file.read()
    model = re.search(r"model name\s*: (.*)", text)
    vector = next((name for name in ("avx512f", "avx2", "sse4_2", "asimd") if re.search(rf"\b{name}\b", text)), "")
    return f"{model.group(1) if model else os.uname().machine}, {len(cores())} cores, {vector}"


def describe_memory():
    with open("/proc/meminfo") as file:
        kilobytes = int(re.search(r"MemTotal:\s*(\d+)", file.read()).group(1))
    caches = re.findall(r"^(L[23]) cache:\s*(.*)$", _output("lscpu"), re.MULTILINE)
    return ", ".join([f"{kilobytes / 2**20:.0f} GiB"] + [f"{name} {size.strip()}" for name, size in caches])


def lammps_version():
    match = re.search(r"Simulator - (.*)", _output(STOCK_LMP, "-help"))
    return match.group(1).strip() if match else "?"


def liggghts_version():
    if not LIGGGHTS:
        return "not installed"
    version = _output("dpkg-query", "-W", "-f", "${Version}", "liggghts")
    return version.strip() or "?"


SOURCES = ("src", "cmake", "CMakeLists.txt")


def commit():
    """The commit that sources are of, which is the last that changed them, with a mark if they differ from it."""
    sha = _output("git", "-C", ROOT, "log", "-1", "--format=%h", "--", *SOURCES).strip()
    if not sha:
        return "no git"
    changed = _output("git", "-C", ROOT, "status", "--porcelain", "--", *SOURCES).strip()
    return sha + (" with changes" if changed else "")


def stamp():
    """Lines about machine and versions, for a section of the report."""
    return [
        f"{time.strftime('%Y-%m-%d')}, Talus {commit()}, LAMMPS {lammps_version()}, "
        f"LIGGGHTS {liggghts_version()}",
        f"{describe_cpu()}, {describe_memory()}",
        f"{os.environ.get('TALUS_CXX_VERSION', '')}, -march={os.environ.get('TALUS_ARCH', 'native')} "
        "for LAMMPS and Talus; LIGGGHTS as Debian builds it",
    ]
