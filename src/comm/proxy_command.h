// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The command comm_proxy: puts the direct exchange in the place of the host's, or back, and prints
// what it does. doc/comm_proxy.md is the user's page.

#ifndef LMP_PROXY_COMMAND_H
#define LMP_PROXY_COMMAND_H

#include "command.h"

namespace LAMMPS_NS {

class ProxyCommand : public Command {
 public:
  explicit ProxyCommand(class LAMMPS *lmp) : Command(lmp) {}
  /// comm_proxy yes|no, comm_proxy info, comm_proxy check yes|no
  void command(int, char **) override;

 private:
  class CommProxy *current() const;
  void switch_on();
  void switch_off();
  void replace_comm(class Comm *with);
  void check(bool value);
  void info();
};

}    // namespace LAMMPS_NS

#endif
