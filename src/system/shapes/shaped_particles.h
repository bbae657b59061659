// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that are not spheres: their shapes by type, orientations, contacts with each other and with large bodies, and
// what these remember. They are particles of LAMMPS like all others, with the radius of the sphere around their shape, so
// that neighbors, ghosts and the order of sums are found as always. Pairs with a shape are taken out of the neighbor list
// at a rebuild, and computed after those of spheres.
//
//   a run begins      forget_bodies(), set_up()
//   a step            move(), by the command; compute_contacts() and touch_body(), by the system
//   a rebuild         put_aside(), by ContactMemory, agree_with_other_ranks(); migration by the command; set_pairs()
//
//   shaped_particles.cpp        sizes, orientations, motion, questions
//   shaped_particles_step.cpp   contacts
//   shaped_particles_state.cpp  what travels with particles, snapshots
//
// The orientation is a quaternion w x y z from the axes in which the script gives the shape to those of space. Units are
// those of the script. GranularSystem owns this; fix shape/gran makes it, and has the hooks of LAMMPS.

#ifndef TALUS_SYSTEM_SHAPES_SHAPED_PARTICLES_H
#define TALUS_SYSTEM_SHAPES_SHAPED_PARTICLES_H

#include "body/contact/body_contacts.h"
#include "contact/contact_pipeline.h"
#include "exchange/sparse_exchange.h"
#include "history/contact_memory.h"
#include "particles/particle_state.h"
#include "shape/contact/body_points.h"
#include "shape/contact/shape_table.h"
#include "shape/contact/shaped_pairs.h"

#include "pointers.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;
class LargeBody;

class ShapedParticles : public ContactMemory::Holder, protected LAMMPS_NS::Pointers {
 public:
  /// `command`: its data by particle are here; it moves those of its group.
  ShapedParticles(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner, LAMMPS_NS::Fix *command,
                  ShapeTable shapes);
  ~ShapedParticles() override;
  ShapedParticles(const ShapedParticles &) = delete;
  ShapedParticles &operator=(const ShapedParticles &) = delete;

  const LAMMPS_NS::Fix *command() const { return fix; }
  const ShapeTable &table() const { return shapes; }
  bool is_shaped(int type) const { return shapes.of(type) != nullptr; }
  /// Contacts with each other and with spheres, of the last step on this rank.
  const ShapedPairs &pairs() const { return pairs_here; }

  // ---- particles

  /// Rows of four by local index, of owned particles and ghosts: orientations, zero of spheres and of particles that have
  /// none yet. To be sent with positions in each step.
  double *const *orientations() const { return quat; }
  double **orientation_rows() { return quat; }
  /// Radius and mass belong to the type; LAMMPS makes new particles with others.
  void set_sizes(int first, int last);
  /// Of new particles, by ID, which some commands give after they have made the particle.
  void orient_new(int first, int last);
  /// Those with this ID on this rank; returns how many there are.
  int set_orientation(LAMMPS_NS::tagint tag, const Eigen::Quaterniond &orientation);
  /// The command moves it (local index), and writes the change of its velocity, see ParticleState::change().
  bool moves(int i) const;
  /// Those of the command's group go on by a step, where they are now.
  void move();
  /// For pictures: visit(i, triangle) for the surfaces of owned particles with a shape.
  using VisitTriangle = std::function<void(int, const Triangle &)>;
  void for_each_triangle(const VisitTriangle &visit) const;

  // ---- a run, a rebuild, a step; collective

  /// A script may have deleted some; histories are in the lists.
  void forget_bodies() { bodies.clear(); }
  /// It is deleted.
  void forget(const LargeBody &body);
  /// "", or why particles with a shape cannot touch the surface of a body.
  std::string refusal(LargeBody &body);
  /// There is a set-up: pairs and ghosts of shapes will be known.
  void set_up() { is_set_up = true; }

  // ContactMemory::Holder: of contact points
  bool owns(const ContactLists::Contact &one) const override
  {
    return (one.feature & ContactLists::of_shape) != 0;
  }
  void put_aside(ContactLists &to) override;
  /// Collective, after it: in a periodic box on the histories of contacts across borders.
  void agree_with_other_ranks();
  /// The pairs with a shape (local indices, at least one is owned).
  void set_pairs(const std::vector<std::array<int, 2>> &found);
  /// Adds the forces of their contacts where those of spheres are now, in the arrays of LAMMPS or
  /// in the records, when all particles of this step are there, ghosts included.
  void compute_contacts(const ContactStep &step);
  /// Adds the forces between owned particles with a shape and a large body; returns what the body
  /// bears.
  BodyLoad touch_body(LargeBody &body, const BodyStep &step);

  /// Of the last step the deepest of pairs, over the radius of the smaller of the largest spheres inside; and in a body.
  DeepestContact deepest_contact() const;
  DeepestInBody deepest_in(const LargeBody &body) const;

  // ---- what travels with a particle: the orientation. Doubles.

  void grow(int particles);
  void copy(int from, int to);
  void begin(int i);
  int pack(int i, double *to) const;
  int unpack(int i, const double *from);
  static constexpr int size_orientation = 4;

  /// For snapshots, between two runs.
  void exchange_state(StateExchange &x);
  double memory_usage() const;

 private:
  using Load = ParticleState::Load;
  ShapedView view() const;
  void require_set_up() const;
  void keep_change(ChangeRecord &change, int i, const Load &load) const;
  void move(const ParticleState &particles, const int *of_lane, int count);
  void send_orientations();
  void tell_pairs(const ContactStep &step) const;
  BodyPoints &points_of(LargeBody &body);
  BodyPoints &points_with_particles(LargeBody &body);
  void list_particles(const LargeBody &body, BodyPoints &points);
  static std::int64_t name_of(const LargeBody &body);
  bool in_periodic_box() const;
  void begin_step();

  GranularSystem &system;
  LAMMPS_NS::Fix *fix;
  ShapeTable shapes;
  ShapedPairs pairs_here;
  std::map<const LargeBody *, BodyPoints> bodies;    ///< with which they have contacts
  double **quat = nullptr;
  bool orientations_were_set = false;    ///< by a command: ghosts do not know it
  bool is_set_up = false;

  bool agreed = true;                       ///< all ranks have, or need not, since the last step
  ShapedPairs::Messages for_other_ranks;    ///< until they agree
  SparseExchange exchange;
};

}    // namespace Talus

#endif
