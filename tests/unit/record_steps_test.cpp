// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Steps that are made in the records must have the bits of steps through the host's arrays, with
// any division of the work, whoever is sent, and whenever the host looks at the particles. The
// reference is the plain loop of the integrator around a pipeline that reads and delivers in every
// step.

#include "neighbor_lists.h"
#include "packing.h"

#include "contact/contact_pipeline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

using namespace Talus;
using namespace slow;

namespace {

constexpr double skin = 1.5;
const RecordStep euler{1e-3, 1e-3, {0.0, 1e-3, -4e-3}, 0.4};

/// Velocity Verlet: kicks of half a step.
RecordStep verlet(double inertia)
{
  RecordStep step{1e-3, 5e-4, {0.0, 0.0, 0.0}, inertia};
  step.two_kicks = true;
  return step;
}

/// A host: rows of three, owned particles only.
struct Host {
  std::vector<double> x, v, omega, radius, mass, f, torque;
  int n = 0;

  explicit Host(const Packing &p) : radius(p.radius), mass(p.mass), n(p.size())
  {
    for (int i = 0; i < n; i++)
      for (int d = 0; d < 3; d++) {
        x.push_back(p.x[i][d]);
        v.push_back(p.v[i][d]);
        omega.push_back(p.omega[i][d]);
      }
    f.assign(3 * n, 0.0);
    torque.assign(3 * n, 0.0);
  }

  ParticleView view()
  {
    return {x.data(),    v.data(), omega.data(), radius.data(),
            mass.data(), nullptr,  f.data(),     torque.data()};
  }
  /// One kick, and the drift of particle i.
  void kick(int i, const RecordStep &with, bool drifts)
  {
    const double per_mass = with.kick * (1.0 / mass[i]), inverse_radius = 1.0 / radius[i];
    const double per_inertia = per_mass * (inverse_radius * inverse_radius) * (1.0 / with.inertia);
    for (int k = 3 * i; k < 3 * i + 3; k++) {
      v[k] += per_mass * f[k] + with.gravity_kick[k - 3 * i];
      omega[k] += per_inertia * torque[k];
      if (drifts) x[k] += with.dt * v[k];
    }
  }
  void clear_forces()
  {
    std::fill(f.begin(), f.end(), 0.0);
    std::fill(torque.begin(), torque.end(), 0.0);
  }
  void spoil()
  {
    for (auto *rows : {&x, &v, &omega, &f, &torque}) std::fill(rows->begin(), rows->end(), NAN);
  }
  void step(const std::function<bool(int)> &moves)
  {
    for (int i = 0; i < n; i++)
      if (moves(i)) kick(i, euler, true);
  }
};

bool same_rows(const std::vector<double> &a, const std::vector<double> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool same_state(const Host &a, const Host &b)
{
  return same_rows(a.x, b.x) && same_rows(a.v, b.v) && same_rows(a.omega, b.omega);
}

struct Division {
  int threads;
  bool two_phases;
  bool some_rest, some_sent;
};

class RecordSteps : public testing::TestWithParam<Division> {
 protected:
  RecordSteps() : p(packing(random)), reference(p), host(p)
  {
    const LawTable laws = mixed_laws();
    for (ContactPipeline *pipeline : {&slow, &fast}) pipeline->set_laws(laws);
    fast.set_work(GetParam().threads, GetParam().two_phases);
    for (ContactPipeline *pipeline : {&slow, &fast}) number_pairs(*pipeline);
    if (GetParam().some_sent)
      for (int i = 0; i < p.size(); i += 7) sent.push_back(i);
  }

  static Packing packing(RandomSource &random) { return random_packing(300, random); }

  void number_pairs(ContactPipeline &pipeline)
  {
    NeighborLists lists(p.size());
    for (const Neighbors &n : candidates(p, skin, true)) lists.add(n.i, n.j, n.weight);
    pipeline.set_pairs({p.size(), p.key, p.tag, p.type.data()}, lists.view());
    pipeline.start_pairs(nothing_kept);
  }

  bool moves(int i) const { return !GetParam().some_rest || i % 5 != 2; }

  void compute(ContactPipeline &pipeline, Host &of, const ContactStep &step)
  {
    if (!pipeline.in_two_phases()) return pipeline.compute(of.view(), step);
    pipeline.compute_early(of.view(), step);
    pipeline.compute_late(of.view(), step);
  }

  template <class Mover> static ParticleMotion::Movers for_each(Mover mover)
  {
    return [mover](int begin, int end, signed char *to) {
      for (int i = begin; i < end; i++) to[i - begin] = static_cast<signed char>(mover(i));
    };
  }

  void advance()
  {
    if (!fast.motion().is_prepared())
      fast.motion().prepare(for_each([this](int i) { return moves(i) ? 0 : -1; }), sent);
    fast.motion().advance({euler});
  }

  /// A step after which particles stay in the records, and their move; how such steps are made.
  ContactStep keep_and_move()
  {
    ContactStep keep{euler.dt, true};
    keep.deliver = false;
    compute(slow, reference, {euler.dt, true});
    compute(fast, host, keep);
    advance();
    reference.step([this](int i) { return moves(i); });
    return keep;
  }

  RandomSource random{21};
  Packing p;
  Host reference, host;
  HistoryStore nothing_kept;
  ContactPipeline slow, fast;
  std::vector<int> sent;
};

TEST_P(RecordSteps, HaveTheBitsOfStepsThroughTheHost)
{
  const std::vector<int> looked_at{0, 1, 5, 6, 20, 39};
  for (int n = 0; n < 40; n++) {
    const auto in = [&](int step) {
      return std::find(looked_at.begin(), looked_at.end(), step) != looked_at.end();
    };
    if (n > 0) reference.step([this](int i) { return moves(i); });
    reference.clear_forces();
    compute(slow, reference, {euler.dt, n > 0});

    const bool held = fast.motion().holds_state();
    ASSERT_EQ(held, n > 0 && !in(n - 1));
    if (held)
      advance();
    else if (n > 0)
      host.step([this](int i) { return moves(i); });
    if (held) {    // what is sent is there before forces are computed
      fast.motion().copy_states(sent, host.view());
      for (const int i : sent)
        for (int k = 3 * i; k < 3 * i + 3; k++) ASSERT_EQ(host.x[k], reference.x[k]);
    }
    host.clear_forces();
    ContactStep step{euler.dt, n > 0};
    step.read = !held;
    step.deliver = in(n);
    compute(fast, host, step);
    if (in(n)) {
      ASSERT_TRUE(same_state(host, reference)) << n;
      ASSERT_TRUE(same_rows(host.f, reference.f) && same_rows(host.torque, reference.torque)) << n;
    } else {
      host.spoil();
    }
  }
}

TEST_P(RecordSteps, ReturnTheStateInTheMiddleOfAStepAndAtItsEnd)
{
  for (const bool in_the_middle : {false, true}) {
    ContactStep keep{euler.dt, true};
    keep.deliver = false;
    compute(slow, reference, {euler.dt, true});
    compute(fast, host, keep);
    host.spoil();
    if (in_the_middle) {
      advance();
      reference.step([this](int i) { return moves(i); });
    }
    fast.motion().return_state(host.view(), !in_the_middle);
    EXPECT_FALSE(fast.motion().holds_state());
    EXPECT_TRUE(same_state(host, reference));
    if (!in_the_middle) {
      EXPECT_TRUE(same_rows(host.f, reference.f));
      EXPECT_TRUE(same_rows(host.torque, reference.torque));
    }
    for (Host *one : {&reference, &host}) one->clear_forces();
  }
}

/* Three groups: spheres and discs of velocity Verlet, and semi-implicit Euler. Some have no weight. */

TEST_P(RecordSteps, OfSeveralIntegratorsWithWeights)
{
  const std::vector<RecordStep> steps{verlet(0.4), verlet(0.5), euler};
  const double g[3] = {0.1, -0.3, -5.0};
  const auto mover = [this](int i) { return moves(i) ? i % 3 : -1; };
  const auto weightless = [](int i) { return i % 4 == 1; };
  for (ContactPipeline *pipeline : {&slow, &fast}) {
    pipeline->set_gravity(g);
    pipeline->set_weightless(weightless);
  }
  const auto end_step = [&](Host &of) {
    for (int i = 0; i < of.n; i++)
      if (mover(i) >= 0 && steps[mover(i)].two_kicks) of.kick(i, steps[mover(i)], false);
  };
  for (int n = 0; n < 30; n++) {
    const bool looked_at = n % 6 == 0 || n == 7;
    if (n > 0)
      for (int i = 0; i < reference.n; i++)
        if (mover(i) >= 0) reference.kick(i, steps[mover(i)], true);
    reference.clear_forces();
    compute(slow, reference, {euler.dt, n > 0});
    end_step(reference);

    const bool held = fast.motion().holds_state();
    if (held) {
      if (!fast.motion().is_prepared()) fast.motion().prepare(for_each(mover), sent);
      fast.motion().advance(steps);
      EXPECT_TRUE(fast.motion().is_moving());
    } else if (n > 0) {
      for (int i = 0; i < host.n; i++)
        if (mover(i) >= 0) host.kick(i, steps[mover(i)], true);
    }
    host.clear_forces();
    ContactStep step{euler.dt, n > 0};
    step.read = !held;
    step.deliver = looked_at;
    compute(fast, host, step);
    if (!looked_at) {
      host.spoil();
      continue;
    }
    end_step(host);
    ASSERT_TRUE(same_state(host, reference)) << n;
    ASSERT_TRUE(same_rows(host.f, reference.f) && same_rows(host.torque, reference.torque)) << n;
  }
}

TEST_P(RecordSteps, BeginSumsWithTheWeights)
{
  const double g[3] = {0.0, 0.0, -5.0};
  Host bare(p);
  compute(slow, bare, {euler.dt, false});
  slow.set_gravity(g);
  slow.set_weightless([](int i) { return i % 4 == 1; });
  compute(slow, reference, {euler.dt, false});
  for (int i = 0; i < reference.n; i++) {
    const double weight = i % 4 == 1 ? 0.0 : -5.0 * reference.mass[i], f = bare.f[3 * i + 2];
    EXPECT_EQ(reference.f[3 * i], bare.f[3 * i]);
    EXPECT_NEAR(reference.f[3 * i + 2], f + weight, 1e-12 * (std::abs(f) + std::abs(weight) + 1.0))
        << i;
  }
}

class RecordStepsInTwoPhases : public RecordSteps {};

TEST_P(RecordStepsInTwoPhases, ReturnTheStateBetweenThem)
{
  ASSERT_TRUE(fast.in_two_phases());
  ContactStep keep{euler.dt, true};
  keep.deliver = false;
  compute(slow, reference, {euler.dt, true});
  compute(fast, host, keep);
  host.spoil();
  advance();
  reference.step([this](int i) { return moves(i); });
  keep.read = false;
  fast.compute_early(host.view(), keep);    // then an error comes
  fast.motion().return_state(host.view(), false);
  EXPECT_TRUE(same_state(host, reference));
}

TEST_P(RecordSteps, TellTheLargestSpeed)
{
  ContactStep keep = keep_and_move();
  keep.read = false;
  compute(fast, host, keep);

  double expected = 0.0;
  bool all_move = true;
  for (int i = 0; i < reference.n; i++) {
    const double *v = &reference.v[3 * i];
    expected = std::max(expected, std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    all_move = all_move && moves(i);
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_EQ(fast.motion().fastest(), expected);
  EXPECT_EQ(fast.motion().moves_all_owned(), all_move);
}

TEST_P(RecordSteps, TakeTorquesOfOthers)
{
  ContactStep keep{euler.dt, true};
  keep.deliver = false;
  compute(slow, reference, {euler.dt, true});
  compute(fast, host, keep);
  ParticleRecords &records = fast.records();
  for (int i = 0; i < reference.n; i += 3) {
    const int s = fast.particle_order().slot_of_atom[i];
    for (int time = 0; time < 2; time++) {
      records.settle_torque(s);
      records.load[2 * s + 1].c[1] += 0.25;
      records.load[2 * s].c[0] -= 0.5;
      reference.torque[3 * i + 1] += 0.25;
      reference.f[3 * i] -= 0.5;
    }
  }
  advance();
  reference.step([this](int i) { return moves(i); });
  fast.motion().return_state(host.view(), false);
  EXPECT_TRUE(same_state(host, reference));
}

TEST_P(RecordSteps, AddMoreForcesToEverySlotOnceWhenItsContactsAreDone)
{
  ContactStep keep = keep_and_move();
  reference.clear_forces();
  compute(slow, reference, {euler.dt, true});

  const ParticleOrder &order = fast.particle_order();
  std::vector<Record> sums(reference.n);
  const std::function<void(int, int, int)> more = [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) {
      Record &force = fast.records().load[2 * static_cast<std::size_t>(s)];
      sums[order.atom_of_slot[s]] = force;
      force.c[2] += 0.5;
    }
  };
  keep.read = false;
  keep.add_other_forces = &more;
  compute(fast, host, keep);
  for (int i = 0; i < reference.n; i++) {
    for (int d = 0; d < 3; d++) ASSERT_EQ(sums[i].c[d], reference.f[3 * i + d]) << i;
    reference.f[3 * i + 2] += 0.5;
  }
  fast.motion().return_state(host.view(), true);
  EXPECT_TRUE(same_rows(host.f, reference.f) && same_rows(host.torque, reference.torque));
}

constexpr Division two_phases{1, true, false, true}, two_phases_on_threads{2, true, true, true};

INSTANTIATE_TEST_SUITE_P(Divisions, RecordSteps,
                         testing::Values(Division{1, false, false, false},
                                         Division{1, false, true, true}, two_phases,
                                         Division{3, false, true, false}, two_phases_on_threads));
INSTANTIATE_TEST_SUITE_P(Divisions, RecordStepsInTwoPhases,
                         testing::Values(two_phases, two_phases_on_threads));

}    // namespace
