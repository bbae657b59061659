// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/law_book.h"

#include "base/simd.h"

#include <cstdio>

using namespace LAMMPS_NS;
using namespace Talus;

void LawBook::resize(int ntypes)
{
  types = ntypes;
  entries.assign((types + 1) * (types + 1), Entry{});
}

bool LawBook::can_mix(int i, int j) const
{
  if (!is_set(i, i) || !is_set(j, j)) return false;
  const ContactSpec &a = spec(i, i), &b = spec(j, j);
  // a number for one material and NULL for the other, or adhesion by different laws, have no common
  // meaning
  const bool same_words = a.kt_given == b.kt_given && a.gt_given == b.gt_given;
  const auto kind = [](const ContactCoefficients &c) {
    return c.adhesion > 0.0 ? 1 : c.adhesion_dmt > 0.0 ? 2 : c.adhesion_perko > 0.0 ? 3 : 0;
  };
  return a.law == b.law && (same_words || !a.is_material()) && kind(a.given) == kind(b.given);
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

std::string LawBook::describe_pair(int i, int j) const
{
  const ContactLaw l = law(i, j);
  const ContactCoefficients c = coefficients(i, j);
  const bool material = l.normal >= NormalLaw::HOOKE_MATERIAL;
  std::string text = "types " + std::to_string(i) + " " + std::to_string(j) + ": " +
                     describe_law(l) + (is_set(i, j) ? ";" : "; mixed;");
  const auto add = [&text](const char *name, double value) {
    char word[64];
    snprintf(word, sizeof word, " %s %.6g", name, value);
    text += word;
  };
  add(material ? "E_eff" : "kn", c.kn);
  add(material ? "damping" : "gn", c.gn);
  if (l.tangential != TangentialLaw::NONE && l.tangential != TangentialLaw::TANH) {
    add(material ? "G_eff" : "kt", c.kt);
    add(material ? "tangential damping" : "gt", c.gt);
  }
  if (l.tangential != TangentialLaw::NONE) add("mu", c.mu);
  if (l.resists) add("mu_r", c.mu_roll);
  if (l.resists) add("mu_s", c.mu_twist);
  if (l.adheres) add("adhesion", c.adhesion + c.adhesion_dmt + c.adhesion_perko);
  if (c.force_floor == 0.0) text += " limit_damping";
  return text;
}

std::string LawBook::describe(const LawTable &table) const
{
  std::string text = std::to_string(table.num_laws()) + " kernel(s), " + instruction_set() + "\n";
  constexpr int most = 10;
  int lines = 0;
  for (int i = 1; i <= types; i++)
    for (int j = i; j <= types; j++)
      if (known(i, j) && lines++ < most) text += "  " + describe_pair(i, j) + "\n";
  if (lines > most) text += "  ... " + std::to_string(lines - most) + " more pairs of types\n";

  std::string left_out;
  if (!table.has_resistance()) left_out += ", torques of resistance (no rolling or spinning resistance)";
  if (!table.has_impact()) left_out += ", impact velocity and age of contacts (no law reads them)";
  if (!table.has_history()) left_out += ", contact history (no multistep law)";
  if (!table.has_friction()) left_out += ", angular velocities and torques (no friction)";
  if (table.uniform()) left_out += ", look-up by type (one set of coefficients)";
  return left_out.empty() ? text : text + "  left out: " + left_out.substr(2) + "\n";
}

std::string LAMMPS_NS::describe_law(ContactLaw law)
{
  std::string text = std::string(name_of(law.normal)) + " + " + name_of(law.tangential);
  if (law.resists) text += law.delayed ? " + delayed resistance" : " + resistance";
  if (law.adheres) text += " + adhesion";
  return text;
}
