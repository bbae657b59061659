// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts between the owned particles with a shape and one large body, through the same laws as
// those of spheres. As there (body/contact/body_batch.h), everything is computed in the frame of
// the body, where it is at rest and histories turn with it.
//
//   at a rebuild   save() (if points are current), set_particles(), restore()
//   every step     compute()

#ifndef TALUS_SHAPED_WALL_POINTS_H
#define TALUS_SHAPED_WALL_POINTS_H

#include "base/state_exchange.h"
#include "body/contact/body_batch.h"
#include "body/contact/body_contacts.h"
#include "shaped/body_surfaces.h"
#include "shaped/point_batch.h"
#include "shaped/shape_table.h"
#include "shaped/shaped_view.h"

#include <memory>
#include <vector>

namespace Talus {

class WallPoints {
 public:
  WallPoints(const ShapeTable &shape_table, std::int64_t body_name) :
      shapes(shape_table), name(body_name)
  {
  }

  /// Local indices of the particles with a shape that the body acts on.
  void set_particles(const std::vector<int> &particles);
  /// From and to the lists of its particles, see point_contact.h.
  void restore(const ContactLists &from);
  void save(ContactLists &to) const;

  /// For snapshots, with the particles.
  void exchange_state(StateExchange &x) { x(particles, chunks); }

  /// Adds forces and torques; returns what the body bears.
  BodyLoad compute(const BodySurfaces &surfaces, const BodyFrame &frame, const ShapedView &view,
                   const LawTable &laws, const BodyStep &step);
  /// Since set_particles(), over the radius of the largest sphere inside of the particle.
  DeepestInBody deepest() const;
  double memory_usage() const;

 private:
  struct Chunk {
    int begin, end;    ///< of the particles
    std::vector<PointContact> points, before;
    std::vector<int> of_point, of_before;    ///< which particle, counted in the list
    ShapeContacts found;
    BodyLoad load;
    ExactLoad exact;
    std::vector<TouchedPart> touched;
    std::vector<TouchedCorners> corners;
    DeepestInBody deepest;
  };
  struct Task {
    const BodySurfaces &surfaces;
    const BodyFrame &frame;
    const ShapedView &view;
    const LawTable &laws;
    const BodyStep &step;
  };

  void find_points(const Task &task, Chunk &chunk, int n, std::size_t &old) const;
  void add_forces(const Task &task, Chunk &chunk) const;
  void account(WorkAccount &to) const;
  void record_contacts(const Task &task) const;
  static void see_vertices(const Task &task, PointContact &point);
  static Vector3<double> change_seen(const Task &task, int i, const Vector3<double> &place);

  const ShapeTable &shapes;
  std::int64_t name;
  std::vector<int> particles;
  std::vector<Chunk> chunks;
  std::vector<std::unique_ptr<PointBatch>> batches;    ///< by thread
};

}    // namespace Talus

#endif
