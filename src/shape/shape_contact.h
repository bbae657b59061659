// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where two bodies touch of which at least one is a particle with a shape.

#ifndef TALUS_SHAPE_SHAPE_CONTACT_H
#define TALUS_SHAPE_SHAPE_CONTACT_H

#include "base/vector3.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace Talus {

/// One of the points at which bodies a and b touch.
struct ShapeContact {
  Vector3<double> position;    ///< in space: half way between the two surfaces
  Vector3<double> normal;      ///< unit vector from b to a: repulsion pushes a along it
  double overlap;              ///< > 0
  /// Forces and torques of the law are multiplied by it, so that they are continuous where contact
  /// points merge. Of a vertex beside an edge contact it may be negative, see shared_energy.h; the
  /// force of all points together repels.
  double weight;
  /// What the contact stores over the energy of the law for this overlap; that of all points is the
  /// energy from which weights follow, if there is one. Else the weight.
  double energy = 1.0;
  /// Of the surfaces of a and b where they touch (1/length), or what stands for it. Laws have their
  /// sum as 1/R_eff; that of a large body counts as 0.
  double curvature[2] = {0.0, 0.0};
  /// Which parts touch, see contact_name(): the same in successive steps as long as the same parts
  /// touch, and different for all contacts of a pair. History is kept by it.
  std::uint32_t name;
  /// Of a mesh or vessel: which of its surfaces is touched, a second half of the name.
  std::uint32_t surface = 0;
  /// The name is a place_name(): that of the next step is the nearest one of the same surface.
  bool is_named_by_place = false;
  int part = 0;    ///< of a large body, see SurfaceContact
  /// The normal is kept with the history: from there the search of the next step begins. Contacts may depend on it
  /// by rounding.
  bool begins_search = false;
};

/// Parts by which a contact is named: a vertex of a, a vertex of b (on whatever of the other body),
/// an edge of each, or the bodies as wholes.
enum class ContactParts : std::uint32_t { VERTEX_OF_A, VERTEX_OF_B, EDGES, WHOLE };
inline std::uint32_t contact_name(ContactParts parts, int of_a, int of_b)
{
  return static_cast<std::uint32_t>(parts) << 30 | static_cast<std::uint32_t>(of_a) << 15 |
         static_cast<std::uint32_t>(of_b);
}
inline ContactParts parts_of(std::uint32_t name)
{
  return static_cast<ContactParts>(name >> 30);
}

/// The name of a place on a smooth surface that is touched by a smooth shape: by the direction (a unit vector in the
/// frame of the large body) in which it lies from the center of the shape, in 30 bits, on an octahedron.
inline std::uint32_t place_name(const Vector3<double> &direction)
{
  const double x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z),
               sum = x + y + z;
  const bool is_above = direction.z >= 0.0;    // the lower half is folded outward
  const double u = (is_above ? x : sum - y) / sum, v = (is_above ? y : sum - x) / sum;
  const auto code = [](double part, double sign) {
    return static_cast<int>((sign < 0.0 ? 1.0 - part : 1.0 + part) * 16383.0 + 0.5);
  };
  return contact_name(ContactParts::WHOLE, code(u, direction.x), code(v, direction.y));
}
/// That direction, of any length.
inline Vector3<double> direction_of_place(std::uint32_t name)
{
  const auto part = [](std::uint32_t code) { return static_cast<double>(code) / 16383.0 - 1.0; };
  const double u = part(name >> 15 & 0x7fffU), v = part(name & 0x7fffU),
               z = 1.0 - std::abs(u) - std::abs(v);
  if (z >= 0.0) return {u, v, z};
  return {u < 0.0 ? std::abs(v) - 1.0 : 1.0 - std::abs(v),
          v < 0.0 ? std::abs(u) - 1.0 : 1.0 - std::abs(u), z};
}

/// The name that a contact has when a and b are exchanged.
inline std::uint32_t exchanged_name(std::uint32_t name)
{
  const int of_a = name >> 15 & 0x7fffU, of_b = name & 0x7fffU;
  switch (parts_of(name)) {
  case ContactParts::VERTEX_OF_A:
    return contact_name(ContactParts::VERTEX_OF_B, of_b, of_a);
  case ContactParts::VERTEX_OF_B:
    return contact_name(ContactParts::VERTEX_OF_A, of_b, of_a);
  default:
    return contact_name(parts_of(name), of_b, of_a);
  }
}

/// What collide() fills; to be reused, so that no memory is allocated.
struct ShapeContacts {
  std::vector<ShapeContact> points;    ///< in an order that depends on poses only
  /// Cores of rounded bodies overlap: the overlap is larger than both radii, and the contacts do
  /// not follow continuously from those before. Worth a warning, with the depth (length) and what it
  /// is of the smaller rounding radius.
  bool cores_overlap = false;
  double core_depth = 0.0, core_ratio = 0.0;
  Vector3<double> start{0.0, 0.0, 0.0};    ///< of the request; 0: none

  void clear()
  {
    points.clear();
    cores_overlap = false;
    core_depth = core_ratio = 0.0;
  }
};

/// What is kept of a pair from step to step to find sooner that it does not touch. Results do not
/// depend on it, not even in the last bit: it need be neither sent nor saved.
struct SeparatingDirection {
  /// From b to a, in space; 0: not known. If bodies are exchanged: negative.
  Vector3<double> direction{0.0, 0.0, 0.0};
};

}    // namespace Talus

#endif
