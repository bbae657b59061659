// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_body_vertices.h"

#include "comm.h"
#include "update.h"

#include <cstdint>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

LargeBodyVertices::LargeBodyVertices(LAMMPS *lmp, MeshShape &shape) :
    Pointers(lmp), mesh(shape), sums(shape.surface().num_own_vertices())
{
}

void LargeBodyVertices::begin_step(const Kicks &kicks_of_step)
{
  kicks = kicks_of_step;
  time += update->dt;
  add(kicks.before);
}

void LargeBodyVertices::end_step(bool advance)
{
  if (advance && kicks.after > 0.0) add(kicks.after);
}

void LargeBodyVertices::add(double share)
{
  constexpr std::size_t ahead = 8, far_ahead = 16;
  const double impulse = share * update->dt;
  const TriangleMesh &surface = mesh.surface();
  const auto corners = [&](std::size_t n) { return surface.corners(forces[n].triangle).vertex; };
  for (std::size_t n = 0; n < forces.size(); n++) {
    if (n + far_ahead < forces.size())
      for (int k = 0; k < 3; k++) {
        sums.prefetch_slot(corners(n + far_ahead)[k]);
        mesh.moving()->prefetch(corners(n + far_ahead)[k]);
      }
    if (n + ahead < forces.size())
      for (int k = 0; k < 3; k++) sums.prefetch(corners(n + ahead)[k]);
    const TouchedCorners &touch = forces[n];
    double work = 0.0;
    for (int k = 0; k < 3; k++) {
      const int vertex = surface.corners(touch.triangle).vertex[k];
      sums.add(vertex, impulse * touch.force[k]);
      work += dot(touch.force[k], mesh.moving()->gone_in_step(vertex));
    }
    if (work != 0.0) sums.add(share * work);
  }
}

/* One after the other, what all ranks have. */

std::vector<std::int64_t> LargeBodyVertices::packed_of_all_ranks() const
{
  const std::vector<std::int64_t> here = sums.packed();
  const int size = static_cast<int>(here.size());
  std::vector<int> sizes(comm->nprocs), begins(comm->nprocs, 0);
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  std::partial_sum(sizes.begin(), sizes.end() - 1, begins.begin() + 1);
  std::vector<std::int64_t> all(begins.back() + sizes.back());
  MPI_Allgatherv(here.data(), size, MPI_INT64_T, all.data(), sizes.data(), begins.data(),
                 MPI_INT64_T, world);
  begins.push_back(static_cast<int>(all.size()));
  VertexSums total(mesh.surface().num_own_vertices());
  for (int rank = 0; rank < comm->nprocs; rank++)
    total.add_packed(all.data() + begins[rank], all.data() + begins[rank + 1]);
  return total.packed();
}

VertexImpulses LargeBodyVertices::take()
{
  if (comm->nprocs > 1) {
    const std::vector<std::int64_t> all = packed_of_all_ranks();
    sums.clear();
    sums.add_packed(all.data(), all.data() + all.size());
  }
  VertexImpulses found;
  const std::vector<int> touched_vertices = sums.vertices();
  found.vertices.reserve(touched_vertices.size());
  found.impulses.reserve(touched_vertices.size());
  for (const int vertex : touched_vertices) {
    found.vertices.push_back(vertex);
    found.impulses.push_back(sums.sum(vertex));
  }
  found.work = sums.sum_of_numbers();
  found.time = std::exchange(time, 0.0);
  sums.clear();
  return found;
}

void LargeBodyVertices::collect_sums()
{
  const std::vector<std::int64_t> all = packed_of_all_ranks();
  sums.clear();
  if (comm->me == 0) sums.add_packed(all.data(), all.data() + all.size());
}

/* Of a restart file, all ranks have read the sums of all. */

bool LargeBodyVertices::take_over_sums()
{
  if (!mesh.moving()->state_fits()) return false;
  mesh.vertices_are_restored();
  if (comm->me) sums.clear();
  return true;
}

double LargeBodyVertices::memory_usage() const
{
  return static_cast<double>(forces.capacity() * sizeof(TouchedCorners)) + sums.memory_usage();
}

}    // namespace Talus
