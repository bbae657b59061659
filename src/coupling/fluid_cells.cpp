// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls that tell the cells of a fluid and its laws.

#include "coupling/fluid.h"

#include "base/words.h"
#include "coupling/calls.h"
#include "exchange/large_messages.h"
#include "fluid/grid_cells.h"
#include "fluid/point_cells.h"

#include "fmt/format.h"
#include "group.h"
#include "lammps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

PartnerFluid &fluid_of(talus_partner &partner)
{
  if (!partner.fluid) partner.fluid = std::make_shared<PartnerFluid>();
  return *partner.fluid;
}

namespace {

using Homes = std::vector<OwnerExchange::Home>;

/* ---- words ---------------------------------------------------------------------------------- */

/// The text of an argument, word by word.
void read_words(talus_partner &partner, const char *what, const char *given,
                const std::function<void(Words &)> &read)
{
  std::istringstream text(partner.text_of(what, given));
  std::vector<std::string> all;
  for (std::string word; text >> word;) all.push_back(word);
  std::vector<const char *> pointers;
  pointers.reserve(all.size());
  for (const std::string &word : all) pointers.push_back(word.c_str());
  Words words(what, static_cast<int>(all.size()), pointers.data(), 0,
              [](int, const std::string &problem) { throw Refusal(problem); });
  read(words);
  words.end();
}

struct KernelAndGroup {
  FluidKernel kernel;
  int group_bits;
};

KernelAndGroup kernel_of(talus_partner &partner, const char *given)
{
  KernelAndGroup found{{}, 1};    // bits of group all
  read_words(partner, "kernel", given, [&](Words &words) {
    const bool smooth = words.choice("kernel", {"tophat", "gaussian"}) == 1;
    found.kernel.shape = smooth ? FluidKernel::Shape::GAUSSIAN : FluidKernel::Shape::TOP_HAT;
    found.kernel.width = smooth ? words.positive("width") : words.not_negative("width");
    if (!words.take("group")) return;
    const std::string id = words.text("the ID of a group");
    Group &groups = *partner.instance().group;
    const int number = groups.find(id);
    if (number < 0) throw Refusal("kernel: there is no group '" + id + "'");
    found.group_bits = groups.bitmask[number];
  });
  return found;
}

/* ---- who has which cell --------------------------------------------------------------------- */

void set_cells(talus_partner &partner, std::unique_ptr<FluidCells> cells, Homes homes,
               int group_bits, bool whole)
{
  PartnerFluid &fluid = fluid_of(partner);
  const int all = cells->size();
  fluid.grains = std::make_unique<GrainsInFluid>(&partner.instance(), std::move(cells),
                                                 std::move(homes), group_bits, partner.world());
  fluid.whole = whole;
  fluid.num_cells = whole ? all : fluid.grains->num_cells();
}

void require_system(talus_partner &partner)
{
  const std::string problem = GrainsInFluid::reason_against(&partner.instance());
  if (!problem.empty()) throw Refusal(problem);
}

std::string cell_name(const int (&at)[3])
{
  return fmt::format("cell {} {} {}", at[0], at[1], at[2]);
}

/// Of ranges of all ranks, six numbers each: first, last.
Homes homes_of_ranges(const std::vector<std::int64_t> &ranges, const int (&cells)[3])
{
  Homes homes(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2], {-1, 0});
  for (int rank = 0; rank < static_cast<int>(ranges.size() / 6); rank++) {
    const std::int64_t *const first = &ranges[6 * rank], *const last = first + 3;
    for (int d = 0; d < 3; d++)
      if (first[d] < 0 || last[d] > cells[d] || first[d] > last[d])
        throw Refusal(fmt::format("cells of rank {} are {} to before {} along {}, expected numbers "
                                  "from 0 to {}",
                                  rank, first[d], last[d], "xyz"[d], cells[d]));
    int place = 0, at[3];
    for (at[2] = static_cast<int>(first[2]); at[2] < last[2]; at[2]++)
      for (at[1] = static_cast<int>(first[1]); at[1] < last[1]; at[1]++)
        for (at[0] = static_cast<int>(first[0]); at[0] < last[0]; at[0]++) {
          auto &home =
              homes[(static_cast<std::size_t>(at[2]) * cells[1] + at[1]) * cells[0] + at[0]];
          if (home.rank >= 0)
            throw Refusal(
                fmt::format("{} belongs to ranks {} and {}", cell_name(at), home.rank, rank));
          home = {rank, place++};
        }
  }
  for (std::size_t n = 0; n < homes.size(); n++) {
    if (homes[n].rank >= 0) continue;
    const int number = static_cast<int>(n), row = number / cells[0],
              at[3] = {number % cells[0], row % cells[1], row / cells[1]};
    throw Refusal(cell_name(at) + " belongs to no rank: ranges of all ranks must cover the grid");
  }
  return homes;
}

std::vector<std::int64_t> ranges_of_all(talus_partner &partner, const int *first, const int *last)
{
  const bool one_only = (first == nullptr) != (last == nullptr);
  partner.refuse_if(one_only ? "first or last is NULL" : "");
  std::vector<std::int64_t> mine(6, 0);
  for (int d = 0; d < 3 && first && partner.lives_here(); d++) {
    mine[d] = first[d];
    mine[3 + d] = last[d];
  }
  return gather(mine, MPI_INT64_T, -1, partner.world());
}

/// Cells of this rank, or a text that says what is wrong.
std::string read_points(const talus_partner &partner, std::int64_t n, const double *x,
                        const double *volume, std::vector<double> &rows)
{
  if (!partner.lives_here()) return "";
  int me;
  MPI_Comm_rank(partner.world(), &me);
  if (n < 0) return fmt::format("n is {} on rank {}, expected 0 or more", n, me);
  if (n && (!x || !volume)) return fmt::format("{} is NULL on rank {}", x ? "volume" : "x", me);
  for (std::int64_t k = 0; k < n; k++) {
    for (int d = 0; d < 3; d++)
      if (!std::isfinite(x[3 * k + d]))
        return fmt::format("x[{}] is no finite number on rank {}", 3 * k + d, me);
    if (!(volume[k] > 0.0) || !std::isfinite(volume[k]))
      return fmt::format("volume[{}] is {:.6g} on rank {}, expected more than 0", k, volume[k], me);
    rows.insert(rows.end(), {x[3 * k], x[3 * k + 1], x[3 * k + 2], volume[k]});
  }
  return "";
}

}    // namespace

/* ---- calls ---------------------------------------------------------------------------------- */

int call_set_fluid_grid(talus_partner *partner, const char *kernel, const double *lo,
                        const double *hi, const int *cells, const int *first, const int *last)
{
  return partner->collective("talus_set_fluid_grid", [&] {
    require_system(*partner);
    const KernelAndGroup words = kernel_of(*partner, kernel);
    const std::vector<double> begin = partner->numbers_of("lo", lo, 3),
                              end = partner->numbers_of("hi", hi, 3);
    partner->refuse_if(partner->lives_here() && !cells ? "cells is NULL" : "");
    std::vector<std::int64_t> given(3);
    if (partner->lives_here()) std::copy(cells, cells + 3, given.begin());
    given = partner->integers_of("cells", given.data(), 3);
    const int number[3] = {static_cast<int>(given[0]), static_cast<int>(given[1]),
                           static_cast<int>(given[2])};
    const FluidCells::Periods periods = GrainsInFluid::periods_of(*partner->instance().domain);
    const std::string problem =
        GridCells::problem(words.kernel, begin.data(), end.data(), number, periods);
    if (!problem.empty()) throw Refusal(problem);
    auto grid =
        std::make_unique<GridCells>(words.kernel, begin.data(), end.data(), number, periods);
    const bool divided = partner->home() < 0 && partner->is_given(first || last);
    Homes homes;
    if (divided)
      homes = homes_of_ranges(ranges_of_all(*partner, first, last), number);
    else
      for (int n = 0; n < grid->size(); n++) homes.push_back({std::max(partner->home(), 0), n});
    set_cells(*partner, std::move(grid), std::move(homes), words.group_bits,
              !divided && partner->home() < 0);
  });
}

int call_set_fluid_cells(talus_partner *partner, const char *kernel, int64_t n, const double *x,
                         const double *volume)
{
  return partner->collective("talus_set_fluid_cells", [&] {
    require_system(*partner);
    const KernelAndGroup words = kernel_of(*partner, kernel);
    std::vector<double> mine;
    partner->refuse_if(read_points(*partner, n, x, volume, mine));
    const auto here = static_cast<std::int64_t>(mine.size() / 4);
    const std::vector<std::int64_t> counts =
        gather(std::vector<std::int64_t>{here}, MPI_INT64_T, -1, partner->world());
    const std::vector<double> rows = gather(mine, MPI_DOUBLE, -1, partner->world());
    if (rows.empty()) throw Refusal("n is 0 on all ranks: a fluid has one cell or more");
    if (rows.size() / 4 > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw Refusal("there are more than 2^31 cells");

    std::vector<PointCells::Cell> given(rows.size() / 4);
    Homes home_of(given.size());
    std::size_t next = 0;
    for (int rank = 0; rank < static_cast<int>(counts.size()); rank++)
      for (int place = 0; place < counts[rank]; place++, next++) {
        const double *const row = &rows[4 * next];
        given[next] = {{row[0], row[1], row[2]}, row[3]};
        home_of[next] = {rank, place};
      }
    std::vector<int> order(given.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return PointCells::comes_before(given[a], given[b]); });
    std::vector<PointCells::Cell> sorted;
    Homes homes;
    for (const int k : order) {
      sorted.push_back(given[k]);
      homes.push_back(home_of[k]);
    }
    set_cells(*partner,
              std::make_unique<PointCells>(words.kernel, sorted,
                                           GrainsInFluid::periods_of(*partner->instance().domain)),
              std::move(homes), words.group_bits, false);
  });
}

int call_set_drag_law(talus_partner *partner, const char *law, double density, double viscosity)
{
  return partner->collective("talus_set_drag_law", [&] {
    DragLaw chosen;
    LiftLaw lift;
    read_words(*partner, "law", law, [&](Words &words) {
      const int which = words.choice("law of drag", DragLaw::names());
      const double sphericity =
          DragLaw::has_sphericity(which) ? words.between("sphericity", 0.0, 1.0, true) : 1.0;
      const bool total = words.take("total");
      chosen = DragLaw(which, sphericity, total);
      while (!words.at_end())
        if (!lift.take(words.choice("word", LiftLaw::names())))
          words.fail(1, "there is one of this kind already");
    });
    const double of_fluid[2] = {partner->number_of("density", density),
                                partner->number_of("viscosity", viscosity)};
    for (int k = 0; k < 2; k++)
      if (!(of_fluid[k] > 0.0))
        throw Refusal(fmt::format("{} is {:.6g}, expected more than 0", k ? "viscosity" : "density",
                                  of_fluid[k]));
    PartnerFluid &fluid = fluid_of(*partner);
    fluid.law = chosen;
    fluid.lift = lift;
    fluid.density = of_fluid[0];
    fluid.viscosity = of_fluid[1];
    fluid.has_law = true;
  });
}

}    // namespace Talus
