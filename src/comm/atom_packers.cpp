// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/atom_packers.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

/* The vector of one step along y or z has the tilts of a triclinic box. Written as the host does,
   zero terms included: they decide about signed zeros. */

const std::vector<std::array<double, 3>> &ShiftSteps::of(const PeriodicShift &shift)
{
  steps.clear();
  for (int d = 0; d < 3; d++) {
    const double s = shift[d] > 0 ? 1.0 : -1.0;
    std::array<double, 3> step{0.0, 0.0, 0.0};
    if (d == 0) step[0] = s * domain->xprd;
    if (d == 1) {
      if (domain->triclinic) step[0] = s * domain->xy;
      step[1] = s * domain->yprd;
    }
    if (d == 2) {
      if (domain->triclinic) step[0] = s * domain->xz;
      if (domain->triclinic) step[1] = s * domain->yz;
      step[2] = s * domain->zprd;
    }
    for (int n = 0; n < std::abs(shift[d]); n++) steps.push_back(step);
  }
  return steps;
}

/* ---------------------------------------------------------------------- */

void HostPacker::set(int new_size, bool with_velocity)
{
  size = new_size;
  velocity = with_velocity;
}

/* One particle at a time: the host packs several ones array by array, and the receiver must be able
   to take out single ones. */

void HostPacker::pack(const int *particles, int count, double *out)
{
  int pbc[6] = {0, 0, 0, 0, 0, 0};
  for (int k = 0; k < count; k++, out += size) {
    int particle = particles[k];
    if (velocity)
      atom->avec->pack_comm_vel(1, &particle, out, 0, pbc);
    else
      atom->avec->pack_comm(1, &particle, out, 0, pbc);
  }
}

/* What the host packs begins with x, so that the shift can be added afterwards: the host itself
   could add only one step. */

void HostPacker::unpack(const ProxyRun &run, const int *places, const double *message)
{
  const auto &steps = shifts.of(run.shift);
  state.resize(size);
  for (int k = 0; k < run.count; k++) {
    std::copy_n(message + static_cast<std::size_t>(size) * places[k], size, state.begin());
    for (const auto &step : steps)
      for (int d = 0; d < 3; d++) state[d] += step[d];
    if (velocity)
      atom->avec->unpack_comm_vel(1, run.first + k, state.data());
    else
      atom->avec->unpack_comm(1, run.first + k, state.data());
  }
}

/* ---------------------------------------------------------------------- */

bool SpherePacker::applies(bool ghost_velocity) const
{
  const AtomVec *avec = atom->avec;
  return ghost_velocity && std::strcmp(atom->atom_style, "sphere") == 0 &&
         avec->size_forward == 3 && avec->size_velocity == 6 && !avec->bonus_flag &&
         !domain->deform_vremap;
}

void SpherePacker::pack(const int *particles, int count, double *out)
{
  const double *const *x = atom->x, *const *v = atom->v, *const *omega = atom->omega;
  for (int k = 0; k < count; k++, out += stride()) {
    const int i = particles[k];
    for (int d = 0; d < 3; d++) {
      out[d] = x[i][d];
      out[3 + d] = v[i][d];
    }
    if (spins)
      for (int d = 0; d < 3; d++) out[6 + d] = omega[i][d];
  }
}

void SpherePacker::unpack(const ProxyRun &run, const int *places, const double *message)
{
  double **x = atom->x, **v = atom->v, **omega = atom->omega;
  const auto width = static_cast<std::size_t>(stride());
  const auto &steps = shifts.of(run.shift);
  for (int k = 0; k < run.count; k++) {
    const int i = run.first + k;
    const double *in = message + width * places[k];
    for (int d = 0; d < 3; d++) {
      x[i][d] = in[d];
      v[i][d] = in[3 + d];
    }
    if (spins)
      for (int d = 0; d < 3; d++) omega[i][d] = in[6 + d];
    for (const auto &step : steps)
      for (int d = 0; d < 3; d++) x[i][d] += step[d];
  }
}
