// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The state of spheres as the exchange carries it from records to records, while particles live
// there: position, velocity and, in scenes with friction, angular velocity. The arrays of LAMMPS
// are neither read nor written, so that its ghosts stay as they are.
//
//   set_plan()    once per exchange plan, when the slots of its particles are known
//   set_state()   before each exchange

#ifndef TALUS_EXCHANGE_RECORD_PACKER_H
#define TALUS_EXCHANGE_RECORD_PACKER_H

#include "base/aligned_vector.h"
#include "exchange/periodic_box.h"
#include "exchange/proxy_packer.h"
#include "particles/record.h"

#include <vector>

namespace Talus {

class ParticleRecords;

class RecordPacker : public ProxyPacker {
 public:
  /// Looks the slots of all particles of the plan up, so that exchanges need not. `slot_of_atom`:
  /// by index, of owned particles and proxies.
  void set_plan(const ExchangePlan &plan, const int *slot_of_atom);

  /// Where the states are, until finish() of the exchange, and the present box.
  void set_state(ParticleRecords &records, const PeriodicBox &box);

  int stride() const override;
  void pack(const ExchangeNeighbor &to, double *out) override;
  void unpack(const ExchangeNeighbor &from, const double *message) override;

 private:
  struct Target {
    int slot, place;    ///< of a proxy, and of its particle in the message
  };
  /// Proxies that follow each other and have their shift in common.
  struct Run {
    PeriodicShift shift;
    std::vector<Target> targets;
  };
  /// What is exchanged with one rank.
  struct Slots {
    int rank;
    std::vector<int> sent;
    std::vector<Run> received;
  };
  static Slots slots_of(const ExchangeNeighbor &neighbor, const int *slot_of_atom);
  const Slots &slots_with(int rank) const;
  template <bool rotation> void pack_all(const std::vector<int> &slots, double *out) const;
  template <bool rotation> void unpack_run(const Run &run, const double *message);

  std::vector<Slots> slots;    ///< by neighbor
  ParticleRecords *records = nullptr;
  PeriodicBox box;
  AlignedVector<Record> steps, velocity_steps;    ///< of the shift of a run; the fourth numbers are 0
};

}    // namespace Talus

#endif
