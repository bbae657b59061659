// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How stiffly a body is held that touches others with its faces: by a spring at each corner of
// each face, normal and tangential. With the Jacobian J of the motion of the contact points the
// squares of the frequencies are the eigenvalues of M^-1 J^T k J (translation and rotation together).

#ifndef TALUS_SHAPE_FACE_STIFFNESS_H
#define TALUS_SHAPE_FACE_STIFFNESS_H

#include "shape/shape.h"

#include <Eigen/Core>
#include <vector>

namespace Talus {

class FaceStiffness {
 public:
  /// More neighbors than these cannot touch a body with their faces: of a shape with more faces
  /// each counts less, but where one alone holds the body better than all of them so.
  static constexpr double most_faces = 12.0;

  explicit FaceStiffness(const Shape &shape);

  /// Mass of the body times the square of the highest frequency, if other shapes hold all faces by
  /// springs of stiffness kn and kt (>= 0) at a corner: 24 kn of a cube without kt.
  double largest(double kn, double kt) const { return largest(kn, kt, by_shapes, 1.0); }
  /// The same if large bodies hold half of them, as those of a box in a corner of three planes, or
  /// one of them. There each corner of a sharp shape is a contact of its own.
  double largest_on_bodies(double kn, double kt) const { return largest(kn, kt, by_bodies, 0.5); }

 private:
  using Matrix = Eigen::Matrix<double, 6, 6>;
  struct Springs {    // for unit mass and stiffness
    Matrix normal = Matrix::Zero(), tangential = Matrix::Zero();
    double largest(double kn, double kt, double below) const;
  };
  struct Held {
    Springs all;
    std::vector<Springs> face;
  };
  static double largest(double kn, double kt, const Held &held, double share);

  Held by_shapes, by_bodies;
};

}    // namespace Talus

#endif
