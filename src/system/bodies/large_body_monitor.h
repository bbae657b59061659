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

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_MONITOR_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_MONITOR_H

#include "body/contact/body_contacts.h"
#include "body/shape/mesh_shape.h"
#include "pointers.h"
#include "system/monitor/run_monitor.h"

#include <string>
#include <vector>

namespace Talus {

class LargeBody;

class LargeBodyMonitor : protected LAMMPS_NS::Pointers {
 public:
  static constexpr double largest_overlap = 0.1;    ///< over the radius
  static constexpr double largest_move = 0.1;       ///< over the radius

  LargeBodyMonitor(LAMMPS_NS::LAMMPS *lmp, LargeBody &large_body);

  /// This object and the body must live as long as the checks.
  std::vector<LAMMPS_NS::RunMonitor::Check> checks();

  /// A run begins.
  void start() { step_of_look = -1; }

 private:
  using Worst = BodyFindings::Worst;
  const BodyFindings &findings();
  LAMMPS_NS::RunMonitor::Finding finding(const Worst &worst, double factor = 1.0) const;
  std::string place(const LAMMPS_NS::RunMonitor::Finding &found) const;
  void warn(const std::string &text) const;
  std::string other_side() const;
  std::string cure_of_overlap(const LAMMPS_NS::RunMonitor::Finding &found) const;
  void warn_overlap(const LAMMPS_NS::RunMonitor::Finding &found) const;
  void warn_move(const LAMMPS_NS::RunMonitor::Finding &found) const;
  void warn_passage(const LAMMPS_NS::RunMonitor::Finding &found) const;
  void warn_idle(const LAMMPS_NS::RunMonitor::Finding &found) const;

  LargeBody &body;
  const MeshShape *mesh;    // its shape, if it is one
  BodyFindings worst;
  LAMMPS_NS::bigint step_of_look = -1;    // one pass over the particles serves all checks of a step
};

}    // namespace Talus

#endif
