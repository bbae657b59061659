/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/fix_nve_sphere_symplectic.h"

#include "base/in_parallel.h"
#include "base/rows.h"
#include "body/motion/quaternion.h"
#include "system/host/command_words.h"
#include "system/host/fix_list.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "math_extra.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

#include <string>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using Talus::command_words;
using Talus::row;
using Talus::Words;

namespace {
constexpr const char *title = "Fix nve/sphere/symplectic";
}

/* ---------------------------------------------------------------------- */

FixNVESphereSymplectic::FixNVESphereSymplectic(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(Talus::GranularSystem::of(lmp)), start(lmp, title),
    second_order(this, lmp, title), gravity(lmp)
{
  time_integrate = 1;
  dynamic_group_allow = 1;
  restart_global = 1;

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, 2,
               "Fix nve/sphere/symplectic requires atom attributes radius, rmass, "
               "omega and torque (atom_style sphere)");

  Words words = command_words(lmp, "fix nve/sphere/symplectic", narg, arg, 3);
  std::vector<std::string> known;
  while (!words.at_end()) {
    const std::string keyword = words.peek();
    if (std::find(known.begin(), known.end(), keyword) != known.end())
      words.fail(0, "keyword '" + keyword + "' given twice");
    known.push_back(keyword);
    parse_keyword(words);
    words.about("");
  }

  const bool says_start = std::find(known.begin(), known.end(), "start") != known.end();
  if (integration_order == 2) SecondOrderCheck::set_half(lmp, title, start, says_start);

  if (gravity.given()) {
    scalar_flag = 1;
    extscalar = 1;
    global_freq = 1;
    energy_global_flag = 1;
  }
}

/* ----------------------------------------------------------------------
   one keyword with its values
------------------------------------------------------------------------- */

void FixNVESphereSymplectic::parse_keyword(Words &words)
{
  static const std::vector<std::string> keywords = {"start", "order", "gravity", "orientation",
                                                    "disc"};
  const std::string keyword = keywords[words.choice("keyword", keywords)];
  words.about(keyword);
  if (keyword == "start") {
    start.set_half(words.choice("value", {"half", "plain"}) == 0);
  } else if (keyword == "order") {
    integration_order = 1 + words.choice("value", {"1", "2"});
  } else if (keyword == "gravity") {
    gravity.parse(words);
  } else if (keyword == "orientation") {
    rotates = words.choice("value", {"yes", "no"}) == 0;
    if (rotates && !atom->quat_flag && !atom->mu_flag)
      words.fail(1, "expected an atom style with a quaternion or a dipole (bpm/sphere or hybrid "
                    "sphere dipole)");
  } else {
    if (domain->dimension != 2) words.fail(1, "expected a 2d simulation");
    inertia = 0.5;
  }
}

/* ---------------------------------------------------------------------- */

int FixNVESphereSymplectic::setmask()
{
  return INITIAL_INTEGRATE;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereSymplectic::init()
{
  if (update->whichflag == 2)
    error->all(FLERR, Error::NOLASTLINE, "Fix nve/sphere/symplectic cannot be used with minimize");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix nve/sphere/symplectic cannot be used with run_style respa: no inner levels");

  const bigint npoints = count_members([this](int i) { return !(atom->radius[i] > 0.0); });
  if (npoints)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix nve/sphere/symplectic: expected spheres of non-zero "
               "radius, but {} members of group {} have none",
               npoints, group->names[igroup]);

  if (integration_order == 2) second_order.check(*system, start);
  frozenbits = 0;
  if (gravity.given())
    for (auto &fix : Talus::fix_list(*modify))
      if (fix != this) check_fix(fix);
}

/* ----------------------------------------------------------------------
   with gravity: refuse a fix that does not go with it, note frozen groups
------------------------------------------------------------------------- */

void FixNVESphereSymplectic::check_fix(Fix *fix)
{
  const char *reason = nullptr;
  std::function<bool(int)> disturbed = [this, fix](int i) {
    return (atom->mask[i] & fix->groupbit) != 0;
  };

  const auto *other_integrator = dynamic_cast<FixNVESphereSymplectic *>(fix);
  if (utils::strmatch(fix->style, "^gravity") ||
      (other_integrator && other_integrator->gravity.given())) {
    reason = "gravity would act twice";
  } else if (strcmp(fix->style, "setforce") == 0 || utils::strmatch(fix->style, "^setforce/kk")) {
    reason = "gravity is not seen in the force that it sets";
  } else if (utils::strmatch(fix->style, "^freeze")) {
    frozenbits |= fix->groupbit;
    reason = "frozen particles get no gravity, but these move";
    disturbed = [this, fix](int i) {
      const double *v = atom->v[i], *w = atom->omega[i];
      return (atom->mask[i] & fix->groupbit) && (v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0 ||
                                                 w[0] != 0.0 || w[1] != 0.0 || w[2] != 0.0);
    };
  }
  if (!reason) return;

  const bigint n = count_members(disturbed);
  if (n)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix nve/sphere/symplectic gravity: fix {} ({}) acts on "
               "{} members of group {}: {}",
               fix->id, fix->style, n, group->names[igroup], reason);
}

/* ----------------------------------------------------------------------
   number of members of the group on all ranks that satisfy a condition
------------------------------------------------------------------------- */

bigint FixNVESphereSymplectic::count_members(const std::function<bool(int)> &condition)
{
  bigint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && condition(i)) mine++;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   the whole step; dt is read here because other fixes may change it
------------------------------------------------------------------------- */

void FixNVESphereSymplectic::initial_integrate(int /*vflag*/)
{
  const double dt = update->dt;
  system->step().advance(this, step_of(start.next_kick(dt), dt), frozenbits);
  if (rotates) rotate(dt);
}

Talus::RecordStep FixNVESphereSymplectic::step_of(double kick, double dt) const
{
  const double kick_f = kick * force->ftm2v;
  const double *const g = gravity.acceleration();
  Talus::RecordStep step{dt, kick_f, {kick_f * g[0], kick_f * g[1], kick_f * g[2]}, inertia};
  // the lag is that after the step; a plain start is one that is half a step off
  step.extrapolation = start.is_half() ? start.lag() / kick : 0.5;
  return step;
}

std::string FixNVESphereSymplectic::needs_arrays()
{
  if (rotates) return "it turns orientations";
  return group->dynamic[igroup] ? "its group is dynamic" : "";
}

double FixNVESphereSymplectic::next_kick_in_steps() const
{
  return start.coming_kick(update->dt) / update->dt;
}

Talus::Kicks FixNVESphereSymplectic::kicks() const
{
  return {start.last_kick() / update->dt, 0.0};
}

/* ----------------------------------------------------------------------
   quaternions and dipoles turn by the angle dt |omega| about omega,
   a rotation in the frame of space: exact for constant omega
------------------------------------------------------------------------- */

void FixNVESphereSymplectic::rotate(double dt)
{
  const int n = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  Talus::in_ranges(n, comm->nthreads, [this, dt](int, int begin, int end) {
    for (int i = begin; i < end; i++)
      if (atom->mask[i] & groupbit) rotate(i, dt);
  });
}

void FixNVESphereSymplectic::rotate(int i, double dt)
{
  const auto rotation = Talus::rotation_in(row(atom->omega[i]), dt);
  if (atom->quat_flag) {
    double *const q = atom->quat[i];
    const auto now = (rotation * Talus::Quaternion<double>{q[0], q[1], q[2], q[3]}).normalized();
    const double values[4] = {now.w, now.x, now.y, now.z};
    std::copy(values, values + 4, q);
  }
  if (atom->mu_flag && atom->mu[i][3] > 0.0) {
    double *const mu = atom->mu[i];    // x y z length
    const Talus::Vector3<double> now = rotation.axes().to_space(row(mu));
    Talus::put(mu[3] / length(now) * now, mu);
  }
}

/* ----------------------------------------------------------------------
   potential energy in the gravity field
------------------------------------------------------------------------- */

double FixNVESphereSymplectic::compute_scalar()
{
  double mine = 0.0, all = 0.0, x[3];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || (atom->mask[i] & frozenbits)) continue;
    domain->unmap(atom->x[i], atom->image[i], x);
    mine -= atom->rmass[i] * MathExtra::dot3(gravity.acceleration(), x);
  }
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereSymplectic::write_restart(FILE *fp)
{
  start.write_restart(fp);
}

void FixNVESphereSymplectic::restart(char *buf)
{
  start.restart(buf);
}
