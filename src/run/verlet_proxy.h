// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// run_style verlet/proxy [overlap yes|no]: the Verlet loop with the exchange of proxies under way
// while pairs inside the sub-domain are computed, and without a step in which every rank waits for
// every other. doc/run_style_verlet_proxy.md is the user's page.
//
// The only place that begins an exchange without finishing it: the pair style finishes it
// (comm/pending_exchange.h).

#ifndef LMP_VERLET_PROXY_H
#define LMP_VERLET_PROXY_H

#include "exchange/exchange_counters.h"
#include "run/rebuild_check.h"
#include "run/record_steps.h"

#include "verlet.h"

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
  void update_proxies();
  void bring_back();
  void rebuild();
  void compute_forces();
  class CommProxy *current() const;

  void say_where_steps_are_made();

  Talus::RebuildCheck lists;
  Talus::RecordSteps records;
  bool wanted = true;                  ///< overlap yes
  bool overlaps = false;               ///< in this run
  Talus::ExchangeCounters at_start;    ///< of the run
  std::string announced;               ///< last reason given for not overlapping
  std::string said;                    ///< last line about records
};

}    // namespace LAMMPS_NS

#endif
