// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Steps that are made in the records of the contacts: see ContactPipeline::compute().

#include "pair/pair_gran_penalty.h"

#include "atom.h"
#include "neighbor.h"

using namespace LAMMPS_NS;
using namespace Talus;

void PairGranPenalty::advance(const RecordStep &step, int groupbit)
{
  if (!pipeline.can_move()) {
    double **then = neighbor->dist_check ? neighbor->get_xhold() : nullptr;
    const int *mask = atom->mask;
    pipeline.prepare_to_move([=](int i) { return (mask[i] & groupbit) != 0; }, sent,
                             then && atom->nlocal ? then[0] : nullptr);
  }
  pipeline.advance(step);
}

std::size_t PairGranPenalty::others_that_join()
{
  if (!keeps_state || !pipeline.holds_state()) return 0;
  std::size_t joined = 0;
  while (joined < others.size() && others[joined]->join_step()) joined++;
  return joined;
}

void PairGranPenalty::return_state(bool with_forces)
{
  if (!pipeline.holds_state()) return;
  const bool any = atom->nlocal > 0;
  pipeline.return_state(any ? atom->x[0] : nullptr, any ? atom->v[0] : nullptr,
                        any ? atom->omega[0] : nullptr, any && with_forces ? atom->f[0] : nullptr,
                        any && with_forces ? atom->torque[0] : nullptr);
}

void PairGranPenalty::show_state(const std::vector<int> &atoms) const
{
  if (!atoms.empty()) pipeline.show_state(atoms, atom->x[0], atom->v[0], atom->omega[0]);
}

std::string PairGranPenalty::hazard_of_records() const
{
  if (keeps_account) return "energies of contacts are accounted for";
  if (masses.unit() != 1.0) return "the unit of force is not that of mass times acceleration";
  return "";
}
