// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_work.h"

#include "laws/contact_law.h"
#include "laws/law_definition.h"

namespace Talus {
namespace {

template <bool friction, bool twists, bool resists, bool beyond_contact>
void find_work_of_batch(ContactBatch &b, int begin, int end, const StageInput &in)
{
  for (int k = begin; k < end; k += lanes) {
    ContactLanes<Vec8> s;
    load_state(b, k, s);
    load_found<Stage::HEAT>(b, k, s);
    s.tangential = s.force - dot(s.force, s.normal) * s.normal;
    ContactWork<Vec8> work;
    find_work<friction, twists, resists, beyond_contact>(s, in.dt, work);
    for (int n = 0; n < ContactBatch::num_causes; n++) store(&b.work[n][k], work[n]);
  }
}

template <bool beyond_contact> StageFunction work_finder_of(const ContactLaw &law)
{
  if (law.resists()) return find_work_of_batch<true, true, true, beyond_contact>;
  if (law.twists()) return find_work_of_batch<true, true, false, beyond_contact>;
  return law.has_friction() ? find_work_of_batch<true, false, false, beyond_contact>
                            : find_work_of_batch<false, false, false, beyond_contact>;
}

}    // namespace

StageFunction work_finder(const ContactLaw &law)
{
  return law.normal().lasts_beyond_contact ? work_finder_of<true>(law) : work_finder_of<false>(law);
}

}    // namespace Talus
