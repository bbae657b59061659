// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/face_stiffness.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace Talus {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// What a corner of a face on that of another shape counts: of a rounded shape it is a contact of its
/// own, of a sharp one it has the angle by which the polygon turns there, over a right angle.
double weight_of_corner(const ConvexShape &shape, int face, int k)
{
  if (shape.radius() > 0.0) return 1.0;
  const ConvexCore &core = shape.core();
  const int n = core.num_corners(face);
  const int *corner = core.corners(face);
  const Vector3<double> here = core.vertex(corner[k]);
  const Vector3<double> in = here - core.vertex(corner[(k + n - 1) % n]);
  const Vector3<double> out = core.vertex(corner[(k + 1) % n]) - here;
  constexpr double right_angle = 1.57079632679489661923;
  return std::acos(std::clamp(dot(in, out) / (length(in) * length(out)), -1.0, 1.0)) / right_angle;
}

}    // namespace

FaceStiffness::FaceStiffness(const ConvexShape &shape)
{
  const ConvexCore &core = shape.core();
  const Eigen::Vector3d moments = shape.principal_moments() / shape.volume();
  const double share = std::min(1.0, most_faces / core.num_faces());
  const auto row = [&](const Vector3<double> &arm, const Vector3<double> &direction) {
    const Vector3<double> turn = cross(arm, direction);
    Vector6 its;
    its << direction.x, direction.y, direction.z, turn.x / std::sqrt(moments(0)),
        turn.y / std::sqrt(moments(1)), turn.z / std::sqrt(moments(2));
    return its;
  };
  for (int f = 0; f < core.num_faces(); f++) {
    Springs of_shapes, of_bodies;
    for (int k = 0; k < core.num_corners(f); k++) {
      const Vector3<double> n = core.normal(f);
      const Vector3<double> arm = core.vertex(core.corners(f)[k]) + shape.radius() * n;
      const Vector6 along = row(arm, n);
      const Matrix normal = along * along.transpose();
      Matrix tangential = -normal;
      for (const Vector3<double> axis :
           {Vector3<double>{1.0, 0.0, 0.0}, Vector3<double>{0.0, 1.0, 0.0},
            Vector3<double>{0.0, 0.0, 1.0}}) {
        const Vector6 any = row(arm, axis);
        tangential += any * any.transpose();
      }
      const double weight = weight_of_corner(shape, f, k);
      of_shapes.normal += weight * normal;
      of_shapes.tangential += weight * tangential;
      of_bodies.normal += normal;
      of_bodies.tangential += tangential;
    }
    for (auto [held, its] : {std::pair{&by_shapes, &of_shapes}, {&by_bodies, &of_bodies}}) {
      held->all.normal += share * its->normal;
      held->all.tangential += share * its->tangential;
      held->face.push_back(*its);
    }
  }
}

/* 0 if it is not above `below`, which no eigenvalue is if their sum is not. */

double FaceStiffness::Springs::largest(double kn, double kt, double below) const
{
  const Matrix sum = kn * normal + kt * tangential;
  if (sum.trace() <= below) return 0.0;
  return Eigen::SelfAdjointEigenSolver<Matrix>(sum, Eigen::EigenvaluesOnly).eigenvalues()(5);
}

double FaceStiffness::largest(double kn, double kt, const Held &held, double share)
{
  double most = share * held.all.largest(kn, kt, 0.0);
  for (const Springs &face : held.face) most = std::max(most, face.largest(kn, kt, most));
  return most;
}

}    // namespace Talus
