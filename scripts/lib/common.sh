# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# Shared by all scripts: messages, places, and the environment that MPI needs.

TALUS_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
TALUS_LIB=$TALUS_ROOT/scripts/lib

note() { printf 'talus: %s\n' "$*" >&2; }

# One message that ends with the cure.
die() {
  note "$*"
  exit 1
}

have() { command -v "$1" >/dev/null 2>&1; }

# nproc answers with OMP_NUM_THREADS where that is set, which is not the question here.
number_of_cores() { env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc; }

# The tilde works where HOME is not set, as in some containers.
cache_dir() {
  local home=~
  printf '%s/talus' "${XDG_CACHE_HOME:-$home/.cache}"
}

# Show the usage text of a script: its comment block after the first line.
usage() {
  sed -n '2,/^[^#]/{/^#/!d;s/^# \{0,1\}//;p;}' "$0"
}

# with_lock FILE COMMAND...: one at a time; says so when it has to wait.
with_lock() {
  local file=$1
  shift
  mkdir -p "$(dirname "$file")" || die "cannot write $(dirname "$file"); set XDG_CACHE_HOME to a place that can be written"
  (
    if ! flock -n 9; then
      note "waiting for another build (lock $file)"
      flock 9
    fi
    "$@"
  ) 9>"$file"
}

is_open_mpi() { [[ $(mpirun --version 2>&1) == *Open*MPI* || $(mpirun --version 2>&1) == *OpenRTE* ]]; }

# Containers and CI run as root and often with fewer cores than ranks; Open MPI 4 and 5 both
# refuse that unless told.
allow_any_mpirun() {
  export OMPI_MCA_rmaps_base_oversubscribe=1
  export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
  if [[ $(id -u) == 0 ]]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    export PRTE_ALLOW_RUN_AS_ROOT=1 PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1
  fi
}
