/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

// What travels with particles: orientations and what contact points remember.

#include "fix/fix_shape_gran.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr double restart_version = 2.0;    // 1 lacks the number of particles

}    // namespace

void FixShapeGran::grow_arrays(int nmax)
{
  memory->grow(quat, nmax, 4, "shape/gran:quat");
  array_atom = quat;
  memories.grow(nmax);
}

void FixShapeGran::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy(quat[i], quat[i] + 4, quat[j]);
  memories.copy(i, j);
}

/* Radius and mass at once, so that others are put at the right distance. */

void FixShapeGran::set_arrays(int i)
{
  std::fill(quat[i], quat[i] + 4, 0.0);
  memories.clear(i);
  set_sizes(i, i + 1);
}

int FixShapeGran::pack_border(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++) std::copy(quat[list[k]], quat[list[k]] + 4, buf + 4L * k);
  return 4 * n;
}

int FixShapeGran::unpack_border(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) std::copy(buf + 4L * k, buf + 4L * k + 4, quat[first + k]);
  return 4 * n;
}

/* Sizes first, one number of each particle. Then what is there, in pieces: a message of the host has
   room for block_size doubles of each particle, and is shorter where there is less. */

void FixShapeGran::send_memories_to_ghosts()
{
  const int nall = atom->nlocal + atom->nghost;
  sizes.assign(nall, 0);
  int mine = 0, longest = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!memories.of(i).empty()) sizes[i] = memories.packed_size(i);
    mine = std::max(mine, sizes[i]);
  }
  MPI_Allreduce(&mine, &longest, 1, MPI_INT, MPI_MAX, world);
  for (int i = atom->nlocal; i < nall; i++) memories.clear(i);
  if (longest == 0) return;    // nothing is remembered
  message = Message::SIZES;
  comm->forward_comm(this, 1);
  lists.resize(nall);
  for (int i = 0; i < nall; i++) lists[i].resize(sizes[i]);
  for (int i = 0; i < atom->nlocal; i++)
    if (sizes[i]) memories.pack(i, lists[i].data());
  message = Message::MEMORIES;
  for (sent = 0; sent < longest; sent += block_size) comm->forward_comm(this, block_size);
  message = Message::ORIENTATIONS;
  for (int i = atom->nlocal; i < nall; i++)
    if (sizes[i]) memories.unpack(i, lists[i].data());
  lists = {};
  sizes = {};
}

/* Of a list, the doubles in the present piece. */

int FixShapeGran::size_of_piece(int i) const
{
  return std::clamp(sizes[i] - sent, 0, block_size);
}

int FixShapeGran::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  if (message == Message::ORIENTATIONS) return pack_border(n, list, buf);
  double *next = buf;
  for (int k = 0; k < n; k++)
    if (message == Message::SIZES)
      *next++ = sizes[list[k]];
    else if (const int size = size_of_piece(list[k]))
      next = std::copy_n(&lists[list[k]][sent], size, next);
  return static_cast<int>(next - buf);
}

void FixShapeGran::unpack_forward_comm(int n, int first, double *buf)
{
  if (message == Message::ORIENTATIONS) {
    unpack_border(n, first, buf);
    return;
  }
  for (int i = first; i < first + n; i++)
    if (message == Message::SIZES) {
      sizes[i] = static_cast<int>(*buf++);
    } else if (const int size = size_of_piece(i)) {
      std::copy_n(buf, size, &lists[i][sent]);
      buf += size;
    }
}

int FixShapeGran::pack_exchange(int i, double *buf)
{
  std::copy(quat[i], quat[i] + 4, buf);
  return 4 + memories.pack(i, buf + 4);
}

int FixShapeGran::unpack_exchange(int i, double *buf)
{
  std::copy(buf, buf + 4, quat[i]);
  return 4 + memories.unpack(i, buf + 4);
}

/* Restart files hold a version and the number of particles; of each particle the number of doubles,
   and what it carries. The host does not move what it has read for us when particles are deleted or
   added before this fix is defined: their number tells. */

void FixShapeGran::write_restart(FILE *fp)
{
  keep_memories();    // on all ranks, before particles are packed
  if (comm->me) return;
  const double head[] = {restart_version, static_cast<double>(atom->natoms)};
  const int size = sizeof head;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(head, size, 1, fp);
}

void FixShapeGran::restart(char *buf)
{
  double head[2];
  std::memcpy(head, buf, sizeof head[0]);
  if (head[0] != restart_version)
    error->all(FLERR,
               "Fix shape/gran {}: the restart file was written by another version of Talus: go on "
               "with that version",
               id);
  std::memcpy(head, buf, sizeof head);
  if (head[1] != static_cast<double>(atom->natoms))
    error->all(FLERR,
               "Fix shape/gran {}: particles were added or deleted between read_restart and this "
               "command, so that orientations cannot be assigned: define the fix right after "
               "read_restart",
               id);
}

int FixShapeGran::pack_restart(int i, double *buf)
{
  buf[0] = 1 + pack_exchange(i, buf + 1);
  return static_cast<int>(buf[0]);
}

void FixShapeGran::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  std::copy(extra + m + 1, extra + m + 5, quat[i]);
  memories.unpack(i, extra + m + 5);
}

int FixShapeGran::size_restart(int i)
{
  return 1 + 4 + memories.packed_size(i);
}

int FixShapeGran::maxsize_restart()
{
  int mine = 1 + 4 + 1 + PointMemory::size * memories.longest(atom->nlocal), most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}

double FixShapeGran::memory_usage()
{
  double bytes = 4.0 * sizeof(double) * atom->nmax + memories.memory_usage() +
                 pairs.memory_usage() + table.memory_usage();
  for (const auto &[body, its] : walls)
    if (its.points) bytes += its.points->memory_usage();
  return bytes;
}
