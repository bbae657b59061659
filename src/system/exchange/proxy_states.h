// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How the states of proxies come up to date in a step: through the arrays of LAMMPS, or, while
// particles are in the records before and after it, from records to records. GranularSystem calls
// it between the move of the particles and their forces.

#ifndef TALUS_SYSTEM_EXCHANGE_PROXY_STATES_H
#define TALUS_SYSTEM_EXCHANGE_PROXY_STATES_H

#include "contact/contact_pipeline.h"
#include "exchange/record_packer.h"

#include "pointers.h"

#include <utility>
#include <vector>

namespace Talus {

class ExchangeSwitch;
class ProxyPacker;
class DirectExchange;

class ProxyStates : protected LAMMPS_NS::Pointers {
 public:
  ProxyStates(LAMMPS_NS::LAMMPS *lmp, const ExchangeSwitch &exchange_switch) :
      Pointers(lmp), exchange(exchange_switch)
  {
  }

  /// The exchange plan is a new one.
  void forget_plan() { sent_is_known = packer_knows_plan = false; }
  /// Local indices of owned particles that are proxies elsewhere, ascending, of the present plan.
  const std::vector<int> &sent();

  /// Updates all proxies of these particles; pending on return if `overlap`. `stay`: if they are in
  /// the records, they will be after the step. Collective.
  void update(bool overlap, ContactPipeline &particles, const ParticleView &arrays, bool stay);
  /// Waits for those that are under way.
  void finish();
  /// Those of the last update() have come to the records; and asked once.
  bool have_arrived_in_records() const { return in_records; }
  bool take_arrived_in_records() { return std::exchange(in_records, false); }

 private:
  ProxyPacker *packer_of_records(ContactPipeline &particles);

  const ExchangeSwitch &exchange;
  std::vector<int> sent_particles;
  bool sent_is_known = false, packer_knows_plan = false, in_records = false;
  RecordPacker packer;
};

}    // namespace Talus

#endif
