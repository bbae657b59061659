// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "packing/sphere_grid.h"

#include <cmath>

namespace Talus {
namespace {

constexpr int most_classes = 20;      // the last one has all that are smaller
constexpr int most_cells = 100000;    // along an edge: numbers of cells fit into keys

double part_of(const Vector3<double> &x, int d)
{
  return d == 0 ? x.x : d == 1 ? x.y : x.z;
}

}    // namespace

SphereGrid::SphereGrid(const GridBox &space, double largest, double near, std::size_t expected) :
    box(space), skin(near)
{
  for (int n = 0; n < most_classes; n++) {
    SizeClass cells{};
    cells.largest = std::ldexp(largest, -n);
    for (int d = 0; d < 3; d++) {
      const double length = part_of(box.hi, d) - part_of(box.lo, d);
      const double wanted = length / (2.0 * cells.largest + skin);
      cells.cells[d] = wanted < most_cells ? std::max(1, static_cast<int>(wanted)) : most_cells;
      cells.per_length[d] = cells.cells[d] / length;
    }
    classes.push_back(cells);
  }
  entries.reserve(expected);
  make_buckets(2 * expected);
}

/* Entries go to their buckets in the order in which they came. */

void SphereGrid::make_buckets(std::size_t least)
{
  int bits = 10;
  while (bits < 30 && (std::size_t(1) << bits) < least) bits++;
  shift = 64 - bits;
  first.assign(std::size_t(1) << bits, -1);
  for (std::size_t n = 0; n < entries.size(); n++) link(static_cast<int>(n));
}

void SphereGrid::link(int entry)
{
  int &head = first[bucket_of(entries[entry].key)];
  entries[entry].next = head;
  head = entry;
}

int SphereGrid::class_of(double radius) const
{
  int n = 0;
  while (n + 1 < most_classes && radius <= classes[n + 1].largest) n++;
  return n;
}

/* What is outside counts as in the cell at the edge; in a periodic direction as where its image is. */

int SphereGrid::cell_of(const SizeClass &cells, double at, int d) const
{
  const double place = std::floor((at - part_of(box.lo, d)) * cells.per_length[d]);
  const int last = cells.cells[d] - 1;
  if (box.periodic[d]) {
    const double inside = place - (last + 1) * std::floor(place / (last + 1));
    return inside > last ? 0 : static_cast<int>(inside);
  }
  return place < 0.0 ? 0 : place > last ? last : static_cast<int>(place);
}

/* Only cells that the reach touches. In a periodic direction from the first one on, which is in the
   box, to the last one, which may be behind it. */

void SphereGrid::range_of(const SizeClass &cells, const Vector3<double> &x, double reach,
                          int (&from)[3], int (&to)[3]) const
{
  constexpr double rounding = 1e-9;    // of an image's place, in cells
  for (int d = 0; d < 3; d++) {
    const double at = part_of(x, d) - part_of(box.lo, d), last = cells.cells[d] - 1;
    const double low = std::floor((at - reach) * cells.per_length[d] - rounding);
    const double high = std::floor((at + reach) * cells.per_length[d] + rounding);
    const bool all = box.periodic[d] && high - low >= last;
    if (!box.periodic[d] || all) {
      from[d] = all ? 0 : static_cast<int>(std::clamp(low, 0.0, last));
      to[d] = static_cast<int>(all ? last : std::clamp(high, 0.0, last));
    } else {
      const double periods = std::floor(low / (last + 1.0));
      from[d] = static_cast<int>(low - periods * (last + 1.0));
      to[d] = from[d] + static_cast<int>(high - low);
    }
  }
}

void SphereGrid::add(int number, const Vector3<double> &x, double radius)
{
  const int size_class = class_of(radius);
  SizeClass &cells = classes[size_class];
  cells.count++;
  const std::uint64_t key =
      key_of(size_class, cell_of(cells, x.x, 0), cell_of(cells, x.y, 1), cell_of(cells, x.z, 2));
  entries.push_back({key, number, -1});
  if (entries.size() > first.size())
    make_buckets(2 * entries.size());
  else
    link(static_cast<int>(entries.size()) - 1);
}

}    // namespace Talus
