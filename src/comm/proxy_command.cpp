// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/proxy_command.h"

#include "comm/comm_proxy.h"
#include "system/command_words.h"
#include "system/exchange_report.h"

#include "comm.h"
#include "comm_brick.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

/* The stock object, apart from a pointer that its constructor leaves as it is and its destructor
   frees. */

class StockComm : public CommBrick {
 public:
  StockComm(LAMMPS *lmp, Comm *old) : CommBrick(lmp, old) { localsendlist = nullptr; }
};

}    // namespace

void ProxyCommand::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR, "comm_proxy before the simulation box is defined: put it after create_box, "
                      "read_data or read_restart");
  Words words = command_words(lmp, "comm_proxy", narg, arg);
  enum { YES, NO, INFO, CHECK };
  const int task = words.choice("word", {"yes", "no", "info", "check"});
  bool value = false;
  if (task == CHECK) {
    words.about("check");
    value = words.choice("value", {"yes", "no"}) == 0;
    words.about("");
  }
  words.end();
  if (task == YES) switch_on();
  if (task == NO) switch_off();
  if (task == INFO) info();
  if (task == CHECK) check(value);
}

CommProxy *ProxyCommand::current() const
{
  return dynamic_cast<CommProxy *>(comm);
}

/* ---------------------------------------------------------------------- */

void ProxyCommand::switch_on()
{
  if (current()) return;
  if (lmp->kokkos)
    error->all(FLERR, "comm_proxy does not run with the KOKKOS package: start LAMMPS without "
                      "'-k on'");
  if (comm->style != Comm::BRICK || comm->layout == Comm::LAYOUT_TILED)
    error->all(FLERR, "comm_proxy: 'comm_style tiled' is not supported: use 'comm_style brick' "
                      "and balance without rcb");
  if (comm->mode != Comm::SINGLE)
    error->all(FLERR, "comm_proxy: 'comm_modify mode multi' is not supported: use 'comm_modify "
                      "mode single' or 'comm_proxy no'");
  replace_comm(new CommProxy(lmp, comm));
}

void ProxyCommand::switch_off()
{
  if (current()) replace_comm(new StockComm(lmp, comm));
}

void ProxyCommand::replace_comm(Comm *with)
{
  Comm *old = comm;
  comm = with;
  delete old;
  // The new object knows of no ghosts yet: even 'run N pre no' has to set up everything.
  update->first_update = 0;
}

void ProxyCommand::check(bool value)
{
  if (CommProxy *proxy = current())
    proxy->check(value);
  else if (value)
    error->all(FLERR, "comm_proxy check yes: the direct exchange is off: say 'comm_proxy yes' "
                      "first");
}

void ProxyCommand::info()
{
  CommProxy *proxy = current();
  if (!proxy) {
    if (comm->me == 0) utils::logmesg(lmp, "comm_proxy: off, exchange of LAMMPS\n");
    return;
  }
  const std::string text =
      describe_exchange(*proxy, GranularSystem::of(lmp)->share_without_proxies(), world);
  if (comm->me == 0) utils::logmesg(lmp, text);
}
