// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces, torques, drag and heat that another program puts on particles, by ID (talus.h). They act in
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
//   external_loads.cpp         the fix, what is put, what travels with particles
//   external_loads_step.cpp    what moves particles, and a step
//
// Per-atom data is here and not in the fix that LAMMPS calls (fix_external_loads.h), which may be made
// anew: it has to be the last one that acts on forces. Without loads there is none, and a step costs
// one call.

#ifndef TALUS_SYSTEM_EXTERNAL_LOADS_H
#define TALUS_SYSTEM_EXTERNAL_LOADS_H

#include "particles/particle_state.h"
#include "system/particles_by_id.h"

#include "pointers.h"

#include <cstdint>
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

  /// Each replaces all that was put of its kind. Numbers for each particle of the list: force and
  /// torque, 3 each, or nullptr; coefficient of drag (force/velocity), velocity of the fluid (3
  /// each); heat flow (energy/time).
  void put_forces(const ParticlesById &particles, const double *force, const double *torque);
  void put_drag(const ParticlesById &particles, const double *coefficient,
                const double *fluid_velocity);
  void put_heat(const ParticlesById &particles, const double *flow);
  /// Of this rank: "", or why drag is too large where it is taken at the present velocity.
  std::string problem_of_drag(const ParticlesById &particles, const double *coefficient);
  /// None of any kind from now on.
  void clear();

  /// Impulses of drag (force time), two counts. Those of particles, for which they begin anew: 3
  /// each, of those that this rank owns.
  void take_impulses(const ParticlesById &particles, double *impulse);
  /// And those for fields; nullptr: none.
  double *impulse_for_fields(int i);

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
  static constexpr int size_packed = 24;
  int pack(int i, double *to) const;
  int unpack(int i, const double *from);
  double memory_usage() const;
  /// The fix is going.
  void drop_fix();
  void take_fix(LAMMPS_NS::Fix *one) { fix = one; }
  /// LAMMPS has made its lists of the fixes that act, for whatever command: digest_of_fixes() then.
  void lists_are_of(std::uint64_t fixes) { listed_fixes = fixes; }
  std::uint64_t fixes_of_lists() const { return listed_fixes; }

 private:
  // of one particle, bits: ADDED: force, torque and drag are in the sums that are there between
  // steps; DUE: drag begins the next step
  static constexpr unsigned FORCE = 1, TORQUE = 2, DRAG = 4, HEAT = 8, ADDED = 16, DUE = 32;
  /// What each step reads, and writes in the last two.
  struct Load {
    double force[3], coefficient, fluid_velocity[3], drag[3], impulse[3];
  };
  /// What few steps need. Impulses are those up to now, without the one of the load.
  struct Rest {
    double torque[3], heat, for_particles[3], for_fields[3];
  };
  static_assert(sizeof(Load) + sizeof(Rest) == sizeof(double) * (size_packed - 1));

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
  template <class Put> void replace(unsigned kinds, const ParticlesById &particles, Put put);
  void settle_impulse(int i);

  void find_kicks(Moment moment);
  Kick kick_of(LAMMPS_NS::Fix &integrator, Moment moment) const;
  const Kick *kick_of(int i) const;
  void take_back();
  void act_on(int i, const ParticleState &particles, Moment moment);
  void add(int i, const ParticleState &particles, const Kick *kick, Moment moment);
  void find_drag(int i, const double *v, const double *force, const Kick *kick);

  GranularSystem &system;
  LAMMPS_NS::Fix *fix = nullptr;
  std::uint64_t listed_fixes = 0;
  // by local index; empty: there are none
  std::vector<unsigned char> what;
  std::vector<Load> loads;
  std::vector<Rest> rest;
  std::vector<Kick> kicks;    // in the order of the script
  int frozen_bits = 0;
};

}    // namespace Talus

#endif
