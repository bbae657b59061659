// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls for particles by ID.

#include "coupling/particles.h"

#include "coupling/calls.h"
#include "coupling/partner.h"

#include "system/host/particle_count.h"
#include "system/host/particles_by_id.h"
#include "system/loads/external_loads.h"

#include "atom.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace Talus {

ExternalLoads &loads_of(talus_partner &partner)
{
  ExternalLoads &loads = partner.system().external_loads();
  const std::string problem = loads.reason_against();
  if (!problem.empty()) throw Refusal(problem);
  if (loads.make_fix()) partner.needs_set_up = true;
  const int number = partner.number();
  partner.at_close("loads on particles",
                   [number](GranularSystem &system) { system.external_loads().clear(number); });
  return loads;
}

void require_temperatures(const talus_partner &partner)
{
  if (!partner.instance().atom->heatflow_flag)
    throw Refusal("particles have no temperature: use 'fix property/atom temperature heatflow' "
                  "and 'fix heat/flow'");
}

namespace {

std::vector<std::int64_t> ids_of(talus_partner &partner, std::int64_t n, const std::int64_t *id)
{
  const std::int64_t count = partner.integer_of("n", n);
  const std::int64_t most = count_particles(&partner.instance());
  if (count < 0 || count > most)
    throw Refusal("n is " + std::to_string(count) + ", expected 0 to " + std::to_string(most) +
                  ", the number of particles");
  return partner.integers_of("id", id, count);
}

void require_all(const ParticlesById &particles, bool once)
{
  const std::string problem = particles.problem(once);
  if (!problem.empty()) throw Refusal(problem);
}

/// Of an argument that may be NULL.
std::vector<double> optional_rows(talus_partner &partner, const char *what, const double *given,
                                  std::size_t count)
{
  if (!partner.has(what, given)) return {};
  return partner.numbers_of(what, given, 3 * static_cast<std::int64_t>(count));
}

const double *or_null(const std::vector<double> &numbers)
{
  return numbers.empty() ? nullptr : numbers.data();
}

}    // namespace

/* ---- what is put on them -------------------------------------------------------------------- */

int call_put_forces(talus_partner *partner, int64_t n, const int64_t *id, const double *force,
                    const double *torque)
{
  return partner->collective("talus_put_forces", [&] {
    const std::vector<std::int64_t> ids = ids_of(*partner, n, id);
    const std::vector<double> forces = optional_rows(*partner, "force", force, ids.size()),
                              torques = optional_rows(*partner, "torque", torque, ids.size());
    if (!ids.empty() && forces.empty() && torques.empty())
      throw Refusal("force and torque are both NULL");
    const ParticlesById particles(&partner->instance(), ids);
    require_all(particles, true);
    loads_of(*partner).put_forces(partner->number(), particles, or_null(forces), or_null(torques));
  });
}

int call_put_drag(talus_partner *partner, int64_t n, const int64_t *id, const double *coefficient,
                  const double *fluid_velocity)
{
  return partner->collective("talus_put_drag", [&] {
    const std::vector<std::int64_t> ids = ids_of(*partner, n, id);
    const auto count = static_cast<std::int64_t>(ids.size());
    const std::vector<double> coefficients = partner->numbers_of("coefficient", coefficient, count),
                              velocities =
                                  partner->numbers_of("fluid_velocity", fluid_velocity, 3 * count);
    for (std::size_t k = 0; k < ids.size(); k++)
      if (!(coefficients[k] > 0.0))
        throw Refusal(
            fmt::format("coefficient[{}] of particle {} is {:.6g}, expected more than 0: leave "
                        "out particles without drag",
                        k, ids[k], coefficients[k]));
    const ParticlesById particles(&partner->instance(), ids);
    require_all(particles, true);
    ExternalLoads &loads = loads_of(*partner);
    partner->refuse_if(loads.problem_of_drag(particles, coefficients.data()));
    loads.put_drag(partner->number(), particles, coefficients.data(), velocities.data());
  });
}

int call_put_heat(talus_partner *partner, int64_t n, const int64_t *id, const double *flow)
{
  return partner->collective("talus_put_heat", [&] {
    const std::vector<std::int64_t> ids = ids_of(*partner, n, id);
    const std::vector<double> flows =
        partner->numbers_of("flow", flow, static_cast<std::int64_t>(ids.size()));
    require_temperatures(*partner);
    const ParticlesById particles(&partner->instance(), ids);
    require_all(particles, true);
    loads_of(*partner).put_heat(partner->number(), particles, flows.data());
  });
}

int call_get_drag_impulses(talus_partner *partner, int64_t n, const int64_t *id, double *impulse)
{
  return partner->collective("talus_get_drag_impulses", [&] {
    const std::vector<std::int64_t> ids = ids_of(*partner, n, id);
    const ParticlesById particles(&partner->instance(), ids);
    require_all(particles, true);
    std::vector<double> impulses(3 * ids.size());
    partner->system().external_loads().take_impulses(partner->number(), particles, impulses.data());
    partner->sum(impulses);
    partner->give(impulse, impulses);
  });
}

/* ---- what they are -------------------------------------------------------------------------- */

int call_get_num_particles(talus_partner *partner, int64_t *n)
{
  return partner->collective("talus_get_num_particles", [&] {
    partner->give(n, std::vector<std::int64_t>{count_particles(&partner->instance())});
  });
}

int call_get_ids(talus_partner *partner, int64_t *id)
{
  return partner->collective("talus_get_ids", [&] {
    const Atom &atom = *partner->instance().atom;
    std::vector<std::int64_t> ids =
        partner->gather(std::vector<std::int64_t>(atom.tag, atom.tag + atom.nlocal));
    std::sort(ids.begin(), ids.end());
    partner->give(id, ids);
  });
}

int call_get_particles(talus_partner *partner, int64_t n, const int64_t *id, double *x, double *v,
                       double *omega, double *radius, double *mass)
{
  return partner->collective("talus_get_particles", [&] {
    const std::vector<std::int64_t> ids = ids_of(*partner, n, id);
    const ParticlesById particles(&partner->instance(), ids);
    require_all(particles, false);
    const Atom &atom = *partner->instance().atom;
    const auto get = [&](const char *what, double *to, std::size_t columns, auto row_of) {
      if (!partner->has(what, to)) return;
      std::vector<double> numbers(columns * ids.size());
      particles.for_each([&](std::size_t k, int i) {
        const double *row = row_of(i);
        std::copy(row, row + columns, numbers.begin() + static_cast<std::int64_t>(columns * k));
      });
      partner->sum(numbers);
      partner->give(to, numbers);
    };
    get("x", x, 3, [&](int i) { return atom.x[i]; });
    get("v", v, 3, [&](int i) { return atom.v[i]; });
    get("omega", omega, 3, [&](int i) { return atom.omega[i]; });
    get("radius", radius, 1, [&](int i) { return atom.radius + i; });
    get("mass", mass, 1, [&](int i) { return atom.rmass + i; });
  });
}

}    // namespace Talus
