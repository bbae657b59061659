// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/face_stiffness.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace Talus {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
}    // namespace

FaceStiffness::FaceStiffness(const Shape &shape)
{
  const std::vector<HeldFace> faces = shape.held_faces();
  const Eigen::Vector3d moments = shape.principal_moments() / shape.volume();
  const double share = std::min(1.0, most_faces / static_cast<double>(faces.size()));
  const auto row = [&](const Vector3<double> &arm, const Vector3<double> &direction) {
    const Vector3<double> torque = cross(arm, direction);
    Vector6 column;
    column << direction.x, direction.y, direction.z, torque.x / std::sqrt(moments(0)),
        torque.y / std::sqrt(moments(1)), torque.z / std::sqrt(moments(2));
    return column;
  };
  for (const HeldFace &face : faces) {
    Springs of_shapes, of_bodies;
    for (const auto &[arm, weight] : face.points) {
      const Vector6 along = row(arm, face.normal);
      const Matrix normal = along * along.transpose();
      Matrix tangential = -normal;
      for (const Vector3<double> axis :
           {Vector3<double>{1.0, 0.0, 0.0}, Vector3<double>{0.0, 1.0, 0.0},
            Vector3<double>{0.0, 0.0, 1.0}}) {
        const Vector6 any = row(arm, axis);
        tangential += any * any.transpose();
      }
      of_shapes.normal += weight * normal;
      of_shapes.tangential += weight * tangential;
      of_bodies.normal += normal;
      of_bodies.tangential += tangential;
    }
    for (auto [held, springs] : {std::pair{&by_shapes, &of_shapes}, {&by_bodies, &of_bodies}}) {
      held->all.normal += share * springs->normal;
      held->all.tangential += share * springs->tangential;
      held->face.push_back(*springs);
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
