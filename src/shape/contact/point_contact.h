// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_CONTACT_POINT_CONTACT_H
#define TALUS_SHAPE_CONTACT_POINT_CONTACT_H

#include "base/vector3.h"
#include "history/contact_lists.h"
#include "laws/contact_energy.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace Talus {

/// History of a contact point, see HistoryValues: its laws have no resistance, and are of order 1.
inline constexpr int point_history_size = 8;
using PointHistory = std::array<double, point_history_size>;

/// One contact point of two bodies of which at least one is a shape, in the axes of space, on its
/// way through the laws.
struct PointContact {
  // geometry, see ShapeContact
  Vector3<double> place, normal;    ///< the normal leads from the second body to the first
  double overlap, weight, energy;
  double inverse_radius;    ///< 1/R_eff
  std::uint64_t name;       ///< with the surface of a large body in the upper half
  int part;                 ///< of a large body, see SurfaceContact; -1 if it has none
  bool is_named_by_place, begins_search;    ///< see ShapeContact
  /// From which the normal was sought; 0: none. Kept beside it, where it begins a search: a set-up finds the normal
  /// of the last step once more, from the same start.
  Vector3<double> start;

  // motion
  Vector3<double> velocity;    ///< of the first body less that of the second, at `place`
  double inverse_mass;         ///< 1/m_1 + 1/m_2
  int row;                     ///< of the table of laws
  /// If work is accounted for: what `velocity` lacks of that at the time of the positions.
  Vector3<double> velocity_change;

  PointHistory history;    ///< in and out

  // results, with the weight
  Vector3<double> force;    ///< on the first body, at `place`
  EnergyByCause work;       ///< if it is accounted for, see contact_work.h
};

/// What is kept of a point beside its name: the history, start and normal (0 where it begins no search).
inline constexpr int point_memory_size = point_history_size + 6;
void write_memory(const PointContact &point, double *to);
void read_memory(const double *from, PointContact &point);

/// Adds the history of a point to the list of a particle, and where it begins a search start and normal. false: there
/// is no such and all values are zero, as those of laws without history, and nothing was added: a point that is not
/// found there begins with zeros.
bool keep_history(const PointContact &point, int particle, std::int64_t partner, ContactLists &to);
/// Of the points of a particle with one surface those that are named by their place take the histories of the points
/// that had been nearest, each that of one: of `before`, all points of the particle with this large body.
void continue_at_places(PointContact *points, std::size_t count, const PointContact *before,
                        std::size_t count_before);
/// A point that has only a history so far, from such a list.
PointContact stored_point(const ContactLists::Contact &one);

}    // namespace Talus

#endif
