// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/shaped_pairs.h"

#include <algorithm>
#include <cstring>

namespace Talus {
namespace {

constexpr std::size_t size_message = 2 + 1 + point_memory_size;    // IDs, name, memory

}    // namespace

void ShapedPairs::set_pairs(const ShapedView &view, const std::vector<std::array<int, 2>> &pairs,
                            const std::vector<std::int64_t> &tag, const LawTable &laws)
{
  const auto radius_inside = [&](int i) {
    return shapes.radius_inside(view.type(i), view.radius(i));
  };
  std::vector<Pair> found;
  for (const auto &[a, b] : pairs) {
    if (tag[a] == tag[b]) continue;
    const auto [first, second] = tag[a] < tag[b] ? std::pair(a, b) : std::pair(b, a);
    found.push_back({first,
                     second,
                     {tag[first], tag[second]},
                     std::min(radius_inside(first), radius_inside(second))});
  }
  std::sort(found.begin(), found.end(), [](const Pair &one, const Pair &other) {
    return one.first != other.first ? one.first < other.first : one.second < other.second;
  });
  set_list(std::move(found), view.owned(), most_of_chunk);
  searches.clear();
  for (const Pair &pair : list) {
    const int of_first = view.type(pair.first), of_second = view.type(pair.second);
    searches.push_back({laws.row(of_first, of_second), shapes.collision(of_first, of_second)});
  }
  results.assign(list.size(), Result{});
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

/* New ones have none, nor have pairs that were renumbered to other sides. */

void ShapedPairs::restore(const ContactLists &from, const std::function<std::int64_t(int)> &name_of)
{
  restore_points(from, [&](const Pair &pair) -> Stored {
    const std::int64_t first = name_of(pair.first), second = name_of(pair.second);
    if (first == 0 || first >= second) return {pair.first, 0};
    return pair.first < owned ? Stored{pair.first, second} : Stored{pair.second, first};
  });
}

void ShapedPairs::save_in_periodic_box(ContactLists &to, int this_rank,
                                       const std::function<int(int)> &owner_of,
                                       Messages &messages) const
{
  messages.clear();
  for_each_point([&](const Pair &pair, const PointContact &point) {
    if (pair.first >= owned || !keep_history(point, pair.first, pair.name[1], to)) return;
    if (pair.second < owned) {
      keep_history(point, pair.second, pair.name[0], to);
      return;
    }
    std::vector<double> &message = messages[owner_of(pair.second)];
    const std::size_t begin = message.size();
    message.resize(begin + size_message);
    std::memcpy(&message[begin], pair.name, sizeof pair.name);
    std::memcpy(&message[begin + 2], &point.name, sizeof point.name);
    write_memory(point, &message[begin + 3]);
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
    if (pair.first >= owned) second_of[{pair.name[0], pair.name[1]}] = pair.second;
  for (std::size_t n = 0; n < message.size(); n += size_message) {
    std::array<std::int64_t, 2> tags{};
    PointContact point{};
    std::memcpy(tags.data(), &message[n], sizeof tags);
    std::memcpy(&point.name, &message[n + 2], sizeof point.name);
    read_memory(&message[n + 3], point);
    if (const auto found = second_of.find(tags); found != second_of.end())
      keep_history(point, found->second, tags[0], to);
  }
}

/* ---------------------------------------------------------------------- */

void ShapedPairs::compute(const ShapedView &view, const LawTable &laws, const Step &step)
{
  if (list.empty()) return;
  dt = step.dt;
  place_solids(view, step.threads);
  const double weight = step.account ? static_cast<double>(step.weight_of_changes) : 0.0;
  const auto find = [&](Chunk &chunk, Scratch &with) {
    find_contacts(laws, step.advance, chunk, with);
    for (int p = chunk.begin; p < chunk.end; p++)
      take_pair(view, weight, chunk, p, with.found[p - chunk.begin]);
  };
  compute_points({laws, step.dt, step.advance, step.account}, step.threads, find,
                 [&](int c) { sum_points(chunks[c]); });
  add_to_particles(view, step.threads);
  if (step.account) account_for_work(*step.account);
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

/* Pairs whose contacts are found several at a time come last. A set-up begins where the last step did. */

void ShapedPairs::find_contacts(const LawTable &laws, bool advance, const Chunk &chunk,
                                Scratch &with)
{
  with.jobs.clear();
  with.of_job.clear();
  std::size_t known = 0;
  for (int p = chunk.begin; p < chunk.end; p++) {
    while (known < chunk.of_before.size() && chunk.of_before[known] < p) known++;
    ShapeContacts &found = with.found[p - chunk.begin];
    found.clear();
    Search &search = searches[p];
    const Solid &a = solids[list[p].first], &b = solids[list[p].second];
    if (!a.may_touch(b)) continue;
    if (search.collision.of_many()) {
      const bool has_start = known < chunk.of_before.size() && chunk.of_before[known] == p &&
                             chunk.before[known].begins_search;
      if (has_start) found.start = advance ? chunk.before[known].normal : chunk.before[known].start;
      CollisionJob &job = with.jobs.emplace_back();
      job.a = &a.geometry();
      job.b = &b.geometry();
      job.pose_a = &a.pose;
      job.pose_b = &b.pose;
      job.direction = &search.direction;
      job.contacts = &found;
      job.start = has_start ? &found.start : nullptr;
      with.of_job.push_back(search.collision.of_many());
      continue;
    }
    const CollisionRequest request{laws.force_exponent(search.row), shapes.method(),
                                   &search.direction};
    search.collision(a.geometry(), a.pose, b.geometry(), b.pose, request, found);
  }
  const int count = static_cast<int>(with.jobs.size());
  for (int begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && with.of_job[end] == with.of_job[begin]) end++;
    with.of_job[begin](&with.jobs[begin], end - begin);
  }
}

void ShapedPairs::take_pair(const ShapedView &view, double weight_of_changes, Chunk &chunk, int p,
                            const ShapeContacts &found)
{
  if (found.points.empty()) return;
  Search &search = searches[p];
  if (found.core_depth > search.core_depth) {
    search.core_depth = found.core_depth;
    search.core_ratio = found.core_ratio;
  }
  const int i = list[p].first, j = list[p].second;
  const double inverse_mass = view.inverse_mass(i) + view.inverse_mass(j);
  take_points(chunk, p, 0, found, [&](const ShapeContact &one, PointContact &point) {
    point.row = search.row;
    point.inverse_mass = inverse_mass;
    point.inverse_radius = one.curvature[0] + one.curvature[1];
    point.velocity = view.velocity_at(i, one.position) - view.velocity_at(j, one.position);
    if (weight_of_changes != 0.0)
      point.velocity_change =
          weight_of_changes * (view.change_at(i, one.position) - view.change_at(j, one.position));
  });
}

ShapedPairs::CoreOverlap ShapedPairs::deepest_core_overlap() const
{
  CoreOverlap deepest;
  for (std::size_t p = 0; p < list.size(); p++)
    if (searches[p].core_depth > deepest.depth)
      deepest = {searches[p].core_depth, searches[p].core_ratio, list[p].first, list[p].second};
  return deepest;
}

void ShapedPairs::sum_points(const Chunk &chunk)
{
  for (int p = chunk.begin; p < chunk.end; p++) results[p] = Result{};
  for (std::size_t n = 0; n < chunk.points.size(); n++) {
    const PointContact &point = chunk.points[n];
    const Pair &pair = list[chunk.of_point[n]];
    Result &sum = results[chunk.of_point[n]];
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

void ShapedPairs::for_each_contact(const LawTable &laws, const VisitContact &visit) const
{
  for_each_point([&](const Pair &pair, const PointContact &point) {
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
  });
}

ShapedPairs::Count ShapedPairs::count() const
{
  Count sum;
  for (std::size_t p = 0; p < list.size(); p++) {
    const double counts = share(list[p]);
    sum.pairs += counts;
    if (results[p].points) sum.contacts += counts;
    sum.points += results[p].points * counts;
  }
  return sum;
}

double ShapedPairs::memory_usage() const
{
  const std::size_t bytes =
      searches.capacity() * sizeof(Search) + results.capacity() * sizeof(Result) +
      sides.capacity() * sizeof(Side) + solids.capacity() * sizeof(Solid) +
      (used.capacity() + particles.capacity() + first_side.capacity()) * sizeof(int);
  return ContactPoints::memory_usage() + static_cast<double>(bytes);
}

}    // namespace Talus
