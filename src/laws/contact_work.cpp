// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_work.h"

#include "laws/contact_law.h"
#include "laws/law_definition.h"

namespace Talus {
namespace {

template <int count>
void copy_history(ContactBatch &b, int begin, int end, const StageInput & /*in*/)
{
  for (int n = 0; n < count; n++)
    for (int k = begin; k < end; k += lanes) store(&b.before[n][k], load8(&b.history[n][k]));
}

/* The torques about the centers are -r moment and +- twisting torque: of the moment that much
   belongs to friction as its lever arm is long, of the twisting torque what the arms differ. */

template <bool friction, bool twists>
void find_work(ContactBatch &b, int begin, int end, const StageInput &in)
{
  const Vec8 zero{}, one = splat<Vec8>(1.0);
  auto &work = b.work;
  for (int k = begin; k < end; k += lanes) {
    ContactLanes<Vec8> s;
    load_state(b, k, s);
    const Vec8 damping = load8(&b.between.normal_force[k]) - load8(&b.between.elastic[k]);
    const Vec8 late = 0.5 * in.dt * damping * s.inverse_mass;
    store(&work[0][k], -in.dt * damping * (load8(&b.between.normal_velocity[k]) + late));
    if constexpr (!friction) {
      store(&work[1][k], zero);
      store(&work[2][k], zero);
      continue;
    }
    const Vector3<Vec8> force = load_vector<Vec8>(b.force, k);
    const Vector3<Vec8> tangential = force - dot(force, s.normal) * s.normal;
    const Vector3<Vec8> lever = cross(s.normal, tangential);
    if constexpr (!twists) {
      const Vec8 power = dot(tangential, s.velocity) - dot(lever, s.surface_rotation);
      store(&work[1][k], -in.dt * power);
      store(&work[2][k], zero);
      continue;
    }
    const Vector3<Vec8> moment = (one - s.arm_loss) * lever, twist = s.arm_difference * lever;
    const Vec8 power = dot(tangential, s.velocity) - dot(moment, s.surface_rotation) +
                       dot(twist, s.relative_omega);
    const Vector3<Vec8> rolling = load_vector<Vec8>(b.moment, k) - moment;
    const Vector3<Vec8> twisting = load_vector<Vec8>(b.twisting_torque, k) - twist;
    store(&work[1][k], -in.dt * power);
    store(&work[2][k],
          in.dt * (dot(rolling, s.surface_rotation) - dot(twisting, s.relative_omega)));
  }
}

}    // namespace

StageFunction history_copier(const ContactLaw &law)
{
  return law.has_impact() ? copy_history<ContactBatch::history_size> : copy_history<4>;
}

StageFunction work_finder(const ContactLaw &law)
{
  if (law.twists()) return find_work<true, true>;
  return law.has_friction() ? find_work<true, false> : find_work<false, false>;
}

}    // namespace Talus
