// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/body/fix_large_body.h"

#include "fix/body/large_body_words.h"

#include "system/host/command_words.h"
#include "system/host/restart_data.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace Talus;

/* ---------------------------------------------------------------------- */

FixLargeBody::FixLargeBody(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(GranularSystem::of(lmp))
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix large/body requires atom attributes radius, rmass, omega and torque: "
                      "use 'atom_style sphere'");
  Words words = command_words(lmp, "fix large/body", narg, arg, 3);
  LargeBodySpec spec = LargeBodyWords(lmp, words).parse();
  body = &system->bodies().add(this, std::move(spec));
  offer_output();
}

FixLargeBody::~FixLargeBody()
{
  system->bodies().remove(*body);
}

void FixLargeBody::post_constructor()
{
  if (body->keeps_history()) system->contact_store().create();
}

void FixLargeBody::offer_output()
{
  const LargeBodySurface &surface = body->surface();
  scalar_flag = vector_flag = 1;
  extscalar = 1;
  size_vector = 21;
  extvector = 0;
  global_freq = 1;
  energy_global_flag = 1;
  virial_global_flag = virial_peratom_flag = 1;
  dynamic_group_allow = 1;
  time_depend = body->motion().depends_on_time() ? 1 : 0;
  restart_global = body->has_state() ? 1 : 0;
  nevery = surface.picture_interval();
  if (!surface.records()) return;
  array_flag = 1;
  size_array_rows = surface.size();
  size_array_cols = surface.columns();
  extarray = 0;
}

/* ---------------------------------------------------------------------- */

int FixLargeBody::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR | POST_FORCE |
         MIN_POST_FORCE | (nevery ? END_OF_STEP : 0);
}

void FixLargeBody::init()
{
  Talus::require_intact_particles(lmp);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix large/body does not run with run_style respa: use run_style verlet");
  body->init();
  if (body->motion().moves()) restart_global = 1;    // a region may by now
}

/* The body goes to the place of this step as the particles have just done. */

void FixLargeBody::post_integrate()
{
  body->advance();
}

void FixLargeBody::setup_post_neighbor()
{
  body->place();
  post_neighbor();
}

void FixLargeBody::min_post_neighbor()
{
  post_neighbor();
}

void FixLargeBody::post_neighbor()
{
  body->find_particles();
}

/* Pair style gran/penalty looks earlier for all; without it the first body does. */

void FixLargeBody::pre_exchange()
{
  system->run_monitor().look(RunMonitor::Moment::REBUILD);
}

void FixLargeBody::post_run()
{
  system->run_monitor().look(RunMonitor::Moment::END);
}

void FixLargeBody::setup(int vflag)
{
  post_force(vflag);
  system->run_monitor().look(RunMonitor::Moment::SETUP);
  if (nevery && update->ntimestep % nevery == 0) end_of_step();
}

void FixLargeBody::min_setup(int vflag)
{
  body->stand_still();
  post_force(vflag);
}

void FixLargeBody::min_post_force(int vflag)
{
  post_force(vflag);
}

std::string FixLargeBody::needs_arrays()
{
  return body->needs_arrays();
}

void FixLargeBody::post_force(int vflag)
{
  v_init(vflag);
  const bool advance = update->setupflag == 0;
  if (evflag) virials.assign(6L * atom->nlocal, 0.0);
  body->compute(advance, evflag ? virials.data() : nullptr);
  for (int i = 0; evflag && i < atom->nlocal; i++) v_tally(i, &virials[6L * i]);
}

void FixLargeBody::end_of_step()
{
  body->surface().write_picture(body->frame());
}

int FixLargeBody::modify_param(int narg, char **arg)
{
  if (strcmp(arg[0], "state") != 0) return 0;
  int words, steps;
  const BodyState state = body->motion().state_from(narg, arg, words, steps);
  const std::string problem = body->guide(state, steps);
  if (!problem.empty()) error->all(FLERR, "fix_modify {} state: {}", id, problem);
  return words;
}
