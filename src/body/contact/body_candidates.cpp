// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_candidates.h"

#include "base/in_parallel.h"
#include "base/lanes.h"
#include "body/shape/moving_vertices.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace Talus {
namespace {

// A body may go half a skin before its list is rebuilt; particles may each go half a skin in one
// direction before the rebuild that the list is made after, and half a skin in the other.
constexpr double free_way = 0.5;

constexpr double near = 1.01;    // of the radius: parts within it are probably touched
constexpr double infinity = std::numeric_limits<double>::infinity();

/// It may go somewhere until particles are listed again.
bool goes(const BodyFrame &frame)
{
  return frame.moves || frame.vertices;
}

}    // namespace

struct BodyCandidates::Search {
  const LargeBodyShape &shape;
  const BodyFrame &frame;
  const ParticleState &view;
  const int *mask;
  int group;
  const std::vector<int> &to_keep;
  double margin, extent;    // extent: of the surface from the reference point

  bool keeps(int i) const { return std::binary_search(to_keep.begin(), to_keep.end(), i); }
  /// From the reference point, of bodies that move.
  double distance(const Vector3<double> &x) const
  {
    return frame.moves ? length(x - frame.origin) : 0.0;
  }
  /// How far from there what matters is that this particle may touch: what is further away than the
  /// surface is touched no sooner than the surface has come there.
  double farthest(double distance, double reach) const
  {
    return frame.moves ? std::min(distance, extent) + reach : 0.0;
  }
  void find_with_parts(int begin, int end, Found &found) const;
  /// visit(i, place in the frame of the body, reach, whether the surface may be nearer than that) for
  /// the particles of the group among those from `begin` to `end`.
  template <class Visit> void each(int begin, int end, Visit visit) const;
};

/// By one thread, of a range of the particles.
struct BodyCandidates::Found {
  struct Sphere {
    int particle;
    Vector3<double> at;
    double radius, nearest, another;
    FlatPlace flat;
    std::size_t num_parts;
  };
  std::vector<Sphere> spheres;
  std::vector<NearPart> parts;    // of all of them
  std::size_t most_contacts = 0;
  double farthest = 0.0;
};

template <class Visit> void BodyCandidates::Search::each(int begin, int end, Visit visit) const
{
  EightSpheres spheres;
  const auto &center = spheres.center;
  for (int first = begin; first < end; first += lanes) {
    const auto place = [&](int k) { return view.place(std::min(first + k, end - 1)); };
    view.spheres_at(place, spheres.center, spheres.radius);
    const Vector3<Vec8> x =
        frame.point_to_body(Vector3<Vec8>{load8(center[0]), load8(center[1]), load8(center[2])});
    store(spheres.center[0], x.x);
    store(spheres.center[1], x.y);
    store(spheres.center[2], x.z);
    store(spheres.radius, load8(spheres.radius) + splat<Vec8>(margin));
    const unsigned bits = shape.may_touch_eight(spheres);
    for (int k = 0, i = first; k < lanes && i < end; k++, i++)
      if (mask[i] & group)
        visit(i, Vector3<double>{center[0][k], center[1][k], center[2][k]}, spheres.radius[k],
              (bits >> k & 1U) != 0);
  }
}

void BodyCandidates::clear()
{
  particles.clear();
  listed.clear();
  most_contacts.clear();
  parts.clear();
  parts_begin.assign(1, 0);
}

void BodyCandidates::list(const LargeBodyShape &shape, const BodyFrame &frame,
                          const ParticleState &view, const int *mask, int group, double skin,
                          double beyond, const std::vector<int> &to_keep, int threads)
{
  clear();
  listed_frame = frame;
  listed_reach = 0.0;
  const double margin = beyond + (goes(frame) ? (1.0 + free_way) * skin : skin);
  const double extent =
      frame.moves ? (1.0 + 1.0e-9) * shape.extent_from(frame.origin) : 0.0;    // rounding
  const Search search{shape, frame, view, mask, group, to_keep, margin, extent};
  if (!shape.thread_safe()) threads = 1;
  if (shape.most_contacts() == 1)
    list_near(search, threads);
  else
    list_with_parts(search, threads);
}

/* By several threads, each for a range of the particles. */

void BodyCandidates::list_near(const Search &search, int threads)
{
  struct Found {
    std::vector<int> near;
    double farthest = 0.0;
  };
  std::vector<Found> found(threads);
  in_ranges(search.view.owned(), threads, [&](int t, int begin, int end) {
    Found of_thread;
    search.each(begin, end, [&](int i, const Vector3<double> &x, double reach, bool may_touch) {
      of_thread.farthest = std::max(of_thread.farthest, search.farthest(search.distance(x), reach));
      if (may_touch || search.keeps(i)) of_thread.near.push_back(i);
    });
    found[t] = std::move(of_thread);
  });
  for (const Found &of_thread : found) {
    particles.insert(particles.end(), of_thread.near.begin(), of_thread.near.end());
    listed_reach = std::max(listed_reach, of_thread.farthest);
  }
}

void BodyCandidates::list_with_parts(const Search &search, int threads)
{
  std::vector<Found> found(threads);
  in_ranges(search.view.owned(), threads, [&](int t, int begin, int end) {
    Found of_thread;
    search.find_with_parts(begin, end, of_thread);
    found[t] = std::move(of_thread);
  });
  for (const Found &of_thread : found) add(of_thread);
}

void BodyCandidates::Search::find_with_parts(int begin, int end, Found &found) const
{
  found.most_contacts = shape.most_contacts();
  each(begin, end, [&](int i, const Vector3<double> &x, double reach, bool may_touch) {
    const double away = distance(x);
    found.farthest = std::max(found.farthest, farthest(away, reach));
    if (frame.moves && away >= extent + reach) may_touch = false;
    const std::size_t before = found.parts.size();
    if (!(may_touch && shape.is_near(x, reach, found.parts)) && !keeps(i)) return;
    Found::Sphere sphere{i, x, reach - margin, 0.0, infinity, {}, found.parts.size() - before};
    if (sphere.num_parts) {
      const NearPart &first = found.parts[before];
      const auto other =
          std::find_if(found.parts.begin() + static_cast<std::ptrdiff_t>(before), found.parts.end(),
                       [&](const NearPart &part) { return part.group != first.group; });
      sphere.nearest = first.distance;
      if (other != found.parts.end()) sphere.another = other->distance;
      sphere.flat = shape.flat_place(x, reach, first.part);
    }
    found.spheres.push_back(sphere);
  });
}

void BodyCandidates::add(const Found &found)
{
  listed_reach = std::max(listed_reach, found.farthest);
  parts.insert(parts.end(), found.parts.begin(), found.parts.end());
  for (const Found::Sphere &sphere : found.spheres) {
    const int k = static_cast<int>(particles.size() % lanes);
    if (k == 0) listed.push_back({});
    Eight &eight = listed.back();
    const double at[3] = {sphere.at.x, sphere.at.y, sphere.at.z};
    for (int d = 0; d < 3; d++) eight.at[d][k] = at[d];
    eight.nearest[k] = sphere.nearest;
    eight.another[k] = sphere.another;
    eight.flat_way[k] = sphere.flat.way;
    eight.flat.set(k, sphere.flat);
    const double probable = near * sphere.radius;
    const bool is_alone = sphere.flat.way > 0.0 && sphere.another >= probable;
    if (sphere.num_parts && sphere.nearest < probable && !is_alone) eight.with_parts |= 1U << k;
    particles.push_back(sphere.particle);
    const std::size_t room = sphere.num_parts ? sphere.num_parts : found.most_contacts;
    most_contacts.push_back(static_cast<std::uint8_t>(std::min(room, found.most_contacts)));
    parts_begin.push_back(parts_begin.back() + sphere.num_parts);
  }
}

bool BodyCandidates::sort_by_slot(const int *slot_of_atom)
{
  const auto before = [slot_of_atom](int a, int b) { return slot_of_atom[a] < slot_of_atom[b]; };
  if (std::is_sorted(particles.begin(), particles.end(), before)) return false;
  std::sort(particles.begin(), particles.end(), before);
  return true;
}

bool BodyCandidates::are_stale(const BodyFrame &frame, double skin) const
{
  if (frame.vertices) return frame.vertices->way() > free_way * skin;
  return frame.moves && largest_displacement(listed_frame, frame, listed_reach) > free_way * skin;
}

/* A little more than the way that both went: rounding must not hide a part. */

template <class Real> Real BodyCandidates::reach_of(Real radius, Real way)
{
  return radius + splat<Real>(1.0 + 1.0e-9) * way + splat<Real>(1.0e-9) * radius;
}

NearParts BodyCandidates::parts_near(const BodyFrame &frame, std::size_t c,
                                     const Vector3<double> &x, double radius, bool &may_touch) const
{
  const double way = length(x - listed_at(c)) + (frame.vertices ? frame.vertices->way() : 0.0);
  const double reach = reach_of(radius, way);
  may_touch = listed[c / lanes].nearest[c % lanes] < reach;
  const NearPart *const begin = parts.data() + parts_begin[c];
  const NearPart *const last = parts.data() + parts_begin[c + 1];
  const NearPart *end = begin;
  while (end != last && end->distance < reach) end++;
  return {begin, end};
}

unsigned BodyCandidates::touch_flat(const LargeBodyShape &shape, const BodyFrame &frame,
                                    std::size_t block, const EightSpheres &spheres,
                                    EightContacts &contacts, unsigned &told) const
{
  const Eight &eight = listed[block];
  const auto vector_of = [](const auto &v) {
    return Vector3<Vec8>{load8(v[0]), load8(v[1]), load8(v[2])};
  };
  const Vector3<Vec8> gone = vector_of(spheres.center) - vector_of(eight.at);
  const Vec8 way =
      square_root(dot(gone, gone)) + splat<Vec8>(frame.vertices ? frame.vertices->way() : 0.0);
  const Vec8 reach = reach_of(load8(spheres.radius), way);
  const unsigned near = less_bits(load8(eight.nearest), reach);
  const unsigned flat =
      less_bits(way, load8(eight.flat_way)) & ~less_bits(load8(eight.another), reach);
  told = ~near;
  if (!(near & flat)) return 0;
  unsigned told_by_shape;
  const unsigned touching = shape.touches_flat(spheres, eight.flat, contacts, told_by_shape);
  told |= flat & told_by_shape;
  return touching & near & flat;
}

void BodyCandidates::prefetch_parts(std::size_t c, double radius, const LargeBodyShape &shape) const
{
  for (std::size_t p = parts_begin[c]; p < parts_begin[c + 1]; p++) {
    if (parts[p].distance > near * radius) break;
    shape.prefetch(parts[p].part);
  }
}

Eigen::AlignedBox3d BodyCandidates::bounds_of_search(const BodyFrame &frame,
                                                     const ParticleState &view, const int *mask,
                                                     int group, double skin, double beyond)
{
  Eigen::AlignedBox3d box;
  double largest = 0.0;
  for (int i = 0; i < view.owned(); i++) {
    if (!(mask[i] & group)) continue;
    box.extend(to_eigen(frame.point_to_body(view.position(i))));
    largest = std::max(largest, view.radius(i));
  }
  if (box.isEmpty()) return box;
  // listed with the margin of list(); they go half a skin, the body what it may until it is stale
  const double reach = largest + beyond + (goes(frame) ? 3.0 : 2.0) * skin;
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(reach);
  return {box.min() - around, box.max() + around};
}

double BodyCandidates::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  return bytes(particles) + bytes(listed) + bytes(most_contacts) + bytes(parts_begin) +
         bytes(parts);
}

}    // namespace Talus
