// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A shape of one's own for fix large/body: a ring, touched from outside.
//
// In this folder:
//
//   g++ -O3 -march=native -ffp-contract=off -shared -fPIC -I../../src torus.cpp -o torus.so
//
//   fix ring all large/body custom ./torus.so 8  0 0 0  0 0 1  2.0 0.4  contact ...
//
// Arguments: center (3), axis (3), radius of the ring, radius of its wire.

#include "body/shape/custom_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using Talus::SurfaceContact;
using Vector = Talus::Vector3<double>;

class Torus : public Talus::LargeBodyShape {
 public:
  Torus(const Vector &center, const Vector &axis, double ring, double wire) :
      center(center), axis(axis), ring(ring), wire(wire)
  {
  }

  bool touches(const Vector &x, double radius, SurfaceContact &contact) const override
  {
    const Vector away = from_wire(x);
    const double distance = std::sqrt(dot(away, away));
    // no contact from the middle line of the wire, where no direction leads out
    if (distance >= wire + radius || distance == 0.0) return false;
    contact.normal = 1.0 / distance * away;
    contact.overlap = wire + radius - distance;
    contact.part = 0;
    return true;
  }

  double distance_bound(const Vector &x) const override
  {
    const Vector away = from_wire(x);
    return std::max(0.0, std::sqrt(dot(away, away)) - wire);
  }

  Vector reference_point() const override { return center; }

 private:
  /// From the nearest point of the middle line of the wire.
  Vector from_wire(const Vector &x) const
  {
    const Vector d = x - center;
    const Vector flat = d - dot(d, axis) * axis;
    const double rho = std::sqrt(dot(flat, flat));
    return rho > 0.0 ? d - ring / rho * flat : d - Vector{ring, 0.0, 0.0};
  }

  Vector center, axis;
  double ring, wire;
};

}    // namespace

TALUS_MAKE_SHAPE(int narg, const char *const *arg, char *problem, int size)
{
  double v[8];
  if (narg != 8) {
    std::snprintf(problem, size, "a torus has 8 arguments, not %d", narg);
    return nullptr;
  }
  for (int k = 0; k < 8; k++) {
    char *end;
    v[k] = std::strtod(arg[k], &end);
    if (*end == '\0' && std::isfinite(v[k])) continue;
    std::snprintf(problem, size, "'%s' is not a number", arg[k]);
    return nullptr;
  }
  const Vector axis{v[3], v[4], v[5]};
  const double length = std::sqrt(dot(axis, axis));
  if (!(length > 0.0) || !(v[7] > 0.0) || !(v[6] > v[7])) {
    std::snprintf(problem, size, "expected an axis, and ring radius > wire radius > 0");
    return nullptr;
  }
  return new Torus({v[0], v[1], v[2]}, 1.0 / length * axis, v[6], v[7]);
}
