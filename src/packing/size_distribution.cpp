// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "packing/size_distribution.h"

#include <algorithm>
#include <cmath>

namespace Talus {

namespace {

constexpr double sixth_of_pi = 0.52359877559829887308;

double normal_share(double x)
{
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

}    // namespace

void SizeDistribution::parse(Words &words)
{
  words.about("diameter");
  std::vector<double> weights;
  if (words.take("uniform") || words.is_next("lognormal")) {
    kind = words.take("lognormal") ? Kind::LOGNORMAL : Kind::UNIFORM;
    if (kind == Kind::LOGNORMAL) {
      median = words.positive("median");
      sigma = words.positive("sigma");
    }
    lo = words.positive("lo");
    hi = words.positive("hi");
    if (hi < lo) words.fail(1, "hi must not be less than lo");
  } else if (words.take("discrete")) {
    kind = Kind::DISCRETE;
    const int n = words.integer("n", 1);
    for (int k = 0; k < n; k++) {
      sizes.push_back(words.positive("diameter D"));
      weights.push_back(words.positive("weight w"));
    }
  } else {
    kind = Kind::DISCRETE;
    sizes = {words.positive("D, uniform, lognormal or discrete")};
    weights = {1.0};
  }
  by_mass = words.take("mass");
  if (!by_mass) words.take("number");
  words.about("");

  // from mass to number: the density of a distribution is divided by the cube of the diameter
  if (by_mass) median *= std::exp(-3.0 * sigma * sigma);
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); k++) {
    sum += by_mass ? weights[k] / (sizes[k] * sizes[k] * sizes[k]) : weights[k];
    shares.push_back(sum);
  }
  for (double &share : shares) share /= sum;
  if (kind == Kind::LOGNORMAL && hi > lo && !(share_to(hi) > share_to(lo)))
    words.fail(by_mass ? 2 : 1,
               "of this lognormal distribution next to nothing is between lo and hi");
}

double SizeDistribution::share_to(double d) const
{
  constexpr double far = 3.0;    // of lo from the median, in sigma: the share above is a thousandth
  const double x = std::log(d / median) / sigma;
  return std::log(lo / median) > far * sigma ? -normal_share(-x) : normal_share(x);
}

double SizeDistribution::quantile(double q) const
{
  if (kind == Kind::DISCRETE) {
    const auto place = std::lower_bound(shares.begin(), shares.end() - 1, q) - shares.begin();
    return sizes[place];
  }
  if (kind == Kind::UNIFORM) {
    if (!by_mass) return lo + q * (hi - lo);
    const double at_lo = 1.0 / (lo * lo), at_hi = 1.0 / (hi * hi);
    return std::clamp(1.0 / std::sqrt(at_lo - q * (at_lo - at_hi)), lo, hi);
  }
  const double below = share_to(lo), wanted = below + q * (share_to(hi) - below);
  double least = lo, most = hi;
  for (int k = 0; k < 60; k++) {
    const double middle = 0.5 * (least + most);
    (share_to(middle) < wanted ? least : most) = middle;
  }
  return 0.5 * (least + most);
}

double SizeDistribution::smallest() const
{
  return kind == Kind::DISCRETE ? *std::min_element(sizes.begin(), sizes.end()) : lo;
}

double SizeDistribution::largest() const
{
  return kind == Kind::DISCRETE ? *std::max_element(sizes.begin(), sizes.end()) : hi;
}

/* Of that many spheres, as diameters() has them. */

double SizeDistribution::mean_volume(int count) const
{
  double sum = 0.0;
  for (int k = 0; k < count; k++) {
    const double d = quantile((k + 0.5) / count);
    sum += sixth_of_pi * d * d * d;
  }
  return sum / count;
}

/* Of few spheres of a wide distribution by mass, none is as large as the largest would be of many, and
   their mean volume is smaller. */

double SizeDistribution::count_of(double volume) const
{
  constexpr int most_parts = 100000, most_rounds = 30;
  int parts = most_parts;
  double count = 0.0;
  for (int n = 0; n < most_rounds; n++) {
    count = volume / mean_volume(parts);
    const int next = static_cast<int>(std::clamp(std::round(count), 1.0, double(most_parts)));
    if (next == parts) break;
    parts = next;
  }
  return count;
}

std::vector<double> SizeDistribution::diameters(int count, RandomNumbers &random) const
{
  std::vector<double> all;
  all.reserve(count);
  for (int k = 0; k < count; k++) all.push_back(quantile((k + 0.5) / count));
  random.shuffle(all);
  return all;
}

}    // namespace Talus
