/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "clump_lanes.h"

using namespace LAMMPS_NS;
using Talus::Record;

void ClumpLanes::make(const ClumpTable &table)
{
  Talus::renew(states, static_cast<std::size_t>(rows_per_clump) * table.size());
  Talus::renew(places, table.spheres.size());
  for (std::size_t n = 0; n < places.size(); n++) {
    const Talus::Vector3<double> &d = table.spheres[n].place;
    places[n] = {{d.x, d.y, d.z, 0.0}};
  }
  current = true;
}

void ClumpLanes::set(int clump, const Talus::ClumpState<double> &s)
{
  row(clump, POSITION) = {{s.position.x, s.position.y, s.position.z, s.mass}};
  row(clump, VELOCITY) = {{s.velocity.x, s.velocity.y, s.velocity.z, 0.0}};
  row(clump, MOMENTUM) = {{s.momentum.x, s.momentum.y, s.momentum.z, 0.0}};
  row(clump, TURN) = {{s.turn.w, s.turn.x, s.turn.y, s.turn.z}};
  row(clump, INERTIA) = {{s.inverse_inertia.x, s.inverse_inertia.y, s.inverse_inertia.z, 0.0}};
  row(clump, OMEGA) = {{s.omega.x, s.omega.y, s.omega.z, 0.0}};
}

Talus::ClumpState<double> ClumpLanes::get(int clump) const
{
  const auto three = [&](Row which) {
    const double *c = row(clump, which).c;
    return Talus::Vector3<double>{c[0], c[1], c[2]};
  };
  const double *q = row(clump, TURN).c;
  Talus::ClumpState<double> s;
  s.mass = row(clump, POSITION).c[3];
  s.inverse_inertia = three(INERTIA);
  s.position = three(POSITION);
  s.velocity = three(VELOCITY);
  s.momentum = three(MOMENTUM);
  s.omega = three(OMEGA);
  s.turn = {q[0], q[1], q[2], q[3]};
  s.axes = s.turn.axes();
  return s;
}
