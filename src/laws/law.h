// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What other code knows of a law. A contact goes through stages,
//
//   normal -> damping -> tangential -> rolling -> twisting -> cohesion -> heat,
//
// and a pair of materials names one law for each. A law is one file in the folder of its stage: a
// struct with its equation, its words, the mixing of two materials, its history and stored energy,
// and what it needs; see law_definition.h for what such a struct consists of. list.cpp of each
// stage names them.

#ifndef TALUS_LAWS_LAW_H
#define TALUS_LAWS_LAW_H

#include "laws/contact_batch.h"
#include "laws/contact_lanes.h"

#include <array>

namespace Talus {

enum class Stage : int { NORMAL, DAMPING, TANGENTIAL, ROLLING, TWISTING, COHESION, HEAT };
inline constexpr int num_stages = 7;

struct LawReader;
struct Mixing;

/// One row of the table of coefficients: those of all stages of one pair of materials, one behind
/// the other, see ContactLaw::first_coefficient().
struct ContactCoefficients {
  static constexpr int size = 32;
  double c[size] = {};
};

/// Of two bodies that may touch: effective radius (length) and volume of those that are particles.
template <class Real> struct ContactSize {
  Real radius, volume;
};

/// Indices of the values of one law in ContactBatch::history.
using HistoryIndices = std::array<int, ContactBatch::history_size>;

/// What a stage is given besides the batch.
struct StageInput {
  const ContactCoefficients *table;
  bool uniform;             ///< row 0 for every contact, else batch.coefficients[k]
  int first_coefficient;    ///< of this law in a row
  HistoryIndices history_index;
  double dt;
};

/// Computes one stage of the contacts begin ... end-1 of a batch, multiples of `lanes`.
using StageFunction = void (*)(ContactBatch &batch, int begin, int end, const StageInput &in);

/// The same of one contact, history only read. `c`, `history`: the law's own numbers.
using OneContact = void (*)(ContactLanes<double> &contact, const double *c, double *history,
                            double dt);

/// Where the log shows a coefficient.
enum class Shown { ALWAYS, WITH_SPRING, NEVER };
struct CoefficientName {
  const char *name;
  Shown shown = Shown::ALWAYS;    ///< WITH_SPRING: if the tangential law reads kt or gt
};

struct Law {
  Stage stage;
  const char *name;    ///< word of scripts, name in restart files and in the log; no two of a stage
                       ///< have the same
  const char *label;    ///< in descriptions of whole laws, nullptr to leave it out

  const CoefficientName *coefficients;
  int num_coefficients;

  /// Number of history values, zero when a contact begins: first those that change their sign if
  /// the bodies are exchanged (displacements, forces), then those that do not.
  int odd_history, even_history;

  bool acts;               ///< false of laws "none"
  bool needs_radius;       ///< reads the effective radius, or what follows from it
  bool reads_impact;       ///< impact speed or age; kept if the tangential law has a history
  bool reads_stiffness;    ///< tangential: kt or gt
  bool has_spring;         ///< tangential: its history is a displacement, whose energy it gives
                           ///< back, or more
  bool stiffens;           ///< tangential: a stretched spring of its own may gain from the overlap
  bool is_midpoint;        ///< tangential: second order in the time step
  bool synchronized;    ///< tangential: all stages see the normal of half a step before; the last
                        ///< coefficient is the time step
  bool holds;           ///< rolling: a body at rest is held
  bool delayed;         ///< rolling, twisting: reads delayed_force
  bool hysteretic;      ///< normal: more work is done on it than it stores
  bool reads_sums_alone;    ///< cohesion: of what other stages find, nothing but their sums
  bool shares_liquid;    ///< cohesion: bridges have the liquid of particles, see liquid_bridges.h
  double exponent;       ///< normal: elastic force ~ overlap^exponent
  bool lever_arms;    ///< tangential: lever arms end in the middle of the overlap, not at surfaces
  bool cohesive;      ///< normal: adhesion of its own
  bool allows_cohesion;         ///< damping: may follow such a normal law
  bool lasts_beyond_contact;    ///< normal, cohesion: a contact ends at the pull-off distance,
                                ///< not at overlap 0; heat: it begins there as well
  bool second_order;            ///< tangential: reads the changes of velocities, see second_order.h
  /// Tangential, rolling, twisting: the law that integrators of second order take in its place; nullptr,
  /// or nullptr is returned: there is none. `adhesive`: after a normal law with adhesion of its own.
  const Law *(*order_2)(bool adhesive);
  bool like_stock;    ///< normal: slips by the rule of the stock styles unless another is asked for
  /// Why kt (normal) or gt (damping) has to be NULL, or a number.
  const char *takes_no_kt, *takes_no_gt, *needs_gt;
  const char *damping;    ///< normal: name of the damping law that it has unless asked for another

  /// Whether it has a coefficient of this name.
  bool reads(const char *coefficient) const;

  StageFunction reading, advancing;    ///< history only read; or advanced by this step
  OneContact one;
  StageFunction delay;    ///< normal: finds delayed_force, by Chrono's rule for this law
  OneContact one_delay;

  /// Reads words behind the name; nullptr: the law is not chosen by a word of its own but by
  /// another law's.
  void (*read)(LawReader &reader);
  /// Damping: reads its coefficient, which is a word of the normal law.
  void (*read_coefficient)(LawReader &reader);
  /// Damping: see DampingLaw; nullptr of others.
  double (*damping_exponent)(double elastic_exponent);
  double (*dashpot_exponent)(double elastic_exponent);
  /// Coefficients of a contact of two materials to c[0 ... num_coefficients-1].
  void (*mix)(const Mixing &materials, double *c);
  /// Energy stored in a contact whose stages have all been computed.
  double (*stored)(const ContactLanes<double> &contact, const double *c, const double *history);
  /// Normal: effective Young's modulus of a Hertzian contact, 0 of others.
  double (*modulus)(const double *c);
  /// Normal, cohesion: the third power of the pull-off distance (length), how far a contact that has begun lasts beyond
  /// zero overlap; nullptr if not. Heat: up to where it flows. A power, since the formulas of most laws have one, and
  /// bodies that have come apart are asked in each step.
  double (*pulloff_cube)(const double *c, const ContactSize<double> &size);
  /// The same of eight.
  void (*pulloff_cubes)(const double *c, const ContactSize<Vec8> &size, Vec8 &cubes);
  /// Normal: finds ContactBatch::pulloff_distance where bodies are apart; nullptr if not.
  StageFunction find_pulloff_distance;
};

}    // namespace Talus

#endif
