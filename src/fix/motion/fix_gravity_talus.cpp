/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/fix_gravity_talus.h"

#include "base/state_exchange.h"
#include "fix/motion/plain_style.h"
#include "system/host/fix_list.h"
#include "system/host/time_formula.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <cstring>

using namespace LAMMPS_NS;

FixGravityTalus::FixGravityTalus(LAMMPS *lmp, int narg, char **arg) :
    FixGravity(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
}

FixGravityTalus::~FixGravityTalus()
{
  system->weights().drop(this);
}

void FixGravityTalus::post_constructor()
{
  restore_style(this, "gravity");
}

/* ---------------------------------------------------------------------- */

void FixGravityTalus::init()
{
  FixGravity::init();
  evaluated_at = -1;
  reason = find_reason();
  if (reason.empty()) say_where_it_differs();
}

/* In the order of the fixes, rigid bodies sum up their forces when a run is set up. */

void FixGravityTalus::say_where_it_differs()
{
  for (const Fix *fix : Talus::fix_list(*modify)) {
    if (fix == this) return;
    if (!fix->rigid_flag || utils::strmatch(fix->style, "/symplectic$")) continue;
    if (comm->me == 0 && !has_said)
      error->warning(
          FLERR,
          "Fix gravity {}: in LAMMPS the bodies of fix {} do not fall in the first half step of a "
          "run, because fix gravity comes behind it; here they do: put fix gravity before it for "
          "the same results with both",
          id, fix->id);
    has_said = true;
  }
}

std::string FixGravityTalus::find_reason()
{
  if (update->whichflag == 2) return "there is no gravity in a minimization";
  if (utils::strmatch(update->integrate_style, "^respa")) return "run_style respa has levels";
  if (group->dynamic[igroup]) return "its group is dynamic";
  for (const std::string &reason : {reason_of_variables(), reason_of_fixes_before()})
    if (!reason.empty()) return reason;
  return system->weights().take(this, [this] { return acceleration(); });
}

std::string FixGravityTalus::reason_of_variables() const
{
  for (const char *name : {mstr, vstr, pstr, tstr, xstr, ystr, zstr})
    if (name && !Talus::reads_only_time(lmp, name))
      return std::string("its variable '") + name + "' may read more than the time";
  return "";
}

/* What bonds that break store only keeps what it is given. */

bool FixGravityTalus::acts_on_forces(Fix *fix) const
{
  return (modify->get_fix_mask(fix) & FixConst::POST_FORCE) &&
         std::strcmp(fix->style, "STORE/LOCAL") != 0;
}

/* Weights come first in the sums: what acts on forces before this fix would act on them. */

std::string FixGravityTalus::reason_of_fixes_before() const
{
  for (Fix *fix : Talus::fix_list(*modify)) {
    if (fix == this) break;
    if (utils::strmatch(fix->style, "^freeze")) {
      if (some_frozen_move(fix->groupbit))
        return std::string("fix ") + fix->id +
               " (freeze) comes before it, so that frozen particles fall: put it behind";
    } else if (acts_on_forces(fix) && !Talus::SystemFix::of(fix)) {
      return std::string("fix ") + fix->id + " (" + fix->style + ") acts on forces before it";
    }
  }
  return "";
}

bool FixGravityTalus::some_frozen_move(int frozenbits) const
{
  int movers = 0;
  for (const Fix *fix : Talus::fix_list(*modify))
    if (fix->time_integrate) movers |= fix->groupbit;
  int mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    const int mask = atom->mask[i];
    if ((mask & frozenbits) && (mask & groupbit) && (mask & movers)) mine = 1;
  }
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all != 0;
}

/* ---------------------------------------------------------------------- */

const double *FixGravityTalus::acceleration()
{
  if (varflag != CONSTANT && evaluated_at != update->ntimestep) evaluate();
  evaluated_at = update->ntimestep;
  return disable ? nullptr : gvec;
}

/* Variables are evaluated again. */

void FixGravityTalus::exchange_state(Talus::StateExchange &x)
{
  x(eflag, egrav);
  if (x.restores()) evaluated_at = -1;
}

void FixGravityTalus::evaluate()
{
  const auto value_of = [this](int style_of, int variable, double &value) {
    if (style_of == EQUAL) value = input->variable->compute_equal(variable);
  };
  value_of(mstyle, mvar, magnitude);
  value_of(vstyle, vvar, vert);
  value_of(pstyle, pvar, phi);
  value_of(tstyle, tvar, theta);
  value_of(xstyle, xvar, xdir);
  value_of(ystyle, yvar, ydir);
  value_of(zstyle, zvar, zdir);
  set_acceleration();
}

void FixGravityTalus::post_force(int vflag)
{
  if (!reason.empty()) return FixGravity::post_force(vflag);
  system->step().complete_step_of(*this);
}

/* The sums have begun with the weights: frozen particles have none in them. */

void FixGravityTalus::complete_step()
{
  const double *g = acceleration();
  if (!g) return;

  eflag = 0;
  egrav = 0.0;
  const int frozenbits = system->masses().frozen_groups();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double m = atom->rmass[i], *x = atom->x[i];
    egrav -= m * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
    if (!(atom->mask[i] & frozenbits)) continue;
    for (int d = 0; d < 3; d++) atom->f[i][d] += m * g[d];
  }
}
