// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/exchange_report.h"

#include "fmt/format.h"

#include <algorithm>

using namespace Talus;

namespace {

std::string line(const char *what, double value, MPI_Comm world)
{
  const Spread s = spread_over_ranks(value, world);
  return fmt::format("  {:<34} {:>12.6g} {:>12.6g} {:>12.6g}\n", what, s.least, s.mean, s.largest);
}

double per_exchange(double sum, const ExchangeCounters &counters)
{
  return counters.exchanges > 0.0 ? sum / counters.exchanges : 0.0;
}

}    // namespace

Spread Talus::spread_over_ranks(double value, MPI_Comm world)
{
  int ranks = 1;
  Spread s{};
  MPI_Comm_size(world, &ranks);
  MPI_Allreduce(&value, &s.least, 1, MPI_DOUBLE, MPI_MIN, world);
  MPI_Allreduce(&value, &s.largest, 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(&value, &s.mean, 1, MPI_DOUBLE, MPI_SUM, world);
  s.mean /= ranks;
  return s;
}

std::string Talus::describe_exchange(DirectExchange &proxies, double share_without_proxies,
                                     MPI_Comm world)
{
  const ExchangePlan &plan = proxies.plan();
  const ExchangeCounters &c = proxies.counters();
  const double owned = plan.num_owned();
  std::string text =
      "comm_proxy: on" + std::string(proxies.is_checking() ? ", checking" : "") + "\n";
  text += "  message: " + proxies.describe_message() + "\n";
  text += fmt::format("  {:<34} {:>12} {:>12} {:>12}\n", "per rank", "least", "mean", "largest");
  text += line("owned particles", owned, world);
  text += line("proxies", plan.num_proxies(), world);
  text += line("neighbor ranks", static_cast<double>(plan.neighbors().size()), world);
  text += line("messages per exchange", proxies.messages_per_exchange(), world);
  text += line("bytes per exchange", proxies.bytes_per_exchange(), world);
  text += line("share of owned that are no proxies",
               owned > 0.0 ? plan.num_interior() / owned : 1.0, world);
  text += line("share computed without proxies", share_without_proxies, world);
  text += line("exchanges so far", c.exchanges, world);
  text += line("  of them overlapped", c.overlapped, world);
  text += line("messages sent", c.messages, world);
  text += line("bytes sent", c.bytes, world);
  text += line("particles sent", c.particles, world);
  text += line("seconds packing and sending", c.pack_seconds, world);
  text += line("seconds waiting", c.wait_seconds, world);
  text += line("seconds unpacking", c.unpack_seconds, world);
  return text;
}

std::string Talus::summarize_exchange(const ExchangeCounters &c, MPI_Comm world)
{
  const Spread messages = spread_over_ranks(per_exchange(c.messages, c), world);
  const Spread bytes = spread_over_ranks(per_exchange(c.bytes, c), world);
  const Spread waited = spread_over_ranks(c.wait_seconds, world);
  const Spread copied = spread_over_ranks(c.pack_seconds + c.unpack_seconds, world);
  return fmt::format("Talus exchange: {:.0f} updates of proxies, {:.0f} overlapped; per rank "
                     "(min/avg/max) messages {:.3g}/{:.3g}/{:.3g}, bytes {:.4g}/{:.4g}/{:.4g} "
                     "per update, s packing {:.3g}/{:.3g}/{:.3g}, waiting {:.3g}/{:.3g}/{:.3g}\n",
                     c.exchanges, c.overlapped, messages.least, messages.mean, messages.largest,
                     bytes.least, bytes.mean, bytes.largest, copied.least, copied.mean,
                     copied.largest, waited.least, waited.mean, waited.largest);
}
