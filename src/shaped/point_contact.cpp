// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/point_contact.h"

#include <algorithm>

namespace Talus {

bool keep_history(const PointContact &point, int particle, std::int64_t partner, ContactLists &to)
{
  const PointHistory &history = point.history;
  if (std::all_of(history.begin(), history.end(), [](double v) { return v == 0.0; })) return false;
  std::copy(history.begin(), history.end(), to.add(particle, partner, point.name));
  return true;
}

PointContact stored_point(const ContactLists::Contact &one)
{
  PointContact point{};
  point.name = one.feature;
  std::copy_n(one.value, point_history_size, point.history.begin());
  return point;
}

}    // namespace Talus
