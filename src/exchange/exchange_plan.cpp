// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/exchange_plan.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

using namespace Talus;

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
  self_images = ExchangeNeighbor{};
  others.clear();
}

/* Kept sorted by distance above our own rank. */

ExchangeNeighbor &ExchangePlan::neighbor(int rank)
{
  if (rank == me) return self_images;
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
  me = self_images.rank = my_rank;
  owned = first_proxy;
  proxies = static_cast<int>(origins.size());

  ExchangeNeighbor *last = nullptr;
  for (int k = 0; k < proxies; k++) add_to_runs(origins[k], first_proxy + k, last);
  arrange_message(self_images);
  for (ExchangeNeighbor &from : others) arrange_message(from);
  accept_request(me, self_images.receive_index);
}

/* Leaves the owner's index where the place in the message will stand. */

void ExchangePlan::add_to_runs(const ProxyOrigin &origin, int proxy, ExchangeNeighbor *&last)
{
  const bool continues =
      last && last->rank == origin.owner && last->receive.back().shift == origin.shift;
  if (!continues) {
    last = &neighbor(origin.owner);    // adding one moves the others: looked up again each time
    last->receive.push_back({proxy, 0, origin.shift});
  }
  last->receive.back().count++;
  last->receive_place.push_back(origin.index);
}

void ExchangePlan::arrange_message(ExchangeNeighbor &from)
{
  std::vector<int> &wanted = from.receive_index;
  wanted.clear();
  if (from.receive_place.empty()) return;
  // by index of the owner: wanted, and then where in the message
  const auto last = std::max_element(from.receive_place.begin(), from.receive_place.end());
  std::vector<int> place_of(*last + 1, -1);
  for (const int index : from.receive_place) place_of[index] = 0;
  for (int index = 0; index <= *last; index++)
    if (place_of[index] == 0) {
      place_of[index] = static_cast<int>(wanted.size());
      wanted.push_back(index);
    }
  for (int &place : from.receive_place) place = place_of[place];
}

std::vector<int> ExchangePlan::request_for(int rank) const
{
  if (rank == me) return self_images.receive_index;
  for (const ExchangeNeighbor &n : others)
    if (n.rank == rank) return n.receive_index;
  return {};
}

void ExchangePlan::accept_request(int rank, const std::vector<int> &message)
{
  if (message.empty()) return;
  const auto reject = [rank](const std::string &why) {
    throw std::invalid_argument("request of rank " + std::to_string(rank) + ": " + why);
  };
  int before = -1;
  for (const int i : message) {
    if (i < 0 || i >= owned) reject("particle " + std::to_string(i) + " is not ours");
    if (i <= before) reject("particle " + std::to_string(i) + " is not in order");
    before = i;
  }
  neighbor(rank).send_index = message;
}

int ExchangePlan::num_interior() const
{
  std::vector<char> shared(owned, 0);
  for (const int i : self_images.send_index) shared[i] = 1;
  for (const ExchangeNeighbor &n : others)
    for (const int i : n.send_index) shared[i] = 1;
  return static_cast<int>(std::count(shared.begin(), shared.end(), 0));
}
