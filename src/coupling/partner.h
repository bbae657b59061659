// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What all calls of the coupling interface (talus.h) share: who gives arguments and gets results,
// the agreement of all ranks on what is called, and errors that are the same on all of them.

#ifndef TALUS_COUPLING_PARTNER_H
#define TALUS_COUPLING_PARTNER_H

#include "coupling/talus.h"

#include "system/step/granular_system.h"

#include "pointers.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace Talus {

/// Why a call is refused, the same on all ranks.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PartnerFluid;

/// The ranks of a LAMMPS instance, with messages of their own: not those of LAMMPS. All partners of the instance
/// share them, so that ranks notice that they call different ones.
class OwnRanks {
 public:
  /// Collective where there is no partner yet.
  static std::shared_ptr<OwnRanks> of(LAMMPS_NS::LAMMPS *lmp, MPI_Comm of_instance);
  explicit OwnRanks(MPI_Comm of_instance) { MPI_Comm_dup(of_instance, &comm); }
  ~OwnRanks();
  OwnRanks(const OwnRanks &) = delete;
  OwnRanks &operator=(const OwnRanks &) = delete;
  MPI_Comm comm = MPI_COMM_NULL;
  std::string failed;    ///< "" or why all of them are gone
  /// Of the next partner, the same on all ranks: the one it would have, and for good.
  int coming_number() const { return last + 1; }
  int next_number();

 private:
  int last = 0;
  static int last_number;    ///< of all instances on this rank
};

}    // namespace Talus

/// A program that shares the simulation. Collective, but for error_text(); by one thread.
struct talus_partner : protected LAMMPS_NS::Pointers {
 public:
  /// `root`: rank on which it lives, or TALUS_ALL_RANKS. Throws Refusal.
  talus_partner(LAMMPS_NS::LAMMPS *lmp, int root);

  LAMMPS_NS::LAMMPS &instance() const { return *lmp; }
  /// The how manyth of the instance, from 1: what it puts on particles is its own.
  int number() const { return order; }

  /// Makes a call: all ranks agree that they make this one, then `work` is done. Returns its code.
  int collective(const char *name, const std::function<void()> &work) noexcept;
  /// In the place of any call. Returns TALUS_PARTNER_FAILED.
  int fail(const char *why) noexcept;
  /// The last call. Does what was left for it, unless the instance or its system is gone.
  int close() noexcept;
  /// Of the last call.
  const std::string &error_text() const { return text; }

  // ---- within a call, in the same order on all ranks

  /// Where it lives: a rank, or TALUS_ALL_RANKS.
  int home() const { return root; }
  /// Arguments of this rank count, and results are wanted.
  bool lives_here() const;
  /// What was given, on all ranks. Throws Refusal unless it is there, the same wherever the partner
  /// lives, and finite. `what`: its name, for messages.
  std::string text_of(const char *what, const char *given);
  std::int64_t integer_of(const char *what, std::int64_t given);
  double number_of(const char *what, double given);
  std::vector<double> numbers_of(const char *what, const double *given, std::int64_t count);
  std::vector<std::int64_t> integers_of(const char *what, const std::int64_t *given,
                                        std::int64_t count);
  /// Of pointers that may be NULL: whether it is given.
  bool has(const char *what, const void *given);
  /// The same where each rank has a part of its own: some rank has given it.
  bool is_given(bool here) const;
  /// Throws Refusal on all ranks if some rank has a text; that of the lowest one.
  void refuse_if(const std::string &problem);
  /// Writes results where they are wanted and there is room.
  template <class Number> void give(Number *to, const std::vector<Number> &values) const
  {
    if (lives_here() && to) std::copy(values.begin(), values.end(), to);
  }

  /// Numbers of which one rank has a part and the others 0: the sums, where results are wanted.
  void sum(std::vector<double> &numbers) const;
  /// What all ranks have, one after another, where results are wanted.
  std::vector<std::int64_t> gather(const std::vector<std::int64_t> &mine) const;

  /// A command of LAMMPS.
  void command(const std::string &line);
  /// The set-up of a run, if one is due: at first, after needs_set_up, or if what is to be set up has changed
  /// since the last run.
  void set_up_if_needed();
  /// The same where only what others may point to counts: deleted, or defined anew.
  void set_up_if_lost();
  /// The next advance begins with the set-up of a run.
  bool needs_set_up = true;
  /// Cells and laws of a fluid that it computes; nullptr: none.
  std::shared_ptr<Talus::PartnerFluid> fluid;
  /// To be done when the partner is closed, once for each name: what it has asked the system to do for it
  /// ends.
  void at_close(const std::string &name, const std::function<void(Talus::GranularSystem &)> &work)
  {
    last[name] = work;
  }
  /// See GranularSystem: that of the instance while the call lasts, for `clear` makes another one.
  Talus::GranularSystem &system() { return *granular; }
  MPI_Comm world() const { return ranks->comm; }

 private:
  void set_up();
  bool agree(const char *name);
  int code_of(const char *name, const std::function<void()> &work);
  int stop_all(const char *name, const std::exception &problem);
  void check(const char *what, const std::string &problem, std::uint64_t digest);
  /// Of this partner, or of all.
  const std::string &why_failed() const { return failed.empty() ? ranks->failed : failed; }
  void set_failed(int rank, bool all_partners);

  const std::shared_ptr<Talus::OwnRanks> ranks;
  const int order;
  const int root;
  int me, num_ranks;
  std::shared_ptr<Talus::GranularSystem> granular;
  std::weak_ptr<Talus::GranularSystem> of_last_call;
  std::map<std::string, std::function<void(Talus::GranularSystem &)>> last;
  std::string text;
  std::string failed;    // "" or why the partner is gone
};

#endif
