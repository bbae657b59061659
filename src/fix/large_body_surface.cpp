// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_surface.h"

#include "system/present_time.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

enum Field { NORMAL, SHEAR, FORCE = 4, WORK = 7 };

}    // namespace

LargeBodySurface::LargeBodySurface(LAMMPS *lmp, LargeBodyShape &body_shape) :
    Pointers(lmp), shape(body_shape), mesh(body_shape.as_mesh())
{
}

bool LargeBodySurface::parse(Words &words)
{
  if (words.take("pressure")) {
    words.about("pressure");
    const int choice = words.choice("value", {"yes", "no", "average"});
    if (!mesh) words.fail(2, "only the triangles of a mesh are looked at one by one");
    averages = choice == 2;
    if (choice != 1) keep_loads();
    return true;
  }
  if (words.take("wear")) {
    words.about("wear");
    wear = words.positive("coefficient k");
    if (!mesh) words.fail(2, "only the triangles of a mesh are looked at one by one");
    keep_loads();
    return true;
  }
  if (words.take("vtk")) {
    words.about("vtk");
    interval = words.integer("interval N", 1);
    file = words.text("file");
    if (file.find('*') == std::string::npos)
      words.fail(1, "the name of the file needs a * for the time step");
    if (file.size() < 4 || file.compare(file.size() - 4, 4, ".vtp") != 0)
      words.fail(1, "the name of the file must end in .vtp");
    return true;
  }
  return false;
}

/* ---- loads ---------------------------------------------------------------------------------- */

void LargeBodySurface::keep_loads()
{
  with_loads = true;
  loads.assign(fields * size(), 0.0);
  loads_of_all = loads;
}

void LargeBodySurface::add_step(double dt)
{
  if (!with_loads || (averages && dt == 0.0)) return;
  if (!averages || starts_new_sums) {
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
  if (column == 3) return wear * load[WORK] / area;
  const double *s = load + SHEAR;
  return share() * std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / area;
}

void LargeBodySurface::append_work(std::vector<double> &values)
{
  if (!with_loads) return;
  reduce();
  for (int t = 0; t < size(); t++) values.push_back(loads_of_all[fields * t + WORK]);
}

void LargeBodySurface::read_work(const std::vector<double> &values, int first)
{
  if (!with_loads || comm->me) return;    // the sum over ranks is kept by one
  if (static_cast<int>(values.size()) != first + size()) {
    error->warning(FLERR,
                   "Fix large/body: the restart file has no shear work of these triangles: it "
                   "begins at zero");
    return;
  }
  for (int t = 0; t < size(); t++) loads[fields * t + WORK] = values[first + t];
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
  static const char *const names[] = {"pressure", "shear_stress", "shear_work", "wear"};
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
  if (with_loads) add_loads(picture, frame);
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
      all.write(utils::star_subst(file, update->ntimestep, 0), present_time(update));
  if (!problem.empty()) error->one(FLERR, "Fix large/body vtk: {}", problem);
}

double LargeBodySurface::memory_usage() const
{
  return static_cast<double>((loads.capacity() + loads_of_all.capacity()) * sizeof(double) +
                             parts.capacity() * sizeof(TouchedPart)) +
         (mesh ? mesh->memory_usage() : 0.0);
}
