// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the contacts of a particle with a large body remember, out of what it would take along.

#ifndef TALUS_TEST_HISTORIES_OF_H
#define TALUS_TEST_HISTORIES_OF_H

#include "body/contact/body_history.h"

#include <vector>

inline std::vector<Talus::HistoryValues> histories_of(Talus::BodyHistory &history, int particle)
{
  constexpr int behind_normal = 3;
  std::vector<double> list(history.size_packed(particle));
  history.pack(particle, list.data());
  Talus::ContactLists lists;
  lists.keep(static_cast<int>(list[1]));
  lists.grow(1);
  lists.unpack(0, list.data());
  std::vector<Talus::HistoryValues> found;
  lists.for_each(0, [&](const Talus::ContactLists::Contact &one) {
    found.emplace_back();
    std::copy(one.value + behind_normal, one.value + lists.values(), found.back().begin());
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
