/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/clump/clump_lanes.h"

using namespace LAMMPS_NS;

void ClumpLanes::make(const ClumpTable &table, const Talus::ParticleRecords &records,
                      const int *slot_of_atom, bool in_a_plane)
{
  flat = in_a_plane;
  groups.assign((table.size() + lanes - 1) / lanes, Group{});
  rows.clear();
  for (int g = 0; g < num_groups(); g++) {
    Group &group = groups[g];
    group.first_clump = lanes * g;
    group.end_clump = std::min(table.size(), lanes * (g + 1));
    std::int64_t most = 0;
    for (int c = group.first_clump; c < group.end_clump; c++)
      most = std::max(most, table.first[c + 1] - table.first[c]);
    group.first_row = static_cast<int>(rows.size());
    for (int m = 0; m < most; m++) make_row(table, records, slot_of_atom, group, m);
    group.end_row = static_cast<int>(rows.size());
    for (int k = 0; k < lanes; k++)    // lanes without a clump
      group.number[Group::MASS][k] = group.number[Group::QUAT][k] = 1.0;
  }
  current = true;
}

void ClumpLanes::make_row(const ClumpTable &table, const Talus::ParticleRecords &records,
                          const int *slot_of_atom, const Group &group, int m)
{
  Row row{};
  int usual = 0;
  for_each_sphere(table, group, m, [&](int k, const ClumpSphere &sphere) {
    const double place[3] = {sphere.place.x, sphere.place.y, sphere.place.z};
    for (int d = 0; d < 3; d++) row.number[Row::PLACE + d][k] = place[d];
    if (!sphere.owned) return;
    const int slot = slot_of_atom[sphere.atom];
    row.slot[k] = slot;
    row.number[Row::RADIUS][k] = records.position[slot].c[3];
    row.number[Row::INVERSE_RADIUS][k] = records.omega(slot).c[3];
    row.number[Row::INVERSE_MASS][k] = records.velocity(slot).c[3];
    if (sphere.wrapped) row.wrapped |= 1U << k;
    if (row.number[Row::INVERSE_MASS][k] > 0.0) usual++;
  });
  row.usual = usual == lanes;
  rows.push_back(row);
}

void ClumpLanes::set(int clump, const Talus::ClumpState<double> &s)
{
  Group &group = groups[clump / lanes];
  Group::visit_all(s, [&](int which, double value) { group.number[which][clump % lanes] = value; });
}

Talus::ClumpState<double> ClumpLanes::get(int clump) const
{
  const Group &group = groups[clump / lanes];
  Talus::ClumpState<double> s;
  Group::visit_all(s,
                   [&](int which, double &value) { value = group.number[which][clump % lanes]; });
  s.axes = s.quat.axes();
  return s;
}
