// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws and coefficients as the slow references know them: by name, and all numbers side by side.

#ifndef TALUS_TEST_NAMED_LAW_H
#define TALUS_TEST_NAMED_LAW_H

#include "laws/contact_kernel.h"
#include "laws/law_list.h"
#include "material/law_table.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace named {

using Talus::ContactCoefficients;
using Talus::ContactLaw;
using Talus::Stage;

enum class Normal {
  HOOKE,
  HERTZ,
  FLORES,
  PLAINCOULOMB,
  HOOKE_MATERIAL,
  HERTZ_MATERIAL,
  FLORES_MATERIAL,
  PLAINCOULOMB_MATERIAL
};
enum class Tangential {
  NONE,
  DASHPOT,
  ONESTEP,
  MULTISTEP,
  TANH,
  MIDPOINT,
  SLIDER,
  SLIDER_MIDPOINT
};
enum class Adhesion { NONE, CONSTANT, DMT, PERKO };
inline constexpr int num_normal_laws = 8, num_tangential_laws = 8, num_adhesions = 4;

inline const char *name_of(Normal law)
{
  const char *const names[] = {
      "hooke",          "hertz",          "flores",          "plaincoulomb",
      "hooke/material", "hertz/material", "flores/material", "plaincoulomb/material"};
  return names[static_cast<int>(law)];
}
inline const char *name_of(Tangential law)
{
  const char *const names[] = {"none",
                               "dashpot",
                               "onestep",
                               "multistep",
                               "tanh",
                               "multistep midpoint",
                               "multistep slider",
                               "multistep slider midpoint"};
  return names[static_cast<int>(law)];
}
inline const char *name_of(Adhesion law)
{
  const char *const names[] = {"none", "constant", "dmt", "perko"};
  return names[static_cast<int>(law)];
}
inline const char *damping_of(Normal law)
{
  const char *const names[] = {"mass_velocity", "viscoelastic", "flores",          "plaincoulomb",
                               "restitution",   "restitution",  "flores/material", "restitution"};
  return names[static_cast<int>(law)];
}

struct NamedLaw {
  Normal normal = Normal::HOOKE;
  Tangential tangential = Tangential::NONE;
  bool resists = false, delayed = false;
  Adhesion adhesion = Adhesion::NONE;

  ContactLaw law() const
  {
    ContactLaw law;
    const auto choose = [&](Stage stage, const char *name) {
      law.choose(stage, Talus::find_law(stage, name));
    };
    choose(Stage::NORMAL, name_of(normal));
    choose(Stage::DAMPING, damping_of(normal));
    choose(Stage::TANGENTIAL, name_of(tangential));
    choose(Stage::ROLLING, !resists ? "none" : delayed ? "delayed" : "holding");
    choose(Stage::TWISTING, !resists ? "none" : delayed ? "delayed" : "stopping");
    choose(Stage::COHESION, name_of(adhesion));
    return law;
  }
  operator ContactLaw() const { return law(); }

  // what the laws say of themselves, as the equations have it
  bool has_friction() const { return tangential != Tangential::NONE || resists; }
  bool has_history() const
  {
    return tangential == Tangential::MULTISTEP || tangential >= Tangential::MIDPOINT;
  }
  bool has_impact() const
  {
    const bool speed = normal == Normal::HOOKE_MATERIAL || normal == Normal::FLORES_MATERIAL;
    return has_history() && (speed || (resists && delayed));
  }
};

/// All coefficients of a contact. Moduli and damping factors of material laws count as kn, kt, gn, gt.
struct Numbers {
  double kn = 0.0, gn = 0.0, kt = 0.0, gt = 0.0, mu = 0.0;
  double force_floor = 0.0, speed = 0.0, mu_roll = 0.0, mu_twist = 0.0;
  double adhesion = 0.0;    ///< of the one kind that a law has
  double slip_min = 0.0, roll_min = 0.0, twist_min = 0.0;
};

inline double &number(Numbers &n, const std::string &name)
{
  if (name == "kn" || name == "E_eff") return n.kn;
  if (name == "gn" || name == "damping") return n.gn;
  if (name == "kt" || name == "G_eff") return n.kt;
  if (name == "gt" || name == "tangential damping") return n.gt;
  if (name == "mu") return n.mu;
  if (name == "floor") return n.force_floor;
  if (name == "vchar") return n.speed;
  if (name == "mu_r") return n.mu_roll;
  if (name == "mu_s") return n.mu_twist;
  if (name == "adhesion") return n.adhesion;
  if (name == "slip_min") return n.slip_min;
  if (name == "roll_min") return n.roll_min;
  if (name == "twist_min") return n.twist_min;
  throw std::logic_error("no coefficient " + name);
}

/// visit(number of the row, its place among the Numbers)
template <class Row, class Visit>
void for_each_coefficient(const ContactLaw &law, Row &row, Numbers &numbers, Visit visit)
{
  int place = 0;
  for (int s = 0; s < Talus::num_stages; s++) {
    const Talus::Law &stage_law = law[static_cast<Stage>(s)];
    for (int n = 0; n < stage_law.num_coefficients; n++)
      visit(row.c[place++], number(numbers, stage_law.coefficients[n].name));
  }
}

inline ContactCoefficients row_of(const ContactLaw &law, Numbers numbers)
{
  ContactCoefficients row;
  for_each_coefficient(law, row, numbers, [](double &to, double from) { to = from; });
  return row;
}

inline Numbers numbers_of(const ContactLaw &law, const ContactCoefficients &row)
{
  Numbers numbers;
  for_each_coefficient(law, row, numbers, [](double from, double &to) { to = from; });
  return numbers;
}

/// Which of the combinations of normal and tangential law it is.
inline NamedLaw named_law(const ContactLaw &law)
{
  NamedLaw found;
  for (int n = 0; n < num_normal_laws; n++)
    if (name_of(static_cast<Normal>(n)) == std::string(law.normal().name))
      found.normal = static_cast<Normal>(n);
  for (int t = 0; t < num_tangential_laws; t++)
    if (name_of(static_cast<Tangential>(t)) == std::string(law.tangential().name))
      found.tangential = static_cast<Tangential>(t);
  return found;
}

/// A pair of types gets a law with these numbers.
inline void set(Talus::LawTable &table, int i, int j, NamedLaw law, const Numbers &numbers)
{
  table.set(i, j, law, row_of(law, numbers));
}

}    // namespace named

#endif
