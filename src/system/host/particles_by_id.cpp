// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/particles_by_id.h"

#include "atom.h"

#include <algorithm>
#include <unordered_map>

using namespace LAMMPS_NS;

namespace Talus {

/* The map of LAMMPS may be missing, and need not be up to date between runs. Of a list in the order of this rank's
   particles each is found behind the last one. */

ParticlesById::ParticlesById(LAMMPS *lmp, const std::vector<std::int64_t> &ids) :
    Pointers(lmp), named(ids), here(ids.size(), -1)
{
  std::size_t in_order = 0;
  for (int i = 0; i < atom->nlocal && in_order < ids.size(); i++)
    if (atom->tag[i] == ids[in_order]) here[in_order++] = i;
  if (in_order == ids.size()) return;
  std::unordered_map<std::int64_t, int> owned(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) owned.emplace(atom->tag[i], i);
  for (std::size_t k = 0; k < ids.size(); k++)
    if (const auto found = owned.find(ids[k]); found != owned.end()) here[k] = found->second;
}

/* All ranks look at all of the list: each of its particles is on one of them. */

std::string ParticlesById::problem(bool once) const
{
  std::int64_t numbers[2] = {0, 0}, all[2];    // found here, and named more than once
  std::vector<unsigned char> seen(once ? atom->nlocal : 0, 0);
  for (const int i : here) {
    if (i < 0) continue;
    numbers[0]++;
    if (!once) continue;
    numbers[1] += seen[i];
    seen[i] = 1;
  }
  MPI_Allreduce(numbers, all, 2, MPI_INT64_T, MPI_SUM, world);
  if (all[0] < static_cast<std::int64_t>(size())) {
    std::vector<int> found(size());
    std::transform(here.begin(), here.end(), found.begin(), [](int i) { return i >= 0; });
    MPI_Allreduce(MPI_IN_PLACE, found.data(), static_cast<int>(size()), MPI_INT, MPI_MAX, world);
    const auto missing = std::find(found.begin(), found.end(), 0);
    return "there is no particle " + std::to_string(named[missing - found.begin()]);
  }
  if (all[1] == 0) return "";
  std::vector<std::int64_t> sorted = named;
  std::sort(sorted.begin(), sorted.end());
  return "particle " + std::to_string(*std::adjacent_find(sorted.begin(), sorted.end())) +
         " is given twice";
}

}    // namespace Talus
