// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls for large bodies as rigid bodies.

#include "coupling/bodies.h"

#include "coupling/calls.h"
#include "coupling/partner.h"

#include "system/bodies/large_body.h"
#include "system/step/granular_system.h"

#include "fix.h"

#include <limits>

namespace Talus {

static_assert(BodyState::size == TALUS_STATE_SIZE && ImpulseAccount::size == TALUS_LOAD_SIZE);

LargeBody &body_of(talus_partner &partner, const char *given)
{
  const std::string id = partner.text_of("body", given);
  LargeBody *const body = partner.system().bodies().find(id);
  if (body) return *body;
  std::string known;
  for (LargeBody *one : partner.system().bodies().in_order())
    known += std::string(known.empty() ? ", only " : ", ") + one->command()->id;
  throw Refusal("there is no fix large/body '" + id + "'" + known);
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
    LargeBody &steered = body_of(*partner, body);
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
    body_of(*partner, body).frame().state.to_array(numbers.data());
    partner->give(state, numbers);
  });
}

int call_watch_body(talus_partner *partner, const char *body, const double *point)
{
  return partner->collective("talus_watch_body", [&] {
    LargeBody &watched = body_of(*partner, body);
    Vector3<double> about{0.0, 0.0, 0.0};
    if (partner->has("point", point)) {
      const std::vector<double> numbers = partner->numbers_of("point", point, 3);
      about = {numbers[0], numbers[1], numbers[2]};
    }
    const int number = partner->number();
    watched.watch(about, number);
    const std::string id = watched.command()->id;
    partner->at_close("watch " + id, [id, number](GranularSystem &system) {
      if (LargeBody *one = system.bodies().find(id)) one->unwatch(number);
    });
    partner->needs_set_up = true;    // its load is summed from then on
  });
}

int call_get_body_load(talus_partner *partner, const char *body, double *load)
{
  return partner->collective("talus_get_body_load", [&] {
    LargeBody &watched = body_of(*partner, body);
    if (!watched.is_watched())
      throw Refusal(watched.name() +
                    " is not watched: call talus_watch_body() before, and again if "
                    "the fix has been defined again");
    partner->refuse_if(partner->lives_here() && !load ? "load is NULL" : "");
    std::vector<double> numbers(ImpulseAccount::size);
    watched.settled_impulses().take(numbers.data());
    partner->give(load, numbers);
  });
}

}    // namespace Talus
