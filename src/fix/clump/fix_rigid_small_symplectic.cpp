/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/clump/fix_rigid_small_symplectic.h"

#include "base/state_exchange.h"
#include "system/host/command_words.h"
#include "system/host/fix_list.h"
#include "system/host/private_members.h"

#include "atom.h"
#include "error.h"
#include "fix_gravity.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <type_traits>

using namespace LAMMPS_NS;
using namespace FixConst;
using ClumpState = Talus::ClumpState<double>;
using Talus::Words;

namespace {
constexpr const char *command = "fix rigid/small/symplectic";
constexpr const char *title = "Fix rigid/small/symplectic";
}    // namespace

/* ---------------------------------------------------------------------- */

FixRigidSmallSymplectic::Settings::Settings(LAMMPS *lmp, int narg, char **arg) :
    stock(arg, arg + std::min(narg, 3)), start(lmp, title), gravity(lmp)
{
  Words words = Talus::command_words(lmp, command, narg, arg, 3);
  const auto hand_over = [&](int count, const std::string &expected) {
    for (int n = 0; n < count; n++) {
      if (words.at_end()) words.text(expected);
      stock.push_back(arg[words.index()]);
      words.skip(1);
    }
  };
  const bool custom = words.choice("kind of bodies", {"molecule", "custom"}) == 1;
  words.skip(-1);
  hand_over(custom ? 2 : 1, "i_name or v_name");

  static const std::vector<std::string> keywords = {"start", "order",  "gravity",
                                                    "mol",   "infile", "reinit"};
  std::vector<std::string> known;
  while (!words.at_end()) {
    const std::string keyword = words.peek();
    if (std::find(known.begin(), known.end(), keyword) != known.end())
      words.fail(0, "keyword '" + keyword + "' given twice");
    known.push_back(keyword);
    const int which = words.choice("keyword", keywords);
    words.about(keyword);
    if (which == 0) {
      start.set_half(words.choice("value", {"half", "plain"}) == 0);
    } else if (which == 1) {
      order = 1 + words.choice("value", {"1", "2"});
    } else if (which == 2) {
      gravity.parse(words);
    } else {
      words.skip(-1);
      hand_over(2, which == 3   ? "ID of a molecule template"
                   : which == 4 ? "name of a file"
                                : "yes or no");
    }
    words.about("");
  }
  const bool says_start = std::find(known.begin(), known.end(), "start") != known.end();
  if (order == 2) SecondOrderCheck::set_half(lmp, title, start, says_start);
}

FixRigidSmallSymplectic::FixRigidSmallSymplectic(LAMMPS *lmp, int narg, char **arg) :
    FixRigidSmallSymplectic(lmp, Settings(lmp, narg, arg))
{
}

FixRigidSmallSymplectic::FixRigidSmallSymplectic(LAMMPS *lmp, Settings settings) :
    FixRigidSmallTalus(lmp, static_cast<int>(settings.stock.size()), settings.stock.data()),
    start(settings.start), integration_order(settings.order), second_order(this, lmp, title),
    gravity(settings.gravity)
{
  restart_global = 1;
}

int FixRigidSmallSymplectic::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | PRE_NEIGHBOR;
}

/* ---------------------------------------------------------------------- */

void FixRigidSmallSymplectic::init()
{
  FixRigidSmallTalus::init();
  if (!reason.empty())
    error->all(FLERR, Error::NOLASTLINE, "{} {}: {}: use fix rigid/small", title, id, reason);
  for (const Fix *fix : Talus::fix_list(*modify))
    if (fix != this) check_fix(fix);
  if (integration_order == 2) second_order.check(*system, start);
}

/* Without a pair style of Talus as well: forces are those of the arrays. */

std::string FixRigidSmallSymplectic::find_reason()
{
  return reason_of_settings();
}

void FixRigidSmallSymplectic::check_fix(const Fix *fix) const
{
  std::string problem;
  if (fix->time_integrate)
    problem = "moves them as well: give it another group";
  else if (utils::strmatch(fix->style, "^freeze"))
    problem = "freezes them, but they move: give it another group";
  else if (const auto *field = dynamic_cast<const FixGravity *>(fix))
    if (gravity.given() && !Talus::is_disabled(*field))
      problem = "lets them fall a second time: leave the word gravity out, or use 'disable' there";
  if (problem.empty()) return;
  const bigint n = count_common(fix);
  if (n)
    error->all(FLERR, Error::NOLASTLINE,
               "{} {}: of the spheres of its clumps {} are in the group "
               "of fix {} ({}), which {}",
               title, id, n, fix->id, fix->style, problem);
}

bigint FixRigidSmallSymplectic::count_common(const Fix *fix) const
{
  bigint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (bodytag[i] && (atom->mask[i] & fix->groupbit)) mine++;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

/* ---------------------------------------------------------------------- */

void FixRigidSmallSymplectic::initial_integrate(int vflag)
{
  v_init(vflag);
  const double dt = update->dt, kick_time = start.next_kick(dt), time = kick_time * force_unit();
  if (start.is_half()) extrapolation = start.lag() / kick_time;
  way_back = integration_order == 2 ? start.lag() : 0.0;
  find_particles();
  share_loads();
  const double *g = gravity.acceleration();
  const Kick kick{time, {time * g[0], time * g[1], time * g[2]}, 1.0};
  const auto motion = [&](auto &s, const auto &sum) {
    using Real = std::decay_t<decltype(s.mass)>;
    s.kick(time, sum.force, sum.torque);
    s.velocity = s.velocity + Talus::in_all_lanes<Real>({kick.gravity_kick[0], kick.gravity_kick[1],
                                                         kick.gravity_kick[2]});
    if (integration_order == 2) return s.drift_half_way(dt);
    s.drift_freely(dt);
    return s.sphere_motion();
  };
  if (moves_in_lanes()) {
    move_in_lanes(motion);
  } else {
    take_from_lanes();
    for_each_clump([&](int clump, Body &b) {
      ClumpState s = state_of(b);
      const auto sphere_motion = motion(s, loads_on(clump, s));
      put_state(s, b);
      place_spheres(clump, s, sphere_motion, b, SphereUpdate::POSITIONS_AND_VELOCITIES, kick);
    });
  }
  system->step().advance(this, record_step(time));
}

Talus::SphereMotion<double> FixRigidSmallSymplectic::sphere_motion_of(const ClumpState &state) const
{
  if (way_back == 0.0) return state.sphere_motion();
  ClumpState before = state;
  before.drift_freely(-2.0 * way_back);
  return half_way_between(before.sphere_motion(), state.sphere_motion());
}

/* The step is complete; but others may look at the clumps in the bodies of the stock class. */

void FixRigidSmallSymplectic::final_integrate()
{
  system->step().complete_step_of(*this);
}

void FixRigidSmallSymplectic::complete_step()
{
  take_from_lanes();
}

/* ---------------------------------------------------------------------- */

double FixRigidSmallSymplectic::next_kick_in_steps() const
{
  return start.coming_kick(update->dt) / update->dt;
}

Talus::Kicks FixRigidSmallSymplectic::kicks() const
{
  return {start.last_kick() / update->dt, 0.0};
}

void FixRigidSmallSymplectic::write_restart(FILE *fp)
{
  start.write_restart(fp, way_back);
}

void FixRigidSmallSymplectic::exchange_state(Talus::StateExchange &x)
{
  FixRigidSmallTalus::exchange_state(x);
  double lag = start.lag();
  x(lag, way_back);
  start.set_lag(lag);
}

/* Velocities of spheres are those of the file until the first step. */

void FixRigidSmallSymplectic::restart(char *buf)
{
  way_back = start.restart(buf);
}
