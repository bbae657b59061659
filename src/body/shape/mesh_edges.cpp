// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace Talus {

MeshEdges::MeshEdges(const std::vector<Corners> &triangles) : edges_of(3 * triangles.size())
{
  struct Side {
    int low, high, place;    // place: 3 triangle + k
  };
  std::vector<Side> sides;
  sides.reserve(edges_of.size());
  for (std::size_t t = 0; t < triangles.size(); t++)
    for (int k = 0; k < 3; k++) {
      const int a = triangles[t].vertex[k], b = triangles[t].vertex[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(3 * t) + k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
    return std::tie(a.low, a.high, a.place) < std::tie(b.low, b.high, b.place);
  });

  edge_users.reserve(sides.size());
  for (std::size_t n = 0; n < sides.size(); n++) {
    const Side &s = sides[n];
    const bool is_new = n == 0 || s.low != sides[n - 1].low || s.high != sides[n - 1].high;
    if (is_new) edges.push_back({{s.low, s.high}, static_cast<int>(n), 0});
    edges.back().num_users++;
    edge_users.push_back(s.place / 3);
    edges_of[s.place] = static_cast<int>(edges.size()) - 1;
  }
}

}    // namespace Talus
