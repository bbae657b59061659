// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_wall_gran_region_talus.h"

#include "error.h"
#include "region.h"
#include "system/time_formula.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

void FixWallGranRegionTalus::begin_run()
{
  dynamic = region->dynamic_check();
  bounded = has_distance(*region) && !radii_vary();
  simple = bounded && !is_composite(*region);
  in_frame = dynamic && simple;
  parts = bounded ? RegionParts(*region) : RegionParts();
  span = PeriodicSpan(*region, *domain);
}

std::string FixWallGranRegionTalus::what_reads_arrays()
{
  if (!region->dynamic_check()) return "";
  const std::string variable = variable_that_may_read_particles(lmp, *region);
  return variable.empty()
             ? ""
             : "its region may move with particles: v_" + variable + " reads more than time";
}

double FixWallGranRegionTalus::displacement() const
{
  return dynamic && bounded ? parts.largest_displacement(listed_poses, listed_box) : 0.0;
}

bool FixWallGranRegionTalus::is_inside(const Vector3<double> &center)
{
  const Vector3<double> at = span.image_of(center);
  const double x[3] = {at.x, at.y, at.z};
  return in_frame ? RegionInFrame(*region, motion).match(x) : region->match(x[0], x[1], x[2]);
}

/* A center that is on the surface has no normal: that of a place beside it on the inner side. */

int FixWallGranRegionTalus::find_contacts(const Vector3<double> &center, double reach)
{
  const int count = contacts_at(center, reach);
  if (have_normals(count)) return count;
  const double aside = 1.0e-9 * reach;
  for (const double s : {aside, -aside}) {
    const Vector3<double> beside = center + s * Vector3<double>{1.0, 0.7, 0.4};
    if (!is_inside(beside)) continue;
    if (const int found = contacts_at(beside, reach); have_normals(found)) return found;
  }
  return 0;
}

int FixWallGranRegionTalus::contacts_at(const Vector3<double> &center, double reach)
{
  const Vector3<double> at = span.image_of(center);
  const double x[3] = {at.x, at.y, at.z};
  return in_frame ? RegionInFrame(*region, motion).surface(x, reach)
                  : region->surface(x[0], x[1], x[2], reach);
}

bool FixWallGranRegionTalus::have_normals(int count) const
{
  return std::all_of(region->contact, region->contact + count,
                     [](const Region::Contact &contact) { return contact.r > 0.0; });
}

/* Contacts that have begun may last beyond the radius. */

double FixWallGranRegionTalus::reach_of(double radius)
{
  return touches_beyond_contact() ? radius + model->pulloff_distance(radius, 0.0) : radius;
}

/* Which of eight particles may be nearer to the surface than they reach with the margin. */

unsigned FixWallGranRegionTalus::near(const SphereLanes &spheres, double margin)
{
  constexpr double rounding = 1.000001;
  Vec8 reach = spheres.radius;
  if (touches_beyond_contact())
    reach = for_each_lane(reach, [this](double radius) { return reach_of(radius); });
  reach = splat<Vec8>(rounding) * (reach + splat<Vec8>(margin));
  return span.is_empty() ? parts.near(spheres.position, reach)
                         : near_in_images(spheres.position, reach, margin > 0.0);
}

/* `later`: when it may be in another image. */

unsigned FixWallGranRegionTalus::near_in_images(const Vector3<Vec8> &x, Vec8 reach, bool later)
{
  unsigned bits = 0;
  for (int k = 0; k < lanes; k++) {
    const auto look = [&](const Vector3<double> &image) {
      bits |= parts.near(in_all_lanes<Vec8>(image), reach) & (1U << k);
    };
    const Vector3<double> position{x.x[k], x.y[k], x.z[k]};
    if (later)
      span.each_image(position, look);
    else
      look(span.image_of(position));
  }
  return bits;
}

/* A particle that is not near keeps its histories, as in LAMMPS, if it is not in the region, and
   has none if it is. */

void FixWallGranRegionTalus::clear_history(int i, const ParticleState &particles)
{
  if (use_history && ncontact[i] && is_inside(particles.position(i))) ncontact[i] = 0;
}

/* One thread: a region keeps the contacts that it finds. */

void FixWallGranRegionTalus::find_candidates(double moved, const ParticleState &particles)
{
  if (!bounded) {
    candidates.list_all(atom->nlocal, [this](int i) { return is_member(i); });
    return;
  }
  listed_poses = parts.poses();
  LanesOfBox around;
  Vec8 largest{};
  candidates.list(
      atom->nlocal, neighbor->skin, moved, 1,
      [&](const int *eight, double margin) {
        const SphereLanes spheres = sphere_lanes(particles, eight);
        around.add(spheres.position);
        largest = larger(largest, spheres.radius);
        unsigned members = 0;
        for (int k = 0; k < lanes; k++) members |= (is_member(eight[k]) ? 1U : 0U) << k;
        return near(spheres, margin) & members;
      },
      [&](int i) {
        if (is_member(i)) clear_history(i, particles);
      });
  double radius = 0.0;
  for (int k = 0; k < lanes; k++) radius = std::max(radius, largest[k]);
  listed_box = AxisBox(around, 2.0 * (reach_of(radius) + neighbor->skin));
}

void FixWallGranRegionTalus::begin_step()
{
  if (dynamic) {
    region->prematch();
    region->set_velocity();
    parts.place();
    if (in_frame) motion = RegionMotion(*region);
  }
  std::fill(velocity, velocity + 3, 0.0);
}

void FixWallGranRegionTalus::add_contacts()
{
  begin_step();
  find_wall_temperature();
  begin_account();
  const ParticleState particles = system->particles();
  const auto are_stale = [this](double moved) {
    return candidates.are_stale(moved, displacement(), atom->nlocal);
  };
  if (are_stale(bounded ? system->moved_at_most() : 0.0))
    if (const double moved = bounded ? system->moved_since_rebuild() : 0.0; are_stale(moved))
      find_candidates(moved, particles);
  if (keeps_contacts()) clear_stored_contacts();
  add_contacts_of_candidates(particles);
  system->account().add(batch.work);
}

void FixWallGranRegionTalus::report_contacts()
{
  begin_step();
  add_contacts_of_candidates(system->particles());
}

void FixWallGranRegionTalus::add_contacts_of_candidates(const ParticleState &particles)
{
  begin(batch);
  for (int c = 0; c < candidates.size(); c += lanes) {
    int eight[lanes];
    candidates.eight_from(c, eight);
    const unsigned bits = bounded ? near(sphere_lanes(particles, eight), 0.0) : 0xffU;
    for (int k = 0; k < lanes && c + lanes + k < candidates.size(); k++)
      particles.prefetch_position(particles.place(candidates.atoms[c + lanes + k]));
    for (unsigned rest = bits; rest; rest &= rest - 1U)
      particles.prefetch_for_contact(particles.place(eight[__builtin_ctz(rest)]));
    for (int k = 0; k < lanes && c + k < candidates.size(); k++)
      if (bits >> k & 1U)
        add_contacts_of(eight[k], particles);
      else
        clear_history(eight[k], particles);
  }
  deliver(batch, particles);
}

/* As in LAMMPS, only particles on the inner side are looked at. With a simple region what has
   contacts is there, unless its center is on the surface. */

void FixWallGranRegionTalus::add_contacts_of(int i, const ParticleState &particles)
{
  const Vector3<double> x = particles.position(i);
  if (!simple && !is_inside(x)) return;
  const int nc = find_contacts(x, reach_of(particles.radius(i)));
  const bool known = simple && nc > 0 && region->contact[0].r > 0.0;
  if (simple && !known && !is_inside(x)) return;
  if (nc > tmax) error->one(FLERR, "Too many wallgran/region contacts for one particle");
  if (use_history && !match_history(i, nc)) return;
  for (int ic = 0; ic < nc; ic++) add_contact(i, ic, particles);
}

/* Gives the contacts of a particle the histories that they had with the same walls. Returns whether
   there are any. */

bool FixWallGranRegionTalus::match_history(int i, int nc)
{
  if (nc == 0) {
    ncontact[i] = 0;
    return false;
  }
  if (nc > 1) {
    update_contacts(i, nc);
    return true;
  }
  c2r[0] = 0;
  const int iwall = region->contact[0].iwall;
  if (ncontact[i] == 0) {
    ncontact[i] = 1;
    walls[i][0] = iwall;
    std::fill(history_many[i][0], history_many[i][0] + size_history, 0.0);
  } else if (ncontact[i] > 1 || iwall != walls[i][0]) {
    update_contacts(i, nc);
  }
  return true;
}

/* LAMMPS computes the point of contact only if the region turns, but reads it if the region changes
   its shape. */

void FixWallGranRegionTalus::find_wall_velocity(const double *position, int ic)
{
  double x[3];
  std::copy_n(position, 3, x);
  const int varies = region->varshape;
  if (!region->rotateflag) region->varshape = 0;
  region->velocity_contact(velocity, x, ic);
  region->varshape = varies;
  const Region::Contact &contact = region->contact[ic];
  if (region->rotateflag || !varies || !contact.varflag) return;
  double point[3] = {x[0] - contact.delx, x[1] - contact.dely, x[2] - contact.delz};
  region->velocity_contact_shape(velocity, point);
}

void FixWallGranRegionTalus::add_contact(int i, int ic, const ParticleState &particles)
{
  const Region::Contact &contact = region->contact[ic];
  double *history = use_history ? history_many[i][c2r[ic]] : nullptr;
  const bool beyond = touches_beyond_contact();
  const double radius = particles.radius(i);
  double touch = radius;
  if (beyond && history[0] != 0.0) touch += wall_law.pulloff_distance(radius, contact.radius);
  if (!(contact.r * contact.r < touch * touch)) {
    if (history) std::fill(history, history + size_history, 0.0);
    return;
  }
  if (beyond) history[0] = 1;

  if (dynamic) find_wall_velocity(particles.x(i), ic);
  const double separation[3] = {contact.delx, contact.dely, contact.delz};
  batch.add({i, separation, contact.r, radius, system->masses().of_body(i), contact.radius,
             velocity, temperature_difference(i), history, contact.iwall});
  if (batch.is_full()) deliver(batch, particles);
}
