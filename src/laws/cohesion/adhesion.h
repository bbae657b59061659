// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Adhesive forces of Chrono, constant as long as the particles overlap: F, W sqrt(R_eff) (dmt), S R_eff (after Perko).

#ifndef TALUS_LAWS_COHESION_ADHESION_H
#define TALUS_LAWS_COHESION_ADHESION_H

#include "laws/law_definition.h"

namespace Talus {

/// Model: name and words of the coefficient (force/length^p), and R_eff^p as of_radius().
template <class Model> struct Adhesion : CohesionLaw {
  static constexpr const char *name = Model::name;
  template <class Real> struct Row {
    Real strength;
  };
  static constexpr CoefficientName coefficients[] = {{"adhesion"}};

  static void read(LawReader &r)
  {
    r.spec.given[Model::given] = r.words.not_negative(Model::words);
  }
  static Row<double> mix(const Mixing &m) { return {m.smallest(Model::given)}; }
  static double stored(const ContactLanes<double> &s, const Row<double> &c,
                       const double * /*history*/)
  {
    return -force(c, s) * s.overlap;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.force = s.force - (s.adhesive_share * force(c, s)) * s.normal;
  }

 private:
  template <class Real>
  TALUS_INLINE static Real force(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    return Model::of_radius(c.strength, s.radius);
  }
};

struct ConstantModel {
  static constexpr const char *name = "constant", *given = "adhesive force",
                              *words = "adhesive force F";
  template <class Real> TALUS_INLINE static Real of_radius(Real f, Real /*radius*/) { return f; }
};

struct DmtModel {
  static constexpr const char *name = "dmt", *given = "adhesion W", *words = given;
  template <class Real> TALUS_INLINE static Real of_radius(Real w, Real radius)
  {
    return w * square_root(radius);
  }
};

struct PerkoModel {
  static constexpr const char *name = "perko", *given = "adhesion S", *words = given;
  template <class Real> TALUS_INLINE static Real of_radius(Real s, Real radius)
  {
    return s * radius;
  }
};

}    // namespace Talus

#endif
