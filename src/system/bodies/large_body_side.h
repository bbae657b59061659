// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// On which side of a closed mesh the particles of fix large/body are, where the command does not
// say: that side acts from then on. Found out when there are particles for the first time, and kept
// in restart files.

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_SIDE_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_SIDE_H

#include "body/motion/body_state.h"
#include "body/shape/mesh_shape.h"
#include "pointers.h"

namespace Talus {

class LargeBodySide : protected LAMMPS_NS::Pointers {
 public:
  /// nullptr: the shape is no mesh, and nothing is decided. `shape` must live as long as this.
  LargeBodySide(LAMMPS_NS::LAMMPS *lmp, MeshShape *shape) : Pointers(lmp), mesh_shape(shape) {}

  /// The command has not said it.
  bool is_open() const { return mesh_shape && mesh_shape->side() == MeshSide::UNDECIDED; }

  /// Before particles of the group are listed. Collective while the question is open.
  void decide(int group_bits, const BodyFrame &frame);

  /// The side that acts. What the command says counts more than what is in a restart file.
  template <class Exchange> void exchange_state(Exchange &x)
  {
    if (!mesh_shape) return;
    MeshSide acting = mesh_shape->side();
    x(acting);
    if (x.restores() && (Exchange::of_each_rank || is_open())) mesh_shape->set_side(acting);
  }

 private:
  MeshShape *mesh_shape;
};

}    // namespace Talus

#endif
