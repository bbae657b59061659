// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/law_table.h"

#include <algorithm>
#include <cstring>

namespace Talus {

void LawTable::reset(int ntypes)
{
  types = ntypes;
  rows.assign(static_cast<std::size_t>(ntypes) * ntypes, ContactCoefficients{});
  laws.assign(rows.size(), ContactLaw{});
  index_of_row.assign(rows.size(), 0);
  distinct.clear();
}

void LawTable::set(int i, int j, const ContactLaw &law, const ContactCoefficients &coefficients)
{
  for (int r : {row(i, j), row(j, i)}) {
    rows[r] = coefficients;
    laws[r] = law;
  }
}

void LawTable::finish()
{
  one_row = true;
  distinct.clear();
  for (std::size_t r = 0; r < rows.size(); r++) {
    auto found = std::find(distinct.begin(), distinct.end(), laws[r]);
    index_of_row[r] = static_cast<int>(found - distinct.begin());
    if (found == distinct.end()) distinct.push_back(laws[r]);
    one_row = one_row && laws[r] == laws[0] &&
              std::memcmp(&rows[r], &rows[0], sizeof(ContactCoefficients)) == 0;
  }
  lasting.clear();
  advancing.clear();
  reading.clear();
  accounting.clear();
  accounting_at_rest.clear();
  for (const ContactLaw &law : distinct) {
    const Stage stage = law.stage_of_pulloff();
    lasting.push_back({law[stage].pulloff_cube, law.first_coefficient(stage)});
    advancing.push_back(contact_kernel(law, one_row, true));
    reading.push_back(contact_kernel(law, one_row, false));
    accounting.push_back(Talus::accounting_kernel(law, one_row, true));
    accounting_at_rest.push_back(Talus::accounting_kernel(law, one_row, false));
  }
}

template <class Predicate> bool LawTable::any(Predicate holds) const
{
  return std::any_of(distinct.begin(), distinct.end(), holds);
}

bool LawTable::has_friction() const
{
  return any([](const ContactLaw &law) { return law.has_friction() || law.has_history(); });
}

bool LawTable::has_history() const
{
  return any([](const ContactLaw &law) { return law.has_history(); });
}

int LawTable::history_records() const
{
  int most = 0;
  for (const ContactLaw &law : distinct) most = std::max(most, law.history_records());
  return most;
}

bool LawTable::keeps_impact() const
{
  return any([](const ContactLaw &law) { return law.history().keeps_impact; });
}

bool LawTable::has_resistance() const
{
  return any([](const ContactLaw &law) { return law.resists(); });
}

bool LawTable::has_twisting_torques() const
{
  return any([](const ContactLaw &law) { return law.twists(); });
}

bool LawTable::conducts_heat() const
{
  return any([](const ContactLaw &law) { return law.conducts_heat(); });
}

bool LawTable::shares_liquid() const
{
  return any([](const ContactLaw &law) { return law.cohesion().shares_liquid; });
}

bool LawTable::second_order() const
{
  return any([](const ContactLaw &law) { return law.tangential().second_order; });
}

bool LawTable::lasts_beyond_contact() const
{
  return any([](const ContactLaw &law) { return law.lasts_beyond_contact(); });
}

double LawTable::pulloff_distance(int row, double radius_i, double radius_j) const
{
  return pulloff_distance_of(laws[row], rows[row], radius_i, radius_j);
}

/* That of equal spheres: the effective radius is at most a quarter of the sum. */

double LawTable::largest_relative_reach() const
{
  double largest = 0.0;
  if (!any([](const ContactLaw &law) { return law.reaches(); })) return largest;
  for (std::size_t row = 0; row < rows.size(); row++)
    if (laws[row].reaches())
      largest = std::max(largest, pulloff_distance_of(laws[row], rows[row], 0.5, 0.5));
  return largest;
}

double LawTable::pulloff_distance(int row, double radius) const
{
  return pulloff_distance_of(laws[row], rows[row], radius);
}

bool LawTable::lasts(int row, double radius_i, double radius_j, double gap) const
{
  const Lasting &law = lasting[index_of_row[row]];
  if (!law.cube || radius_i <= 0.0 || radius_j <= 0.0) return false;
  const double cube =
      law.cube(rows[row].c + law.first_coefficient, size_of_pair(radius_i, radius_j));
  return cube > 0.0 && gap * gap * gap < cube;
}

}    // namespace Talus
