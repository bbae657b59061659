// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/neighbor_search.h"

#include "base/in_parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace Talus {
namespace {

constexpr int width = 16;
constexpr std::size_t usual = 16;    // neighbors in the row of a sphere, or less
using Floats = VectorOf<float, width>;
using Ints = VectorOf<std::int32_t, width>;

}    // namespace

/* Places beyond the outermost cells, which only rounding makes, belong to these; those below 0 are
   rounded up to it, or stay below. */

int NeighborSearch::Grid::cell(double place, int d) const
{
  return std::clamp(static_cast<int>(place * per_place[d]), 0, cells[d] - 1);
}

/* Of the places and sizes of all spheres. */

struct NeighborSearch::Extent {
  static constexpr double far = std::numeric_limits<double>::infinity();
  double low[3] = {far, far, far}, high[3] = {-far, -far, -far};
  double sum = 0.0, largest = 0.0;    // of radii
  double check = 0.0;                 // not a number if any position is not

  void add(const double *x, int d)
  {
    low[d] = std::min(low[d], *x);
    high[d] = std::max(high[d], *x);
    check += 0.0 * *x;
  }
  /// Of several spheres. Four of them fill three vectors.
  void add_all(const double *x, const double *radius, int count)
  {
    Vec4 lows[3], highs[3], checks[3] = {}, sums{}, most{};
    for (int part = 0; part < 3; part++) {
      lows[part] = splat<Vec4>(far);
      highs[part] = splat<Vec4>(-far);
    }
    int a = 0;
    for (; a + 4 <= count; a += 4) {
      for (int part = 0; part < 3; part++) {
        const Vec4 four_of = Memory<Vec4>::load_anywhere(x + 3L * a + 4L * part);
        lows[part] = select(four_of < lows[part], four_of, lows[part]);
        highs[part] = larger(four_of, highs[part]);
        checks[part] = checks[part] + splat<Vec4>(0.0) * four_of;
      }
      const Vec4 radii = Memory<Vec4>::load_anywhere(radius + a);
      sums = sums + radii;
      most = larger(radii, most);
    }
    for (int k = 0; k < 12; k++) {
      low[k % 3] = std::min(low[k % 3], lows[k / 4][k % 4]);
      high[k % 3] = std::max(high[k % 3], highs[k / 4][k % 4]);
      check += checks[k / 4][k % 4];
    }
    for (int k = 0; k < 4; k++) {
      sum += sums[k];
      largest = std::max(largest, most[k]);
    }
    for (; a < count; a++) {
      for (int d = 0; d < 3; d++) add(x + 3L * a + d, d);
      sum += radius[a];
      largest = std::max(largest, radius[a]);
    }
  }
  void join(const Extent &other)
  {
    for (int d = 0; d < 3; d++) {
      low[d] = std::min(low[d], other.low[d]);
      high[d] = std::max(high[d], other.high[d]);
    }
    sum += other.sum;
    largest = std::max(largest, other.largest);
    check += other.check;
  }
};

/* Sums over blocks of spheres, so that they do not depend on the number of threads. */

NeighborSearch::Extent NeighborSearch::extent_of(const Spheres &s, int threads)
{
  constexpr int block = 4096;
  std::vector<Extent> found((s.total - 1) / block + 1);
  in_ranges(static_cast<std::int64_t>(found.size()), threads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      Extent of_block;
      const int first = n * block, last = first + std::min(block, s.total - first);
      of_block.add_all(s.x + 3L * first, s.radius + first, last - first);
      found[n] = of_block;
    }
  });
  Extent all;
  for (const Extent &one : found) all.join(one);
  return all;
}

/* By the reach of a sphere of the mean radius, or of all if they differ little. */

NeighborSearch::Grid NeighborSearch::make_grid(const Spheres &s, int threads)
{
  const Extent extent = extent_of(s, threads);
  if (extent.check != 0.0) throw std::domain_error("a position is not a number");
  constexpr double similar = 1.5;
  const double mean = extent.sum / s.total;
  const bool all_alike = extent.largest < similar * mean;
  double edge = 2.0 * (all_alike ? extent.largest : mean) + s.skin;
  if (edge <= 0.0) edge = 1.0;    // points without a skin: any cells do
  Grid grid{};
  choose_cells(grid, extent, edge, s.total);
  grid.largest = extent.largest * grid.per_length;
  grid.alike = all_alike ? static_cast<float>(grid.largest) : 0.0F;
  return grid;
}

/* What lies side by side along x is one piece of the sorted spheres: short cells there leave out
   more, and thick ones across make few pieces that fill vectors. Wider ones if there would be far
   more cells than spheres. */

void NeighborSearch::choose_cells(Grid &grid, const Extent &extent, double edge, int spheres)
{
  constexpr double cells_per_sphere = 4.0, least = 4096.0, most = 2.0e9;    // numbered with 32 bits
  constexpr double per_x = 2.0, thinnest = 2.0, thickest = 8.0, in_a_piece = 8.0;
  double volume = 1.0;    // in edges
  for (int d = 0; d < 3; d++) volume *= (extent.high[d] - extent.low[d]) / edge + 1.0;
  const double length = 2.0 + 1.0 / per_x;    // of a piece
  const double thickness =
      std::clamp(std::sqrt(in_a_piece * volume / (length * spheres)), thinnest, thickest);
  for (;; edge *= 1.3) {
    double number = 1.0;
    grid.per_length = 1.0 / edge;
    for (int d = 0; d < 3; d++) {
      grid.low[d] = extent.low[d];
      grid.per_place[d] = d == 0 ? per_x : 1.0 / thickness;
      const double cells =
          std::floor((extent.high[d] - extent.low[d]) / edge * grid.per_place[d]) + 1.0;
      number *= cells;
      grid.cells[d] = static_cast<int>(std::min(cells, most));
    }
    if (number <= std::min(cells_per_sphere * spheres + least, most)) return;
  }
}

/* Spheres in a cell stand in ascending order. They are counted by up to eight threads, each for
   itself and a range of the spheres. */

void NeighborSearch::sort_into_cells(const Spheres &s, int threads)
{
  grid = make_grid(s, threads);
  constexpr int enough = 8;
  const int workers = std::min(threads, enough);
  const std::int64_t num_cells = grid.row(0, grid.cells[2]);
  CellCounts counts(workers);
  AlignedVector<std::int32_t> cell(s.total);
  in_ranges(s.total, workers, [&](int t, int begin, int end) {
    counts[t].assign(num_cells, 0);
    for (int a = begin; a < end; a++) {
      const int y = grid.cell(grid.place(s, a, 1), 1), z = grid.cell(grid.place(s, a, 2), 2);
      cell[a] = static_cast<std::int32_t>(grid.row(y, z) + grid.cell(grid.place(s, a, 0), 0));
      counts[t][cell[a]]++;
    }
  });
  find_starts(counts);

  const std::size_t room = static_cast<std::size_t>(s.total) + width;    // read, but not used
  for (AlignedVector<float> *array : {&x, &y, &z, &radius}) renew(*array, room);
  renew(index, room);
  in_ranges(s.total, workers, [&](int t, int begin, int end) {
    for (int a = begin; a < end; a++) {
      const std::int32_t n = counts[t][cell[a]]++;
      x[n] = static_cast<float>(grid.place(s, a, 0));
      y[n] = static_cast<float>(grid.place(s, a, 1));
      z[n] = static_cast<float>(grid.place(s, a, 2));
      radius[n] = static_cast<float>(s.radius[a] * grid.per_length);
      index[n] = a;
    }
  });

  // places and sums of lengths are rounded by less than this part of the longest length
  constexpr float rounding = 1.0e-6F;
  skin = static_cast<float>(s.skin * grid.per_length);
  double extent = 0.0;
  for (int d = 0; d < 3; d++) extent = std::max(extent, grid.cells[d] / grid.per_place[d]);
  slack = rounding * (static_cast<float>(extent) + 2.0F * static_cast<float>(grid.largest) + skin);
}

/* From the numbers of spheres in each cell, by thread, to where the first of them will stand. */

void NeighborSearch::find_starts(CellCounts &counts)
{
  const std::int64_t num_cells = static_cast<std::int64_t>(counts[0].size());
  const int workers = static_cast<int>(counts.size());
  start.resize(num_cells + 1);
  std::vector<std::int32_t> before(workers + 1, 0);    // spheres in the cells of a range
  const auto begin = [&](int range) { return num_cells * range / workers; };
  const auto count = [&](int range) {
    std::int32_t sum = 0;
    for (const auto &of_thread : counts)
      sum = std::accumulate(of_thread.begin() + begin(range), of_thread.begin() + begin(range + 1),
                            sum);
    before[range + 1] = sum;
  };
  const auto place = [&](int range) {
    std::int32_t next = std::accumulate(before.begin(), before.begin() + range + 1, 0);
    for (std::int64_t c = begin(range); c < begin(range + 1); c++) {
      start[c] = next;
      for (auto &of_thread : counts) next += std::exchange(of_thread[c], next);
    }
    if (range + 1 == workers) start[num_cells] = next;
  };
  in_parallel(workers, workers, count, place);
}

void NeighborSearch::find(const Spheres &s, int threads,
                          const std::function<bool(int, int)> &excluded)
{
  clear();
  if (s.total == 0) return;
  sort_into_cells(s, threads);
  renew(size, s.total);
  renew(entries, s.total);
  chunks.resize(threads);
  in_ranges(s.total, threads,
            [&](int t, int begin, int end) { find_rows(s, chunks[t], begin, end, excluded); });
  if (memory_usage() > release_threshold) release_cells();
}

/* Before lists of pairs are made from the rows. */

void NeighborSearch::release_cells()
{
  for (AlignedVector<float> *array : {&x, &y, &z, &radius}) release(*array);
  release(index);
  release(start);
}

/* The rows of one thread. */

void NeighborSearch::find_rows(const Spheres &s, Chunk &mine, int begin, int end,
                               const std::function<bool(int, int)> &excluded)
{
  mine.count = 0;
  // addresses for more than most scenes need: only what is written takes memory
  if (mine.entries.empty()) mine.entries.resize(usual * (end - begin));
  for (int a = begin; a < end; a++) {
    const std::size_t before = mine.count;
    if (a >= s.first_row) find_row(s, a, mine);
    int *const row = mine.entries.data() + before, *last = mine.entries.data() + mine.count;
    if (excluded) last = std::remove_if(row, last, [&](int b) { return excluded(a, b); });
    size[a] = static_cast<int>(last - row);
    mine.count = before + size[a];
  }
  const int *row = mine.entries.data();    // which moves no more
  for (int a = begin; a < end; row += size[a++]) entries[a] = row;
}

/* Rows of cells that the sphere reaches. */

void NeighborSearch::find_row(const Spheres &s, int a, Chunk &found) const
{
  float of_sphere[4];
  double place[3];
  for (int d = 0; d < 3; d++) {
    place[d] = grid.place(s, a, d);
    of_sphere[d] = static_cast<float>(place[d]);
  }
  of_sphere[3] = static_cast<float>(s.radius[a] * grid.per_length);
  const double reach = of_sphere[3] + std::max(of_sphere[3], grid.alike) + skin + slack;
  int from[3], to[3];
  for (int d = 0; d < 3; d++) {
    from[d] = grid.cell(place[d] - reach, d);
    to[d] = grid.cell(place[d] + reach, d);
  }
  // pairs of two ghosts belong to other ranks
  const int below = a < s.owned ? s.total : s.owned;
  for (int kz = from[2]; kz <= to[2]; kz++)
    for (int ky = from[1]; ky <= to[1]; ky++) {
      const std::int64_t row = grid.row(ky, kz);
      compare(of_sphere, a, below, start[row + from[0]], start[row + to[0] + 1], found);
    }
}

/* Appends those of a piece of the sorted spheres that are near and of a lower index, or smaller. */

TALUS_INLINE void NeighborSearch::compare(const float *place_and_radius, int a, int below,
                                          std::int64_t begin, std::int64_t end, Chunk &found) const
{
  const auto floats = [](const float *at) { return Memory<Floats>::load_anywhere(at); };
  const Ints lane = counting<Ints>();
  const float wide = place_and_radius[3] + skin + slack;
  const Ints by_index = Ints{} - static_cast<std::int32_t>(grid.alike > 0.0F);
  for (std::int64_t k = begin; k < end; k += width) {
    const Floats dx = floats(&x[k]) - place_and_radius[0], dy = floats(&y[k]) - place_and_radius[1],
                 dz = floats(&z[k]) - place_and_radius[2];
    const Floats other_radius = floats(&radius[k]), reach = other_radius + wide;
    const Ints other = Memory<Ints>::load_anywhere(&index[k]);
    const Ints chosen = (~by_index & (other_radius < place_and_radius[3])) |
                        ((by_index | (other_radius == place_and_radius[3])) & (other < a));
    const Ints near = dx * dx + dy * dy + dz * dz < reach * reach;
    const Ints inside = lane < static_cast<std::int32_t>(std::min<std::int64_t>(end - k, width));
    if (found.entries.size() < found.count + width)
      found.entries.resize(2 * found.entries.size() + 1024);
    const unsigned bits = bits_of(near & chosen & inside & (other < below));
    found.count += store_chosen(found.entries.data() + found.count, bits, other);
  }
}

NeighborView NeighborSearch::view() const
{
  return {static_cast<int>(size.size()), nullptr, size.data(), entries.data()};
}

/* Rows stand in the memory of chunks, which is ours to write. */

void NeighborSearch::take_out(const std::function<bool(int, int)> &take)
{
  for (std::size_t i = 0; i < size.size(); i++) {
    int *row = const_cast<int *>(entries[i]);
    int kept = 0;
    for (int n = 0; n < size[i]; n++)
      if (!take(static_cast<int>(i), row[n])) row[kept++] = row[n];
    size[i] = kept;
  }
}

void NeighborSearch::clear()
{
  size.clear();
  entries.clear();
  if (memory_usage() > release_threshold) *this = NeighborSearch{};
}

double NeighborSearch::memory_usage() const
{
  std::size_t bytes =
      sizeof(std::int32_t) * (start.capacity() + index.capacity()) +
      sizeof(float) * (x.capacity() + y.capacity() + z.capacity() + radius.capacity()) +
      sizeof(int) * size.capacity() + sizeof(const int *) * entries.capacity();
  for (const Chunk &chunk : chunks) bytes += sizeof(int) * chunk.entries.capacity();
  return static_cast<double>(bytes);
}

}    // namespace Talus
