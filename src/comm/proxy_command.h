// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The command comm_proxy: what the user decides on the direct exchange, see exchange_switch.h;
// prints and checks what it does. doc/run_style_verlet_proxy.md is the user's page.

#ifndef LMP_PROXY_COMMAND_H
#define LMP_PROXY_COMMAND_H

#include "command.h"

namespace LAMMPS_NS {

class ProxyCommand : public Command {
 public:
  explicit ProxyCommand(class LAMMPS *lmp) : Command(lmp) {}
  /// comm_proxy auto|yes|no, comm_proxy info, comm_proxy check yes|no
  void command(int, char **) override;

 private:
  void check(bool value);
  void info();
};

}    // namespace LAMMPS_NS

#endif
