/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_CLUMP_LANES_H
#define LMP_CLUMP_LANES_H

#include "base/aligned_vector.h"
#include "base/lanes.h"
#include "body/motion/clump_motion.h"
#include "fix/clump/clump_table.h"
#include "particles/particle_records.h"

#include <algorithm>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Clumps while their spheres are in the records: groups of eight clumps, lane by lane, that are
   moved together, with the bits of one by one. The m-th spheres of the clumps of a group are a row.

   In a usual row all eight spheres are there, owned and free to move: what does not change of them
   is kept as lanes, and the rest of their records is read and written as a whole. In other rows
   spheres are looked at one by one.

   Made by the fix that moves clumps; used until neighbor lists are rebuilt, or a step is made in
   the arrays of LAMMPS.
------------------------------------------------------------------------- */

class ClumpLanes {
 public:
  using Vec8 = Talus::Vec8;
  using State = Talus::ClumpState<Vec8>;
  using Motion = Talus::SphereMotion<Vec8>;
  using Vector = Talus::Vector3<Vec8>;
  struct Sums {
    Vector force, torque;
  };

  bool are_current() const { return current; }
  void forget() { current = false; }

  // places of spheres, and room for the states of the clumps, to be set; slots are those of the records;
  // in a plane (two dimensions) nothing acts or moves along z
  void make(const ClumpTable &table, const Talus::ParticleRecords &records, const int *slot_of_atom,
            bool in_a_plane);
  void set(int clump, const Talus::ClumpState<double> &state);
  Talus::ClumpState<double> get(int clump) const;
  int num_groups() const { return static_cast<int>(groups.size()); }

  // find_motion(state, sums) moves the clumps of a group and returns the motion of their spheres;
  // those of this rank get their places and velocities. load_of(sphere): force and torque on any one;
  // shift_of(sphere): by which the center of mass is away as it is counted, of one that is wrapped
  template <class FindMotion, class LoadOf, class ShiftOf>
  void move(const ClumpTable &table, Talus::ParticleRecords &records, int group,
            FindMotion find_motion, LoadOf load_of, ShiftOf shift_of)
  {
    if (group + 1 < num_groups()) prefetch(records, groups[group + 1]);
    Group &this_group = groups[group];
    State s = this_group.load();
    const Motion motion = find_motion(s, sum_loads(table, records, this_group, s, load_of));
    this_group.keep(s);
    if (records.keeps_changes())
      place<true>(table, records, this_group, s, motion, shift_of);
    else
      place<false>(table, records, this_group, s, motion, shift_of);
  }

 private:
  static constexpr int lanes = Talus::lanes;

  struct Group {
    enum { POSITION, VELOCITY = 3, MOMENTUM = 6, OMEGA = 9, QUAT = 12, INERTIA = 16, MASS = 19 };
    alignas(64) double number[20][lanes];    // of states; axes are those of QUAT
    int first_row, end_row;
    int first_clump, end_clump;

    // visit(which, number) for those of the state of one clump or of eight that change in a step
    template <class AnyState, class Visit> static void visit_motion(AnyState &s, Visit visit)
    {
      visit_three(POSITION, s.position, visit);
      visit_three(VELOCITY, s.velocity, visit);
      visit_three(MOMENTUM, s.momentum, visit);
      visit_three(OMEGA, s.omega, visit);
      visit(QUAT, s.quat.w);
      visit(QUAT + 1, s.quat.x);
      visit(QUAT + 2, s.quat.y);
      visit(QUAT + 3, s.quat.z);
    }
    template <class AnyState, class Visit> static void visit_all(AnyState &s, Visit visit)
    {
      visit_motion(s, visit);
      visit_three(INERTIA, s.inverse_inertia, visit);
      visit(MASS, s.mass);
    }
    template <class AnyVector, class Visit>
    static void visit_three(int which, AnyVector &v, const Visit &visit)
    {
      visit(which, v.x);
      visit(which + 1, v.y);
      visit(which + 2, v.z);
    }

    State load() const
    {
      State s;
      visit_all(s, [this](int which, Vec8 &value) { value = Talus::load8(number[which]); });
      s.axes = s.quat.axes();
      return s;
    }
    void keep(const State &s)
    {
      visit_motion(s, [this](int which, const Vec8 &value) { Talus::store(number[which], value); });
    }
  };
  struct Row {
    enum { PLACE, RADIUS = 3, INVERSE_RADIUS, INVERSE_MASS };
    alignas(64) double number[6][lanes];
    int slot[lanes];     // of owned spheres
    unsigned wrapped;    // bits of the lanes whose spheres are in another period than their centers
    bool usual;

    Vec8 at(int which) const { return Talus::load8(number[which]); }
    Vector place() const { return {at(0), at(1), at(2)}; }
  };

  bool current = false, flat = false;
  Talus::AlignedVector<Group> groups;
  Talus::AlignedVector<Row> rows;

  void make_row(const ClumpTable &table, const Talus::ParticleRecords &records,
                const int *slot_of_atom, const Group &group, int m);

  // visit(k, sphere) for the m-th sphere of each clump
  template <class Visit>
  static void for_each_sphere(const ClumpTable &table, const Group &group, int m, Visit visit)
  {
    for (int c = group.first_clump; c < group.end_clump; c++) {
      const ClumpSphere *s = table.begin(c) + m;
      if (s < table.end(c)) visit(c - group.first_clump, *s);
    }
  }

  void prefetch(const Talus::ParticleRecords &records, const Group &group) const
  {
    for (int r = group.first_row; r < group.end_row; r++) {
      if (!rows[r].usual) continue;
      for (const int slot : rows[r].slot) {
        records.prefetch(slot);
        __builtin_prefetch(&records.load[2L * slot]);
      }
    }
  }

  template <class LoadOf>
  Sums sum_loads(const ClumpTable &table, const Talus::ParticleRecords &records, const Group &group,
                 const State &state, LoadOf load_of) const
  {
    Sums sum{};
    for (int r = group.first_row; r < group.end_row; r++) {
      const Sums row_sum =
          rows[r].usual ? loads_of(records, rows[r]) : loads_one_by_one(table, group, r, load_of);
      sum.force = sum.force + row_sum.force;
      sum.torque = sum.torque +
                   (cross(state.axes.to_space(rows[r].place()), row_sum.force) + row_sum.torque);
    }
    if (flat) sum.force.z = sum.torque.x = sum.torque.y = Vec8{};
    return sum;
  }

  template <class Which> static Talus::EightRows eight(const Row &row, Which which)
  {
    return Talus::to_lanes(
        [&](int k) -> const Talus::Record & { return which(static_cast<long>(row.slot[k])); });
  }

  // what ParticleRecords::torque() says
  static Sums loads_of(const Talus::ParticleRecords &records, const Row &row)
  {
    const Vec8 none{}, radius = row.at(Row::RADIUS);
    const auto of = [&](const Talus::AlignedVector<Talus::Record> &of_all, int offset) {
      return eight(row,
                   [&](long slot) -> const Talus::Record & { return of_all[2 * slot + offset]; });
    };
    const Talus::EightRows f = of(records.load, 0), m = of(records.load, 1);
    const Vector torque_per_radius{m.number[0], m.number[1], m.number[2]};
    Vector torque{none - radius * torque_per_radius.x, none - radius * torque_per_radius.y,
                  none - radius * torque_per_radius.z};
    if (!records.twisting_torque.empty()) {
      const Talus::EightRows t = eight(
          row, [&](long slot) -> const Talus::Record & { return records.twisting_torque[slot]; });
      torque = torque + Vector{t.number[0], t.number[1], t.number[2]};
    }
    torque = select(f.number[3] > none, torque_per_radius, torque);
    return {{f.number[0], f.number[1], f.number[2]}, torque};
  }

  template <class LoadOf>
  static Sums loads_one_by_one(const ClumpTable &table, const Group &group, int r, LoadOf load_of)
  {
    Talus::Record f[lanes] = {}, t[lanes] = {};
    for_each_sphere(table, group, r - group.first_row, [&](int k, const ClumpSphere &sphere) {
      const auto load = load_of(sphere);
      f[k] = record_of(load.force);
      t[k] = record_of(load.torque);
    });
    return {three(f), three(t)};
  }

  static Talus::Record record_of(const Talus::Vector3<double> &v) { return {{v.x, v.y, v.z, 0.0}}; }
  static Vector three(const Talus::Record *records)
  {
    const Talus::EightRows all =
        Talus::to_lanes([records](int k) -> const Talus::Record & { return records[k]; });
    return {all.number[0], all.number[1], all.number[2]};
  }

  template <bool changes, class ShiftOf>
  void place(const ClumpTable &table, Talus::ParticleRecords &records, const Group &group,
             const State &s, const Motion &motion, ShiftOf shift_of) const
  {
    for (int r = group.first_row; r < group.end_row; r++) {
      const Row &row = rows[r];
      const Vector place = row.place(), arm = s.axes.to_space(place);
      Vector v = motion.velocity_at(place);
      const int m = r - group.first_row;
      Vector x = arm + (row.wrapped ? s.position - shifts(table, group, m, row.wrapped, shift_of)
                                    : s.position);
      if (flat) x.z = v.z = Vec8{};
      Talus::Record x_row[lanes], v_row[lanes], w_row[lanes];
      Talus::to_rows({x.x, x.y, x.z, row.at(Row::RADIUS)}, x_row);
      Talus::to_rows({v.x, v.y, v.z, row.at(Row::INVERSE_MASS)}, v_row);
      Talus::to_rows({motion.omega.x, motion.omega.y, motion.omega.z, row.at(Row::INVERSE_RADIUS)},
                     w_row);
      const auto put = [&](int k, long slot) {
        Talus::Record *state = &records.motion[2 * slot];
        const Talus::Vec4 v_old = load4(state[0]), w_old = load4(state[1]);
        records.position[slot] = x_row[k];
        state[0] = v_row[k];
        state[1] = w_row[k];
        if constexpr (changes)
          records.keep_change(slot, v_old, load4(v_row[k]), w_old, load4(w_row[k]));
      };
      if (row.usual)
        for (int k = 0; k < lanes; k++) put(k, row.slot[k]);
      else
        for_each_sphere(table, group, m, [&](int k, const ClumpSphere &sphere) {
          if (sphere.owned) put(k, row.slot[k]);
        });
    }
  }

  template <class ShiftOf>
  static Vector shifts(const ClumpTable &table, const Group &group, int m, unsigned wrapped,
                       ShiftOf shift_of)
  {
    Talus::Record away[lanes] = {};
    for (int k = 0; k < lanes; k++)
      if (wrapped >> k & 1U) away[k] = record_of(shift_of(table.begin(group.first_clump + k)[m]));
    return three(away);
  }
};

}    // namespace LAMMPS_NS

#endif
