// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Triangles for Fix::image(), which dump image draws. LAMMPS fills those pixels of a triangle that are near enough to its
// first corner, by extents that are rounded: the last column or row of pixels may be missing, those on the border of two
// triangles may by rounding be in none, and surfaces have gaps there. So each triangle comes three times, with each of its
// corners first once, and is larger by what rounding can do.

#ifndef TALUS_SYSTEM_BODIES_IMAGE_TRIANGLES_H
#define TALUS_SYSTEM_BODIES_IMAGE_TRIANGLES_H

#include "body/shape/large_body_shape.h"

#include <vector>

namespace Talus {

class ImageTriangles {
 public:
  void clear() { values.clear(); }
  /// Seen from the side from which its corners go round counterclockwise. `type`: of particles, whose color it may have.
  void add(double type, const Triangle &triangle);
  /// One of another fix, as LAMMPS draws it: behind its type nine numbers.
  void add_row(double type, const double *row);
  /// What Fix::image() returns; until the next change.
  int hand_out(int *&kinds, double **&rows);

 private:
  std::vector<double> values;
  std::vector<int> image_kinds;
  std::vector<double *> image_rows;
};

}    // namespace Talus

#endif
