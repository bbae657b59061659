// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/shaped_pairs.h"

#include "base/in_parallel.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

constexpr int pairs_of_chunk = 128;
constexpr std::size_t size_message = 2 + 1 + point_history_size;    // IDs, name, history

}    // namespace

void ShapedPairs::set_pairs(const ShapedView &view, const std::vector<std::array<int, 2>> &pairs,
                            const std::vector<std::int64_t> &tag, const LawTable &laws)
{
  owned = view.owned();
  list.clear();
  for (const auto &[a, b] : pairs) {
    if (tag[a] == tag[b]) continue;
    const bool in_order = tag[a] < tag[b];
    const int first = in_order ? a : b, second = in_order ? b : a;
    const int of_first = view.type(first), of_second = view.type(second);
    list.push_back({first,
                    second,
                    laws.row(of_first, of_second),
                    std::min(radius_inside(view, first), radius_inside(view, second)),
                    {tag[first], tag[second]},
                    shapes.collision(of_first, of_second),
                    {}});
  }
  std::sort(list.begin(), list.end(), [](const Pair &one, const Pair &other) {
    return one.first != other.first ? one.first < other.first : one.second < other.second;
  });
  results.assign(list.size(), Result{});
  chunks.clear();
  const int all = static_cast<int>(list.size());
  for (int begin = 0; begin < all; begin += pairs_of_chunk)
    chunks.push_back({begin, std::min(begin + pairs_of_chunk, all)});
  set_sides(view, tag);
}

void ShapedPairs::set_sides(const ShapedView &view, const std::vector<std::int64_t> &tag)
{
  std::vector<std::pair<int, Side>> found;    // owned particle, and its side of a pair
  used.clear();
  for (int p = 0; p < static_cast<int>(list.size()); p++) {
    const Pair &pair = list[p];
    if (pair.first < owned) found.push_back({pair.first, {p, false}});
    if (pair.second < owned) found.push_back({pair.second, {p, true}});
    used.push_back(pair.first);
    used.push_back(pair.second);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  solids.resize(view.total);

  const auto partner = [&](const Side &side) {
    return tag[side.second ? list[side.pair].first : list[side.pair].second];
  };
  // of two images of one partner at most one touches
  std::sort(found.begin(), found.end(), [&](const auto &one, const auto &other) {
    if (one.first != other.first) return one.first < other.first;
    const std::int64_t a = partner(one.second), b = partner(other.second);
    return a != b ? a < b : one.second.pair < other.second.pair;
  });
  particles.clear();
  first_side.clear();
  sides.clear();
  for (const auto &[particle, side] : found) {
    if (particles.empty() || particles.back() != particle) {
      particles.push_back(particle);
      first_side.push_back(static_cast<int>(sides.size()));
    }
    sides.push_back(side);
  }
  first_side.push_back(static_cast<int>(sides.size()));
}

/* Points that have only a history so far: the narrow phase will find them again, or drop them. */

void ShapedPairs::restore(const ContactLists &from, const std::function<std::int64_t(int)> &name_of)
{
  for (Chunk &chunk : chunks) {
    chunk.points.clear();
    chunk.pair_of_point.clear();
    for (int p = chunk.begin; p < chunk.end; p++) {
      const Pair &pair = list[p];
      const bool of_first = pair.first < owned;
      const std::int64_t name[2] = {name_of(pair.first), name_of(pair.second)};
      if (name[0] == 0 || name[0] >= name[1]) continue;    // new ones, or renumbered to other sides
      from.for_each(of_first ? pair.first : pair.second, [&](const ContactLists::Contact &one) {
        if (one.partner != name[of_first ? 1 : 0] || !(one.feature & ContactLists::of_shape))
          return;
        chunk.points.push_back(stored_point(one));
        chunk.pair_of_point.push_back(p);
      });
    }
  }
}

template <class Visit> void ShapedPairs::for_each_point_of_pair(Visit visit) const
{
  for (const Chunk &chunk : chunks)
    for (std::size_t n = 0; n < chunk.points.size(); n++)
      visit(list[chunk.pair_of_point[n]], chunk.points[n]);
}

void ShapedPairs::save(ContactLists &to) const
{
  for_each_point_of_pair([&](const Pair &pair, const PointContact &point) {
    if (pair.first < owned) keep_history(point, pair.first, pair.tag[1], to);
    if (pair.second < owned) keep_history(point, pair.second, pair.tag[0], to);
  });
}

void ShapedPairs::save_in_periodic_box(ContactLists &to, int this_rank,
                                       const std::function<int(int)> &owner_of,
                                       Messages &messages) const
{
  messages.clear();
  for_each_point_of_pair([&](const Pair &pair, const PointContact &point) {
    if (pair.first >= owned || !keep_history(point, pair.first, pair.tag[1], to)) return;
    if (pair.second < owned) {
      keep_history(point, pair.second, pair.tag[0], to);
      return;
    }
    std::vector<double> &message = messages[owner_of(pair.second)];
    const std::size_t begin = message.size();
    message.resize(begin + size_message);
    std::memcpy(&message[begin], pair.tag, sizeof pair.tag);
    std::memcpy(&message[begin + 2], &point.name, sizeof point.name);
    std::copy(point.history.begin(), point.history.end(), &message[begin + 3]);
  });
  const auto images = messages.find(this_rank);
  if (images == messages.end()) return;
  receive(images->second, to);
  messages.erase(images);
}

void ShapedPairs::receive(const std::vector<double> &message, ContactLists &to) const
{
  std::map<std::array<std::int64_t, 2>, int> second_of;
  for (const Pair &pair : list)
    if (pair.first >= owned) second_of[{pair.tag[0], pair.tag[1]}] = pair.second;
  for (std::size_t n = 0; n < message.size(); n += size_message) {
    std::array<std::int64_t, 2> tags{};
    PointContact point{};
    std::memcpy(tags.data(), &message[n], sizeof tags);
    std::memcpy(&point.name, &message[n + 2], sizeof point.name);
    std::copy_n(&message[n + 3], point_history_size, point.history.begin());
    if (const auto found = second_of.find(tags); found != second_of.end())
      keep_history(point, found->second, tags[0], to);
  }
}

/* ---------------------------------------------------------------------- */

void ShapedPairs::compute(const ShapedView &view, const LawTable &laws, const Step &step)
{
  if (list.empty()) return;
  dt = step.dt;
  while (static_cast<int>(scratch.size()) < step.threads)
    scratch.push_back(std::make_unique<Scratch>());
  place_solids(view, step.threads);
  in_ranges(static_cast<std::int64_t>(chunks.size()), step.threads, [&](int t, int begin, int end) {
    for (int c = begin; c < end; c++) compute_chunk(view, laws, step, chunks[c], *scratch[t]);
  });
  add_to_particles(view, step.threads);
  if (step.account) account(*step.account);
}

void ShapedPairs::place_solids(const ShapedView &view, int threads)
{
  in_ranges(static_cast<std::int64_t>(used.size()), threads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      const int i = used[n];
      Solid &solid = solids[i];
      const ParticleShape *shape = shapes.of(view.type(i));
      solid.shape = shape ? &shape->shape() : nullptr;
      solid.bounding_sphere.radius = view.radius(i);
      solid.pose.position = view.position(i);
      if (shape) solid.pose = shape->pose(solid.pose.position, view.quaternion(i));
    }
  });
}

void ShapedPairs::compute_chunk(const ShapedView &view, const LawTable &laws, const Step &step,
                                Chunk &chunk, Scratch &with)
{
  std::swap(chunk.points, chunk.before);
  std::swap(chunk.pair_of_point, chunk.pair_before);
  chunk.points.clear();
  chunk.pair_of_point.clear();
  find_contacts(laws, chunk, with);
  std::size_t old = 0;
  for (int p = chunk.begin; p < chunk.end; p++)
    take_points(view, step, chunk, p, with.found[p - chunk.begin], old);
  with.batch.compute({laws, step.dt, step.advance, step.account}, chunk.points.data(),
                     chunk.points.size());
  sum_points(chunk);
}

/* Pairs whose contacts are found several at a time come last. */

void ShapedPairs::find_contacts(const LawTable &laws, const Chunk &chunk, Scratch &with)
{
  with.found.resize(pairs_of_chunk);
  with.jobs.clear();
  with.of_job.clear();
  for (int p = chunk.begin; p < chunk.end; p++) {
    ShapeContacts &found = with.found[p - chunk.begin];
    found.clear();
    Pair &pair = list[p];
    const Solid &a = solids[pair.first], &b = solids[pair.second];
    if (!a.may_touch(b)) continue;
    if (pair.collision.of_many()) {
      with.jobs.push_back(
          {&a.geometry(), &b.geometry(), &a.pose, &b.pose, &pair.direction, &found});
      with.of_job.push_back(pair.collision.of_many());
      continue;
    }
    const CollisionRequest request{laws.force_exponent(pair.row), shapes.method(), &pair.direction};
    pair.collision(a.geometry(), a.pose, b.geometry(), b.pose, request, found);
  }
  const int count = static_cast<int>(with.jobs.size());
  for (int begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && with.of_job[end] == with.of_job[begin]) end++;
    with.of_job[begin](&with.jobs[begin], end - begin);
  }
}

double ShapedPairs::radius_inside(const ShapedView &view, int i) const
{
  const ParticleShape *shape = shapes.of(view.type(i));
  return shape ? shape->shape().inscribed_radius() : view.radius(i);
}

/* Points of a pair that touched before stand from `old` on: they are looked up by their feature. */

void ShapedPairs::take_points(const ShapedView &view, const Step &step, Chunk &chunk, int p,
                              const ShapeContacts &found, std::size_t &old)
{
  const Pair &pair = list[p];
  const std::size_t known = old;
  while (old < chunk.pair_before.size() && chunk.pair_before[old] == p) old++;
  if (found.points.empty()) return;
  if (found.core_depth > chunk.cores.depth)
    chunk.cores = {found.core_depth, found.core_ratio, pair.first, pair.second};
  const int i = pair.first, j = pair.second;
  const double change = step.account ? static_cast<double>(step.weight_of_changes) : 0.0;
  PointContact point{};
  point.inverse_mass = view.inverse_mass(i) + view.inverse_mass(j);
  point.row = pair.row;
  for (const ShapeContact &one : found.points) {
    point.place = one.position;
    point.normal = one.normal;
    point.overlap = one.overlap;
    point.weight = one.weight;
    point.energy = one.energy;
    point.inverse_radius = one.curvature[0] + one.curvature[1];
    point.name = one.name;
    point.velocity = view.velocity_at(i, one.position) - view.velocity_at(j, one.position);
    if (change != 0.0)
      point.velocity_change =
          change * (view.change_at(i, one.position) - view.change_at(j, one.position));
    point.history = {};
    for (std::size_t n = known; n < old; n++)
      if (chunk.before[n].name == one.name) point.history = chunk.before[n].history;
    chunk.points.push_back(point);
    chunk.pair_of_point.push_back(p);
    if (one.overlap > chunk.deepest.overlap_ratio * pair.size)
      chunk.deepest = {one.overlap / pair.size, i, j};
  }
}

DeepestContact ShapedPairs::deepest_since_set() const
{
  DeepestContact deepest{DeepestContact::watched};
  for (const Chunk &chunk : chunks) deepest = std::max(deepest, chunk.deepest);
  return deepest;
}

ShapedPairs::CoreOverlap ShapedPairs::deepest_core_overlap() const
{
  CoreOverlap deepest;
  for (const Chunk &chunk : chunks)
    if (chunk.cores.depth > deepest.depth) deepest = chunk.cores;
  return deepest;
}

void ShapedPairs::sum_points(const Chunk &chunk)
{
  for (int p = chunk.begin; p < chunk.end; p++) results[p] = Result{};
  for (std::size_t n = 0; n < chunk.points.size(); n++) {
    const PointContact &point = chunk.points[n];
    const Pair &pair = list[chunk.pair_of_point[n]];
    Result &sum = results[chunk.pair_of_point[n]];
    sum.force = sum.force + point.force;
    sum.torque_first =
        sum.torque_first + cross(point.place - solids[pair.first].center(), point.force);
    sum.torque_second =
        sum.torque_second - cross(point.place - solids[pair.second].center(), point.force);
    sum.points++;
  }
}

void ShapedPairs::add_to_particles(const ShapedView &view, int threads) const
{
  in_ranges(static_cast<std::int64_t>(particles.size()), threads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      Vector3<double> force{0.0, 0.0, 0.0}, torque = force;
      for (int s = first_side[n]; s < first_side[n + 1]; s++) {
        const Result &result = results[sides[s].pair];
        if (!result.points) continue;
        force = sides[s].second ? force - result.force : force + result.force;
        torque = torque + (sides[s].second ? result.torque_second : result.torque_first);
      }
      view.add(particles[n], force, torque);
    }
  });
}

/* In the order of the points: several of them may belong to one particle. */

void ShapedPairs::account(WorkAccount &to) const
{
  for (const Chunk &chunk : chunks)
    for (std::size_t n = 0; n < chunk.points.size(); n++) {
      const Pair &pair = list[chunk.pair_of_point[n]];
      const EnergyByCause &work = chunk.points[n].work;
      to.sum += share(pair) * work;
      for (const int i : {pair.first, pair.second})
        if (i < owned) add_work(to, i, work, 0.5);
    }
}

/* ---------------------------------------------------------------------- */

void ShapedPairs::for_each_contact(const LawTable &laws, const VisitContact &visit) const
{
  for (const Chunk &chunk : chunks)
    for (std::size_t n = 0; n < chunk.points.size(); n++) {
      const Pair &pair = list[chunk.pair_of_point[n]];
      const PointContact &point = chunk.points[n];
      ComputedContact one = PointBatch::contact_of(point);
      ContactReport &found = one.report;
      found.i = pair.first;
      found.j = pair.second;
      found.share = share(pair);
      found.center[0] = solids[pair.first].center();
      found.center[1] = solids[pair.second].center();
      found.arm[0] = point.place - found.center[0];
      found.arm[1] = point.place - found.center[1];
      found.torque[0] = cross(found.arm[0], found.force);
      found.torque[1] = -cross(found.arm[1], found.force);
      visit(one.with_energy(laws, dt));
    }
}

double ShapedPairs::count_candidates() const
{
  double count = 0.0;
  for (const Pair &pair : list) count += share(pair);
  return count;
}

double ShapedPairs::count_contacts() const
{
  double count = 0.0;
  for (std::size_t p = 0; p < list.size(); p++)
    if (results[p].points) count += share(list[p]);
  return count;
}

double ShapedPairs::count_points() const
{
  double count = 0.0;
  for (std::size_t p = 0; p < list.size(); p++) count += results[p].points * share(list[p]);
  return count;
}

double ShapedPairs::memory_usage() const
{
  std::size_t bytes =
      list.capacity() * sizeof(Pair) + results.capacity() * sizeof(Result) +
      sides.capacity() * sizeof(Side) + solids.capacity() * sizeof(Solid) +
      (used.capacity() + particles.capacity() + first_side.capacity()) * sizeof(int);
  for (const Chunk &chunk : chunks)
    bytes += (chunk.points.capacity() + chunk.before.capacity()) * sizeof(PointContact);
  return static_cast<double>(bytes);
}

}    // namespace Talus
