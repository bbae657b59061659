// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/mass_properties.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr double pi = 3.14159265358979323846;

/// Integrals of 1, x, x x^T.
struct Moments {
  double volume = 0.0;
  Vector first = Vector::Zero();
  Matrix second = Matrix::Zero();

  /// Adds those of a part whose moments are about `place`.
  void add(double v, const Vector &m, const Matrix &s, const Vector &place)
  {
    volume += v;
    first += m + v * place;
    second += s + m * place.transpose() + place * m.transpose() + v * place * place.transpose();
  }
};

/// The simplex of `corners` about its first one: second moments of a simplex of n corners are
/// measure/(n (n + 1)) (sum_i x_i x_i^T + (sum x)(sum x)^T).
template <int n> void add_simplex(Moments &moments, double measure, const Vector (&corners)[n])
{
  Vector sum = Vector::Zero();
  Matrix squares = Matrix::Zero();
  for (const Vector &c : corners) {
    sum += c;
    squares += c * c.transpose();
  }
  moments.volume += measure;
  moments.first += measure / n * sum;
  moments.second += measure / (n * (n + 1.0)) * (squares + sum * sum.transpose());
}

/* ---- parts of a rounded polyhedron ----------------------------------------------------------- */

Vector corner_of(const ConvexCore &core, int f, int k)
{
  return to_eigen(core.vertex(core.corners(f)[k]));
}

void add_core(const ConvexCore &core, Moments &moments)
{
  for (int f = 0; f < core.num_faces(); f++)
    for (int k = 1; k + 1 < core.num_corners(f); k++) {
      const Vector x[4] = {Vector::Zero(), corner_of(core, f, 0), corner_of(core, f, k),
                           corner_of(core, f, k + 1)};
      add_simplex(moments, x[1].dot(x[2].cross(x[3])) / 6.0, x);
    }
}

/* A face and what is up to r above it: the polygon's moments, and those of 0 ... r along n. */

void add_prisms(const ConvexCore &core, double r, Moments &moments)
{
  for (int f = 0; f < core.num_faces(); f++) {
    const Vector n = to_eigen(core.normal(f));
    Moments polygon;
    for (int k = 1; k + 1 < core.num_corners(f); k++) {
      const Vector x[3] = {corner_of(core, f, 0), corner_of(core, f, k), corner_of(core, f, k + 1)};
      add_simplex(polygon, 0.5 * n.dot((x[1] - x[0]).cross(x[2] - x[0])), x);
    }
    const double area = polygon.volume;
    moments.volume += r * area;
    moments.first += r * polygon.first + r * r / 2.0 * area * n;
    moments.second +=
        r * polygon.second +
        r * r / 2.0 * (polygon.first * n.transpose() + n * polygon.first.transpose()) +
        r * r * r / 3.0 * area * n * n.transpose();
  }
}

/// The exterior angle of an edge, between the normals of its faces.
double rotation_by(const ConvexCore &core, int e)
{
  const Vector n0 = to_eigen(core.normal(core.edge(e).face[0])),
               n1 = to_eigen(core.normal(core.edge(e).face[1]));
  return std::atan2(n0.cross(n1).norm(), n0.dot(n1));
}

/* Sectors of a cylinder, about the middle of their edge: in the plane of `half`, the bisector of
   the normals, and `side`; the sector goes from -angle to angle. */

void add_edge_sectors(const ConvexCore &core, double r, Moments &moments)
{
  for (int e = 0; e < core.num_edges(); e++) {
    const Vector from = to_eigen(core.vertex(core.edge(e).vertex[0])),
                 to = to_eigen(core.vertex(core.edge(e).vertex[1])), along = to - from;
    const double size = along.norm(), angle = 0.5 * rotation_by(core, e);
    const Vector half =
        (to_eigen(core.normal(core.edge(e).face[0])) + to_eigen(core.normal(core.edge(e).face[1])))
            .normalized();
    const Vector side = along.cross(half) / size;
    const double volume = angle * r * r * size;
    const Matrix plane = r * r * r * r / 4.0 * size *
                         ((angle + 0.5 * std::sin(2.0 * angle)) * half * half.transpose() +
                          (angle - 0.5 * std::sin(2.0 * angle)) * side * side.transpose());
    const Vector first = 2.0 / 3.0 * std::sin(angle) * r * r * r * size * half;
    const Matrix line = volume / 12.0 * along * along.transpose();
    moments.add(volume, first, plane + line, 0.5 * (from + to));
  }
}

/* Sectors of the ball at the vertices. The normals n that belong to a vertex are a polygon on the
   unit sphere whose sides are arcs of great circles between the normals of faces. With nu, the unit
   vector along the sphere and out of the polygon, constant on a side, the theorem of Gauss for the
   tangential parts of constant vectors a, and of (a . n) b, gives
     integral n      = -1/2 sum of sides: angle nu
     integral n n^T  =  1/3 (1 area - sum of sides: (integral n ds) nu^T)
   and integral n ds = tan(angle/2) (n0 + n1). All of a side but the sign of nu belongs to an edge,
   so that edges can be gone through one by one; the area is what the angles of the faces leave of
   2 pi. */

void add_vertex_sectors(const ConvexCore &core, double r, Moments &moments)
{
  const int count = core.num_vertices();
  std::vector<double> area(count, 2.0 * pi);
  std::vector<Vector> first(count, Vector::Zero());
  std::vector<Matrix> second(count, Matrix::Zero());
  for (int f = 0; f < core.num_faces(); f++)
    for (int k = 0, m = core.num_corners(f); k < m; k++) {
      const Vector here = corner_of(core, f, k), a = corner_of(core, f, (k + 1) % m) - here,
                   b = corner_of(core, f, (k + m - 1) % m) - here;
      area[core.corners(f)[k]] -= std::atan2(a.cross(b).norm(), a.dot(b));
    }
  for (int e = 0; e < core.num_edges(); e++) {
    const ConvexCore::Edge &edge = core.edge(e);
    const Vector along = to_eigen(core.vertex(edge.vertex[1]) - core.vertex(edge.vertex[0]));
    const Vector sum = to_eigen(core.normal(edge.face[0]) + core.normal(edge.face[1]));
    const double angle = rotation_by(core, e);
    for (int end = 0; end < 2; end++) {
      // normals of a vertex are those along which no edge from it ascends
      const Vector nu = (end == 0 ? 1.0 : -1.0) * along.normalized();
      first[edge.vertex[end]] -= 0.5 * angle * nu;
      const Matrix side = std::tan(0.5 * angle) * sum * nu.transpose();
      second[edge.vertex[end]] -= side;
    }
  }
  for (int v = 0; v < count; v++) {
    const Matrix moment = (area[v] * Matrix::Identity() + second[v]) / 3.0;
    moments.add(r * r * r / 3.0 * area[v], r * r * r * r / 4.0 * first[v],
                std::pow(r, 5) / 10.0 * (moment + moment.transpose()), to_eigen(core.vertex(v)));
  }
}

}    // namespace

MassProperties mass_properties(const ConvexCore &core, double radius)
{
  Moments moments;
  add_core(core, moments);
  if (radius > 0.0) {
    add_prisms(core, radius, moments);
    add_edge_sectors(core, radius, moments);
    add_vertex_sectors(core, radius, moments);
  }
  MassProperties body;
  body.volume = moments.volume;
  body.center = moments.first / moments.volume;
  body.second_moment = moments.second - moments.volume * body.center * body.center.transpose();
  return body;
}

/* ---- principal axes -------------------------------------------------------------------------- */

namespace {

/* Where moments are equal any axes will do: the projections of the given ones are taken. The first
   of them is the one that has most of its length among these axes. */

void straighten(Matrix &axes, int from, int to)
{
  const Matrix space =
      axes.middleCols(from, to - from) * axes.middleCols(from, to - from).transpose();
  Matrix left = space;    // projection on what is not taken yet
  for (int k = from; k < to; k++) {
    int best = 0;
    for (int q = 1; q < 3; q++)
      if (left(q, q) > left(best, best) + 1.0e-6) best = q;
    const Vector axis = left.col(best).normalized();
    axes.col(k) = axis;
    left -= axis * axis.transpose();
  }
}

/* Each axis beside that of the frame it is nearest to, and in the same sense. */

PrincipalFrame in_order(const PrincipalFrame &found)
{
  int order[3] = {0, 1, 2}, best[3] = {0, 1, 2};
  double most = 0.0;
  do {
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += std::fabs(found.axes(k, order[k]));
    if (sum > most + 1.0e-6) {
      most = sum;
      std::copy(order, order + 3, best);
    }
  } while (std::next_permutation(order, order + 3));
  PrincipalFrame sorted;
  for (int k = 0; k < 3; k++) {
    const Vector axis = found.axes.col(best[k]);
    sorted.axes.col(k) = axis[k] < 0.0 ? Vector(-axis) : axis;
    sorted.moments[k] = found.moments[best[k]];
  }
  if (sorted.axes.determinant() < 0.0) {
    int least = 0;
    for (int k = 1; k < 3; k++)
      if (std::fabs(sorted.axes(k, k)) < std::fabs(sorted.axes(least, least))) least = k;
    sorted.axes.col(least) *= -1.0;
  }
  return sorted;
}

}    // namespace

PrincipalFrame principal_axes(const Matrix &inertia)
{
  constexpr double equal = 1.0e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(inertia);
  PrincipalFrame found{solver.eigenvectors(), solver.eigenvalues()};
  const double tolerance = equal * found.moments[2];
  for (int from = 0; from < 3;) {
    int to = from + 1;
    while (to < 3 && found.moments[to] - found.moments[to - 1] <= tolerance) to++;
    if (to - from > 1) straighten(found.axes, from, to);
    from = to;
  }
  return in_order(found);
}

}    // namespace Talus
