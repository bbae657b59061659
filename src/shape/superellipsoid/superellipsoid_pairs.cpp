// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of two superellipsoids: one pair, or eight pairs of the same two shapes at a time, with the same bits.

#include "shape/superellipsoid/common_normal_search.h"
#include "shape/superellipsoid/least_overlap.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"

#include "base/lanes.h"

#include <algorithm>
#include <vector>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Vector8 = Vector3<Vec8>;

/* Written in its place: a copy would read as a whole what has just been written in parts, for which processors wait. */

void add_contact(ShapeContacts &to, const Vector &normal, const Vector &middle, double overlap,
                 double curvature_of_a, double curvature_of_b)
{
  ShapeContact &contact = to.points.emplace_back();
  contact.position = middle;
  contact.normal = -normal;
  contact.overlap = overlap;
  contact.weight = 1.0;
  contact.curvature[0] = curvature_of_a;
  contact.curvature[1] = curvature_of_b;
  contact.name = contact_name(ContactParts::WHOLE, 0, 0);
  contact.begins_search = true;
}

void finish(const Superellipsoid &a, const Pose &pose, const CommonNormal &found,
            SeparatingDirection *direction, ShapeContacts &contacts)
{
  const Vector normal = pose.direction_in_space(found.normal);
  if (found.overlap > 0.0) {
    const Vector middle = pose.point_in_space(0.5 * (found.of_a.place + found.place_on_b));
    add_contact(contacts, normal, middle, found.overlap, a.curvature_for_laws(found.of_a),
                found.curvature_of_b);
  } else if (direction) {
    direction->direction = -normal;
  }
}

/* ---- eight pairs ------------------------------------------------------------------------------ */

struct EightPoses {
  Vector8 position;
  Vec8 rotation[3][3];
};

/// pose_of(k): of lane k.
template <class PoseOf> EightPoses eight_poses(PoseOf pose_of)
{
  static_assert(sizeof(Pose) == 12 * sizeof(double), "position, and rotation by columns");
  EightRows rows[3];
  for (int q = 0; q < 3; q++)
    rows[q] = lanes_of([&](int k) {
      return Memory<Vec4>::load_anywhere(reinterpret_cast<const double *>(&pose_of(k)) + 4 * q);
    });
  const auto number = [&](int n) { return rows[n / 4].number[n % 4]; };
  EightPoses poses;
  poses.position = {number(0), number(1), number(2)};
  for (int column = 0; column < 3; column++)
    for (int row = 0; row < 3; row++) poses.rotation[row][column] = number(3 + 3 * column + row);
  return poses;
}

/// As relative_pose().
SeenPose<Vec8> relative_poses(const EightPoses &a, const EightPoses &b)
{
  const auto &r = a.rotation;
  const Vector8 d = b.position - a.position;
  const auto component = [&](int k) { return r[0][k] * d.x + r[1][k] * d.y + r[2][k] * d.z; };
  SeenPose<Vec8> seen;
  seen.position = {component(0), component(1), component(2)};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      seen.rotation[i][j] =
          r[0][i] * b.rotation[0][j] + (r[1][i] * b.rotation[1][j] + r[2][i] * b.rotation[2][j]);
  return seen;
}

Vector8 in_space(const EightPoses &poses, const Vector8 &v)
{
  const auto row = [&](int k) {
    return poses.rotation[k][0] * v.x + poses.rotation[k][1] * v.y + poses.rotation[k][2] * v.z;
  };
  return {row(0), row(1), row(2)};
}

Vector8 in_body(const EightPoses &poses, const Vector8 &v)
{
  const auto column = [&](int k) {
    return poses.rotation[0][k] * v.x + poses.rotation[1][k] * v.y + poses.rotation[2][k] * v.z;
  };
  return {column(0), column(1), column(2)};
}

/// Pairs of two shapes, up to eight at a time.
class EightPairs {
 public:
  EightPairs(const Superellipsoid &shape_a, const Superellipsoid &shape_b) : a(shape_a), b(shape_b)
  {
  }
  ~EightPairs() { flush(); }
  EightPairs(const EightPairs &) = delete;
  EightPairs &operator=(const EightPairs &) = delete;

  void add(const CollisionJob &job)
  {
    jobs[count++] = &job;
    if (count == lanes) look_along_known();
  }

 private:
  using Search = CommonNormalSearch<OtherSuperellipsoid<Vec8>>;
  /// Lanes behind the last one have what it has.
  struct Lanes {
    const CollisionJob *const *jobs;
    int count;
    const CollisionJob &job(int k) const { return *jobs[std::min(k, count - 1)]; }
    EightPoses poses_of_a() const
    {
      return eight_poses([this](int k) -> const Pose & { return *job(k).pose_a; });
    }
    EightPoses poses_of_b() const
    {
      return eight_poses([this](int k) -> const Pose & { return *job(k).pose_b; });
    }
    unsigned all() const { return (1U << count) - 1U; }
  };

  void look_along_known();
  unsigned apart_along_known(const Lanes &pairs) const;
  void search();
  void hand_out(const Lanes &pairs, const EightPoses &poses, const Search::State &x,
                const Vector8 &center_of_b, unsigned done) const;
  void flush()
  {
    if (count) look_along_known();
    if (near_count) search();
  }

  const Superellipsoid &a, &b;
  const CollisionJob *jobs[lanes], *near_jobs[lanes];
  int count = 0, near_count = 0;
};

/* Those that are known to be apart by more than rounding along a direction are done: no search would find that
   they touch. */

void EightPairs::look_along_known()
{
  const unsigned apart = apart_along_known({jobs, count});
  for (int k = 0; k < count; k++) {
    if (apart >> k & 1U) continue;
    near_jobs[near_count++] = jobs[k];
    if (near_count == lanes) search();
  }
  count = 0;
}

unsigned EightPairs::apart_along_known(const Lanes &pairs) const
{
  const EightPoses of_a = pairs.poses_of_a(), of_b = pairs.poses_of_b();
  const Vector8 n = eight_vectors([&](int k) { return -pairs.job(k).direction->direction; });
  const Vec8 overlap = a.formulas().at_normal(in_body(of_a, n)).height +
                       b.formulas().at_normal(in_body(of_b, n)).height -
                       dot(n, of_b.position - of_a.position);
  const double rounding = 1.0e-12 * (a.bounding_radius() + b.bounding_radius());
  return less_bits(overlap, splat<Vec8>(-rounding)) & pairs.all();
}

void EightPairs::search()
{
  const Lanes pairs{near_jobs, near_count};
  const EightPoses of_a = pairs.poses_of_a();
  const SeenPose<Vec8> seen = relative_poses(of_a, pairs.poses_of_b());
  const OtherSuperellipsoid<Vec8> other(b.formulas(), seen);
  const Search searching(a.formulas(), other, size_of_both(a, b));
  const Vec8 zero = splat<Vec8>(0.0), one = splat<Vec8>(1.0);
  const Vector8 start = eight_vectors([&](int k) {
    return pairs.job(k).start ? -*pairs.job(k).start : Vector{0.0, 0.0, 0.0};
  });
  Vector8 begin = in_body(of_a, start);
  const auto is_new = dot(start, start) == zero;
  if (any(is_new))
    begin = select(is_new, first_normal(a.formulas(), b.formulas(), seen, a.nearest_pole().normal),
                   begin);
  const Search::State x =
      searching.descend(searching.at_normal(begin), Search::Goal::LEAST_OVERLAP, true, zero < one);
  const auto proven = (x.overlap < zero) | is_proven(a.formulas(), other, x, deep_overlap(a, b));
  const unsigned done = less_bits(select(proven, zero, one), splat<Vec8>(0.5)) & pairs.all();
  hand_out(pairs, of_a, x, other.center(), done);
  for (int k = 0; k < near_count; k++) {
    if (done >> k & 1U) continue;
    const CollisionJob &job = pairs.job(k);
    finish(a, *job.pose_a, find_common_normal(a, b, relative_pose(*job.pose_a, *job.pose_b)),
           job.direction, *job.contacts);
  }
  near_count = 0;
}

/* As finish(). */

void EightPairs::hand_out(const Lanes &pairs, const EightPoses &poses, const Search::State &x,
                          const Vector8 &center_of_b, unsigned done) const
{
  const Vector8 normal = in_space(poses, x.normal),
                middle = in_space(poses, splat<Vec8>(0.5) *
                                             (x.of_a.place + (center_of_b - x.of_b.place))) +
                         poses.position;
  const Vec8 of_a = a.curvature_for_laws(x.of_a), of_b = b.curvature_for_laws(x.of_b.own);
  alignas(64) double overlap[lanes], curvature[2][lanes];
  store(overlap, x.overlap);
  store(curvature[0], of_a);
  store(curvature[1], of_b);
  Vector middle_of[lanes];
  for_each_of_eight(middle, lanes, [&](int k, const Vector &one) { middle_of[k] = one; });
  for_each_of_eight(normal, pairs.count, [&](int k, const Vector &n) {
    if (!(done >> k & 1U)) return;
    const CollisionJob &job = pairs.job(k);
    if (overlap[k] > 0.0)
      add_contact(*job.contacts, n, middle_of[k], overlap[k], curvature[0][k], curvature[1][k]);
    else
      job.direction->direction = -n;
  });
}

}    // namespace

bool superellipsoid_and_superellipsoid(const PlacedSuperellipsoid &a, const PlacedSuperellipsoid &b,
                                       const CollisionRequest &how, ShapeContacts &contacts)
{
  contacts.clear();
  Vector start{0.0, 0.0, 0.0};
  if (how.start) start = a.pose.direction_in_body(-*how.start);
  finish(a.geometry, a.pose,
         find_common_normal(a.geometry, b.geometry, relative_pose(a.pose, b.pose), start),
         how.direction, contacts);
  return !contacts.points.empty();
}

void many_superellipsoids(const CollisionJob *jobs, int count)
{
  std::vector<bool> done(count, false);
  for (int first = 0; first < count; first++) {
    if (done[first]) continue;
    const Geometry *const a = jobs[first].a, *const b = jobs[first].b;
    EightPairs pairs(static_cast<const Superellipsoid &>(*a),
                     static_cast<const Superellipsoid &>(*b));
    for (int k = first; k < count; k++) {
      if (done[k] || jobs[k].a != a || jobs[k].b != b) continue;
      done[k] = true;
      pairs.add(jobs[k]);
    }
  }
}

}    // namespace Talus
