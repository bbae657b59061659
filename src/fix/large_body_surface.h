// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The surface of a large body as triangles: pictures, files for ParaView, and what each triangle of
// a mesh bears. Words `pressure`, `wear` and `vtk` of fix large/body.
//
// Wear is that of Finnie's model of a cutting grain (Wear 3, 1960, 87-103): what a tangential force
// F_t cuts on a way s of a ductile surface has the volume integral of F_t ds/(psi p), with the flow
// pressure p of the surface and the ratio psi of contact to cutting depth. So the depth is the work
// of the tangential force by area times a coefficient k = c/(psi p), c the fraction of grains that
// cut.

#ifndef TALUS_FIX_LARGE_BODY_SURFACE_H
#define TALUS_FIX_LARGE_BODY_SURFACE_H

#include "base/state_exchange.h"
#include "base/words.h"
#include "body/contact/body_batch.h"
#include "body/motion/body_state.h"
#include "body/shape/mesh_shape.h"
#include "fix/image_triangles.h"
#include "vtk/poly_data.h"

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class LargeBodySurface : protected Pointers {
 public:
  LargeBodySurface(LAMMPS *lmp, Talus::LargeBodyShape &shape);

  /// `pressure yes|no|average`, `wear k` or `vtk N file`, if that is the next word.
  bool parse(Talus::Words &words);

  /// Loads of triangles are asked for; how many there are.
  bool records() const { return with_loads; }
  int size() const { return mesh ? mesh->surface().num_own() : 0; }
  /// 0: no pictures.
  int picture_interval() const { return interval; }

  /// Filled by the contacts of a step, then taken up by add_step(); dt 0 while a run is set up.
  std::vector<Talus::TouchedPart> *touched() { return &parts; }
  void add_step(double dt);

  /// Pressure and shear stress in the last step, or their means over the steps since the last
  /// picture; shear work per area since the start; depth of wear. All ranks.
  int columns() const { return wear > 0.0 ? 4 : 3; }
  double value(int triangle, int column);

  /// For dump image. Every rank gives its share of the triangles.
  int image(const Talus::BodyFrame &frame, int *&kinds, double **&values);
  /// For ParaView, with the loads of the triangles. All ranks; rank 0 gets all of it.
  Talus::VtkPolyData picture(const Talus::BodyFrame &frame);
  void write_picture(const Talus::BodyFrame &frame);

  /// Shear work of all ranks, for restart files; read_work() begins at values[first].
  void append_work(std::vector<double> &values);
  void read_work(const std::vector<double> &values, int first);

  /// For snapshots: what triangles have borne.
  void exchange_state(Talus::StateExchange &x)
  {
    x(loads, loads_of_all, reduced, starts_new_sums, steps);
  }

  double memory_usage() const;

 private:
  std::vector<Talus::Triangle> triangles_in_space(const Talus::BodyFrame &frame) const;
  void keep_loads();
  void reduce();
  void add_loads(Talus::VtkPolyData &picture, const Talus::BodyFrame &frame);
  double share() const { return averages && steps > 0 ? 1.0 / steps : 1.0; }

  const Talus::LargeBodyShape &shape;
  const Talus::MeshShape *mesh;    // nullptr: another shape
  bool with_loads = false;
  bool averages = false;          // loads are sums over `steps` steps
  bool starts_new_sums = true;    // they are in a picture: the next step begins new sums
  int steps = 0;
  double wear = 0.0;    // coefficient, 1/pressure
  int interval = 0;
  std::string file;

  std::vector<Talus::TouchedPart> parts;
  // by triangle, of this rank: normal force, shear force (3), force on the body (3), shear work;
  // and of all ranks; vectors in the frame of the body
  static constexpr int fields = 8;
  std::vector<double> loads, loads_of_all;
  bool reduced = false;

  Talus::ImageTriangles drawn;
};

}    // namespace LAMMPS_NS

#endif
