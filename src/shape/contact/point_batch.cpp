// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/point_batch.h"

#include "base/lanes.h"
#include "material/run_laws.h"

namespace Talus {

std::string PointBatch::refusal(const ContactLaw &law)
{
  if (law.resists())
    return "has rolling or twisting resistance, which stands for a shape that spheres do not have: "
           "leave it out";
  if (law.conducts_heat()) return "conducts heat: leave 'heat' out";
  if (law.normal().lasts_beyond_contact)
    return std::string("has the normal law ") + law.normal().name +
           ", which lasts beyond contact: use dmt or another law";
  if (law.bridges())
    return std::string("has the adhesion ") + law.cohesion().name +
           ", a bridge that lasts beyond contact: use 'adhesion constant F'";
  if (law.normal().hysteretic)
    return std::string("has the normal law ") + law.normal().name +
           ", which remembers how deep a contact was, while points of shapes come and go: use "
           "hooke or another law";
  if (law.history().size > point_history_size)
    return "has laws with " + std::to_string(law.history().size) +
           " values of history, and points of shapes keep " + std::to_string(point_history_size) +
           ": take another tangential law";
  if (law.synchronized())
    return std::string("has the tangential law ") + law.tangential().name +
           ", whose normal is that of half a step before: leave 'synchronized_verlet' out";
  return "";
}

void PointBatch::compute(const Task &new_task, PointContact *points, std::size_t count)
{
  task = &new_task;
  const LawTable &laws = task->laws;
  for (law_index = 0; law_index < laws.num_laws(); law_index++) {
    has_history = laws.distinct_law(law_index).has_history();
    for (std::size_t n = 0; n < count; n++) {
      if (laws.num_laws() > 1 && laws.law_index(points[n].row) != law_index) continue;
      of_lane[filled] = points + n;
      gather(points[n], filled);
      if (++filled == ContactBatch::width) flush();
    }
    flush();
  }
}

void PointBatch::gather(const PointContact &point, int lane)
{
  const auto put = [lane](double(&to)[3][ContactBatch::width], const Vector3<double> &v) {
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
  };
  put(batch.normal, point.normal);
  put(batch.velocity, point.velocity);
  batch.overlap[lane] = point.overlap;
  batch.inverse_mass[lane] = point.inverse_mass;
  batch.inverse_radius[lane] = point.inverse_radius;
  batch.coefficients[lane] = point.row;
  if (task->account) put(batch.velocity_change, point.velocity_change);
  for (int k = 0; k < point_history_size && has_history; k++)
    batch.history[k][lane] = point.history[k];
}

/* Lanes behind the last point hold older ones: computed, not used. */

void PointBatch::flush()
{
  if (!filled) return;
  const LawTable &laws = task->laws;
  const int end = (filled + lanes - 1) / lanes * lanes;
  for (int lane = filled; lane < end; lane++) {    // a row of this law, whatever it was before
    gather(*of_lane[filled - 1], lane);
  }
  run_laws(batch, law_index, 0, end, {laws, task->dt, task->advance, task->account});
  for (int lane = 0; lane < filled; lane++) hand_out(*of_lane[lane], lane);
  filled = 0;
}

void PointBatch::hand_out(PointContact &point, int lane) const
{
  const double w = point.weight;
  point.force =
      w * Vector3<double>{batch.force[0][lane], batch.force[1][lane], batch.force[2][lane]};
  if (task->account) point.work = w * work_of_lane(batch, lane);
  if (task->advance && has_history)
    for (int k = 0; k < point_history_size; k++) point.history[k] = batch.history[k][lane];
}

ComputedContact PointBatch::contact_of(const PointContact &point)
{
  ComputedContact found;
  found.state.normal = found.report.normal = point.normal;
  found.state.overlap = found.report.overlap = point.overlap;
  found.state.velocity = point.velocity;
  found.state.inverse_mass = point.inverse_mass;
  found.state.inverse_radius = point.inverse_radius;
  found.row = point.row;
  found.weight = point.weight;
  found.energy = point.energy;
  found.report.force = point.force;
  std::copy(point.history.begin(), point.history.end(), found.report.history.begin());
  return found;
}

}    // namespace Talus
