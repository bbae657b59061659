// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/external_loads.h"

#include "atom.h"
#include "domain.h"
#include "fix.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

void copy_row(const double *from, double *to)
{
  std::copy(from, from + 3, to);
}

void add_row(double factor, const double *row, double *to)
{
  for (int d = 0; d < 3; d++) to[d] += factor * row[d];
}

bool is_zero(const double *row)
{
  return row[0] == 0.0 && row[1] == 0.0 && row[2] == 0.0;
}

/// c = sum c_k and u = sum c_k u_k / c.
class WeightedMean {
 public:
  void add(double coefficient, const double *value)
  {
    weight += coefficient;
    add_row(coefficient, value, sum);
  }
  /// u stays as it is where c is 0.
  void give(double &coefficient, double *value) const
  {
    coefficient = weight;
    for (int d = 0; d < 3 && weight > 0.0; d++) value[d] = sum[d] / weight;
  }

 private:
  double weight = 0.0, sum[3] = {};
};

}    // namespace

/* ---- who has put something ------------------------------------------------------------------ */

int ExternalLoads::place_of(int partner) const
{
  const auto found = std::find(partners.begin(), partners.end(), partner);
  return found == partners.end() ? -1 : static_cast<int>(found - partners.begin());
}

int ExternalLoads::take_place(int partner)
{
  if (const int known = place_of(partner); known >= 0) return known;
  partners.push_back(partner);
  if (partners.size() == 2) divide();
  if (partners.size() > 1) layers.emplace_back(what.size(), Part{});
  set_maxexchange();
  return static_cast<int>(partners.size()) - 1;
}

/* What the only one has put is its part. */

void ExternalLoads::divide()
{
  Layer first(what.size(), Part{});
  for (std::size_t i = 0; i < what.size(); i++) {
    settle_impulse(static_cast<int>(i));
    Part &part = first[i];
    part.kinds = what[i] & KINDS;
    copy_row(loads[i].force, part.force);
    copy_row(rest[i].torque, part.torque);
    part.coefficient = loads[i].coefficient;
    copy_row(loads[i].fluid_velocity, part.fluid_velocity);
    part.spin_coefficient = rest[i].spin_coefficient;
    copy_row(rest[i].fluid_omega, part.fluid_omega);
    part.heat = rest[i].heat;
    std::swap(part.for_particles, rest[i].for_particles);
    std::swap(part.for_fields, rest[i].for_fields);
  }
  layers.push_back(std::move(first));
}

/* Sums are those of the last one already. */

void ExternalLoads::unite()
{
  for (std::size_t i = 0; i < what.size(); i++) {
    copy_row(layers[0][i].for_particles, rest[i].for_particles);
    copy_row(layers[0][i].for_fields, rest[i].for_fields);
  }
  layers.clear();
}

/* What it had put is taken off before. */

void ExternalLoads::drop_place(int layer)
{
  if (std::find(gone.begin(), gone.end(), partners[layer]) == gone.end())
    gone.push_back(partners[layer]);
  partners.erase(partners.begin() + layer);
  if (layers.empty()) return;
  layers.erase(layers.begin() + layer);
  if (layers.size() == 1) unite();
  set_maxexchange();
}

/* ---- parts and sums ------------------------------------------------------------------------- */

ExternalLoads::Place ExternalLoads::place(int layer, int i)
{
  if (layers.empty())
    return {loads[i].force,
            rest[i].torque,
            &loads[i].coefficient,
            loads[i].fluid_velocity,
            &rest[i].spin_coefficient,
            rest[i].fluid_omega,
            &rest[i].heat};
  Part &part = layers[layer][i];
  return {
      part.force,       part.torque, &part.coefficient, part.fluid_velocity, &part.spin_coefficient,
      part.fluid_omega, &part.heat};
}

ExternalLoads::Counts ExternalLoads::counts_of(int layer, int i)
{
  if (!layers.empty()) return {layers[layer][i].for_particles, layers[layer][i].for_fields};
  settle_impulse(i);
  return {rest[i].for_particles, rest[i].for_fields};
}

void ExternalLoads::set_kinds(int layer, int i, unsigned some)
{
  if (layers.empty()) return set(i, some);
  Part &part = layers[layer][i];
  part.kinds = static_cast<unsigned>(part.kinds) | some;
}

void ExternalLoads::unset_kinds(int layer, unsigned some)
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (layers.empty()) {
      unset(i, some);
      continue;
    }
    Part &part = layers[layer][i];
    part.kinds = static_cast<unsigned>(part.kinds) & ~some;
  }
}

void ExternalLoads::add_up(int i)
{
  if (layers.empty()) return;
  Load &load = loads[i];
  Rest &others = rest[i];
  double force[3] = {}, torque[3] = {}, heat = 0.0;
  WeightedMean drag, spin;
  unsigned kinds = 0;
  for (const Layer &layer : layers) {
    const Part &part = layer[i];
    kinds |= static_cast<unsigned>(part.kinds);
    if (has(part, FORCE)) add_row(1.0, part.force, force);
    if (has(part, TORQUE)) add_row(1.0, part.torque, torque);
    if (has(part, HEAT)) heat += part.heat;
    if (has(part, DRAG)) drag.add(part.coefficient, part.fluid_velocity);
    if (has(part, SPIN)) spin.add(part.spin_coefficient, part.fluid_omega);
  }
  copy_row(force, load.force);
  copy_row(torque, others.torque);
  others.heat = heat;
  drag.give(load.coefficient, load.fluid_velocity);
  spin.give(others.spin_coefficient, others.fluid_omega);
  unset(i, KINDS);
  set(i, kinds);
}

bool ExternalLoads::is_idle(const Part &part)
{
  return part.kinds == 0.0 && is_zero(part.for_particles) && is_zero(part.for_fields);
}

/* The drag c (u - v) tells v, and so the part c_k (u_k - v) of each. */

void ExternalLoads::count_drag(int i, double time)
{
  Load &load = loads[i];
  if (layers.empty()) return add_row(time, load.drag, load.impulse);
  for (Layer &layer : layers) {
    Part &part = layer[i];
    if (!has(part, DRAG)) continue;
    for (int d = 0; d < domain->dimension; d++) {
      const double drag = part.coefficient * (load.drag[d] / load.coefficient +
                                              (part.fluid_velocity[d] - load.fluid_velocity[d]));
      part.for_particles[d] += time * drag;
      part.for_fields[d] += time * drag;
    }
  }
}

/* ---- what travels with particles, and snapshots --------------------------------------------- */

int ExternalLoads::most_packed() const
{
  return size_packed + size_part * static_cast<int>(layers.size());
}

void ExternalLoads::set_maxexchange()
{
  if (fix) fix->maxexchange = most_packed();
}

void ExternalLoads::exchange_state(StateExchange &x)
{
  x(partners);
  if (!x.restores()) return;
  layers.assign(partners.size() > 1 ? partners.size() : 0, Layer(what.size(), Part{}));
  set_maxexchange();
}

void ExternalLoads::state_is_restored()
{
  for (const int partner : std::vector<int>(gone)) clear(partner);
}

}    // namespace Talus
