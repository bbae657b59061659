// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_CONTACT_BODY_LOAD_H
#define TALUS_BODY_CONTACT_BODY_LOAD_H

#include "base/exact_sum.h"
#include "base/vector3.h"

namespace Talus {

/// Load of the particles of one rank on the body: force, and torque about its reference point, in
/// space axes.
struct BodyLoad {
  Vector3<double> force{0.0, 0.0, 0.0}, torque{0.0, 0.0, 0.0};
  double contacts = 0.0;
  double heat = 0.0;    ///< that flows into the body (energy/time)

  void add(const BodyLoad &other)
  {
    force = force + other.force;
    torque = torque + other.torque;
    contacts += other.contacts;
    heat += other.heat;
  }
};

/// Force and torque without rounding, for bodies that move by them.
struct ExactLoad {
  ExactSum component[6];

  void clear()
  {
    for (ExactSum &c : component) c.clear();
  }
  void add(const Vector3<double> &force, const Vector3<double> &torque)
  {
    const double values[6] = {force.x, force.y, force.z, torque.x, torque.y, torque.z};
    for (int k = 0; k < 6; k++) component[k].add(values[k]);
  }
  void add(const ExactLoad &other)
  {
    for (int k = 0; k < 6; k++) component[k].add(other.component[k]);
  }
};

}    // namespace Talus

#endif
