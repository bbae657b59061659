// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/fused_kernels.h"

#include "laws/approach.h"
#include "laws/damping/mass_velocity.h"
#include "laws/damping/restitution.h"
#include "laws/damping/viscoelastic.h"
#include "laws/law_list.h"
#include "laws/normal/hertz.h"
#include "laws/normal/hertz_material.h"
#include "laws/normal/hooke.h"
#include "laws/tangential/multistep.h"
#include "laws/tangential/none.h"
#include "laws/tangential/onestep.h"

#include <algorithm>

namespace Talus {
namespace {

// A contact is a long chain of operations that wait for each other, too long for a processor to
// look beyond it to the next one. So these kernels compute two vectors of the machine at a time.
#if defined(__AVX512F__)
using Wide = Twice<Vec8>;
#else
using Wide = Vec8;
#endif
constexpr int wide_lanes = sizeof(Wide) / sizeof(double);

template <class Normal, class Damping, class Tangential> struct Fused {
  static constexpr int remembered = history_size_of<Tangential>;
  static constexpr int first_of_damping = num_coefficients_of<Normal>();
  static constexpr int first_of_tangential = first_of_damping + num_coefficients_of<Damping>();

  template <class Real> struct Rows {
    typename Normal::template Row<Real> normal;
    typename Damping::template Row<Real> damping;
    typename Tangential::template Row<Real> tangential;
  };

  template <class Real> TALUS_INLINE static Rows<Real> rows(const double *c)
  {
    return {spread<Normal, Real>(c), spread<Damping, Real>(c + first_of_damping),
            spread<Tangential, Real>(c + first_of_tangential)};
  }

  /// The contacts from lane k on, as many as a Real is wide.
  template <class Real>
  TALUS_INLINE static void compute(ContactBatch &b, int k, const Rows<Real> &c,
                                   const StageInput &in)
  {
    ContactLanes<Real> s;
    load_state(b, k, s);
    approach<Normal::needs_radius>(s);
    Real history[remembered + 1];    // none has no length 0
    for (int n = 0; n < remembered; n++)
      history[n] = Memory<Real>::load(&b.history[in.places[n]][k]);
    Normal::template compute<true>(c.normal, s, history, in.dt);
    Damping::template compute<true>(c.damping, s, history, in.dt);
    if constexpr (Tangential::acts) {
      Tangential::template compute<true>(c.tangential, s, history, in.dt);
      store_vector(b.moment, k, s.moment);
    }
    store_vector(b.force, k, s.force);
    for (int n = 0; n < remembered; n++)
      Memory<Real>::store(&b.history[in.places[n]][k], history[n]);
  }

  static void run(ContactBatch &b, int begin, int end, const StageInput &in)
  {
    const Rows<Wide> wide = rows<Wide>(in.table[0].c);
    int k = begin;
    for (; k + wide_lanes <= end; k += wide_lanes) compute<Wide>(b, k, wide, in);
    const Rows<Vec8> rest = rows<Vec8>(in.table[0].c);
    for (; k < end; k += lanes) compute<Vec8>(b, k, rest, in);
  }
};

/// Laws by their names: what is in law_list.cpp is not compiled here once more.
struct Entry {
  const char *normal, *damping, *tangential;
  StageFunction function;
};

template <class Normal, class Damping, class Tangential> constexpr Entry entry()
{
  return {Normal::name, Damping::name, Tangential::name, Fused<Normal, Damping, Tangential>::run};
}

constexpr Entry entries[] = {
    entry<Hooke, MassVelocity, TangentialNone>(),
    entry<Hooke, MassVelocity, MultistepStock>(),
    entry<Hertz, Viscoelastic, TangentialNone>(),
    entry<Hertz, Viscoelastic, MultistepStock>(),
    entry<HertzMaterial, RestitutionDamping, TangentialNone>(),
    entry<HertzMaterial, RestitutionDamping, Onestep>(),
    entry<HertzMaterial, RestitutionDamping, MultistepStock>(),
    entry<HertzMaterial, RestitutionDamping, Multistep<false, true>>(),
};

}    // namespace

StageFunction fused_function(const ContactLaw &law)
{
  const std::vector<ContactLaw> laws = fused_laws();
  const auto found = std::find(laws.begin(), laws.end(), law);
  return found == laws.end() ? nullptr : entries[found - laws.begin()].function;
}

std::vector<ContactLaw> fused_laws()
{
  std::vector<ContactLaw> laws;
  for (const Entry &e : entries) {
    ContactLaw its;
    its.choose(Stage::NORMAL, find_law(Stage::NORMAL, e.normal));
    its.choose(Stage::DAMPING, find_law(Stage::DAMPING, e.damping));
    its.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, e.tangential));
    laws.push_back(its);
  }
  return laws;
}

}    // namespace Talus
