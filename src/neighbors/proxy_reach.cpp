// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/proxy_reach.h"

#include "base/nearly_sorted.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace Talus {
namespace {

constexpr double none = -1.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// floor(2 log2(unit / radius)), within the classes.
int class_of(double radius, double unit)
{
  constexpr int last = ProxyReach::num_classes - 1;
  if (radius >= unit) return 0;
  const double ratio = unit / radius;
  if (!(ratio < std::exp2(0.5 * last))) return last;
  int exponent = 0;
  const bool upper_half = std::frexp(ratio, &exponent) >= std::sqrt(0.5);
  return 2 * (exponent - 1) + (upper_half ? 1 : 0);
}

double square(double a)
{
  return a * a;
}

/// How far a place is from an edge of a domain.
double gap(double x, const DomainGrid::Edge &edge)
{
  return std::max({edge.low - x, x - edge.high, 0.0});
}

}    // namespace

ProxyReach::ClassRadii ProxyReach::classes_of(int count, const double *radius, double unit)
{
  ClassRadii found;
  found.fill(none);
  for (int i = 0; i < count; i++) {
    double &of_class = found[class_of(radius[i], unit)];
    of_class = std::max(of_class, radius[i]);
  }
  return found;
}

ProxyReach::ProxyReach(DomainGrid around, const ClassRadii &classes, double unit_of_classes,
                       double most) :
    domains(std::move(around)),
    of_class(classes), unit(unit_of_classes), skin(most)
{
  const auto is_there = [this](int c) { return of_class[c] >= 0.0; };
  for (int c = num_classes - 1; c >= 0; c--)
    if (is_there(c)) first_class = c;
  for (int c = 0; c < num_classes; c++)
    if (is_there(c)) last_class = c;
  own.fill({-infinity, infinity, true});
  for (int d = 0; d < 3; d++) {
    const auto &edges = domains.along[d];
    if (edges.size() > 1) own[d] = edges[edges.size() / 2];
  }
}

void ProxyReach::Selection::add(const double *at, double size, int meaning)
{
  x.insert(x.end(), at, at + 3);
  radius.push_back(size);
  what.push_back(meaning);
}

double ProxyReach::shell(double radius) const
{
  return radius + of_class[class_of(radius, unit)] + skin;
}

/* To the nearest face of the own domain: all others are behind one. */

double ProxyReach::to_faces(const double *x) const
{
  double least = infinity;
  for (int d = 0; d < 3; d++)
    least = std::min(least, std::min(x[d] - own[d].low, own[d].high - x[d]));
  return least;
}

/* With the sums of in_shells() in its order, so that rounding makes no sphere a proxy twice. */

bool ProxyReach::is_in_shell(const double *x, double radius, int domain) const
{
  const auto &[along_x, along_y, along_z] = domains.along;
  const int nx = static_cast<int>(along_x.size()), ny = static_cast<int>(along_y.size());
  const double from_z = square(gap(x[2], along_z[domain / (nx * ny)])),
               from_y = from_z + square(gap(x[1], along_y[domain / nx % ny]));
  return from_y + square(gap(x[0], along_x[domain % nx])) < square(shell(radius));
}

/* Most spheres are near no face, not even for the largest one, and those that are near one are near
   few domains. */

ProxyReach::Lists ProxyReach::in_shells(int owned, const double *x, const double *radius) const
{
  Lists lists(domains.size());
  const auto &[along_x, along_y, along_z] = domains.along;
  const std::size_t nx = along_x.size(), ny = along_y.size(), here = domains.own();
  const double widest = owned ? 2.0 * of_class[first_class] + skin : 0.0;
  for (int i = 0; i < owned; i++) {
    const double *const at = x + 3L * i, near = to_faces(at);
    if (near >= widest) continue;
    const double reach = shell(radius[i]), most = square(reach);
    if (near >= reach) continue;
    for (std::size_t k = 0; k < along_z.size(); k++) {
      const double from_z = square(gap(at[2], along_z[k]));
      if (!along_z[k].present || from_z >= most) continue;
      for (std::size_t j = 0; j < ny; j++) {
        const double from_y = from_z + square(gap(at[1], along_y[j]));
        if (!along_y[j].present || from_y >= most) continue;
        for (std::size_t m = 0; m < nx; m++) {
          const std::size_t domain = (k * ny + j) * nx + m;
          if (along_x[m].present && domain != here &&
              from_y + square(gap(at[0], along_x[m])) < most)
            lists[domain].push_back(i);
        }
      }
    }
  }
  return lists;
}

/* Those that a larger one on the other side of a face can reach. */

void ProxyReach::select_owned(int owned, const double *x, const double *radius, Selection &to) const
{
  for (int i = 0; i < owned; i++)
    if (to_faces(x + 3L * i) < radius[i] + of_class[first_class] + skin &&
        class_of(radius[i], unit) > first_class)
      to.add(x + 3L * i, radius[i], i);
}

void ProxyReach::select_proxies(const double *x, const double *radius,
                                const std::vector<Proxies> &proxies, Selection &to) const
{
  for (const Proxies &from : proxies)
    for (int j = from.begin; j < from.end; j++)
      if (class_of(radius[j], unit) < last_class) to.add(x + 3L * j, radius[j], from.domain);
}

ProxyReach::Lists ProxyReach::beyond_shells(int owned, const double *x, const double *radius,
                                            const std::vector<Proxies> &proxies) const
{
  Lists lists(domains.size());
  Selection spheres;
  select_owned(owned, x, radius, spheres);
  const int candidates = static_cast<int>(spheres.what.size());
  select_proxies(x, radius, proxies, spheres);
  const int all = static_cast<int>(spheres.what.size());
  if (candidates == 0 || candidates == all) return lists;

  NeighborSearch search;
  search.find({candidates, all, spheres.x.data(), spheres.radius.data(), skin, candidates}, 1, {});
  search.view().for_each_pair(candidates, all, [&](int j, int i, double /*scale*/) {
    const int domain = spheres.what[j];
    if (!is_in_shell(&spheres.x[3L * i], spheres.radius[i], domain))
      lists[domain].push_back(spheres.what[i]);
  });
  for (std::vector<int> &list : lists) sort_and_unite(list);
  return lists;
}

}    // namespace Talus
