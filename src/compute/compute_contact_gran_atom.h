// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute ID group contact/gran/atom: how many particles and large bodies each particle touches.
// doc/compute_contacts.md is the user's page.

#ifndef LMP_COMPUTE_CONTACT_GRAN_ATOM_H
#define LMP_COMPUTE_CONTACT_GRAN_ATOM_H

#include "compute.h"

#include "system/step/granular_system.h"

#include <memory>

namespace LAMMPS_NS {

class ComputeContactGranAtom : public Compute, private Talus::ContactObserver {
 public:
  ComputeContactGranAtom(class LAMMPS *, int, char **);
  ~ComputeContactGranAtom() override;
  void init() override;
  /// By particle: contacts, those with particles, those with large bodies. 0 outside of the group.
  void compute_peratom() override;
  double memory_usage() override;

 private:
  bool asks_for_work() const override { return false; }

  std::shared_ptr<Talus::GranularSystem> system;
  int nmax = 0;
};

}    // namespace LAMMPS_NS

#endif
