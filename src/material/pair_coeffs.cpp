// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/pair_coeffs.h"

#include "base/simd.h"
#include "laws/second_order_laws.h"

#include <algorithm>

namespace Talus {
namespace {

void take_moduli(ContactSpec &to, const ContactSpec &from)
{
  for (const char *name : {"E", "nu"}) to.given[name] = from.given.value(name);
}

}    // namespace

void PairCoeffs::resize(int ntypes)
{
  types = ntypes;
  entries.assign((types + 1) * (types + 1), Entry{});
  changes++;
}

bool PairCoeffs::can_mix(int i, int j) const
{
  if (!is_set(i, i) || !is_set(j, j)) return false;
  const ContactSpec &a = spec(i, i), &b = spec(j, j);
  const auto both_or_none = [&](const char *name) {
    return a.given.has(name) == b.given.has(name);
  };
  return a.law == b.law && (!a.is_material() || (both_or_none("kt") && both_or_none("gt")));
}

const ContactLaw &PairCoeffs::law(int i, int j) const
{
  return (is_set(i, j) ? spec(i, j) : spec(i, i)).law;
}

ContactSides PairCoeffs::sides(int i, int j) const
{
  if (!is_set(i, j)) return {spec(i, i), spec(j, j), mix};
  ContactSides pair{spec(i, j), spec(i, j), mix};
  if (takes_moduli_of_types(pair.a)) {
    take_moduli(pair.a, spec(i, i));
    take_moduli(pair.b, spec(j, j));
  }
  return pair;
}

ContactCoefficients PairCoeffs::coefficients(int i, int j) const
{
  return sides(i, j).coefficients();
}

std::string PairCoeffs::note_on(int i, int j) const
{
  if (!is_set(i, j)) return "; mixed";
  return takes_moduli_of_types(spec(i, j)) ? "; E and nu of both types" : "";
}

int PairCoeffs::type_without_moduli(int i, int j) const
{
  if (!is_set(i, j) || !takes_moduli_of_types(spec(i, j))) return 0;
  for (int type : {i, j})
    if (const ContactSpec *one = own(type); !one || !one->is_material()) return type;
  return 0;
}

bool PairCoeffs::conducts_heat() const
{
  return std::any_of(entries.begin(), entries.end(),
                     [](const Entry &one) { return one.set && one.spec.law.conducts_heat(); });
}

bool PairCoeffs::shares_liquid() const
{
  return std::any_of(entries.begin(), entries.end(), [](const Entry &one) {
    return one.set && one.spec.law.cohesion().shares_liquid;
  });
}

bool PairCoeffs::reaches() const
{
  return std::any_of(entries.begin(), entries.end(),
                     [](const Entry &one) { return one.set && one.spec.law.reaches(); });
}

double PairCoeffs::pulloff_distance(int i, int j, double radius_i, double radius_j) const
{
  return pulloff_distance_of(law(i, j), coefficients(i, j), radius_i, radius_j);
}

std::string PairCoeffs::reason_against_second_order(int i, int j) const
{
  return Talus::reason_against_second_order(law(i, j), coefficients(i, j));
}

LawTable PairCoeffs::table(int order) const
{
  if (order == 2) {
    PairCoeffs second = *this;
    for (Entry &one : second.entries)
      if (one.set) one.spec.law = second_order_law(one.spec.law);
    return second.table();
  }

  int any_i = 1, any_j = 1;
  for (int i = types; i >= 1; i--)
    for (int j = types; j >= i; j--)
      if (known(i, j)) {
        any_i = i;
        any_j = j;
      }

  LawTable table;
  table.reset(types);
  for (int i = 1; i <= types; i++)
    for (int j = i; j <= types; j++) {
      const int a = known(i, j) ? i : any_i, b = known(i, j) ? j : any_j;
      table.set(i, j, law(a, b), coefficients(a, b));
    }
  table.finish();
  return table;
}

std::string PairCoeffs::describe_pair(int i, int j) const
{
  return "types " + std::to_string(i) + " " + std::to_string(j) + ": " +
         sides(i, j).describe(note_on(i, j));
}

std::string PairCoeffs::describe(const LawTable &table) const
{
  std::string text = std::to_string(table.num_laws()) + " kernel(s), " + instruction_set() + "\n";
  constexpr int most = 10;
  int lines = 0;
  for (int i = 1; i <= types; i++)
    for (int j = i; j <= types; j++)
      if (known(i, j) && lines++ < most) text += "  " + describe_pair(i, j) + "\n";
  if (lines > most) text += "  ... " + std::to_string(lines - most) + " more pairs of types\n";

  std::string spared;
  if (!table.has_resistance())
    spared += ", torques of resistance (no rolling or spinning resistance)";
  if (!table.keeps_impact()) spared += ", impact velocity and age of contacts (no law reads them)";
  if (!table.has_history()) spared += ", contact history (no law with a spring)";
  if (!table.has_friction()) spared += ", angular velocities and torques (no friction)";
  if (table.uniform()) spared += ", coefficients by type (one set for all)";
  return spared.empty() ? text : text + "  not needed here: " + spared.substr(2) + "\n";
}

}    // namespace Talus
