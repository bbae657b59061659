// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What fix large/body can be asked: sums over ranks, energies, pictures.

#include "fix/fix_large_body.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

/* The digits of this rank, where the sum over ranks takes them. */

void FixLargeBody::collect_digits()
{
  for (int k = 0; k < 6; k++) {
    exact.component[k].normalize();
    const std::int64_t *digits = exact.component[k].data();
    std::copy(digits, digits + ExactSum::size, digits_here + k * ExactSum::size);
  }
}

/* Bodies that move by their load need it in the next step: the sum over ranks goes on meanwhile. It
   is one of integers, exact in any order. */

void FixLargeBody::begin_reduction()
{
  if (comm->nprocs == 1) return;
  collect_digits();
  MPI_Iallreduce(digits_here, digits_of_all, size_digits, MPI_INT64_T, MPI_SUM, world, &reduction);
}

void FixLargeBody::finish_reduction()
{
  if (reduction != MPI_REQUEST_NULL) MPI_Wait(&reduction, MPI_STATUS_IGNORE);
}

void FixLargeBody::reduce_exactly()
{
  if (reduced) return;
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
}

void FixLargeBody::reduce_load()
{
  if (total_is_known) return;
  if (motion.moves()) reduce_exactly();
  const double here[7] = {mine.force.x,  mine.force.y,  mine.force.z, mine.torque.x,
                          mine.torque.y, mine.torque.z, mine.contacts};
  double all[7];
  MPI_Allreduce(here, all, 7, MPI_DOUBLE, MPI_SUM, world);
  total.contacts = all[6];
  total_is_known = true;
  if (motion.moves()) return;
  total.force = {all[0], all[1], all[2]};
  total.torque = {all[3], all[4], all[5]};
}

double FixLargeBody::compute_vector(int n)
{
  reduce_load();
  const double load[6] = {total.force.x,  total.force.y,  total.force.z,
                          total.torque.x, total.torque.y, total.torque.z};
  if (n < 6) return load[n];
  if (n == 19) return total.contacts;
  double state[BodyState::size];
  const BodyFrame &frame = motion.frame();
  frame.state.to_array(state);
  return state[n - 6];
}

/* The account begins when it is first asked for: then the contacts of this step are looked at once
   more, their forces going nowhere. */

double FixLargeBody::compute_scalar()
{
  if (!keeps_account && has_forces) {
    keeps_account = true;
    std::vector<double> unused(6L * atom->nlocal);
    BodyParticleView particles = view();
    particles.f = unused.data();
    particles.torque = unused.data() + 3L * atom->nlocal;
    compute_contacts(particles, false);
  }
  const double here = account.elastic() + account.dissipated_normal() +
                      account.dissipated_tangential() + account.dissipated_resistance();
  double all;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all + motion.energy();
}

double FixLargeBody::compute_array(int row, int column)
{
  return surface->value(row, column);
}

int FixLargeBody::image(int *&kinds, double **&values)
{
  return surface->image(motion.frame(), kinds, values);
}

double FixLargeBody::memory_usage()
{
  return contacts.memory_usage() + surface->memory_usage();
}
