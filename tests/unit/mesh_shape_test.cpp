// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Meshes are seamless: a sphere that drops, slides and rolls over a plane cut into triangles
// follows the same path as over a plane; convex and concave edges against closed forms.

#include "body/contact/body_contacts.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/plane.h"
#include "named_law.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace Talus;

namespace {

using V = Vector3<double>;
constexpr double pi = 3.14159265358979323846;

V talus(const std::array<double, 3> &a)
{
  return {a[0], a[1], a[2]};
}
/// A frame of three axes; the plane contains origin, e1 and e2.
struct Axes {
  V origin, e1, e2, normal;
  V at(double a, double b, double h) const { return origin + a * e1 + b * e2 + h * normal; }
};

Axes random_axes(RandomSource &random)
{
  Axes a;
  a.origin = talus(random.in_cube(1.0));
  a.normal = talus(random.unit_vector());
  const V other = talus(random.unit_vector());
  a.e1 = cross(a.normal, other);
  a.e1 = 1.0 / length(a.e1) * a.e1;
  a.e2 = cross(a.normal, a.e1);
  return a;
}

Eigen::AlignedBox3d box_around(const V &low, const V &high)
{
  return {to_eigen(low), to_eigen(high)};
}

/// Squares of the plane -half ... half, n along each side, each cut into two; inner corners may be
/// shaken within the plane.
std::vector<Triangle> cut_plane(const Axes &axes, double half, int n, double shake,
                                RandomSource &random)
{
  std::vector<V> corner((n + 1) * (n + 1));
  const double cell = 2.0 * half / n;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double s = inner ? shake * cell : 0.0;
      corner[j * (n + 1) + i] = axes.at(-half + i * cell + s * random.uniform(-1.0, 1.0),
                                        -half + j * cell + s * random.uniform(-1.0, 1.0), 0.0);
    }
  std::vector<Triangle> soup;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const V &a = corner[j * (n + 1) + i], &b = corner[j * (n + 1) + i + 1],
              &c = corner[(j + 1) * (n + 1) + i + 1], &d = corner[(j + 1) * (n + 1) + i];
      if ((i + j) % 2) {
        soup.push_back({{a, b, c}});
        soup.push_back({{a, c, d}});
      } else {
        soup.push_back({{a, b, d}});
        soup.push_back({{b, c, d}});
      }
    }
  return soup;
}

LawTable sliding_law()
{
  LawTable table;
  table.reset(1);
  named::Numbers c;
  c.kn = 2.0e4;
  c.gn = 20.0;
  c.kt = 6.0e3;
  c.gt = 10.0;
  c.mu = 0.4;
  c.force_floor = -1.0e300;
  named::set(table, 1, 1, {named::Normal::HERTZ, named::Tangential::MULTISTEP}, c);
  table.finish();
  return table;
}

/// One sphere under gravity in contact with a body, stepped by semi-implicit Euler.
class Roller {
 public:
  Roller(const LargeBodyShape &shape, const V &x0, const V &v0, const V &w0, const V &g) :
      shape(shape), gravity(g), x(x0), v(v0), w(w0)
  {
    contacts.set_laws(sliding_law());
    contacts.history.keep(shape.most_contacts() > 1, false);
    frame.origin = shape.reference_point();
  }

  void step(double dt)
  {
    if (traveled + dt * length(v) > 0.5 * skin || steps++ == 0) {
      contacts.find_candidates(shape, frame, view(), &mask, 1, skin);
      traveled = 0.0;
    }
    f = t = {0.0, 0.0, 0.0};
    BodyStep how;
    how.dt = dt;
    touched += contacts.compute(shape, frame, view(), how).contacts;
    v = v + dt * (1.0 / mass * f + gravity);
    w = w + (dt / (0.4 * mass * radius * radius)) * t;
    x = x + dt * v;
    traveled += dt * length(v);
  }

  const LargeBodyShape &shape;
  V gravity, x, v, w;
  double touched = 0.0;
  static constexpr double radius = 0.05, mass = 1.0, skin = 0.02;

 private:
  ParticleState view()
  {
    return {1, {&x.x, &v.x, &w.x, &size, &weight, nullptr, &f.x, &t.x}, &type};
  }

  BodyContacts contacts;
  BodyFrame frame;
  V f{}, t{};
  double traveled = 0.0;
  int steps = 0, mask = 1, type = 1;
  double size = radius, weight = mass;
};

class SeamlessPlane : public testing::TestWithParam<int> {};

// Drops, slides and rolls in 100 random directions over edges and corners.
TEST_P(SeamlessPlane, SamePathAsOnAPlane)
{
  RandomSource random(7);
  double worst = 0.0;
  int touched = 0;
  for (int direction = 0; direction < 100; direction++) {
    const Axes axes = random_axes(random);
    const int n = GetParam();
    const MeshShape mesh(TriangleMesh(cut_plane(axes, 1.0, n, n > 1 ? 0.2 : 0.0, random)),
                         MeshSide::NORMALS);
    const Plane plane(axes.origin, axes.normal, false);
    // aimed at a corner of the mesh or near it, from a little above the plane
    const double heading = random.uniform(0.0, 2.0 * pi), speed = random.uniform(0.2, 2.0);
    const V along = std::cos(heading) * axes.e1 + std::sin(heading) * axes.e2;
    const double aside = direction % 3 ? random.uniform(-0.01, 0.01) : 0.0;
    const V start = axes.at(0.0, 0.0, (direction % 2 ? 0.999 : 1.05) * Roller::radius) -
                    0.3 * along + aside * cross(axes.normal, along);
    const bool rolls = direction % 4 < 2;
    const V spin = rolls ? (speed / Roller::radius) * cross(axes.normal, along)
                         : 3.0 * talus(random.unit_vector());
    const V gravity = -9.81 * axes.normal;
    Roller on_mesh(mesh, start, speed * along, spin, gravity),
        on_plane(plane, start, speed * along, spin, gravity);
    for (int step = 0; step < 600; step++) {
      on_mesh.step(5.0e-4);
      on_plane.step(5.0e-4);
      worst = std::max(worst, length(on_mesh.x - on_plane.x) / Roller::radius);
      ASSERT_EQ(on_mesh.touched, on_plane.touched) << "direction " << direction << " step " << step;
    }
    touched += on_plane.touched > 50;
    worst = std::max(worst, length(on_mesh.w - on_plane.w) / (1.0 + length(on_plane.w)));
  }
  EXPECT_LT(worst, 1.0e-9);
  EXPECT_GT(touched, 90);
  RecordProperty("worst", std::to_string(worst));
  std::printf("largest distance of the paths: %.2g radii\n", worst);
}

// 2, 800 and, on the finest, 10 082 triangles
INSTANTIATE_TEST_SUITE_P(Cuts, SeamlessPlane, testing::Values(1, 20, 71));

/// Two half planes that meet along the y axis with a dihedral angle, each 4 x 4; `bend` > 0: a
/// ridge.
MeshShape roof(double bend)
{
  const double c = 4.0 * std::cos(0.5 * bend), s = -4.0 * std::sin(0.5 * bend);
  const V a{0, -2, 0}, b{0, 2, 0}, left0{-c, -2, s}, left1{-c, 2, s}, right0{c, -2, s},
      right1{c, 2, s};
  return MeshShape(
      TriangleMesh({{{a, b, left0}}, {{left0, b, left1}}, {{b, a, right0}}, {{b, right0, right1}}}),
      MeshSide::NORMALS);
}

TEST(MeshEdges, RidgeTouchesOnceWithTheNormalFromTheEdge)
{
  const double bend = 1.0, r = 0.3;
  const MeshShape mesh = roof(bend);
  for (const double tilt : {-0.4, -0.1, 0.0, 0.2, 0.45}) {    // within the fan of normals
    const V n{std::sin(tilt), 0.0, std::cos(tilt)};
    std::vector<NearPart> parts;
    SurfaceContact found[LargeBodyShape::max_contacts];
    const V x = V{0.0, 0.13, 0.0} + 0.25 * n;
    ASSERT_TRUE(mesh.is_near(x, r, parts));
    ASSERT_EQ(mesh.find_contacts(x, r, {parts.data(), parts.data() + parts.size()}, found), 1);
    EXPECT_NEAR(found[0].overlap, 0.05, 1e-14);
    EXPECT_NEAR(length(found[0].normal - n), 0.0, 1e-13);
  }
  SurfaceContact contact;
  EXPECT_FALSE(mesh.touches({0.0, 0.0, -0.1}, r, contact));    // behind
}

TEST(MeshEdges, ValleyTouchesBothSides)
{
  const double bend = -1.2, r = 0.3;
  const MeshShape mesh = roof(bend);
  const V left{std::sin(0.6), 0.0, std::cos(0.6)}, right{-std::sin(0.6), 0.0, std::cos(0.6)};
  const V x{0.01, -0.4, 0.34};
  std::vector<NearPart> parts;
  SurfaceContact found[LargeBodyShape::max_contacts];
  ASSERT_TRUE(mesh.is_near(x, r, parts));
  ASSERT_EQ(mesh.find_contacts(x, r, {parts.data(), parts.data() + parts.size()}, found), 2);
  // deepest first: that of the right side
  EXPECT_NEAR(length(found[0].normal - right), 0.0, 1e-13);
  EXPECT_NEAR(found[0].overlap, r - dot(x, right), 1e-13);
  EXPECT_NEAR(length(found[1].normal - left), 0.0, 1e-13);
  EXPECT_NEAR(found[1].overlap, r - dot(x, left), 1e-13);
}

TEST(MeshEdges, CornerAndRimOfASheet)
{
  const MeshShape sheet(TriangleMesh({{{V{0, 0, 0}, V{1, 0, 0}, V{1, 1, 0}}},
                                      {{V{0, 0, 0}, V{1, 1, 0}, V{0, 1, 0}}}}),
                        MeshSide::NORMALS);
  SurfaceContact contact;
  const V at_corner{-0.1, -0.2, 0.2};
  ASSERT_TRUE(sheet.touches(at_corner, 0.4, contact));
  EXPECT_NEAR(contact.overlap, 0.4 - 0.3, 1e-15);
  EXPECT_NEAR(length(contact.normal - 1.0 / 0.3 * at_corner), 0.0, 1e-15);
  ASSERT_TRUE(sheet.touches({0.5, -0.3, 0.4}, 0.6, contact));
  EXPECT_NEAR(contact.overlap, 0.1, 1e-15);
  EXPECT_NEAR(length(contact.normal - V{0.0, -0.6, 0.8}), 0.0, 1e-15);
  EXPECT_FALSE(sheet.touches({0.5, -0.3, -0.4}, 0.6, contact));
}

// A tube of facets: the contact goes from facet to facet without a jump of the force.
TEST(MeshEdges, FacetsOfABasinAreOneSmoothPatch)
{
  constexpr int facets = 40;
  std::vector<Triangle> soup;
  const auto point = [](int k, double z) {
    const double a = 2.0 * pi * k / facets;
    return V{std::cos(a), std::sin(a), z};
  };
  for (int k = 0; k < facets; k++) {    // normals to the axis
    soup.push_back({{point(k, -1), point(k, 1), point(k + 1, -1)}});
    soup.push_back({{point(k + 1, -1), point(k, 1), point(k + 1, 1)}});
  }
  // equal corners must have equal coordinates
  for (Triangle &t : soup)
    for (V &p : t.corner)
      if (std::fabs(p.x - 1.0) < 1e-9) p = {1.0, 0.0, p.z};
  const MeshShape tube(TriangleMesh(soup), MeshSide::NORMALS);
  const double r = 0.2;
  double last = -1.0;
  for (int k = 0; k <= 2000; k++) {
    const double a = 1.3 * k / 2000.0;
    const V x{0.802 * std::cos(a), 0.802 * std::sin(a), 0.07};
    std::vector<NearPart> parts;
    SurfaceContact found[LargeBodyShape::max_contacts];
    ASSERT_TRUE(tube.is_near(x, r, parts));
    ASSERT_EQ(tube.find_contacts(x, r, {parts.data(), parts.data() + parts.size()}, found), 1);
    if (last >= 0.0) {
      EXPECT_NEAR(found[0].overlap, last, 1e-4);
    }
    last = found[0].overlap;
  }
}

// Whatever the tree leaves out is too far away.
TEST(MeshTree, FindsWhatASearchOfAllTrianglesFinds)
{
  RandomSource random(3);
  const Axes axes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Triangle> soup = cut_plane(axes, 1.0, 12, 0.3, random);
  for (Triangle &t : soup)
    for (V &p : t.corner) p.z = 0.2 * std::sin(3.0 * p.x) * std::cos(2.0 * p.y);
  const TriangleMesh surface(soup);
  const MeshDetail all(surface, surface.bounds());
  const MeshShape mesh(surface, MeshSide::BOTH);
  for (int n = 0; n < 300; n++) {
    const V x = talus(random.in_cube(1.3));
    const double reach = random.uniform(0.05, 0.6);
    std::vector<NearPart> parts;
    mesh.is_near(x, reach, parts);
    std::vector<int> found, expected;
    for (const NearPart &p : parts) found.push_back(p.part);
    double least = 1e300;
    for (int t = 0; t < all.size(); t++) {
      const double d = std::sqrt(all.nearest(t, x).square);
      least = std::min(least, d);
      if (d < reach) expected.push_back(t);
    }
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
    EXPECT_DOUBLE_EQ(mesh.distance_bound(x), least);
  }
}

// What a rank holds near its particles gives the same contacts, bit for bit, as the whole mesh.
TEST(MeshFocus, GivesTheContactsOfTheWhole)
{
  RandomSource random(8);
  const Axes axes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Triangle> soup = cut_plane(axes, 1.0, 24, 0.0, random);
  for (Triangle &t : soup)
    for (V &p : t.corner)    // hills, and beyond them a plane
      p.z = p.x < 0.3 ? 0.2 * std::sin(7.0 * (p.x - 0.3)) * std::cos(5.0 * p.y) : 0.0;
  const MeshShape whole(TriangleMesh(soup), MeshSide::BOTH);
  MeshShape part(TriangleMesh(soup), MeshSide::BOTH, true);
  EXPECT_EQ(part.size_of_detail(), 0);
  EXPECT_TRUE(part.wants_focus());
  int compared = 0;
  for (const V &corner : {V{-0.8, -0.7, 0}, V{-0.2, 0.1, 0}, V{0.2, -0.4, 0}}) {
    EXPECT_TRUE(part.focus(box_around(corner - V{0, 0, 1}, corner + V{0.4, 0.4, 1})));
    EXPECT_FALSE(part.focus(box_around(corner, corner + V{0.3, 0.3, 1}))) << "within what there is";
    EXPECT_LT(part.size_of_detail(), whole.size_of_detail() / 2);
    EXPECT_LT(part.memory_usage(), 0.7 * whole.memory_usage());
    for (int n = 0; n < 400; n++) {
      const double r = random.uniform(0.05, 0.1);
      const V x{corner.x + random.uniform(r, 0.4 - r), corner.y + random.uniform(r, 0.4 - r),
                random.uniform(-0.25, 0.25)};
      std::vector<NearPart> near_whole, near_part;
      whole.is_near(x, r, near_whole);
      part.is_near(x, r, near_part);
      SurfaceContact a[LargeBodyShape::max_contacts], b[LargeBodyShape::max_contacts];
      const int count =
          whole.find_contacts(x, r, {near_whole.data(), near_whole.data() + near_whole.size()}, a);
      ASSERT_EQ(
          part.find_contacts(x, r, {near_part.data(), near_part.data() + near_part.size()}, b),
          count);
      for (int k = 0; k < count; k++, compared++) {
        EXPECT_EQ(a[k].part, b[k].part);
        EXPECT_EQ(a[k].overlap, b[k].overlap);
        EXPECT_EQ(a[k].normal.x, b[k].normal.x);
        EXPECT_EQ(a[k].normal.y, b[k].normal.y);
        EXPECT_EQ(a[k].normal.z, b[k].normal.z);
      }
    }
  }
  EXPECT_GT(compared, 300);
  constexpr double far = 1.0e9;
  EXPECT_FALSE(part.focus(Eigen::AlignedBox3d())) << "no particles";
  EXPECT_TRUE(part.focus(box_around({-far, -far, -far}, {far, far, far})));
  EXPECT_FALSE(part.wants_focus());
  EXPECT_EQ(part.size_of_detail(), whole.size_of_detail());
}

TEST(MeshReportTest, SaysWhatIsWrong)
{
  const V a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1}, e{1, 1, 1};
  const std::vector<Triangle> tetrahedron{{{a, c, b}}, {{a, b, d}}, {{b, c, d}}, {{a, d, c}}};
  const TriangleMesh closed(tetrahedron);
  EXPECT_TRUE(closed.report().closed());
  EXPECT_NEAR(closed.volume(), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(length(closed.center() - V{0.25, 0.25, 0.25}), 0.0, 1e-15);

  std::vector<Triangle> soup = tetrahedron;
  soup.push_back({{a, b, 2.0 * b}});    // no area
  soup.push_back({{c, b, a}});          // there already
  soup.push_back({{a, b, e}});          // a third triangle at the edge a b
  const TriangleMesh broken(soup);
  EXPECT_EQ(broken.report().degenerate, 1);
  EXPECT_EQ(broken.report().first_degenerate, 5);
  EXPECT_EQ(broken.report().duplicate, 1);
  EXPECT_EQ(broken.report().first_duplicate, 6);
  EXPECT_EQ(broken.report().nonmanifold_edges, 1);
  EXPECT_EQ(broken.report().first_nonmanifold, 7);
  EXPECT_EQ(broken.report().open_edges, 2);
  EXPECT_EQ(broken.number_in_file(4), 6);

  std::vector<Triangle> turned = tetrahedron;
  std::swap(turned[3].corner[0], turned[3].corner[1]);
  EXPECT_EQ(TriangleMesh(turned).report().inconsistent_edges, 3);
  const std::vector<Triangle> flat{{{a, b, 2.0 * b}}};
  EXPECT_THROW(TriangleMesh{flat}, std::runtime_error);
}

}    // namespace
