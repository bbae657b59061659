// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Checks of fix large/body, as ContactMonitor has them for pairs:
//
//   overlap   a particle overlaps the body by more than a tenth of its radius: the laws are those
//             of small overlaps; by more than its radius: its center is behind the surface
//   move      a particle near a body that moves goes by more than a tenth of its radius past it in
//             a time step: it may be deep in the body, or through it, before it feels a force
//   passage   the center of a particle has gone through a triangle of a mesh
//   idle      a particle reaches a triangle of a mesh from the side that does not act

#ifndef TALUS_FIX_LARGE_BODY_MONITOR_H
#define TALUS_FIX_LARGE_BODY_MONITOR_H

#include "body/contact/body_contacts.h"
#include "body/shape/mesh_shape.h"
#include "pointers.h"
#include "system/large_body.h"
#include "system/run_monitor.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class LargeBodyMonitor : protected Pointers {
 public:
  static constexpr double largest_overlap = 0.1;    ///< over the radius
  static constexpr double largest_move = 0.1;       ///< over the radius

  explicit LargeBodyMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// `moves`: whether the body does. This object and the body must live as long as the checks.
  std::vector<RunMonitor::Check> checks(Talus::LargeBody &large_body, std::function<bool()> moves);

  /// A run begins.
  void start() { step_of_look = -1; }

 private:
  using Worst = Talus::BodyFindings::Worst;
  const Talus::BodyFindings &findings();
  RunMonitor::Finding finding(const Worst &worst, double factor = 1.0) const;
  std::string place(const RunMonitor::Finding &found) const;
  void warn(const std::string &text) const;
  std::string other_side() const;
  std::string cure_of_overlap(const RunMonitor::Finding &found) const;
  void warn_overlap(const RunMonitor::Finding &found) const;
  void warn_move(const RunMonitor::Finding &found) const;
  void warn_passage(const RunMonitor::Finding &found) const;
  void warn_idle(const RunMonitor::Finding &found) const;

  Talus::LargeBody *body = nullptr;
  const Talus::MeshShape *mesh = nullptr;    // its shape, if it is one
  Talus::BodyFindings worst;
  bigint step_of_look = -1;    // one pass over the particles serves all checks of a step
};

}    // namespace LAMMPS_NS

#endif
