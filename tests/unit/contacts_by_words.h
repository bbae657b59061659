// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws from their words, and single contacts along the x axis, for tests of laws.

#ifndef TALUS_TEST_CONTACTS_BY_WORDS_H
#define TALUS_TEST_CONTACTS_BY_WORDS_H

#include "laws/contact_energy.h"
#include "laws/contact_kernel.h"
#include "laws/contact_words.h"
#include "material/contact_spec.h"

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace contacts {

using namespace Talus;

/// std::invalid_argument with the text of the error.
inline ContactSpec read(const std::string &text)
{
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; stream >> part;) parts.push_back(part);
  std::vector<const char *> arg;
  for (const std::string &part : parts) arg.push_back(part.c_str());
  Words words("test", static_cast<int>(arg.size()), arg.data(), 0,
              [](int, const std::string &problem) { throw std::invalid_argument(problem); });
  ContactSpec spec = parse_contact(words, 1.0);
  words.end();
  return spec;
}

inline std::string problem_of(const std::string &text)
{
  try {
    read(text);
  } catch (const std::invalid_argument &problem) {
    return problem.what();
  }
  return "";
}

/// Two spheres of one material.
struct Pair {
  Pair(const std::string &words, double radius, double other) :
      spec(read(words)), law(spec.law), row(contact_coefficients(spec, spec, FrictionMix::MINIMUM)),
      radius(radius), other(other)
  {
  }

  /// `gap` between the surfaces, below 0 if they overlap.
  ContactState<double> at(double gap, const Vector3<double> &velocity = {}) const
  {
    ContactState<double> s{};
    s.normal = {1.0, 0.0, 0.0};
    s.overlap = -gap;
    s.velocity = velocity;
    s.inverse_mass = 2.0;
    s.inverse_radius = 1.0 / radius + 1.0 / other;
    s.inverse_distance = 1.0 / (radius + other + gap);
    return s;
  }
  ContactLanes<double> contact(double gap, const Vector3<double> &velocity = {},
                               const HistoryValues &history = {}) const
  {
    return single_contact(law, row, at(gap, velocity), 1.0e-5, history);
  }
  /// Contacts that move, turn, conduct heat and remember something: apart in even lanes k, by 1e-6 (k + 1), with an
  /// overlap of 1e-6 k in odd ones.
  ContactBatch touching_and_apart() const
  {
    ContactBatch batch;
    batch.clear();
    for (int n = 0; n < ContactBatch::history_size; n++)
      for (double &value : batch.history[n]) value = 1e-6 * (n + 1);
    for (int k = 0; k < ContactBatch::width; k++) {
      const ContactState<double> s = at(k % 2 ? -1e-6 * k : 1e-6 * (k + 1));
      batch.overlap[k] = s.overlap;
      batch.normal[0][k] = 1.0;
      batch.inverse_mass[k] = s.inverse_mass;
      batch.inverse_radius[k] = s.inverse_radius;
      batch.inverse_distance[k] = s.inverse_distance;
      batch.temperature_difference[k] = 10.0;
      for (int d = 0; d < 3; d++) {
        batch.velocity[d][k] = 0.1 * (d + 1);
        batch.surface_rotation[d][k] = batch.relative_omega[d][k] = 0.2 - 0.1 * d;
      }
    }
    return batch;
  }
  double attraction(double gap) const { return -contact(gap).force.x; }
  double stored(double gap, const HistoryValues &history = {}) const
  {
    return stored_energy(law, row, at(gap), 1.0e-5, history).normal;
  }
  double reach() const { return pulloff_distance_of(law, row, radius, other); }

  ContactSpec spec;
  ContactLaw law;
  ContactCoefficients row;
  double radius, other;
};

/// By Simpson's rule.
template <class Function>
double integral(const Function &f, double begin, double end, int intervals = 2000)
{
  const double h = (end - begin) / intervals;
  double sum = f(begin) + f(end);
  for (int n = 1; n < intervals; n++) sum += (n % 2 ? 4.0 : 2.0) * f(begin + n * h);
  return sum * h / 3.0;
}

}    // namespace contacts

#endif
