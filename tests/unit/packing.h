// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A random polydisperse packing and its slow reference: all contacts found and added by brute
// force, histories kept in a map. Particles are known by their place in the arrays; hosts may
// number them differently.

#ifndef TALUS_TEST_PACKING_H
#define TALUS_TEST_PACKING_H

#include "base/cube_root.h"
#include "law_states.h"
#include "material/law_table.h"
#include "particles/canonical_key.h"

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace slow {

using Vector = reference::Triple<double>;
using reference::infinity;
using reference::inner;
using reference::norm;
using reference::outer;
using reference::plain;

inline Talus::Vector3<double> talus(const Vector &a)
{
  return {a[0], a[1], a[2]};
}

/// s a + b
inline Vector axpy(double s, const Vector &a, const Vector &b)
{
  using namespace reference;
  return s * a + b;
}

/// Of a contact, as body 0 sees it.
struct Outcome {
  Vector force{};
  std::array<Vector, 2> torque{};
  Vector history{};
  bool sliding = false, clear_case = true;
  double force_scale = 0.0, history_scale = 0.0;
};

/// normal: from body 1 to body 0; history: of body 0. Those of the contact are the other way round.
inline Outcome evaluate(reference::Contact c, const Vector &normal, const Vector &history,
                        const Talus::ContactLaw &law, const Talus::ContactCoefficients &row,
                        double dt, bool advance)
{
  const auto narrow = [](double sign, const reference::Vector &v) {
    const auto part = [&](int d) { return sign * static_cast<double>(v[d]); };
    return Vector{part(0), part(1), part(2)};
  };
  c.normal = reference::widen(axpy(-1.0, normal, {}));
  c.history = reference::widen(axpy(-1.0, history, {}));
  const reference::Outcome out = reference::evaluate(
      c, named::named_law(law), reference::composite_of(named::numbers_of(law, row)), dt, advance);
  return {narrow(1.0, out.force),
          {narrow(1.0, out.torque[0]), narrow(1.0, out.torque[1])},
          narrow(-1.0, out.history),
          out.sliding,
          out.clear_case,
          static_cast<double>(out.force_scale),
          static_cast<double>(out.history_scale)};
}

struct Packing {
  std::vector<Vector> x, v, omega;
  std::vector<double> radius, mass, mass_override;
  std::vector<int> type;
  std::vector<std::int64_t> tag;
  std::vector<std::uint64_t> key;

  int size() const { return static_cast<int>(x.size()); }

  /// Every particle flies on; `kick` changes velocities at random.
  void move(double dt, double kick, RandomSource &random)
  {
    for (int i = 0; i < size(); i++) {
      v[i] = axpy(kick, random.in_cube(1.0), v[i]);
      x[i] = axpy(dt, v[i], x[i]);
    }
  }

  void refresh_keys(double inverse_cell)
  {
    for (int i = 0; i < size(); i++) key[i] = Talus::canonical_key(x[i].data(), inverse_cell);
  }
};

/// n spheres of three types, overlapping at random, about four contacts each.
inline Packing random_packing(int n, RandomSource &random)
{
  Packing p;
  const double half = 0.5 * Talus::cube_root(2.9 * n);
  for (int i = 0; i < n; i++) {
    p.x.push_back(random.in_cube(half));
    p.v.push_back(random.in_cube(1.0));
    p.omega.push_back(random.in_cube(2.0));
    p.radius.push_back(random.uniform(0.4, 1.0));
    p.mass.push_back(random.uniform(0.5, 3.0));
    p.mass_override.push_back(i % 17 == 3 ? infinity : i % 19 == 5 ? 40.0 : 0.0);
    p.type.push_back(1 + random.below(3));
    p.tag.push_back(1 + i);
    p.key.push_back(0);
  }
  random.shuffle(p.tag);
  p.refresh_keys(0.7);    // cells that hold a few particles: the tag decides as well
  return p;
}

inline constexpr int num_types = 3;

/// Six laws at once, one for each pair of types, frictionless ones among them.
inline Talus::LawTable mixed_laws()
{
  using N = named::Normal;
  using T = named::Tangential;
  Talus::LawTable table;
  table.reset(num_types);
  named::set(table, 1, 1, {N::HOOKE, T::NONE}, {900.0, 5.0, 0.0, 0.0, 0.0, 0.0});
  named::set(table, 2, 2, {N::HERTZ, T::MULTISTEP}, {800.0, 3.0, 300.0, 2.0, 0.2, -infinity});
  named::set(table, 3, 3, {N::HOOKE, T::MULTISTEP}, {700.0, 4.0, 200.0, 1.0, 0.3, 0.0});
  named::set(table, 1, 2, {N::HERTZ, T::DASHPOT}, {850.0, 2.0, 0.0, 30.0, 0.4, -infinity});
  named::set(table, 1, 3, {N::HERTZ, T::NONE}, {750.0, 9.0, 0.0, 0.0, 0.0, -infinity});
  named::set(table, 2, 3, {N::HOOKE, T::ONESTEP}, {650.0, 1.0, 400.0, 20.0, 0.5, 0.0});
  table.finish();
  return table;
}

/// One law; with `spread` its coefficients differ between types, else one row serves all.
inline Talus::LawTable single_law(named::NamedLaw law, bool spread)
{
  Talus::LawTable table;
  table.reset(num_types);
  for (int i = 1; i <= num_types; i++)
    for (int j = i; j <= num_types; j++) {
      const double s = spread ? i + j : 1.0;
      named::set(table, i, j, law, {800.0 * s, 3.0 * s, 300.0 * s, 5.0 / s, 0.1 * s, -infinity});
    }
  table.finish();
  return table;
}

struct Neighbors {
  int i, j;
  double weight;
};

/// All pairs that are closer than their radii plus skin. With `weighted` some forces are scaled.
inline std::vector<Neighbors> candidates(const Packing &p, double skin, bool weighted)
{
  std::vector<Neighbors> list;
  for (int i = 0; i < p.size(); i++)
    for (int j = i + 1; j < p.size(); j++) {
      if (norm(axpy(-1.0, p.x[j], p.x[i])) >= p.radius[i] + p.radius[j] + skin) continue;
      const std::int64_t sum = p.tag[i] + p.tag[j];
      const double weight = sum % 3 == 0 ? 0.5 : sum % 7 == 0 ? 0.1 : 1.0;
      list.push_back({i, j, weighted ? weight : 1.0});
    }
  return list;
}

struct PairOutcome {
  Outcome out;
  double weight, scale;    ///< scale: how large the rounding error of this pair may be, times 1e-16
};

/// All contacts of a packing, computed one by one. Owns the histories.
class BruteForce {
 public:
  /// Contacts by (i, j), i < j. With `advance` the histories move on.
  std::map<std::pair<int, int>, PairOutcome> contacts;

  void compute(const Packing &p, const Talus::LawTable &laws, double dt, bool advance,
               bool weighted)
  {
    contacts.clear();
    for (const Neighbors &n : candidates(p, 0.0, weighted)) {
      const Vector separation = axpy(-1.0, p.x[n.j], p.x[n.i]);
      const double distance = norm(separation), reach = p.radius[n.i] + p.radius[n.j];
      const double overlap = distance > 0.0 ? reach - distance : 0.0;
      const int row = laws.row(p.type[n.i], p.type[n.j]);
      reference::Contact c = contact_of(p, n.i, n.j);
      c.overlap = overlap;
      const auto known = histories.find({n.i, n.j});
      const bool is_known = known != histories.end();
      c.sliding = is_known && known->second.second;
      const Outcome out = evaluate(c, axpy(distance > 0.0 ? 1.0 / distance : 0.0, separation, {}),
                                   is_known ? known->second.first : Vector{}, laws.law(row),
                                   laws.coefficients(row), dt, advance);
      // the overlap is a small difference: what that costs
      const double condition = overlap > 0.0 ? 1.0 + reach / overlap : 1.0;
      contacts[{n.i, n.j}] = {out, n.weight, out.force_scale * condition};
    }
    if (!advance) return;
    histories.clear();    // whoever does not touch loses the history
    for (const auto &[pair, contact] : contacts)
      histories[pair] = {contact.out.history, contact.out.sliding};
  }

  struct Sums {
    std::vector<Vector> force, torque;
    std::vector<double> scale;
  };
  Sums sums(int num_particles) const
  {
    Sums s;
    s.force.resize(num_particles);
    s.torque.resize(num_particles);
    s.scale.resize(num_particles);
    for (const auto &[pair, c] : contacts) {
      const auto [i, j] = pair;
      s.force[i] = axpy(c.weight, c.out.force, s.force[i]);
      s.force[j] = axpy(-c.weight, c.out.force, s.force[j]);
      s.torque[i] = axpy(c.weight, c.out.torque[0], s.torque[i]);
      s.torque[j] = axpy(c.weight, c.out.torque[1], s.torque[j]);
      s.scale[i] += c.scale;
      s.scale[j] += c.scale;
    }
    return s;
  }

 private:
  std::map<std::pair<int, int>, std::pair<Vector, bool>> histories;

  static reference::Contact contact_of(const Packing &p, int i, int j)
  {
    reference::Contact c;
    int body = 0;
    for (const int a : {i, j}) {
      c.radius[body] = p.radius[a];
      c.mass[body] = p.mass_override[a] > 0.0 ? p.mass_override[a] : p.mass[a];
      c.velocity[body] = reference::widen(p.v[a]);
      c.omega[body++] = reference::widen(p.omega[a]);
    }
    return c;
  }
};

}    // namespace slow

#endif
