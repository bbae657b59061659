// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/neighbour_search.h"

#include "contact/in_parallel.h"
#include "contact/simd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace Talus {
namespace {

constexpr int width = 16;
/// Cells per unit of place. What lies side by side along x is one piece of the sorted spheres:
/// short cells there leave out more, and thick ones across make few pieces that fill vectors.
constexpr double cells_per_place[3] = {2.0, 0.5, 0.5};
constexpr std::size_t usual = 16;    // neighbors in the row of a sphere, or less
typedef float Floats __attribute__((vector_size(64)));
typedef float FloatsOverlay __attribute__((vector_size(64), aligned(4), may_alias));
typedef std::int32_t Ints __attribute__((vector_size(64)));
typedef std::int32_t IntsOverlay __attribute__((vector_size(64), aligned(4), may_alias));

inline Floats load(const float *address)
{
  return *reinterpret_cast<const FloatsOverlay *>(address);
}

inline Ints load(const std::int32_t *address)
{
  return *reinterpret_cast<const IntsOverlay *>(address);
}

/// Appends the values where the mask is set; writes up to `width` places, returns how many count.
/// No branch, since nobody could foresee it.
inline int append(Ints mask, Ints values, std::int32_t *to)
{
#if defined(__AVX512F__)
  const __mmask16 bits = _mm512_cmplt_epi32_mask((__m512i) mask, _mm512_setzero_si512());
  // compressed in a register: to compress into memory takes some processors a hundred cycles
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(bits, (__m512i) values));
  return __builtin_popcount(bits);
#else
  int count = 0;
  for (int k = 0; k < width; k++) {
    to[count] = values[k];
    count -= mask[k];
  }
  return count;
#endif
}

}    // namespace

/* Places beyond the outermost cells, which only rounding makes, belong to these. */

int NeighbourSearch::Grid::cell(double place, int d) const
{
  return std::clamp(static_cast<int>(std::floor(place * cells_per_place[d])), 0, cells[d] - 1);
}

/* As wide as the reach of a sphere of the mean radius, or of all if they differ little; wider if
   there would be far more cells than spheres. */

NeighbourSearch::Grid NeighbourSearch::make_grid(const Spheres &s)
{
  Grid grid{{s.x[0], s.x[1], s.x[2]}, 1.0, {1, 1, 1}, 0.0F};
  double high[3] = {s.x[0], s.x[1], s.x[2]}, sum = 0.0, largest = 0.0, check = 0.0;
  for (int a = 0; a < s.total; a++) {
    for (int d = 0; d < 3; d++) {
      grid.low[d] = std::min(grid.low[d], s.x[3L * a + d]);
      high[d] = std::max(high[d], s.x[3L * a + d]);
      check += 0.0 * s.x[3L * a + d];
    }
    sum += s.radius[a];
    largest = std::max(largest, s.radius[a]);
  }
  if (check != 0.0) throw std::domain_error("a position is not a number");
  constexpr double similar = 1.5, cells_per_sphere = 4.0, least = 4096.0;
  const double mean = sum / s.total;
  const bool all_alike = largest < similar * mean;
  double edge = 2.0 * (all_alike ? largest : mean) + s.skin;
  if (edge <= 0.0) edge = 1.0;    // points without a skin: any cells do
  double number = 0.0;
  // cells are numbered with 32 bits
  const double most = std::min(cells_per_sphere * s.total + least, 2.0e9);
  for (;; edge *= 1.3) {
    number = 1.0;
    for (int d = 0; d < 3; d++)
      number *= std::floor((high[d] - grid.low[d]) / edge * cells_per_place[d]) + 1.0;
    if (number <= most) break;
  }
  grid.per_length = 1.0 / edge;
  grid.alike = all_alike ? static_cast<float>(largest / edge) : 0.0F;
  for (int d = 0; d < 3; d++)
    grid.cells[d] =
        1 + static_cast<int>((high[d] - grid.low[d]) * grid.per_length * cells_per_place[d]);
  return grid;
}

void NeighbourSearch::sort_into_cells(const Spheres &s)
{
  grid = make_grid(s);
  const auto place = [&](int a, int d) {
    return (s.x[3L * a + d] - grid.low[d]) * grid.per_length;
  };
  std::vector<std::int32_t> cell(s.total);
  start.assign(grid.row(0, grid.cells[2]) + 2, 0);
  double largest = 0.0;
  for (int a = 0; a < s.total; a++) {
    cell[a] = static_cast<std::int32_t>(
        grid.row(grid.cell(place(a, 1), 1), grid.cell(place(a, 2), 2)) + grid.cell(place(a, 0), 0));
    start[cell[a] + 2]++;
    largest = std::max(largest, s.radius[a]);
  }
  std::partial_sum(start.begin(), start.end(), start.begin());

  const std::size_t room = static_cast<std::size_t>(s.total) + width;    // read, but not used
  for (BigVector<float> *array : {&x, &y, &z, &radius}) renew(*array, room);
  renew(index, room);
  for (int a = 0; a < s.total; a++) {
    const std::int32_t n = start[cell[a] + 1]++;    // which ends as the end of the cell
    x[n] = static_cast<float>(place(a, 0));
    y[n] = static_cast<float>(place(a, 1));
    z[n] = static_cast<float>(place(a, 2));
    radius[n] = static_cast<float>(s.radius[a] * grid.per_length);
    index[n] = a;
  }
  start.pop_back();

  // places and sums of lengths are rounded by less than this part of the longest length
  constexpr float rounding = 1.0e-6F;
  skin = static_cast<float>(s.skin * grid.per_length);
  double extent = 0.0;
  for (int d = 0; d < 3; d++) extent = std::max(extent, grid.cells[d] / cells_per_place[d]);
  slack = rounding * (static_cast<float>(extent) +
                      2.0F * static_cast<float>(largest * grid.per_length) + skin);
}

void NeighbourSearch::find(const Spheres &s, int threads,
                           const std::function<bool(int, int)> &excluded)
{
  clear();
  if (s.total == 0) return;
  sort_into_cells(s);
  size.assign(s.total, 0);
  entries.assign(s.total, nullptr);
  chunks.resize(threads);
  in_parallel(threads, threads, [&](int t) { find_rows(s, t, threads, excluded); });
}

/* The rows of one thread. */

void NeighbourSearch::find_rows(const Spheres &s, int t, int threads,
                                const std::function<bool(int, int)> &excluded)
{
  const int begin = static_cast<int>(static_cast<std::int64_t>(s.total) * t / threads);
  const int end = static_cast<int>(static_cast<std::int64_t>(s.total) * (t + 1) / threads);
  Chunk &mine = chunks[t];
  mine.count = 0;
  // addresses for more than most scenes need: only what is written takes memory
  if (mine.entries.empty()) mine.entries.resize(usual * (end - begin));
  for (int a = begin; a < end; a++) {
    const std::size_t before = mine.count;
    find_row(s, a, mine);
    int *const row = mine.entries.data() + before, *last = mine.entries.data() + mine.count;
    if (excluded) last = std::remove_if(row, last, [&](int b) { return excluded(a, b); });
    size[a] = static_cast<int>(last - row);
    mine.count = before + size[a];
  }
  const int *row = mine.entries.data();    // which moves no more
  for (int a = begin; a < end; row += size[a++]) entries[a] = row;
}

/* Rows of cells that the sphere reaches. */

void NeighbourSearch::find_row(const Spheres &s, int a, Chunk &found) const
{
  float own[4];
  double place[3];
  for (int d = 0; d < 3; d++) {
    place[d] = (s.x[3L * a + d] - grid.low[d]) * grid.per_length;
    own[d] = static_cast<float>(place[d]);
  }
  own[3] = static_cast<float>(s.radius[a] * grid.per_length);
  const double reach = own[3] + std::max(own[3], grid.alike) + skin + slack;
  int from[3], to[3];
  for (int d = 0; d < 3; d++) {
    from[d] = grid.cell(place[d] - reach, d);
    to[d] = grid.cell(place[d] + reach, d);
  }
  // pairs of two ghosts are somebody else's
  const int below = a < s.owned ? s.total : s.owned;
  for (int kz = from[2]; kz <= to[2]; kz++)
    for (int ky = from[1]; ky <= to[1]; ky++) {
      const std::int64_t row = grid.row(ky, kz);
      compare(own, a, below, start[row + from[0]], start[row + to[0] + 1], found);
    }
}

/* Appends those of a piece of the sorted spheres that are near and of a lower index, or smaller. */

TALUS_INLINE void NeighbourSearch::compare(const float *own, int a, int below, std::int64_t begin,
                                           std::int64_t end, Chunk &found) const
{
  constexpr Ints lane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const float wide = own[3] + skin + slack;
  const Ints by_index = Ints{} - static_cast<std::int32_t>(grid.alike > 0.0F);
  for (std::int64_t k = begin; k < end; k += width) {
    const Floats dx = load(&x[k]) - own[0], dy = load(&y[k]) - own[1], dz = load(&z[k]) - own[2];
    const Floats its = load(&radius[k]), reach = its + wide;
    const Ints other = load(&index[k]);
    const Ints chosen = (~by_index & (its < own[3])) | ((by_index | (its == own[3])) & (other < a));
    const Ints near = dx * dx + dy * dy + dz * dz < reach * reach;
    const Ints inside = lane < static_cast<std::int32_t>(std::min<std::int64_t>(end - k, width));
    if (found.entries.size() < found.count + width)
      found.entries.resize(2 * found.entries.size() + 1024);
    found.count +=
        append(near & chosen & inside & (other < below), other, found.entries.data() + found.count);
  }
}

NeighbourView NeighbourSearch::view() const
{
  return {static_cast<int>(size.size()), nullptr, size.data(), entries.data()};
}

void NeighbourSearch::clear()
{
  size.clear();
  entries.clear();
  if (memory_usage() > worth_giving_back) *this = NeighbourSearch{};
}

double NeighbourSearch::memory_usage() const
{
  std::size_t bytes =
      sizeof(std::int32_t) * (start.capacity() + index.capacity()) +
      sizeof(float) * (x.capacity() + y.capacity() + z.capacity() + radius.capacity()) +
      sizeof(int) * size.capacity() + sizeof(const int *) * entries.capacity();
  for (const Chunk &chunk : chunks) bytes += sizeof(int) * chunk.entries.capacity();
  return static_cast<double>(bytes);
}

}    // namespace Talus
