// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/shared_energy.h"

#include <cmath>

namespace Talus {
namespace {

/* y^m, m being the exponent of energies. */

double energy_ratio(double y, double force_exponent)
{
  if (force_exponent == 1.0) return y * y;
  if (force_exponent == 1.5) return y * y * std::sqrt(y);
  return std::pow(y, force_exponent + 1.0);
}

/* What the contact of an end leaves of the energy, and minus its slope, for the ratio p of their
   energies: 1 - a p, which ends at p = 1 without a kink, as a parabola over a fifth. Where the slope
   is above 1 the weight of the end is negative, and pulls at what should topple about the edge; the
   mean slope is 1, so that it cannot be below 1 everywhere. */

struct Left {
  double share, slope;
};

Left left_by_end(double p)
{
  constexpr double rounded_part = 0.2, steepest = 1.0 / (1.0 - 0.5 * rounded_part),
                   to_end = 1.0 - rounded_part;
  if (p < to_end) return {1.0 - steepest * p, steepest};
  const double slope = steepest * (1.0 - p) / rounded_part;
  return {0.5 * slope * (1.0 - p), slope};
}

}    // namespace

void SharedEnergy::begin(double contact_overlap, double force_exponent)
{
  ends.clear();
  overlap = contact_overlap;
  exponent = force_exponent;
  is_left = true;
}

void SharedEnergy::add_end(int contact, double contact_overlap, double share)
{
  if (!is_left || !(contact_overlap > 0.0) || !(share > 0.0)) return;
  const double ratio = share * energy_ratio(contact_overlap / overlap, exponent);
  is_left = ratio < 1.0;
  const Left left = left_by_end(ratio);
  ends.push_back({contact, share, ratio, left.share, left.slope});
}

/* The derivatives by o, over phi'(o), and by -o_k, over phi'(o_k). */

bool SharedEnergy::finish()
{
  if (!is_left) return false;
  product = 1.0;
  for (const End &end : ends) product *= end.left;
  own = product;
  for (std::size_t k = 0; k < ends.size(); k++) {
    double others = 1.0;
    for (std::size_t l = 0; l < ends.size(); l++)
      if (l != k) others *= ends[l].left;
    End &end = ends[k];
    own += end.ratio * end.weight * others;
    end.weight *= end.share * others;
  }
  return own > least_weight;
}

}    // namespace Talus
