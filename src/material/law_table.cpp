// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/law_table.h"

#include "base/power.h"

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
  advancing.clear();
  reading.clear();
  accounting.clear();
  accounting_at_rest.clear();
  for (const ContactLaw &law : distinct) {
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

double LawTable::pulloff_distance(int row, double radius) const
{
  return pulloff_distance_of(laws[row], rows[row], radius);
}

Vec8 LawTable::limits_of_contacts(int row, Vec8 radius_i, Vec8 radius_j) const
{
  const ContactLaw &law = laws[row];
  const Vec8 zero{}, one = splat<Vec8>(1.0);
  if (!law.lasts_beyond_contact() || law.cohesion().shares_liquid) return zero;
  const Stage stage = law.stage_of_pulloff();
  const auto two = (radius_i > zero) & (radius_j > zero);
  Vec8 cubes;
  law[stage].pulloff_cubes(law.coefficients(stage, rows[row]),
                           size_of_pair(select(two, radius_i, one), select(two, radius_j, one)),
                           cubes);
  const Vec8 distance = select(cubes > zero, cube_root(select(cubes > zero, cubes, one)), zero);
  const Vec8 limit = radius_i + radius_j + distance, square = limit * limit;
  return select(two & (distance > zero), law.reaches() ? square : -square, zero);
}

}    // namespace Talus
