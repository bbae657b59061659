// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What fix large/body can be asked: sums over ranks, energies, pictures.

#include "fix/body/fix_large_body.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

double FixLargeBody::compute_vector(int n)
{
  const BodyLoad &total = body->load();
  const double values[6] = {total.force.x,  total.force.y,  total.force.z,
                            total.torque.x, total.torque.y, total.torque.z};
  if (n < 6) return values[n];
  if (n == 19) return total.contacts;
  if (n == 20) return total.heat;
  double state[BodyState::size];
  const BodyFrame &frame = body->frame();
  frame.state.to_array(state);
  return state[n - 6];
}

double FixLargeBody::compute_scalar()
{
  return body->energy() + body->motion().energy();
}

double FixLargeBody::compute_array(int row, int column)
{
  return body->surface().value(row, column);
}

int FixLargeBody::image(int *&kinds, double **&values)
{
  return body->surface().image(body->frame(), kinds, values);
}

double FixLargeBody::memory_usage()
{
  return body->memory_usage();
}
