// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What Talus has in restart files, with a digest of it: a file of which something is lost or another version wrote ends
// in one message, before any of it is used. LAMMPS hands neither sizes nor ends of what it has read; so the head of data
// tells their size twice.

#ifndef TALUS_SYSTEM_HOST_RESTART_DATA_H
#define TALUS_SYSTEM_HOST_RESTART_DATA_H

#include "lmptype.h"

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// Data of a style as a whole. `format`: of their layout, a number that grows; those of another one are refused.
/// Writing is for the first rank. `command`: for messages, "Fix large/body floor".

/// As a part of the file, for Pair::write_restart() and read_restart(); reading is collective and needs the file on the
/// first rank only.
void write_restart_data(FILE *file, int format, const void *data, std::size_t bytes);
std::string read_restart_data(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int format,
                              FILE *file);
/// For Fix::write_restart(), and what restart(buf) gets of it, whole words of eight bytes. Not more than LAMMPS counts: 2 GB.
void write_restart_data_of_fix(FILE *file, int format, const void *data, std::size_t bytes);
std::vector<double> restart_data_of_fix(LAMMPS_NS::LAMMPS *lmp, const std::string &command,
                                        int format, const char *buf);

/// Data of a particle, for Fix::pack_restart(): they begin behind a head of this many doubles, which is filled in when
/// they are complete, and are `size` together, which is returned.
constexpr int size_particle_head = 2;
int complete_particle_data(double *buf, int size);
/// For unpack_restart(): those of the local particle i, behind the head; nullptr if they are damaged, which
/// require_intact_particles() tells.
const double *particle_data(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int i, int nth);

/// The same in the format of a style of LAMMPS, which does not read what is behind its own data: there is the digest. To
/// be called with what it has written, of buf[0] doubles; returns one more.
constexpr int size_of_digest = 1;
int append_digest(double *buf);
/// Data with the digest, or of LAMMPS without one. stock_size(data): how many doubles LAMMPS would have written, -1 if
/// there is something that it writes never.
using StockSize = std::function<LAMMPS_NS::bigint(const double *)>;
const double *stock_particle_data(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int i,
                                  int nth, const StockSize &stock_size);

/// An error if a rank has found damaged data of particles. Collective, for init() of all that ask for such data: what one
/// rank says alone may be lost.
void require_intact_particles(LAMMPS_NS::LAMMPS *lmp);

}    // namespace Talus

#endif
