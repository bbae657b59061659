// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pairs that do not overlap, and touch all the same.

#include "contact/contact_chunk.h"

#include "base/lanes.h"
#include "laws/tangential/end_of_contact.h"

#include <algorithm>

namespace Talus {

/* Contacts of second order end one step later; bridges with liquid of particles by what they hold. */

unsigned ContactChunk::lasting(const Step &step, std::int64_t pair, unsigned ended)
{
  const ContactScene &scene = step.scene;
  const auto lasts = [&](std::int64_t one) {
    if (scene.second_order) return has_just_ended(history.record(one).c[3], step.advance);
    return scene.liquid.terms(row_of_pair(scene, one)).share > 0.0 && bridge_holds(step, one);
  };
  unsigned found = 0;
  for (; ended; ended &= ended - 1U) {
    const int k = __builtin_ctz(ended);
    if (lasts(pair + k)) found |= 1U << k;
  }
  return found;
}

/* The others by their pull-off distance, which depends on radii alone: it is found once for every list of pairs. Who
   changes radii or laws does so in the arrays of LAMMPS. */

bool ContactChunk::has_limits(const ContactScene &scene) const
{
  return !scene.second_order && scene.laws.lasts_beyond_contact();
}

void ContactChunk::make_room_for_limits(const Step &step)
{
  const std::size_t room = has_limits(step.scene) ? pairs.num_pairs() + lanes : 0;
  if (limits.size() != room) renew(limits, room);
  if (step.read) limits_are_known = false;
  if (room == 0) limits_are_known = true;
}

/* Of pairs begin ... end-1, `begin` a multiple of eight, whose particles have been loaded. */

void ContactChunk::find_limits(const Step &step, std::int64_t begin, std::int64_t end)
{
  const ContactScene &scene = step.scene;
  const Record *position = step.particles.position.data();
  const int *first = pairs.state_of_first(), *second = pairs.second.data();
  for (std::int64_t c = begin; c < end; c += lanes) {
    alignas(64) double radius_i[lanes], radius_j[lanes];
    int row[lanes];
    for (int k = 0; k < lanes; k++) {
      const std::int64_t pair = std::min(c + k, end - 1);
      radius_i[k] = position[first[pair]].c[3];
      radius_j[k] = position[second[pair]].c[3];
      row[k] = row_of_pair(scene, pair);
    }
    for (int k = 0; k < lanes; k++) {
      if (k > 0 && row[k] == row[k - 1]) continue;
      alignas(64) double found[lanes];
      store(found, scene.laws.limits_of_contacts(row[k], load8(radius_i), load8(radius_j)));
      for (int n = k; n < lanes && row[n] == row[k]; n++) limits[c + n] = found[n];
    }
  }
}

}    // namespace Talus
