// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute ID group contact/gran/local: the contacts of a step as rows of numbers, those of
// particles with each other and with large bodies. doc/compute_contacts.md is the user's
// page.

#ifndef LMP_COMPUTE_CONTACT_GRAN_LOCAL_H
#define LMP_COMPUTE_CONTACT_GRAN_LOCAL_H

#include "compute.h"

#include "system/step/granular_system.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class ComputeContactGranLocal : public Compute, private Talus::ContactObserver {
 public:
  ComputeContactGranLocal(class LAMMPS *, int, char **);
  ~ComputeContactGranLocal() override;
  void init() override;
  /// One row for each contact whose particles are in the group, on one rank.
  void compute_local() override;
  double memory_usage() override;

  /// A contact with its numbers, as its first particle has them, that of the lower ID.
  struct Row {
    double id[2], body, part;
    double x[2][3];    ///< center of the first, and of the second or the point of the body
    double point[3], normal[3], overlap, force[3], torque[3], energy;
    Talus::HistoryValues history;
  };

 private:
  bool asks_for_work() const override { return false; }
  bool is_chosen(const Talus::ContactReport &one) const;
  Row row_of(const Talus::ContactReport &one) const;

  std::shared_ptr<Talus::GranularSystem> system;
  std::vector<double (*)(const Row &)> columns;
  std::vector<double> values;
  std::vector<double *> rows;
};

}    // namespace LAMMPS_NS

#endif
