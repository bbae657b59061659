// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/shapes/shaped_particles.h"

#include "system/bodies/large_body.h"
#include "system/host/rows.h"
#include "system/step/granular_system.h"

#include "base/in_parallel.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

ShapedParticles::ShapedParticles(LAMMPS *lmp, GranularSystem &owner, Fix *command,
                                 ShapeTable table_of_types) :
    Pointers(lmp),
    system(owner), fix(command), shapes(std::move(table_of_types)), pairs_here(shapes),
    exchange(world)
{
  system.memory().add(*this);
  grow(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) begin(i);
}

ShapedParticles::~ShapedParticles()
{
  system.memory().remove(*this);
  memory->destroy(quat);
}

void ShapedParticles::set_sizes(int first, int last)
{
  for (int i = first; i < last; i++)
    if (const ParticleShape *shape = shapes.of(atom->type[i])) {
      atom->radius[i] = shape->shape().bounding_radius();
      atom->rmass[i] = shape->mass();
    }
}

void ShapedParticles::orient_new(int first, int last)
{
  for (int i = first; i < last; i++) {
    const ParticleShape *shape = shapes.of(atom->type[i]);
    if (shape && atom->tag[i] > 0 && !is_known(quat[i]))
      put(shape->new_orientation(atom->tag[i]), quat[i]);
  }
}

int ShapedParticles::set_orientation(tagint tag, const Eigen::Quaterniond &orientation)
{
  int count = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->tag[i] == tag && is_shaped(atom->type[i])) {
      put(orientation, quat[i]);
      count++;
    }
  orientations_were_set = true;
  return count;
}

/* ---- motion ---- */

bool ShapedParticles::moves(int i) const
{
  return is_shaped(atom->type[i]) && (atom->mask[i] & fix->groupbit);
}

/* Half of what the kick gives to velocities: of omega not what free rotation changes, for this is
   exact at the positions on both sides of a step. */

void ShapedParticles::keep_change(ChangeRecord &change, int i, const Load &load) const
{
  const double half = 0.5 * update->dt * force->ftm2v;
  const Vector3<double> v = (half / atom->rmass[i]) * load.force;
  const Vector3<double> omega =
      shapes.of(atom->type[i])
          ->rotation()
          .omega_of(quaternion(quat[i]), (half * atom->radius[i]) * load.torque);
  store(change, change_of(four(v.x, v.y, v.z, 0.0), four(omega.x, omega.y, omega.z, 0.0)));
}

void ShapedParticles::move(const ParticleState &particles, int i)
{
  const Load load = particles.load(i);
  if (ChangeRecord *change = particles.change(i)) keep_change(*change, i, load);
  const double dt = update->dt, kick = dt * force->ftm2v;
  const Vector3<double> v = particles.velocity(i) + (kick / atom->rmass[i]) * load.force;
  put(v, particles.v(i));
  put(particles.position(i) + dt * v, particles.x(i));
  Eigen::Quaterniond q = quaternion(quat[i]);
  Vector3<double> omega = particles.angular_velocity(i);
  shapes.of(atom->type[i])->rotation().advance(q, omega, force->ftm2v * load.torque, dt);
  put(q, quat[i]);
  put(omega, particles.w(i));
}

void ShapedParticles::move()
{
  const ParticleState particles = system.step().particles();
  in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++)
      if (moves(i)) move(particles, i);
  });
}

/* ---- questions ---- */

void ShapedParticles::for_each_triangle(const VisitTriangle &visit) const
{
  constexpr int pieces = 3;    // of an arc of 90 degrees
  std::vector<std::vector<Triangle>> of_type(shapes.last_type() + 1);
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    const ParticleShape *shape = shapes.of(type);
    if (!shape || !is_known(quat[i])) continue;
    if (of_type[type].empty()) of_type[type] = shape->shape().surface(pieces);
    const Pose pose = shape->pose(row(atom->x[i]), quaternion(quat[i]));
    for (const Triangle &one : of_type[type])
      visit(i, {{pose.point_in_space(one.corner[0]), pose.point_in_space(one.corner[1]),
                 pose.point_in_space(one.corner[2])}});
  }
}

DeepestContact ShapedParticles::deepest_contact() const
{
  DeepestContact deepest;
  const auto inside = [this](int i) {
    return shapes.radius_inside(atom->type[i], atom->radius[i]);
  };
  pairs_here.for_each_point([&](const ContactPoints::Pair &pair, const PointContact &point) {
    const int i = pair.first, j = pair.second;
    const double ratio = point.overlap / std::min(inside(i), inside(j));
    if (ratio > deepest.overlap_ratio) deepest = {ratio, i, j};
  });
  return deepest;
}

DeepestInBody ShapedParticles::deepest_in(const LargeBody &body) const
{
  const auto found = bodies.find(&body);
  if (found == bodies.end()) return {};
  const DeepestContact deepest = found->second.deepest_since_set();
  return {deepest.overlap_ratio, deepest.i, deepest.j};
}

}    // namespace Talus
