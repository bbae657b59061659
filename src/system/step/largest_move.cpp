// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/largest_move.h"

#include "base/in_parallel.h"
#include "contact/contact_pipeline.h"

#include "atom.h"
#include "comm.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

namespace Talus {

void LargestMove::moves_in_records()
{
  moved_in_records = update->ntimestep;
}

bool LargestMove::was_in_records() const
{
  return moved_in_records == update->ntimestep;
}

bool LargestMove::is_checked() const
{
  return neighbor->dist_check && !neighbor->includegroup;
}

bool LargestMove::is_known() const
{
  return known_at == update->ntimestep && lists == neighbor->ncalls && !update->setupflag;
}

double LargestMove::at_most(ContactPipeline &pipeline)
{
  if (!is_checked()) return HUGE_VAL;
  if (is_known()) return distance;
  const bigint now = update->ntimestep;
  const bool follows = known_at == now - 1 && lists == neighbor->ncalls && !update->setupflag;
  if (!follows || !was_in_records() || !pipeline.motion().moves_all_owned())
    return exactly(pipeline);
  constexpr double more_than_rounding = 1.0 + 1.0e-9;
  pipeline.motion().complete();
  distance = more_than_rounding * (distance + update->dt * pipeline.motion().fastest());
  known_at = now;
  exact = false;
  return distance;
}

double LargestMove::exactly(ContactPipeline &pipeline)
{
  double **then = neighbor->get_xhold();
  if (!is_checked() || !then) return HUGE_VAL;
  if (is_known() && exact) return distance;
  if (!pipeline.motion().holds_state()) {
    distance = largest([this](int i) { return atom->x[i]; });
  } else {
    pipeline.motion().complete();
    const ParticleRecords &records = pipeline.records();
    const int *slots = pipeline.particle_order().slot_of_atom.data();
    distance = largest([&](int i) { return records.position[slots[i]].c; });
  }
  known_at = update->ntimestep;
  lists = neighbor->ncalls;
  exact = true;
  return distance;
}

template <class Place> double LargestMove::largest(Place place) const
{
  double **then = neighbor->get_xhold();
  std::vector<double> squares(comm->nthreads, 0.0);
  in_ranges(atom->nlocal, comm->nthreads, [&](int t, int begin, int end) {
    double most = 0.0;
    for (int i = begin; i < end; i++) {
      const double *x = place(i), *x0 = then[i];
      const double d[3] = {x[0] - x0[0], x[1] - x0[1], x[2] - x0[2]};
      const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (!(squared <= most)) most = squared;    // also if it is not a number
    }
    squares[t] = most;
  });
  double most = 0.0;
  for (const double one : squares)
    if (!(one <= most)) most = one;
  return std::sqrt(most);
}

}    // namespace Talus
