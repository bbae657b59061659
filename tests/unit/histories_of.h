// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the contacts of a particle with a large body remember, as it would be put aside.

#ifndef TALUS_TEST_HISTORIES_OF_H
#define TALUS_TEST_HISTORIES_OF_H

#include "body/contact/body_history.h"

#include <vector>

inline std::vector<Talus::HistoryValues> histories_of(Talus::BodyHistory &history, int particle)
{
  constexpr int most_particles = 5000;
  Talus::ContactLists lists;
  lists.grow(most_particles);
  history.put_aside(lists);
  std::vector<Talus::HistoryValues> found;
  lists.for_each(particle, [&](const Talus::ContactLists::Contact &one) {
    found.push_back(Talus::BodyHistory::values_of(one));
  });
  return found;
}

/// Of the first one; zero if there is none.
inline Talus::HistoryValues history_of(Talus::BodyHistory &history, int particle)
{
  const auto all = histories_of(history, particle);
  return all.empty() ? Talus::HistoryValues{} : all.front();
}

#endif
