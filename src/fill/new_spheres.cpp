// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fill/new_spheres.h"

#include "exchange/large_messages.h"

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

constexpr std::size_t row_size = 5;    // ID, as its bits, place, radius

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

/// What is beyond a face that grows is of those who are there.
bool is_of_this_rank(const Domain &domain, int d, double x)
{
  const bool first = domain.boundary[d][0] >= 2 && domain.sublo[d] == domain.boxlo[d],
             last = domain.boundary[d][1] >= 2 && domain.subhi[d] == domain.boxhi[d];
  return (first || x >= domain.sublo[d]) && (last || x < domain.subhi[d]);
}

void require_made(LAMMPS *lmp, bigint mine, bigint wanted)
{
  bigint made = 0;
  MPI_Allreduce(&mine, &made, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (made != wanted)
    lmp->error->all(FLERR, "{} of {} spheres were not made: their places belong to no rank",
                    wanted - made, wanted);
}

/* Of fix property/atom, which leaves those of the particle or ghost that had this place before. */

void clear_properties(Atom &atom, int i)
{
  if (atom.molecule_flag) atom.molecule[i] = 0;
  if (atom.q_flag) atom.q[i] = 0.0;
  if (atom.temperature_flag) atom.temperature[i] = 0.0;
  if (atom.heatflow_flag) atom.heatflow[i] = 0.0;
  for (int k = 0; k < atom.nivector; k++)
    if (atom.ivname[k]) atom.ivector[k][i] = 0;
  for (int k = 0; k < atom.ndvector; k++)
    if (atom.dvname[k]) atom.dvector[k][i] = 0.0;
  for (int k = 0; k < atom.niarray; k++)
    if (atom.ianame[k]) std::fill_n(atom.iarray[k][i], atom.icols[k], 0);
  for (int k = 0; k < atom.ndarray; k++)
    if (atom.daname[k]) std::fill_n(atom.darray[k][i], atom.dcols[k], 0.0);
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
    if (near) mine.insert(mine.end(), {ubuf(atom->tag[i]).d, x[0], x[1], x[2], r});
  }
  const std::vector<double> all = gather(mine, MPI_DOUBLE, -1, lmp->world);
  std::vector<std::size_t> order(all.size() / row_size);
  std::iota(order.begin(), order.end(), 0);
  const auto tag = [&all](std::size_t k) { return ubuf(all[row_size * k]).i; };
  std::sort(order.begin(), order.end(),
            [&tag](std::size_t a, std::size_t b) { return tag(a) < tag(b); });
  std::vector<KnownSphere> found;
  for (const std::size_t k : order) {
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
    for (int d = 0; d < 3; d++) here = here && is_of_this_rank(*domain, d, x[d]);
    if (!here) continue;
    const int i = atom->nlocal;
    atom->avec->create_atom(type, x);
    atom->tag[i] = last;
    atom->radius[i] = sphere.radius;
    atom->rmass[i] = density * (four_thirds_pi * sphere.radius * sphere.radius * sphere.radius);
    clear_properties(*atom, i);
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

/* Sub-domains are shares of the box, so that those of all ranks move when it grows; and in a run particles go to the next
   ranks only. */

bool LAMMPS_NS::box_grows_too_fast(LAMMPS *lmp)
{
  const Atom *atom = lmp->atom;
  const Domain *domain = lmp->domain;
  const Comm *comm = lmp->comm;
  if (domain->nonperiodic != 2 || comm->layout == Comm::LAYOUT_TILED) return false;
  double ends[6];    // with a minus, the lower ones
  for (int d = 0; d < 3; d++) {
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int i = 0; i < atom->nlocal; i++) {
      lo = std::min(lo, atom->x[i][d]);
      hi = std::max(hi, atom->x[i][d]);
    }
    ends[d] = domain->boundary[d][0] >= 2 ? -lo : -domain->boxlo[d];
    ends[d + 3] = domain->boundary[d][1] >= 2 ? hi : domain->boxhi[d];
  }
  MPI_Allreduce(MPI_IN_PLACE, ends, 6, MPI_DOUBLE, MPI_MAX, lmp->world);
  int far = 0;
  const double *const splits[] = {comm->xsplit, comm->ysplit, comm->zsplit};
  for (int d = 0; d < 3; d++) {
    const auto border = [&](int k) { return -ends[d] + splits[d][k] * (ends[d + 3] + ends[d]); };
    const int below = comm->myloc[d] - 1,
              above = comm->myloc[d] + 2;    // borders of what can be reached
    for (int i = 0; i < atom->nlocal; i++) {
      const double x = atom->x[i][d];
      if ((below > 0 && x < border(below)) || (above < comm->procgrid[d] && x >= border(above)))
        far = 1;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &far, 1, MPI_INT, MPI_MAX, lmp->world);
  return far != 0;
}
