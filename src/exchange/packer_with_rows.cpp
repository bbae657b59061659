// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/packer_with_rows.h"

#include <algorithm>
#include <cstddef>

namespace Talus {

void PackerWithRows::pack(const ExchangeNeighbor &to, double *out)
{
  first->pack(to, out);
  out += static_cast<std::ptrdiff_t>(first->stride()) * to.send_count();
  for (const int particle : to.send_index) out = std::copy_n(row[particle], columns, out);
}

void PackerWithRows::unpack(const ExchangeNeighbor &from, const double *message)
{
  first->unpack(from, message);
  const double *rows =
      message + static_cast<std::ptrdiff_t>(first->stride()) * from.receive_count();
  from.for_each_proxy([&](int proxy, int place, const PeriodicShift &) {
    std::copy_n(rows + static_cast<std::ptrdiff_t>(columns) * place, columns, row[proxy]);
  });
}

}    // namespace Talus
