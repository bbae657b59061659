// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The load that a large body bears: sums over ranks.

#include "system/bodies/large_body.h"

#include "system/step/granular_system.h"

#include "comm.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

/* The digits of this rank, where the sum over ranks takes them. */

void LargeBody::collect_digits()
{
  for (int k = 0; k < 6; k++) {
    exact.component[k].normalize();
    const std::int64_t *digits = exact.component[k].data();
    std::copy(digits, digits + ExactSum::size, digits_here + k * ExactSum::size);
  }
}

/* Bodies that move by their load need it in the next step: the sum over ranks goes on meanwhile. It
   is one of integers, exact in any order. */

void LargeBody::begin_reduction()
{
  if (comm->nprocs == 1) return;
  collect_digits();
  MPI_Iallreduce(digits_here, digits_of_all, size_digits, MPI_INT64_T, MPI_SUM, world, &reduction);
}

void LargeBody::finish_reduction()
{
  if (reduction != MPI_REQUEST_NULL) MPI_Wait(&reduction, MPI_STATUS_IGNORE);
}

const BodyLoad &LargeBody::exact_load()
{
  if (reduced) return total;
  if (reduction == MPI_REQUEST_NULL) {
    collect_digits();
    MPI_Allreduce(digits_here, digits_of_all, size_digits, MPI_INT64_T, MPI_SUM, world);
  }
  finish_reduction();
  double sum[6];
  for (int k = 0; k < 6; k++) {
    ExactSum all;
    const std::int64_t *digits = digits_of_all + k * ExactSum::size;
    std::copy(digits, digits + ExactSum::size, all.data());
    sum[k] = all.value();
  }
  total.force = {sum[0], sum[1], sum[2]};
  total.torque = {sum[3], sum[4], sum[5]};
  reduced = true;
  return total;
}

const BodyLoad &LargeBody::load()
{
  if (total_is_known) return total;
  if (exact_is_known) exact_load();
  const double here[8] = {mine.force.x,  mine.force.y,  mine.force.z,  mine.torque.x,
                          mine.torque.y, mine.torque.z, mine.contacts, mine.heat};
  double all[8];
  MPI_Allreduce(here, all, 8, MPI_DOUBLE, MPI_SUM, world);
  total.contacts = all[6];
  total.heat = all[7];
  total_is_known = true;
  if (exact_is_known) return total;
  total.force = {all[0], all[1], all[2]};
  total.torque = {all[3], all[4], all[5]};
  return total;
}

/* ---- over many steps ------------------------------------------------------------------------ */

/* The load that is there may not have been summed exactly: the next one is the first that counts. */

void LargeBody::watch(const Vector3<double> &point, int watcher)
{
  impulses.emplace(point);
  watchers.insert(watcher);
}

void LargeBody::unwatch(int watcher)
{
  if (watchers.erase(watcher) && watchers.empty()) impulses.reset();
}

/* With the velocities that contacts of second order see, or that the work of others counts with. */

void LargeBody::see_load()
{
  if (!frame().moves)
    impulses->see(frame(), {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  else if (system.integrators().lag() > 0.0)
    impulses->see(frame(), frame().present.velocity, frame().present.omega);
  else
    impulses->see(frame(), frame().state.velocity + frame().velocity_change,
                  frame().state.omega + frame().omega_change);
}

void LargeBody::watch_steps()
{
  if (!is_watched()) return;
  const Kicks kicks = system.integrators().kicks();
  const double dt = update->dt;
  impulses->begin_step(impulses->has_load() ? exact_load() : BodyLoad{}, kicks.before * dt,
                       kicks.after * dt, dt);
}

ImpulseAccount &LargeBody::settled_impulses()
{
  if (impulses->has_load()) impulses->settle(exact_load());
  return *impulses;
}

}    // namespace Talus
