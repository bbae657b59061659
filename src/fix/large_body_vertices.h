// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A mesh whose vertices another program moves (`move vertices` of fix large/body): the impulses that
// particles give them. A force acts in the step that follows it, or where the integrator gives half of its
// kick at the end of a step, in both: so do its impulse and its work, which is the force times the way of
// the vertex. So vertices have got what particles have lost, to rounding.
//
//   begin_step()   when vertices and particles have moved
//   end_step()     when forces are known

#ifndef TALUS_FIX_LARGE_BODY_VERTICES_H
#define TALUS_FIX_LARGE_BODY_VERTICES_H

#include "base/state_exchange.h"
#include "body/contact/body_batch.h"
#include "body/contact/vertex_sums.h"
#include "body/shape/mesh_shape.h"
#include "system/deforming_body.h"
#include "system/system_fix.h"

#include "pointers.h"

#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

class LargeBodyVertices : protected Pointers {
 public:
  LargeBodyVertices(LAMMPS *lmp, Talus::MeshShape &shape);

  /// Filled by the contacts of a step.
  std::vector<Talus::TouchedCorners> *touched() { return &forces; }
  void begin_step(const Talus::Kicks &kicks_of_step);
  /// `advance`: there was one.
  void end_step(bool advance);

  /// Collective.
  Talus::VertexImpulses take();

  /// Collective: for restart files, state of the vertices and sums of all ranks; rank 0 goes on with these.
  /// `begin`, `end`: false if it is that of another mesh.
  void to_array(std::vector<double> &to);
  bool from_array(const double *begin, const double *end);
  /// For snapshots: the vertices, and the sums of this rank.
  void exchange_state(Talus::StateExchange &x);

  double memory_usage() const;

 private:
  void add(double share);
  std::vector<std::int64_t> packed_of_all_ranks() const;

  Talus::MeshShape &mesh;
  std::vector<Talus::TouchedCorners> forces;    // of the last step
  Talus::Kicks kicks{1.0, 0.0};
  Talus::VertexSums sums;
  double time = 0.0;    // of the sums
};

}    // namespace LAMMPS_NS

#endif
