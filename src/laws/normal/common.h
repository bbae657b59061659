// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What several normal laws have in common. They turn coefficients and state of a contact into
//
//   F_e = kn overlap ,   kt
//
// with overlap = r_i + r_j - |x_i - x_j|; damping adds -gn v_n and gt. m and R are the effective
// mass and radius. The material laws and flores are those of the penalty solver of Project Chrono
// (Fleischmann, Serban, Negrut, Jayakumar, J. Comput. Nonlinear Dyn. 11, 044502, 2016).

#ifndef TALUS_LAWS_NORMAL_COMMON_H
#define TALUS_LAWS_NORMAL_COMMON_H

#include "laws/law_definition.h"
#include "laws/law_list.h"
#include "laws/restitution.h"

#include <cmath>

namespace Talus {

/// Spring constants. By number: arithmetic means; kt that was not given is 2/7 kn, as in the stock
/// styles. By material: effective moduli by compliance.
template <class Real> struct SpringRow {
  Real kn, kt;
};

template <class Law> struct SpringsByNumber : Law {
  template <class Real> using Row = SpringRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"kn"}, {"kt", Shown::WITH_SPRING}};

  static SpringRow<double> mix(const Mixing &m)
  {
    const auto kt = [](const ContactSpec &s) {
      return s.given.value("kt", 2.0 / 7.0 * s.given.value("kn"));
    };
    return {m.mean("kn"), 0.5 * (kt(m.a) + kt(m.b))};
  }
};

/// The damping coefficient of the words: of any damping law, or only of that of the normal law.
enum class Damping : bool { ANY, OWN };
inline void read_damping(LawReader &r, Damping damping)
{
  const Law *chosen = find_law(Stage::DAMPING, r.spec.law.normal().damping);
  r.spec.law.choose(Stage::DAMPING, chosen);
  if (damping == Damping::ANY) r.damping_at = r.words.index();
  // a bad number is one for all
  const double number = parse_number(r.words.peek());
  if (damping == Damping::ANY && std::isfinite(number) && number >= 0.0)
    r.words.skip(1);
  else
    chosen->read_coefficient(r);
}

/// kn, gn of the words.
inline void read_numbers(LawReader &r, Damping damping)
{
  r.set_not_negative("kn");
  read_damping(r, damping);
}

/// E, e, nu of the words; both E and nu may be NULL: those of two types, see moduli_of_types in
/// material/contact_spec.h.
inline void read_material(LawReader &r, Damping damping)
{
  GivenNumbers &given = r.spec.given;
  const bool of_types = r.words.take("NULL");
  if (!of_types) given["E"] = r.words.positive("Young's modulus E") * r.pressure_unit;
  read_damping(r, damping);
  if (!of_types)
    given["nu"] = r.words.between("Poisson's ratio nu", -1.0, 0.5, true);
  else if (r.words.take("NULL"))
    given["moduli_of_types"] = 1.0;
  else
    r.words.fail(0, "expected NULL for Poisson's ratio nu, as for Young's modulus E, instead of '" +
                        r.words.peek() + "'");
}

inline double mixed_young(const Mixing &m)
{
  const GivenNumbers &a = m.a.given, &b = m.b.given;
  return effective_young(a.value("E"), a.value("nu"), b.value("E"), b.value("nu"));
}

/// Effective shear modulus, or kt times `modulus_per_kt` if both have a number for it.
inline double mixed_shear(const Mixing &m, double modulus_per_kt)
{
  const GivenNumbers &a = m.a.given, &b = m.b.given;
  return m.both_have("kt")
             ? modulus_per_kt * m.mean("kt")
             : effective_shear(a.value("E"), a.value("nu"), b.value("E"), b.value("nu"));
}

/// Hertzian: elastic force ~ overlap^(3/2).
struct HertzianLaw : NormalLaw {
  static constexpr bool needs_radius = true;
  static constexpr double exponent = 1.5;

  template <class Real> static void reduce(Real overlap, Real &k, Real &g)
  {
    const Real root = square_root(overlap);
    k = k / root;
    g = g / square_root(root);
  }

  template <class Row>
  static double stored(const ContactLanes<double> &s, const Row & /*c*/, const double * /*history*/)
  {
    return 0.4 * s.elastic * s.overlap;
  }
};

/// Elastic force ~ overlap.
struct LinearLaw : NormalLaw {
  template <class Row>
  static double stored(const ContactLanes<double> &s, const Row & /*c*/, const double * /*history*/)
  {
    return 0.5 * s.elastic * s.overlap;
  }
};

}    // namespace Talus

#endif
