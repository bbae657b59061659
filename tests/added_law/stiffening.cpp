// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A contact law that Talus does not have, added by one file: a spring that is the stiffer the faster
// the particles met, F_e = k (1 + v_0/v_s) overlap with v_0 = |v_n| in the first step of the contact.
// Words: stiffening k vs gn. k force/distance, vs velocity, gn 1/time.

#include "laws/normal/common.h"

namespace Talus {
namespace {

struct Stiffening : LinearLaw {
  static constexpr const char *name = "stiffening", *label = name;
  static constexpr int even_history = 2;    // v_0, and 1 after the first step
  template <class Real> struct Row {
    Real k, speed;
  };
  static constexpr CoefficientName coefficients[] = {{"k"}, {"vs"}};

  static void read(LawReader &r)
  {
    r.spec.given["k"] = r.words.positive("k");
    r.spec.given["vs"] = r.words.positive("speed vs");
    read_damping(r, Damping::ANY);
  }
  static Row<double> mix(const Mixing &m) { return {m.mean("k"), m.smallest("vs")}; }

  template <bool advance, class Real>
  static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *history, double /*dt*/)
  {
    const Real one = splat<Real>(1.0), zero = splat<Real>(0.0);
    const Real met = select(history[1] > zero, history[0], magnitude(s.normal_velocity));
    s.kn = s.tangent_n = c.k * (one + met / c.speed);
    s.kt = s.tangent_t = (2.0 / 7.0) * s.kn;
    s.contact_radius = square_root(s.overlap * s.radius);
    s.elastic = s.kn * s.overlap;
    if (!advance) return;
    history[0] = met;
    history[1] = one;
  }
};

const AddedLaw added(law<Stiffening>);

}    // namespace
}    // namespace Talus
