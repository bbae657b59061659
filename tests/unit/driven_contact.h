// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A contact along the x axis that is driven, or an impact, for tests of laws that remember.

#ifndef TALUS_TEST_DRIVEN_CONTACT_H
#define TALUS_TEST_DRIVEN_CONTACT_H

#include "contacts_by_words.h"

namespace contacts {

/// A contact that is driven: one lane of a batch, its history kept.
class Driven {
 public:
  explicit Driven(const Pair &pair) :
      pair(pair), kernel(contact_kernel(pair.law, true, true)),
      slot(pair.law.history().of_stage[static_cast<int>(Stage::NORMAL)])
  {
    batch.clear();
  }
  /// The repulsion at this overlap.
  double at(double overlap)
  {
    const ContactState<double> s = pair.at(-overlap);
    batch.overlap[0] = overlap;
    batch.normal[0][0] = 1.0;
    batch.inverse_mass[0] = s.inverse_mass;
    batch.inverse_radius[0] = s.inverse_radius;
    batch.inverse_distance[0] = s.inverse_distance;
    kernel(batch, 0, lanes, &pair.row, 1e-5);
    return batch.force[0][0];
  }
  /// In steps, so that all between is seen.
  double go(double from, double to, int steps = 400)
  {
    double force = 0.0;
    for (int n = 1; n <= steps; n++) force = at(from + (to - from) * n / steps);
    return force;
  }
  /// Number n of the history of the normal law.
  double kept(int n = 0) const { return batch.history[slot[n]][0]; }
  HistoryValues history() const
  {
    HistoryValues values{};
    for (int n = 0; n < ContactBatch::history_size; n++) values[n] = batch.history[n][0];
    return values;
  }

 private:
  const Pair &pair;
  ContactKernel kernel;
  HistoryIndices slot;
  ContactBatch batch;
};

/// Speed after an impact over that before, in steps of `dt`.
inline double restitution_of(const Pair &pair, double speed, double dt)
{
  Driven contact(pair);
  double x = 0.0, v = speed;
  for (int n = 0; n < 10000000 && (x > 0.0 || v > 0.0); n++) {
    const double force = x > 0.0 ? contact.at(x) : 0.0;
    v -= 2.0 * force * dt;    // 1/m = 2
    x += v * dt;
  }
  return -v / speed;
}

}    // namespace contacts

#endif
