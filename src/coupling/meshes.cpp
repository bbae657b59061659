// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls for large bodies as meshes, and for those whose vertices the partner moves.

#include "coupling/bodies.h"
#include "coupling/calls.h"
#include "coupling/partner.h"

#include "body/shape/mesh_shape.h"
#include "system/bodies/large_body.h"

#include <optional>

namespace Talus {
namespace {

const TriangleMesh &mesh_of(LargeBody &body)
{
  MeshShape *const mesh = body.shape().as_mesh();
  if (!mesh) throw Refusal(body.name() + " is no mesh");
  return mesh->surface();
}

LargeBodyVertices &vertices_of(LargeBody &body)
{
  if (!body.vertices())
    throw Refusal("the vertices of " + body.name() +
                  " are not moved by a partner: use 'mesh ... move vertices'");
  return *body.vertices();
}

std::vector<double> numbers_in(const std::vector<Vector3<double>> &vectors)
{
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vector3<double> &v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

std::vector<Vector3<double>> vectors_in(const std::vector<double> &numbers)
{
  std::vector<Vector3<double>> vectors;
  vectors.reserve(numbers.size() / 3);
  for (std::size_t k = 0; k + 3 <= numbers.size(); k += 3)
    vectors.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  return vectors;
}

}    // namespace

int call_get_mesh_size(talus_partner *partner, const char *body, int64_t *vertices,
                       int64_t *triangles)
{
  return partner->collective("talus_get_mesh_size", [&] {
    const TriangleMesh &mesh = mesh_of(body_of(*partner, body));
    partner->give(vertices, std::vector<std::int64_t>{mesh.num_own_vertices()});
    partner->give(triangles, std::vector<std::int64_t>{mesh.num_own()});
  });
}

int call_get_mesh(talus_partner *partner, const char *body, double *x, int64_t *triangles)
{
  return partner->collective("talus_get_mesh", [&] {
    LargeBody &given = body_of(*partner, body);
    const TriangleMesh &mesh = mesh_of(given);
    std::vector<Vector3<double>> places;
    for (int v = 0; v < mesh.num_own_vertices(); v++)
      places.push_back(given.frame().point_to_space(mesh.vertex(v)));
    std::vector<std::int64_t> corners;
    for (int t = 0; t < mesh.num_own(); t++)
      for (const int v : mesh.corners(t).vertex) corners.push_back(v);
    partner->give(x, numbers_in(places));
    partner->give(triangles, corners);
  });
}

int call_put_vertices(talus_partner *partner, const char *body, const double *x, const double *v,
                      int64_t steps)
{
  return partner->collective("talus_put_vertices", [&] {
    LargeBody &given = body_of(*partner, body);
    vertices_of(given);
    const std::int64_t count = 3L * mesh_of(given).num_own_vertices();
    const std::vector<Vector3<double>> places = vectors_in(partner->numbers_of("x", x, count));
    std::optional<std::vector<Vector3<double>>> velocities;
    if (partner->has("v", v)) velocities = vectors_in(partner->numbers_of("v", v, count));
    const int ahead = steps_ahead(*partner, steps);
    const std::string problem =
        given.guide_vertices(places, velocities ? &*velocities : nullptr, ahead);
    if (!problem.empty()) throw Refusal(problem);
  });
}

int call_get_vertex_loads(talus_partner *partner, const char *body, int64_t *touched,
                          int64_t *numbers, double *impulses, double *work, double *duration)
{
  return partner->collective("talus_get_vertex_loads", [&] {
    const VertexImpulses found = vertices_of(body_of(*partner, body)).take();
    partner->give(touched,
                  std::vector<std::int64_t>{static_cast<std::int64_t>(found.vertices.size())});
    partner->give(numbers, found.vertices);
    partner->give(impulses, numbers_in(found.impulses));
    partner->give(work, std::vector<double>{found.work});
    partner->give(duration, std::vector<double>{found.time});
  });
}

}    // namespace Talus
