// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contact laws of all pairs of particle types, as set by `pair_coeff` and as mixed where they
// are not set.

#ifndef TALUS_MATERIAL_PAIR_COEFFS_H
#define TALUS_MATERIAL_PAIR_COEFFS_H

#include "material/contact_spec.h"
#include "material/law_table.h"

#include <string>
#include <vector>

namespace Talus {

class PairCoeffs {
 public:
  FrictionMix mix = FrictionMix::MINIMUM;

  /// Clears everything; types count from 1 to ntypes.
  void resize(int ntypes);
  int num_types() const { return types; }

  /// Sets the pair (i, j) with i <= j.
  void set(int i, int j, const ContactSpec &spec)
  {
    entry(i, j) = {spec, true};
    changes++;
  }
  bool is_set(int i, int j) const { return entry(i, j).set; }
  const ContactSpec &spec(int i, int j) const { return entry(i, j).spec; }

  /// Of a type with itself; nullptr if it is not set, or there is no such type.
  const ContactSpec *own(int type) const
  {
    return type <= types && is_set(type, type) ? &spec(type, type) : nullptr;
  }
  /// Another number after each change of a pair.
  int revision() const { return changes; }

  /// Both types are set and have the same law, so that the pair can be mixed. Material laws must
  /// also agree on whether kt and gt are numbers or NULL: the two have no common meaning.
  bool can_mix(int i, int j) const;

  /// The pair is set with the moduli of types, and this one of the two has none; 0: no such pair.
  int type_without_moduli(int i, int j) const;

  /// The pair is set or can be mixed; the functions below need that.
  bool known(int i, int j) const
  {
    return is_set(i, j) ? type_without_moduli(i, j) == 0 : can_mix(i, j);
  }

  const ContactLaw &law(int i, int j) const;
  ContactSides sides(int i, int j) const;
  ContactCoefficients coefficients(int i, int j) const;
  /// For descriptions: where numbers are from that no pair_coeff of the pair has; "": nowhere else.
  std::string note_on(int i, int j) const;
  /// Any pair that is set conducts heat.
  bool conducts_heat() const;
  /// Bridges of any pair that is set have the liquid of particles.
  bool shares_liquid() const;
  /// Heat also through gaps.
  bool reaches() const;
  /// How far a contact of particles with these radii lasts beyond zero overlap (length).
  double pulloff_distance(int i, int j, double radius_i, double radius_j) const;

  /// "", or why contacts of the pair are not of second order, see second_order_laws.h.
  std::string reason_against_second_order(int i, int j) const;

  /// One line for a pair that is set or can be mixed: law, whether it was mixed, coefficients.
  std::string describe_pair(int i, int j) const;

  /// For the log, several lines: kernels, pairs of types, and what the laws of `table` do not need.
  std::string describe(const LawTable &table) const;

  /// All pairs for the kernels. Pairs that are neither set nor can be mixed belong to another
  /// sub-style of pair hybrid and never come up: they get the row of one that does, so that uniform
  /// laws are recognized.
  /// With the laws for integrators of this order.
  LawTable table(int order = 1) const;

 private:
  struct Entry {
    ContactSpec spec;
    bool set = false;
  };
  Entry &entry(int i, int j) { return entries[i * (types + 1) + j]; }
  const Entry &entry(int i, int j) const { return entries[i * (types + 1) + j]; }

  int types = 0, changes = 0;
  std::vector<Entry> entries;
};

}    // namespace Talus

#endif
