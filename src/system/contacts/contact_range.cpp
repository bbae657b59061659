// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/contact_range.h"

#include "base/told_numbers.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "utils.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

/* Of the largest particles; the reach grows with both largest_radii. */

double ContactRange::reach(int i, int j) const
{
  return laws.known(i, j)
             ? laws.pulloff_distance(i, j, largest_radii.largest(i), largest_radii.largest(j))
             : 0.0;
}

double ContactRange::cutoff(int i, int j) const
{
  return largest_radii.cutoff(i, j) + reach(std::min(i, j), std::max(i, j));
}

/* Asked at each rebuild: scripts may declare many types. */

double ContactRange::largest_pulloff_distance() const
{
  if (farthest_of_laws == laws.revision()) return farthest;
  farthest_of_laws = laws.revision();
  farthest = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) farthest = std::max(farthest, reach(i, j));
  return farthest;
}

/* A radius far beyond the box makes ghosts or cells of neighbors without end. A frozen particle may
   touch its image: it does not move. */

void ContactRange::require_sizes(const std::string &style) const
{
  constexpr double far_beyond = 1.0e6;
  const double largest = largest_radii.largest(),
               box = std::max({domain->prd[0], domain->prd[1], domain->prd[2]});
  if (!(largest <= far_beyond * box))
    error->all(
        FLERR,
        "Pair style {}: the largest particle has a radius of {:.4g}, {:.3g} times the longest "
        "side of the box: look for what has set it (set diameter, read_data, fix adapt, fix "
        "pour or deposit), in units of length",
        style, largest, largest / box);
  double free = 0.0;
  for (int type = 1; type <= atom->ntypes; type++)
    free = std::max(free, largest_radii.of_free(type));
  for (int d = 0; d < 3; d++) {
    const bool matters = domain->periodicity[d] && !(domain->dimension == 2 && d == 2);
    if (!matters || domain->prd[d] >= 2.0 * free) continue;
    const std::string problem = fmt::format(
        "the box is periodic in {} with a period of {:.6g}, and the largest particle "
        "has a diameter "
        "of {:.6g}: it touches its own image: make the box at least {:.6g} wide, or "
        "use 'boundary f'",
        std::string(1, "xyz"[d]), domain->prd[d], 2.0 * free, rounded_up(4.0 * free, 6));
    error->all(FLERR, "Pair style {}: {}", style, problem);
  }
}

std::string ContactRange::small_period() const
{
  const double needed = 4.0 * largest_radii.largest();
  for (int d = 0; d < 3; d++) {
    const bool matters = domain->periodicity[d] && !(domain->dimension == 2 && d == 2);
    if (matters && domain->prd[d] < needed)
      return fmt::format(
          "the box is periodic in {} with a period of {:.6g}, below two diameters of the largest "
          "particle: two particles could touch on both sides, and laws with history cannot tell "
          "these contacts apart: make the box at least {:.6g} wide, or use 'boundary f'",
          std::string(1, "xyz"[d]), domain->prd[d], rounded_up(needed, 6));
  }
  return "";
}

}    // namespace Talus
