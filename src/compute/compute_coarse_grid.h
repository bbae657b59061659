// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// compute coarse/grid: density, velocity, granular temperature and stress as continuous fields, on
// a grid of LAMMPS, for fix ave/grid and dump grid. doc/compute_coarse_grid.md is the user's page
// and has the equations.

#ifndef LMP_COMPUTE_COARSE_GRID_H
#define LMP_COMPUTE_COARSE_GRID_H

#include "compute/grid_sum.h"
#include "system/contacts/contact_list.h"
#include "system/contacts/contact_observer.h"
#include "system/loads/coarse_kernel.h"
#include "system/step/granular_system.h"

#include "compute.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class ComputeCoarseGrid : public Compute, private Talus::ContactObserver {
 public:
  ComputeCoarseGrid(LAMMPS *, int, char **);
  ~ComputeCoarseGrid() override;

  void init() override;
  void init_list(int, NeighList *list) override { contacts.set_list(list); }
  void compute_pergrid() override;

  void reset_grid() override;
  void require_countable() const;
  int get_grid_by_name(const std::string &, int &) override;
  void *get_grid_by_index(int) override;
  int get_griddata_by_name(int, const std::string &, int &) override;
  void *get_griddata_by_index(int) override;
  double memory_usage() override;

 private:
  void check_box();
  double reach() const;
  void free_data();
  void add_particles();
  void add_volume(const Talus::Vector3<double> &x, double volume);
  void add_contacts();
  bool asks_for_work() const override { return false; }
  void add_branch(const Talus::Vector3<double> &from, const Talus::Vector3<double> &to,
                  const Talus::Vector3<double> &force);
  double *moments_of(const Talus::CoarseKernel::Share &share);
  double value(int quantity, const double *moments) const;

  int cells[3];
  std::array<bool, 3> mean_of{};    // directions of which the one cell takes the mean
  double width;
  std::vector<int> quantities;    // what each column is
  bool with_contacts = false, with_volumes = false;
  std::shared_ptr<Talus::GranularSystem> system;    // its bodies
  Talus::ContactList contacts;

  std::unique_ptr<GridSum> sums;
  double box_of_grid[3] = {}, reach_of_grid = 0.0;
  std::unique_ptr<Talus::CoarseKernel> kernel;
  double ***vector_of_cells = nullptr, ****array_of_cells = nullptr;
};

}    // namespace LAMMPS_NS

#endif
