// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_wall_gran_region_talus.h"

#include "error.h"
#include "region.h"

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

bool FixWallGranRegionTalus::is_inside(const double *x)
{
  return in_frame ? RegionInFrame(*region, motion).match(x) : region->match(x[0], x[1], x[2]);
}

int FixWallGranRegionTalus::find_contacts(const double *x, double reach)
{
  return in_frame ? RegionInFrame(*region, motion).surface(x, reach)
                  : region->surface(x[0], x[1], x[2], reach);
}

/* Contacts that have begun may last beyond the radius. */

double FixWallGranRegionTalus::pulloff_distance_of(double radius)
{
  return touches_beyond_contact() ? radius + model->pulloff_distance(radius, 0.0) : radius;
}

/* Which of eight particles may be nearer to the surface than they reach with the margin. */

unsigned FixWallGranRegionTalus::near(const EightSpheres &spheres, double margin)
{
  constexpr double rounding = 1.000001;
  Vec8 reach = spheres.radius;
  if (touches_beyond_contact())
    reach = for_each_lane(reach, [this](double radius) { return pulloff_distance_of(radius); });
  return parts.near(spheres.position, splat<Vec8>(rounding) * (reach + splat<Vec8>(margin)));
}

/* A particle that is not near keeps its histories, as in LAMMPS, if it is not in the region, and
   has none if it is. */

void FixWallGranRegionTalus::clear_history(int i, const ParticleState &particles)
{
  if (use_history && ncontact[i] && is_inside(particles.x(i))) ncontact[i] = 0;
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
        const EightSpheres spheres = eight_spheres(particles, eight);
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
  listed_box = AxisBox(around, 2.0 * (pulloff_distance_of(radius) + neighbor->skin));
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
  const double moved = bounded ? system->moved_since_rebuild() : 0.0;
  const ParticleState particles = system->particles();
  if (candidates.are_stale(moved, displacement(), atom->nlocal)) find_candidates(moved, particles);
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
    const unsigned bits = bounded ? near(eight_spheres(particles, eight), 0.0) : 0xffU;
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
  const double *x = particles.x(i);
  if (!simple && !is_inside(x)) return;
  const int nc = find_contacts(x, pulloff_distance_of(particles.radius(i)));
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
             particles.v(i), velocity, particles.w(i), temperature_difference(i), history,
             contact.iwall, particles.change(i)});
  if (batch.is_full()) deliver(batch, particles);
}
