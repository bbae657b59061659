// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/fix_wall_gran_talus.h"

#include "domain.h"
#if TALUS_HOST_DRAWS_GRAN_WALLS
#include "fix_wall.h"
#endif

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

/* LAMMPS adds the velocity of a cylinder that turns to that of the particle before. */

std::string FixWallGranTalus::what_only_stock_does() const
{
  if (is_cylinder() && wshear && axis != 2) return "it turns a cylinder: use fix wall/gran/region";
  if (is_cylinder() && model->beyond_contact)
    return "contacts with its cylinder last beyond zero overlap: use fix wall/gran/region";
  return "";
}

const LargeBodyShape &FixWallGranTalus::begin_run()
{
  if (is_cylinder()) return cylinder;
  return planes;
}

double FixWallGranTalus::phase() const
{
  return omega * static_cast<double>(update->ntimestep - time_origin) * dt;
}

/* The sums are in the order of LAMMPS: so they have its bits. */

void FixWallGranTalus::place()
{
  double now[2] = {lo, hi}, velocity[3] = {0.0, 0.0, 0.0};
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
  const Vector3<double> v{velocity[0], velocity[1], velocity[2]};
#if TALUS_HOST_HAS_WALL_CYLINDER
  if (is_cylinder()) {
    cylinder.place(cylradius, v);
    return;
  }
#endif
  planes.place(wallstyle, now[0], now[1], v);
}

double FixWallGranTalus::gone() const
{
  return wiggle && wallstyle == axis ? amplitude - amplitude * cos(phase()) : 0.0;
}

double FixWallGranTalus::displacement() const
{
  return std::abs(gone() - listed_at);
}

int FixWallGranTalus::read(int i, int /*k*/, HistoryValues &values) const
{
  wall_law.read(history_one[i], values);
  return 0;
}

void FixWallGranTalus::clear(int i)
{
  std::fill(history_one[i], history_one[i] + size_history, 0.0);
}

void FixWallGranTalus::add(int i, int /*part*/, const HistoryValues &values)
{
  wall_law.write(values, history_one[i]);
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
        FixWall::update_image_plane(row++, 2 * wallstyle + side, planes.place_of(side), imgparms,
                                    domain);
  }
  return FixWallGran::image(objects, parameters);
}
#endif
