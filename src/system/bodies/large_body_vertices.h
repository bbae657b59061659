// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A mesh whose vertices another program moves (`move vertices` of fix large/body): the impulses that
// particles give them. A force acts in the step that follows it, or where the integrator gives half of its
// kick at the end of a step, in both: so do its impulse and its work, which is the force times the way of
// the vertex. So vertices have got what particles have lost, to rounding.
//
//   begin_step()   when vertices and particles have moved
//   end_step()     when forces are known

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_VERTICES_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_VERTICES_H

#include "body/contact/body_batch.h"
#include "body/contact/vertex_sums.h"
#include "body/shape/mesh_shape.h"
#include "system/host/system_fix.h"

#include "pointers.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// Impulses of particles on vertices since the last exchange (force times time), of those that were
/// touched, ascending; the work done on all, and the time.
struct VertexImpulses {
  std::vector<std::int64_t> vertices;
  std::vector<Vector3<double>> impulses;
  double work = 0.0, time = 0.0;
};

class LargeBodyVertices : protected LAMMPS_NS::Pointers {
 public:
  LargeBodyVertices(LAMMPS_NS::LAMMPS *lmp, MeshShape &shape);

  /// Filled by the contacts of a step.
  std::vector<TouchedCorners> *touched() { return &forces; }
  void begin_step(const Kicks &kicks_of_step);
  /// `advance`: there was one.
  void end_step(bool advance);

  /// Collective.
  VertexImpulses take();

  /// The vertices, and the sums of this rank; of a restart file, those of all. Before that is written: collect_sums(),
  /// collective; they are the first rank's then. After one was read: take_over_sums(), false if its mesh was another one.
  template <class Exchange> void exchange_state(Exchange &x)
  {
    mesh.moving()->exchange_state(x);
    if (x.restores() && !mesh.moving()->state_fits())
      return;    // sums are of vertices that are not there
    if constexpr (Exchange::of_each_rank) x(forces, kicks);
    x(sums, time);
    if (Exchange::of_each_rank && x.restores()) mesh.vertices_are_restored();
  }
  void collect_sums();
  bool take_over_sums();

  double memory_usage() const;

 private:
  void add(double share);
  std::vector<std::int64_t> packed_of_all_ranks() const;

  MeshShape &mesh;
  std::vector<TouchedCorners> forces;    // of the last step
  Kicks kicks{1.0, 0.0};
  VertexSums sums;
  double time = 0.0;    // of the sums
};

}    // namespace Talus

#endif
