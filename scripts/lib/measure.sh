# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# What scripts/bench and scripts/validate have in common: the environment of bench/lib.

# measure FOLDER NAMES... -- WORDS...: runs the programs of that folder, one after the other.
measure() {
  local folder=$1 names=() candidate python=python3 name status=0
  shift
  while [[ $1 != -- ]]; do names+=("$1") && shift; done
  shift
  # Debian's packages belong to its own Python, which need not be the first in the path.
  for candidate in /usr/bin/python3 python3; do
    if "$candidate" -c 'import matplotlib' 2>/dev/null || "$candidate" -c 'import numpy' 2>/dev/null; then
      python=$candidate
      break
    fi
  done
  export TALUS_ROOT TALUS_BUILD PYTHONDONTWRITEBYTECODE=1
  TALUS_BENCH_HOST=$HOST_BINARY/lmp TALUS_BENCH_SOURCE=$HOST_SOURCE TALUS_BENCH_CACHE=$(cache_dir)/bench
  TALUS_CXX_VERSION=$("$(host_compiler)" --version | head -n 1)
  export TALUS_BENCH_HOST TALUS_BENCH_SOURCE TALUS_BENCH_CACHE TALUS_CXX_VERSION
  for name in "${names[@]}"; do    # wait: signals end this script at once, and ended.py sees it
    "$python" "$TALUS_ROOT/bench/lib/ended.py" "$python" "$TALUS_ROOT/bench/lib/main.py" "$folder" "$name" "$@" </dev/null &
    wait "$!" || status=$?
  done
  return "$status"
}
