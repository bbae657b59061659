// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_work.h"

#include "laws/contact_law.h"
#include "laws/law_definition.h"

namespace Talus {
namespace {

/// What counts as work of the normal force; SUM: with that of a law of cohesion.
enum class NormalPart { DAMPING, WHOLE, SUM };

template <bool friction, bool twists, bool resists, NormalPart part>
void find_work_of_batch(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k += lanes) {
    ContactLanes<Vec8> s;
    load_state(b, k, s);
    load_found<Stage::HEAT>(b, k, s);
    const Vec8 sum = dot(s.force, s.normal);
    s.tangential = s.force - sum * s.normal;
    if constexpr (part == NormalPart::SUM) s.normal_force = sum;
    ContactWork<Vec8> work;
    find_work<friction, twists, resists, part != NormalPart::DAMPING>(s, in.dt, work);
    for (int n = 0; n < ContactBatch::num_causes; n++) store(&b.work[n][k], work[n]);
  }
}

template <NormalPart part> StageFunction work_finder_of(const ContactLaw &law)
{
  if (law.resists()) return find_work_of_batch<true, true, true, part>;
  if (law.twists()) return find_work_of_batch<true, true, false, part>;
  return law.has_friction() ? find_work_of_batch<true, false, false, part>
                            : find_work_of_batch<false, false, false, part>;
}

}    // namespace

StageFunction work_finder(const ContactLaw &law)
{
  if (!law.whole_force_works()) return work_finder_of<NormalPart::DAMPING>(law);
  return law.cohesion().acts ? work_finder_of<NormalPart::SUM>(law)
                             : work_finder_of<NormalPart::WHOLE>(law);
}

}    // namespace Talus
