// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which steps of run style verlet/proxy are made in the records of the contacts alone: those that
// nobody but Talus looks at. Then the host's arrays of positions, velocities and forces are neither
// read nor written. The particles come back to them for every step with output, a fix of the host
// at its end or new neighbor lists, and at the end of a run, even one that ends in an error.

#ifndef TALUS_RUN_RECORD_STEPS_H
#define TALUS_RUN_RECORD_STEPS_H

#include "exchange/record_packer.h"

#include "lmptype.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class PairGranPenalty;
}    // namespace LAMMPS_NS

namespace Talus {

class RecordSteps : protected LAMMPS_NS::Pointers {
 public:
  explicit RecordSteps(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// At the start of a run, after setup. Collective; decides the same on all ranks.
  void start(bool pairs_computed);
  /// "" if this run has such steps, else the first reason why not, for people.
  const std::string &hazard() const { return reason; }

  /// Before forces are computed: whether particles may stay in the records until the next step. The
  /// pair style is told.
  bool may_stay(LAMMPS_NS::bigint now, bool tallied);

  /// The pair style if particles live in its records now, else nullptr.
  LAMMPS_NS::PairGranPenalty *keeper() const;
  /// Of this run, or nullptr.
  LAMMPS_NS::PairGranPenalty *pair() const { return reason.empty() ? style : nullptr; }

  /// Before an exchange in a step for which may_stay() has been asked: the packer for an exchange
  /// from records to records, or nullptr, on all ranks, if it goes through the host's arrays. Those
  /// then show the particles that are sent, wherever they live.
  ProxyPacker *prepare_exchange();
  /// There is a new exchange plan.
  void forget_plan() { sent_is_known = packer_knows_plan = false; }

 private:
  std::string find_hazard(bool pairs_computed);
  std::string hazard_of_fix(LAMMPS_NS::Fix *fix, int mask) const;
  bool is_looked_at(LAMMPS_NS::bigint now) const;
  void find_sent_particles();

  std::string reason = "no run yet";
  LAMMPS_NS::PairGranPenalty *style = nullptr;
  std::vector<LAMMPS_NS::Fix *> at_end_of_step;
  std::vector<int> sent;
  bool sent_is_known = false, packer_knows_plan = false, stays = false;
  RecordPacker packer;
};

}    // namespace Talus

#endif
