/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_CLUMP_LANES_H
#define LMP_CLUMP_LANES_H

#include "base/aligned_vector.h"
#include "base/lanes.h"
#include "body/motion/clump_motion.h"
#include "fix/clump_table.h"
#include "particles/particle_records.h"

#include <algorithm>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Clumps while their spheres are in the records: states of clumps and places of spheres as rows of
   four numbers, eight of which become lanes and are moved together, with the bits of one by one.

   Made by the fix that moves clumps; used until neighbor lists are made anew, or a step is made in
   the arrays of the host.
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

  // rows for so many clumps, to be set by set(), and places of spheres
  void make(const ClumpTable &table);
  void set(int clump, const Talus::ClumpState<double> &state);
  Talus::ClumpState<double> get(int clump) const;

  // find_motion(state, sums) moves clumps begin ... begin+7, of which those below `end` are there,
  // and returns that of their spheres; those of this rank get their places and velocities. row(sphere): force and torque on one
  // that another rank owns; shift(sphere): a record, by which the center of mass is away as it is
  // counted, of one that is wrapped
  template <class FindMotion, class RowOfSphere, class Shift>
  void move(const ClumpTable &table, Talus::ParticleRecords &records, int begin, int end,
            FindMotion find_motion, RowOfSphere row, Shift shift)
  {
    State s = load(begin, end);
    const Sums sums = sum_loads(table, records, begin, end, s, row);
    const Motion its = find_motion(s, sums);
    keep(s, begin, end);
    if (records.keeps_changes())
      place<true>(table, records, begin, end, s, its, shift);
    else
      place<false>(table, records, begin, end, s, its, shift);
  }

 private:
  static constexpr int rows_per_clump = 6;
  enum Row { POSITION, VELOCITY, MOMENTUM, TURN, INERTIA, OMEGA };
  bool current = false;
  Talus::AlignedVector<Talus::Record> states, places;

  const Talus::Record &row(int clump, int which) const
  {
    return states[static_cast<std::size_t>(rows_per_clump) * clump + which];
  }
  Talus::Record &row(int clump, int which)
  {
    return states[static_cast<std::size_t>(rows_per_clump) * clump + which];
  }

  State load(int begin, int end) const
  {
    const auto eight = [&](int which) {
      return Talus::to_lanes(
          [&](int k) -> const Talus::Record & { return row(std::min(begin + k, end - 1), which); });
    };
    const Talus::EightRows x = eight(POSITION), v = eight(VELOCITY), l = eight(MOMENTUM),
                           q = eight(TURN), i = eight(INERTIA), w = eight(OMEGA);
    State s;
    s.mass = x.number[3];
    s.position = {x.number[0], x.number[1], x.number[2]};
    s.velocity = {v.number[0], v.number[1], v.number[2]};
    s.momentum = {l.number[0], l.number[1], l.number[2]};
    s.turn = {q.number[0], q.number[1], q.number[2], q.number[3]};
    s.inverse_inertia = {i.number[0], i.number[1], i.number[2]};
    s.omega = {w.number[0], w.number[1], w.number[2]};
    s.axes = s.turn.axes();
    return s;
  }

  void keep(const State &s, int begin, int end)
  {
    const Vec8 none{};
    const auto eight = [&](int which, Talus::EightRows from) {
      Talus::Record rows[Talus::lanes];
      Talus::to_rows(from, rows);
      for (int k = 0; k < end - begin; k++) row(begin + k, which) = rows[k];
    };
    eight(POSITION, {s.position.x, s.position.y, s.position.z, s.mass});
    eight(VELOCITY, {s.velocity.x, s.velocity.y, s.velocity.z, none});
    eight(MOMENTUM, {s.momentum.x, s.momentum.y, s.momentum.z, none});
    eight(TURN, {s.turn.w, s.turn.x, s.turn.y, s.turn.z});
    eight(OMEGA, {s.omega.x, s.omega.y, s.omega.z, none});
  }

  // visit(k, sphere, place) for the m-th sphere of each clump; the largest number of spheres
  static int most_spheres(const ClumpTable &table, int begin, int end)
  {
    std::int64_t most = 0;
    for (int c = begin; c < end; c++) most = std::max(most, table.first[c + 1] - table.first[c]);
    return static_cast<int>(most);
  }
  template <class Visit>
  static void for_each_sphere(const ClumpTable &table, int begin, int end, int m, Visit visit)
  {
    for (int k = 0; k < end - begin; k++) {
      const std::int64_t n = table.first[begin + k] + m;
      if (n < table.first[begin + k + 1]) visit(k, n);
    }
  }

  template <class RowOfSphere>
  Sums sum_loads(const ClumpTable &table, const Talus::ParticleRecords &records, int begin, int end,
                 const State &state, RowOfSphere row) const
  {
    Sums sum{};
    const int most = most_spheres(table, begin, end);
    for (int m = 0; m < most; m++) {
      Talus::Record f[Talus::lanes] = {}, t[Talus::lanes] = {}, d[Talus::lanes] = {};
      for_each_sphere(table, begin, end, m, [&](int k, std::int64_t n) {
        const ClumpSphere &sphere = table.spheres[n];
        d[k] = places[n];
        if (!sphere.owned) {
          const double *its = row(sphere);
          std::copy(its, its + 3, f[k].c);
          std::copy(its + 3, its + 6, t[k].c);
        } else if (records.velocity(sphere.slot).c[3] > 0.0) {    // not frozen
          f[k] = records.load[2L * sphere.slot];
          store(t[k], records.torque(sphere.slot));
        }
      });
      const Vector force = three(f), torque = three(t), arm = state.axes.to_space(three(d));
      sum.force = sum.force + force;
      sum.torque = sum.torque + (cross(arm, force) + torque);
    }
    return sum;
  }

  static Vector three(const Talus::Record *rows)
  {
    const Talus::EightRows all =
        Talus::to_lanes([rows](int k) -> const Talus::Record & { return rows[k]; });
    return {all.number[0], all.number[1], all.number[2]};
  }

  template <bool changes, class Shift>
  void place(const ClumpTable &table, Talus::ParticleRecords &records, int begin, int end,
             const State &s, const Motion &motion, Shift shift) const
  {
    Talus::Record w[Talus::lanes];
    Talus::to_rows({motion.omega.x, motion.omega.y, motion.omega.z, Vec8{}}, w);
    const int most = most_spheres(table, begin, end);
    for (int m = 0; m < most; m++) {
      Talus::Record d[Talus::lanes] = {}, away[Talus::lanes] = {}, x[Talus::lanes], v[Talus::lanes];
      for_each_sphere(table, begin, end, m, [&](int k, std::int64_t n) {
        d[k] = places[n];
        if (table.spheres[n].wrapped) away[k] = shift(table.spheres[n]);
      });
      const Vector its = three(d), at = s.axes.to_space(its) + (s.position - three(away));
      const Vector moves = motion.velocity_at(its);
      Talus::to_rows({at.x, at.y, at.z, Vec8{}}, x);
      Talus::to_rows({moves.x, moves.y, moves.z, Vec8{}}, v);
      for_each_sphere(table, begin, end, m, [&](int k, std::int64_t n) {
        const ClumpSphere &sphere = table.spheres[n];
        if (!sphere.owned) return;
        Talus::Record *state = &records.motion[2L * sphere.slot];
        const Talus::Vec4 v_old = load4(state[0]), w_old = load4(state[1]);
        put(records.position[sphere.slot], x[k]);
        put(state[0], v[k]);
        put(state[1], w[k]);
        if constexpr (changes)
          records.keep_change(sphere.slot, v_old, load4(state[0]), w_old, load4(state[1]));
      });
    }
  }

  // all but the fourth number
  static void put(Talus::Record &to, const Talus::Record &from)
  {
    store(to, __builtin_shufflevector(load4(from), load4(to), 0, 1, 2, 7));
  }
};

}    // namespace LAMMPS_NS

#endif
