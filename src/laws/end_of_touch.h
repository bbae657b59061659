// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What is left of the laws between bodies that touch where these are apart and a law of cohesion or of heat acts: nothing,
// and no memory. Called by kernels and queries of single contacts before that stage.

#ifndef TALUS_LAWS_END_OF_TOUCH_H
#define TALUS_LAWS_END_OF_TOUCH_H

#include "laws/law_definition.h"

namespace Talus {

/// Of one contact; its history is the caller's.
inline void end_touch(ContactLanes<double> &s)
{
  if (!(s.overlap < 0.0)) return;
  for (double *one :
       {&s.kn, &s.kt, &s.tangent_n, &s.tangent_t, &s.contact_radius, &s.elastic, &s.pulloff_force,
        &s.gn, &s.gt, &s.normal_force, &s.critical_force, &s.delayed_force})
    *one = 0.0;
  s.force = s.tangential = s.torque_per_radius = s.twisting_torque = Vector3<double>{};
}

/// Of a batch, `advance`: with the history values of these laws, all indices that are not below 0; `found`: with what
/// stages find for others, not the sums alone.
template <bool advance, bool found>
void end_touch(ContactBatch &b, int begin, int end, const StageInput &in)
{
  [[maybe_unused]] ContactBatch::Between &f = b.between;
  const Vec8 zero = splat<Vec8>(0.0);
  for (int k = begin; k < end; k += lanes) {
    const auto apart = load8(&b.overlap[k]) < zero;
    if (!any(apart)) continue;
    const auto end_one = [=](double *of_lanes) {
      store(of_lanes + k, select(apart, zero, load8(of_lanes + k)));
    };
    if constexpr (found)
      for (double *one :
           {f.kn, f.kt, f.tangent_n, f.tangent_t, f.contact_radius, f.elastic, f.pulloff_force,
            f.gn, f.gt, f.normal_force, f.critical_force, f.delayed_force})
        end_one(one);
    for (int d = 0; d < 3; d++)
      for (double *one : {b.force[d], b.torque_per_radius[d], b.twisting_torque[d]}) end_one(one);
    if constexpr (advance)
      for (const int n : in.history_index)
        if (n >= 0) end_one(b.history[n]);
  }
}

}    // namespace Talus

#endif
