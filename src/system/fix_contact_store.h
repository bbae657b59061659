// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Internal fix of pair style gran/penalty: what has to travel with a particle.
//
//   * its canonical key (see contact/canonical_key.h), to other ranks, to ghosts and into restart
//   files;
//   * the contact history whenever pairs are renumbered, and between runs: as it stands (see
//     contact/kept_contacts.h), with the slot that each particle had; in restart files and periodic
//     boxes filed by particle (see contact/partner_lists.h). And the tag under which other
//     particles' histories know this one, for IDs may be renumbered between runs;
//   * where fix balance shifts cutting planes, its position: the host goes to fractions of the box
//   and back
//     for that, which moves every particle by a rounding error. The positions are put back, so that
//     load balancing does not change the trajectory.
//
// The pair style creates it (through the placeholder that keeps its place in the list of fixes) and
// owns no copy of its data. The ID is the same in every process, because restart files find fixes
// by ID.

#ifndef LMP_FIX_CONTACT_STORE_H
#define LMP_FIX_CONTACT_STORE_H

#include "contact/contact_pipeline.h"
#include "fix.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace Talus {
class GranularSystem;
}

namespace LAMMPS_NS {

class FixContactStore : public Fix {
 public:
  /// Values of ghost `atom` with the partner `tag`, or nullptr.
  using GhostValues = std::function<const double *(int atom, std::int64_t tag)>;

  /// fix ID all CONTACT_STORE cell, where cell is the edge of the cells of the canonical order
  /// (length).
  FixContactStore(class LAMMPS *, int, char **);
  ~FixContactStore() override;

  /// Called by the system right after creation; it outlives this fix.
  void serve(Talus::GranularSystem *of) { system = of; }
  /// Impact speed and age of contacts are kept as well.
  void keep_impacts(bool yes) { partners.set_values(yes ? 8 : 4); }
  /// To be called by the system whenever it has computed forces: its pairs hold the latest
  /// history, and the lists need not.
  void pairs_are_current();
  /// The same when pairs have been numbered: the slots of owned particles.
  void pairs_are_numbered(const std::vector<int> &slot_of_atom);

  /// Keys of owned and ghost particles; there may be more elements than particles.
  const std::vector<std::uint64_t> &all_keys() const { return keys; }
  Talus::FiledHistories histories() const { return {partners, filed_tags, kept, kept_slots}; }

  int setmask() override;
  void init() override;
  void post_integrate() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void min_pre_exchange() override;
  void setup_pre_neighbor() override;
  void pre_neighbor() override;
  void post_neighbor() override;
  void min_post_neighbor() override;
  void setup_post_neighbor() override;
  void post_run() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_border(int, int *, double *) override;
  int unpack_border(int, int, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
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

 private:
  enum class Occasion { REBUILD, RESTART_FILE, END_OF_RUN };
  void store_histories(Occasion occasion);
  void file_kept();
  void find_maxexchange();
  bool in_periodic_box() const;
  void agree_on_shared_pairs();
  void refresh_key(int i);
  void take_over_sorting();
  void give_sorting_back();
  void sort_particles();
  void keep_positions();
  void put_positions_back();
  bigint next_refresh(bigint step) const;
  double *ghost_entry(int atom, int n);

  Talus::GranularSystem *system = nullptr;
  bool current = false;
  double inverse_cell;
  std::vector<std::uint64_t> keys;
  std::vector<std::int64_t> filed_tags;    // 0: in no list
  Talus::PartnerLists partners;
  std::vector<int> kept_slots;    // of owned particles in the pairs that are or were
  Talus::KeptContacts kept;

  int host_sorts_every = 0;    // atom->sortfreq, while this fix sorts instead

  bool guards_positions = false;    // a fix balance exists
  std::vector<double> positions;    // of owned particles as they were before fix balance

  // while lists go to ghosts, one entry of each list at a time
  int sent_entry = 0, most_entries = 0;
  std::vector<double> ghost_entries;
};

}    // namespace LAMMPS_NS

#endif
