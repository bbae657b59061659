// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Particles that are not spheres, as GranularSystem knows them: fix shape/gran. They are particles
// of LAMMPS like all others, with the radius of the sphere around their shape, so that neighbors,
// ghosts and the order of sums are found as always. Pairs with a shape are taken out of the
// neighbor list at a rebuild, and computed by the fix after those of spheres.

#ifndef TALUS_SYSTEM_SYSTEM_SHAPES_H
#define TALUS_SYSTEM_SYSTEM_SHAPES_H

#include "body/contact/body_contacts.h"
#include "contact/contact_pipeline.h"
#include "shaped/point_contact.h"
#include "shaped/shape_table.h"
#include "system/system_fix.h"

#include <array>
#include <functional>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class LargeBody;

class SystemShapes : public SystemFix {
 public:
  /// Types count from 1.
  virtual bool is_shaped(int type) const = 0;
  /// Of the sphere around (length), 0 of a type of spheres.
  virtual double radius_of(int type) const = 0;
  /// Of the largest sphere inside (length), and the volume; only of types with a shape.
  virtual double inner_radius_of(int type) const = 0;
  virtual double volume_of(int type) const = 0;
  /// nullptr of a type of spheres.
  virtual const ParticleShape *shape_of(int type) const = 0;

  /// Before particles are sorted or migrate, after a run, and before a restart file is written:
  /// stores the histories of contacts with the particles. Collective.
  virtual void keep_histories() = 0;
  /// Rows of four by local index, of owned particles and ghosts: orientations, to be sent with
  /// positions in each step.
  virtual double *const *orientations() const = 0;
  /// At a rebuild, collective: the pairs with a shape (local indices, at least one is owned).
  virtual void set_pairs(std::vector<std::array<int, 2>> pairs) = 0;
  /// Adds the forces of their contacts where those of spheres are now, in the arrays of LAMMPS or
  /// in the records, when all particles of this step are there, ghosts included. Collective.
  virtual void compute_contacts(const ContactStep &step) = 0;

  /// Adds the forces between owned particles with a shape and a large body; returns what the body
  /// bears.
  virtual BodyLoad touch_body(LargeBody &body, const BodyStep &step) = 0;

  /// Its integrator has written the change of velocities of particle i in this step, see
  /// ParticleState::change().
  virtual bool keeps_change_of(int i) const = 0;

  /// visit(contact) for each contact point of two particles in the last step on this rank.
  using VisitContact = std::function<void(const ContactReport &)>;
  virtual void for_each_contact_of_pairs(const VisitContact &visit) const = 0;
  /// For pictures: visit(i, triangle) for the surfaces of owned particles with a shape.
  using VisitTriangle = std::function<void(int, const Triangle &)>;
  virtual void for_each_triangle(const VisitTriangle &visit) const = 0;
  /// Pairs that touch, and all whose surroundings overlap; what two ranks compute counts half.
  virtual double count_contacts() const = 0;
  virtual double count_candidates() const = 0;
  /// Of these the deepest, over the radius of the smaller of the largest spheres inside.
  virtual DeepestContact deepest_contact() const = 0;
  /// Since the last rebuild, if deeper than DeepestContact::watched; otherwise that.
  virtual DeepestContact deepest_since_rebuild() const = 0;
  virtual DeepestInBody deepest_in(const LargeBody &body) const = 0;

 protected:
  ~SystemShapes() = default;
};

}    // namespace Talus

#endif
