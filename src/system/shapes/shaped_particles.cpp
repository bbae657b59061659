// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/shapes/shaped_particles.h"

#include "system/bodies/large_body.h"
#include "system/step/granular_system.h"

#include "base/in_parallel.h"
#include "base/lanes.h"
#include "base/rows.h"

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

/* Up to eight at a time: those of local index of_lane[k], k < count. */

void ShapedParticles::move(const ParticleState &particles, const int *of_lane, int count)
{
  const auto particle = [&](int k) { return of_lane[std::min(k, count - 1)]; };
  const auto inertia = [&](int k) -> const Inertia<double> & {
    return shapes.of(atom->type[particle(k)])->rotation().inertia();
  };
  const auto eight_quaternions = [](auto row_of) {
    const EightRows q = lanes_of([&](int k) { return Memory<Vec4>::load_anywhere(row_of(k)); });
    return Quaternion<Vec8>{q.number[0], q.number[1], q.number[2], q.number[3]};
  };
  Load loads[lanes];
  for (int k = 0; k < lanes; k++) loads[k] = particles.load(particle(k));
  for (int k = 0; k < count; k++)
    if (ChangeRecord *change = particles.change(particle(k)))
      keep_change(*change, particle(k), loads[k]);

  const double unit = force->ftm2v, dt = update->dt;
  const Vec8 kick =
      splat<Vec8>(dt * unit) / eight_numbers([&](int k) { return atom->rmass[particle(k)]; });
  const Vector3<Vec8> v = eight_vectors([&](int k) { return particles.velocity(particle(k)); }) +
                          kick * eight_vectors([&](int k) { return loads[k].force; });
  const Vector3<Vec8> x =
      eight_vectors([&](int k) { return particles.position(particle(k)); }) + splat<Vec8>(dt) * v;
  const Inertia<Vec8> body{eight_vectors([&](int k) { return inertia(k).inverse; }),
                           eight_vectors([&](int k) { return inertia(k).moments; }),
                           eight_quaternions([&](int k) { return &inertia(k).principal.w; })};
  Quaternion<Vec8> q = eight_quaternions([&](int k) { return quat[particle(k)]; });
  Vector3<Vec8> omega =
      eight_vectors([&](int k) { return particles.angular_velocity(particle(k)); });
  const Vector3<Vec8> torque =
      splat<Vec8>(unit) * eight_vectors([&](int k) { return loads[k].torque; });
  body.rotate(q, omega, body.angular_momentum(q, omega) + splat<Vec8>(dt) * torque, dt);

  for_each_of_eight(v, count, [&](int k, const auto &one) { put(one, particles.v(of_lane[k])); });
  for_each_of_eight(x, count, [&](int k, const auto &one) { put(one, particles.x(of_lane[k])); });
  for_each_of_eight(omega, count,
                    [&](int k, const auto &one) { put(one, particles.w(of_lane[k])); });
  Record turned[lanes];
  to_rows({{q.w, q.x, q.y, q.z}}, turned);
  for (int k = 0; k < count; k++) std::copy_n(turned[k].c, size_orientation, quat[of_lane[k]]);
}

void ShapedParticles::move()
{
  const ParticleState particles = system.step().particles();
  in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
    int of_lane[lanes], count = 0;
    for (int i = begin; i < end; i++) {
      if (!moves(i)) continue;
      of_lane[count++] = i;
      if (count == lanes) move(particles, of_lane, std::exchange(count, 0));
    }
    if (count) move(particles, of_lane, count);
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
