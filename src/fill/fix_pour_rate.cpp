// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fill/fix_pour_rate.h"

#include "base/state_numbers.h"
#include "fill/region_space.h"
#include "system/host/command_words.h"
#include "system/host/restart_data.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

FixPourRate::FixPourRate(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->tag_enable)
    error->all(FLERR, "fix pour/rate requires atom attributes radius and rmass, and IDs: use "
                      "'atom_style sphere'");
  Words words = command_words(lmp, "fix pour/rate", narg, arg, 3);
  nevery = words.integer("N", 1);
  type = words.integer("type", 1);
  if (type > atom->ntypes)
    words.fail(1, "there are " + std::to_string(atom->ntypes) + " types of atoms");
  region_id = words.text("region-ID");
  rate = words.positive("mass rate");
  int seed = 0;
  while (!words.at_end()) {
    switch (
        words.choice("keyword", {"diameter", "density", "seed", "velocity", "attempts", "mass"})) {
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
      velocity = words.vector("velocity");
      break;
    case 4:
      attempts = words.integer("attempts", 1);
      break;
    default:
      total = words.positive("mass");
    }
  }
  if (!sizes.is_set()) words.text("diameter");
  if (density == 0.0) words.text("density");
  if (seed == 0) words.text("seed");
  const RegionSpace space(lmp, "fix pour/rate", region_id);

  random = RandomNumbers(seed);
  next_diameter = sizes.quantile(random.uniform());
  largest_radius = 0.5 * sizes.largest();
  vector_flag = 1;
  size_vector = 3;
  extvector = 0;
  global_freq = 1;
  restart_global = time_depend = 1;
  force_reneighbor = 1;
  next_reneighbor = update->ntimestep + 1;
}

int FixPourRate::setmask()
{
  return FixConst::PRE_EXCHANGE;
}

void FixPourRate::init()
{
  const RegionSpace space(lmp, "fix pour/rate", region_id);
  warned = false;
  const ShapedParticles *const shapes = GranularSystem::of(lmp)->shapes();
  shape_mass = shapes && shapes->is_shaped(type) ? shapes->table().of(type)->mass() : 0.0;
  if (is_over()) return;
  // also after runs without this fix, or with another step count
  if (next_reneighbor <= update->ntimestep || next_reneighbor > update->ntimestep + nevery)
    next_reneighbor = update->ntimestep + 1;
}

static double volume_of(double diameter)
{
  return 0.52359877559829887308 * diameter * diameter * diameter;
}

/* Of a particle with a shape the diameter is that of the sphere around it. */

double FixPourRate::mass_of(double diameter) const
{
  return shape_mass > 0.0 ? shape_mass : density * volume_of(diameter);
}

void FixPourRate::pre_exchange()
{
  if (next_reneighbor != update->ntimestep) return;
  due += rate * (nevery * update->dt);
  const RegionSpace space(lmp, "fix pour/rate", region_id);
  require_countable(space);
  create(find_places(space));
  warn_if_behind();
  next_reneighbor = is_over() ? 0 : update->ntimestep + nevery;
}

/* What is behind the rate and finds no place does not count. */

void FixPourRate::require_countable(const RegionSpace &space) const
{
  constexpr double most = 1.0e7;
  const double mean_density = shape_mass > 0.0 ? shape_mass / volume_of(sizes.smallest()) : density;
  const double volume = std::min(due / mean_density, space.volume_between_corners());
  if (volume < most * volume_of(sizes.smallest())) return;
  const double number = sizes.count_of(volume);
  if (number > most)
    error->all(FLERR,
               "fix pour/rate {}: {:.3g} particles are due at a time, a mass of {:.4g}: this is "
               "more than this command is made for, look for a wrong unit in the mass rate, the "
               "diameter or the density, or take a smaller N",
               id, number, mean_density * volume);
}

/* The same on all ranks: they know the same spheres and draw the same numbers. */

std::vector<KnownSphere> FixPourRate::find_places(const RegionSpace &space)
{
  std::vector<KnownSphere> known = spheres_in_box(lmp, space.low_corner(), space.high_corner()),
                           made;
  double largest = largest_radius;
  for (const KnownSphere &one : known) largest = std::max(largest, one.radius);
  SphereGrid grid(space.box(), largest, 0.0, known.size());
  for (std::size_t n = 0; n < known.size(); n++)
    grid.add(static_cast<int>(n), known[n].x, known[n].radius);
  while (due >= 0.5 * mass_of(next_diameter) && !is_over()) {
    KnownSphere sphere{{}, 0.5 * next_diameter};
    bool placed = false;
    for (int k = 0; k < attempts && !placed; k++) {
      sphere.x = space.draw(random);
      placed = space.holds(sphere.x, sphere.radius) && is_free(sphere, known, grid);
    }
    if (!placed) break;
    grid.add(static_cast<int>(known.size()), sphere.x, sphere.radius);
    known.push_back(sphere);
    made.push_back(sphere);
    due -= mass_of(next_diameter);
    poured += mass_of(next_diameter);
    next_diameter = sizes.quantile(random.uniform());
  }
  return made;
}

bool FixPourRate::is_free(const KnownSphere &sphere, const std::vector<KnownSphere> &others,
                          const SphereGrid &grid) const
{
  const auto touches = [&](const KnownSphere &other) {
    const Vector3<double> between = sphere.x - other.x;
    double d[3] = {between.x, between.y, between.z};
    for (int k = 0; k < 3; k++)
      if (domain->periodicity[k]) d[k] -= domain->prd[k] * std::round(d[k] / domain->prd[k]);
    const double touch = sphere.radius + other.radius;
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < touch * touch;
  };
  bool free = true;
  for (int n = 0; n < grid.num_classes() && free; n++)
    grid.visit_near(n, sphere.x, sphere.radius, [&](int k) { free = free && !touches(others[k]); });
  return free;
}

void FixPourRate::create(const std::vector<KnownSphere> &spheres)
{
  if (spheres.empty()) return;
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  const int first = create_spheres(lmp, spheres, type, density);
  for (int i = first; i < atom->nlocal; i++) {
    atom->mask[i] |= groupbit;
    atom->v[i][0] = velocity.x;
    atom->v[i][1] = velocity.y;
    atom->v[i][2] = velocity.z;
  }
  count += static_cast<double>(spheres.size());
  if (box_grows_too_fast(lmp))
    error->all(FLERR,
               "fix pour/rate {}: the box grows too fast for this number of ranks along it, to "
               "reach the region: use "
               "'boundary' with m in the place of s, so that it stays as large as it is defined, "
               "or 'processors'",
               id);
}

void FixPourRate::warn_if_behind()
{
  const double usual = rate * nevery * update->dt + mass_of(2.0 * largest_radius);
  if (warned || due < 10.0 * usual) return;
  warned = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "fix pour/rate {}: a mass of {:.4g} finds no place: the region is too small or "
                   "particles do not leave it fast enough",
                   id, due);
}

double FixPourRate::compute_vector(int n)
{
  return n == 0 ? poured : n == 1 ? count : due;
}

void *FixPourRate::extract(const char *what, int &of_type)
{
  if (strcmp(what, "radius") != 0) return nullptr;
  static double none = 0.0;
  return of_type == type ? &largest_radius : &none;
}

/* ---- restart -------------------------------------------------------------------------------- */

static constexpr int restart_format = 3;

template <class Exchange> void FixPourRate::exchange_state(Exchange &x)
{
  x(random.state, next_diameter, due, poured, count, next_reneighbor);
}

void FixPourRate::write_restart(FILE *file)
{
  if (comm->me) return;
  std::vector<double> numbers;
  StateNumbers writing(numbers);
  exchange_state(writing);
  write_restart_data_of_fix(file, restart_format, numbers.data(), numbers.size() * sizeof(double));
}

void FixPourRate::restart(char *buffer)
{
  const std::vector<double> numbers =
      restart_data_of_fix(lmp, std::string("fix pour/rate ") + id, restart_format, buffer);
  StateNumbers reading(numbers.data(), numbers.data() + numbers.size());
  exchange_state(reading);
}
