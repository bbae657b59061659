// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/given_law.h"

#include "laws/damping/common.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus {

double Mixing::mean(const std::string &name) const
{
  return 0.5 * (a.given.value(name) + b.given.value(name));
}

double Mixing::geometric(const std::string &name) const
{
  const double p = a.given.value(name), q = b.given.value(name);
  return p == q ? p : std::sqrt(p * q);
}

double Mixing::smallest(const std::string &name) const
{
  return std::min(a.given.value(name), b.given.value(name));
}

double Mixing::largest(const std::string &name, double otherwise) const
{
  return std::max(a.given.value(name, otherwise), b.given.value(name, otherwise));
}

double Mixing::friction(const std::string &name) const
{
  const double p = a.given.value(name), q = b.given.value(name);
  if (rule == FrictionMix::ARITHMETIC) return 0.5 * (p + q);
  if (rule == FrictionMix::GEOMETRIC) return std::sqrt(p * q);
  return std::min(p, q);
}

bool Mixing::limits_damping() const
{
  return a.given.has("limit_damping") || b.given.has("limit_damping");
}

void LawReader::finish()
{
  if (damping_at >= 0) {
    const int end = words.index();
    words.skip(damping_at - end);
    spec.law.damping().read_coefficient(*this);
    words.skip(end - words.index());
  }
  for (const LateCheck &one : checks)
    if (const std::string wrong = one.check(spec.law); !wrong.empty())
      words.fail(words.index() - one.index, wrong);
}

double least_force(const Mixing &m)
{
  return m.limits_damping() ? 0.0 : -std::numeric_limits<double>::infinity();
}

}    // namespace Talus
