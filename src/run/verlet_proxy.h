// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// run_style verlet/proxy [overlap yes|no]: the Verlet loop with the exchange of proxies under way
// while pairs inside the sub-domain are computed, and without a step in which every rank waits for
// every other. doc/run_style_verlet_proxy.md is the user's page.
//
// The only place that lets an exchange be under way while forces are computed: GranularSystem finishes
// it.

#ifndef LMP_VERLET_PROXY_H
#define LMP_VERLET_PROXY_H

#include "run/rebuild_check.h"
#include "system/granular_system.h"

#include "verlet.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class VerletProxy : public Verlet {
 public:
  VerletProxy(class LAMMPS *, int, char **);
  void init() override;
  void setup(int) override;
  void setup_minimal(int) override;
  void run(int) override;
  void cleanup() override;

 private:
  void step();
  void bring_back();
  void rebuild();
  void compute_forces();

  void say_where_steps_are_made();

  Talus::RebuildCheck lists;
  std::shared_ptr<Talus::GranularSystem> system;
  bool wanted = true;                  ///< overlap yes
  bool overlaps = false;               ///< in this run
  Talus::ExchangeCounters at_start;    ///< of the run
  std::string announced;               ///< last reason given for not overlapping
  std::string said;                    ///< last line about records
};

}    // namespace LAMMPS_NS

#endif
