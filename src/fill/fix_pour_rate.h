// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix pour/rate: a stream of spheres, or of particles with a shape, into a region at a given mass
// rate. doc/filling.md is the user's page. That its name begins with that of LAMMPS' fix pour tells
// pair styles that particles will come, and to ask extract() how large they are.

#ifndef LMP_FIX_POUR_RATE_H
#define LMP_FIX_POUR_RATE_H

#include "fill/new_spheres.h"
#include "packing/size_distribution.h"
#include "packing/sphere_grid.h"

#include "fix.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class RegionSpace;

class FixPourRate : public Fix {
 public:
  FixPourRate(LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void pre_exchange() override;
  /// Poured mass, particles, and mass that is behind the rate.
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void *extract(const char *, int &) override;

 private:
  double mass_of(double diameter) const;
  bool is_over() const { return total > 0.0 && poured >= total; }
  void require_countable(const RegionSpace &space) const;
  std::vector<KnownSphere> find_places(const RegionSpace &space);
  bool is_free(const KnownSphere &sphere, const std::vector<KnownSphere> &others,
               const Talus::SphereGrid &grid) const;
  void create(const std::vector<KnownSphere> &spheres);
  void warn_if_behind();
  template <class Exchange> void exchange_state(Exchange &x);

  int type;
  std::string region_id;
  double rate = 0.0, density = 0.0, total = 0.0;
  Talus::Vector3<double> velocity{0.0, 0.0, 0.0};
  Talus::SizeDistribution sizes;
  int attempts = 100;
  double largest_radius = 0.0;
  double shape_mass = 0.0;    // of a particle of the type, in this run; 0: they are spheres

  // the state, which restart files have; the same on all ranks
  Talus::RandomNumbers random{0};
  double next_diameter = 0.0, due = 0.0, poured = 0.0, count = 0.0;
  bool warned = false;
};

}    // namespace LAMMPS_NS

#endif
