// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact histories of an accelerated pair style in restart files as the stock style has them, so
// that either continues a file of the other. The stock style keeps its histories in a fix
// NEIGH_HISTORY, which restart files name by style and ID; this fix has the same of both. It holds
// nothing: it writes what the HistoryStore has, and hands to it what it reads, unless there is more
// in the file (see FixContactStore).
//
// Of each particle: number of doubles, of contacts, and for each contact the tag of the partner (as
// the bits of a double) and the displacement as the particle sees it (length).

#ifndef LMP_FIX_PAIR_HISTORY_H
#define LMP_FIX_PAIR_HISTORY_H

#include "fix.h"

#include <memory>
#include <vector>

namespace Talus {
class GranularSystem;
}

namespace LAMMPS_NS {

class FixPairHistory : public Fix {
 public:
  /// fix NEIGH_HISTORY_HHn all TALUS_PAIR_HISTORY. To be created when the system has its store.
  FixPairHistory(class LAMMPS *, int, char **);
  ~FixPairHistory() override;

  /// From here on its style is NEIGH_HISTORY.
  void post_constructor() override;
  int setmask() override { return 0; }

  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

 private:
  int read_list(int atom);
  std::shared_ptr<Talus::GranularSystem> system;
  std::vector<double> list;    // of one particle, as HistoryStore has it
};

}    // namespace LAMMPS_NS

#endif
