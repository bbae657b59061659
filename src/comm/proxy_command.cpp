// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/proxy_command.h"

#include "comm/comm_proxy.h"
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
  const std::string word = narg ? arg[0] : "";
  const bool takes_value = word == "check";
  if (narg > (takes_value ? 2 : 1))
    error->all(FLERR, takes_value ? 2 : 1, "comm_proxy: surplus word '{}'",
               arg[takes_value ? 2 : 1]);

  if (word == "yes")
    switch_on();
  else if (word == "no")
    switch_off();
  else if (word == "info")
    info();
  else if (takes_value && narg == 2)
    check(arg[1]);
  else
    error->all(FLERR, narg ? 0 : Error::NOPOINTER,
               "comm_proxy: expected 'yes', 'no', 'info' or 'check yes|no' instead of '{}'", word);
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

void ProxyCommand::check(const char *word)
{
  const std::string value = word;
  if (value != "yes" && value != "no")
    error->all(FLERR, 1, "comm_proxy check: expected 'yes' or 'no' instead of '{}'", value);
  if (CommProxy *proxy = current())
    proxy->check(value == "yes");
  else if (value == "yes")
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
