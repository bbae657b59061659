// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_contact_gran_local.h"

#include "atom.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

using namespace LAMMPS_NS;
using Talus::ContactReport;

namespace {

using Row = ComputeContactGranLocal::Row;

double normal_force(const Row &r)
{
  return r.force[0] * r.normal[0] + r.force[1] * r.normal[1] + r.force[2] * r.normal[2];
}

double length_of(const double *v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double tangential_force(const Row &r)
{
  const double normal = normal_force(r);
  double rest[3];
  for (int d = 0; d < 3; d++) rest[d] = r.force[d] - normal * r.normal[d];
  return length_of(rest);
}

template <int place> double history_value(const Row &r)
{
  return r.history[place];
}

struct Column {
  const char *word;
  double (*value)(const Row &);
};

constexpr Column known[] = {
    {"id1", [](const Row &r) { return r.id[0]; }},
    {"id2", [](const Row &r) { return r.id[1]; }},
    {"body", [](const Row &r) { return r.body; }},
    {"part", [](const Row &r) { return r.part; }},
    {"x1", [](const Row &r) { return r.x[0][0]; }},
    {"y1", [](const Row &r) { return r.x[0][1]; }},
    {"z1", [](const Row &r) { return r.x[0][2]; }},
    {"x2", [](const Row &r) { return r.x[1][0]; }},
    {"y2", [](const Row &r) { return r.x[1][1]; }},
    {"z2", [](const Row &r) { return r.x[1][2]; }},
    {"px", [](const Row &r) { return r.point[0]; }},
    {"py", [](const Row &r) { return r.point[1]; }},
    {"pz", [](const Row &r) { return r.point[2]; }},
    {"nx", [](const Row &r) { return r.normal[0]; }},
    {"ny", [](const Row &r) { return r.normal[1]; }},
    {"nz", [](const Row &r) { return r.normal[2]; }},
    {"overlap", [](const Row &r) { return r.overlap; }},
    {"force", [](const Row &r) { return length_of(r.force); }},
    {"fn", normal_force},
    {"ft", tangential_force},
    {"fx", [](const Row &r) { return r.force[0]; }},
    {"fy", [](const Row &r) { return r.force[1]; }},
    {"fz", [](const Row &r) { return r.force[2]; }},
    {"tx", [](const Row &r) { return r.torque[0]; }},
    {"ty", [](const Row &r) { return r.torque[1]; }},
    {"tz", [](const Row &r) { return r.torque[2]; }},
    {"eng", [](const Row &r) { return r.energy; }},
    {"h1", history_value<0>},
    {"h2", history_value<1>},
    {"h3", history_value<2>},
    {"h4", history_value<3>},
    {"h5", history_value<4>},
    {"h6", history_value<5>},
    {"h7", history_value<6>},
    {"h8", history_value<7>},
    {"h9", history_value<8>},
    {"h10", history_value<9>},
    {"h11", history_value<10>},
    {"h12", history_value<11>},
    {"h13", history_value<12>},
    {"h14", history_value<13>},
    {"h15", history_value<14>},
    {"h16", history_value<15>},
    {"h17", history_value<16>},
    {"h18", history_value<17>},
    {"h19", history_value<18>},
    {"h20", history_value<19>},
};

std::string known_words()
{
  std::string all;
  for (const Column &one : known) all += std::string(all.empty() ? "" : " ") + one.word;
  return all;
}

}    // namespace

ComputeContactGranLocal::ComputeContactGranLocal(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
{
  if (narg < 4)
    error->all(FLERR, "compute contact/gran/local: expected at least one of {}", known_words());
  for (int n = 3; n < narg; n++) {
    const auto *found = std::find_if(std::begin(known), std::end(known), [&](const Column &one) {
      return std::strcmp(one.word, arg[n]) == 0;
    });
    if (found == std::end(known))
      error->all(FLERR, n, "compute contact/gran/local: unknown value '{}': expected some of {}",
                 arg[n], known_words());
    columns.push_back(found->value);
  }
  local_flag = 1;
  size_local_cols = columns.size() == 1 ? 0 : static_cast<int>(columns.size());
  system->account().add_observer(this);
}

ComputeContactGranLocal::~ComputeContactGranLocal()
{
  system->account().drop_observer(this);
}

void ComputeContactGranLocal::init()
{
  if (!system->pair_style().is_there())
    error->all(FLERR, "Compute contact/gran/local requires a pair style of Talus");
}

bool ComputeContactGranLocal::is_chosen(const ContactReport &one) const
{
  if (!(atom->mask[one.i] & groupbit)) return false;
  if (one.j < 0) return true;
  return (atom->mask[one.j] & groupbit) && system->contacts().is_of_this_rank(one);
}

ComputeContactGranLocal::Row ComputeContactGranLocal::row_of(const ContactReport &one) const
{
  const bool with_body = one.body >= 0, swapped = !with_body && atom->tag[one.i] > atom->tag[one.j];
  const double sign = swapped ? -1.0 : 1.0;
  const auto put = [](const Talus::Vector3<double> &v, double(&to)[3]) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
  };
  const Talus::Vector3<double> &center = one.center[swapped], point = center + one.arm[swapped];
  Row row{};
  row.id[0] = static_cast<double>(atom->tag[swapped ? one.j : one.i]);
  row.id[1] = with_body ? 0.0 : static_cast<double>(atom->tag[swapped ? one.i : one.j]);
  row.body = one.body + 1;
  row.part = one.part + 1;
  row.overlap = one.overlap;
  row.energy = one.stored.total();
  put(sign * one.normal, row.normal);
  put(sign * one.force, row.force);
  put(one.torque[swapped], row.torque);
  put(center, row.x[0]);
  put(point - one.arm[!swapped], row.x[1]);
  put(point, row.point);
  row.history = swapped ? Talus::mirrored(one.history) : one.history;
  return row;
}

void ComputeContactGranLocal::compute_local()
{
  invoked_local = update->ntimestep;
  values.clear();
  system->contacts().for_each(Talus::ContactData::ALL, [&](const ContactReport &one) {
    if (!is_chosen(one)) return;
    const Row row = row_of(one);
    for (const auto value : columns) values.push_back(value(row));
  });
  size_local_rows = static_cast<int>(values.size() / columns.size());
  rows.resize(size_local_rows);
  for (int n = 0; n < size_local_rows; n++) rows[n] = values.data() + n * columns.size();
  vector_local = values.data();
  array_local = rows.data();
}

double ComputeContactGranLocal::memory_usage()
{
  return static_cast<double>(values.capacity() + rows.capacity()) * sizeof(double);
}
