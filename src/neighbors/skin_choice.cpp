// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/skin_choice.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

// Over the cost of a candidate in a step, from gases of 2 to 30 % solids with skins of .15 to .85 diameters.
constexpr double cost_of_particle = 45.0, cost_in_list = 5.0;
// A list that is longer by this number of candidates for each particle takes about a tenth of its memory more.
constexpr double most_candidates_added = 3.5;
constexpr int steps_per_doubling = 4;
constexpr int most_steps = 4 * steps_per_doubling;
constexpr double clearly = 0.97;

double cubed(double x)
{
  return x * x * x;
}

double candidates_with(double skin, const CountedLists &counted)
{
  return static_cast<double>(counted.candidates) *
         cubed((counted.mean_diameter + skin) / (counted.mean_diameter + counted.skin));
}

/* Of a step. */

double cost_with(double skin, const CountedLists &counted)
{
  const double candidates = candidates_with(skin, counted);
  const double steps = std::max(1.0, static_cast<double>(counted.steps) * skin / counted.skin);
  return candidates +
         (cost_of_particle * static_cast<double>(counted.particles) + cost_in_list * candidates) /
             steps;
}

}    // namespace

double choose_skin(const CountedLists &counted, const SkinLimits &limits)
{
  const double most_candidates = candidates_with(limits.given, counted) +
                                 most_candidates_added * static_cast<double>(counted.particles);
  double best = limits.given, least = cost_with(limits.given, counted);
  for (int k = 1; k <= most_steps; k++) {
    const double skin = limits.given * std::exp2(static_cast<double>(k) / steps_per_doubling);
    if (skin > limits.most || candidates_with(skin, counted) > most_candidates) break;
    const double cost = cost_with(skin, counted);
    if (!(cost < least)) continue;
    best = skin;
    least = cost;
  }
  const bool may_stay = counted.skin <= std::max(limits.given, limits.most) &&
                        candidates_with(counted.skin, counted) <= most_candidates;
  return may_stay && !(least < clearly * cost_with(counted.skin, counted)) ? counted.skin : best;
}

}    // namespace Talus
