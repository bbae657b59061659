// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/fused_kernels.h"

#include "laws/approach.h"
#include "laws/contact_work.h"
#include "laws/damping/coeff_restitution.h"
#include "laws/damping/mass_velocity.h"
#include "laws/damping/restitution.h"
#include "laws/damping/tsuji.h"
#include "laws/damping/viscoelastic.h"
#include "laws/law_list.h"
#include "laws/none.h"
#include "laws/normal/hertz.h"
#include "laws/normal/hertz_material.h"
#include "laws/normal/hooke.h"
#include "laws/normal/jkr.h"
#include "laws/rolling/sds.h"
#include "laws/second_order_laws.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/multistep.h"
#include "laws/tangential/none.h"
#include "laws/tangential/onestep.h"
#include "laws/tangential/second_order.h"
#include "laws/twisting/marshall.h"

#include <algorithm>

namespace Talus {
namespace {

// A contact is a long chain of operations that wait for each other, too long for a processor to
// look beyond it to the next one. So these kernels compute two vectors of the machine at a time.
#if defined(__AVX512F__)
using Wide = DoubleWidth<Vec8>;
#else
using Wide = Vec8;
#endif
template <class Real> inline constexpr int width_of = sizeof(Real) / sizeof(double);

template <class... Laws>
inline constexpr int coefficients_of = (0 + ... + num_coefficients_of<Laws>());
template <class... Laws> inline constexpr int values_of = (0 + ... + history_size_of<Laws>);

template <class Normal, class Damping, class Tangential, class Rolling, class Twisting>
struct Fused {
  static constexpr int history_size = values_of<Tangential, Rolling, Twisting>;
  static constexpr bool with_radius = Normal::needs_radius || Damping::needs_radius ||
                                      Tangential::needs_radius || Rolling::needs_radius ||
                                      Twisting::needs_radius;
  static constexpr bool twists = Tangential::lever_arms || Rolling::acts || Twisting::acts;

  template <class Real> struct Rows {
    typename Normal::template Row<Real> normal;
    typename Damping::template Row<Real> damping;
    typename Tangential::template Row<Real> tangential;
    typename Rolling::template Row<Real> rolling;
    typename Twisting::template Row<Real> twisting;
  };

  template <class Real> TALUS_INLINE static Rows<Real> rows(const double *c)
  {
    return {spread<Normal, Real>(c), spread<Damping, Real>(c + coefficients_of<Normal>),
            spread<Tangential, Real>(c + coefficients_of<Normal, Damping>),
            spread<Rolling, Real>(c + coefficients_of<Normal, Damping, Tangential>),
            spread<Twisting, Real>(c + coefficients_of<Normal, Damping, Tangential, Rolling>)};
  }

  /// The contacts from lane k on, as many as a Real is wide; `accounts`: and their work.
  template <bool accounts, class Real>
  TALUS_INLINE static void compute(ContactBatch &b, int k, const Rows<Real> &c,
                                   const StageInput &in)
  {
    if constexpr (Tangential::second_order) {
      if (any_at_event<Tangential, Real>(b, k, in.history_index)) {
        for (int n = 0; n < width_of<Real>; n += lanes) compute_ends<accounts>(b, k + n, in);
        return;
      }
    }
    compute_lanes<accounts, false>(b, k, c, in);
  }

  template <bool accounts>
  [[gnu::noinline]] static void compute_ends(ContactBatch &b, int k, const StageInput &in)
  {
    compute_lanes<accounts, true>(b, k, rows<Vec8>(in.table[0].c), in);
  }

  template <bool accounts, bool ends, class Real>
  TALUS_INLINE static void compute_lanes(ContactBatch &b, int k, const Rows<Real> &c,
                                         const StageInput &in)
  {
    ContactLanes<Real> s;
    load_state(b, k, s);
    approach<with_radius>(s);
    Real history[history_size + 1];    // none has no length 0
    for (int n = 0; n < history_size; n++)
      history[n] = Memory<Real>::load(&b.history[in.history_index[n]][k]);
    Normal::template compute<true>(c.normal, s, history, in.dt);
    Damping::template compute<true>(c.damping, s, history, in.dt);
    if constexpr (Tangential::acts) {
      compute_law<Tangential, true, ends>(c.tangential, s, history, in.dt);
      Real *const of_rolling = history + values_of<Tangential>;
      if constexpr (Rolling::acts) Rolling::template compute<true>(c.rolling, s, of_rolling, in.dt);
      if constexpr (Twisting::acts)
        Twisting::template compute<true>(c.twisting, s, of_rolling + values_of<Rolling>, in.dt);
      store_vector(b.torque_per_radius, k, s.torque_per_radius);
      if constexpr (twists) store_vector(b.twisting_torque, k, s.twisting_torque);
    }
    store_vector(b.force, k, s.force);
    if constexpr (accounts) account(b, k, s, in.dt);
    for (int n = 0; n < history_size; n++)
      Memory<Real>::store(&b.history[in.history_index[n]][k], history[n]);
  }

  template <class Real>
  TALUS_INLINE static void account(ContactBatch &b, int k, const ContactLanes<Real> &s, double dt)
  {
    ContactWork<Real> work;
    find_work<Tangential::acts, twists, Rolling::acts || Twisting::acts,
              Normal::lasts_beyond_contact>(s, dt, work);
    for (int n = 0; n < ContactBatch::num_causes; n++) Memory<Real>::store(&b.work[n][k], work[n]);
  }

  template <bool accounts>
  static void run(ContactBatch &b, int begin, int end, const StageInput &in)
  {
    const Rows<Wide> wide = rows<Wide>(in.table[0].c);
    int k = begin;
    for (; k + width_of<Wide> <= end; k += width_of<Wide>) compute<accounts, Wide>(b, k, wide, in);
    const Rows<Vec8> rest = rows<Vec8>(in.table[0].c);
    for (; k < end; k += lanes) compute<accounts, Vec8>(b, k, rest, in);
  }
};

/// Laws by their names: what is in their lists is not compiled here once more.
struct Entry {
  const char *normal, *damping, *tangential, *rolling, *twisting;
  bool second_order;
  StageFunction function, accounting;
};

template <class Normal, class Damping, class Tangential, class Rolling = NoRolling,
          class Twisting = NoTwisting>
constexpr Entry entry()
{
  using Its = Fused<Normal, Damping, Tangential, Rolling, Twisting>;
  return {Normal::name,
          Damping::name,
          Tangential::name,
          Rolling::name,
          Twisting::name,
          Tangential::second_order,
          Its::template run<false>,
          Its::template run<true>};
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
    entry<Hooke, MassVelocity, SecondOrder<Friction::SPRING>>(),
    entry<Hertz, Viscoelastic, SecondOrder<Friction::SPRING>>(),
    entry<HertzMaterial, RestitutionDamping, SecondOrder<Friction::SPRING>>(),
    entry<Hertz, Viscoelastic, Mindlin>(),
    entry<Hertz, Tsuji, Mindlin>(),
    entry<Hertz, CoeffRestitution, Mindlin>(),
    entry<Hertz, Tsuji, Mindlin, SdsRolling, MarshallTwist>(),
    entry<Jkr, Viscoelastic, Mindlin>(),
};

const Entry *entry_of(const ContactLaw &law)
{
  const std::vector<ContactLaw> laws = fused_laws();
  const auto found = std::find(laws.begin(), laws.end(), law);
  return found == laws.end() ? nullptr : &entries[found - laws.begin()];
}

}    // namespace

StageFunction fused_function(const ContactLaw &law)
{
  const Entry *entry = entry_of(law);
  return entry ? entry->function : nullptr;
}

StageFunction fused_accounting_function(const ContactLaw &law)
{
  const Entry *entry = entry_of(law);
  return entry ? entry->accounting : nullptr;
}

std::vector<ContactLaw> fused_laws()
{
  std::vector<ContactLaw> laws;
  for (const Entry &e : entries) {
    ContactLaw law;
    law.choose(Stage::NORMAL, find_law(Stage::NORMAL, e.normal));
    law.choose(Stage::DAMPING, find_law(Stage::DAMPING, e.damping));
    law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, e.tangential));
    law.choose(Stage::ROLLING, find_law(Stage::ROLLING, e.rolling));
    law.choose(Stage::TWISTING, find_law(Stage::TWISTING, e.twisting));
    laws.push_back(e.second_order ? second_order_law(law) : law);
  }
  return laws;
}

}    // namespace Talus
