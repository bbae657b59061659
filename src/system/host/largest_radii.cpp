// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/largest_radii.h"

#include "system/shapes/shaped_particles.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

void LargestRadii::find(int frozen_groups, const Talus::ShapedParticles *shapes)
{
  const int n = atom->ntypes + 1;
  std::vector<double> mine(n, 0.0), mine_frozen(n, 0.0);
  add_future(mine);
  for (int type = 1; type < n && shapes; type++)
    mine[type] = std::max(mine[type], shapes->table().bounding_radius(type));
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->type[i] < 1 || atom->type[i] >= n)
      error->one(FLERR,
                 "Particle {} is of type {}, and there are {} types: the restart file is damaged, "
                 "use another copy or "
                 "an earlier file",
                 atom->tag[i], atom->type[i], n - 1);
    double &r = (atom->mask[i] & frozen_groups ? mine_frozen : mine)[atom->type[i]];
    r = std::max(r, atom->radius[i]);
  }
  free.resize(n);
  frozen.resize(n);
  MPI_Allreduce(mine.data(), free.data(), n, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(mine_frozen.data(), frozen.data(), n, MPI_DOUBLE, MPI_MAX, world);
}

void LargestRadii::add_future(std::vector<double> &radius) const
{
  for (const char *style : {"^pour", "^deposit"})
    for (const auto &ifix : modify->get_fix_by_style(style))
      for (int type = 1; type <= atom->ntypes; type++) {
        int itype = type;
        auto *largest = static_cast<double *>(ifix->extract("radius", itype));
        if (largest) radius[type] = std::max(radius[type], *largest);
      }
}

double LargestRadii::cutoff(int i, int j) const
{
  return std::max({free[i] + free[j], frozen[i] + free[j], free[i] + frozen[j]});
}

double LargestRadii::largest() const
{
  return std::max(*std::max_element(free.begin(), free.end()),
                  *std::max_element(frozen.begin(), frozen.end()));
}
