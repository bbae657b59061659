// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A wall of LAMMPS (fix wall/gran, fix wall/gran/region) as a body: candidates, contacts with what they
// remember, masses, work and outputs. The fix that it belongs to has words, law and restart data of the
// stock class and knows where the surface is; it calls
//
//   in init()                    begin_run(), or leave_run() for a run of the methods of the stock class
//   with new neighbor lists      forget_list()
//   forces                       begin_step(), then list_if_needed() and compute()
//
// Units are those of the script.

#ifndef TALUS_SYSTEM_BODIES_HOST_WALL_H
#define TALUS_SYSTEM_BODIES_HOST_WALL_H

#include "base/history_values.h"
#include "body/contact/body_contacts.h"
#include "material/law_table.h"

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;
class StateExchange;

class HostWall : protected LAMMPS_NS::Pointers {
 public:
  /// What the stock class keeps of contacts in its arrays, by owned particle: where they are in restart files
  /// and in runs of its methods.
  class Arrays {
   public:
    /// Number of contacts; of contact k the part that is touched, and its history.
    virtual int count(int particle) const = 0;
    virtual int read(int particle, int k, HistoryValues &values) const = 0;
    virtual void clear(int particle) = 0;
    virtual void add(int particle, int part, const HistoryValues &values) = 0;

   protected:
    ~Arrays() = default;
  };

  /// `fix`: whose group is that of the particles that touch it. Both must live longer than this.
  HostWall(const LAMMPS_NS::Fix *fix, Arrays &arrays, GranularSystem &system,
           LAMMPS_NS::LAMMPS *lmp);

  /// A run with these laws, of types (t, t), and this surface, which must live as long as the run. `bounded`: a
  /// particle cannot touch it before both together have gone as far as the skin. `history`: the stock class keeps some;
  /// what its arrays have out of a restart file, or of a run of its methods, is in the memory from here on.
  void begin_run(const LawTable &laws, const LargeBodyShape &surface, bool bounded, bool history);
  /// What is in the memory goes to the arrays.
  void leave_run();
  /// Contacts of a particle go to the arrays, for as long as a restart file is written, and are cleared there again.
  void fill_row(int particle);
  void clear_row(int particle);

  void forget_list() { is_listed = false; }
  /// Contacts for outputs are those of the step that follows, if it has any. `listed`: the fix itself asks for them.
  void begin_step(bool listed);
  /// `displacement`: how far a point of the surface has gone at most since particles were listed. Returns
  /// whether they have been listed anew.
  bool list_if_needed(double displacement);
  /// See BodyContacts, of those that are listed.
  Eigen::AlignedBox3d bounds_of_search() const;
  /// Adds the forces of a step to the particles.
  void compute(const BodyHeat &heat);

  /// See SystemFix::for_each_contact().
  void for_each_contact(const ComputedContacts::VisitContact &visit) const
  {
    for_outputs.for_each(visit);
  }
  /// For snapshots.
  void exchange_state(StateExchange &x);
  double memory_usage() const { return contacts.memory_usage() + for_outputs.memory_usage(); }

 private:
  void take_arrays();
  bool is_stale(double moved, double displacement) const;
  void list(double moved);
  void find_masses();

  const LAMMPS_NS::Fix *fix;
  Arrays &arrays;
  GranularSystem &system;
  const BodyFrame at_rest{};
  BodyContacts contacts;
  ComputedContacts for_outputs;
  const LargeBodyShape *surface = nullptr;    // of this run
  bool bounded = false;
  bool is_listed = false;
  int owned_then = 0;            // when particles were listed
  double moved_then = 0.0;       // by them, since the neighbor lists were new
  std::vector<double> masses;    // by particle, or empty
};

}    // namespace Talus

#endif
