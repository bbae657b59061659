// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The surface of a large body as triangles: pictures, files for ParaView, and what each triangle of
// a mesh bears, as BodySurfaceSpec says.
//
// Wear is that of Finnie's model of a cutting grain (Wear 3, 1960, 87-103): what a tangential force
// F_t cuts on a way s of a ductile surface has the volume integral of F_t ds/(psi p), with the flow
// pressure p of the surface and the ratio psi of contact to cutting depth. So the depth is the work
// of the tangential force by area times a coefficient k = c/(psi p), c the fraction of grains that
// cut.

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_SURFACE_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_SURFACE_H

#include "body/contact/body_batch.h"
#include "body/motion/body_state.h"
#include "body/shape/mesh_shape.h"
#include "system/bodies/image_triangles.h"
#include "system/bodies/large_body_spec.h"
#include "vtk/poly_data.h"

#include "pointers.h"

#include <string>
#include <vector>

namespace Talus {

class LargeBodySurface : protected LAMMPS_NS::Pointers {
 public:
  /// `mesh`: the shape, if it is one. Both must live as long as this.
  LargeBodySurface(LAMMPS_NS::LAMMPS *lmp, const LargeBodyShape &shape, const MeshShape *mesh,
                   const BodySurfaceSpec &spec);

  /// Loads of triangles are asked for; how many there are.
  bool records() const { return given.with_loads; }
  int size() const { return mesh ? mesh->surface().num_own() : 0; }
  /// 0: no pictures.
  int picture_interval() const { return given.interval; }

  /// Filled by the contacts of a step, then taken up by add_step(); dt 0 while a run is set up.
  std::vector<TouchedPart> *touched() { return &parts; }
  void add_step(double dt);

  /// Pressure and shear stress in the last step, or their means over the steps since the last
  /// picture; shear work per area since the start; depth of wear; heat flow per area, as the pressure. All ranks.
  int columns() const { return 3 + (given.wear > 0.0 ? 1 : 0) + (given.with_heat ? 1 : 0); }
  double value(int triangle, int column);

  /// For dump image. Every rank gives its share of the triangles.
  int image(const BodyFrame &frame, int *&kinds, double **&values);
  /// For ParaView, with the loads of the triangles. All ranks; rank 0 gets all of it.
  VtkPolyData picture(const BodyFrame &frame);
  void write_picture(const BodyFrame &frame);

  /// What triangles have borne. Before a restart file is written: reduce(), collective. After one was read:
  /// false if it has not that of these triangles, which begins at zero then.
  template <class Exchange> void exchange_state(Exchange &x)
  {
    if constexpr (Exchange::of_each_rank) x(loads, reduced);
    x(loads_of_all, starts_new_sums, steps);
  }
  void reduce();
  bool take_over_sums();

  double memory_usage() const;

 private:
  std::vector<Triangle> triangles_in_space(const BodyFrame &frame) const;
  void add_loads(VtkPolyData &picture, const BodyFrame &frame);
  double share() const { return given.averages && steps > 0 ? 1.0 / steps : 1.0; }

  const LargeBodyShape &shape;
  const MeshShape *mesh;    // nullptr: another shape
  BodySurfaceSpec given;
  bool starts_new_sums = true;    // they are in a picture: the next step begins new sums
  int steps = 0;                  // of the sums

  std::vector<TouchedPart> parts;
  // by triangle, of this rank: normal force, shear force (3), force on the body (3), heat flow, shear work;
  // and of all ranks; vectors in the frame of the body
  static constexpr int fields = 9;
  std::vector<double> loads, loads_of_all;
  bool reduced = false;

  ImageTriangles drawn;
};

}    // namespace Talus

#endif
