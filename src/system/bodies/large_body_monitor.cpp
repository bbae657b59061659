// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_body_monitor.h"

#include "system/bodies/large_body.h"
#include "system/regions/region_shape.h"

#include "base/told_numbers.h"
#include "system/monitor/contact_monitor.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "fmt/format.h"
#include "update.h"

#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

LargeBodyMonitor::LargeBodyMonitor(LAMMPS *lmp, LargeBody &large_body) :
    Pointers(lmp), body(large_body), mesh(large_body.shape().as_mesh())
{
}

std::vector<RunMonitor::Check> LargeBodyMonitor::checks()
{
  using Finding = RunMonitor::Finding;
  const auto check = [this](double limit, std::function<Finding()> find,
                            void (LargeBodyMonitor::*warning)(const Finding &) const) {
    return RunMonitor::Check{limit, std::move(find), [this, warning](const Finding &found) {
                               if (comm->me == 0) (this->*warning)(found);
                               return true;
                             }};
  };
  RunMonitor::Check overlap = check(
      visibly * largest_overlap, [this] { return finding(findings().overlap); },
      &LargeBodyMonitor::warn_overlap);
  overlap.worse = ContactMonitor::much_deeper;
  return {std::move(overlap),
          check(
              visibly * largest_move,
              [this] {
                return body.motion().moves() ? finding(findings().speed, update->dt) : Finding{};
              },
              &LargeBodyMonitor::warn_move),
          check(
              0.5, [this] { return finding(findings().passed); }, &LargeBodyMonitor::warn_passage),
          check(
              0.5, [this] { return finding(findings().idle); }, &LargeBodyMonitor::warn_idle)};
}

const BodyFindings &LargeBodyMonitor::findings()
{
  if (step_of_look != update->ntimestep) worst = body.find_worst();
  step_of_look = update->ntimestep;
  return worst;
}

/* Details: the particle; of a mesh, the number of the triangle in the file; see stiffness_power(); whether
   it has a shape. */

RunMonitor::Finding LargeBodyMonitor::finding(const Worst &found, double factor) const
{
  if (!(found.value > 0.0)) return {};
  const int triangle = mesh ? mesh->surface().number_in_file(found.part) + 1 : 0;
  const int type = atom->type[found.particle];
  const ShapedParticles *const shapes = GranularSystem::of(lmp)->shapes();
  return {factor * found.value,
          {static_cast<double>(atom->tag[found.particle]), static_cast<double>(triangle),
           body.stiffness_power(type), shapes && shapes->is_shaped(type) ? 1.0 : 0.0}};
}

std::string LargeBodyMonitor::place(const RunMonitor::Finding &found) const
{
  if (!mesh) return "the body";
  return fmt::format("triangle {:.0f} of mesh '{}'", found.details[1], mesh->name());
}

void LargeBodyMonitor::warn(const std::string &text) const
{
  error->warning(FLERR, "Fix large/body {}: {}", body.command()->id, text);
}

/* What a user writes so that particles are touched on the other side. */

std::string LargeBodyMonitor::other_side() const
{
  if (mesh) return "'two-sided', or the other one of 'inside' and 'outside'";
  if (dynamic_cast<const RegionShape *>(&body.shape()))
    return "the other one of 'side in' and 'side out' in the region command";
  if (body.shape().has_one_normal()) return "the normal the other way round, or 'two-sided'";
  return "the other one of 'inside' and 'outside'";
}

std::string LargeBodyMonitor::cure_of_overlap(const RunMonitor::Finding &found) const
{
  const bool begins = update->ntimestep == update->firststep,
             deep = found.value > ContactMonitor::deep;
  std::string cure = ContactMonitor::remedy_for(found.value, found.details[2]);
  if (begins)
    cure = "it is there from the beginning: move the particle or the body";
  else if (deep)
    cure = "no impact should go so deep: put particles where they are clear of the body, or use a "
           "smaller time step or a higher stiffness if they hit it fast";
  if (found.value <= 1.0) return cure;
  return fmt::format("its center {} behind the surface: if particles belong on that side, use {}; "
                     "otherwise {}",
                     found.details[3] != 0.0 ? "may be" : "is", other_side(), cure);
}

void LargeBodyMonitor::warn_overlap(const RunMonitor::Finding &found) const
{
  const bool begins = update->ntimestep == update->firststep;
  warn(fmt::format("particle {:.0f} overlaps {} by {:.3g} of its radius at step {}{}; {}",
                   found.details[0], place(found), found.value, update->ntimestep,
                   begins ? "" : " or since the last rebuild", cure_of_overlap(found)));
}

void LargeBodyMonitor::warn_move(const RunMonitor::Finding &found) const
{
  warn(fmt::format("particle {:.0f} and the body move past each other by {:.3g} of its radius in a "
                   "time step at step {}; an impact is not resolved: reduce the time step",
                   found.details[0], found.value, update->ntimestep));
}

void LargeBodyMonitor::warn_passage(const RunMonitor::Finding &found) const
{
  const bool unfelt = found.value > 1.5;
  warn(fmt::format("particle {:.0f} went through {} before step {}; {}", found.details[0],
                   place(found), update->ntimestep,
                   unfelt
                       ? "the mesh does not act on the side that it came from: use " + other_side()
                       : "the contact is too soft, or the time step too long, for so hard an "
                         "impact: use a higher stiffness or a smaller time step"));
}

void LargeBodyMonitor::warn_idle(const RunMonitor::Finding &found) const
{
  warn(fmt::format("particle {:.0f} is at {} at step {}, but on the side where the mesh does not "
                   "act: move it, or use {}",
                   found.details[0], place(found), update->ntimestep, other_side()));
}

}    // namespace Talus
