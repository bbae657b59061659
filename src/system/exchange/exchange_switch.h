// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which exchange of proxies is in force: that of LAMMPS, or the direct one (class CommProxy), which
// takes the place of LAMMPS' communication object. Unless the user has decided with comm_proxy,
// the direct one is switched on at the start of a run that can use it.
//
// All methods are collective; every rank decides the same.

#ifndef TALUS_SYSTEM_EXCHANGE_EXCHANGE_SWITCH_H
#define TALUS_SYSTEM_EXCHANGE_EXCHANGE_SWITCH_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {
class Comm;
}

namespace Talus {

class DirectExchange;

class ExchangeSwitch : protected LAMMPS_NS::Pointers {
 public:
  enum class Choice { AUTOMATIC, YES, NO };
  using MakeDirect = LAMMPS_NS::Comm *(*) (LAMMPS_NS::LAMMPS *, LAMMPS_NS::Comm *old);

  explicit ExchangeSwitch(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}
  /// Once, when the plugin is loaded: what makes a CommProxy with the settings of `old`.
  static void set_maker(MakeDirect maker);

  /// What the user has said with comm_proxy. YES and NO take effect at once; YES is an error where
  /// the direct exchange is not supported.
  void choose(Choice choice);
  Choice choice() const { return chosen; }

  /// Of a run that can use it, before Comm::init(): switches the direct exchange on unless the user
  /// or LAMMPS is against it. It falls back later if something else is found. In any case the communication
  /// object of the run is one of Talus, which tells when it is deleted.
  void start_run();

  /// From the constructor and the destructor of communication objects of Talus, with the direct exchange or
  /// nullptr: in every step it is asked several times whether one is there.
  void is_made(const LAMMPS_NS::Comm *comm, DirectExchange *proxies);
  void is_deleted(const LAMMPS_NS::Comm *comm);
  /// Of the present communication object: the how manyth of those of Talus; -1, -2: one of LAMMPS, brick or tiled.
  int number_of_object() const;
  /// The direct exchange if it is in force, else nullptr.
  DirectExchange *direct() const;
  /// The same, also where it falls back.
  DirectExchange *present() const { return comm == made ? proxies_of_made : nullptr; }
  /// With direct() == nullptr: why, and the cure, as text for messages.
  std::string reason_for_stock() const;
  /// "" or what of the present settings the direct exchange does not support, and the cure.
  /// `in_run`: after Domain::init(); else only what can be known before.
  std::string unsupported(bool in_run) const;
  /// "" if nothing but contacts looks at proxies in this run, else what does, as text for messages.
  /// After Neighbor::init().
  std::string needs_beyond_contacts() const;

 private:
  void replace_comm(LAMMPS_NS::Comm *with);
  void use_stock();
  void settle_brick();

  Choice chosen = Choice::AUTOMATIC;
  int num_made = 0;
  const LAMMPS_NS::Comm *made = nullptr;
  DirectExchange *proxies_of_made = nullptr;
};

}    // namespace Talus

#endif
