// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/image_triangles.h"

#include "system/host/lammps_compat.h"

namespace Talus {

static constexpr std::size_t size_row = 10;    // type, corners

/* LAMMPS lights the side from which corners go round clockwise. */

void ImageTriangles::add(double type, const Triangle &triangle)
{
  constexpr double larger = 1.0e-6;
  const Vector3<double> *const p = triangle.corner;
  const Vector3<double> middle = (1.0 / 3.0) * (p[0] + p[1] + p[2]);
  for (const int first : {0, 1, 2}) {
    values.push_back(type);
    for (const int corner : {first, (first + 2) % 3, (first + 1) % 3}) {
      const Vector3<double> x = p[corner] + larger * (p[corner] - middle);
      values.insert(values.end(), {x.x, x.y, x.z});
    }
  }
}

void ImageTriangles::add_row(double type, const double *row)
{
  values.push_back(type);
  values.insert(values.end(), row + 1, row + size_row);
}

int ImageTriangles::hand_out(int *&kinds, double **&rows)
{
  const std::size_t count = values.size() / size_row;
  image_kinds.assign(count, TALUS_IMAGE_TRIANGLE);
  image_rows.clear();
  for (std::size_t k = 0; k < count; k++) image_rows.push_back(&values[size_row * k]);
  kinds = image_kinds.data();
  rows = image_rows.data();
  return static_cast<int>(count);
}

}    // namespace Talus
