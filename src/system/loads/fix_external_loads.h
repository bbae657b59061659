// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Internal fix by which LAMMPS calls ExternalLoads: after the other forces of a step, and where
// particles go to another place or rank. Made by it, fix TALUS_LOADS all EXTERNAL_LOADS; nothing of
// it is in restart files.

#ifndef LMP_FIX_EXTERNAL_LOADS_H
#define LMP_FIX_EXTERNAL_LOADS_H

#include "fix.h"
#include "system/host/system_fix.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixExternalLoads : public Fix, public Talus::SystemFix {
 public:
  FixExternalLoads(class LAMMPS *, int, char **);
  ~FixExternalLoads() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void post_force(int) override;
  void reset_dt() override;

  void grow_arrays(int most) override { loads().grow(most); }
  void copy_arrays(int i, int j, int) override { loads().copy(i, j); }
  void set_arrays(int i) override { loads().forget(i); }
  int pack_exchange(int i, double *buf) override { return loads().pack(i, buf); }
  int unpack_exchange(int i, double *buf) override { return loads().unpack(i, buf); }
  double memory_usage() override { return loads().memory_usage(); }

  // SystemFix
  std::string needs_arrays() override { return loads().needs_arrays(); }
  bool adds_forces() const override { return true; }
  void exchange_state(Talus::StateExchange &x) override { loads().exchange_state(x); }
  void state_is_restored() override { loads().state_is_restored(); }

 private:
  Talus::ExternalLoads &loads() { return system->external_loads(); }

  std::shared_ptr<Talus::GranularSystem> system;
};

}    // namespace LAMMPS_NS

#endif
