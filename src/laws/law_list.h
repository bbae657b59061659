// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The list of all laws.

#ifndef TALUS_LAWS_LAW_LIST_H
#define TALUS_LAWS_LAW_LIST_H

#include "laws/law.h"

#include <string>
#include <vector>

namespace Talus {

/// In the order in which messages name them.
const std::vector<const Law *> &laws_of(Stage stage);

/// nullptr if there is none of this name.
const Law *find_law(Stage stage, const std::string &name);

/// The word of a stage in messages and restart files, e.g. "normal".
const char *name_of(Stage stage);

/// Those that are chosen by a word of their own.
std::vector<std::string> words_of(Stage stage);

/// Adds a law of another source file, as a static object of that file: see tests/added_law.
struct AddedLaw {
  explicit AddedLaw(const Law &law);
};

}    // namespace Talus

#endif
