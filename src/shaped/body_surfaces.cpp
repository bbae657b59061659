// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/body_surfaces.h"

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
  explicit Listing(std::vector<Surface> &its_list) : list(its_list) {}

  void flat(const Vector3<double> &normal, const Vector3<double> &point, bool two_sided,
            int part) override
  {
    FlatSurface its;
    its.normal = normal;
    its.offset = dot(normal, point);
    its.two_sided = two_sided;
    its.part = part;
    add(its);
  }
  void box(const Vector3<double> &center, const Vector3<double> &edges) override
  {
    const auto its = std::make_shared<const ConvexShape>(ConvexShape::box(edges, 0.0));
    Pose pose = its->given_frame();
    pose.position = pose.position + center;
    list.push_back({its, pose});
  }
  void ball(const Vector3<double> &center, double radius) override
  {
    Sphere its;
    its.radius = radius;
    add(its);
    list.back().pose.position = center;
  }
  void frustum(const Frustum &body) override
  {
    RoundSurface its;
    its.body = &body;
    add(its);
  }
  void vessel(const LargeBodyShape &body) override
  {
    VesselSurface its;
    its.body = &body;
    add(its);
  }
  void mesh(std::shared_ptr<const MeshShape> mesh) override
  {
    MeshSurface its;
    its.features = std::make_shared<const MeshFeatures>(mesh->surface());
    its.shape = std::move(mesh);
    add(its);
  }

 private:
  template <class Kind> void add(const Kind &its)
  {
    list.push_back({std::make_shared<const Kind>(its)});
  }

  std::vector<Surface> &list;
};

BodySurfaces::BodySurfaces(const LargeBodyShape &body, const ShapeTable &its_shapes) :
    shapes(its_shapes), parts(body.most_contacts() > 1)
{
  Listing listing(surfaces);
  body.visit_surfaces(listing);
  for (Surface &its : surfaces) {
    its.collision.resize(shapes.last_type() + 1);
    for (int type = 1; type <= shapes.last_type(); type++)
      if (shapes.of(type)) its.collision[type] = shapes.collision(type, *its.geometry);
  }
}

bool BodySurfaces::touches_all(int type) const
{
  return std::all_of(surfaces.begin(), surfaces.end(),
                     [type](const Surface &its) { return static_cast<bool>(its.collision[type]); });
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
