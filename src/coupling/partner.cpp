// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "coupling/partner.h"

#include "base/state_digest.h"

#include "comm.h"
#include "error.h"
#include "exceptions.h"
#include "input.h"

#include <cmath>
#include <cstdio>
#include <limits>

using namespace LAMMPS_NS;
using namespace Talus;

talus_partner::talus_partner(LAMMPS *lmp, int root_rank) : Pointers(lmp), root(root_rank)
{
  MPI_Comm_rank(world(), &me);
  MPI_Comm_size(world(), &num_ranks);
  if (root < TALUS_ALL_RANKS || root >= num_ranks)
    throw Refusal("talus_open: root is " + std::to_string(root) + ", expected " +
                  std::to_string(TALUS_ALL_RANKS) + " (all ranks) or a rank below " +
                  std::to_string(num_ranks));
  granular = GranularSystem::of(lmp);
}

talus_partner::~talus_partner()
{
  if (has_put_loads) granular->external_loads().clear();
}

bool talus_partner::lives_here() const
{
  return root == TALUS_ALL_RANKS || root == me;
}

/* ---- agreement ------------------------------------------------------------------------------ */

namespace {

std::uint64_t digest_of(const char *bytes, std::size_t count)
{
  StateDigest digest;
  for (std::size_t k = 0; k < count; k++)
    digest.add(static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[k])));
  return digest.value();
}

/// A digest as a number that sums and compares without rounding.
double as_number(std::uint64_t digest)
{
  return static_cast<double>(digest >> 12U);
}

constexpr std::uint64_t of_failure = 0;

void broadcast(std::string &text, int from, MPI_Comm world)
{
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, from, world);
  text.resize(size);
  MPI_Bcast(text.data(), size, MPI_CHAR, from, world);
}

}    // namespace

/* One reduction: of the name of the call, and of the lowest rank whose partner has failed. `name`: nullptr
   for that. */

bool talus_partner::agree(const char *name)
{
  if (!failed.empty()) {
    text = failed;
    return false;
  }
  const double digest = as_number(name ? digest_of(name, std::strlen(name)) : of_failure);
  const double none = std::numeric_limits<double>::max();
  double here[3] = {name ? digest : none, name ? -digest : none, name ? none : me}, all[3];
  MPI_Allreduce(here, all, 3, MPI_DOUBLE, MPI_MIN, world());
  if (all[2] != none) {
    set_failed(static_cast<int>(all[2]));
    return false;
  }
  if (all[0] == -all[1]) return true;
  text = std::string(name) +
         ": not all ranks make this call: every rank makes all calls in the same order";
  std::string first = text;
  broadcast(first, 0, world());
  text = first;
  return false;
}

void talus_partner::set_failed(int rank)
{
  broadcast(text, rank, world());
  failed = text;
}

int talus_partner::fail(const char *why) noexcept
{
  if (!failed.empty()) return TALUS_PARTNER_FAILED;
  text = "the partner on rank " + std::to_string(me) +
         " has failed: " + (why ? why : "no reason given");
  agree(nullptr);
  return TALUS_PARTNER_FAILED;
}

int talus_partner::collective(const char *name, const std::function<void()> &work) noexcept
{
  text.clear();
  if (!agree(name)) return failed.empty() ? TALUS_REFUSED : TALUS_PARTNER_FAILED;
  try {
    work();
    return TALUS_OK;
  } catch (const Refusal &problem) {
    text = std::string(name) + ": " + problem.what();
    return TALUS_REFUSED;
  } catch (const LAMMPSAbortException &problem) {
    // the other ranks wait for this one
    text = problem.what();
    if (num_ranks == 1) return TALUS_HOST_ERROR;
    std::fprintf(stderr, "%s: %s\n", name, text.c_str());
    MPI_Abort(world(), 1);
  } catch (const std::exception &problem) {
    text = problem.what();
    return TALUS_HOST_ERROR;
  }
  return TALUS_HOST_ERROR;
}

/* ---- arguments ------------------------------------------------------------------------------ */

void talus_partner::refuse_if(const std::string &problem)
{
  int first = problem.empty() ? num_ranks : me, first_of_all;
  MPI_Allreduce(&first, &first_of_all, 1, MPI_INT, MPI_MIN, world());
  if (first_of_all == num_ranks) return;
  std::string said = problem;
  broadcast(said, first_of_all, world());
  throw Refusal(said);
}

void talus_partner::all_have_the_same(const char *what, std::uint64_t digest)
{
  const double here[2] = {as_number(digest), -as_number(digest)};
  double all[2];
  MPI_Allreduce(here, all, 2, MPI_DOUBLE, MPI_MIN, world());
  if (all[0] != -all[1])
    throw Refusal(
        std::string(what) +
        " is not the same on all ranks: let the partner live on one, or give all the same");
}

std::string talus_partner::text_of(const char *what, const char *given)
{
  refuse_if(lives_here() && !given ? std::string(what) + " is NULL" : "");
  std::string value = lives_here() ? given : "";
  if (root == TALUS_ALL_RANKS)
    all_have_the_same(what, digest_of(value.data(), value.size()));
  else
    broadcast(value, root, world());
  return value;
}

std::int64_t talus_partner::integer_of(const char *what, std::int64_t given)
{
  return integers_of(what, &given, 1)[0];
}

double talus_partner::number_of(const char *what, double given)
{
  return numbers_of(what, &given, 1)[0];
}

bool talus_partner::has(const char *what, const void *given)
{
  return integer_of(what, given != nullptr) != 0;
}

std::vector<std::int64_t> talus_partner::integers_of(const char *what, const std::int64_t *given,
                                                     std::int64_t count)
{
  std::vector<std::int64_t> values(count);
  refuse_if(lives_here() && count > 0 && !given ? std::string(what) + " is NULL" : "");
  if (lives_here()) std::copy(given, given + count, values.begin());
  if (root == TALUS_ALL_RANKS) {
    StateDigest digest;
    for (const std::int64_t value : values) digest.add(static_cast<std::uint64_t>(value));
    all_have_the_same(what, digest.value());
  } else {
    MPI_Bcast(values.data(), static_cast<int>(count), MPI_INT64_T, root, world());
  }
  return values;
}

std::vector<double> talus_partner::numbers_of(const char *what, const double *given,
                                              std::int64_t count)
{
  std::string problem;
  if (lives_here() && count > 0 && !given) problem = std::string(what) + " is NULL";
  for (std::int64_t k = 0; problem.empty() && lives_here() && k < count; k++)
    if (!std::isfinite(given[k]))
      problem = std::string(what) + (count > 1 ? "[" + std::to_string(k) + "]" : "") +
                " is no finite number";
  refuse_if(problem);
  std::vector<double> values(count);
  if (lives_here()) std::copy(given, given + count, values.begin());
  if (root == TALUS_ALL_RANKS) {
    StateDigest digest;
    digest.add(values.data(), count);
    all_have_the_same(what, digest.value());
  } else {
    MPI_Bcast(values.data(), static_cast<int>(count), MPI_DOUBLE, root, world());
  }
  return values;
}

/* ---- results -------------------------------------------------------------------------------- */

void talus_partner::sum(std::vector<double> &numbers) const
{
  const int count = static_cast<int>(numbers.size());
  if (root == TALUS_ALL_RANKS)
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), count, MPI_DOUBLE, MPI_SUM, world());
  else if (me == root)
    MPI_Reduce(MPI_IN_PLACE, numbers.data(), count, MPI_DOUBLE, MPI_SUM, root, world());
  else
    MPI_Reduce(numbers.data(), nullptr, count, MPI_DOUBLE, MPI_SUM, root, world());
}

std::vector<std::int64_t> talus_partner::gather(const std::vector<std::int64_t> &mine) const
{
  const int here = static_cast<int>(mine.size());
  std::vector<int> counts(num_ranks), first(num_ranks + 1, 0);
  MPI_Allgather(&here, 1, MPI_INT, counts.data(), 1, MPI_INT, world());
  for (int rank = 0; rank < num_ranks; rank++) first[rank + 1] = first[rank] + counts[rank];
  std::vector<std::int64_t> all(lives_here() ? first[num_ranks] : 0);
  if (root == TALUS_ALL_RANKS)
    MPI_Allgatherv(mine.data(), here, MPI_INT64_T, all.data(), counts.data(), first.data(),
                   MPI_INT64_T, world());
  else
    MPI_Gatherv(mine.data(), here, MPI_INT64_T, all.data(), counts.data(), first.data(),
                MPI_INT64_T, root, world());
  return all;
}

void talus_partner::command(const std::string &line)
{
  lmp->input->one(line);
}
