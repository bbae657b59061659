// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_body_surface.h"

#include "system/host/simulated_time.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;

namespace Talus {

namespace {

enum Field { NORMAL, SHEAR, FORCE = 4, HEAT = 7, WORK };

}    // namespace

LargeBodySurface::LargeBodySurface(LAMMPS *lmp, const LargeBodyShape &body_shape,
                                   const MeshShape *body_mesh, const BodySurfaceSpec &spec) :
    Pointers(lmp),
    shape(body_shape), mesh(body_mesh), given(spec)
{
  if (!given.with_loads) return;
  loads.assign(fields * size(), 0.0);
  loads_of_all = loads;
}

/* ---- loads ---------------------------------------------------------------------------------- */

void LargeBodySurface::add_step(double dt)
{
  if (!given.with_loads || (given.averages && dt == 0.0)) return;
  if (!given.averages || starts_new_sums) {
    for (int t = 0; t < size(); t++) std::fill_n(&loads[fields * t], WORK, 0.0);
    steps = 0;
  }
  starts_new_sums = false;
  steps++;
  for (const TouchedPart &p : parts) {
    double *load = &loads[fields * mesh->surface().own(p.part)];
    load[NORMAL] += p.normal_force;
    load[SHEAR] += p.shear.x;
    load[SHEAR + 1] += p.shear.y;
    load[SHEAR + 2] += p.shear.z;
    load[FORCE] += p.force.x;
    load[FORCE + 1] += p.force.y;
    load[FORCE + 2] += p.force.z;
    load[HEAT] += p.heat;
    load[WORK] += dt * p.shear_power;
  }
  reduced = false;
}

void LargeBodySurface::reduce()
{
  if (reduced) return;
  MPI_Allreduce(loads.data(), loads_of_all.data(), static_cast<int>(loads.size()), MPI_DOUBLE,
                MPI_SUM, world);
  reduced = true;
}

double LargeBodySurface::value(int t, int column)
{
  reduce();
  const double *load = &loads_of_all[fields * t];
  const double area = mesh->surface().area(t);
  if (column == 0) return share() * load[NORMAL] / area;
  if (column == 2) return load[WORK] / area;
  if (column == 3 && given.wear > 0.0) return given.wear * load[WORK] / area;
  if (column >= 3) return share() * load[HEAT] / area;
  const double *s = load + SHEAR;
  return share() * std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / area;
}

/* The sums of all ranks are kept by one. */

bool LargeBodySurface::take_over_sums()
{
  const std::size_t needed = loads.size();
  if (loads_of_all.size() != needed) {
    loads_of_all.assign(needed, 0.0);
    starts_new_sums = true;
    steps = 0;
    return false;
  }
  loads.assign(needed, 0.0);
  if (comm->me == 0) loads = loads_of_all;
  reduced = false;
  return true;
}

/* ---- pictures ------------------------------------------------------------------------------- */

std::vector<Triangle> LargeBodySurface::triangles_in_space(const BodyFrame &frame) const
{
  // the simulation box as the body sees it
  Eigen::AlignedBox3d visible;
  for (int corner = 0; corner < 8; corner++) {
    const Vector3<double> x{corner & 1 ? domain->boxhi[0] : domain->boxlo[0],
                            corner & 2 ? domain->boxhi[1] : domain->boxlo[1],
                            corner & 4 ? domain->boxhi[2] : domain->boxlo[2]};
    visible.extend(to_eigen(frame.point_to_body(x)));
  }
  std::vector<Triangle> triangles;
  shape.tessellate(visible, triangles);
  for (Triangle &t : triangles)
    for (Vector3<double> &p : t.corner) p = frame.point_to_space(p);
  return triangles;
}

int LargeBodySurface::image(const BodyFrame &frame, int *&kinds, double **&values)
{
  const std::vector<Triangle> all = triangles_in_space(frame);
  constexpr double type = 1.0;    // the color of its particles, if it is by type
  drawn.clear();
  for (std::size_t t = comm->me; t < all.size(); t += comm->nprocs) drawn.add(type, all[t]);
  return drawn.hand_out(kinds, values);
}

void LargeBodySurface::add_loads(VtkPolyData &picture, const BodyFrame &frame)
{
  const std::string names[] = {"pressure", "shear_stress", "shear_work",
                               given.wear > 0.0 ? "wear" : "heat_flux", "heat_flux"};
  reduce();
  starts_new_sums = true;
  const int count = comm->me == 0 ? size() : 0;
  for (int c = 0; c < columns(); c++) {
    VtkPolyData::Array &array = picture.add_cell_data(names[c], 1);
    for (int t = 0; t < count; t++) array.add(value(t, c));
  }
  VtkPolyData::Array &forces = picture.add_cell_data("force", 3);
  for (int t = 0; t < count; t++) {
    const double *f = &loads_of_all[fields * t + FORCE];
    const Vector3<double> force = frame.to_space(Vector3<double>{f[0], f[1], f[2]});
    for (const double component : {force.x, force.y, force.z}) forces.add(share() * component);
  }
}

VtkPolyData LargeBodySurface::picture(const BodyFrame &frame)
{
  VtkPolyData picture(VtkCells::TRIANGLES);
  if (given.with_loads) add_loads(picture, frame);
  if (comm->me) return picture;
  for (const Triangle &t : triangles_in_space(frame))
    for (const Vector3<double> &p : t.corner) picture.add_point(p);
  return picture;
}

void LargeBodySurface::write_picture(const BodyFrame &frame)
{
  const VtkPolyData all = picture(frame);
  if (comm->me) return;
  const std::string problem =
      all.write(utils::star_subst(given.file, update->ntimestep, 0), simulated_time(update));
  if (!problem.empty()) error->one(FLERR, "Fix large/body vtk: {}", problem);
}

double LargeBodySurface::memory_usage() const
{
  return static_cast<double>((loads.capacity() + loads_of_all.capacity()) * sizeof(double) +
                             parts.capacity() * sizeof(TouchedPart)) +
         (mesh ? mesh->memory_usage() : 0.0);
}

}    // namespace Talus
