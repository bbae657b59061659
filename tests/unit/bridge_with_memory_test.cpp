// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A law of cohesion beyond touch that remembers something, as laws of users may be: a thread that pulls the less the
// longer the surfaces have been apart. What other laws remember ends with the touch, what it does stays.

#include "contacts_by_words.h"
#include "laws/law_definition.h"
#include "laws/law_list.h"
#include "material/law_table.h"

#include <gtest/gtest.h>

using namespace contacts;

namespace {

struct Thread : CohesionLaw {
  static constexpr const char *name = "thread", *label = name;
  static constexpr bool lasts_beyond_contact = true;
  static constexpr int even_history = 1;    // time since the surfaces have parted
  template <class Real> struct Row {
    Real force, length;
  };
  static constexpr CoefficientName coefficients[] = {{"force"}, {"length"}};

  static void read(LawReader &r)
  {
    r.spec.given["thread force"] = r.words.positive("force");
    r.spec.given["thread length"] = r.words.positive("length");
  }
  static Row<double> mix(const Mixing &m)
  {
    return {m.mean("thread force"), m.mean("thread length")};
  }
  template <class Real>
  static Real pulloff_cube(const Row<Real> &c, const ContactSize<Real> & /*size*/)
  {
    return c.length * c.length * c.length;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *history,
                                   double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real time = select(s.overlap < zero, history[0] + (advance ? dt : 0.0), zero);
    s.force = s.force - (c.force / (one + time)) * s.normal;
    if constexpr (advance) history[0] = time;
  }
};

const AddedLaw added(law<Thread>);
constexpr double dt = 0.5;

TEST(BridgeWithMemory, KeepsItsOwnWhileThatOfTouchEnds)
{
  const Pair pair("hooke 1e3 0 tangential multistep NULL NULL 0.5 adhesion thread 6 0.2", 1.0, 1.0);
  EXPECT_EQ(pair.reach(), 0.2);
  const int own = pair.law.history().of_stage[static_cast<int>(Stage::COHESION)][0];
  ContactBatch batch;
  batch.clear();
  const ContactKernel kernel = contact_kernel(pair.law, true, true);
  const auto step = [&](double gap) {
    const ContactState<double> s = pair.at(gap);
    batch.overlap[0] = s.overlap;
    batch.normal[0][0] = 1.0;
    batch.velocity[1][0] = 0.1;
    batch.inverse_radius[0] = s.inverse_radius;
    batch.inverse_distance[0] = s.inverse_distance;
    kernel(batch, 0, lanes, &pair.row, dt);
    return batch.force[0][0];
  };
  const auto others_are_zero = [&] {
    bool all = true;
    for (int n = 0; n < ContactBatch::history_size; n++)
      all = all && (n == own || batch.history[n][0] == 0.0);
    return all;
  };
  EXPECT_DOUBLE_EQ(step(-0.01), 10.0 - 6.0);
  EXPECT_FALSE(others_are_zero());
  for (int n = 1; n < 4; n++) {
    EXPECT_DOUBLE_EQ(step(0.1), -6.0 / (1.0 + n * dt));
    EXPECT_EQ(batch.history[own][0], n * dt);
    EXPECT_TRUE(others_are_zero());
  }
  HistoryValues kept{};
  kept[own] = batch.history[own][0];
  EXPECT_DOUBLE_EQ(pair.contact(0.1, {}, kept).force.x, -6.0 / (1.0 + 3 * dt));
  EXPECT_DOUBLE_EQ(step(-0.01), 10.0 - 6.0);
  EXPECT_EQ(batch.history[own][0], 0.0);
}

}    // namespace
