// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of shapes on their way through the laws, the same kernels as those of spheres. A
// law sees the velocity of the two surfaces past each other at the point itself, and no rotation:
// its force acts at the point, where its owner finds the torques. R_eff is what the narrow phase
// says, m_eff = 1/(1/m_1 + 1/m_2).

#ifndef TALUS_SHAPE_CONTACT_POINT_BATCH_H
#define TALUS_SHAPE_CONTACT_POINT_BATCH_H

#include "body/contact/computed_contacts.h"
#include "material/law_table.h"
#include "shape/contact/point_contact.h"

#include <cstddef>
#include <string>

namespace Talus {

class PointBatch {
 public:
  PointBatch() { batch.clear(); }    // no lane may ever hold what is not finite

  struct Task {
    const LawTable &laws;
    double dt;
    bool advance;                            ///< false: histories are only read
    const WorkAccount *account = nullptr;    ///< given: finds the work of the points
  };
  /// Forces and histories of all points. What a point yields does not depend on the others.
  void compute(const Task &task, PointContact *points, std::size_t count);

  /// What compute() has left of a point, with the signs of its first body and in its axes: all that
  /// does not depend on the identity of the bodies.
  static ComputedContact contact_of(const PointContact &point);

  /// "" or why points of shapes cannot have this law, and the cure, as text for messages. Not asked
  /// about laws of second order, which no integrator may use then.
  static std::string refusal(const ContactLaw &law);

 private:
  void gather(const PointContact &point, int lane);
  void hand_out(PointContact &point, int lane) const;
  void flush();

  const Task *task = nullptr;
  int law_index = 0, filled = 0;
  bool has_history = false;
  PointContact *of_lane[ContactBatch::width] = {};
  ContactBatch batch;
};

}    // namespace Talus

#endif
