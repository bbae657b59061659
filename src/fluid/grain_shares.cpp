// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/grain_shares.h"

#include <algorithm>
#include <utility>

namespace Talus {

bool GrainShares::Grain::operator==(const Grain &other) const
{
  return std::equal(x, x + 3, other.x) && radius == other.radius && in_fluid == other.in_fluid;
}

GrainShares::GrainShares(const FluidCells &of_fluid, std::size_t most) :
    cells(of_fluid), most_kept(most), first(1, 0), touched(of_fluid.size())
{
}

bool GrainShares::find(const Grain &grain)
{
  found++;
  if (cells.find_shares(grain.x, grain.radius, shares)) return true;
  shares.assign(1, {cells.nearest_to(grain.x), 1.0});
  return false;
}

void GrainShares::update(std::vector<Grain> now)
{
  if (now == grains) return;
  grains = std::move(now);
  touched.clear();
  slots.clear();
  weights.clear();
  first.assign(1, 0);
  outside = -1;
  for (std::size_t g = 0; g < grains.size(); g++) {
    if (grains[g].in_fluid) {
      if (!find(grains[g]) && outside < 0) outside = static_cast<int>(g);
      const bool kept = slots.size() + shares.size() <= most_kept;
      for (const FluidCells::Share &share : shares) {
        const int slot = touched.slot(share.cell);
        if (!kept) continue;
        slots.push_back(slot);
        weights.push_back(share.weight);
      }
    }
    first.push_back(slots.size());
  }
}

}    // namespace Talus
