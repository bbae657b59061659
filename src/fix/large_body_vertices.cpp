// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_vertices.h"

#include "comm.h"
#include "update.h"

#include <numeric>

using namespace LAMMPS_NS;
using namespace Talus;

LargeBodyVertices::LargeBodyVertices(LAMMPS *lmp, MeshShape &shape) :
    Pointers(lmp), mesh(shape), sums(shape.surface().num_own_vertices())
{
}

void LargeBodyVertices::begin_step()
{
  time += update->dt;
  add(share_of_next);
}

void LargeBodyVertices::end_step(double next, bool advance)
{
  if (advance && next < 1.0) add(1.0 - next);
  share_of_next = next;
}

void LargeBodyVertices::add(double share)
{
  const double impulse = share * update->dt;
  const TriangleMesh &surface = mesh.surface();
  for (const TouchedCorners &touch : forces) {
    double work = 0.0;
    for (int k = 0; k < 3; k++) {
      const int vertex = surface.corners(touch.triangle).vertex[k];
      sums.add(vertex, impulse * touch.force[k]);
      work += dot(touch.force[k], mesh.moving()->gone_in_step(vertex));
    }
    if (work != 0.0) sums.add(share * work);
  }
}

std::vector<double> LargeBodyVertices::of_all_ranks() const
{
  std::vector<double> here;
  sums.pack(here);
  if (comm->nprocs == 1) return here;
  const int size = static_cast<int>(here.size());
  std::vector<int> sizes(comm->nprocs), begins(comm->nprocs, 0);
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  std::partial_sum(sizes.begin(), sizes.end() - 1, begins.begin() + 1);
  std::vector<double> packed(begins.back() + sizes.back()), all;
  MPI_Allgatherv(here.data(), size, MPI_DOUBLE, packed.data(), sizes.data(), begins.data(),
                 MPI_DOUBLE, world);
  VertexSums total(mesh.surface().num_own_vertices());
  for (int rank = 0; rank < comm->nprocs; rank++)
    total.unpack(packed.data() + begins[rank], packed.data() + begins[rank] + sizes[rank]);
  total.pack(all);
  return all;
}

VertexImpulses LargeBodyVertices::take()
{
  const std::vector<double> all = of_all_ranks();
  VertexSums total(mesh.surface().num_own_vertices());
  total.unpack(all.data(), all.data() + all.size());
  VertexImpulses found;
  for (const int vertex : total.vertices()) {
    found.vertices.push_back(vertex);
    found.impulses.push_back(total.sum(vertex));
  }
  found.work = total.sum_of_numbers();
  found.time = time;
  sums.clear();
  time = 0.0;
  return found;
}

/* Number of vertices, state of them; time, sums. */

void LargeBodyVertices::to_array(std::vector<double> &to)
{
  const MovingVertices &moving = *mesh.moving();
  to.push_back(moving.num_own());
  to.resize(to.size() + moving.size_of_array());
  moving.to_array(to.data() + to.size() - moving.size_of_array());
  to.push_back(time);
  const std::vector<double> all = of_all_ranks();
  to.insert(to.end(), all.begin(), all.end());
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
  if (comm->me == 0) sums.unpack(begin + 2 + size, end);
  return true;
}

void LargeBodyVertices::exchange_state(StateExchange &x)
{
  std::vector<double> state(mesh.moving()->size_of_array());
  if (!x.restores()) mesh.moving()->to_array(state.data());
  x(state, forces, share_of_next, sums, time);
  if (x.restores()) mesh.resume(state.data());
}

double LargeBodyVertices::memory_usage() const
{
  return static_cast<double>(forces.capacity() * sizeof(TouchedCorners)) + sums.memory_usage();
}
