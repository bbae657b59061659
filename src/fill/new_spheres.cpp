// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fill/new_spheres.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int row_size = 5;    // ID, place, radius

/// A part of the sphere, or of one of its images, is between lo and hi.
bool reaches(const Domain *domain, double x, double radius, int d, double lo, double hi)
{
  const int images = domain->periodicity[d] ? 1 : 0;
  for (int k = -images; k <= images; k++) {
    const double at = x + k * domain->prd[d];
    if (at + radius > lo && at - radius < hi) return true;
  }
  return false;
}

std::vector<double> gather(MPI_Comm world, const std::vector<double> &mine)
{
  int size;
  MPI_Comm_size(world, &size);
  int count = static_cast<int>(mine.size());
  std::vector<int> counts(size), first(size, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int r = 1; r < size; r++) first[r] = first[r - 1] + counts[r - 1];
  std::vector<double> all(first[size - 1] + counts[size - 1]);
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), first.data(),
                 MPI_DOUBLE, world);
  return all;
}

void require_made(LAMMPS *lmp, bigint mine, bigint wanted)
{
  bigint made = 0;
  MPI_Allreduce(&mine, &made, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (made != wanted)
    lmp->error->all(FLERR, "{} of {} spheres were not made: their places belong to no rank",
                    wanted - made, wanted);
}

}    // namespace

std::vector<KnownSphere> LAMMPS_NS::spheres_in_box(LAMMPS *lmp, const Vector3<double> &lo,
                                                   const Vector3<double> &hi)
{
  const Atom *atom = lmp->atom;
  const double low[3] = {lo.x, lo.y, lo.z}, high[3] = {hi.x, hi.y, hi.z};
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *x = atom->x[i], r = atom->radius[i];
    bool near = true;
    for (int d = 0; d < 3; d++) near = near && reaches(lmp->domain, x[d], r, d, low[d], high[d]);
    if (near) mine.insert(mine.end(), {static_cast<double>(atom->tag[i]), x[0], x[1], x[2], r});
  }
  const std::vector<double> all = gather(lmp->world, mine);
  std::vector<int> order(all.size() / row_size);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&all](int a, int b) { return all[row_size * a] < all[row_size * b]; });
  std::vector<KnownSphere> found;
  for (const int k : order) {
    const double *row = &all[row_size * k];
    found.push_back({{row[1], row[2], row[3]}, row[4]});
  }
  return found;
}

int LAMMPS_NS::create_spheres(LAMMPS *lmp, const std::vector<KnownSphere> &spheres, int type,
                              double density)
{
  constexpr double four_thirds_pi = 4.18879020478639098462;
  Atom *atom = lmp->atom;
  const Domain *domain = lmp->domain;
  atom->nghost = 0;
  atom->avec->clear_bonus();
  tagint mine = 0, last = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, atom->tag[i]);
  MPI_Allreduce(&mine, &last, 1, MPI_LMP_TAGINT, MPI_MAX, lmp->world);
  if (static_cast<double>(last) + static_cast<double>(spheres.size()) > MAXTAGINT)
    lmp->error->all(FLERR, "New atom IDs exceed maximum allowed ID {}", MAXTAGINT);

  const int first = atom->nlocal;
  for (const KnownSphere &sphere : spheres) {
    last++;
    double x[3] = {sphere.x.x, sphere.x.y, sphere.x.z};
    bool here = true;
    for (int d = 0; d < 3; d++) here = here && x[d] >= domain->sublo[d] && x[d] < domain->subhi[d];
    if (!here) continue;
    const int i = atom->nlocal;
    atom->avec->create_atom(type, x);
    atom->tag[i] = last;
    atom->radius[i] = sphere.radius;
    atom->rmass[i] = density * (four_thirds_pi * sphere.radius * sphere.radius * sphere.radius);
  }
  atom->data_fix_compute_variable(first, atom->nlocal);
  require_made(lmp, atom->nlocal - first, static_cast<bigint>(spheres.size()));
  // particles that were lost before are not ours to report: LAMMPS compares with this number
  atom->natoms += static_cast<bigint>(spheres.size());
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
  return first;
}
