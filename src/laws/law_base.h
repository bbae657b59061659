// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What laws are derived from, one struct for each stage: what is so unless a law says otherwise. See law_definition.h.

#ifndef TALUS_LAWS_LAW_BASE_H
#define TALUS_LAWS_LAW_BASE_H

#include "base/simd.h"
#include "laws/given_law.h"
#include "laws/law.h"

#include <cstddef>

namespace Talus {

struct LawBase {
  template <class Real> struct Row {
  };
  static constexpr CoefficientName coefficients[] = {{nullptr}};    // none
  static Row<double> mix(const Mixing & /*m*/) { return {}; }
  static constexpr std::nullptr_t read = nullptr;
  template <class AnyRow>
  static double stored(const ContactLanes<double> & /*s*/, const AnyRow & /*c*/,
                       const double * /*history*/)
  {
    return 0.0;
  }

  static constexpr bool acts = true, needs_radius = false, reads_impact = false;
  static constexpr bool reads_stiffness = false, has_spring = false, stiffens = false;
  static constexpr bool is_midpoint = false, synchronized = false;
  static constexpr bool holds = false, delayed = false, like_stock = false;
  static constexpr bool lever_arms = false, cohesive = false, allows_cohesion = true;
  static constexpr bool lasts_beyond_contact = false, second_order = false, hysteretic = false;
  static constexpr bool reads_sums_alone = false, shares_liquid = false;
  static constexpr const char *takes_no_kt = nullptr, *takes_no_gt = nullptr, *needs_gt = nullptr;
  static constexpr int odd_history = 0, even_history = 0;
  /// Tangential, rolling, twisting: what integrators of second order take in its place, nullptr if there
  /// is nothing; `adhesive`: the normal law has adhesion of its own. See second_order_laws.h.
  static constexpr std::nullptr_t order_2 = nullptr;
  static constexpr double exponent = 1.0;
  /// Normal, cohesion and heat: the third power of how far a contact lasts beyond zero overlap (length), of heat in
  /// proportion to the radius; only called if lasts_beyond_contact.
  template <class Row, class Real>
  static Real pulloff_cube(const Row & /*c*/, const ContactSize<Real> & /*size*/)
  {
    return Real{};
  }
};

/// Finds kn, kt, tangent_n, tangent_t, contact_radius, elastic; with adhesion of its own
/// pulloff_force.
struct NormalLaw : LawBase {
  static constexpr Stage stage = Stage::NORMAL;
  static constexpr const char *damping = "mass_velocity";

  /// kn and gn without their dependence on the overlap, as Chrono's rule for the collision time of
  /// delayed resistance takes them.
  template <class Real> static void reduce(Real /*overlap*/, Real & /*k*/, Real & /*g*/) {}
  template <class Row> static double modulus(const Row & /*c*/) { return 0.0; }
};

/// Finds gn, gt, normal_force and force; see finish_normal_force().
struct DampingLaw : LawBase {
  static constexpr Stage stage = Stage::DAMPING;
  static constexpr const char *label = nullptr;    // descriptions name it if it was asked for

  static void read_coefficient(LawReader &r) { r.set_not_negative("gn"); }
  /// gn ~ overlap^p with an elastic force ~ overlap^elastic: p = 0, 1/4, 1/2, 1 or 3/2. Read by
  /// laws of second order.
  static double damping_exponent(double elastic) = delete;
  /// The same of gt, where it is another one; below 0 if not.
  static double dashpot_exponent(double /*elastic*/) { return -1.0; }
};

/// Finds tangential and torque_per_radius, and twisting_torque if it has lever_arms, and adds to
/// force.
struct TangentialLaw : LawBase {
  static constexpr Stage stage = Stage::TANGENTIAL;
};

/// Adds to torque_per_radius, or to twisting_torque.
struct RollingLaw : LawBase {
  static constexpr Stage stage = Stage::ROLLING;
};

/// Adds to twisting_torque.
struct TwistingLaw : LawBase {
  static constexpr Stage stage = Stage::TWISTING;
};

/// Adds to force: an adhesive force that is constant while the bodies touch, times adhesive_share. Or,
/// if lasts_beyond_contact, any force and torque_per_radius of bodies that touch or have touched:
/// overlap is below 0 where they are apart, and the stages before have then found nothing.
struct CohesionLaw : LawBase {
  static constexpr Stage stage = Stage::COHESION;
  static constexpr const char *label = "adhesion";
  static constexpr double exponent = 0.0;
  static constexpr bool needs_radius = true;
};

/// Finds heat_flow. If lasts_beyond_contact, also of bodies that are apart, whether they have touched or not: the
/// stages before have then found nothing.
struct HeatLaw : LawBase {
  static constexpr Stage stage = Stage::HEAT;
  static constexpr bool needs_radius = true;    // for the contact radius of the normal law
};

}    // namespace Talus

#endif
