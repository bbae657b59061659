// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What GranularSystem knows of the fixes of Talus. It finds them in the list of LAMMPS, so that
// the order in which they act is that of the script.

#ifndef TALUS_SYSTEM_HOST_SYSTEM_FIX_H
#define TALUS_SYSTEM_HOST_SYSTEM_FIX_H

#include "laws/contact_energy.h"

#include <functional>
#include <string>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class StateExchange;

/// For how long forces act on particles in a step, over the time step: those of the step before until
/// positions move, and those of the step at its end.
struct Kicks {
  double before, after;
};

/// A fix that does its work on particles in the records as well as in the arrays of LAMMPS.
class SystemFix {
 public:
  /// nullptr of fixes of LAMMPS.
  static SystemFix *of(LAMMPS_NS::Fix *fix);
  static const SystemFix *of(const LAMMPS_NS::Fix *fix)
  {
    return of(const_cast<LAMMPS_NS::Fix *>(fix));
  }

  /// At the start of a run, collective: "", or why it needs the arrays of LAMMPS in this run.
  virtual std::string needs_arrays() = 0;

  /// "" if it is accelerated in this run, else why the methods of the stock class are used, and the
  /// cure, as text for messages. Valid after init(); the same on all ranks.
  virtual std::string reason_for_stock() const { return ""; }

  /// It adds forces to particles in its own post_force(), also in the records. Bodies that are
  /// defined after it in the script do not join then, see LargeBody::join_step().
  virtual bool adds_forces() const { return false; }

  /// Particles touch it, a large body or a wall: it has a number, in the order of the script.
  virtual bool is_touched() const { return false; }
  /// Of such a fix: visit(contact) for those of the last step on this rank, as they were when its forces
  /// were computed; without the number. Where Step::may_be_asked() in that step, else none.
  using VisitContact = std::function<void(const ContactReport &)>;
  virtual void for_each_contact(const VisitContact & /*visit*/) const {}

  /// Integrates the motion of particles.
  virtual bool integrates() const { return false; }
  /// An integrator that moves the particles of its group in the records itself, before it calls
  /// Step::advance(), which then moves none of them.
  virtual bool places_particles() const { return false; }
  /// Of an integrator: whether it moves this particle of its group (local index).
  virtual bool moves_particle(int /*i*/) const { return true; }
  /// Of an integrator: its particles have, or will have after Step::complete_move(), the velocities that move them in this
  /// step. It turns what orientations they have. Called by Step::advance().
  virtual void turn_particles() const {}
  /// Called when particles go back to the arrays of LAMMPS, before anything else reads or migrates
  /// them: what the fix itself keeps of them has to go back as well.
  virtual void leave_records() {}
  /// Of an integrator: its order in the time step, 1 or 2, as its command says.
  virtual int order() const { return 1; }
  /// Of an integrator: the acceleration that it gives to particles besides that of forces; nullptr:
  /// none. Not to those of a fix freeze.
  virtual const double *gravity_besides_forces() const { return nullptr; }
  /// It keeps the changes of velocities of particles that it moves in the arrays of LAMMPS, see
  /// ParticleState::change(). In the records they are kept for all.
  virtual bool keeps_changes() const { return false; }
  /// Of order 2: the time by which velocities are behind positions.
  virtual double lag() const { return 0.0; }
  /// Time of the kick that the next forces give, over the time step; between two steps.
  virtual double next_kick_in_steps() const { return 1.0; }
  /// In a step after initial_integrate(): its kicks.
  virtual Kicks kicks() const { return {1.0, 0.0}; }

  /// Its part of a step that others can see only in the arrays of LAMMPS, with the forces of
  /// contacts, bodies and weights. Called by Step::complete_step_of() in a step that LAMMPS
  /// looks at; and when particles come back from a step in the records, those that integrate last.
  virtual void complete_step() {}

  // ---- snapshots (snapshot.h), between two runs

  /// What it knows of the past, besides what travels with particles and what is in restart files; with
  /// exchanges_all() that as well. When a state is restored particles are in the arrays of LAMMPS before; it may be
  /// called twice, before ghosts and neighbor lists are there, and after it.
  virtual void exchange_state(StateExchange & /*x*/) {}
  virtual bool exchanges_all() const { return false; }
  /// Everything is restored: particles of which it has lists are to be listed again.
  virtual void state_is_restored() {}

 protected:
  ~SystemFix() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
