// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_law.h"

#include "base/power.h"
#include "laws/law_list.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

/// Assigns history indices: 0 to 2 to values that change their sign, those from 3 on to others.
/// Rolling and twisting have theirs from 4 and 7 on, whatever the other laws have: restart files of
/// LAMMPS identify them by that.
class FreeIndices {
 public:
  HistoryIndices take(int num_odd, int num_even, int first_even = 3)
  {
    HistoryIndices history_index{};
    for (int n = 0; n < num_odd; n++) history_index[n] = take_one(0);
    for (int n = 0; n < num_even; n++) history_index[num_odd + n] = take_one(first_even);
    return history_index;
  }
  static int first_of(Stage stage)
  {
    return stage == Stage::TWISTING ? 7 : stage == Stage::ROLLING ? 4 : 3;
  }
  int size() const
  {
    int size = ContactBatch::history_size;
    while (size > 0 && !taken[size - 1]) size--;
    return size;
  }

 private:
  /// There are enough, whichever laws of the stages come together.
  int take_one(int index)
  {
    while (taken[index]) index++;
    taken[index] = true;
    return index;
  }
  std::array<bool, ContactBatch::history_size> taken{};
};

}    // namespace

bool Law::reads(const char *coefficient) const
{
  for (int n = 0; n < num_coefficients; n++)
    if (std::strcmp(coefficients[n].name, coefficient) == 0) return true;
  return false;
}

ContactLaw::ContactLaw()
{
  for (int s = 0; s < num_stages; s++) laws[s] = laws_of(static_cast<Stage>(s)).front();
}

bool ContactLaw::needs_radius() const
{
  return std::any_of(laws.begin(), laws.end(), [](const Law *law) { return law->needs_radius; });
}

HistoryLayout ContactLaw::history() const
{
  FreeIndices free_indices;
  HistoryLayout layout;
  bool reads_impact = false;
  for (int s = 0; s < num_stages; s++) {
    layout.of_stage[s] = free_indices.take(laws[s]->odd_history, laws[s]->even_history,
                                           FreeIndices::first_of(static_cast<Stage>(s)));
    reads_impact = reads_impact || laws[s]->reads_impact;
  }
  // laws of second order have a history without a spring as well
  const bool has_spring_history = tangential().odd_history + tangential().even_history > 0 &&
                                  (!tangential().second_order || tangential().has_spring);
  layout.keeps_impact = has_spring_history && reads_impact;
  if (layout.keeps_impact) layout.impact = free_indices.take(0, 3);
  layout.size = free_indices.size();
  if (layout.size == 0 && lasts_beyond_contact()) layout.size = 1;    // that it touches
  return layout;
}

HistoryVectors ContactLaw::vectors_in_history() const
{
  const HistoryLayout layout = history();
  HistoryVectors vectors;
  const auto add = [&](Stage stage, int values) {
    const HistoryIndices &at = layout.of_stage[static_cast<int>(stage)];
    for (int first = 0; first + 3 <= values; first += 3)
      vectors.index[vectors.count++] = {at[first], at[first + 1], at[first + 2]};
  };
  add(Stage::TANGENTIAL, tangential().odd_history);
  add(Stage::ROLLING, rolling().even_history);
  return vectors;
}

int ContactLaw::first_coefficient(Stage stage) const
{
  int first = 0;
  for (int s = 0; s < static_cast<int>(stage); s++) first += laws[s]->num_coefficients;
  return first;
}

int ContactLaw::num_coefficients() const
{
  return first_coefficient(Stage::HEAT) + heat().num_coefficients;
}

double ContactLaw::coefficient(Stage stage, const char *name, const ContactCoefficients &row) const
{
  const Law &law = (*this)[stage];
  for (int n = 0; n < law.num_coefficients; n++)
    if (std::strcmp(law.coefficients[n].name, name) == 0) return coefficients(stage, row)[n];
  return 0.0;
}

static double pulloff_distance_of(const ContactLaw &law, const ContactCoefficients &row,
                                  const ContactSize<double> &size)
{
  const Stage stage = law.stage_of_pulloff();
  const auto cube = law[stage].pulloff_cube;
  return cube ? cube_root(cube(law.coefficients(stage, row), size)) : 0.0;
}

static double volume_of_sphere(double radius)
{
  return 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
}

double pulloff_distance_of(const ContactLaw &law, const ContactCoefficients &row, double radius_i,
                           double radius_j)
{
  if (radius_i <= 0.0 || radius_j <= 0.0) return 0.0;
  return pulloff_distance_of(law, row, size_of_pair(radius_i, radius_j));
}

double pulloff_distance_of(const ContactLaw &law, const ContactCoefficients &row, double radius)
{
  return pulloff_distance_of(law, row, ContactSize<double>{radius, volume_of_sphere(radius)});
}

std::string describe_law(const ContactLaw &law)
{
  std::string text, last;
  for (int s = 0; s < num_stages; s++) {
    const Law &one = law[static_cast<Stage>(s)];
    std::string label = one.label ? one.label : "";
    if (one.stage == Stage::DAMPING && std::strcmp(one.name, law.normal().damping) != 0)
      label = std::string("damping ") + one.name;
    if (label.empty() || last == label) continue;
    text += (text.empty() ? "" : " + ") + label;
    last = label;
  }
  return text;
}

}    // namespace Talus
