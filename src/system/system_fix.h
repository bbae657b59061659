// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What GranularSystem knows of the fixes of Talus. It finds them in the list of the host, so that
// the order in which they act is that of the script.

#ifndef TALUS_SYSTEM_SYSTEM_FIX_H
#define TALUS_SYSTEM_SYSTEM_FIX_H

#include "laws/contact_energy.h"
#include "laws/contact_law.h"

#include <string>

namespace Talus {

/// A fix that does its work on particles in the records as well as in the arrays of LAMMPS.
class SystemFix {
 public:
  /// At the start of a run, collective: "", or why it needs the arrays of LAMMPS in this run.
  virtual std::string needs_host_arrays() = 0;

  /// "" if it is accelerated in this run, else why the methods of the stock class are used, and the
  /// cure, for people. Valid after init(); the same on all ranks.
  virtual std::string reason_for_stock() const { return ""; }

  /// It moves particles.
  virtual bool integrates() const { return false; }

 protected:
  ~SystemFix() = default;    // never deleted through this interface
};

/// A large body: exerts forces on particles. Forces on particles in the records are added by the
/// threads that compute the contacts between particles, each to the particles that it has just
/// dealt with, so that no thread waits for another one in between.
class SystemBody : public SystemFix {
 public:
  /// At the beginning of a step in the records: whether the forces of this step will be added by
  /// add_to_slots(). If not, nor are those of the fixes behind it: forces on a particle are summed
  /// in the order of the fixes.
  virtual bool join_step() = 0;

  /// Adds the forces on the particles of slots begin ... end-1. Called once by each thread, at the
  /// same time, for ranges that together hold all owned particles.
  virtual void add_to_slots(int thread, int begin, int end) = 0;

  /// From the next step on energies are accounted for; what the last step found on this rank.
  virtual void keep_account() = 0;
  virtual const EnergyAccount &energy_account() const = 0;
  virtual double contacts_here() const = 0;
  virtual double largest_overlap_ratio() const = 0;

  /// sqrt(m/k) (time) of a particle of this type, mass and radius against the body, with the
  /// stiffness at an overlap of 1 % of the radius; 0 without stiffness.
  virtual double contact_period(int type, double mass, double radius) = 0;
  /// Law and coefficients of contacts of particles of this type with the body.
  virtual ContactLaw law_of(int type) const = 0;
  virtual ContactCoefficients coefficients_of(int type) = 0;

  /// Bits of the group of particles that it touches; its name in messages.
  virtual int group_bits() const = 0;
  virtual std::string name() const = 0;

 protected:
  ~SystemBody() = default;
};

}    // namespace Talus

#endif
