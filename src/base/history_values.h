// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The history of a contact, with the signs of its first body. The first three values
// (displacements, forces) change their sign if the other body counts as the first. Which law has
// which: see HistoryLayout (laws/contact_law.h).

#ifndef TALUS_BASE_HISTORY_VALUES_H
#define TALUS_BASE_HISTORY_VALUES_H

#include <array>

namespace Talus {

/// Room for all laws: a whole number of records of four.
inline constexpr int most_history_values = 20;

/// Values beyond those that the laws of a contact have are zero.
using HistoryValues = std::array<double, most_history_values>;

/// With the signs of the other body of the contact.
inline HistoryValues mirrored(HistoryValues values)
{
  for (int n = 0; n < 3; n++) values[n] = -values[n];
  return values;
}

}    // namespace Talus

#endif
