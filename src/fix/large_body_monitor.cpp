// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_monitor.h"

#include "system/contact_monitor.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <utility>

using namespace LAMMPS_NS;
using namespace Talus;

/* One pass over the particles serves both checks, as long as the first one still looks. */

std::vector<RunMonitor::Check> LargeBodyMonitor::checks(std::function<BodyFindings()> find_worst,
                                                        std::function<bool()> moves,
                                                        const std::string &id)
{
  using Finding = RunMonitor::Finding;
  look = std::move(find_worst);
  const auto look_for_overlap = [this] {
    worst = look();
    just_looked = true;
    return finding(worst.overlap, worst.deepest);
  };
  const auto say_overlap = [this, id](const Finding &found) {
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix large/body {}: particle {:.0f} overlaps the body by {:.3g} of its radius "
                     "at step {}; {}",
                     id, found.details[0], found.value, update->ntimestep,
                     ContactMonitor::cure_of(found.value));
    return true;
  };
  const auto look_for_move = [this, moves = std::move(moves)]() -> Finding {
    const bool looked = just_looked;
    just_looked = false;
    if (!moves()) return {};
    if (!looked) worst = look();
    return finding(worst.speed * update->dt, worst.fastest);
  };
  const auto say_move = [this, id](const Finding &found) {
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix large/body {}: particle {:.0f} and the body move past each other by "
                     "{:.3g} of its radius in a time step at step {}; an impact is not resolved: "
                     "reduce the time step",
                     id, found.details[0], found.value, update->ntimestep);
    return true;
  };
  return {{largest_overlap, look_for_overlap, say_overlap, ContactMonitor::much_deeper},
          {largest_move, look_for_move, say_move}};
}

RunMonitor::Finding LargeBodyMonitor::finding(double value, int particle) const
{
  if (!(value > 0.0)) return {};
  return {value, {static_cast<double>(atom->tag[particle])}};
}
