// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "particles/particle_order.h"
#include "random_pairs.h"

#include <gtest/gtest.h>

#include <tuple>

using namespace Talus;
using namespace slow;

namespace {

TEST(ParticleOrder, OrdersParticlesByKeyThenTagThenHost)
{
  RandomSource random(1);
  for (int n : {0, 1, 2, 3, 50, 333}) {
    const Particles p = random_particles(n, random);
    ParticleOrder order;
    order.arrange(p.owned, p.key, p.tag);
    ASSERT_EQ(order.size(), n);
    EXPECT_EQ(order.tag, p.tag);
    for (int s = 0; s < n; s++) {
      ASSERT_EQ(order.slot_of_atom[order.atom_of_slot[s]], s);
      if (s == 0) continue;
      const int a = order.atom_of_slot[s - 1], b = order.atom_of_slot[s];
      const auto rank = [&](int atom) { return std::tuple(p.key[atom], p.tag[atom], atom); };
      ASSERT_LT(rank(a), rank(b));
    }
  }
}

TEST(ParticleOrder, ThreadsDoNotShow)
{
  RandomSource random(6);
  for (int n : {0, 1, 5, 400})
    for (bool sorted : {false, true}) {
      Particles p = random_particles(n, random);
      if (sorted)
        for (int a = 0; a < p.owned; a++) p.key[a] = a;
      ParticleOrder one, several;
      one.arrange(p.owned, p.key, p.tag);
      for (int threads : {2, 3, 8}) {
        several.arrange(p.owned, p.key, p.tag, threads);
        EXPECT_EQ(several.atom_of_slot, one.atom_of_slot);
        EXPECT_EQ(several.slot_of_atom, one.slot_of_atom);
      }
    }
}

}    // namespace
