// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_vertices.h"

#include "comm.h"
#include "update.h"

#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;
using namespace Talus;

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
  for (const int vertex : sums.vertices()) {
    found.vertices.push_back(vertex);
    found.impulses.push_back(sums.sum(vertex));
  }
  found.work = sums.sum_of_numbers();
  found.time = std::exchange(time, 0.0);
  sums.clear();
  return found;
}

/* Number of vertices, state of them; time, and the bits of the sums. */

void LargeBodyVertices::to_array(std::vector<double> &to)
{
  const MovingVertices &moving = *mesh.moving();
  to.push_back(moving.num_own());
  to.resize(to.size() + moving.size_of_array());
  moving.to_array(to.data() + to.size() - moving.size_of_array());
  to.push_back(time);
  const std::vector<std::int64_t> all = packed_of_all_ranks();
  to.resize(to.size() + all.size());
  std::memcpy(to.data() + to.size() - all.size(), all.data(), all.size() * sizeof(double));
}

bool LargeBodyVertices::from_array(const double *begin, const double *end)
{
  const std::size_t size = mesh.moving()->size_of_array();
  if (static_cast<std::size_t>(end - begin) < size + 2 ||
      *begin != static_cast<double>(mesh.moving()->num_own()))
    return false;
  mesh.resume(begin + 1);
  time = begin[1 + size];
  sums.clear();
  std::vector<std::int64_t> all(end - begin - 2 - size);
  std::memcpy(all.data(), begin + 2 + size, all.size() * sizeof(double));
  if (comm->me == 0) sums.add_packed(all.data(), all.data() + all.size());
  return true;
}

void LargeBodyVertices::exchange_state(StateExchange &x)
{
  std::vector<double> state(mesh.moving()->size_of_array());
  if (!x.restores()) mesh.moving()->to_array(state.data());
  x(state, forces, kicks, sums, time);
  if (x.restores()) mesh.resume(state.data());
}

double LargeBodyVertices::memory_usage() const
{
  return static_cast<double>(forces.capacity() * sizeof(TouchedCorners)) + sums.memory_usage();
}
