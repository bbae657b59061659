// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// LAMMPS' communication object with a direct exchange, for comm_style brick and tiled:
// ExchangeSwitch puts it in the place of the stock one. doc/run_style_verlet_proxy.md is the user's page.
//
// Migration and all exchanges of single styles stay those of LAMMPS, and borders too but where
// CommReach chooses proxies; forward_comm(), which runs in every other step, is that of
// DirectExchange. Every method finishes a pending exchange first.

#ifndef LMP_COMM_PROXY_H
#define LMP_COMM_PROXY_H

#include "comm/comm_reach.h"
#include "system/exchange/direct_exchange.h"

#include "comm_tiled.h"

#include <cstring>
#include <vector>

namespace LAMMPS_NS {

/// Base: CommReach or CommTiled.
template <class Base> class CommProxy : public Base {
 public:
  /// Takes over the settings of `old`, which the caller deletes afterwards. Collective.
  CommProxy(class LAMMPS *lmp, class Comm *old) :
      Base(lmp, old),
      direct(lmp, this,
             {[this](MPI_Comm communicator) { return trace_origins(communicator); },
              [this] { return possible_neighbors(); }, [this] { Base::forward_comm(); }})
  {
  }

  void init() override
  {
    direct.abandon();    // left by an error; particles may have changed since
    Base::init();
    direct.init(Base::size_forward);
  }
  void setup() override
  {
    direct.finish();
    Base::setup();
  }
  void set_proc_grid(int outflag = 1) override
  {
    direct.forget_plan();
    Base::set_proc_grid(outflag);
  }
  void exchange() override
  {
    direct.forget_plan();
    Base::exchange();
  }
  void borders() override
  {
    direct.forget_plan();
    Base::borders();
    direct.derive_plan();
  }
  void forward_comm(int dummy = 0) override
  {
    direct.finish();
    if (!direct.has_plan()) return Base::forward_comm(dummy);
    direct.begin(nullptr);
    direct.finish();
  }

  void reverse_comm() override
  {
    direct.finish();
    Base::reverse_comm();
  }
  void forward_comm(class Pair *pair, int size = 0) override { forward_of(pair, size); }
  void reverse_comm(class Pair *pair, int size = 0) override { reverse_of(pair, size); }
  void forward_comm(class Bond *bond, int size = 0) override { forward_of(bond, size); }
  void reverse_comm(class Bond *bond, int size = 0) override { reverse_of(bond, size); }
  void forward_comm(class Fix *fix, int size = 0) override { forward_of(fix, size); }
  void reverse_comm(class Fix *fix, int size = 0) override { reverse_of(fix, size); }
  void reverse_comm_variable(class Fix *fix) override
  {
    direct.finish();
    Base::reverse_comm_variable(fix);
  }
  void forward_comm(class Compute *compute, int size = 0) override { forward_of(compute, size); }
  void reverse_comm(class Compute *compute, int size = 0) override { reverse_of(compute, size); }
  void forward_comm(class Dump *dump, int size = 0) override { forward_of(dump, size); }
  void reverse_comm(class Dump *dump, int size = 0) override { reverse_of(dump, size); }
  void forward_comm_array(int columns, double **array) override
  {
    direct.finish();
    Base::forward_comm_array(columns, array);
  }
  /// `proxies_pending`: an int, whether an update is under way.
  void *extract(const char *name, int &dimension) override
  {
    if (std::strcmp(name, "proxies_pending") != 0) return Base::extract(name, dimension);
    dimension = 0;
    is_pending = direct.pending();
    return &is_pending;
  }
  double memory_usage() override
  {
    return Base::memory_usage() + 2.0 * direct.bytes_per_exchange();
  }

 private:
  template <class Style> void forward_of(Style *style, int size)
  {
    direct.finish();
    Base::forward_comm(style, size);
  }
  template <class Style> void reverse_of(Style *style, int size)
  {
    direct.finish();
    Base::reverse_comm(style, size);
  }

  std::vector<Talus::ProxyOrigin> trace_origins(MPI_Comm communicator);
  std::vector<int> possible_neighbors();

  Talus::DirectExchange direct;
  int is_pending = 0;    // see extract()
};

template <> std::vector<Talus::ProxyOrigin> CommProxy<CommReach>::trace_origins(MPI_Comm);
template <> std::vector<int> CommProxy<CommReach>::possible_neighbors();
template <> std::vector<Talus::ProxyOrigin> CommProxy<CommTiled>::trace_origins(MPI_Comm);
template <> std::vector<int> CommProxy<CommTiled>::possible_neighbors();

using CommProxyBrick = CommProxy<CommReach>;
using CommProxyTiled = CommProxy<CommTiled>;

/// What takes the place of `old`, with its settings.
Comm *make_comm_proxy(LAMMPS *lmp, Comm *old);

}    // namespace LAMMPS_NS

#endif
