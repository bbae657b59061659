// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// run_style verlet, and run_style verlet/proxy [overlap yes|no]: the Verlet loop with the exchange
// of proxies under way while pairs inside the sub-domain are computed, and without a step in which
// every rank waits for every other. Where the pair style is not one of Talus the steps are those of
// LAMMPS. doc/run_style_verlet_proxy.md is the user's page.
//
// The only place that lets an exchange be under way while forces are computed: GranularSystem
// finishes it.

#ifndef LMP_VERLET_PROXY_H
#define LMP_VERLET_PROXY_H

#include "run/rebuild_check.h"
#include "system/host/box_speeds.h"
#include "system/host/system_style.h"
#include "system/step/granular_system.h"

#include "verlet.h"

#include <memory>
#include <optional>
#include <string>

namespace LAMMPS_NS {

class VerletProxy : public Verlet, public Talus::SystemStyle {
 public:
  VerletProxy(class LAMMPS *, int, char **);
  void init() override;
  void setup(int) override;
  void setup_minimal(int) override;
  void run(int) override;
  void cleanup() override;
  std::string plain_style() const override { return "verlet"; }
  std::string reason_for_stock() const override;

 private:
  enum class Overlap { AUTOMATIC, YES, NO };

  bool makes_own_steps() const { return reason_for_stock().empty(); }
  void go_on_without_set_up();
  void decide_on_overlap();
  bool others_act_on_ghosts() const;
  void step();
  void bring_back();
  void rebuild();
  void compute_forces(bool to_arrays);

  std::optional<Talus::RebuildCheck> lists;    ///< of the first run with steps of its own
  std::shared_ptr<Talus::GranularSystem> system;
  Talus::BoxSpeeds box_speeds;
  Overlap wanted = Overlap::AUTOMATIC;
  std::optional<bool> on_machines;     ///< more than one
  bool set_up = false;                 ///< for the coming run
  bool needs_lists = false;            ///< the next step makes neighbor lists
  bool overlaps = false;               ///< in this run
  bool reverses = false;               ///< in this run forces on ghosts go to their owners
  Talus::ExchangeCounters at_start;    ///< of the run
  std::string announced;               ///< last reason given for not overlapping
};

}    // namespace LAMMPS_NS

#endif
