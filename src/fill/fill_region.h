// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Command fill_region: a region is packed with spheres that overlap by no more than a limit.
// doc/filling.md is the user's page.

#ifndef LMP_FILL_REGION_H
#define LMP_FILL_REGION_H

#include "command.h"
#include "fill/new_spheres.h"
#include "packing/size_distribution.h"

#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class RegionSpace;

class FillRegion : public Command {
 public:
  explicit FillRegion(LAMMPS *lmp) : Command(lmp) {}
  void command(int narg, char **arg) override;

 private:
  void parse(int narg, char **arg);
  int count_spheres(double volume) const;
  void require_room_for_shape() const;
  void enlarge_box(const std::vector<KnownSphere> &made);
  void require_room(const std::vector<double> &radii, double volume) const;
  std::vector<KnownSphere> pack(const RegionSpace &space, int count, double volume,
                                const std::vector<KnownSphere> &present);

  std::string region_id;
  int type = 1;
  double fraction = 0.0;
  int number = 0;
  Talus::SizeDistribution sizes;
  double density = 0.0, limit = 1.0e-3;
  std::uint64_t seed = 0;
  int most_steps = 100000;

  double reached = 0.0;    // largest overlap over the smaller radius
  int steps = 0;
};

}    // namespace LAMMPS_NS

#endif
