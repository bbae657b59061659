// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_law.h"

#include "laws/law_list.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

/// Gives values places, those that change their sign and others apart.
class Places {
 public:
  HistoryPlaces take(int num_odd, int num_even)
  {
    HistoryPlaces places{};
    int n = 0;
    for (; n < num_odd; n++) places[n] = odd++;
    for (; n < num_odd + num_even; n++) places[n] = even++;
    return places;
  }
  bool fit() const { return odd <= first_even && even <= ContactBatch::history_size; }
  int size() const { return even > first_even ? even : odd; }

 private:
  static constexpr int first_even = 3;
  int odd = 0, even = first_even;
};

}    // namespace

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
    layout.of_stage[s] = places.take(laws[s]->odd_history, laws[s]->even_history);
    reads_impact = reads_impact || laws[s]->reads_impact;
  }
  const bool tangential_remembers = tangential().odd_history + tangential().even_history > 0;
  layout.keeps_impact = tangential_remembers && reads_impact;
  if (layout.keeps_impact) layout.impact = places.take(0, 3);
  layout.fits = places.fit();
  layout.size = places.size();
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
  return first_coefficient(Stage::COHESION) + cohesion().num_coefficients;
}

double ContactLaw::coefficient(Stage stage, const char *name, const ContactCoefficients &row) const
{
  const Law &law = (*this)[stage];
  for (int n = 0; n < law.num_coefficients; n++)
    if (std::strcmp(law.coefficients[n].name, name) == 0) return coefficients(stage, row)[n];
  return 0.0;
}

std::string describe_law(const ContactLaw &law)
{
  std::string text, last;
  for (int s = 0; s < num_stages; s++) {
    const char *label = law[static_cast<Stage>(s)].label;
    if (!label || last == label) continue;
    text += (text.empty() ? "" : " + ") + std::string(label);
    last = label;
  }
  return text;
}

}    // namespace Talus
