// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_wall_gran_talus.h"

#include "comm.h"
#include "domain.h"
#if TALUS_HOST_DRAWS_GRAN_WALLS
#include "fix_wall.h"
#endif

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {
constexpr int worth_a_thread = 100;    // candidates
}    // namespace

/* LAMMPS adds the velocity of a cylinder that turns to that of the particle before. */

std::string FixWallGranTalus::what_only_stock_does() const
{
  if (is_cylinder() && wshear && axis != 2) return "it turns a cylinder: use fix wall/gran/region";
  return "";
}

void FixWallGranTalus::begin_run()
{
  batches.resize(comm->nthreads);
}

/* ---------------------------------------------------------------------- */

double FixWallGranTalus::radius_of_cylinder() const
{
#if TALUS_HOST_HAS_WALL_CYLINDER
  return cylradius;
#else
  return 0.0;
#endif
}

double FixWallGranTalus::phase() const
{
  return omega * static_cast<double>(update->ntimestep - time_origin) * dt;
}

/* The sums are in the order of LAMMPS: so they have its bits. */

void FixWallGranTalus::place()
{
  now[0] = lo;
  now[1] = hi;
  std::fill(velocity, velocity + 3, 0.0);
  if (wiggle) {
    const double arg = phase();
    if (wallstyle == axis) {
      now[0] = lo + amplitude - amplitude * cos(arg);
      now[1] = hi + amplitude - amplitude * cos(arg);
    }
    velocity[axis] = amplitude * omega * sin(arg);
  } else if (wshear) {
    velocity[axis] = vshear;
  }
}

double FixWallGranTalus::displacement() const
{
  if (!wiggle || wallstyle != axis) return 0.0;
  return amplitude - amplitude * cos(phase());
}

FixWallGranTalus::Gap FixWallGranTalus::gap(const double *x, double radius) const
{
  Gap result;
  if (!is_cylinder()) {
    const double above = x[wallstyle] - now[0], below = now[1] - x[wallstyle];
    result.part = above < below ? 0 : 1;
    result.d[wallstyle] = result.part ? -below : above;
    return result;
  }
  const double cylinder = radius_of_cylinder();
  const double r = sqrt(x[0] * x[0] + x[1] * x[1]), inwards = cylinder - r;
  if (inwards > radius) {
    result.d[2] = cylinder;
  } else {
    result.d[0] = -inwards / r * x[0];
    result.d[1] = -inwards / r * x[1];
    result.radius = r < cylinder ? -2 * cylinder : 2 * cylinder;
  }
  return result;
}

double FixWallGranTalus::distance(const double *x) const
{
  if (is_cylinder()) return std::abs(radius_of_cylinder() - std::sqrt(x[0] * x[0] + x[1] * x[1]));
  return std::min(std::abs(x[wallstyle] - now[0]), std::abs(now[1] - x[wallstyle]));
}

/* ---------------------------------------------------------------------- */

void FixWallGranTalus::clear_history(int i)
{
  if (use_history) std::fill(history_one[i], history_one[i] + size_history, 0.0);
}

/* A contact that goes on beyond zero overlap has begun before. */

void FixWallGranTalus::find_candidates(double moved)
{
  if (radii_vary()) {
    candidates.list_all(atom->nlocal, [this](int i) { return is_member(i); });
    return;
  }
  const ParticleState particles = system->particles();
  const bool beyond = touches_beyond_contact();
  candidates.list(
      atom->nlocal, neighbor->skin, moved, comm->nthreads,
      [&](const int *eight, double margin) {
        unsigned bits = 0;
        for (int k = 0; k < lanes; k++) {
          const int i = eight[k];
          const bool near = (beyond && history_one[i][0] != 0.0) ||
                            !(distance(particles.x(i)) >= particles.radius(i) + margin);
          if (is_member(i) && near) bits |= 1U << k;
        }
        return bits;
      },
      [&](int i) {
        if (is_member(i)) clear_history(i);
      });
  listed_at = displacement();
}

void FixWallGranTalus::add_contacts()
{
  place();
  const auto are_stale = [this](double moved) {
    return candidates.are_stale(moved, std::abs(displacement() - listed_at), atom->nlocal);
  };
  if (are_stale(system->moved_at_most()))
    if (const double moved = system->moved_since_rebuild(); are_stale(moved))
      find_candidates(moved);
  if (keeps_contacts()) clear_stored_contacts();
  find_wall_temperature();
  begin_account();
  const ParticleState particles = system->particles();
  const int threads =
      std::clamp(candidates.size() / worth_a_thread, 1, static_cast<int>(batches.size()));
  ranges.assign(threads, {0, 0});
  in_ranges(candidates.size(), threads, [&](int thread, int first, int last) {
    ranges[thread] = {first, last};
    begin(batches[thread]);
    add_contacts_of(batches[thread], particles, first, last);
  });
  for (int t = 0; t < threads; t++)
    if (ranges[t].first < ranges[t].second) system->account().add(batches[t].work);
}

void FixWallGranTalus::report_contacts()
{
  place();
  const ParticleState particles = system->particles();
  for (std::size_t t = 0; t < ranges.size(); t++) {
    if (ranges[t].first == ranges[t].second) continue;
    begin(batches[t]);
    add_contacts_of(batches[t], particles, ranges[t].first, ranges[t].second);
  }
}

void FixWallGranTalus::add_contacts_of(WallBatch &batch, const ParticleState &particles, int begin,
                                       int end)
{
  const bool beyond = touches_beyond_contact();
  constexpr int ahead = 8;
  for (int c = begin; c < end; c++) {
    if (c + ahead < end) particles.prefetch_position(particles.place(candidates.atoms[c + ahead]));
    const int i = candidates.atoms[c];
    const double radius = particles.radius(i);
    const Gap g = gap(particles.x(i), radius);
    const double squared = g.d[0] * g.d[0] + g.d[1] * g.d[1] + g.d[2] * g.d[2];
    double touch = radius;
    if (beyond && history_one[i][0] != 0.0) touch += wall_law.pulloff_distance(radius, g.radius);
    if (!(squared < touch * touch)) {
      if (candidates.touched[c]) clear_history(i);
      candidates.touched[c] = 0;
      continue;
    }
    candidates.touched[c] = 1;
    if (beyond) history_one[i][0] = 1;
    batch.add({i, g.d, std::sqrt(squared), radius, system->masses().of_body(i), g.radius, velocity,
               temperature_difference(i), use_history ? history_one[i] : nullptr, g.part});
    if (batch.is_full()) deliver(batch, particles);
  }
  deliver(batch, particles);
}

/* ---------------------------------------------------------------------- */

#if TALUS_HOST_DRAWS_GRAN_WALLS
int FixWallGranTalus::image(int *&objects, double **&parameters)
{
  if (reason_for_stock().empty()) {
    constexpr double far_away = 1.0e20;    // what LAMMPS sets for a plane that is not there
    int row = 0;
    place();
    for (const int side : {0, 1})
      if (std::abs(side ? hi : lo) != far_away)
        FixWall::update_image_plane(row++, 2 * wallstyle + side, now[side], imgparms, domain);
  }
  return FixWallGran::image(objects, parameters);
}
#endif
