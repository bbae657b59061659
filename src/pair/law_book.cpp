// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/law_book.h"

using namespace LAMMPS_NS;
using namespace Talus;

void LawBook::resize(int ntypes)
{
  types = ntypes;
  entries.assign((types + 1) * (types + 1), Entry{});
}

bool LawBook::can_mix(int i, int j) const
{
  return is_set(i, i) && is_set(j, j) && spec(i, i).law == spec(j, j).law;
}

ContactLaw LawBook::law(int i, int j) const
{
  return (is_set(i, j) ? spec(i, j) : spec(i, i)).law;
}

ContactCoefficients LawBook::coefficients(int i, int j) const
{
  if (is_set(i, j)) return contact_coefficients(spec(i, j), spec(i, j), mix);
  return contact_coefficients(spec(i, i), spec(j, j), mix);
}

LawTable LawBook::table() const
{
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

std::string LAMMPS_NS::describe(ContactLaw law)
{
  std::string text = std::string(name_of(law.normal)) + " + " + name_of(law.tangential);
  if (law.resists) text += law.delayed ? " + delayed resistance" : " + resistance";
  if (law.adheres) text += " + adhesion";
  return text;
}
