// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of one pair of materials, one for each stage, and what follows from their choice: which
// coefficients a row holds, what the history of a contact is, what has to be read and computed.

#ifndef TALUS_LAWS_CONTACT_LAW_H
#define TALUS_LAWS_CONTACT_LAW_H

#include "laws/law.h"

#include <array>
#include <string>

namespace Talus {

/// Indices of the history values of each law in ContactBatch::history. Values that change their
/// sign if the bodies are exchanged have the indices 0 to 2.
struct HistoryLayout {
  std::array<HistoryIndices, num_stages> of_stage{};
  HistoryIndices impact{};    ///< speed, age, and 1 after the first step
  bool keeps_impact = false;
  int size = 0;    ///< indices in use
};

/// Vectors among the history values, by the indices of their components.
struct HistoryVectors {
  int count = 0;
  std::array<std::array<int, 3>, ContactBatch::history_size / 3> index{};
};

/// Which laws a pair uses; pairs with equal laws share a kernel.
class ContactLaw {
 public:
  /// The first law of each stage in the list: hooke, frictionless.
  ContactLaw();

  void choose(Stage stage, const Law *law) { laws[static_cast<int>(stage)] = law; }
  const Law &operator[](Stage stage) const { return *laws[static_cast<int>(stage)]; }
  const Law &normal() const { return (*this)[Stage::NORMAL]; }
  const Law &damping() const { return (*this)[Stage::DAMPING]; }
  const Law &tangential() const { return (*this)[Stage::TANGENTIAL]; }
  const Law &rolling() const { return (*this)[Stage::ROLLING]; }
  const Law &twisting() const { return (*this)[Stage::TWISTING]; }
  const Law &cohesion() const { return (*this)[Stage::COHESION]; }
  const Law &heat() const { return (*this)[Stage::HEAT]; }

  bool operator==(const ContactLaw &o) const { return laws == o.laws; }
  bool operator!=(const ContactLaw &o) const { return laws != o.laws; }

  /// There is rolling or spinning resistance.
  bool resists() const { return rolling().acts || twisting().acts; }
  bool conducts_heat() const { return heat().acts; }
  /// twisting_torque is written: there are torques other than those of one force at both surfaces.
  bool twists() const { return resists() || tangential().lever_arms; }
  bool synchronized() const { return tangential().synchronized; }
  bool delayed() const { return rolling().delayed || twisting().delayed; }
  /// Contacts that have begun last while bodies are apart.
  bool lasts_beyond_contact() const
  {
    return normal().lasts_beyond_contact || bridges() || reaches();
  }
  /// By a force of its own, while all others end at zero overlap.
  bool bridges() const { return cohesion().lasts_beyond_contact; }
  /// Heat flows through gaps as well, whether bodies have touched or not, up to a pull-off distance that is in
  /// proportion to the effective radius.
  bool reaches() const { return heat().lasts_beyond_contact; }
  /// The first stage that acts where bodies are apart, if it is one behind the normal law; see end_of_touch.h.
  bool acts_apart_from(Stage stage) const
  {
    return stage == Stage::COHESION ? bridges() : stage == Stage::HEAT && reaches() && !bridges();
  }
  /// The stage whose law tells how far they last.
  Stage stage_of_pulloff() const
  {
    return reaches() ? Stage::HEAT : bridges() ? Stage::COHESION : Stage::NORMAL;
  }
  /// The whole normal force takes work, of which stored energies are a part: else only damping does,
  /// and what is stored has all come from the elastic force.
  bool whole_force_works() const
  {
    return normal().lasts_beyond_contact || bridges() || normal().hysteretic;
  }
  /// Angular velocities are read, and torques computed.
  bool has_friction() const
  {
    return tangential().acts || twists() || bridges() ||
           conducts_heat();    // heat: like walls beside it
  }
  /// The tangential spring changes with the overlap while it is stretched.
  bool stiffens() const
  {
    return tangential().reads_stiffness ? normal().exponent > 1.0 : tangential().stiffens;
  }
  /// Contacts have a history.
  bool has_history() const { return history().size > 0; }
  /// In records of four values.
  int history_records() const { return (history().size + 3) / 4; }
  /// The effective radius is needed.
  bool needs_radius() const;
  HistoryLayout history() const;
  /// The three values of a tangential law that change their sign, and of rolling as many as there are
  /// threes: they turn with the surface that the contact is on.
  HistoryVectors vectors_in_history() const;

  /// Place of a stage's first coefficient in a row, and behind the last one of the last stage.
  int first_coefficient(Stage stage) const;
  int num_coefficients() const;
  /// Of a synchronized law.
  int place_of_time_step() const { return first_coefficient(Stage::ROLLING) - 1; }
  const double *coefficients(Stage stage, const ContactCoefficients &row) const
  {
    return row.c + first_coefficient(stage);
  }
  /// The coefficient of this name, 0 if the law has none.
  double coefficient(Stage stage, const char *name, const ContactCoefficients &row) const;

 private:
  std::array<const Law *, num_stages> laws;
};

/// Of two particles with these radii, > 0.
template <class Real> TALUS_INLINE ContactSize<Real> size_of_pair(Real radius_i, Real radius_j)
{
  constexpr double of_unit_ball = 4.0 / 3.0 * 3.14159265358979323846;
  const auto volume = [](Real r) { return of_unit_ball * r * r * r; };
  return {radius_i * radius_j / (radius_i + radius_j), volume(radius_i) + volume(radius_j)};
}

/// How far a contact of particles with these radii lasts beyond zero overlap (length); 0 if a
/// radius is.
double pulloff_distance_of(const ContactLaw &law, const ContactCoefficients &row, double radius_i,
                           double radius_j);
/// The same of one particle and a flat body.
double pulloff_distance_of(const ContactLaw &law, const ContactCoefficients &row, double radius);

/// A law in words, e.g. "hertz + multistep + resistance".
std::string describe_law(const ContactLaw &law);

}    // namespace Talus

#endif
