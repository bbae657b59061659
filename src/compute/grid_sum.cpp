// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/grid_sum.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {

/// What the constructor of a fix reads.
struct FixWords {
  char id[5] = "NONE", group[4] = "all", style[15] = "TALUS_GRID_SUM";
  char *words[3] = {id, group, style};
};

}    // namespace

GridSum::GridSum(LAMMPS *lmp, const int (&cells)[3], int values, double reach) :
    Fix(lmp, 3, FixWords().words), num_values(values),
    grid(std::make_unique<Grid3d>(lmp, world, cells[0], cells[1], cells[2]))
{
  grid->set_distance(reach);
  grid->setup_grid(in_lo[0], in_hi[0], in_lo[1], in_hi[1], in_lo[2], in_hi[2], out_lo[0], out_hi[0],
                   out_lo[1], out_hi[1], out_lo[2], out_hi[2]);
  int sent, received;
  grid->setup_comm(sent, received);
  send_buffer.resize(static_cast<std::size_t>(num_values) * sent);
  receive_buffer.resize(static_cast<std::size_t>(num_values) * received);
  data.resize(num_values * (offset(out_hi[0], out_hi[1], out_hi[2]) + 1));
}

std::size_t GridSum::offset(int x, int y, int z) const
{
  const std::size_t nx = out_hi[0] - out_lo[0] + 1, ny = out_hi[1] - out_lo[1] + 1;
  return (z - out_lo[2]) * nx * ny + (y - out_lo[1]) * nx + (x - out_lo[0]);
}

bool GridSum::has(const int (&cell)[3]) const
{
  for (int d = 0; d < 3; d++)
    if (cell[d] < out_lo[d] || cell[d] > out_hi[d]) return false;
  return true;
}

void GridSum::clear()
{
  std::fill(data.begin(), data.end(), 0.0);
}

void GridSum::add_up()
{
  grid->reverse_comm(Grid3d::FIX, static_cast<Fix *>(this), 0, num_values, sizeof(double),
                     send_buffer.data(), receive_buffer.data(), MPI_DOUBLE);
}

void GridSum::pack_reverse_grid(int, void *buffer, int count, int *cells)
{
  auto *to = static_cast<double *>(buffer);
  for (int k = 0; k < count; k++) {
    const double *values = &data[static_cast<std::size_t>(num_values) * cells[k]];
    to = std::copy(values, values + num_values, to);
  }
}

void GridSum::unpack_reverse_grid(int, void *buffer, int count, int *cells)
{
  const auto *from = static_cast<const double *>(buffer);
  for (int k = 0; k < count; k++) {
    double *values = &data[static_cast<std::size_t>(num_values) * cells[k]];
    for (int n = 0; n < num_values; n++) values[n] += *from++;
  }
}

double GridSum::memory_usage()
{
  return static_cast<double>((data.size() + send_buffer.size() + receive_buffer.size()) *
                             sizeof(double));
}
