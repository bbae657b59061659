// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_law.h"

#include "laws/law_list.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

/// Gives values places: those that change their sign 0 to 2, others those from 3 on. Rolling and
/// twisting have theirs from 4 and 7 on, whatever the other laws remember: restart files of LAMMPS
/// tell which they are by that.
class Places {
 public:
  HistoryPlaces take(int num_odd, int num_even, int first_even = 3)
  {
    HistoryPlaces places{};
    for (int n = 0; n < num_odd; n++) places[n] = take_one(0);
    for (int n = 0; n < num_even; n++) places[num_odd + n] = take_one(first_even);
    return places;
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
  int take_one(int place)
  {
    while (taken[place]) place++;
    taken[place] = true;
    return place;
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
  Places places;
  HistoryLayout layout;
  bool reads_impact = false;
  for (int s = 0; s < num_stages; s++) {
    layout.of_stage[s] = places.take(laws[s]->odd_history, laws[s]->even_history,
                                     Places::first_of(static_cast<Stage>(s)));
    reads_impact = reads_impact || laws[s]->reads_impact;
  }
  // laws of second order remember a contact without a spring as well
  const bool remembers_spring = tangential().odd_history + tangential().even_history > 0 &&
                                (!tangential().second_order || tangential().has_spring);
  layout.keeps_impact = remembers_spring && reads_impact;
  if (layout.keeps_impact) layout.impact = places.take(0, 3);
  layout.size = places.size();
  if (layout.size == 0 && normal().lasts_beyond_contact) layout.size = 1;    // that it touches
  return layout;
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

double reach_of(const ContactLaw &law, const ContactCoefficients &row, double radius_i,
                double radius_j)
{
  if (radius_i <= 0.0 || radius_j <= 0.0) return 0.0;
  return reach_of(law, row, radius_i * radius_j / (radius_i + radius_j));
}

double reach_of(const ContactLaw &law, const ContactCoefficients &row, double effective_radius)
{
  const Law &normal = law.normal();
  return normal.reach ? normal.reach(law.coefficients(Stage::NORMAL, row), effective_radius) : 0.0;
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
