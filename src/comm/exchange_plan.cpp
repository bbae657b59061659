// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/exchange_plan.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

using namespace Talus;

namespace {

constexpr int words_per_run = 4;    // of a request: count, shift in x, y, z

[[noreturn]] void reject(int rank, const std::string &why)
{
  throw std::invalid_argument("request of rank " + std::to_string(rank) + ": " + why);
}

}    // namespace

int Talus::message_length(int stride, std::size_t count)
{
  const std::size_t most = std::numeric_limits<int>::max();
  if (stride > 0 && count > most / stride)
    throw std::length_error(
        "a message between two ranks with more than 2^31 numbers: use more ranks");
  return stride * static_cast<int>(count);
}

void ExchangePlan::clear()
{
  owned = proxies = 0;
  own = ExchangeNeighbor{};
  others.clear();
  origin.clear();
}

/* Kept sorted by distance above our own rank. */

ExchangeNeighbor &ExchangePlan::neighbor(int rank)
{
  if (rank == me) return own;
  const auto before = [this](const ExchangeNeighbor &n, int wanted) {
    return std::make_pair(n.rank < me, n.rank) < std::make_pair(wanted < me, wanted);
  };
  auto place = std::lower_bound(others.begin(), others.end(), rank, before);
  if (place == others.end() || place->rank != rank) {
    place = others.emplace(place);
    place->rank = rank;
  }
  return *place;
}

void ExchangePlan::build(int my_rank, int first_proxy, const std::vector<ProxyOrigin> &origins)
{
  clear();
  me = own.rank = my_rank;
  owned = first_proxy;
  proxies = static_cast<int>(origins.size());
  origin = origins;

  ExchangeNeighbor *from = nullptr;
  for (int k = 0; k < proxies; k++) {
    const ProxyOrigin &o = origins[k];
    const bool continues = from && from->rank == o.owner && from->receive.back().shift == o.shift;
    if (!continues) {
      from = &neighbor(o.owner);    // adding one moves the others: looked up again each time
      from->receive.push_back({first_proxy + k, 0, o.shift});
    }
    from->receive.back().count++;
    from->receive_count++;
  }
  accept_request(me, request_for(me));
}

std::vector<int> ExchangePlan::request_for(int rank) const
{
  const ExchangeNeighbor *from = &own;
  if (rank != me) {
    const auto found = std::find_if(others.begin(), others.end(),
                                    [rank](const ExchangeNeighbor &n) { return n.rank == rank; });
    if (found == others.end()) return {};
    from = &*found;
  }
  if (from->receive.empty()) return {};

  std::vector<int> message{static_cast<int>(from->receive.size())};
  message.reserve(1 + words_per_run * from->receive.size() + from->receive_count);
  for (const ProxyRun &run : from->receive) {
    message.push_back(run.count);
    message.insert(message.end(), run.shift.begin(), run.shift.end());
  }
  for (const ProxyRun &run : from->receive)
    for (int k = run.first; k < run.first + run.count; k++)
      message.push_back(origin[k - owned].index);
  return message;
}

void ExchangePlan::accept_request(int rank, const std::vector<int> &message)
{
  if (message.empty()) return;
  take_runs(neighbor(rank), message);
}

void ExchangePlan::take_runs(ExchangeNeighbor &to, const std::vector<int> &message) const
{
  const auto size = static_cast<std::int64_t>(message.size());
  const std::int64_t runs = message[0], head = 1 + words_per_run * runs;
  if (runs < 1 || head > size) reject(to.rank, "wrong number of runs");

  to.send.clear();
  std::int64_t total = 0;
  for (std::int64_t r = 0; r < runs; r++) {
    const int *word = &message[1 + words_per_run * r];
    if (word[0] < 1) reject(to.rank, "empty run");
    to.send.push_back({static_cast<int>(total), word[0], {word[1], word[2], word[3]}});
    total += word[0];
    if (total > size) reject(to.rank, "runs and indices do not match");
  }
  if (head + total != size) reject(to.rank, "runs and indices do not match");

  to.send_index.assign(message.begin() + head, message.end());
  for (const int i : to.send_index)
    if (i < 0 || i >= owned) reject(to.rank, "particle " + std::to_string(i) + " is not ours");
}

int ExchangePlan::num_interior() const
{
  std::vector<char> shared(owned, 0);
  for (const int i : own.send_index) shared[i] = 1;
  for (const ExchangeNeighbor &n : others)
    for (const int i : n.send_index) shared[i] = 1;
  return static_cast<int>(std::count(shared.begin(), shared.end(), 0));
}
