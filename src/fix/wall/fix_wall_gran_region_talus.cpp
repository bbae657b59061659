// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/fix_wall_gran_region_talus.h"

#include "domain.h"
#include "error.h"
#include "region.h"
#include "system/host/time_formula.h"

using namespace LAMMPS_NS;
using namespace Talus;

bigint FixWallGranRegionTalus::stock_size(const double *data) const
{
  const auto count = static_cast<std::int64_t>(ubuf(data[1]).i);
  return count >= 0 && count <= tmax ? 2 + count * (size_history + 1) : -1;
}

std::string FixWallGranRegionTalus::what_only_stock_does() const
{
  return region->tmax > LargeBodyShape::max_parts ? "its region has too many faces" : "";
}

std::string FixWallGranRegionTalus::what_reads_arrays()
{
  if (!region->dynamic_check()) return "";
  const std::string variable = variable_that_may_read_particles(lmp, *region);
  return variable.empty()
             ? ""
             : "its region may move with particles: v_" + variable + " reads more than time";
}

const LargeBodyShape &FixWallGranRegionTalus::begin_run()
{
  surface = std::make_unique<RegionShape>(RegionShape::MovedBy::ITSELF, *region, *domain);
  return *surface;
}

void FixWallGranRegionTalus::are_listed()
{
  if (surface->is_dynamic()) surface->are_listed(wall.bounds_of_search());
}

void FixWallGranRegionTalus::post_force(int vflag)
{
  AcceleratedWall::post_force(vflag);
  if (!surface || !surface->had_too_many_contacts()) return;
  error->one(
      FLERR,
      "Too many wallgran/region contacts for one particle: fix wall/gran/region {} has room for "
      "{} with region '{}'. A particle that fits between opposite faces needs fix large/body, "
      "which takes the deepest {}",
      id, region->tmax, idregion, LargeBodyShape::max_contacts);
}

void FixWallGranRegionTalus::write_restart(FILE *file)
{
  if (domain->get_region_by_id(idregion) != region)
    error->all(
        FLERR,
        "Fix wall/gran/region {}: region '{}' has been deleted or defined anew since the last run: "
        "let a run be set up before its state is saved",
        id, idregion);
  AcceleratedWall::write_restart(file);
}

int FixWallGranRegionTalus::read(int i, int k, HistoryValues &values) const
{
  wall_law.read(history_many[i][k], values);
  return walls[i][k];
}

void FixWallGranRegionTalus::add(int i, int part, const HistoryValues &values)
{
  const int k = ncontact[i]++;
  walls[i][k] = part;
  wall_law.write(values, history_many[i][k]);
}
