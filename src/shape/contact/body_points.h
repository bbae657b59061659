// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of the owned particles with a shape and one large body, through the same laws as
// those of spheres. As there (body/contact/body_batch.h), everything is computed in the frame of
// the body, where it is at rest and histories turn with it.
//
//   at a rebuild   save() (if points are current), set_particles()
//   every step     compute()

#ifndef TALUS_SHAPE_CONTACT_BODY_POINTS_H
#define TALUS_SHAPE_CONTACT_BODY_POINTS_H

#include "body/contact/body_batch.h"
#include "body/contact/body_contacts.h"
#include "shape/contact/body_surfaces.h"
#include "shape/contact/contact_points.h"
#include "shape/contact/shape_table.h"
#include "shape/contact/shaped_view.h"

#include <vector>

namespace Talus {

class BodyPoints : public ContactPoints {
 public:
  /// Shapes must live as long as this. `body_name`: see ContactMemory::name_of().
  BodyPoints(const LargeBodyShape &body, const ShapeTable &shape_table, std::int64_t body_name) :
      shapes(shape_table), name(body_name), surfaces(body, shape_table)
  {
  }

  /// "", or why some particles cannot touch this body, see BodySurfaces.
  std::string refusal() const { return surfaces.refusal(); }

  /// Local indices of the particles with a shape that the body acts on, and the lists in which their
  /// histories are.
  void set_particles(const ShapedView &view, const std::vector<int> &particles,
                     const ContactLists &from);
  bool has_particles() const { return is_set; }

  /// For snapshots, with the particles.
  void exchange_state(StateExchange &x)
  {
    x(is_set);
    ContactPoints::exchange_state(x);
  }

  /// Adds forces and torques; returns what the body bears.
  BodyLoad compute(const BodyFrame &frame, const ShapedView &view, const LawTable &laws,
                   const BodyStep &step);

 private:
  struct Task {
    const BodyFrame &frame;
    const ShapedView &view;
    const LawTable &laws;
    const BodyStep &step;
  };
  /// Of the body, to the particles of a chunk.
  struct Reaction {
    BodyLoad load;
    ExactLoad exact;
    std::vector<TouchedPart> touched;
    std::vector<TouchedCorners> corners;
  };

  void find_points(const Task &task, Chunk &chunk, int p, ShapeContacts &found) const;
  void add_forces(const Task &task, const Chunk &chunk, Reaction &reaction) const;
  void record_contacts(const Task &task) const;
  static void see_motion(const Task &task, int i, PointContact &point);
  static void see_vertices(const Task &task, PointContact &point);

  const ShapeTable &shapes;
  std::int64_t name;
  BodySurfaces surfaces;
  bool is_set = false;
  std::vector<Reaction> reactions;    ///< by chunk
};

}    // namespace Talus

#endif
