// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact models of LAMMPS' granular walls for several threads: a model keeps the contact that it
// computes in its members, so that each thread needs one of its own.

#ifndef TALUS_FIX_WALL_MODELS_H
#define TALUS_FIX_WALL_MODELS_H

#include <memory>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
namespace Granular_NS {
class GranularModel;
}
}    // namespace LAMMPS_NS

namespace Talus {

using Model = LAMMPS_NS::Granular_NS::GranularModel;

class WallModels {
 public:
  WallModels();
  ~WallModels();
  WallModels(const WallModels &) = delete;
  WallModels &operator=(const WallModels &) = delete;

  /// At the start of a run, after the fix has set up its model: `own` for the first thread, and
  /// models like it for the others.
  void init(LAMMPS_NS::LAMMPS *lmp, Model &own, int threads);

  int threads() const { return 1 + static_cast<int>(others.size()); }
  Model &of(int thread) const { return thread == 0 ? *first : *others[thread - 1]; }
  /// At the beginning of a step: time step, whether histories advance and details are kept, for all
  /// threads; `wall_velocity` is kept as a pointer, the wall does not turn.
  void begin_step(double dt, bool advance, bool with_details, double *wall_velocity);

 private:
  Model *first = nullptr;
  std::vector<std::unique_ptr<Model>> others;
  double no_omega[3] = {0.0, 0.0, 0.0};
};

}    // namespace Talus

#endif
