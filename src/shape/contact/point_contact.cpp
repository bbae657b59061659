// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/point_contact.h"

#include "base/rows.h"
#include "shape/shape_contact.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace Talus {

void write_memory(const PointContact &point, double *to)
{
  const Vector3<double> none{0.0, 0.0, 0.0};
  to = std::copy(point.history.begin(), point.history.end(), to);
  put(point.begins_search ? point.start : none, to);
  put(point.begins_search ? point.normal : none, to + 3);
}

void read_memory(const double *from, PointContact &point)
{
  std::copy_n(from, point_history_size, point.history.begin());
  point.start = row(from + point_history_size);
  point.normal = row(from + point_history_size + 3);
  point.begins_search = dot(point.normal, point.normal) > 0.0;
}

bool keep_history(const PointContact &point, int particle, std::int64_t partner, ContactLists &to)
{
  const PointHistory &history = point.history;
  const bool is_empty =
      std::all_of(history.begin(), history.end(), [](double v) { return v == 0.0; });
  if (is_empty && !point.begins_search) return false;
  double memory[point_memory_size];
  write_memory(point, memory);
  const int size = point.begins_search ? point_memory_size : point_history_size;
  std::copy_n(memory, size, to.add(particle, partner, point.name | ContactLists::of_shape, size));
  return true;
}

namespace {

bool is_same_surface(const PointContact &point, const PointContact &old)
{
  return point.name >> 32 == old.name >> 32 &&
         parts_of(static_cast<std::uint32_t>(old.name)) == ContactParts::WHOLE;
}

/// Cosine of the angle between the two places, as seen from the center of the particle.
double nearness(const PointContact &one, const PointContact &other)
{
  const Vector3<double> a = direction_of_place(static_cast<std::uint32_t>(one.name)),
                        b = direction_of_place(static_cast<std::uint32_t>(other.name));
  return dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
}

}    // namespace

void continue_at_places(PointContact *points, std::size_t count, const PointContact *before,
                        std::size_t count_before)
{
  struct Couple {
    double near;
    std::size_t point, old;
  };
  const auto each_couple = [&](auto visit) {
    for (std::size_t n = 0; n < count; n++)
      for (std::size_t k = 0; points[n].is_named_by_place && k < count_before; k++)
        if (is_same_surface(points[n], before[k])) visit(n, k);
  };
  std::size_t couples = 0;
  each_couple([&](std::size_t n, std::size_t k) {
    couples++;
    points[n].history = before[k].history;
  });
  if (couples < 2) return;
  std::vector<Couple> all;
  all.reserve(couples);
  each_couple([&](std::size_t n, std::size_t k) {
    all.push_back({nearness(points[n], before[k]), n, k});
    points[n].history = {};
  });
  std::sort(all.begin(), all.end(), [](const Couple &a, const Couple &b) {
    return a.near != b.near     ? a.near > b.near
           : a.point != b.point ? a.point < b.point
                                : a.old < b.old;
  });
  std::vector<char> has(count, 0), is_taken(count_before, 0);
  for (const Couple &best : all) {
    if (has[best.point] || is_taken[best.old]) continue;
    has[best.point] = is_taken[best.old] = 1;
    points[best.point].history = before[best.old].history;
  }
}

PointContact stored_point(const ContactLists::Contact &one)
{
  PointContact point{};
  point.name = one.feature & ~ContactLists::of_shape;
  double memory[point_memory_size] = {};
  std::copy_n(one.value, std::min(one.values, point_memory_size), memory);
  read_memory(memory, point);
  return point;
}

}    // namespace Talus
