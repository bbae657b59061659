// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "bed.h"

#include "laws/contact_words.h"
#include "material/contact_spec.h"

#include "particles/canonical_key.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <random>

namespace Bench {
namespace {

// of the lattice, fitted to the pairs of a settled bed
constexpr double nearest = 0.995, jitter = 0.03;
constexpr double edge = 1.1547005383792517 * nearest;    // of the cell of two sites: 2/sqrt(3)
constexpr double smallest = 0.95, largest = 1.05;        // diameters

/// Uniform in -1 ... 1, the same on every machine.
class Random {
 public:
  double operator()() { return bits() * (2.0 / 4294967295.0) - 1.0; }
  double bits() { return static_cast<double>(generator()); }

 private:
  std::mt19937 generator{5};
};

void add_sphere(Bed &bed, const double *x, Random &random)
{
  const double r = 0.25 * (smallest + largest) + 0.25 * (largest - smallest) * random();
  for (int d = 0; d < 3; d++) {
    bed.x.push_back(x[d]);
    bed.v.push_back(random());
    bed.omega.push_back(random());
  }
  bed.radius.push_back(r);
  bed.mass.push_back(4.0 * r * r * r);
  bed.type.push_back(1);
}

/// Appends sphere i of another bed.
void copy_sphere(Bed &to, const Bed &from, int i)
{
  for (int d = 0; d < 3; d++) {
    to.x.push_back(from.x[3 * i + d]);
    to.v.push_back(from.v[3 * i + d]);
    to.omega.push_back(from.omega[3 * i + d]);
  }
  to.radius.push_back(from.radius[i]);
  to.mass.push_back(from.mass[i]);
  to.type.push_back(from.type[i]);
  to.key.push_back(from.key[i]);
  to.tag.push_back(from.tag[i]);
}

void complete(Bed &bed)
{
  bed.f.assign(bed.x.size(), 0.0);
  bed.torque.assign(bed.x.size(), 0.0);
}

bool near(const Bed &bed, int i, int j)
{
  double r2 = 0.0;
  for (int d = 0; d < 3; d++) r2 += std::pow(bed.x[3 * i + d] - bed.x[3 * j + d], 2);
  return r2 < std::pow(bed.radius[i] + bed.radius[j] + skin, 2);
}

/// Cells in which neighbors are looked for, wider than the largest distance of a pair.
class Cells {
 public:
  explicit Cells(const Bed &bed)
  {
    for (int d = 0; d < 3; d++) {
      low[d] = high[d] = bed.x[d];
      for (int i = 0; i < bed.size(); i++) {
        low[d] = std::min(low[d], bed.x[3 * i + d]);
        high[d] = std::max(high[d], bed.x[3 * i + d]);
      }
      count[d] = 1 + static_cast<int>((high[d] - low[d]) / width);
    }
    begin.assign(static_cast<std::size_t>(count[0]) * count[1] * count[2] + 1, 0);
    for (int i = 0; i < bed.size(); i++) begin[cell(&bed.x[3 * i]) + 1]++;
    for (std::size_t c = 1; c < begin.size(); c++) begin[c] += begin[c - 1];
    spheres.resize(bed.size());
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (int i = 0; i < bed.size(); i++) spheres[next[cell(&bed.x[3 * i])]++] = i;
  }

  /// visit(j) for all spheres in the cells around x.
  template <class Visit> void around(const double *x, Visit visit) const
  {
    int at[3];
    for (int d = 0; d < 3; d++) at[d] = static_cast<int>((x[d] - low[d]) / width);
    for (int k = std::max(0, at[2] - 1); k <= std::min(count[2] - 1, at[2] + 1); k++)
      for (int j = std::max(0, at[1] - 1); j <= std::min(count[1] - 1, at[1] + 1); j++)
        for (int i = std::max(0, at[0] - 1); i <= std::min(count[0] - 1, at[0] + 1); i++) {
          const std::size_t c = index(i, j, k);
          for (int n = begin[c]; n < begin[c + 1]; n++) visit(spheres[n]);
        }
  }

 private:
  static constexpr double width = largest + skin;
  double low[3], high[3];
  int count[3];
  std::vector<int> begin, spheres;

  std::size_t index(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * count[1] + j) * count[0] + i;
  }
  std::size_t cell(const double *x) const
  {
    int at[3];
    for (int d = 0; d < 3; d++) at[d] = static_cast<int>((x[d] - low[d]) / width);
    return index(at[0], at[1], at[2]);
  }
};

/// Rows of all spheres with the owned neighbors of a lower index.
Lists make_lists(const Bed &bed)
{
  const Cells cells(bed);
  Lists lists;
  std::vector<std::size_t> begin;
  for (int i = 0; i < bed.size(); i++) {
    begin.push_back(lists.entries.size());
    cells.around(&bed.x[3 * i], [&](int j) {
      if (j < i && j < bed.owned && near(bed, i, j)) lists.entries.push_back(j);
    });
    lists.row.push_back(i);
    lists.size.push_back(static_cast<int>(lists.entries.size() - begin.back()));
  }
  for (const std::size_t b : begin) lists.begin.push_back(lists.entries.data() + b);
  return lists;
}

Bed in_order_of_keys(const Bed &bed)
{
  std::vector<int> order(bed.size());
  for (int i = 0; i < bed.size(); i++) order[i] = i;
  std::sort(order.begin(), order.end(), [&](int i, int j) { return bed.key[i] < bed.key[j]; });
  Bed sorted;
  for (const int i : order) copy_sphere(sorted, bed, i);
  sorted.owned = bed.owned;
  return sorted;
}

}    // namespace

Talus::NeighborView Lists::view() const
{
  Talus::NeighborView v;
  v.rows = static_cast<int>(row.size());
  v.particle = row.data();
  v.size = size.data();
  v.entries = begin.data();
  return v;
}

Talus::ParticleView Bed::view()
{
  return {x.data(),    v.data(), omega.data(), radius.data(),
          mass.data(), nullptr,  f.data(),     torque.data()};
}

Bed make_bed(int spheres)
{
  const int across = std::max(2, static_cast<int>(std::cbrt(spheres / 2.0)));
  Random random;
  Bed bed;
  for (int site = 0; site < 2 * across * across * across; site++) {
    const int cell = site / 2,
              place[3] = {cell % across, cell / across % across, cell / (across * across)};
    double x[3];
    for (int d = 0; d < 3; d++) x[d] = edge * (place[d] + 0.5 * (site % 2)) + jitter * random();
    add_sphere(bed, x, random);
    bed.key.push_back(Talus::canonical_key(x, 1.0));
    bed.tag.push_back(1 + site);
  }
  bed.owned = bed.size();
  bed = in_order_of_keys(bed);
  complete(bed);
  bed.neighbors = make_lists(bed);
  return bed;
}

Bed in_periodic_box(const Bed &bed)
{
  constexpr double reach = largest + skin, low = -0.25 * edge;
  const double period = edge * std::round(std::cbrt(bed.owned / 2.0));
  Bed periodic;
  for (int i = 0; i < bed.owned; i++) copy_sphere(periodic, bed, i);
  periodic.owned = periodic.size();
  const auto is_near = [&](double x) { return x > low - reach && x < low + period + reach; };
  for (int shift = 0; shift < 27; shift++)
    for (int i = 0; i < bed.owned; i++) {
      const int along[3] = {shift % 3 - 1, shift / 3 % 3 - 1, shift / 9 - 1};
      double x[3];
      for (int d = 0; d < 3; d++) x[d] = bed.x[3 * i + d] + along[d] * period;
      if (shift == 13 || !is_near(x[0]) || !is_near(x[1]) || !is_near(x[2])) continue;
      copy_sphere(periodic, bed, i);
      std::copy(x, x + 3, periodic.x.end() - 3);
      periodic.original.push_back(i);
    }
  complete(periodic);
  periodic.neighbors = make_lists(periodic);
  return periodic;
}

std::vector<Bed> two_ranks(const Bed &bed)
{
  std::vector<double> all;
  for (int i = 0; i < bed.size(); i++) all.push_back(bed.x[3 * i]);
  std::nth_element(all.begin(), all.begin() + all.size() / 2, all.end());
  const double middle = all[all.size() / 2];

  std::vector<Bed> ranks(2);
  for (int side = 0; side < 2; side++) {
    Bed &rank = ranks[side];
    const auto is_owned = [&](int i) { return (bed.x[3 * i] < middle) == (side == 0); };
    for (int i = 0; i < bed.size(); i++)
      if (is_owned(i)) copy_sphere(rank, bed, i);
    rank.owned = rank.size();
    for (int i = 0; i < bed.size(); i++)
      if (!is_owned(i) && std::abs(bed.x[3 * i] - middle) < largest + skin)
        copy_sphere(rank, bed, i);
    complete(rank);
    rank.neighbors = make_lists(rank);
  }
  return ranks;
}

Talus::LawTable one_law(const char *normal, const char *tangential)
{
  const bool smooth = std::string(tangential) == "none",
             has_kt = std::string(tangential) != "dashpot";
  std::vector<const char *> text{normal, "1000.0", "10.0", "tangential", tangential};
  if (!smooth && has_kt) text.push_back("300.0");
  if (!smooth) text.insert(text.end(), {"5.0", "0.5"});
  Talus::Words words("law of the bed", static_cast<int>(text.size()), text.data(), 0,
                     [](int, const std::string &problem) { throw std::invalid_argument(problem); });
  const Talus::ContactSpec spec = Talus::parse_contact(words, 1.0);
  Talus::LawTable table;
  table.reset(1);
  table.set(1, 1, spec.law, contact_coefficients(spec, spec, Talus::FrictionMix::MINIMUM));
  table.finish();
  return table;
}

Talus::ContactScene scene_of(const Talus::LawTable &laws)
{
  Talus::ContactScene scene;
  scene.laws = laws;
  scene.with_friction = laws.has_friction();
  scene.with_history = laws.has_history();
  scene.history_records = laws.history_records();
  scene.with_resistance = laws.has_resistance();
  return scene;
}

}    // namespace Bench
