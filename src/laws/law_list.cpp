// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/law_list.h"

#include "laws/stage_lists.h"

#include <array>

namespace Talus {
namespace {

using LawsByStage = std::array<std::vector<const Law *>, num_stages>;

/// Made at the first question: static objects of other files may ask, and add to it.
LawsByStage &list()
{
  static LawsByStage all = [] {
    LawsByStage by_stage;
    for (const auto &laws : {normal_laws(), damping_laws(), tangential_laws(), rolling_laws(),
                             twisting_laws(), cohesion_laws(), heat_laws()})
      for (const Law *one : laws) by_stage[static_cast<int>(one->stage)].push_back(one);
    return by_stage;
  }();
  return all;
}

}    // namespace

const std::vector<const Law *> &laws_of(Stage stage)
{
  return list()[static_cast<int>(stage)];
}

const Law *find_law(Stage stage, const std::string &name)
{
  for (const Law *one : laws_of(stage))
    if (name == one->name) return one;
  return nullptr;
}

const char *name_of(Stage stage)
{
  static const char *const names[num_stages] = {"normal",   "damping",  "tangential", "rolling",
                                                "twisting", "cohesion", "heat"};
  return names[static_cast<int>(stage)];
}

std::vector<std::string> words_of(Stage stage)
{
  std::vector<std::string> words;
  for (const Law *one : laws_of(stage))
    if (one->read) words.emplace_back(one->name);
  return words;
}

AddedLaw::AddedLaw(const Law &law)
{
  list()[static_cast<int>(law.stage)].push_back(&law);
}

}    // namespace Talus
