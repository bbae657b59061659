// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Faces of two cores that overlap, projected along the direction from b to a, for the parts of the
// narrow phase.

#ifndef TALUS_SHAPE_CONVEX_FACE_PROJECTION_H
#define TALUS_SHAPE_CONVEX_FACE_PROJECTION_H

#include "shape/convex/core_pair.h"

#include <cmath>
#include <vector>

namespace Talus {

/// A point or a vector of the plane of projection.
struct Flat {
  double x, y;
};
inline Flat operator+(Flat a, Flat b)
{
  return {a.x + b.x, a.y + b.y};
}
inline Flat operator-(Flat a, Flat b)
{
  return {a.x - b.x, a.y - b.y};
}
inline Flat operator*(double factor, Flat a)
{
  return {factor * a.x, factor * a.y};
}
inline double dot(Flat a, Flat b)
{
  return a.x * b.x + a.y * b.y;
}
inline double cross(Flat a, Flat b)
{
  return a.x * b.y - a.y * b.x;
}
inline double square_of(Flat a)
{
  return dot(a, a);
}

/// Axes of the plane of projection, and its normal.
struct ProjectionFrame {
  Vector3<double> x, y, normal;
  explicit ProjectionFrame(const Vector3<double> &n);
  Flat projected(const Vector3<double> &v) const { return {dot(x, v), dot(y, v)}; }
  Vector3<double> in_space(Flat p, double height) const
  {
    return p.x * x + p.y * y + height * normal;
  }
};

/// A face in that plane: corners counterclockwise as seen against the normal, edge k from corner k
/// to the next one; `height` along the normal is a linear function.
struct ProjectedFace {
  std::vector<Flat> corner;
  std::vector<int> vertex, edge;
  double at_origin;
  Flat slope;
  double height(Flat p) const { return at_origin + dot(slope, p); }
  int num_corners() const { return static_cast<int>(corner.size()); }
  Flat next_corner(int k) const { return corner[k + 1 < num_corners() ? k + 1 : 0]; }
};

/// `pose`: of the core in the frame of the pair. The face must not be parallel to the normal.
void project(const ConvexCore &core, int face, const Pose &pose, const ProjectionFrame &frame,
             ProjectedFace &projected);

/// A corner of a polygon, and where the side comes from that begins there.
struct PolygonCorner {
  enum Side { OF_A, OF_B, CUT } side;
  Flat place;
  int edge;    ///< of a or of b
};

/// Keeps what is left of the line through `from` and `to`, which becomes a side. `buffer` is
/// overwritten.
void cut(std::vector<PolygonCorner> &polygon, std::vector<PolygonCorner> &buffer, Flat from,
         Flat to, PolygonCorner::Side side, int edge);

/// The polygon that faces of a and b have in common.
void common_polygon(const ProjectedFace &of_a, const ProjectedFace &of_b,
                    std::vector<PolygonCorner> &polygon, std::vector<PolygonCorner> &buffer);

}    // namespace Talus

#endif
