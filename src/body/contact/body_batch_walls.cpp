// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What only walls of LAMMPS need: surfaces that move by themselves and are curved, contacts that are
// known by their parts, and heat.

#include "body/contact/body_batch.h"

#include <algorithm>

namespace Talus {
namespace {

constexpr int width = EightSpheres::width;
constexpr std::size_t ahead = 16;    // candidates whose positions are prefetched
static_assert(ahead + width <= BodyTask::spare);

}    // namespace

/* Those that are near, and those that have contacts, which may end. With several contacts LAMMPS looks
   no further than the radius, even for those that could last beyond zero overlap. */

void BodyBatch::look_at_eight_of_wall(std::size_t first, int low, int high)
{
  const int *const index = task->index + first;
  for (int k = 0; k < width; k++) task->view.prefetch_position(index[ahead + k]);
  load_spheres(index, low, high);
  const unsigned near = task->wall->surface.may_touch(spheres, false);
  for (int k = low; k < high; k++)
    if (near >> k & 1U) task->view.prefetch_for_contact(index[k]);
  for (int k = low; k < high; k++)
    if ((near >> k & 1U) || (task->with_history && task->history.count(first + k) > 0))
      look_at_wall(first + k);
}

void BodyBatch::look_at_wall(std::size_t c)
{
  const int k = static_cast<int>(c % width);
  const Vector3<double> x = task->view.position_at(task->index[c]);
  const double r = spheres.radius[k];
  const int count = task->wall->surface.find(x, r, found_on_wall, points_of_wall);
  if (count < 0) return;
  std::uint32_t slots[WallSurface::most_of_wall];
  if (task->with_history) task->history.continue_parts(c, found_on_wall, count, slots);
  for (int n = 0; n < count; n++) {
    set_point(filled, points_of_wall[n]);
    append(c, task->with_history ? slots[n] : 0, x, r, found_on_wall[n], {});
  }
}

void BodyBatch::set_all_points()
{
  if (const WallSurface::Point *all = task->wall->surface.everywhere()) {
    std::fill_n(wall_velocity[0], ContactBatch::width, all->velocity.x);
    std::fill_n(wall_velocity[1], ContactBatch::width, all->velocity.y);
    std::fill_n(wall_velocity[2], ContactBatch::width, all->velocity.z);
    std::fill_n(curvature, ContactBatch::width, all->curvature);
  }
}

/* Only outputs ask for parts where all points have the same velocity and curvature. */

void BodyBatch::take_points(unsigned bits)
{
  const bool same = task->wall->surface.everywhere() != nullptr;
  if (same && !task->record_contacts) return;
  for (int lane = filled; bits; bits &= bits - 1U, lane++) {
    const int k = __builtin_ctz(bits);
    const WallSurface::Point point = task->wall->surface.point(
        {spheres.center[0][k], spheres.center[1][k], spheres.center[2][k]});
    if (same)
      part_of_lane[lane] = point.part;
    else
      set_point(lane, point);
  }
}

void BodyBatch::set_point(int lane, const WallSurface::Point &point)
{
  wall_velocity[0][lane] = point.velocity.x;
  wall_velocity[1][lane] = point.velocity.y;
  wall_velocity[2][lane] = point.velocity.z;
  curvature[lane] = point.curvature;
  part_of_lane[lane] = point.part;
}

/* The velocity of the wall is that of the time of the positions. */

void BodyBatch::see_from_wall(Motion &m, int k) const
{
  m.velocity = m.velocity - Vector3<Vec8>{load8(&wall_velocity[0][k]), load8(&wall_velocity[1][k]),
                                          load8(&wall_velocity[2][k])};
  if (const double *const masses = task->wall->masses) {
    alignas(64) double mass[lanes];
    for (int q = 0; q < lanes; q++)
      mass[q] = masses[task->candidates.atom(candidate_of_lane[k + q])];
    m.inverse_mass = splat<Vec8>(1.0) / load8(mass);
  }
}

void BodyBatch::gather_temperatures()
{
  const WallStep &wall = *task->wall;
  for (int k = 0; k < filled; k++)
    batch.temperature_difference[k] =
        wall.wall_temperature - wall.temperature[task->candidates.atom(candidate_of_lane[k])];
}

void BodyBatch::add_heat()
{
  double *const heat_flow = task->wall->heat_flow;
  if (!heat_flow || !law.conducts_heat()) return;
  for (int k = 0; k < filled; k++)
    heat_flow[task->candidates.atom(candidate_of_lane[k])] += batch.heat_flow[k];
}

}    // namespace Talus
