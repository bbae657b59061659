// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The state of spheres as the exchange carries it from records to records, while particles live
// there (see RecordSteps): x, v and, in scenes with friction, omega. The host's arrays are neither
// read nor written, so that its ghosts stay as they are.

#ifndef TALUS_COMM_RECORD_PACKER_H
#define TALUS_COMM_RECORD_PACKER_H

#include "comm/atom_packers.h"
#include "exchange/proxy_packer.h"

namespace Talus {

class ParticleRecords;

class RecordPacker : public ProxyPacker {
 public:
  explicit RecordPacker(LAMMPS_NS::LAMMPS *lmp) : shifts(lmp) {}

  /// Before begin(): where the states are, until finish(). `slot_of_atom`: of owned particles and
  /// proxies.
  void set(ParticleRecords &records, const int *slot_of_atom);

  int stride() const override;
  void pack(const int *particles, int count, double *out) override;
  void unpack(const ProxyRun &run, const int *places, const double *message) override;

 private:
  ParticleRecords *records = nullptr;
  const int *slots = nullptr;
  ShiftSteps shifts;
};

}    // namespace Talus

#endif
