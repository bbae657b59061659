// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/body_surfaces.h"

#include "body/shape/mesh_shape.h"
#include "body/shape/surface_visitor.h"
#include "shape/convex/convex_shape.h"
#include "shape/mesh_features.h"
#include "shape/surface.h"

#include <algorithm>
#include <utility>

namespace Talus {

/* A box is a convex body, and a ball a sphere, as if they were particles. */

class BodySurfaces::Listing final : public SurfaceVisitor {
 public:
  explicit Listing(std::vector<Surface> &target) : list(target) {}

  void flat(const Vector3<double> &normal, const Vector3<double> &point, bool two_sided,
            int part) override
  {
    FlatSurface surface;
    surface.normal = normal;
    surface.offset = dot(normal, point);
    surface.two_sided = two_sided;
    surface.part = part;
    add(surface);
  }
  void box(const Vector3<double> &center, const Vector3<double> &edges) override
  {
    const auto shape = std::make_shared<const ConvexShape>(ConvexShape::box(edges, 0.0));
    Pose pose = shape->given_frame();
    pose.position = pose.position + center;
    list.push_back({shape, pose});
  }
  void ball(const Vector3<double> &center, double radius) override
  {
    Sphere surface;
    surface.radius = radius;
    add(surface);
    list.back().pose.position = center;
  }
  void frustum(const Frustum &body) override
  {
    RoundSurface surface;
    surface.body = &body;
    add(surface);
  }
  void vessel(const LargeBodyShape &body, const std::vector<InwardWall> &walls) override
  {
    VesselSurface surface;
    surface.body = &body;
    surface.walls = walls;
    add(surface);
  }
  void mesh(std::shared_ptr<const MeshShape> mesh) override
  {
    MeshSurface surface;
    surface.features = std::make_shared<const MeshFeatures>(mesh->surface());
    if (mesh->moving()) moving = mesh;
    surface.shape = std::move(mesh);
    add(surface);
  }

  std::shared_ptr<const MeshShape> moving;

 private:
  template <class Kind> void add(const Kind &surface)
  {
    list.push_back({std::make_shared<const Kind>(surface)});
  }

  std::vector<Surface> &list;
};

BodySurfaces::BodySurfaces(const LargeBodyShape &body, const ShapeTable &shape_table) :
    shapes(shape_table), parts(body.most_contacts() > 1)
{
  Listing listing(surfaces);
  body.visit_surfaces(listing);
  moving = listing.moving;
  if (moving) changes = moving->num_changes();
  for (Surface &surface : surfaces) {
    surface.collision.resize(shapes.last_type() + 1);
    for (int type = 1; type <= shapes.last_type(); type++)
      if (shapes.of(type)) surface.collision[type] = shapes.collision(type, *surface.geometry);
  }
}

/* A mesh is the only surface of its body. */

void BodySurfaces::follow()
{
  if (!moving || moving->num_changes() == changes) return;
  changes = moving->num_changes();
  MeshSurface surface;
  surface.features = std::make_shared<const MeshFeatures>(moving->surface());
  surface.shape = moving;
  surfaces.front().geometry = std::make_shared<const MeshSurface>(surface);
}

bool BodySurfaces::touches_all(int type) const
{
  return std::all_of(surfaces.begin(), surfaces.end(), [type](const Surface &surface) {
    return static_cast<bool>(surface.collision[type]);
  });
}

std::string BodySurfaces::refusal() const
{
  if (surfaces.empty())
    return "particles with a shape touch no surface of this kind: use plane, rectangle, box, "
           "sphere, "
           "cylinder or cone without 'open', or mesh";
  for (int type = 1; type <= shapes.last_type(); type++)
    if (shapes.of(type) && !touches_all(type))
      return std::string("its contacts with the shape ") + shapes.of(type)->shape().name() +
             " of particles of type " + std::to_string(type) +
             " are not known: use another surface, such as plane or mesh";
  return "";
}

}    // namespace Talus
