// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/fix_external_loads.h"

#include "atom.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;
using Moment = Talus::ExternalLoads::Moment;

FixExternalLoads::FixExternalLoads(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
  if (narg != 3 || !utils::strmatch(id, "^TALUS_LOADS$"))
    error->all(FLERR, "Fix EXTERNAL_LOADS is internal to Talus");
  create_attribute = 1;
  maxexchange_dynamic = 1;
  atom->add_callback(Atom::GROW);
  loads().take_fix(this);
  maxexchange = loads().most_packed();
}

FixExternalLoads::~FixExternalLoads()
{
  atom->delete_callback(id, Atom::GROW);
  loads().drop_fix();
}

int FixExternalLoads::setmask()
{
  return FixConst::PRE_EXCHANGE | FixConst::POST_FORCE;
}

void FixExternalLoads::init()
{
  system->setup_state().list_fixes();
  if (utils::strmatch(update->integrate_style, "^respa") && loads().any())
    error->all(FLERR,
               "Forces, drag or heat that another program has put on particles do not act with "
               "run_style respa: use run_style verlet");
}

void FixExternalLoads::setup_pre_exchange()
{
  loads().sums_begin_anew();
}

void FixExternalLoads::setup(int)
{
  loads().act(Moment::SET_UP);
}

void FixExternalLoads::post_force(int)
{
  loads().act(Moment::STEP);
}

/* Between two steps, or at the end of one that is in the arrays. */

void FixExternalLoads::reset_dt()
{
  loads().act(Moment::BETWEEN_STEPS);
}
