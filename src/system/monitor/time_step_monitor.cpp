// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/time_step_monitor.h"

#include "system/host/fix_list.h"
#include "system/step/granular_system.h"

#include "base/told_numbers.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int everyone = 1;    // the bit of the group all

}    // namespace

void TimeStepMonitor::judge_start(const PairCoeffs &laws, const ContactPipeline &contacts)
{
  critical.compute(laws, contacts, everyone);
  said = false;
  judge();
  if (comm->me == 0 && critical.smallest() > 0.0 && particles_move()) {
    const double fraction = update->dt / critical.smallest();
    critical.undamped.warn(fraction);
    critical.elastic.warn(fraction);
  }
  critical.compute_from_sizes(laws, everyone);
  limit_at_start = critical.smallest();
  store_sizes(laws);
}

void TimeStepMonitor::store_sizes(const PairCoeffs &laws)
{
  const std::vector<double> here = critical.sizes_here(laws.num_types(), everyone);
  known_sizes.resize(here.size());
  MPI_Allreduce(here.data(), known_sizes.data(), static_cast<int>(here.size()), MPI_DOUBLE, MPI_MIN,
                world);
}

/* Particles that were added or changed during the run: by how much the largest of the sizes known
   before shrink. */

RunMonitor::Check TimeStepMonitor::check(const PairCoeffs &laws)
{
  constexpr double as_before = 1.0;
  return {as_before, [this, &laws] { return smaller_particles(laws); },
          [this, &laws](const RunMonitor::Finding &) { return judge_smaller_particles(laws); }};
}

RunMonitor::Finding TimeStepMonitor::smaller_particles(const PairCoeffs &laws) const
{
  if (said) return {};
  const std::vector<double> here = critical.sizes_here(laws.num_types(), everyone);
  constexpr double of_new_type = 2.0;    // anything above 1
  double shrinks = 0.0;
  for (std::size_t n = 0; n < std::min(here.size(), known_sizes.size()); n++)
    if (here[n] < known_sizes[n])
      shrinks =
          std::max(shrinks, std::isinf(known_sizes[n]) ? of_new_type : known_sizes[n] / here[n]);
  return {shrinks};
}

bool TimeStepMonitor::judge_smaller_particles(const PairCoeffs &laws)
{
  critical.compute_from_sizes(laws, everyone);
  const double limit = critical.smallest();
  const bool smaller = limit_at_start > 0.0 ? limit < limit_at_start : limit > 0.0;
  if (smaller) judge();
  if (!said) store_sizes(laws);
  return said;
}

/* Where no fix moves particles, as in a run for heat alone, any time step will do for contacts. */

bool TimeStepMonitor::particles_move() const
{
  const auto fixes = fix_list(*modify);
  return std::any_of(fixes.begin(), fixes.end(),
                     [](const Fix *fix) { return fix->time_integrate != 0; });
}

void TimeStepMonitor::judge()
{
  if (!particles_move()) return;
  const double limit = critical.smallest();
  const bool too_large = limit > 0.0 && update->dt > visibly * advised * limit;
  const bool unstable = critical.stable > 0.0 && update->dt > visibly * critical.stable;
  said = too_large || unstable;
  if (comm->me == 0 && unstable) warn_unstable();
  if (comm->me == 0 && too_large) warn_too_large(limit);
}

/* Less damping is no cure where springs alone make it unstable. */

void TimeStepMonitor::warn_unstable() const
{
  const GranularSystem &system = *GranularSystem::of(lmp);
  std::string cure = "use a smaller one";
  if (!(critical.stable_undamped > 0.0) || update->dt <= critical.stable_undamped)
    cure += std::string(", less damping (gt above all)") +
            (system.integrators().order() > 1 ? ", or order 1" : "");
  error->warning(
      FLERR,
      "Pair style {}: the time step is {:.3g} of the largest with which particles among twelve "
      "others, shapes by their faces, are stable with the damping of their contacts ({:.4g}): {}",
      system.pair_style().name(), update->dt / critical.stable, critical.stable, cure);
}

void TimeStepMonitor::warn_too_large(double limit) const
{
  std::string rules;
  for (const auto &[name, value] : {std::pair("contact", critical.contact),
                                    {"Rayleigh", critical.rayleigh},
                                    {"Hertz", critical.hertz}})
    if (value > 0.0) rules += fmt::format("{}{} {:.4g}", rules.empty() ? "" : ", ", name, value);
  error->warning(
      FLERR,
      "Pair style {}: the time step is {:.3g} of the critical one ({:.4g}; {}): at most {} of "
      "it is advised",
      GranularSystem::of(lmp)->pair_style().name(), update->dt / limit, limit, rules, advised);
}
