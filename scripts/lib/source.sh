# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# Source of the host from Debian, through apt with a state of its own: apt checks the signature of
# the index against the Debian archive keyring, and the hash of the file against the index. The
# mirror is the one this machine uses already, with the suite exchanged.

TALUS_OWN_SOURCE="point LAMMPS_SOURCE_DIR at an unpacked source tree of LAMMPS 4 Feb 2025 or newer"

debian_keyring() {
  local file
  for file in /usr/share/keyrings/debian-archive-keyring.{gpg,pgp}; do
    [[ -r $file ]] && printf '%s\n' "$file" && return
  done
  die "no Debian archive keyring; install the package debian-archive-keyring"
}

# apt itself knows every form its sources can have. Suites of other archives (security, updates,
# third parties) hold no LAMMPS.
debian_mirrors() {
  local codename
  # shellcheck disable=SC1091
  codename=$(. /etc/os-release && printf '%s' "${VERSION_CODENAME:-}")
  # shellcheck disable=SC2016  # apt's own variables
  apt-get indextargets --no-release-info --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' |
    awk -v own="$codename" '$3 == "main" &&
      ($2 == own || $2 ~ /^(oldstable|stable|testing|unstable|sid|bookworm|trixie|forky)$/) &&
      !seen[$1]++ { print $1 }'
}

# private_apt DIR COMMAND...: run an apt command on the state in DIR.
private_apt() {
  local dir=$1
  shift
  APT_CONFIG=$dir/apt.conf LC_ALL=C "$@" </dev/null
}

# The cache of a user cannot be read by apt's own unprivileged user, hence no change of user.
write_private_apt() {
  local dir=$1 mirror=$2 suite=$3 keyring
  keyring=$(debian_keyring) || exit 1
  mkdir -p "$dir/lists/partial" "$dir/cache/archives/partial"
  printf 'deb-src [signed-by=%s] %s %s main\n' "$keyring" "$mirror" "$suite" >"$dir/sources.list"
  cat >"$dir/apt.conf" <<CONF
Dir::Etc::sourcelist "$dir/sources.list";
Dir::Etc::sourceparts "-";
Dir::State::Lists "$dir/lists";
Dir::Cache "$dir/cache";
APT::Sandbox::User "$(id -un)";
APT::Update::Error-Mode "any";
Acquire::Languages "none";
Acquire::Retries "3";
CONF
}

# Leave DIR with the index of SUITE, from the first mirror that has it.
open_suite() {
  local dir=$1 suite=$2 log=$3 mirror mirrors
  mapfile -t mirrors < <(debian_mirrors)
  ((${#mirrors[@]})) || die "apt on this machine has no Debian mirror; $TALUS_OWN_SOURCE"
  for mirror in "${mirrors[@]}"; do
    write_private_apt "$dir" "$mirror" "$suite"
    private_apt "$dir" apt-get update >>"$log" 2>&1 && return
  done
  grep '^E:' "$log" | sort -u | head -n 3 >&2 || true
  die "no index of Debian '$suite' from this machine's mirror: check the network and proxy, or $TALUS_OWN_SOURCE"
}

# The revision after the dash changes with Debian's packaging, the source does not.
debian_revision() {
  local dir=$1 upstream=$2
  private_apt "$dir" apt-cache showsrc --only-source lammps 2>/dev/null |
    awk -v wanted="$upstream-" '$1 == "Version:" && index($2, wanted) == 1 { print $2; exit }'
}

# newest_revision DIR: of any release in the suite.
newest_revision() {
  private_apt "$1" apt-cache showsrc --only-source lammps 2>/dev/null | awk '$1 == "Version:" { print $2 }' | sort -V | tail -n 1
}

# download_source UPSTREAM SUITE DIR: put the original tarball into DIR. A suite that has moved on has another release,
# which is taken, and named in the file "newer" beside DIR.
download_source() {
  local upstream=$1 suite=$2 dir=$3 version
  have apt-get || die "no apt-get here to get LAMMPS with; $TALUS_OWN_SOURCE"
  mkdir -p "$dir"
  open_suite "$dir/apt" "$suite" "$dir/log"
  version=$(debian_revision "$dir/apt" "$upstream")
  if [[ -z $version ]]; then
    version=$(newest_revision "$dir/apt")
    [[ -n $version ]] || die "Debian '$suite' has no source of lammps; $TALUS_OWN_SOURCE"
    note "Debian '$suite' has lammps $version in the place of $upstream: taking that, which Talus has not been tried with"
    printf '%s\n' "$version" >"$(dirname "$dir")/newer"
  fi
  note "downloading the source of lammps $version (130 to 210 MB)"
  if ! (cd "$dir" && private_apt "$dir/apt" apt-get source --tar-only --download-only "lammps=$version") >>"$dir/log" 2>&1; then
    tail -n 5 "$dir/log" >&2
    die "the source of lammps $version could not be downloaded: check the network and proxy, or $TALUS_OWN_SOURCE"
  fi
}

# What a build, its tests and the benchmarks need of the tree.
TALUS_SOURCE_PARTS=(LICENSE README bench cmake lib python src third_party unittest)

# Input scripts for grains that users of LAMMPS know, with the files they read.
TALUS_INPUT_PARTS=(examples/bpm/pour examples/granregion examples/granular examples/pour)

# unpack_parts TARBALL DIR PART...: some tarballs have a top folder, some have not.
unpack_parts() {
  local tarball=$1 dir=$2 first prefix='' strip=0
  shift 2
  first=$(tar -tf "$tarball" 2>/dev/null | sed -n '1{p;q;}' || true)
  if [[ $first == lammps*/* ]]; then
    prefix=${first%%/*}/
    strip=1
  fi
  mkdir -p "$dir"
  # third_party is not in every version, examples not in every tarball: a name that is missing is no
  # error, a bad file is one.
  tar -xf "$tarball" -C "$dir" --no-same-owner --strip-components="$strip" "${@/#/$prefix}" 2>"$dir.log" ||
    ! grep -v -e 'third_party: Not found' -e 'examples/[a-z/]*: Not found' -e 'Exiting with failure' "$dir.log" >&2 ||
    die "cannot unpack $tarball (disk full?): free some space and run the command again"
  rm -f "$dir.log"
}

# unpack_source TARBALL DIR
unpack_source() {
  unpack_parts "$1" "$2" "${TALUS_SOURCE_PARTS[@]}" "${TALUS_INPUT_PARTS[@]}"
  [[ -f $2/src/version.h ]] || die "no LAMMPS source in $1; remove $(dirname "$1") and run the command again"
}

has_inputs() {
  local part
  for part in "${TALUS_INPUT_PARTS[@]}"; do [[ -d $1/$part ]] || return 1; done
}

# download_inputs UPSTREAM SUITE SOURCE: put the inputs into a tree that has been unpacked without them.
download_inputs() {
  local upstream=$1 suite=$2 source=$3 part new=$3.inputs
  ! has_inputs "$source" || return 0
  rm -rf "$new"
  mkdir -p "$new"
  download_source "$upstream" "$suite" "$new/download"
  unpack_parts "$(ls "$new"/download/lammps_*.orig.tar.*)" "$new/tree" "${TALUS_INPUT_PARTS[@]}"
  has_inputs "$new/tree" || die "no input scripts in the source of LAMMPS $upstream"
  for part in "${TALUS_INPUT_PARTS[@]}"; do
    rm -rf "${source:?}/$part"
    mkdir -p "$(dirname "$source/$part")"
    mv "$new/tree/$part" "$source/$part"
  done
  rm -rf "$new"
}
