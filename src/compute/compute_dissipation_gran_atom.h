// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute ID group dissipation/gran/atom: energy dissipated by the contacts of each particle.
// doc/compute_contacts.md is the user's page.

#ifndef LMP_COMPUTE_DISSIPATION_GRAN_ATOM_H
#define LMP_COMPUTE_DISSIPATION_GRAN_ATOM_H

#include "compute.h"

#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class ComputeDissipationGranAtom : public Compute, private Talus::ContactObserver {
 public:
  ComputeDissipationGranAtom(class LAMMPS *, int, char **);
  ~ComputeDissipationGranAtom() override;
  void init() override;
  void setup() override;
  /// By particle: by normal damping, friction, resistance, since the first run with this compute or
  /// with the one whose restart file was read. Half of a contact between two particles belongs to
  /// each of them. 0 outside of the group.
  void compute_peratom() override;
  double memory_usage() override;

 private:
  bool asks_for_work() const override { return true; }
  double **work_by_particle() override;
  void add_springs(double **to, double sign) const;

  std::shared_ptr<Talus::GranularSystem> system;
  class FixStoreAtom *store;    ///< rows of WorkAccount, less what springs have stored first
  std::string store_id;
  bool started = false;
  int nmax = 0;
};

}    // namespace LAMMPS_NS

#endif
