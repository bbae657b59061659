// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// That positions and velocities are numbers.

#include "system/contacts/fix_contact_store.h"

#include "system/step/granular_system.h"

#include "base/in_parallel.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace LAMMPS_NS;

namespace {

/// Numbers that are far from overflow when they are squared and added, as nearly always.
bool are_small(const double *numbers, std::int64_t count, int threads)
{
  constexpr int block = 4096;
  constexpr double largest = 1.0e300;    // of squares
  std::atomic<bool> all{true};
  Talus::in_ranges((count + block - 1) / block, threads, [&](int, int begin, int end) {
    const std::int64_t first = std::int64_t{begin} * block,
                       last = std::min(count, std::int64_t{end} * block);
    int large = 0;
    for (std::int64_t n = first; n < last; n++) large |= !(numbers[n] * numbers[n] < largest);
    if (large) all = false;
  });
  return all;
}

}    // namespace

/* A square that overflows counts as well: energies and moves are no numbers then. */

RunMonitor::Finding FixContactStore::find_no_number() const
{
  double **const rows[] = {atom->x, atom->v, atom->omega};
  for (int q = 0; q < 3; q++) {
    if (atom->nlocal == 0 || are_small(rows[q][0], 3L * atom->nlocal, comm->nthreads)) continue;
    for (int i = 0; i < atom->nlocal; i++) {
      const double *v = rows[q][i];
      if (!std::isfinite(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))
        return {1.0, {static_cast<double>(atom->tag[i]), static_cast<double>(q)}};
    }
  }
  return {};
}

void FixContactStore::report_no_number(const RunMonitor::Finding &found) const
{
  constexpr const char *quantities[] = {"position", "velocity", "angular velocity"};
  error->all(FLERR,
             "Pair style {}: the {} of particle {:.0f} is not a number, or much too large, at step "
             "{}: use a smaller time step, or look for what has set it (velocity, set, read_data, "
             "a fix)",
             system->pair_style().name(), quantities[static_cast<int>(found.details[1])],
             found.details[0], update->ntimestep);
}

/* Of several ranks the particle with the lowest ID. */

void FixContactStore::require_numbers() const
{
  if (!has_pairs()) return;
  struct {
    double tag;
    int quantity;
  } mine{std::numeric_limits<double>::max(), 0}, first;
  const RunMonitor::Finding here = find_no_number();
  if (here.value > 0.0) mine = {here.details[0], static_cast<int>(here.details[1])};
  MPI_Allreduce(&mine, &first, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
  if (first.tag < std::numeric_limits<double>::max())
    report_no_number({1.0, {first.tag, static_cast<double>(first.quantity)}});
}
