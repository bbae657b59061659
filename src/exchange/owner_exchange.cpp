// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/owner_exchange.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace Talus {
namespace {

constexpr std::size_t doubles_of_sum = sizeof(ScaledSum) / sizeof(double);
static_assert(sizeof(ScaledSum) == doubles_of_sum * sizeof(double));

}    // namespace

OwnerExchange::OwnerExchange(MPI_Comm parent, std::vector<Home> of_items) :
    homes(std::move(of_items)), exchange(parent)
{
  MPI_Comm_rank(parent, &me);
  owned = static_cast<int>(std::count_if(homes.begin(), homes.end(),
                                         [this](const Home &home) { return home.rank == me; }));
}

/* A message has for each item its place, and the sums as they are in memory. */

std::vector<ScaledSum> OwnerExchange::to_owners(const std::vector<int> &items,
                                                const std::vector<ScaledSum> &sums, int width)
{
  std::vector<ScaledSum> totals(static_cast<std::size_t>(owned) * width);
  const auto add = [&](int place, const ScaledSum *parts) {
    ScaledSum *const to = &totals[static_cast<std::size_t>(place) * width];
    for (int k = 0; k < width; k++) to[k].add(parts[k]);
  };
  const std::size_t of_item = 1 + width * doubles_of_sum;
  Messages messages;
  for (std::size_t n = 0; n < items.size(); n++) {
    const Home &home = homes[items[n]];
    const ScaledSum *const parts = &sums[n * width];
    if (home.rank == me) {
      add(home.place, parts);
      continue;
    }
    std::vector<double> &message = messages[home.rank];
    message.resize(message.size() + of_item);
    double *const to = &message[message.size() - of_item];
    *to = home.place;
    std::memcpy(to + 1, parts, width * sizeof(ScaledSum));
  }
  std::vector<ScaledSum> parts(width);
  exchange.run(messages, 0, [&](const std::vector<double> &message) {
    for (std::size_t at = 0; at < message.size(); at += of_item) {
      std::memcpy(static_cast<void *>(parts.data()), &message[at + 1], width * sizeof(ScaledSum));
      add(static_cast<int>(message[at]), parts.data());
    }
  });
  return totals;
}

/* Who asks tells its rank and places; the answer has the rank of the owner, and numbers in that order. */

std::vector<double> OwnerExchange::from_owners(const std::vector<int> &items,
                                               const std::vector<double> &values, int width)
{
  std::vector<double> found(items.size() * width);
  const auto copy = [&](const double *from, std::size_t item) {
    std::copy(from, from + width, &found[item * width]);
  };
  Messages questions, answers;
  std::map<int, std::vector<std::size_t>> asked;
  for (std::size_t n = 0; n < items.size(); n++) {
    const Home &home = homes[items[n]];
    if (home.rank == me) {
      copy(&values[static_cast<std::size_t>(home.place) * width], n);
      continue;
    }
    std::vector<double> &question = questions[home.rank];
    if (question.empty()) question.push_back(me);
    question.push_back(home.place);
    asked[home.rank].push_back(n);
  }
  exchange.run(questions, 0, [&](const std::vector<double> &question) {
    std::vector<double> &answer = answers[static_cast<int>(question[0])];
    answer.push_back(me);
    for (std::size_t at = 1; at < question.size(); at++) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(question[at]) * width;
      answer.insert(answer.end(), from, from + width);
    }
  });
  exchange.run(answers, 0, [&](const std::vector<double> &answer) {
    const double *next = answer.data() + 1;
    for (const std::size_t item : asked[static_cast<int>(answer[0])]) {
      copy(next, item);
      next += width;
    }
  });
  return found;
}

}    // namespace Talus
