// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Internal fix: what has to travel with a particle.
//
//   * the histories of its contacts whenever pairs are renumbered, and between runs (see
//     history/contact_memory.h, which the system owns); in restart files by the names of particles and
//     bodies;
//   * with a pair style of Talus its canonical key (see particles/canonical_key.h), to other ranks, to
//     ghosts and into restart files;
//   * with an integrator of second order the changes of its velocities, see
//     ParticleRecords::change, to other ranks, to ghosts and into restart files;
//   * where fix balance shifts cutting planes, its position: LAMMPS goes to fractions of the box
//     and back for that, which moves every particle by a rounding error. The positions are put
//     back, so that load balancing does not change the trajectory.
//
// GranularSystem makes it: for the pair style (in the place that its placeholder keeps in the list of
// fixes), or for the first body or shape. The ID is the same in every process, because restart files
// find fixes by ID.

#ifndef LMP_FIX_CONTACT_STORE_H
#define LMP_FIX_CONTACT_STORE_H

#include "base/state_exchange.h"
#include "exchange/sparse_exchange.h"
#include "fix.h"
#include "history/contact_memory.h"
#include "particles/change_record.h"
#include "system/monitor/run_monitor.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Talus {
class GranularSystem;
class ShapedParticles;
}    // namespace Talus

namespace LAMMPS_NS {

class FixContactStore : public Fix {
 public:
  /// fix ID all CONTACT_STORE
  FixContactStore(class LAMMPS *, int, char **);
  ~FixContactStore() override;

  /// Edge of the cells of the canonical order (length), unless it is known: of an earlier run, or of a restart
  /// file.
  void use_cells(double edge);
  /// The pair style is going: the next one begins anew, but for what a restart file has brought.
  void forget_pairs();
  /// A restart file had contacts between spheres, as this fix writes them.
  bool has_read_pairs() const { return pairs_were_read; }
  /// Records that the laws of an integrator of this order need of each contact, see HistoryRows.
  void keep_histories(int records, int integration_order);
  /// To be called by the system whenever it has computed forces: its pairs hold the latest
  /// history, and the store need not.
  void pairs_are_current();
  /// The same when pairs have been numbered.
  void pairs_are_numbered(const Talus::ParticleOrder &order);

  /// Keys of owned and ghost particles; there may be more elements than particles.
  const std::vector<std::uint64_t> &all_keys() const { return keys; }
  /// Of the integrator, by whose laws they are; 0: there are none, or it is not known. Kept in restart
  /// files.
  int order_of_histories() const { return order; }
  void set_order_of_histories(int of) { order = of; }
  /// Changes of velocities, of owned particles and ghosts; nullptr if none are kept.
  Talus::ChangeRecord *all_changes() { return with_changes ? changes.data() : nullptr; }

  void keep_changes(bool yes);
  /// Where changes are kept: velocities as the present forces see them, of particles that others
  /// move than those who keep changes; and before the next forces, what follows from them. `mine`:
  /// bits of the groups of particles that are of no concern, nor are those that shapes know of.
  void store_velocities(int mine);
  void follow_velocities(int mine, const Talus::ShapedParticles *shapes);

  /// For snapshots: what owned particles carry along but histories; and these, between two runs.
  void exchange_particles(Talus::StateExchange &x);
  void exchange_histories(Talus::StateExchange &x);

  /// For RunMonitor: a position, velocity or angular velocity of this rank that is not a number.
  /// The error, collective.
  RunMonitor::Finding find_no_number() const;
  void report_no_number(const RunMonitor::Finding &found) const;

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void min_pre_exchange() override { pre_exchange(); }
  void setup_pre_neighbor() override { put_positions_back(); }
  void pre_neighbor() override { put_positions_back(); }
  void post_neighbor() override;
  void min_post_neighbor() override { post_neighbor(); }
  void setup_post_neighbor() override { post_neighbor(); }
  /// The last of the set-up, before its output, and outputs: positions and velocities have to be
  /// numbers.
  void setup(int) override { require_numbers(); }
  void end_of_step() override;
  void post_run() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_border(int, int *, double *) override;
  int unpack_border(int, int, double *) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

  /// Steps between two refreshes of the keys, at multiples of it: a property of the trajectory.
  static constexpr int refresh_interval = 1000;

  /// Doubles of a message: of each ghost, and those of the changes.
  static constexpr int size_border = 1 + Talus::HistoryStore::size_origin + 1,
                       size_change = Talus::ChangeRecord::doubles, size_last = 6;

 private:
  enum class Occasion { REBUILD, RESTART_FILE, END_OF_RUN };
  /// There are pairs of a pair style of Talus.
  bool has_pairs() const;
  void store_histories(Occasion occasion);
  std::string name() const;
  std::string unassignable(const char *how) const;
  void init_for_pairs();
  void init_without_pairs();
  void require_numbers() const;
  void agree_with_other_ranks();
  void set_maxexchange(int largest_list);
  bool in_periodic_box() const;
  void restore_changes(const std::vector<Talus::ChangeRecord> &saved);
  void refresh_key(int i);
  void store_velocity(int i);
  void take_over_sorting();
  void give_sorting_back();
  void sort_particles();
  void keep_positions();
  void put_positions_back();
  bigint next_refresh(bigint step) const;

  std::shared_ptr<Talus::GranularSystem> system;
  Talus::ContactMemory &memory_of_contacts;
  Talus::HistoryStore &store;    // of pairs, and with the lists of all
  bool current = false;
  int order = 0;
  int largest_read = 0;    // lists of a restart file on this rank, doubles
  bool pairs_were_read = false, was_used = false;
  double inverse_cell = 0.0;
  std::vector<std::uint64_t> keys;
  bool with_changes = false, with_last = false;    // on all ranks alike, also without particles
  std::vector<Talus::ChangeRecord> changes;
  using Velocities = std::array<double, size_last>;
  std::vector<Velocities> last;    // of particles that others move, by the last forces
  std::vector<double> scratch;     // a list whose size is asked for
  Talus::SparseExchange exchange;

  int lammps_sorts_every = 0;    // atom->sortfreq, while this fix sorts instead

  bool guards_positions = false;    // a fix balance exists
  std::vector<double> positions;    // of owned particles as they were before fix balance
};

}    // namespace LAMMPS_NS

#endif
