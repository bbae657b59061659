// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/proxy_command.h"

#include "system/host/command_words.h"
#include "system/monitor/exchange_report.h"
#include "system/step/granular_system.h"

#include "contact/contact_survey.h"

#include "comm.h"
#include "domain.h"
#include "error.h"

#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

void ProxyCommand::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR, "comm_proxy before the simulation box is defined: put it after create_box, "
                      "read_data or read_restart");
  Words words = command_words(lmp, "comm_proxy", narg, arg);
  enum { AUTO, YES, NO, INFO, CHECK };
  const int task = words.choice("word", {"auto", "yes", "no", "info", "check"});
  bool value = false;
  if (task == CHECK) {
    words.about("check");
    value = words.choice("value", {"yes", "no"}) == 0;
    words.about("");
  }
  words.end();
  const auto system = GranularSystem::of(lmp);
  using Choice = ExchangeSwitch::Choice;
  if (task == AUTO) system->exchange().choose(Choice::AUTOMATIC);
  if (task == YES) system->exchange().choose(Choice::YES);
  if (task == NO) system->exchange().choose(Choice::NO);
  if (task == INFO) info();
  if (task == CHECK) check(value);
}

void ProxyCommand::check(bool value)
{
  if (DirectExchange *proxy = GranularSystem::of(lmp)->exchange().present())
    proxy->check(value);
  else if (value)
    error->all(FLERR, "comm_proxy check yes: the direct exchange is off: say 'comm_proxy yes' "
                      "first");
}

void ProxyCommand::info()
{
  DirectExchange *proxy = GranularSystem::of(lmp)->exchange().direct();
  if (!proxy) {
    if (comm->me == 0) utils::logmesg(lmp, "comm_proxy: off, exchange of LAMMPS\n");
    return;
  }
  const std::string text = describe_exchange(
      *proxy, ContactSurvey(GranularSystem::of(lmp)->pipeline()).early_share(), world);
  if (comm->me == 0) utils::logmesg(lmp, text);
}
