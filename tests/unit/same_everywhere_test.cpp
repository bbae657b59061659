// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The same bits from every compiler, every instruction set and every processor: digests of scenes
// with pairs, laws, large bodies, shapes and order 2. The numbers below are those of the first
// compiler (GCC 12, AVX-512). They change only where the physics or its rounding is changed on
// purpose; then they are to be taken again from the messages of this test, with any compiler, and
// must be the same with all others.
//
// Some laws use pow, tanh and the like of the C library. glibc computes those with the same bits
// where processors have fused multiply-add: x86-64 since 2013, and aarch64.

#include "base/power.h"
#include "body/contact/body_contacts.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/plane.h"
#include "digest.h"
#include "flying_body.h"
#include "law_states.h"
#include "packing.h"
#include "second_order_engine.h"
#include "shape/convex/collide.h"
#include "test_rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

using namespace Talus;

namespace {

void expect_digest(std::uint64_t expected, const Digest &found, const std::string &what)
{
  EXPECT_EQ(expected, found.value) << what << " has digest 0x" << std::hex << found.value << "U";
}

/* Pairs through the whole pipeline: search, narrow phase, kernels, histories, sums. */

Digest of_pairs(const LawTable &laws)
{
  RandomSource random(12);
  slow::Packing p = slow::random_packing(400, random);
  slow::TestRank rank(laws);
  std::vector<int> all(p.size());
  for (int i = 0; i < p.size(); i++) all[i] = i;
  slow::Luggage luggage;
  rank.rebuild(p, all, slow::candidates(p, 1.5, true), luggage, random);
  Digest digest;
  for (int step = 0; step < 30; step++) {
    rank.compute(p, 1e-3, step > 0);
    digest.add(rank.force);
    digest.add(rank.torque);
    for (int i = 0; i < p.size(); i++) {
      const double per_mass = 1e-3 / p.mass[i];
      p.v[i] = slow::axpy(per_mass, rank.force[i], p.v[i]);
      p.x[i] = slow::axpy(1e-3, p.v[i], p.x[i]);
    }
  }
  EXPECT_GT(ContactSurvey(rank.pipeline).count_contacts(), 300.0);
  return digest;
}

TEST(SameEverywhere, Pairs)
{
  expect_digest(0x7f9779650fdd4dbbU, of_pairs(slow::mixed_laws()), "mixed laws");
  expect_digest(
      0xcf6d3204d68229f0U,
      of_pairs(slow::single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, true)),
      "one law");
}

/* Every law with all that it can be combined with, as it is and of order 2. */

class Laws {
 public:
  explicit Laws(bool second) : second_order(second) { batch.clear(); }

  void add(const named::NamedLaw &law)
  {
    for (const named::NamedLaw &variant : reference::variants(law)) {
      const ContactSpec spec = reference::random_spec(random, variant, random.chance(0.3));
      ContactLaw used = variant;
      if (second_order) {
        if (!reason_against_second_order(used, Engine::row_of(spec)).empty()) continue;
        used = second_order_law(used);
      }
      for (int n = 0; n < 4; n++) run(variant, used, spec);
    }
  }

  Digest digest;
  int count = 0;

 private:
  void run(const named::NamedLaw &law, const ContactLaw &used, const ContactSpec &spec)
  {
    const ContactCoefficients row = Engine::row_of(spec);
    const reference::Composite both = reference::compose(spec, spec, FrictionMix::MINIMUM);
    for (int lane = 0; lane < lanes; lane++) {
      reference::put(batch, lane, reference::random_contact(random, law, both, dt), 0);
      if (second_order)    // whose memory has other places
        for (auto &value : batch.history) value[lane] = 0.0;
    }
    contact_kernel(used, true, true)(batch, 0, lanes, &row, dt);
    for (int lane = 0; lane < lanes; lane++) {
      for (int d = 0; d < 3; d++) {
        digest.add(batch.force[d][lane]);
        if (used.has_friction()) digest.add(batch.torque_per_radius[d][lane]);
        if (used.twists()) digest.add(batch.twisting_torque[d][lane]);
      }
      const int places = std::max(8, used.history().size);
      for (int n = 0; n < places; n++) digest.add(batch.history[n][lane]);
      count++;
    }
  }

  static constexpr double dt = 2e-5;
  bool second_order;
  RandomSource random{4711};
  ContactBatch batch;
};

TEST(SameEverywhere, Laws)
{
  const std::uint64_t expected[] = {0x10e8113eff559a58U, 0x74f87a82984006d1U};
  for (const bool second : {false, true}) {
    Laws laws(second);
    for (const named::NamedLaw &law : reference::law_pairs()) laws.add(law);
    EXPECT_GT(laws.count, 1000);
    expect_digest(expected[second], laws.digest, second ? "order 2" : "order 1");
  }
}

/* Those of LAMMPS' granular styles, with adhesion, resistance and heat, in motion. */

TEST(SameEverywhere, ImpactsOfGranularLaws)
{
  const struct {
    const char *words;
    bool second;
    std::uint64_t expected;
  } cases[] = {
      {"hertz 1e5 0.5 tangential mindlin 3e4 1.0 0.4 rolling sds 1e4 10.0 0.1 twisting marshall "
       "damping tsuji",
       false, 0xabc225bf98a1dce2U},
      {"jkr 1e5 0.3 0.3 10.0 tangential mindlin_rescale/force NULL 1.0 0.4", false,
       0x5d48f68ed57b61ebU},
      {"hooke 1e5 50.0 tangential linear_history 3e4 1.0 0.4 damping mass_velocity", true,
       0x6cfa20fc9e026294U},
      {"hertz/material 1e7 0.5 0.3 tangential mindlin NULL 1.0 0.4", true, 0x1fc0566382df21a2U},
  };
  for (const auto &one : cases) {
    second_order::System start;
    start.gravity = {0, 0, -9.81};
    start.planes = {{{0, 0, 0}, {0, 0, 1}}};
    for (int n = 0; n < 3; n++) {
      second_order::Particle p;
      p.x = {0.03 * n, 0.02 * n * n, 0.5 + 0.999 * n};
      p.v = {0.1 * n, -0.2, -0.3};
      p.w = {1.0, 0.3 * n, -0.7};
      p.mass = 0.5;
      start.particles.push_back(p);
    }
    Digest digest;
    const Engine::Kernels kernels(one.words, one.second);
    const Engine::Motion motion(kernels, start, 0.1, 400);
    for (const second_order::Particle &p : motion.result())
      for (const second_order::Vec &v : {p.x, p.v, p.w}) digest.add(v);
    expect_digest(one.expected, digest, one.words);
  }
}

/* Particles in large bodies of every kind, at rest and moving. */

Digest of_body(const LargeBodyShape &shape, bool moves)
{
  RandomSource random(3);
  slow::Packing p = slow::random_packing(600, random);
  BodyFrame frame;
  if (moves) {
    BodyState state;
    state.position = {0.3, -0.7, 0.5};
    state.orientation = Eigen::Quaterniond(0.8, 0.36, 0.0, 0.48);
    state.velocity = {1.0, 0.5, -2.0};
    state.omega = {0.3, -0.4, 0.2};
    frame.moves = true;
    frame.set(state);
  }
  frame.origin = shape.reference_point();
  BodyContacts contacts;
  contacts.set_laws(slow::single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, true));
  contacts.history.keep(shape.most_contacts() > 1, false);
  const std::vector<int> mask(p.size(), 1);
  std::vector<slow::Vector> force(p.size()), torque(p.size());
  const ParticleState view{p.size(),
                           {p.x[0].data(), p.v[0].data(), p.omega[0].data(), p.radius.data(),
                            p.mass.data(), nullptr, force[0].data(), torque[0].data()},
                           p.type.data()};
  Digest digest;
  int touching = 0;
  for (int step = 0; step < 12; step++) {
    if (step % 4 == 0) contacts.find_candidates(shape, frame, view, mask.data(), 1, 0.3, 1);
    BodyStep how;
    how.dt = 1e-3;
    how.advance = step > 0;
    force.assign(p.size(), {});
    torque.assign(p.size(), {});
    const BodyLoad load = contacts.compute(shape, frame, view, how);
    touching += static_cast<int>(load.contacts);
    digest.add(load.force);
    digest.add(load.torque);
    digest.add(force);
    digest.add(torque);
    p.move(5e-3, 0.1, random);
  }
  EXPECT_GT(touching, 500);
  return digest;
}

TEST(SameEverywhere, Bodies)
{
  const Plane plane({0.5, -0.3, 0.2}, {0.6, 0.0, 0.8}, true);
  const Box box({0.2, -0.1, 0.3}, {9.0, 8.0, 7.0}, true);
  const Vector3<double> corner[4] = {
      {-9.0, -9.0, 0.5}, {9.0, -9.0, -1.0}, {9.0, 9.0, 0.3}, {-9.0, 9.0, 1.0}};
  const std::vector<Triangle> soup{{{corner[0], corner[1], corner[2]}},
                                   {{corner[0], corner[2], corner[3]}}};
  const MeshShape mesh(TriangleMesh(soup), MeshSide::BOTH);
  const Frustum drum({0.2, -0.1, 0.3}, {0.6, 0.0, 0.8}, 5.0, 4.0, 9.0, true);
  const struct {
    const char *name;
    const LargeBodyShape *shape;
    std::uint64_t expected[2];
  } cases[] = {{"plane", &plane, {0xd06da06c729e598fU, 0x6bc9882f44cfdce9U}},
               {"box", &box, {0xc34c1f67602a305eU, 0x387425819b4fd50bU}},
               {"drum", &drum, {0xcb6f2b4e9ad07c20U, 0x800aaccee3553503U}},
               {"mesh", &mesh, {0xa37acc0f4cf16256U, 0x463959869cc47223U}}};
  for (const auto &one : cases)
    for (const bool moves : {false, true})
      expect_digest(one.expected[moves], of_body(*one.shape, moves),
                    std::string(one.name) + (moves ? ", moving" : ""));
}

/* Two convex bodies that meet, sharp and rounded. */

Digest of_shapes(double radius)
{
  RandomBodies random(37);
  std::vector<ConvexShape> shapes;
  shapes.push_back(ConvexShape::box({1.0, 0.6, 0.3}, radius));
  shapes.push_back(ConvexShape::polyhedron(random.corners(14, {0.6, 0.5, 0.4}), radius));
  Digest digest;
  int touching = 0;
  for (int scene = 0; scene < 60; scene++) {
    Flying body[2];
    for (int k = 0; k < 2; k++) {
      body[k] = {&shapes[random.below(2)], {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, random.orientation()};
      body[k].x = (k ? 0.9 : -0.9) * to_eigen(random.direction());
      body[k].v = -0.8 * body[k].x;
      body[k].momentum = 0.02 * to_eigen(random.direction());
    }
    SeparatingDirection direction;
    ShapeContacts contacts;
    for (int step = 0; step < 200; step++) {
      collide(*body[0].shape, body[0].pose(), *body[1].shape, body[1].pose(), direction, contacts,
              NarrowPhase::FEATURES, 1.5);
      for (const ShapeContact &c : contacts.points) {
        digest.add(c.position);
        digest.add(c.normal);
        digest.add(c.overlap);
        digest.add(c.weight);
        digest.add(c.energy);
        touching++;
        for (int k = 0; k < 2; k++) {
          const double size = 1e3 * c.weight * c.overlap * std::sqrt(c.overlap);
          const Eigen::Vector3d f = ((k ? -4e-3 : 4e-3) * size) * to_eigen(c.normal);
          body[k].v += f / body[k].mass();
          body[k].momentum += (to_eigen(c.position) - body[k].x).cross(f);
        }
      }
      for (Flying &one : body) one.move(4e-3);
    }
    for (const Flying &one : body) digest.add(from_eigen(one.x));
  }
  for (const ConvexShape &shape : shapes) {
    digest.add(shape.volume());
    digest.add(shape.contact_radius());
    digest.add(from_eigen(shape.principal_moments()));
  }
  EXPECT_GT(touching, 1500);
  return digest;
}

TEST(SameEverywhere, Shapes)
{
  expect_digest(0xc0e326a517a492c1U, of_shapes(0.0), "sharp bodies");
  expect_digest(0x2a61e1cbf5d68cb1U, of_shapes(0.05), "rounded bodies");
}

TEST(SameEverywhere, CubeRoots)
{
  RandomSource random(5);
  Digest digest;
  for (int n = 0; n < 20000; n++) {
    const double exact = random.uniform(1.0, 10.0);
    const double cube = std::ldexp(exact, random.below(400) - 200);
    const double root = cube_root(cube);
    const long double error = static_cast<long double>(root) * root * root - cube;
    EXPECT_LE(std::abs(static_cast<double>(error / cube)), 3 * 0.51 * 0x1p-52);
    digest.add(root);
  }
  for (const double whole : {0.0, 1.0, 8.0, 27.0, -64.0, 1e-300 * 1e-18 * 1e-3, 1e300})
    digest.add(cube_root(whole));
  EXPECT_EQ(cube_root(27.0), 3.0);
  EXPECT_EQ(cube_root(-64.0), -4.0);
  expect_digest(0x72b120088dd3daa0U, digest, "cube roots");
}

TEST(SameEverywhere, CubeRootsOfVectors)
{
  RandomSource random(6);
  for (int n = 0; n < 20000; n++) {
    Vec8 numbers;
    for (int k = 0; k < lanes; k++)
      numbers[k] = std::ldexp(random.uniform(-2.0, 2.0), random.below(2000) - 1000);
    if (n % 3 == 0) numbers[n % lanes] = n % 2 ? 0.0 : -0.0;
    if (n % 100 == 0) numbers[n % lanes] = n % 200 ? 5e-320 : HUGE_VAL;
    const Vec8 roots = cube_root(numbers);
    for (int k = 0; k < lanes; k++) {
      const double alone = cube_root(numbers[k]), found = roots[k];
      ASSERT_EQ(std::memcmp(&alone, &found, sizeof alone), 0) << numbers[k];
    }
  }
}

}    // namespace
