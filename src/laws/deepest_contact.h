// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_LAWS_DEEPEST_CONTACT_H
#define TALUS_LAWS_DEEPEST_CONTACT_H

namespace Talus {

/// Local indices of two particles, and their overlap over the smaller radius (of shapes, that of the
/// largest sphere inside); 0 without contacts.
struct DeepestContact {
  /// Deeper ones are noticed in every step: contact laws are those of small overlaps.
  static constexpr double watched = 0.1;

  double overlap_ratio = 0.0;
  int i = 0, j = 0;
  bool operator<(const DeepestContact &o) const { return overlap_ratio < o.overlap_ratio; }
};

/// The same of a particle and a part of a large body, over the radius of the particle.
struct DeepestInBody {
  double overlap_ratio = DeepestContact::watched;
  int particle = 0, part = 0;
};

}    // namespace Talus

#endif
