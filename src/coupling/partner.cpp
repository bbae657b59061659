// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "coupling/partner.h"

#include "base/state_digest.h"
#include "exchange/large_messages.h"

#include "comm.h"
#include "error.h"
#include "exceptions.h"
#include "input.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <locale.h>

using namespace LAMMPS_NS;
using namespace Talus;

int OwnRanks::last_number = 0;

OwnRanks::~OwnRanks()
{
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized) MPI_Comm_free(&comm);
}

/* Another instance may have got the address of one that is gone. */

std::shared_ptr<OwnRanks> OwnRanks::of(LAMMPS *lmp, MPI_Comm of_instance)
{
  static std::map<const LAMMPS *, std::weak_ptr<OwnRanks>> all;
  std::shared_ptr<OwnRanks> ranks = all[lmp].lock();
  int alike = MPI_UNEQUAL;
  if (ranks) MPI_Comm_compare(ranks->comm, of_instance, &alike);
  if (ranks && ranks->failed.empty() && alike == MPI_CONGRUENT) return ranks;
  ranks = std::make_shared<OwnRanks>(of_instance);
  MPI_Allreduce(&last_number, &ranks->last, 1, MPI_INT, MPI_MAX, ranks->comm);
  all[lmp] = ranks;
  return ranks;
}

/* Never used again, also after all partners are closed. */

int OwnRanks::next_number()
{
  last_number = std::max(last_number, ++last);
  return last;
}

talus_partner::talus_partner(LAMMPS *lmp, int root_rank) :
    Pointers(lmp), ranks(OwnRanks::of(lmp, Pointers::world)), order(ranks->coming_number()),
    root(root_rank)
{
  MPI_Comm_rank(world(), &me);
  MPI_Comm_size(world(), &num_ranks);
  if (!agree("talus_open")) throw Refusal("talus_open: " + text);
  static_cast<void>(ranks->next_number());
  int here[2] = {root, -root}, lowest[2];
  MPI_Allreduce(here, lowest, 2, MPI_INT, MPI_MIN, world());
  if (lowest[0] != -lowest[1])
    throw Refusal("talus_open: root is not the same on all ranks: " + std::to_string(lowest[0]) +
                  " to " + std::to_string(-lowest[1]));
  if (root < TALUS_ALL_RANKS || root >= num_ranks)
    throw Refusal("talus_open: root is " + std::to_string(root) + ", expected " +
                  std::to_string(TALUS_ALL_RANKS) + " (all ranks) or a rank below " +
                  std::to_string(num_ranks));
}

namespace {

/// Numbers of scripts have a point, whatever the program writes. For this thread.
class PointInNumbers {
 public:
  PointInNumbers() : before(uselocale(static_cast<locale_t>(nullptr)))
  {
    with_point = newlocale(LC_NUMERIC_MASK, "C", duplocale(before));
    uselocale(with_point);
  }
  ~PointInNumbers()
  {
    uselocale(before);
    freelocale(with_point);
  }
  PointInNumbers(const PointInNumbers &) = delete;
  PointInNumbers &operator=(const PointInNumbers &) = delete;

 private:
  locale_t before, with_point;
};

}    // namespace

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

/// A message of LAMMPS, without the word ERROR.
std::string in_one_line(std::string message)
{
  std::replace(message.begin(), message.end(), '\n', ' ');
  const std::size_t last = message.find_last_not_of(' '), colon = message.find(": ");
  message.resize(last == std::string::npos ? 0 : last + 1);
  return message.compare(0, 5, "ERROR") == 0 && colon != std::string::npos
             ? message.substr(colon + 2)
             : message;
}

void broadcast(std::string &text, int from, MPI_Comm world)
{
  std::uint64_t size = text.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, from, world);
  text.resize(size);
  Talus::broadcast(text.data(), size, MPI_CHAR, from, world);
}

}    // namespace

/* One reduction: of the name of the call, of the partner, and of the lowest rank whose partner has failed. `name`:
   nullptr for that. Ranks that make different calls have lost each other for good, whatever the partner. */

bool talus_partner::agree(const char *name)
{
  if (!why_failed().empty()) {
    text = why_failed();
    return false;
  }
  const double digest = as_number(name ? digest_of(name, std::strlen(name)) : of_failure);
  const double none = std::numeric_limits<double>::max(), partner = order;
  double here[5] = {name ? digest : none, name ? -digest : none, name ? none : me, partner,
                    -partner},
         all[5];
  MPI_Allreduce(here, all, 5, MPI_DOUBLE, MPI_MIN, world());
  const bool same_partner = all[3] == -all[4];
  if (all[2] != none) {
    set_failed(static_cast<int>(all[2]), !same_partner);
    return false;
  }
  if (all[0] == -all[1] && same_partner) return true;
  text = "not all ranks make the same call, on rank 0 " + std::string(name) +
         (same_partner ? "" : " of partner " + std::to_string(order)) +
         ": every rank makes all calls in the same order";
  set_failed(0, true);
  return false;
}

void talus_partner::set_failed(int rank, bool all_partners)
{
  broadcast(text, rank, world());
  (all_partners ? ranks->failed : failed) = text;
}

int talus_partner::fail(const char *why) noexcept
{
  if (!why_failed().empty()) return TALUS_PARTNER_FAILED;
  text = "the partner on rank " + std::to_string(me) +
         " has failed: " + (why ? why : "no reason given");
  agree(nullptr);
  return TALUS_PARTNER_FAILED;
}

int talus_partner::close() noexcept
{
  if (const auto of_instance = of_last_call.lock())
    for (const auto &[name, work] : last) work(*of_instance);
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized || !why_failed().empty()) return TALUS_OK;
  text.clear();
  return agree("talus_close") ? TALUS_OK : TALUS_PARTNER_FAILED;
}

int talus_partner::collective(const char *name, const std::function<void()> &work) noexcept
{
  text.clear();
  if (!agree(name)) return TALUS_PARTNER_FAILED;
  const PointInNumbers numbers;
  of_last_call = granular = GranularSystem::of(lmp);
  const int code = code_of(name, work);
  granular.reset();
  return code;
}

/* An error of LAMMPS on all ranks leaves it in no state to go on from without a set-up. */

int talus_partner::code_of(const char *name, const std::function<void()> &work)
{
  try {
    work();
    return TALUS_OK;
  } catch (const Refusal &problem) {
    text = std::string(name) + ": " + problem.what();
    return TALUS_REFUSED;
  } catch (const LAMMPSAbortException &problem) {
    return stop_all(name, problem);
  } catch (const LAMMPSException &problem) {
    text = std::string(name) + ": " + in_one_line(problem.what());
    needs_set_up = true;
    return TALUS_HOST_ERROR;
  } catch (const std::exception &problem) {
    return stop_all(name, problem);
  }
}

/* The other ranks wait for this one. */

int talus_partner::stop_all(const char *name, const std::exception &problem)
{
  text = std::string(name) + ": " + in_one_line(problem.what());
  needs_set_up = true;
  if (num_ranks == 1) return TALUS_HOST_ERROR;
  std::fprintf(stderr, "%s\n", text.c_str());
  MPI_Abort(world(), 1);
  return TALUS_HOST_ERROR;
}

/* ---- arguments ------------------------------------------------------------------------------ */

/* One reduction: of the lowest rank with a problem, and of what is to be the same wherever the partner
   lives. */

void talus_partner::check(const char *what, const std::string &problem, std::uint64_t digest)
{
  const double none = std::numeric_limits<double>::max();
  double here[3] = {problem.empty() ? none : me, none, none}, all[3];
  if (lives_here()) {
    here[1] = as_number(digest);
    here[2] = -here[1];
  }
  MPI_Allreduce(here, all, 3, MPI_DOUBLE, MPI_MIN, world());
  if (all[0] != none) {
    std::string said = problem;
    broadcast(said, static_cast<int>(all[0]), world());
    throw Refusal(said);
  }
  if (all[1] != -all[2])
    throw Refusal(
        std::string(what) +
        " is not the same on all ranks: let the partner live on one, or give all the same");
}

bool talus_partner::is_given(bool here) const
{
  int any = here && lives_here();
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world());
  return any != 0;
}

void talus_partner::refuse_if(const std::string &problem)
{
  check("", problem, 0);
}

std::string talus_partner::text_of(const char *what, const char *given)
{
  std::string value = lives_here() && given ? given : "";
  check(what, lives_here() && !given ? std::string(what) + " is NULL" : "",
        digest_of(value.data(), value.size()));
  if (root != TALUS_ALL_RANKS) broadcast(value, root, world());
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
  const bool missing = lives_here() && count > 0 && !given;
  if (lives_here() && !missing) std::copy(given, given + count, values.begin());
  StateDigest digest;
  for (const std::int64_t value : values) digest.add(static_cast<std::uint64_t>(value));
  check(what, missing ? std::string(what) + " is NULL" : "", digest.value());
  if (root != TALUS_ALL_RANKS) broadcast(values.data(), values.size(), MPI_INT64_T, root, world());
  return values;
}

std::vector<double> talus_partner::numbers_of(const char *what, const double *given,
                                              std::int64_t count)
{
  std::vector<double> values(count);
  std::string problem;
  if (lives_here() && count > 0 && !given)
    problem = std::string(what) + " is NULL";
  else if (lives_here())
    std::copy(given, given + count, values.begin());
  const auto wrong =
      std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (wrong != values.end())
    problem = std::string(what) +
              (count > 1 ? "[" + std::to_string(wrong - values.begin()) + "]" : "") +
              " is no finite number";
  StateDigest digest;
  digest.add(values.data(), count);
  check(what, problem, digest.value());
  if (root != TALUS_ALL_RANKS) broadcast(values.data(), values.size(), MPI_DOUBLE, root, world());
  return values;
}

/* ---- results -------------------------------------------------------------------------------- */

/* Instances of talus_partner that live on all ranks have a negative root. */

void talus_partner::sum(std::vector<double> &numbers) const
{
  sum_over_ranks(numbers, root, world());
}

std::vector<std::int64_t> talus_partner::gather(const std::vector<std::int64_t> &mine) const
{
  return Talus::gather(mine, MPI_INT64_T, root, world());
}

void talus_partner::command(const std::string &line)
{
  lmp->input->one(line);
}

void talus_partner::set_up_if_needed()
{
  const auto &state = system().setup_state();
  if (needs_set_up || !state.change_with_particles().empty() || state.has_new_dump()) set_up();
}

void talus_partner::set_up_if_lost()
{
  if (!system().setup_state().lost().empty()) set_up();
}

/* A run style of LAMMPS does not tell that a run has been set up. */

void talus_partner::set_up()
{
  system().external_loads().make_fix();
  command("run 0 post no");
  needs_set_up = false;
  system().setup_state().record_setup();
}
