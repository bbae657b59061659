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

/// What the laws behind it read of what other stages find, besides their sums.
enum class ReadBehindTouch { NOTHING, CIRCLE, ALL };

/// Of a batch, `advance`: with the history values of these laws, whose indices stand before the first one below 0.
template <bool advance, bool twists, ReadBehindTouch read>
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
    if constexpr (read == ReadBehindTouch::CIRCLE)
      for (double *one : {f.kn, f.contact_radius, f.elastic}) end_one(one);
    if constexpr (read == ReadBehindTouch::ALL)
      for (double *one :
           {f.kn, f.kt, f.tangent_n, f.tangent_t, f.contact_radius, f.elastic, f.pulloff_force,
            f.gn, f.gt, f.normal_force, f.critical_force, f.delayed_force})
        end_one(one);
    for (int d = 0; d < 3; d++)
      for (double *one : {b.force[d], b.torque_per_radius[d]}) end_one(one);
    if constexpr (twists)
      for (double *one : b.twisting_torque) end_one(one);
    if constexpr (advance)
      for (const int n : in.history_index) {
        if (n < 0) break;
        end_one(b.history[n]);
      }
  }
}

}    // namespace Talus

#endif
