// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The invariant checks of DirectExchange, switched on by `comm_proxy check yes`.

#include "system/exchange/direct_exchange.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;

namespace Talus {

namespace {

/* Brings tag and type of the owner to the proxy, and counts where they are not the proxy's own. */

class IdentityPacker : public ProxyPacker {
 public:
  explicit IdentityPacker(const Atom *of) : atom(of), seen(of->nlocal + of->nghost, 0) {}

  int stride() const override { return 2; }

  void pack(const ExchangeNeighbor &to, double *out) override
  {
    for (const int i : to.send_index) {
      *out++ = static_cast<double>(tag_of(i));
      *out++ = atom->type[i];
    }
  }

  void unpack(const ExchangeNeighbor &from, const double *message) override
  {
    from.for_each_proxy([&](int i, int place, const PeriodicShift &) {
      const double *in = message + 2L * place;
      seen[i]++;
      if (in[0] != static_cast<double>(tag_of(i)) || in[1] != atom->type[i]) wrong++;
    });
  }

  /// Proxies with another owner than they should, and proxies without or with several owners.
  int num_wrong() const { return wrong; }
  int num_not_once() const
  {
    int count = 0;
    for (int i = 0; i < atom->nlocal + atom->nghost; i++)
      count += seen[i] != (i < atom->nlocal ? 0 : 1);
    return count;
  }

 private:
  tagint tag_of(int i) const { return atom->tag_enable ? atom->tag[i] : 0; }

  const Atom *atom;
  std::vector<int> seen;
  int wrong = 0;
};

bool same(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

}    // namespace

void DirectExchange::check_owners()
{
  const ExchangeCounters before = transfer.counters;
  IdentityPacker packer(atom);
  transfer.begin(packer);
  transfer.finish();
  transfer.counters = before;
  if (packer.num_not_once() || packer.num_wrong())
    error->one(FLERR,
               "comm_proxy check: of {} proxies {} do not have exactly one owner, and {} have "
               "another one than they should (internal error)",
               atom->nghost, packer.num_not_once(), packer.num_wrong());
}

/* A proxy that is read too early is NaN. */

void DirectExchange::poison_proxies()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++)
    for (int d = 0; d < 3; d++) {
      atom->x[i][d] = nan;
      if (comm->ghost_velocity) atom->v[i][d] = nan;
      if (own_packing) atom->omega[i][d] = nan;
    }
}

/* LAMMPS' staged exchange goes another way and must bring the same. What ours has brought is
   put back, so that checks change nothing. */

void DirectExchange::check_states()
{
  const int first = atom->nlocal, count = atom->nghost;
  const bool rotation = atom->omega_flag && comm->ghost_velocity;
  const auto snapshot = [first, count](double **of) {
    std::vector<double> kept(3 * static_cast<std::size_t>(count));
    if (count) std::memcpy(kept.data(), of[first], sizeof(double) * kept.size());
    return kept;
  };
  const auto differs_then_restore = [&](double **array, const std::vector<double> &kept) {
    bool differs = false;
    const double *now = count ? array[first] : nullptr;
    for (std::size_t k = 0; k < kept.size(); k++) differs |= !same(now[k], kept[k]);
    if (count) std::memcpy(array[first], kept.data(), sizeof(double) * kept.size());
    return differs;
  };

  const std::vector<double> x = snapshot(atom->x);
  const std::vector<double> v = comm->ghost_velocity ? snapshot(atom->v) : std::vector<double>();
  const std::vector<double> omega = rotation ? snapshot(atom->omega) : std::vector<double>();
  staged.forward();
  bool wrong = differs_then_restore(atom->x, x);
  if (comm->ghost_velocity) wrong |= differs_then_restore(atom->v, v);
  if (rotation) wrong |= differs_then_restore(atom->omega, omega);
  if (wrong)
    error->one(FLERR, "comm_proxy check: the state of a proxy is not that of its owner "
                      "(internal error)");
}

}    // namespace Talus
