// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/critical_time_step.h"

#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "base/in_parallel.h"
#include "comm.h"
#include "contact/contact_survey.h"
#include "force.h"
#include "math_const.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr int around_a_particle = 12, in_a_corner = 3;    // contacts

/// 0 stands for "not defined".
double smaller_defined(double a, double b)
{
  if (!(a > 0.0)) return b;
  return b > 0.0 ? std::min(a, b) : a;
}

ContactResponse without_damping(ContactResponse contact)
{
  contact.gn = contact.gt = 0.0;
  return contact;
}

}    // namespace

void CriticalTimeStep::compute(const PairCoeffs &laws, const ContactPipeline &contacts, int group)
{
  sizes = smallest_particles(laws.num_types(), group);
  const double mine = ContactSurvey(contacts).largest_relative_speed();
  double speed;
  MPI_Allreduce(&mine, &speed, 1, MPI_DOUBLE, MPI_MAX, world);

  undamped.clear();
  elastic.clear();
  looks_at_damping = true;
  consider_pairs(laws, speed);
  contact = reduce_smallest(ContactSurvey(contacts).smallest_contact_period());
  if (!(contact > 0.0)) contact = law_period;
  contact = smaller_defined(contact, period_of_shapes);
  contact = smaller_defined(contact, smallest_body_period(laws.num_types(), group));
}

void CriticalTimeStep::compute_from_sizes(const PairCoeffs &laws, int group)
{
  looks_at_damping = false;
  sizes = smallest_particles(laws.num_types(), group);
  consider_pairs(laws, 0.0);
  contact = smaller_defined(law_period, smallest_body_period(laws.num_types(), group));
}

void CriticalTimeStep::consider_pairs(const PairCoeffs &laws, double speed)
{
  law_period = period_of_shapes = rayleigh = hertz = stable = stable_undamped = 0.0;
  order = GranularSystem::of(lmp)->integrators().order();
  for (int i = 1; i <= laws.num_types(); i++)
    for (int j = i; j <= laws.num_types(); j++) consider_pair(laws, i, j, speed);
}

double CriticalTimeStep::smallest() const
{
  return smaller_defined(contact, smaller_defined(rayleigh, hertz));
}

/* Of the particles that are members of all groups, given by their bits: radius by type, then mass in
   contacts by type, then own mass by type. */

std::vector<double> CriticalTimeStep::smallest_here(int types, int groups) const
{
  const EffectiveMasses &masses = GranularSystem::of(lmp)->masses();
  const bool rigid = masses.bodies_are_rigid();
  std::vector<double> mine(3 * (static_cast<size_t>(types) + 1), never);
  std::vector<std::vector<double>> found(comm->nthreads);
  in_ranges(atom->nlocal, comm->nthreads, [&](int t, int begin, int end) {
    std::vector<double> of_thread(mine.size(), never);
    double *const r = of_thread.data(), *const m = r + types + 1, *const own_mass = m + types + 1;
    for (int i = begin; i < end; i++) {
      if ((atom->mask[i] & groups) != groups) continue;
      const int type = atom->type[i];
      r[type] = std::min(r[type], atom->radius[i]);
      if (rigid && masses.knows(i)) m[type] = std::min(m[type], masses.of_body(i));
      own_mass[type] = std::min(own_mass[type], atom->rmass[i]);
    }
    if (!rigid) std::copy(own_mass, own_mass + types + 1, m);
    found[t] = std::move(of_thread);
  });
  for (const std::vector<double> &of_thread : found)
    std::transform(of_thread.begin(), of_thread.end(), mine.begin(), mine.begin(),
                   [](double a, double b) { return std::min(a, b); });
  return mine;
}

std::vector<double> CriticalTimeStep::sizes_here(int types, int group) const
{
  std::vector<double> sizes_of_all = smallest_here(types, group);
  std::set<int> known{group};
  for (const LargeBody *body : GranularSystem::of(lmp)->bodies().in_order())
    if (const int groups = group | body->group_bits(); known.insert(groups).second) {
      const std::vector<double> of_body = smallest_here(types, groups);
      sizes_of_all.insert(sizes_of_all.end(), of_body.begin(), of_body.end());
    }
  return sizes_of_all;
}

/* Forces are in LAMMPS' units: force/mass is acceleration only after conversion. */

CriticalTimeStep::Sizes CriticalTimeStep::smallest_particles(int types, int groups) const
{
  const std::vector<double> mine = smallest_here(types, groups);
  std::vector<double> all(mine);
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_MIN, world);
  const auto masses = all.begin() + types + 1, own_masses = masses + types + 1;
  std::for_each(masses, all.end(), [this](double &mass) { mass /= force->ftm2v; });
  std::transform(masses, own_masses, own_masses, masses,    // where that of a body is not known yet
                 [](double mass, double own_mass) { return std::isinf(mass) ? own_mass : mass; });
  Sizes result{{all.begin(), masses}, {masses, own_masses}, {own_masses, all.end()}, {}};
  for (std::size_t type = 0; type < result.radius.size(); type++) {
    const ParticleShape *shape = shape_of(static_cast<int>(type));
    result.overlap.push_back(0.01 *
                             (shape ? shape->shape().inscribed_radius() : result.radius[type]));
    if (shape && !std::isinf(result.radius[type]))
      result.radius[type] = shape->shape().contact_radius();
  }
  return result;
}

const ParticleShape *CriticalTimeStep::shape_of(int type) const
{
  const ShapedParticles *shapes = GranularSystem::of(lmp)->shapes();
  return shapes ? shapes->table().of(type) : nullptr;
}

double CriticalTimeStep::reduce_smallest(double mine) const
{
  const double defined = mine > 0.0 ? mine : never;
  double all;
  MPI_Allreduce(&defined, &all, 1, MPI_DOUBLE, MPI_MIN, world);
  return std::isinf(all) ? 0.0 : all;
}

void CriticalTimeStep::consider_pair(const PairCoeffs &laws, int i, int j, double speed)
{
  const std::vector<double> &radius = sizes.radius, &mass = sizes.mass, &own_mass = sizes.own_mass;
  if (std::isinf(radius[i]) || std::isinf(radius[j])) return;
  if (!laws.known(i, j)) return;
  const ContactLaw &law = laws.law(i, j);
  const ContactCoefficients c = laws.coefficients(i, j);
  const double m = mass[i] * mass[j] / (mass[i] + mass[j]);
  const double own_m = own_mass[i] * own_mass[j] / (own_mass[i] + own_mass[j]);
  const double r = radius[i] * radius[j] / (radius[i] + radius[j]);

  const double overlap = std::min(sizes.overlap[i], sizes.overlap[j]);
  if (looks_at_damping)
    consider_damping(fmt::format("types {} and {}", i, j), law, c, overlap, m, r);

  const ParticleShape *one = shape_of(i), *other = shape_of(j);
  if (one || other)
    consider_faces(response(law, c, overlap, m, r),
                   {{own_mass[i], one ? &one->faces() : nullptr},
                    {own_mass[j], other ? &other->faces() : nullptr}});
  else
    consider_stability(law, c, overlap, {m, own_m}, r, around_a_particle);
  const double k = tangent_stiffness(law, c, overlap, m, r);
  if (k > 0.0) law_period = smaller_defined(law_period, std::sqrt(m / k));
  if (k > 0.0 && (one || other))
    period_of_shapes = smaller_defined(period_of_shapes, std::sqrt(m / k));
  const double modulus = law.normal().modulus(law.coefficients(Stage::NORMAL, c));
  if (modulus > 0.0 && speed > 0.0)
    hertz = smaller_defined(hertz, 2.87 * std::pow(m * m / (r * modulus * modulus * speed), 0.2));
  if (i == j && laws.spec(i, i).is_material())
    rayleigh = smaller_defined(rayleigh, rayleigh_of(laws.spec(i, i), i));
}

void CriticalTimeStep::consider_damping(const std::string &who, const ContactLaw &law,
                                        const ContactCoefficients &c, double overlap,
                                        double mass_eff, double radius_eff)
{
  undamped.consider(who, law, c, overlap, mass_eff, radius_eff);
  if (order == 1) elastic.consider(who, law, c, overlap, mass_eff, radius_eff);
}

void CriticalTimeStep::consider_stability(const ContactLaw &law, const ContactCoefficients &c,
                                          double overlap, const Masses &mass_eff, double radius_eff,
                                          int contacts)
{
  const ContactResponse small_motion = response(law, c, overlap, mass_eff.of_law, radius_eff);
  const double moved = std::min(mass_eff.of_law, mass_eff.own);
  const auto largest = [&](const ContactResponse &contact_response) {
    return largest_stable_time_step(contact_response, moved, contacts, order);
  };
  stable = smaller_defined(stable, largest(small_motion));
  stable_undamped = smaller_defined(stable_undamped, largest(without_damping(small_motion)));
}

void CriticalTimeStep::consider_faces(const ContactResponse &contact_response,
                                      const std::vector<HeldBody> &bodies)
{
  stable = smaller_defined(stable, largest_stable_time_step(contact_response, bodies));
  stable_undamped = smaller_defined(
      stable_undamped, largest_stable_time_step(without_damping(contact_response), bodies));
}

/* Of particles that a body can touch. */

double CriticalTimeStep::smallest_body_period(int types, int group)
{
  double smallest = 0.0;
  std::map<int, Sizes> known{{group, sizes}};
  for (LargeBody *body : GranularSystem::of(lmp)->bodies().in_order()) {
    const int groups = group | body->group_bits();
    if (!known.count(groups)) known[groups] = smallest_particles(types, groups);
    const auto &[radius, mass, own_mass, overlap] = known[groups];
    for (int type = 1; type <= types; type++) {
      if (std::isinf(radius[type])) continue;
      smallest = smaller_defined(
          smallest, body->contact_period(type, mass[type], radius[type], overlap[type]));
      if (const ParticleShape *shape = shape_of(type))
        consider_faces(response(body->law_of(type), body->coefficients_of(type), overlap[type],
                                mass[type], radius[type]),
                       {{own_mass[type], &shape->faces(), true}});
      else
        consider_stability(body->law_of(type), body->coefficients_of(type), overlap[type],
                           {mass[type], own_mass[type]}, radius[type], in_a_corner);
      if (looks_at_damping)
        consider_damping(fmt::format("type {} with {}", type, body->name()), body->law_of(type),
                         body->coefficients_of(type), overlap[type], mass[type], radius[type]);
    }
  }
  return smallest;
}

double CriticalTimeStep::rayleigh_of(const ContactSpec &spec, int type) const
{
  const ParticleShape *shape = shape_of(type);
  const double r = shape ? shape->shape().inscribed_radius() : sizes.radius[type];
  const double volume = shape ? shape->shape().volume() : 4.0 / 3.0 * MathConst::MY_PI * r * r * r;
  const double density = sizes.own_mass[type] / volume;
  const double poisson = spec.given.value("nu");
  const double shear = spec.given.value("E") / (2.0 * (1.0 + poisson));
  return MathConst::MY_PI * r * std::sqrt(density / shear) / (0.1631 * poisson + 0.8766);
}
