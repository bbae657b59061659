// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/exchange/atom_packers.h"

#include "system/host/present_box.h"

#include "atom.h"
#include "atom_vec.h"
#include "domain.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

/// visit(proxy, place, steps, velocity_steps) for each proxy: its index, the place of its particle in
/// the message and the steps of its shift.
template <class Visit>
void for_each_shifted(const ExchangeNeighbor &from, const PeriodicBox &box, Visit visit)
{
  PeriodicShift known{};
  std::vector<std::array<double, 3>> steps, velocity_steps;
  from.for_each_proxy([&](int proxy, int place, const PeriodicShift &shift) {
    if (shift != known) {
      known = shift;
      steps.clear();
      velocity_steps.clear();
      box.for_each_step(shift, [&](const auto &step) { steps.push_back(step); });
      box.for_each_velocity_step(shift, [&](const auto &step) { velocity_steps.push_back(step); });
    }
    visit(proxy, place, steps, velocity_steps);
  });
}

template <class Steps> void add_steps(const Steps &steps, double *x)
{
  for (const auto &step : steps)
    for (int d = 0; d < 3; d++) x[d] += step[d];
}

}    // namespace

/* ---------------------------------------------------------------------- */

void AtomVecPacker::set(int new_size, bool with_velocity)
{
  size = new_size;
  velocity = with_velocity;
}

/* One particle at a time: LAMMPS packs several ones array by array, and the receiver must be able
   to take out single ones. */

void AtomVecPacker::pack(const ExchangeNeighbor &to, double *out)
{
  int pbc[6] = {0, 0, 0, 0, 0, 0};
  for (int particle : to.send_index) {
    if (velocity)
      atom->avec->pack_comm_vel(1, &particle, out, 0, pbc);
    else
      atom->avec->pack_comm(1, &particle, out, 0, pbc);
    out += size;
  }
}

/* What LAMMPS packs begins with x, and v if it is packed, so that the shift can be added afterwards:
   LAMMPS itself could add only one step. */

void AtomVecPacker::unpack(const ExchangeNeighbor &from, const double *message)
{
  state.resize(size);
  for_each_shifted(from, present_box(*domain),
                   [&](int proxy, int place, const auto &steps, const auto &velocity_steps) {
                     std::copy_n(message + static_cast<std::size_t>(size) * place, size,
                                 state.begin());
                     add_steps(steps, state.data());
                     if (velocity) add_steps(velocity_steps, state.data() + 3);
                     if (velocity)
                       atom->avec->unpack_comm_vel(1, proxy, state.data());
                     else
                       atom->avec->unpack_comm(1, proxy, state.data());
                   });
}

/* ---------------------------------------------------------------------- */

bool SpherePacker::applies(bool ghost_velocity) const
{
  const AtomVec *avec = atom->avec;
  return ghost_velocity && std::strcmp(atom->atom_style, "sphere") == 0 &&
         avec->size_forward == 3 && avec->size_velocity == 6 && !avec->bonus_flag;
}

void SpherePacker::pack(const ExchangeNeighbor &to, double *out)
{
  const double *const *x = atom->x, *const *v = atom->v, *const *omega = atom->omega;
  for (const int i : to.send_index) {
    for (const double *row : {x[i], v[i], omega[i]}) out = std::copy_n(row, 3, out);
  }
}

void SpherePacker::unpack(const ExchangeNeighbor &from, const double *message)
{
  double **x = atom->x, **v = atom->v, **omega = atom->omega;
  for_each_shifted(from, present_box(*domain),
                   [&](int proxy, int place, const auto &steps, const auto &velocity_steps) {
                     const double *in = message + 9L * place;
                     std::copy_n(in, 3, x[proxy]);
                     std::copy_n(in + 3, 3, v[proxy]);
                     std::copy_n(in + 6, 3, omega[proxy]);
                     add_steps(steps, x[proxy]);
                     add_steps(velocity_steps, v[proxy]);
                   });
}
