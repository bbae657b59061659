// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of order 2 with a large body, divided between threads in the middle of eight candidates:
// the same bits as with one thread, and no thread reads what another one writes (thread sanitizer).

#include "body/contact/body_contacts.h"
#include "body/shape/plane.h"
#include "digest.h"
#include "packing.h"
#include "second_order_engine.h"

#include <gtest/gtest.h>

#include <vector>

using namespace Talus;

namespace {

LawTable order_two()
{
  const Engine::Kernels law("hertz 800 3 tangential multistep 300 2 0.3 slider midpoint");
  LawTable table;
  table.reset(slow::num_types);
  for (int i = 1; i <= slow::num_types; i++)
    for (int j = i; j <= slow::num_types; j++) table.set(i, j, law.law, law.row);
  table.finish();
  return table;
}

/// Of forces over some steps, in which contacts begin and end; adds up these.
Digest digest_of(int threads, int &contacts_found)
{
  RandomSource random{21};
  slow::Packing p = slow::random_packing(1500, random);
  const Plane plane({0.5, -0.3, 0.2}, {0.6, 0.0, 0.8}, false);
  BodyFrame frame;
  frame.origin = plane.reference_point();
  BodyContacts contacts;
  contacts.set_laws(order_two());
  const std::vector<int> mask(p.size(), 1);
  std::vector<slow::Vector> force(p.size()), torque(p.size());
  const ParticleState view{p.size(),
                           {p.x[0].data(), p.v[0].data(), p.omega[0].data(), p.radius.data(),
                            p.mass.data(), nullptr, force[0].data(), torque[0].data()},
                           p.type.data()};
  Digest digest;
  for (int step = 0; step < 12; step++) {
    if (step % 4 == 0) contacts.find_candidates(plane, frame, view, mask.data(), 1, 0.3, threads);
    BodyStep how;
    how.dt = 1e-3;
    how.advance = step > 0;
    how.threads = threads;
    force.assign(p.size(), {});
    torque.assign(p.size(), {});
    contacts_found += static_cast<int>(contacts.compute(plane, frame, view, how).contacts);
    digest.add(force);
    digest.add(torque);
    p.move(5e-3, 0.1, random);
  }
  return digest;
}

}    // namespace

TEST(BodyThreads, GiveTheSameBitsInOrderTwo)
{
  int touching = 0;
  const Digest one = digest_of(1, touching);
  EXPECT_GT(touching, 500);
  for (const int threads : {2, 3, 5, 7}) {
    int again = 0;
    EXPECT_EQ(digest_of(threads, again).value, one.value) << threads;
    EXPECT_EQ(again, touching);
  }
}
