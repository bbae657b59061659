// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls for large bodies as rigid bodies.

#include "coupling/bodies.h"

#include "coupling/calls.h"
#include "coupling/partner.h"

#include "system/large_body.h"
#include "system/steered_body.h"

#include <limits>

namespace Talus {

LargeBody &body_of(talus_partner &partner, const char *given)
{
  const std::string id = partner.text_of("body", given);
  LargeBody *const body = partner.system().bodies().find(id);
  if (!body || !body->as_steered()) throw Refusal("there is no fix large/body '" + id + "'");
  return *body;
}

int steps_ahead(talus_partner &partner, std::int64_t given)
{
  const std::int64_t steps = partner.integer_of("steps", given);
  if (steps < 0 || steps > std::numeric_limits<int>::max())
    throw Refusal("steps is " + std::to_string(steps) + ", expected 0 or more");
  return static_cast<int>(steps);
}

int call_put_body_state(talus_partner *partner, const char *body, const double *state,
                        int64_t steps)
{
  return partner->collective("talus_put_body_state", [&] {
    SteeredBody &steered = *body_of(*partner, body).as_steered();
    const std::vector<double> numbers = partner->numbers_of("state", state, BodyState::size);
    const int ahead = steps_ahead(*partner, steps);
    const std::string problem = steered.guide(BodyState::from_array(numbers.data()), ahead);
    if (!problem.empty()) throw Refusal(problem);
  });
}

int call_get_body_state(talus_partner *partner, const char *body, double *state)
{
  return partner->collective("talus_get_body_state", [&] {
    std::vector<double> numbers(BodyState::size);
    body_of(*partner, body).as_steered()->present_state().to_array(numbers.data());
    partner->give(state, numbers);
  });
}

}    // namespace Talus
