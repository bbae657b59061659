// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/contact_monitor.h"

#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "base/in_parallel.h"
#include "base/told_numbers.h"
#include "comm.h"
#include "error.h"
#include "shape/contact/shape_table.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

std::vector<RunMonitor::Check> ContactMonitor::checks(std::function<DeepestContact()> find_deepest)
{
  using Finding = RunMonitor::Finding;
  const auto say_once = [this](void (ContactMonitor::*say)(const Finding &) const) {
    return [this, say](const Finding &worst) {
      if (comm->me == 0) (this->*say)(worst);
      return true;
    };
  };
  return {{visibly * largest_overlap, [this, find_deepest] { return overlap_of(find_deepest()); },
           say_once(&ContactMonitor::warn_overlap), much_deeper},
          {visibly * largest_move, [this] { return largest_own_move(); },
           say_once(&ContactMonitor::warn_move)}};
}

RunMonitor::Finding ContactMonitor::overlap_of(const DeepestContact &deepest) const
{
  if (!(deepest.overlap_ratio > DeepestContact::watched)) return {};
  const auto [low, high] = std::minmax(atom->tag[deepest.i], atom->tag[deepest.j]);
  const auto [i, j] = std::minmax(atom->type[deepest.i], atom->type[deepest.j]);
  return {deepest.overlap_ratio,
          {static_cast<double>(low), static_cast<double>(high),
           GranularSystem::of(lmp)->laws().sides(i, j).stiffness_power()}};
}

/* Of the overlap as it is told. The time step follows the duration of the impact, which is ~ the
   overlap at a given speed. */

std::string ContactMonitor::remedy_for(double overlap, double power)
{
  const double times = rounded_up(overlap, 3) / largest_overlap;
  return fmt::format("contact laws are made for overlaps below {}: for impacts a stiffness (kn or "
                     "E) {:.2g} times as high, with {:.2g} of the time step, would do; or look for "
                     "particles that overlap from the beginning. Said once, unless it becomes much "
                     "worse",
                     largest_overlap, rounded_up(std::pow(times, power), 2),
                     rounded_down(1.0 / times, 2));
}

void ContactMonitor::warn_overlap(const RunMonitor::Finding &worst) const
{
  const bool begins = update->ntimestep == update->firststep;
  std::string cure = remedy_for(worst.value, worst.details[2]);
  if (begins)
    cure = "they do from the beginning: place them further apart";
  else if (worst.value > deep)
    cure = "no impact should go so deep: look for particles that are put into others, or use a "
           "smaller time step and a higher stiffness";
  error->warning(FLERR,
                 "Pair style {}: particles {:.0f} and {:.0f} overlap by {:.3g} of the smaller "
                 "radius at step {}{}; {}",
                 GranularSystem::of(lmp)->pair_style().name(), worst.details[0], worst.details[1],
                 worst.value, update->ntimestep, begins ? "" : " or since the last rebuild", cure);
}

/* The fastest that a point of the surface may be, over the radius of the largest sphere inside. */

double ContactMonitor::speed_over_radius(int i, const ShapedParticles &shapes) const
{
  const int type = atom->type[i];
  const auto length = [](const double *v) { return std::hypot(v[0], v[1], v[2]); };
  if (!shapes.is_shaped(type)) return length(atom->v[i]) / atom->radius[i];
  const ParticleShape &shape = *shapes.table().of(type);
  const double *const x = atom->x[i], *const w = atom->omega[i],
                      *const q = shapes.orientations()[i];
  const Pose pose = shape.pose({x[0], x[1], x[2]}, {q[0], q[1], q[2], q[3]});
  const double turning = shape.fastest_by_turning(pose.direction_in_body({w[0], w[1], w[2]}));
  return (length(atom->v[i]) + turning) / shape.shape().inscribed_radius();
}

RunMonitor::Finding ContactMonitor::largest_own_move() const
{
  const ShapedParticles *const shapes = GranularSystem::of(lmp)->shapes();
  struct Move {
    double ratio2;    ///< squared speed over squared radius
    int atom;
  };
  std::vector<Move> found(comm->nthreads, Move{0.0, 0});
  in_ranges(atom->nlocal, comm->nthreads, [&](int t, int begin, int end) {
    Move farthest = {0.0, 0};
    for (int i = begin; i < end; i++) {
      const double *v = atom->v[i], r = atom->radius[i];
      double ratio2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / (r * r);
      if (shapes) ratio2 = std::pow(speed_over_radius(i, *shapes), 2);
      if (ratio2 > farthest.ratio2) farthest = {ratio2, i};
    }
    found[t] = farthest;
  });
  const Move longest = *std::max_element(
      found.begin(), found.end(), [](const Move &a, const Move &b) { return a.ratio2 < b.ratio2; });
  if (!(longest.ratio2 > 0.0)) return {};
  const bool shaped = shapes && shapes->is_shaped(atom->type[longest.atom]);
  return {std::sqrt(longest.ratio2) * update->dt,
          {static_cast<double>(atom->tag[longest.atom]), shaped ? 1.0 : 0.0}};
}

void ContactMonitor::warn_move(const RunMonitor::Finding &worst) const
{
  error->warning(FLERR,
                 "Pair style {}: particle {:.0f} moves by {:.3g} of its radius{} in a time step at "
                 "step {}; an impact is not resolved: reduce the time step",
                 GranularSystem::of(lmp)->pair_style().name(), worst.details[0], worst.value,
                 worst.details[1] != 0.0
                     ? " (its corners by so much of that of the largest sphere inside)"
                     : "",
                 update->ntimestep);
}
