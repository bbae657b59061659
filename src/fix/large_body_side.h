// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// On which side of a closed mesh the particles of fix large/body are, where the command does not
// say: that side acts from then on. Found out when there are particles for the first time, and kept
// in restart files.

#ifndef TALUS_FIX_LARGE_BODY_SIDE_H
#define TALUS_FIX_LARGE_BODY_SIDE_H

#include "base/state_exchange.h"
#include "body/motion/body_state.h"
#include "body/shape/mesh_shape.h"
#include "pointers.h"

namespace LAMMPS_NS {

class LargeBodySide : protected Pointers {
 public:
  explicit LargeBodySide(LAMMPS *lmp) : Pointers(lmp) {}

  /// Of shapes that are no mesh nothing is decided. `shape` must live as long as this.
  void watch(Talus::LargeBodyShape &shape) { mesh_shape = shape.as_mesh(); }
  const Talus::MeshShape *mesh() const { return mesh_shape; }
  /// The command has not said it.
  bool is_open() const { return mesh_shape && mesh_shape->side() == Talus::MeshSide::UNDECIDED; }

  /// Before particles of the group are listed. Collective while the question is open.
  void decide(int group_bits, const Talus::BodyFrame &frame);

  /// For restart files; what the command says counts more.
  double code() const { return mesh_shape ? static_cast<double>(mesh_shape->side()) : 0.0; }
  void set_code(double code);
  /// For snapshots: the side that acts.
  void exchange_state(Talus::StateExchange &x);

 private:
  Talus::MeshShape *mesh_shape = nullptr;
};

}    // namespace LAMMPS_NS

#endif
