// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random pairs of convex bodies: whether they touch against libccd, distances and depths against all parts of both,
// exchange of the bodies, and that nothing depends on what is known from before. TALUS_LARGE_TESTS=1: a million pairs.

#include "convex_bodies.h"
#include "shape/convex/collide.h"
#include "shape/convex/shared_energy.h"

#include <ccd/ccd.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

int number_of_pairs()
{
  return std::getenv("TALUS_LARGE_TESTS") ? 1000000 : 20000;
}

/* ---- all parts of both ----------------------------------------------------------------------- */

struct Body {
  const ConvexShape *shape;
  Pose pose;
  Points vertices, normals;

  Body(const ConvexShape &s, const Pose &p) : shape(&s), pose(p)
  {
    for (int v = 0; v < s.core().num_vertices(); v++)
      vertices.push_back(p.point_in_space(s.core().vertex(v)));
    for (int f = 0; f < s.core().num_faces(); f++)
      normals.push_back(p.direction_in_space(s.core().normal(f)));
  }
  double highest(const Vector &n) const
  {
    double h = dot(n, vertices[0]);
    for (const Vector &x : vertices) h = std::max(h, dot(n, x));
    return h;
  }
};

double distance_from_segment(const Vector &x, const Vector &from, const Vector &along)
{
  const double t = std::clamp(dot(x - from, along) / dot(along, along), 0.0, 1.0);
  return length(x - from - t * along);
}

double distance_of_segments(const Vector &p, const Vector &u, const Vector &q, const Vector &w)
{
  double least =
      std::min(std::min(distance_from_segment(p, q, w), distance_from_segment(p + u, q, w)),
               std::min(distance_from_segment(q, p, u), distance_from_segment(q + w, p, u)));
  const Vector d = p - q;
  const double uu = dot(u, u), ww = dot(w, w), uw = dot(u, w), ud = dot(u, d), wd = dot(w, d);
  const double det = uu * ww - uw * uw;
  if (det > 1e-14 * uu * ww) {
    const double s = (uw * wd - ud * ww) / det, t = (uu * wd - uw * ud) / det;
    if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)
      least = std::min(least, length(d + s * u - t * w));
  }
  return least;
}

double distance_from_faces(const Vector &x, const Body &body)
{
  const ConvexCore &core = body.shape->core();
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < core.num_faces(); f++) {
    bool over = true;
    for (int k = 0; k < core.num_corners(f); k++) {
      const Vector from = body.vertices[core.corners(f)[k]],
                   to = body.vertices[core.corners(f)[(k + 1) % core.num_corners(f)]];
      over = over && dot(cross(body.normals[f], to - from), x - from) >= 0.0;
    }
    const double height = dot(body.normals[f], x - body.vertices[core.corners(f)[0]]);
    if (over && height >= 0.0) least = std::min(least, height);
  }
  return least;
}

/// Of a point outside.
double distance_from_core(const Vector &x, const Body &body)
{
  double least = distance_from_faces(x, body);
  const ConvexCore &core = body.shape->core();
  for (int e = 0; e < core.num_edges(); e++) {
    const Vector from = body.vertices[core.edge(e).vertex[0]];
    least = std::min(least,
                     distance_from_segment(x, from, body.vertices[core.edge(e).vertex[1]] - from));
  }
  return least;
}

/// Of cores that are apart; and of the edges that are nearest to each other, if they are nearer than all faces and
/// vertices are, how far their ends are from the other core.
struct Distance {
  double least;
  std::vector<double> of_ends;
};

Distance distance_of_cores(const Body &a, const Body &b)
{
  Distance distance{std::numeric_limits<double>::infinity(), {}};
  for (const Vector &x : a.vertices)
    distance.least = std::min(distance.least, distance_from_core(x, b));
  for (const Vector &x : b.vertices)
    distance.least = std::min(distance.least, distance_from_core(x, a));
  const ConvexCore &core_a = a.shape->core(), &core_b = b.shape->core();
  for (int e = 0; e < core_a.num_edges(); e++)
    for (int f = 0; f < core_b.num_edges(); f++) {
      const Vector p = a.vertices[core_a.edge(e).vertex[0]],
                   q = b.vertices[core_b.edge(f).vertex[0]],
                   p_end = a.vertices[core_a.edge(e).vertex[1]],
                   q_end = b.vertices[core_b.edge(f).vertex[1]];
      const double here = distance_of_segments(p, p_end - p, q, q_end - q);
      if (here >= distance.least) continue;
      distance = {here,
                  {distance_from_core(p, b), distance_from_core(p_end, b), distance_from_core(q, a),
                   distance_from_core(q_end, a)}};
    }
  return distance;
}

/// Whether two edges that overlap are left out, since their ends are all but as deep.
bool are_left_out(double overlap, double reach, const std::vector<double> &of_ends)
{
  SharedEnergy energy;
  energy.begin(overlap, 1.0);
  for (const double distance : of_ends) energy.add_end(0, reach - distance);
  return !of_ends.empty() && !energy.finish();
}

/// Of cores that overlap; negative if they do not.
double depth_of_cores(const Body &a, const Body &b)
{
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Vector &n) { least = std::min(least, b.highest(n) + a.highest(-n)); };
  for (const Vector &n : a.normals) look(-n);
  for (const Vector &n : b.normals) look(n);
  const ConvexCore &core_a = a.shape->core(), &core_b = b.shape->core();
  for (int e = 0; e < core_a.num_edges(); e++)
    for (int f = 0; f < core_b.num_edges(); f++) {
      const Vector u = a.vertices[core_a.edge(e).vertex[1]] - a.vertices[core_a.edge(e).vertex[0]];
      const Vector w = b.vertices[core_b.edge(f).vertex[1]] - b.vertices[core_b.edge(f).vertex[0]];
      const Vector n = cross(u, w);
      const double size = length(n);
      if (size < 1e-5 * length(u) * length(w)) continue;
      look((1.0 / size) * n);
      look((-1.0 / size) * n);
    }
  return least;
}

/* ---- libccd ---------------------------------------------------------------------------------- */

void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
  const Body &body = *static_cast<const Body *>(object);
  const Vector d{direction->v[0], direction->v[1], direction->v[2]};
  Vector best = body.vertices[0];
  for (const Vector &x : body.vertices)
    if (dot(d, x) > dot(d, best)) best = x;
  best = best + (body.shape->radius() / length(d)) * d;
  ccdVec3Set(point, best.x, best.y, best.z);
}

bool intersect_by_libccd(const Body &a, const Body &b)
{
  ccd_t options;
  CCD_INIT(&options);
  options.support1 = options.support2 = support;
  options.max_iterations = 500;
  return ccdGJKIntersect(&a, &b, &options) != 0;
}

/* ---- pairs ----------------------------------------------------------------------------------- */

std::vector<ConvexShape> some_shapes(RandomBodies &random, double rounding)
{
  std::vector<ConvexShape> shapes;
  shapes.push_back(ConvexShape::box({1.0, 1.0, 1.0}, rounding));
  shapes.push_back(ConvexShape::box({1.0, 0.5, 0.2}, rounding));
  shapes.push_back(ConvexShape::polyhedron(
      {{0.5, 0, 0}, {0, 0.6, 0}, {0, 0, 0.7}, {-0.3, -0.3, -0.3}}, rounding));
  Points small = dodecahedron_corners();
  for (Vector &x : small) x = 0.4 * x;
  shapes.push_back(ConvexShape::polyhedron(small, rounding));
  for (const int count : {5, 9, 16})
    shapes.push_back(ConvexShape::polyhedron(random.corners(count, {0.6, 0.5, 0.4}), rounding));
  return shapes;
}

struct Case {
  const ConvexShape *a, *b;
  Pose pose_a, pose_b;
};

Case random_case(RandomBodies &random, const std::vector<ConvexShape> &shapes)
{
  Case c;
  c.a = &shapes[random.below(static_cast<int>(shapes.size()))];
  c.b = &shapes[random.below(static_cast<int>(shapes.size()))];
  c.pose_a = Pose({3.0, -2.0, 1.0}, random.orientation());
  const double reach = c.a->bounding_radius() + c.b->bounding_radius();
  // one after the other: the order of arguments is the compiler's choice
  const Eigen::Quaterniond rotation = random.orientation();
  const Vector toward = random.direction();
  c.pose_b = Pose(c.pose_a.position + (reach * random.uniform(0.3, 1.0)) * toward, rotation);
  if (random.chance(0.1)) c.pose_b.rotation = c.pose_a.rotation;    // parallel faces and edges
  return c;
}

double deepest(const ShapeContacts &contacts)
{
  double overlap = 0.0;
  for (const ShapeContact &c : contacts.points) overlap = std::max(overlap, c.overlap);
  return overlap;
}

/* Single weights may be negative; all contacts together repel along the deepest one about as much as it would alone:
   half of that at least, but where one that is nearly as deep is at a right angle to it. So one pair of a hundred
   thousand may repel less, and none attracts. */

bool repels(const ShapeContacts &contacts)
{
  if (contacts.points.empty() || contacts.cores_overlap) return true;
  const ShapeContact *most = &contacts.points[0];
  Vector force{0.0, 0.0, 0.0};
  for (const ShapeContact &c : contacts.points) {
    if (c.overlap > most->overlap) most = &c;
    force = force + (c.weight * c.overlap) * c.normal;
  }
  EXPECT_GT(dot(force, most->normal), 0.0);
  return dot(force, most->normal) > 0.5 * most->overlap;
}

/* Energies are powers of overlaps, and so the work of the forces on all overlaps, if they grow in proportion, is that
   power of the energy (Euler's theorem). Of one that two edges share with their ends, each of which keeps its own,
   prod (1 - p/.9) + sum p is left, or more, which is 1 - sum p/9 if sum p < .9, and is .9 at least. */

void expect_shared_energy(const ShapeContacts &contacts)
{
  double work = 0.0, energy = 0.0, most = 0.0;
  for (const ShapeContact &c : contacts.points) {
    work += c.weight * c.overlap * c.overlap;
    energy += c.energy * c.overlap * c.overlap;
    most = std::max(most, c.overlap * c.overlap);
  }
  EXPECT_NEAR(work, energy, 1e-12);
  EXPECT_GE(energy, 0.9 * most - 1e-12);
}

void expect_sound(const ShapeContacts &contacts)
{
  for (std::size_t k = 0; k < contacts.points.size(); k++) {
    const ShapeContact &c = contacts.points[k];
    EXPECT_GT(c.overlap, 0.0);
    EXPECT_TRUE(std::isfinite(c.weight));
    EXPECT_NEAR(length(c.normal), 1.0, 1e-9);
    EXPECT_TRUE(std::isfinite(c.position.x + c.position.y + c.position.z));
    if (k > 0) {
      EXPECT_LT(contacts.points[k - 1].name, c.name);
    }
  }
}

}    // namespace

TEST(ConvexFuzz, SharpPairsAgainstLibccdAndAllParts)
{
  RandomBodies random(1);
  const std::vector<ConvexShape> shapes = some_shapes(random, 0.0);
  ShapeContacts contacts;
  int touching = 0, compared = 0, wrong = 0, weak = 0;
  double worst = 0.0;
  for (int trial = 0; trial < number_of_pairs(); trial++) {
    const Case c = random_case(random, shapes);
    SeparatingDirection direction;
    const bool touch = collide(*c.a, c.pose_a, *c.b, c.pose_b, direction, contacts);
    touching += touch;
    expect_sound(contacts);
    weak += !repels(contacts);
    const Body a(*c.a, c.pose_a), b(*c.b, c.pose_b);
    if (touch != intersect_by_libccd(a, b)) {
      const double depth = depth_of_cores(a, b);
      if (std::fabs(depth) > 1e-6) {
        wrong++;
        ADD_FAILURE() << "pair " << trial << " touch " << touch << " depth " << depth;
      }
    }
    if (trial % 20 || !touch) continue;
    compared++;
    const double depth = depth_of_cores(a, b);
    // no contact is deeper than the least depth, and one is as deep
    worst = std::max(worst, std::fabs(deepest(contacts) - depth));
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(weak, number_of_pairs() / 100000);
  EXPECT_GT(touching, number_of_pairs() / 5);
  EXPECT_GT(compared, 100);
  EXPECT_LT(worst, 1e-9);
}

TEST(ConvexFuzz, RoundedPairsAgainstLibccdAndAllParts)
{
  RandomBodies random(2);
  const std::vector<ConvexShape> shapes = some_shapes(random, 0.1);
  ShapeContacts contacts;
  int touching = 0, apart = 0, wrong = 0, weak = 0, left_out = 0;
  double worst = 0.0;
  for (int trial = 0; trial < number_of_pairs(); trial++) {
    const Case c = random_case(random, shapes);
    SeparatingDirection direction;
    const bool touch = collide(*c.a, c.pose_a, *c.b, c.pose_b, direction, contacts);
    touching += touch && !contacts.cores_overlap;
    expect_sound(contacts);
    weak += !repels(contacts);
    if (!contacts.cores_overlap) expect_shared_energy(contacts);
    const Body a(*c.a, c.pose_a), b(*c.b, c.pose_b);
    if (touch != intersect_by_libccd(a, b)) {
      const double depth = 0.2 - distance_of_cores(a, b).least;
      if (std::fabs(depth) > 1e-3 * 0.2) {    // libccd gives up on round bodies that all but touch
        wrong++;
        ADD_FAILURE() << "pair " << trial << " touch " << touch << " overlap " << depth;
      }
    }
    if (trial % 10 || contacts.cores_overlap) continue;
    const Distance distance = distance_of_cores(a, b);
    const double overlap = 0.2 - distance.least;
    if (!touch) {
      EXPECT_LE(overlap, 1e-12);
      apart++;
    } else if (are_left_out(overlap, 0.2, distance.of_ends)) {
      EXPECT_LT(deepest(contacts), overlap + 1e-12);
      left_out++;
    } else {
      worst = std::max(worst, std::fabs(overlap - deepest(contacts)));
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(weak, number_of_pairs() / 100000);
  EXPECT_GT(touching, number_of_pairs() / 10);
  EXPECT_GT(apart, 100);
  EXPECT_LT(left_out, number_of_pairs() / 1000);
  EXPECT_LT(worst, 1e-12);
}

TEST(ConvexFuzz, ExchangedBodiesHaveTheSameContacts)
{
  RandomBodies random(3);
  ShapeContacts one, other;
  int compared = 0;
  for (const double rounding : {0.0, 0.1}) {
    const std::vector<ConvexShape> shapes = some_shapes(random, rounding);
    for (int trial = 0; trial < number_of_pairs() / 4; trial++) {
      const Case c = random_case(random, shapes);
      SeparatingDirection direction, exchanged;
      collide(*c.a, c.pose_a, *c.b, c.pose_b, direction, one);
      collide(*c.b, c.pose_b, *c.a, c.pose_a, exchanged, other);
      for (ShapeContact &contact : other.points) contact.name = exchanged_name(contact.name);
      std::sort(other.points.begin(), other.points.end(),
                [](const ShapeContact &p, const ShapeContact &q) { return p.name < q.name; });
      // deep within each other, parallel bodies have several directions of least depth
      if (c.pose_a.rotation == c.pose_b.rotation && deepest(one) > 0.05 + 2.0 * rounding) continue;
      compared++;
      ASSERT_EQ(one.points.size(), other.points.size()) << trial << " rounding " << rounding;
      for (std::size_t k = 0; k < one.points.size(); k++) {
        const ShapeContact &p = one.points[k], &q = other.points[k];
        EXPECT_EQ(p.name, q.name) << trial;
        EXPECT_LT(length(p.position - q.position), 1e-9) << trial;
        // points that share a force lean by its torque over the square of their spread: rounding over the least share
        EXPECT_LT(length(p.normal + q.normal), std::max(1e-9, 1e-12 / std::fabs(p.weight)))
            << trial;
        EXPECT_NEAR(p.overlap, q.overlap, 1e-10);
        EXPECT_NEAR(p.weight, q.weight, 1e-7);
      }
    }
  }
  EXPECT_GT(compared, number_of_pairs() / 3);
}

TEST(ConvexFuzz, ContactsDoNotDependOnTheDirectionThatIsKnown)
{
  RandomBodies random(4);
  ShapeContacts one, other;
  for (const double rounding : {0.0, 0.1}) {
    const std::vector<ConvexShape> shapes = some_shapes(random, rounding);
    for (int trial = 0; trial < number_of_pairs() / 4; trial++) {
      const Case c = random_case(random, shapes);
      SeparatingDirection none, known;
      known.direction = random.direction();
      collide(*c.a, c.pose_a, *c.b, c.pose_b, none, one);
      for (int again = 0; again < 2; again++) {
        collide(*c.a, c.pose_a, *c.b, c.pose_b, known, other);
        ASSERT_EQ(one.points.size(), other.points.size()) << trial;
        for (std::size_t k = 0; k < one.points.size(); k++) {
          const ShapeContact &p = one.points[k], &q = other.points[k];
          EXPECT_EQ(p.name, q.name);
          EXPECT_EQ(std::memcmp(&p.position, &q.position, sizeof p.position), 0);
          EXPECT_EQ(std::memcmp(&p.normal, &q.normal, sizeof p.normal), 0);
          EXPECT_EQ(p.overlap, q.overlap);
          EXPECT_EQ(p.weight, q.weight);
        }
      }
    }
  }
}

/* libccd's MPR starts from the centers: its depth is that along the line of centers, refined, and at least the least
   depth. */

TEST(ConvexFuzz, MprFindsTheSamePairs)
{
  RandomBodies random(5);
  ShapeContacts mpr, features;
  for (const double rounding : {0.0, 0.1}) {
    const std::vector<ConvexShape> shapes = some_shapes(random, rounding);
    int different = 0, touching = 0, weak = 0;
    for (int trial = 0; trial < number_of_pairs() / 4; trial++) {
      const Case c = random_case(random, shapes);
      SeparatingDirection direction, none;
      const bool by_mpr = collide(*c.a, c.pose_a, *c.b, c.pose_b, direction, mpr, NarrowPhase::MPR);
      const bool touch = collide(*c.a, c.pose_a, *c.b, c.pose_b, none, features);
      expect_sound(mpr);
      weak += !repels(mpr);
      touching += touch;
      if (by_mpr != touch && deepest(features) + deepest(mpr) > 1e-5) different++;
      if (!by_mpr || !touch) continue;
      EXPECT_EQ(mpr.points.size(), 1U);
      EXPECT_GT(deepest(mpr), deepest(features) - 1e-4);
    }
    EXPECT_GT(touching, 100);
    EXPECT_EQ(different, 0);
    EXPECT_EQ(weak, 0);
  }
}
