# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# Everything the scripts share.
# shellcheck source=common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
# shellcheck source=packages.sh
. "$TALUS_LIB/packages.sh"
# shellcheck source=source.sh
. "$TALUS_LIB/source.sh"
# shellcheck source=host.sh
. "$TALUS_LIB/host.sh"
# shellcheck source=plugin.sh
. "$TALUS_LIB/plugin.sh"
# shellcheck source=compilers.sh
. "$TALUS_LIB/compilers.sh"
# shellcheck source=measure.sh
. "$TALUS_LIB/measure.sh"
# shellcheck source=systems.sh
. "$TALUS_LIB/systems.sh"
