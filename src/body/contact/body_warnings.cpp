// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_warnings.h"

#include <cmath>
#include <cstdio>

namespace Talus {

BodyWarnings::Finding BodyWarnings::look(Kind kind, const BodyFindings &found, double dt)
{
  const Finding its = kind == OVERLAP ? Finding{found.overlap, found.deepest}
                                      : Finding{found.speed * dt, found.fastest};
  return std::isfinite(its.value) ? its : Finding{0.0, its.atom};
}

std::string BodyWarnings::text(Kind kind, const std::string &id, double value, long long tag,
                               long long step)
{
  const char *const format =
      kind == OVERLAP
          ? "particle %lld overlaps the body by %.3g of its radius at step %lld; contact laws are "
            "made for small overlaps: use a higher stiffness, or look for particles that overlap "
            "from the beginning"
          : "particle %lld and the body move past each other by %.3g of its radius in a time step "
            "at step %lld; an impact is not resolved: reduce the time step";
  char line[400];
  std::snprintf(line, sizeof line, format, tag, value, step);
  return "Fix large/body " + id + ": " + line;
}

}    // namespace Talus
