// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "dump/dump_vtk_gran.h"

#include "system/contacts/compute_contact_list.h"
#include "system/host/simulated_time.h"
#include "system/shapes/shaped_particles.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "input.h"
#include "memory.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <algorithm>
#include <climits>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

const char *const list_suffix = "_TALUS_CONTACT_LIST";
constexpr int first_attribute = 5, num_coordinates = 3;

/// The words of dump custom: positions first, and then what the user asked for.
class CustomWords {
 public:
  CustomWords(int narg, char **arg) : words(arg, arg + std::min(narg, first_attribute))
  {
    words.insert(words.end(), {x, y, z});
    if (narg > first_attribute)
      words.insert(words.end(), arg + first_attribute, arg + narg);
    else
      words.insert(words.end(), {tag, type, radius});
  }
  int size() const { return static_cast<int>(words.size()); }
  char **data() { return words.data(); }

 private:
  char x[2] = "x", y[2] = "y", z[2] = "z", tag[3] = "id", type[5] = "type", radius[7] = "radius";
  std::vector<char *> words;
};

/// `name` without its last letter if that is x, or without [1]; "" if it is neither.
std::string stem_of_first(const std::string &name)
{
  if (utils::strmatch(name, "\\[1\\]$")) return name.substr(0, name.size() - 3);
  return name.size() > 1 && name.back() == 'x' ? name.substr(0, name.size() - 1) : "";
}

}    // namespace

DumpVtkGran::DumpVtkGran(LAMMPS *lmp, int narg, char **arg) :
    DumpCustom(lmp, CustomWords(narg, arg).size(), CustomWords(narg, arg).data()),
    system(GranularSystem::of(lmp))
{
  stem = filename;
  if (!utils::strmatch(stem, "\\.pvd$"))
    error->all(FLERR, "dump vtk/gran: the file name '{}' must end in .pvd", stem);
  if (stem.find('*') != std::string::npos)
    error->all(FLERR,
               "dump vtk/gran: the file name '{}' must have no *: the file tells of all steps",
               stem);
  stem.resize(stem.size() - 4);
  stem.erase(std::remove(stem.begin(), stem.end(), '%'), stem.end());
  buffer_allow = buffer_flag = 0;
  find_columns();
  const std::string list_id = std::string(id) + list_suffix;
  contact_list =
      dynamic_cast<ComputeContactList *>(modify->add_compute(list_id + " all TALUS_CONTACT_LIST"));
}

/* LAMMPS may have deleted the compute: before its dumps when plugins are unloaded. */

DumpVtkGran::~DumpVtkGran()
{
  const std::string list_id = std::string(id) + list_suffix;
  if (modify && modify->get_compute_by_id(list_id)) modify->delete_compute(list_id);
}

/* Components of a vector, and columns of a compute or fix, become one array. */

void DumpVtkGran::find_columns()
{
  const std::vector<std::string> names = utils::split_words(columns_default);
  const int count = static_cast<int>(names.size());
  for (int first = num_coordinates; first < count;) {
    const std::string common = stem_of_first(names[first]);
    const bool is_vector = !common.empty() && names[first].back() == 'x';
    const auto name_of = [&](int k) {
      if (is_vector) return k < 3 ? common + "xyz"[k] : std::string();
      return common + "[" + std::to_string(k + 1) + "]";
    };
    int components = 1;
    while (!common.empty() && first + components < count &&
           names[first + components] == name_of(components))
      components++;
    if (is_vector && components < 3) components = 1;
    array_columns.push_back({components > 1 ? common : names[first], first, components});
    first += components;
  }
}

int DumpVtkGran::modify_param(int narg, char **arg)
{
  for (const auto &[word, flag] : {std::pair<const char *, bool *>{"contacts", &with_contacts},
                                   std::pair<const char *, bool *>{"bodies", &with_bodies}}) {
    if (strcmp(arg[0], word) != 0) continue;
    if (narg < 2) utils::missing_cmd_args(FLERR, std::string("dump_modify ") + word, error);
    *flag = utils::logical(FLERR, arg[1], false, lmp) == 1;
    return 2;
  }
  return DumpCustom::modify_param(narg, arg);
}

void DumpVtkGran::init_style()
{
  DumpCustom::init_style();
  if (pbcflag) error->all(FLERR, "dump_modify pbc yes is not for dump vtk/gran");
  const std::string problem = contact_list->contacts.problem();
  if (with_contacts && !problem.empty())
    error->all(FLERR, "dump vtk/gran: no contacts: {}; use 'dump_modify {} contacts no'", problem,
               id);
}

/* ---- a step --------------------------------------------------------------------------------- */

void DumpVtkGran::write()
{
  nme = count();    // calls computes, also for later steps
  if (is_skipped()) return;
  parts.clear();

  VtkPolyData some = grains();
  write_part("grains", some, true);
  if (with_contacts) {
    some = contacts();
    write_part("contacts", some, true);
  }
  if (system->shapes()) {
    some = shapes();
    write_part("shapes", some, true);
  }
  for (LargeBody *body : system->bodies().in_order()) {
    if (!with_bodies) break;
    VtkPolyData surface = body->picture();
    write_part(std::string("body_") + body->command()->id, surface, false);
  }

  if (comm->me) return;
  const double time = simulated_time(update);
  if (!series) {
    series = std::make_unique<VtkTimeSeries>(stem + ".pvd");
    if (append_flag) series->go_on(time);
  }
  check(series->add(time, parts));
}

bool DumpVtkGran::is_skipped()
{
  if (delay_flag && update->ntimestep < delaystep) return true;
  return skipflag && input->variable->compute_equal(skipindex) != 0.0;
}

void DumpVtkGran::check(const std::string &problem) const
{
  if (!problem.empty()) error->one(FLERR, "dump vtk/gran {}: {}", id, problem);
}

/* As LAMMPS does before it writes. */

void DumpVtkGran::fill_buffer()
{
  bigint mine = nme, most;
  MPI_Allreduce(&mine, &ntotal, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  MPI_Allreduce(&mine, &most, 1, MPI_LMP_BIGINT, MPI_MAX, world);
  if (most * size_one > MAXSMALLINT) error->all(FLERR, "Too much per-proc info for dump");
  if (most * size_one > maxbuf) {
    maxbuf = static_cast<int>(most) * size_one;
    memory->destroy(buf);
    memory->create(buf, maxbuf, "dump:buf");
  }
  const bool sorts = sort_flag && ntotal > 1;
  if (sort_flag && sortcol == 0 && most > maxids) {
    maxids = static_cast<int>(most);
    memory->destroy(ids);
    memory->create(ids, maxids, "dump:ids");
  }
  pack(sorts && sortcol == 0 ? ids : nullptr);
  if (sorts) sort();
}

VtkPolyData DumpVtkGran::grains()
{
  fill_buffer();
  VtkPolyData grains(VtkCells::VERTICES);
  const auto row = [this](int k) { return buf + static_cast<bigint>(size_one) * k; };
  for (int k = 0; k < nme; k++) grains.add_point({row(k)[0], row(k)[1], row(k)[2]});
  for (const Column &column : array_columns) {
    VtkPolyData::Array &array = grains.add_point_data(column.name, column.components);
    for (int k = 0; k < nme; k++)
      for (int c = 0; c < column.components; c++) array.add(row(k)[column.first + c]);
  }
  return grains;
}

VtkPolyData DumpVtkGran::contacts()
{
  if (!contact_list->contacts.is_known())
    error->all(FLERR,
               "dump vtk/gran: contacts are known from the first run after the dump command on; "
               "write grains alone with 'contacts no'");
  VtkPolyData lines(VtkCells::LINES);
  auto &strength = lines.add_point_data("normal_force", 1);
  auto &first = lines.add_cell_data("id1", 1), &second = lines.add_cell_data("id2", 1);
  auto &body_number = lines.add_cell_data("body", 1);
  auto &force = lines.add_cell_data("force", 3), &overlap = lines.add_cell_data("overlap", 1);
  const auto is_chosen = [this](int i) { return (atom->mask[i] & groupbit) != 0; };
  contact_list->contacts.for_each([&](const ContactReport &c) {
    const bool with_body = c.j < 0;
    if (!is_chosen(c.i) || (!with_body && !is_chosen(c.j))) return;
    const double normal_force = dot(c.force, c.normal);
    const Vector3<double> &begin = c.center[0], meeting = begin + c.arm[0];
    lines.add_point(begin);
    lines.add_point(with_body ? meeting : meeting - c.arm[1]);
    strength.add(normal_force);
    strength.add(normal_force);
    first.add(static_cast<double>(atom->tag[c.i]));
    second.add(with_body ? 0.0 : static_cast<double>(atom->tag[c.j]));
    body_number.add(c.body + 1);
    force.add(c.force);
    overlap.add(c.overlap);
  });
  return lines;
}

/* The surfaces of particles with a shape. */

VtkPolyData DumpVtkGran::shapes() const
{
  VtkPolyData surface(VtkCells::TRIANGLES);
  auto &id_of = surface.add_cell_data("id", 1), &type = surface.add_cell_data("type", 1);
  system->shapes()->for_each_triangle([&](int i, const Triangle &one) {
    if (!(atom->mask[i] & groupbit)) return;
    for (const Vector3<double> &corner : one.corner) surface.add_point(corner);
    id_of.add(static_cast<double>(atom->tag[i]));
    type.add(atom->type[i]);
  });
  return surface;
}

/* ---- files ---------------------------------------------------------------------------------- */

std::string DumpVtkGran::file_name(const std::string &part, const std::string &end) const
{
  return stem + "." + part + "." + utils::star_subst("*", update->ntimestep, padflag) + end;
}

void DumpVtkGran::write_part(const std::string &name, VtkPolyData &part, bool in_pieces)
{
  const double time = simulated_time(update);
  const auto in_folder = [](const std::string &path) {
    return path.substr(path.find_last_of('/') + 1);
  };
  if (!in_pieces || !multiproc) {
    if (in_pieces) collect(part);
    if (comm->me == 0) check(part.write(file_name(name, ".vtp"), time));
    parts.emplace_back(name, in_folder(file_name(name, ".vtp")));
    return;
  }
  collect(part);
  int my_number = 0, count;
  MPI_Exscan(&filewriter, &my_number, 1, MPI_INT, MPI_SUM, world);
  MPI_Allreduce(&filewriter, &count, 1, MPI_INT, MPI_SUM, world);
  const auto piece = [&](int k) { return file_name(name, "." + std::to_string(k) + ".vtp"); };
  if (filewriter) check(part.write(piece(comm->me ? my_number : 0), time));
  if (comm->me == 0) {
    std::vector<std::string> pieces;
    pieces.reserve(count);
    for (int k = 0; k < count; k++) pieces.push_back(in_folder(piece(k)));
    check(part.write_list(file_name(name, ".pvtp"), pieces));
  }
  parts.emplace_back(name, in_folder(file_name(name, ".pvtp")));
}

/* To the rank that writes a file from the others whose particles are in it. */

void DumpVtkGran::collect(VtkPolyData &part) const
{
  MPI_Comm ranks = multiproc ? clustercomm : world;
  int rank, size;
  MPI_Comm_rank(ranks, &rank);
  MPI_Comm_size(ranks, &size);
  const bigint at_once = INT_MAX / 2;
  const auto in_messages = [at_once](std::vector<double> &all, auto transfer) {
    for (bigint at = 0; at < static_cast<bigint>(all.size()); at += at_once)
      transfer(&all[at], static_cast<int>(std::min<bigint>(at_once, all.size() - at)));
  };
  if (rank) {
    std::vector<double> packed = part.pack();
    bigint amount = packed.size();
    MPI_Send(&amount, 1, MPI_LMP_BIGINT, 0, 0, ranks);
    in_messages(packed, [&](double *from, int n) { MPI_Send(from, n, MPI_DOUBLE, 0, 0, ranks); });
    return;
  }
  for (int other = 1; other < size; other++) {
    bigint amount;
    MPI_Recv(&amount, 1, MPI_LMP_BIGINT, other, 0, ranks, MPI_STATUS_IGNORE);
    std::vector<double> packed(amount);
    in_messages(packed, [&](double *to, int n) {
      MPI_Recv(to, n, MPI_DOUBLE, other, 0, ranks, MPI_STATUS_IGNORE);
    });
    part.append(packed);
  }
}
