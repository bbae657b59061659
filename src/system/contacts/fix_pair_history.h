// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact histories of an accelerated pair style in restart files as the stock style has them, so
// that either continues a file of the other. The stock style keeps its histories in a fix
// NEIGH_HISTORY, which restart files name by style and ID; this fix has the same of both. It holds
// nothing: it writes what the HistoryStore has, and hands to it what it reads, unless there is more
// in the file (see FixContactStore).
//
// Of each particle: number of doubles, of contacts, and for each contact the tag of the partner (as
// the bits of a double) and its values as the particle sees them.
//
// The history of rolling and twisting is the same for both particles. The stock style writes
// it with a minus for the one that does not own the pair in its neighbor list, and reads it at the
// owner alone: so the plain value, written for both, is what it continues with, whichever particle
// owns the pair then. Of a file of its own the value of the particle that comes first in memory is
// taken, for it owns most pairs of a rank; of a pair across ranks each has the value of its own
// particle.

#ifndef LMP_FIX_PAIR_HISTORY_H
#define LMP_FIX_PAIR_HISTORY_H

#include "base/history_values.h"
#include "fix.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace Talus {
class GranularSystem;
}

namespace LAMMPS_NS {

class FixPairHistory : public Fix {
 public:
  /// fix ID all TALUS_PAIR_HISTORY place ...
  ///
  /// ID: of the stock fix. One word for each value of the stock style: its place with us, see
  /// HistoryLayout, or - of a value that is not used: 0 then. To be created when the system has its
  /// store.
  FixPairHistory(class LAMMPS *, int, char **);
  ~FixPairHistory() override;

  /// From here on its style is NEIGH_HISTORY.
  void post_constructor() override;
  int setmask() override { return 0; }
  void init() override { read_before.clear(); }

  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

 private:
  int stock_entry() const { return 1 + static_cast<int>(place_of_value.size()); }
  void take_even_values_of(int partner, tagint tag, Talus::HistoryValues &values);

  std::shared_ptr<Talus::GranularSystem> system;
  std::vector<int> place_of_value;                // of the stock style; -1: not used
  std::unordered_map<tagint, int> read_before;    // particles of a restart file
};

}    // namespace LAMMPS_NS

#endif
