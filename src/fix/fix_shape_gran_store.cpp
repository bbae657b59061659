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

constexpr double restart_version = 1.0;

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

/* Lists of memories go to ghosts in pieces of the same size, for messages have a fixed one. */

void FixShapeGran::send_memories_to_ghosts()
{
  const int nall = atom->nlocal + atom->nghost;
  int mine = 0, longest = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, memories.packed_size(i));
  MPI_Allreduce(&mine, &longest, 1, MPI_INT, MPI_MAX, world);
  for (int i = atom->nlocal; i < nall; i++) memories.clear(i);
  if (longest == 1) return;    // nothing is remembered
  pieces = (longest + block_size - 1) / block_size;
  lists.assign(nall, {});
  for (int i = 0; i < atom->nlocal; i++) {
    lists[i].assign(static_cast<std::size_t>(pieces) * block_size, 0.0);
    memories.pack(i, lists[i].data());
  }
  for (int i = atom->nlocal; i < nall; i++)
    lists[i].assign(static_cast<std::size_t>(pieces) * block_size, 0.0);
  message = Message::MEMORIES;
  for (piece = 0; piece < pieces; piece++) comm->forward_comm(this, block_size);
  message = Message::ORIENTATIONS;
  for (int i = atom->nlocal; i < nall; i++) memories.unpack(i, lists[i].data());
  lists = {};
}

int FixShapeGran::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  if (message == Message::ORIENTATIONS) return pack_border(n, list, buf);
  for (int k = 0; k < n; k++)
    std::copy_n(&lists[list[k]][static_cast<std::size_t>(piece) * block_size], block_size,
                buf + static_cast<long>(block_size) * k);
  return block_size * n;
}

void FixShapeGran::unpack_forward_comm(int n, int first, double *buf)
{
  if (message == Message::ORIENTATIONS) {
    unpack_border(n, first, buf);
    return;
  }
  for (int k = 0; k < n; k++)
    std::copy_n(buf + static_cast<long>(block_size) * k, block_size,
                &lists[first + k][static_cast<std::size_t>(piece) * block_size]);
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

/* Restart files hold a version; of each particle the number of doubles, and what it carries. */

void FixShapeGran::write_restart(FILE *fp)
{
  keep_memories();    // on all ranks, before particles are packed
  if (comm->me) return;
  const int size = sizeof restart_version;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&restart_version, size, 1, fp);
}

void FixShapeGran::restart(char *buf)
{
  double version;
  std::memcpy(&version, buf, sizeof version);
  if (version != restart_version)
    error->all(FLERR,
               "Fix shape/gran {}: the restart file was written by another version of Talus: go on "
               "with that version",
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
  for (const auto &[body, its] : walls) bytes += its.points->memory_usage();
  return bytes;
}
