// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/atom_packers.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"

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

/* The host's packing begins with x of all particles (and v, if it sends velocities), so that the
   shift can be added afterwards: the host itself could add only one step. */

void HostPacker::pack(const int *particles, int count, const PeriodicShift &shift, double *out)
{
  int pbc[6] = {0, 0, 0, 0, 0, 0};
  int *list = const_cast<int *>(particles);    // the host does not change it
  if (velocity)
    atom->avec->pack_comm_vel(count, list, out, 0, pbc);
  else
    atom->avec->pack_comm(count, list, out, 0, pbc);

  const int width = velocity ? 6 : 3;
  for (const auto &step : shifts.of(shift))
    for (int k = 0; k < count; k++)
      for (int d = 0; d < 3; d++) out[width * k + d] += step[d];
}

void HostPacker::unpack(int first, int count, const double *in)
{
  double *buffer = const_cast<double *>(in);    // the host does not change it
  if (velocity)
    atom->avec->unpack_comm_vel(count, first, buffer);
  else
    atom->avec->unpack_comm(count, first, buffer);
}

/* ---------------------------------------------------------------------- */

bool SpherePacker::applies(bool ghost_velocity) const
{
  const AtomVec *avec = atom->avec;
  return ghost_velocity && std::strcmp(atom->atom_style, "sphere") == 0 &&
         avec->size_forward == 3 && avec->size_velocity == 6 && !avec->bonus_flag &&
         !domain->deform_vremap;
}

void SpherePacker::pack(const int *particles, int count, const PeriodicShift &shift, double *out)
{
  const double *const *x = atom->x, *const *v = atom->v, *const *omega = atom->omega;
  const int width = stride();
  for (int k = 0; k < count; k++) {
    const int i = particles[k];
    double *to = out + static_cast<std::size_t>(width) * k;
    for (int d = 0; d < 3; d++) {
      to[d] = x[i][d];
      to[3 + d] = v[i][d];
    }
    if (spins)
      for (int d = 0; d < 3; d++) to[6 + d] = omega[i][d];
  }
  for (const auto &step : shifts.of(shift))
    for (int k = 0; k < count; k++)
      for (int d = 0; d < 3; d++) out[static_cast<std::size_t>(width) * k + d] += step[d];
}

void SpherePacker::unpack(int first, int count, const double *in)
{
  double **x = atom->x, **v = atom->v, **omega = atom->omega;
  for (int i = first; i < first + count; i++) {
    for (int d = 0; d < 3; d++) {
      x[i][d] = in[d];
      v[i][d] = in[3 + d];
    }
    if (spins)
      for (int d = 0; d < 3; d++) omega[i][d] = in[6 + d];
    in += stride();
  }
}
