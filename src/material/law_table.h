// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws and coefficients of all pairs of particle types, arranged for the kernels.

#ifndef TALUS_MATERIAL_LAW_TABLE_H
#define TALUS_MATERIAL_LAW_TABLE_H

#include "laws/contact_kernel.h"
#include "laws/contact_law.h"

#include <vector>

namespace Talus {

class LawTable {
 public:
  /// Forgets everything and makes room for types 1 ... ntypes (kernels count from 0).
  void reset(int ntypes);

  /// Sets the pair (i, j) = (j, i); types count from 1 as in input scripts.
  void set(int i, int j, const ContactLaw &law, const ContactCoefficients &coefficients);

  /// Call once after the last set(): finds which laws occur, and whether one row serves all.
  void finish();

  int row(int type_i, int type_j) const { return (type_i - 1) * types + (type_j - 1); }
  const ContactCoefficients *coefficients() const { return rows.data(); }
  const ContactCoefficients &coefficients(int row) const { return rows[row]; }
  const ContactLaw &law(int row) const { return laws[row]; }

  /// Number of different laws, and the one that a row uses (0 ... count-1).
  int num_laws() const { return static_cast<int>(distinct.size()); }
  int law_index(int row) const { return index_of_row[row]; }
  const ContactKernel &kernel(int law_index, bool advance) const
  {
    return advance ? advancing[law_index] : reading[law_index];
  }
  /// Of a step: advances, and finds ContactBatch::work.
  const ContactKernel &accounting_kernel(int law_index, bool advance) const
  {
    return (advance ? accounting : accounting_at_rest)[law_index];
  }
  const ContactLaw &distinct_law(int law_index) const { return distinct[law_index]; }
  /// Elastic normal forces of a row grow as overlap^force_exponent.
  double force_exponent(int row) const { return distinct[law_index(row)].normal().exponent; }

  /// All pairs of types have the same law and coefficients: types need not be looked up.
  bool uniform() const { return one_row; }
  /// Angular velocities are read, as by all laws with a history; contacts without them are computed
  /// faster.
  bool has_friction() const;
  bool has_history() const;
  /// Records of four numbers of each contact, of the law that needs most; 0 without history.
  int history_records() const;
  /// Impact speeds and ages are kept.
  bool keeps_impact() const;
  bool has_resistance() const;
  /// Torques other than those of one force at both surfaces.
  bool has_twisting_torques() const;
  bool lasts_beyond_contact() const;
  bool conducts_heat() const;
  /// Bridges have the liquid of particles.
  bool shares_liquid() const;
  /// Changes of velocities are read.
  bool second_order() const;
  /// How far a contact of two radii lasts beyond zero overlap (length), 0 if it does not.
  double pulloff_distance(int row, double radius_i, double radius_j) const;
  /// The same against a flat body.
  double pulloff_distance(int row, double radius) const;
  /// Of eight pairs of a row of laws, with these radii: the squared distance of their centers up to which they last
  /// beyond zero overlap, negative if only those do that have begun; 0 if they do not, or if the liquid of particles
  /// tells it.
  Vec8 limits_of_contacts(int row, Vec8 radius_i, Vec8 radius_j) const;

 private:
  template <class Predicate> bool any(Predicate holds) const;

  int types = 0;
  bool one_row = true;
  std::vector<ContactCoefficients> rows;
  std::vector<ContactLaw> laws;
  std::vector<int> index_of_row;
  std::vector<ContactLaw> distinct;
  std::vector<ContactKernel> advancing, reading, accounting, accounting_at_rest;    // by law
};

}    // namespace Talus

#endif
