// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which spheres of a rank can be touched by spheres of other ranks, or of periodic images, before
// the next rebuild: those that have to be proxies there, and no others. Geometry only, without MPI.
//
// Spheres are sorted into classes by their radii, each at most sqrt(2) wide. Around every domain
// lie shells, one for each class: sphere i is in its shell if
//
//   distance(x_i, domain) < r_i + R(class of i) + skin,
//
// with R the largest radius of its class on any rank. Then all partners of its class and of smaller
// ones are near enough. Larger partners reach further than that, but they are few, and by the same
// rule they are proxies here already. So a sphere is needed beyond its shell where a proxy of a
// larger class reaches it: by the owner of that proxy, whose shift is the opposite one.

#ifndef TALUS_NEIGHBORS_PROXY_REACH_H
#define TALUS_NEIGHBORS_PROXY_REACH_H

#include "neighbors/neighbor_search.h"

#include <array>
#include <vector>

namespace Talus {

/// The domains around that of a rank, as it sees them: shifted by their periods. They are those of
/// a grid, numbered along x first, and a sphere on a face between two belongs to either.
struct DomainGrid {
  struct Edge {
    double low, high;    ///< infinite where the box ends and does not repeat
    bool present;        ///< false: beyond the end of the box
  };
  /// The edges of 2n + 1 domains; in the middle is the own one.
  std::array<std::vector<Edge>, 3> along;

  int size() const { return static_cast<int>(along[0].size() * along[1].size() * along[2].size()); }
  int own() const { return size() / 2; }
};

class ProxyReach {
 public:
  static constexpr int num_classes = 32;
  /// By class the largest radius (length); negative: none.
  using ClassRadii = std::array<double, num_classes>;
  /// Of the spheres of one rank. `unit`: the same on all ranks; spheres as large, and larger ones,
  /// are in class 0.
  static ClassRadii classes_of(int count, const double *radius, double unit);

  /// `classes`: over all ranks, with that unit; `skin`: how far two spheres can come closer before
  /// the next rebuild, and the distance from which they attract each other (length).
  ProxyReach(DomainGrid domains, const ClassRadii &classes, double unit, double skin);

  /// There are spheres of more than one class.
  bool has_larger_partners() const { return first_class < last_class; }

  /// By domain: indices of spheres, ascending.
  using Lists = std::vector<std::vector<int>>;
  /// Those in the shells. Arrays as in NeighborSearch: rows of three doubles and radii of what this
  /// rank owns.
  Lists in_shells(int owned, const double *x, const double *radius) const;

  /// What has come from one domain.
  struct Proxies {
    int domain, begin, end;    ///< end: one after the last
  };
  /// Those beyond. `proxies` has come from all the shells; the arrays go on with it.
  Lists beyond_shells(int owned, const double *x, const double *radius,
                      const std::vector<Proxies> &proxies) const;

 private:
  /// Spheres, with what they are to the caller: an index, or the domain that a proxy has come from.
  struct Selection {
    std::vector<double> x, radius;
    std::vector<int> what;

    void add(const double *x, double radius, int what);
  };
  double shell(double radius) const;
  double to_faces(const double *x) const;
  bool is_in_shell(const double *x, double radius, int domain) const;
  void select_owned(int owned, const double *x, const double *radius, Selection &to) const;
  void select_proxies(const double *x, const double *radius, const std::vector<Proxies> &proxies,
                      Selection &to) const;

  DomainGrid domains;
  /// Of the own domain; infinite where it has no other one beside it.
  std::array<DomainGrid::Edge, 3> own;
  ClassRadii of_class;
  double unit, skin;
  int first_class = 0, last_class = -1;    // that are there
};

}    // namespace Talus

#endif
