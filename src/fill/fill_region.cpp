// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fill/fill_region.h"

#include "fill/region_space.h"
#include "packing/random_packing.h"
#include "system/host/command_words.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "irregular.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr double four_thirds_pi = 4.18879020478639098462;

double cube(double a)
{
  return a * a * a;
}

}    // namespace

void FillRegion::parse(int narg, char **arg)
{
  Words words = command_words(lmp, "fill_region", narg, arg);
  region_id = words.text("region-ID");
  type = words.integer("type", 1);
  if (type > atom->ntypes)
    words.fail(1, "there are " + std::to_string(atom->ntypes) + " types of atoms");
  if (words.choice("amount", {"fraction", "number"}) == 0)
    fraction = words.between("solid fraction", 0.0, 1.0, true);
  else
    number = words.integer("number of spheres", 1);
  while (!words.at_end()) {
    switch (words.choice("keyword", {"diameter", "density", "seed", "overlap", "steps"})) {
    case 0:
      sizes.parse(words);
      break;
    case 1:
      density = words.positive("density");
      break;
    case 2:
      seed = words.integer("seed", 1);
      break;
    case 3:
      limit = words.between("overlap over the smaller radius", 0.0, 1.0, true);
      break;
    default:
      most_steps = words.integer("steps", 1);
    }
  }
  if (!sizes.is_set()) words.text("diameter");
  if (density == 0.0) words.text("density");
  if (seed == 0) words.text("seed");
}

void FillRegion::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR, "fill_region before the simulation box is defined: put it after create_box, "
                      "read_data or read_restart");
  if (!atom->radius_flag || !atom->rmass_flag || !atom->tag_enable)
    error->all(FLERR, "fill_region requires atom attributes radius and rmass, and IDs: use "
                      "'atom_style sphere'");
  parse(narg, arg);
  require_room_for_shape();
  const RegionSpace space(lmp, "fill_region", region_id);
  const double volume = space.volume();
  const int count = count_spheres(volume);
  const std::vector<KnownSphere> present = spheres_in_box(lmp, space.lo, space.hi);
  const std::vector<KnownSphere> made = pack(space, count, volume, present);
  double solid = 0.0;
  for (const KnownSphere &sphere : made) solid += four_thirds_pi * cube(sphere.radius);
  if (reached > limit)
    error->all(
        FLERR,
        "fill_region: {} spheres, a solid fraction of {:.4f} of region '{}', do not fit: the "
        "largest overlap is {:.3g} of the smaller radius after {} steps, the limit {:.3g}. "
        "Ask for fewer spheres or allow more overlap{}",
        count, solid / volume, region_id, reached, steps, limit,
        steps == most_steps ? " or more steps" : "");
  create_spheres(lmp, made, type, density);
  enlarge_box(made);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "fill_region: {} spheres in region {}, solid fraction {:.6g} of its volume "
                   "{:.6g}, largest overlap {:.3g} of the smaller radius after {} steps\n",
                   count, region_id, solid / volume, volume, reached, steps);
}

void FillRegion::require_room_for_shape() const
{
  const ShapedParticles *const shapes = GranularSystem::of(lmp)->shapes();
  const double needed = shapes ? 2.0 * shapes->table().bounding_radius(type) : 0.0;
  if (sizes.smallest() < needed * (1.0 - 1.0e-6))
    error->all(FLERR,
               "fill_region: particles of type {} have a shape, and the sphere around it has a "
               "diameter of {:.8g}, more than the {:.8g} given: give it a diameter of {:.8g}",
               type, needed, sizes.smallest(), needed * (1.0 + 1.0e-6));
}

/* Beyond faces that are shrink-wrapped, by no more than is needed: other commands may want the rest of it before the first
   run. Particles may be of ranks far away then. */

void FillRegion::enlarge_box(const std::vector<KnownSphere> &made)
{
  bool larger = false;
  for (const KnownSphere &sphere : made) {
    const double x[3] = {sphere.x.x, sphere.x.y, sphere.x.z};
    for (int d = 0; d < 3; d++) {
      const bool below = domain->boundary[d][0] >= 2 && x[d] < domain->boxlo[d],
                 above = domain->boundary[d][1] >= 2 && x[d] >= domain->boxhi[d];
      if (below) domain->boxlo[d] = x[d] - sphere.radius;
      if (above) domain->boxhi[d] = x[d] + sphere.radius;
      larger = larger || below || above;
    }
  }
  if (!larger) return;
  domain->set_global_box();
  domain->set_local_box();
  Irregular(lmp).migrate_atoms(1);
}

int FillRegion::count_spheres(double volume) const
{
  if (!(volume > 0.0)) error->all(FLERR, "fill_region: region '{}' has no volume", region_id);
  if (number) return number;
  const double count = std::round(sizes.count_of(fraction * volume));
  if (count < 1.0)
    error->all(FLERR, "fill_region: less than one sphere in region '{}' of volume {:.6g}",
               region_id, volume);
  if (count > 1.0e8)
    error->all(FLERR, "fill_region: {:.4g} spheres are more than this command is made for", count);
  return static_cast<int>(count);
}

/* Spheres that are smaller by the overlap that is allowed do not overlap. The volume is measured on a
   grid, and what is far beyond it is asked for by mistake. */

void FillRegion::require_room(const std::vector<double> &radii, double volume) const
{
  constexpr double far_beyond = 1.5;
  double solid = 0.0;
  for (const double r : radii) solid += four_thirds_pi * cube(r);
  if (cube(1.0 - limit) * solid > far_beyond * volume)
    error->all(
        FLERR,
        "fill_region: {} spheres, a solid fraction of {:.4g} of region '{}', cannot fit: ask "
        "for fewer or smaller spheres",
        radii.size(), solid / volume, region_id);
}

/* One rank does it, for all. */

std::vector<KnownSphere> FillRegion::pack(const RegionSpace &space, int count, double volume,
                                          const std::vector<KnownSphere> &present)
{
  RandomNumbers random(seed);
  const std::vector<double> diameters = sizes.diameters(count, random);
  std::vector<double> radii;
  for (const double d : diameters) radii.push_back(0.5 * d);
  require_room(radii, volume);
  std::vector<Vector3<double>> places(count), fixed;
  if (comm->me == 0) {
    std::vector<double> fixed_radii;
    for (const KnownSphere &sphere : present) {
      fixed.push_back(sphere.x);
      fixed_radii.push_back(sphere.radius);
    }
    RandomPacking packing(space, radii, fixed, fixed_radii);
    packing.pack(random, limit, most_steps);
    places = packing.places();
    reached = packing.largest_overlap();
    steps = packing.steps();
  }
  MPI_Bcast(&reached, 1, MPI_DOUBLE, 0, world);
  MPI_Bcast(&steps, 1, MPI_INT, 0, world);
  for (int from = 0; from < count; from += 10000000)    // in messages that MPI can count
    MPI_Bcast(&places[from], 3 * std::min(10000000, count - from), MPI_DOUBLE, 0, world);
  std::vector<KnownSphere> made;
  for (int k = 0; k < count; k++) made.push_back({places[k], radii[k]});
  return made;
}
