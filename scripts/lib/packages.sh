# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# The Debian packages that building, running and testing need, and how to get them.

TALUS_PACKAGES=(
  g++ cmake ninja-build binutils                          # compiler and build
  libopenmpi-dev openmpi-bin libpng-dev zlib1g-dev        # what the host is built with
  libeigen3-dev libccd-dev                                # geometry of large bodies and of particles
  python3                                                 # progress display
  dpkg-dev debian-archive-keyring xz-utils ca-certificates  # source of the host
)

# What tests need besides, and benchmarks.
TALUS_TEST_PACKAGES=(python3-numpy libgtest-dev libgmock-dev libyaml-dev libbenchmark-dev ccache pkg-config)
TALUS_BENCHMARK_PACKAGES=(libbenchmark-dev)

# Programs that tests couple with Talus.
TALUS_PARTNER_PACKAGES=(libmujoco-dev python3-getfem)

# What the thread sanitizer needs besides: Clang, its sanitizers, and its OpenMP library.
TALUS_THREAD_SANITIZER_PACKAGES=(clang libclang-rt-dev libomp-dev)

# missing_packages PACKAGE...: each once, also where two lists have it.
missing_packages() {
  local package status
  for package in $(printf '%s\n' "$@" | awk '!seen[$0]++'); do
    status=$(dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null) || status=
    grep -qx installed <<<"$status" || printf '%s\n' "$package"
  done
}

# as_root COMMAND...: directly or through sudo, which may ask for a password only on a terminal.
as_root() {
  if [[ $(id -u) == 0 ]]; then
    "$@"
  elif [[ -t 0 ]]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" </dev/null
}

# The package lists of a machine may be missing or too old: refresh them only if so.
install_packages() {
  local log
  log=$(mktemp)
  note "installing Debian packages: $*"
  if apt_install "$@" >"$log" 2>&1; then
    rm -f "$log"
    return
  fi
  note "refreshing the package lists (apt-get update)"
  if as_root apt-get update </dev/null >>"$log" 2>&1 && apt_install "$@" >>"$log" 2>&1; then
    rm -f "$log"
    return
  fi
  tail -n 15 "$log" >&2
  rm -f "$log"
  die "apt could not install: $*. Check the network and apt's sources, or install them by hand"
}

# ensure_packages [PACKAGE...]: those of every build, and these.
# Systems without dpkg keep their own names for these things; CMake will name what it misses.
ensure_packages() {
  [[ -z ${TALUS_SKIP_PACKAGES:-} ]] || return 0
  have dpkg-query || return 0
  local missing
  if [[ -n ${TALUS_TESTS:-} ]]; then set -- "$@" "${TALUS_TEST_PACKAGES[@]}"; fi
  if [[ -n ${TALUS_BENCHMARKS:-} ]]; then set -- "$@" "${TALUS_BENCHMARK_PACKAGES[@]}"; fi
  mapfile -t missing < <(missing_packages "${TALUS_PACKAGES[@]}" "$@")
  ((${#missing[@]})) || return 0
  have apt-get || die "missing Debian packages: ${missing[*]}; there is no apt-get here, so install them by hand"
  [[ $(id -u) == 0 ]] || have sudo ||
    die "missing Debian packages: ${missing[*]}; as root run: apt-get install ${missing[*]}"
  install_packages "${missing[@]}"
}

# announce_packages PACKAGE...: what will be installed, in one line before any of it is, and before a build.
announce_packages() {
  [[ -z ${TALUS_SKIP_PACKAGES:-} ]] && have dpkg-query || return 0
  local missing
  mapfile -t missing < <(missing_packages "${TALUS_PACKAGES[@]}" "$@")
  ((${#missing[@]} == 0)) || note "installs the Debian packages ${missing[*]}; with TALUS_SKIP_PACKAGES=1 none"
}

# optional_packages CONSEQUENCE NAME...: install them if that is possible; otherwise say what follows.
optional_packages() {
  local consequence=$1 missing
  shift
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if [[ -z ${TALUS_SKIP_PACKAGES:-} ]] && have apt-get && (install_packages "${missing[@]}"); then return 0; fi
  note "without the packages ${missing[*]}, $consequence"
}
