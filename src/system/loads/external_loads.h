// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces, torques, drag, drag of rotation and heat that another program puts on particles, by ID (talus.h). They act in
// each step, in the records and in the arrays of LAMMPS, after all other forces: drag is found from
// the sum of these. They travel with the particles, and are gone with those that are deleted.
//
// Drag c (u - v) is taken at the velocity v at which the coming kick of k (time) arrives:
//
//   F_d = c (u - v*)/(1 + k c/m)      v* = v + k (F/m + g), what that would be without drag
//
// so that v = (v* + k c/m u)/(1 + k c/m) after it. k is the time step, but where it is half of one: the
// first of `start half`, and with velocity Verlet that after a set-up or after drag was put. With
// velocity Verlet the half kick that ends a step and the one that begins the next have the same forces
// and count as one. Of spheres of clumps drag is taken at the present velocity. Particles that nothing
// moves, and frozen ones, bear drag at the velocity they have.
//
// Drag of rotation c_T (O - w), w the angular velocity, is taken in the same way: c_T/(1 + k c_T/I), I = 2/5 m r^2. Spheres of
// clumps, frozen particles and those that nothing moves have none; its impulse is not counted.
//
// Several partners of an instance each put their own: forces, torques and heat add up, and drag of several is
// that of c = sum c_k and u = sum c_k u_k / c, of which each has c_k (u_k - v), with the same v; that of rotation too. As
// long as only one has put some there are no parts.
//
//   external_loads.cpp          the fix, what is put, what travels with particles
//   external_loads_parts.cpp    what each of several partners has put
//   external_loads_step.cpp     what moves particles, and a step
//
// Per-atom data is here and not in the fix that LAMMPS calls (fix_external_loads.h), which may be made
// anew: it has to be the last one that acts on forces. Without loads there is none, and a step costs
// one call.

#ifndef TALUS_SYSTEM_LOADS_EXTERNAL_LOADS_H
#define TALUS_SYSTEM_LOADS_EXTERNAL_LOADS_H

#include "base/state_exchange.h"
#include "particles/particle_state.h"
#include "system/host/particles_by_id.h"

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;
class SystemFix;

class ExternalLoads : protected LAMMPS_NS::Pointers {
 public:
  ExternalLoads(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  // ---- by the coupling, between runs, on all ranks

  /// "" or why particles here cannot bear any, for messages.
  std::string reason_against() const;
  /// Makes the internal fix, if there is a box: before the first load, or the last set-up before it.
  /// Returns whether the next run has to begin with a set-up.
  bool make_fix();

  /// Each replaces all that this partner (its number) has put of its kind. Numbers for each particle of the list: force and
  /// torque, 3 each, or nullptr; coefficient of drag (force/velocity), velocity of the fluid (3
  /// each); heat flow (energy/time).
  void put_forces(int partner, const ParticlesById &particles, const double *force,
                  const double *torque);
  void put_drag(int partner, const ParticlesById &particles, const double *coefficient,
                const double *fluid_velocity);
  /// Coefficient (torque time) and angular velocity of the fluid (3 each).
  void put_rotational_drag(int partner, const ParticlesById &particles, const double *coefficient,
                           const double *fluid_omega);
  void put_heat(int partner, const ParticlesById &particles, const double *flow);
  /// Of this rank: "", or why drag is too large where it is taken at the present velocity.
  std::string problem_of_drag(const ParticlesById &particles, const double *coefficient);
  /// The partner is going: none of it of any kind from now on.
  void clear(int partner);

  /// Impulses of the drag that this partner has put (force time), two counts. Those of particles, for which they
  /// begin anew: 3 each, of those that this rank owns.
  void take_impulses(int partner, const ParticlesById &particles, double *impulse);
  /// And those for fields; nullptr: none.
  double *impulse_for_fields(int partner, int i);

  // ---- by the fix

  enum class Moment { SET_UP, STEP, BETWEEN_STEPS };
  /// Some particle has one. Collective.
  bool any() const;
  /// A set-up begins: it makes other sums of forces than those that are there.
  void sums_begin_anew();
  /// Adds them to the forces.
  void act(Moment moment);
  /// At the start of a run, collective: "", or why they need the arrays of LAMMPS.
  std::string needs_arrays() const;

  void grow(int most);
  void copy(int from, int to);
  void forget(int i);
  /// Most numbers of a particle.
  int most_packed() const;
  int pack(int i, double *to) const;
  int unpack(int i, const double *from);
  double memory_usage() const;
  /// For snapshots: who has put something; before what travels with particles. And when all is restored: what
  /// partners that are gone had put is dropped.
  void exchange_state(StateExchange &x);
  void state_is_restored();
  /// The fix is going.
  void drop_fix();
  void take_fix(LAMMPS_NS::Fix *one) { fix = one; }

 private:
  // of one particle, bits: ADDED: force, torque and drag are in the sums that are there between
  // steps; DUE: drag begins the next step
  static constexpr unsigned FORCE = 1, TORQUE = 2, DRAG = 4, HEAT = 8, ADDED = 16, DUE = 32,
                            SPIN = 64;    // drag of rotation
  static constexpr unsigned IN_SUMS = FORCE | TORQUE | DRAG | SPIN, KINDS = IN_SUMS | HEAT;
  /// What each step reads, and writes in the last two.
  struct Load {
    double force[3], coefficient, fluid_velocity[3], drag[3], impulse[3];
  };
  /// What few steps need. Impulses are those up to now, without the one of the load.
  struct Rest {
    double torque[3], heat, for_particles[3], for_fields[3];
    double spin_coefficient, fluid_omega[3], spin_drag[3];
  };
  static constexpr int size_packed = 31;
  static_assert(sizeof(Load) + sizeof(Rest) == sizeof(double) * (size_packed - 1));

  /// What one of several partners has put on a particle, and impulses of its drag.
  struct Part {
    double kinds;    ///< of the bits KINDS
    double force[3], torque[3], coefficient, fluid_velocity[3], spin_coefficient, fluid_omega[3],
        heat, for_particles[3], for_fields[3];
  };
  static constexpr int size_part = sizeof(Part) / sizeof(double);
  static bool has(const Part &part, unsigned some)
  {
    return (static_cast<unsigned>(part.kinds) & some) != 0;
  }
  /// By local index, of the partner with the same place in `partners`.
  using Layer = std::vector<Part>;
  /// Where a partner's numbers of a particle are kept.
  struct Place {
    double *force, *torque, *coefficient, *fluid_velocity, *spin_coefficient, *fluid_omega, *heat;
  };

  /// How the forces of now move the particles of one integrator.
  struct Kick {
    int group_bits;
    const SystemFix *talus_fix;    ///< nullptr: of LAMMPS,
    const int *body;               ///< and the bodies of particles if it moves some, or nullptr
    double time;                   ///< for which drag is taken at the new velocity
    double at_start, at_end;       ///< of this step: by the forces before, and by these
    const double *gravity;
    bool rigid;       ///< of clumps
    bool has_read;    ///< what begins the next step has been taken from the forces already
  };

  bool has(int i, unsigned some) const { return (what[i] & some) != 0; }
  void set(int i, unsigned some) { what[i] = static_cast<unsigned char>(what[i] | some); }
  void unset(int i, unsigned some) { what[i] = static_cast<unsigned char>(what[i] & ~some); }
  bool any_has(unsigned some) const;
  bool is_idle(int i) const;
  void make_room();
  void resize(std::size_t size);
  void release_if_idle();
  template <class Put>
  void replace(int partner, unsigned kinds, const ParticlesById &particles, Put put);

  // parts
  int place_of(int partner) const;
  int take_place(int partner);
  void divide();
  void unite();
  void add_up(int i);
  Place place(int layer, int i);
  void set_kinds(int layer, int i, unsigned some);
  void unset_kinds(int layer, unsigned some);
  /// Impulses of the drag of one, two counts.
  struct Counts {
    double *for_particles, *for_fields;
  };
  Counts counts_of(int layer, int i);
  void drop_place(int layer);
  static bool is_idle(const Part &part);
  void count_drag(int i, double time);
  void set_maxexchange();
  void settle_impulse(int i);

  void find_kicks(Moment moment);
  Kick kick_of(LAMMPS_NS::Fix &integrator, Moment moment) const;
  const Kick *kick_of(int i) const;
  void take_back();
  void act_on(int i, const ParticleState &particles, Moment moment);
  void add(int i, const ParticleState &particles, const Kick *kick, Moment moment);
  void find_drag(int i, const double *v, const double *force, const Kick *kick);
  void find_spin_drag(int i, const double *omega, const double *torque, const Kick &kick);

  GranularSystem &system;
  LAMMPS_NS::Fix *fix = nullptr;
  // by local index; empty: there are none
  std::vector<unsigned char> what;
  std::vector<Load> loads;
  std::vector<Rest> rest;
  std::vector<int> partners;    // who has put something, by number, in the order of their first
  std::vector<Layer> layers;    // of two or more, else none
  std::vector<int> gone;        // partners that were closed
  std::vector<Kick> kicks;      // in the order of the script
  int frozen_bits = 0;
};

}    // namespace Talus

#endif
