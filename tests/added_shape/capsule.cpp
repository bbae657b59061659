// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A shape that Talus does not have, added by one file: a capsule, the points nearer than r to a piece of
// the z axis of length L. Words: capsule L r. Two capsules, and a capsule and a sphere, touch at one
// point, as two spheres at the nearest points of their axes; all else touches both ends, and what is
// deepest between them, which shares its energy with the ends (shape/convex/shared_energy.h).

#include "body/shape/mesh_shape.h"
#include "shape/contact/shape_list.h"
#include "shape/convex/convex_shape.h"
#include "shape/convex/core_pair.h"
#include "shape/convex/shared_energy.h"
#include "shape/surface.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;
constexpr double pi = 3.14159265358979323846;

class Capsule : public Shape {
 public:
  Capsule(double length, double cap_radius) : half(0.5 * length), radius(cap_radius) {}

  const double half, radius;

  const char *name() const override { return "capsule"; }
  double bounding_radius() const override { return half + radius; }
  double inscribed_radius() const override { return radius; }
  double contact_radius() const override { return radius; }
  double volume() const override { return of_cylinder() + of_ball(); }
  Eigen::Vector3d principal_moments() const override
  {
    const double r2 = radius * radius, l = 2.0 * half;
    const double across = of_cylinder() * (l * l / 12.0 + 0.25 * r2) +
                          of_ball() * (0.4 * r2 + half * half + 0.375 * l * radius);
    return {across, across, of_cylinder() * 0.5 * r2 + of_ball() * 0.4 * r2};
  }
  std::vector<HeldFace> held_faces() const override
  {
    std::vector<HeldFace> faces;
    for (const double end : {-1.0, 1.0})
      faces.push_back({{0, 0, end}, {{{0, 0, end * bounding_radius()}, 1.0}}});
    for (int k = 0; k < 8; k++) {
      const Vector n{std::cos(0.25 * pi * k), std::sin(0.25 * pi * k), 0.0}, end{0.0, 0.0, half};
      faces.push_back({n, {{radius * n - end, 1.0}, {radius * n + end, 1.0}}});
    }
    return faces;
  }
  std::vector<Triangle> surface(int pieces) const override
  {
    std::vector<Triangle> triangles;
    const int around = 4 * pieces, rows = 2 * pieces;
    const auto point = [&](int row, int k) {    // twice the row in the middle, once for each end
      const double up = 0.5 * pi * (std::min(row, std::max(row - 1, pieces)) - pieces) / pieces;
      const double turn = 2.0 * pi * k / around, away = radius * std::cos(up);
      return Vector{away * std::cos(turn), away * std::sin(turn),
                    radius * std::sin(up) + (row > pieces ? half : -half)};
    };
    for (int row = 0; row <= rows; row++)
      for (int k = 0; k < around; k++) {
        const Vector a = point(row, k), b = point(row, k + 1), c = point(row + 1, k + 1),
                     d = point(row + 1, k);
        if (row > 0) triangles.push_back({{a, b, c}});
        if (row < rows) triangles.push_back({{a, c, d}});
      }
    return triangles;
  }
  double memory_usage() const override { return sizeof(*this); }

 private:
  double of_cylinder() const { return 2.0 * half * pi * radius * radius; }
  double of_ball() const { return 4.0 / 3.0 * pi * radius * radius * radius; }
};

using AtPlace = Placed<Capsule>;

class Touch {
 public:
  Touch(const AtPlace &placed_capsule, const CollisionRequest &collision_request,
        ShapeContacts &found_contacts) :
      capsule(placed_capsule),
      how(collision_request), contacts(found_contacts)
  {
    contacts.clear();
  }

  /// Of the point of the axis at s = -1 ... 1.
  Vector place(double s) const
  {
    return capsule.pose.point_in_space({0.0, 0.0, s * capsule.geometry.half});
  }

  void add(const Vector &x, const SurfaceContact &found, double curvature, std::uint32_t name)
  {
    ShapeContact contact;
    contact.normal = found.normal;
    contact.overlap = found.overlap;
    contact.position = x - (capsule.geometry.radius - 0.5 * found.overlap) * found.normal;
    contact.weight = 1.0;
    contact.curvature[0] = 1.0 / capsule.geometry.radius;
    contact.curvature[1] = curvature;
    contact.name = name;
    contact.part = found.part;
    contact.surface = static_cast<std::uint32_t>(found.part);
    contacts.points.push_back(contact);
  }

  /// find(x, radius, found): contacts of a sphere, at most LargeBodyShape::max_contacts, deepest first.
  template <class Find> bool ends_and_middle(Find find, double curvature = 0.0)
  {
    SurfaceContact found[LargeBodyShape::max_contacts];
    for (const int end : {0, 1}) {
      const Vector x = place(end ? 1.0 : -1.0);
      const int count = find(x, capsule.geometry.radius, found);
      for (int k = 0; k < count; k++)
        add(x, found[k], curvature, contact_name(ContactParts::VERTEX_OF_A, end, 0));
    }
    const Vector axis = place(1.0) - place(0.0);
    const double reach = 2.0 * capsule.geometry.bounding_radius();
    const auto slope = [&](double s) {
      return find(place(s), reach, found) ? dot(found[0].normal, axis) : 0.0;
    };
    double below = -1.0, above = 1.0;
    if (!(slope(below) < 0.0 && slope(above) > 0.0)) return !contacts.points.empty();
    for (int n = 0; n < 50; n++) {
      const double middle = 0.5 * (below + above);
      (slope(middle) < 0.0 ? below : above) = middle;
    }
    if (find(place(below), capsule.geometry.radius, found))
      add_middle(place(below), found[0], curvature);
    return !contacts.points.empty();
  }

 private:
  void add_middle(const Vector &x, const SurfaceContact &found, double curvature)
  {
    SharedEnergy energy;
    energy.begin(found.overlap, how.force_exponent);
    for (int k = 0; k < static_cast<int>(contacts.points.size()); k++)
      energy.add_end(k, contacts.points[k].overlap);
    if (!energy.finish()) return;
    add(x, found, curvature, contact_name(ContactParts::EDGES, 0, 0));
    contacts.points.back().weight = energy.weight();
    contacts.points.back().energy = energy.energy();
    energy.take_from(contacts.points);
  }

  const AtPlace &capsule;
  const CollisionRequest &how;
  ShapeContacts &contacts;
};

bool with_flat(const AtPlace &a, const Placed<FlatSurface> &b, const CollisionRequest &how,
               ShapeContacts &contacts)
{
  const FlatSurface &plane = b.geometry;
  const double center = dot(plane.normal, a.pose.position) - plane.offset;
  const double side = plane.two_sided && center < 0.0 ? -1.0 : 1.0;
  Touch touch(a, how, contacts);
  if (side * center <= -a.geometry.bounding_radius()) return false;
  return touch.ends_and_middle([&](const Vector &x, double radius, SurfaceContact *found) {
    found->normal = side * plane.normal;
    found->overlap = radius - side * (dot(plane.normal, x) - plane.offset);
    found->part = plane.part;
    return found->overlap > 0.0 ? 1 : 0;
  });
}

bool with_mesh(const AtPlace &a, const Placed<MeshSurface> &b, const CollisionRequest &how,
               ShapeContacts &contacts)
{
  std::vector<NearPart> parts;
  b.geometry.shape->is_near(a.pose.position, 3.0 * a.geometry.bounding_radius(), parts);
  const NearParts near{parts.data(), parts.data() + parts.size()};
  return Touch(a, how, contacts)
      .ends_and_middle([&](const Vector &x, double radius, SurfaceContact *found) {
        return b.geometry.shape->find_contacts(x, radius, near, found);
      });
}

bool with_convex(const AtPlace &a, const Placed<ConvexShape> &b, const CollisionRequest &how,
                 ShapeContacts &contacts)
{
  Touch touch(a, how, contacts);
  const double reach = a.geometry.bounding_radius() + b.geometry.bounding_radius();
  if (length(a.pose.position - b.pose.position) >= reach) return false;
  const auto find = [&](const Vector &x, double radius, SurfaceContact *found) {
    const CorePoint nearest = nearest_point(b.geometry.core(), b.pose.point_in_body(x));
    found->normal = b.pose.direction_in_space(nearest.normal);
    found->overlap = radius + b.geometry.radius() - nearest.distance;
    return found->overlap > 0.0 ? 1 : 0;
  };
  return touch.ends_and_middle(find, 1.0 / b.geometry.contact_radius());
}

/* ---- at the nearest points of two axes, see C. Ericson, Real-time collision detection, 5.1.9 ---- */

bool with_axis(const AtPlace &a, const Vector &center, const Vector &half_axis, double radius,
               const CollisionRequest &how, ShapeContacts &contacts)
{
  Touch touch(a, how, contacts);
  const Vector u = touch.place(1.0) - a.pose.position, d = a.pose.position - center;
  const double uu = dot(u, u), vv = dot(half_axis, half_axis), uv = dot(u, half_axis),
               ud = dot(u, d), vd = dot(half_axis, d), det = uu * vv - uv * uv;
  const auto along = [](double s) { return std::clamp(s, -1.0, 1.0); };
  const auto of_a = [&](double t) { return uu > 0.0 ? along((t * uv - ud) / uu) : 0.0; };
  double t = 0.0;
  if (det > 1.0e-12 * uu * vv) {    // axes that are not parallel
    const double s = along((uv * vd - vv * ud) / det);
    t = along((s * uv + vd) / vv);
  } else if (vv > 0.0) {    // the middle of what they have in common
    const double s = std::sqrt(uu / vv) * (uv < 0.0 ? -1.0 : 1.0), middle = vd / vv;
    t = 0.5 * (along(middle - s) + along(middle + s));
  }
  const Vector x = touch.place(of_a(t)), apart = x - (center + t * half_axis);
  const double distance = length(apart), overlap = a.geometry.radius + radius - distance;
  if (!(overlap > 0.0) || !(distance > 0.0)) return false;
  touch.add(x, {(1.0 / distance) * apart, overlap}, 1.0 / radius,
            contact_name(ContactParts::WHOLE, 0, 0));
  return true;
}

bool with_sphere(const AtPlace &a, const Placed<Sphere> &b, const CollisionRequest &how,
                 ShapeContacts &contacts)
{
  return with_axis(a, b.pose.position, {0.0, 0.0, 0.0}, b.geometry.radius, how, contacts);
}

bool with_capsule(const AtPlace &a, const AtPlace &b, const CollisionRequest &how,
                  ShapeContacts &contacts)
{
  const Vector axis = b.pose.direction_in_space({0.0, 0.0, b.geometry.half});
  return with_axis(a, b.pose.position, axis, b.geometry.radius, how, contacts);
}

std::shared_ptr<const Shape> make(const ShapeReader &from)
{
  const double length = from.words.positive("capsule L");
  return std::make_shared<const Capsule>(length, from.words.positive("capsule r"));
}

const AddedShape added(plain_shape<make>("capsule"), [](Collisions &table) {
  table.add<with_flat, with_mesh, with_convex, with_sphere, with_capsule>();
});

}    // namespace
}    // namespace Talus
