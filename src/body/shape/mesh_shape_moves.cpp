// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A mesh whose vertices move.

#include "base/number_text.h"
#include "body/shape/mesh_shape.h"

#include <algorithm>
#include <utility>

namespace Talus {

void MeshShape::let_vertices_move()
{
  vertices = std::make_unique<MovingVertices>(mesh);
  check = std::make_unique<MeshCheck>(mesh);
  mesh.separate_planes();
  detail = std::make_unique<MeshDetail>(mesh);
  covers_all = true;
}

/* What is wrong with places is the same on all ranks, which know the same of the mesh. */

std::string MeshShape::guide(const MovingVertices::Places &places,
                             const MovingVertices::Places *velocities, int steps, double dt,
                             double way)
{
  const MovingVertices::Places &now = mesh.all_vertices();
  double largest = 0.0;
  int farthest = 0;
  for (int v = 0; v < mesh.num_own_vertices(); v++) {
    const double gone = length(places[v] - now[v]) / std::max(steps, 1);
    if (gone <= largest) continue;
    largest = gone;
    farthest = v;
  }
  if (largest > way)
    return "vertex " + std::to_string(farthest) + " would go " + number_text(largest, 4) +
           " in one step, which is more than the skin " + number_text(way, 4) +
           ": give places more often, or for more steps ahead";
  MovingVertices::Places then = vertices->with_images(places);
  const std::string problem = check->problem(now, then);
  if (!problem.empty()) return problem;
  vertices->guide(std::move(then), velocities, steps, dt);
  if (check->patches_change()) mesh.set_patches(check->patches());
  if (steps == 0) find_planes();
  return "";
}

void MeshShape::vertices_are_restored()
{
  vertices->state_is_restored();
  check->look_at(vertices->target());
  if (check->patches_change()) mesh.set_patches(check->patches());
  find_planes();
}

void MeshShape::advance(bool order_2)
{
  if (vertices->advance(order_2)) find_planes();
}

void MeshShape::find_planes()
{
  changes++;
  if (keeps_planes) mesh.find_planes(check->edges());
}

void MeshShape::settle(bool with_planes)
{
  if (with_planes != keeps_planes) {
    keeps_planes = with_planes;
    mesh.separate_planes();
    find_planes();
  }
  detail->refit();
  vertices->settle();
}

}    // namespace Talus
