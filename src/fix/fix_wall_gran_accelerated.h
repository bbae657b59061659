// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the accelerated variants of fix wall/gran and fix wall/gran/region share. They are the stock
// classes (command line, histories, restart data, output), but look only at the particles near the
// wall, and do so where the particles are: in the arrays of LAMMPS or in the records. The kernels
// of the same contact law compute the contacts: the numbers are those of the stock class but for
// rounding.
//
// Where that is not possible the methods of the stock class are used, with the reason in the log.

#ifndef TALUS_FIX_FIX_WALL_GRAN_ACCELERATED_H
#define TALUS_FIX_FIX_WALL_GRAN_ACCELERATED_H

#include "fix/plain_style.h"
#include "fix/wall_batch.h"
#include "fix/wall_candidates.h"
#include "system/granular_system.h"
#include "system/time_formula.h"

#include "atom.h"
#include "atom_vec.h"
#include "fix.h"
#include "force.h"
#include "gran_sub_mod.h"
#include "granular_model.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <memory>
#include <string>

namespace Talus {

/// Stock: FixWallGran or a class derived from it.
template <class Stock> class AcceleratedWall : public Stock, public SystemFix {
 public:
  /// `plain`: name of the style without suffix.
  AcceleratedWall(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, const char *plain) :
      Stock(lmp, narg, arg), system(GranularSystem::of(lmp)), plain_style(plain)
  {
  }

  void post_constructor() override
  {
    Stock::post_constructor();
    LAMMPS_NS::restore_style(this, plain_style);
  }

  int setmask() override { return Stock::setmask() | LAMMPS_NS::FixConst::POST_NEIGHBOR; }

  void init() override
  {
    Stock::init();
    candidates.forget();
    has_forces = false;
    stock_reason = find_reason_for_stock();
    if (!stock_reason.empty()) return;
    wall_law.take(*this->model);
    begin_run();
  }

  void setup_post_neighbor() override { candidates.forget(); }
  void post_neighbor() override { candidates.forget(); }

  void post_force(int vflag) override
  {
    if (!stock_reason.empty()) {
      Stock::post_force(vflag);
      return;
    }
    add_contacts();
    has_forces = true;
  }

  double memory_usage() override { return Stock::memory_usage() + candidates.memory_usage(); }

  // SystemFix
  std::string reason_for_stock() const override { return stock_reason; }
  bool adds_forces() const override { return true; }
  bool is_touched() const override { return true; }
  /// Of a wall that is not accelerated there are none.
  void for_each_contact(ContactData requested, const VisitContact &visit) override
  {
    if (!has_forces) return;
    const ReportRequest request{requested, visit};
    report = &request;
    report_contacts();
    report = nullptr;
  }
  std::string needs_arrays() override
  {
    if (!stock_reason.empty()) return stock_reason;
    if (this->heat_flag && this->tstr && !reads_only_time(this->lmp, this->tstr))
      return std::string("variable ") + this->tstr + " reads more than time";
    if (!system->pipeline().keeps_omega())
      return "it exerts torques and the contacts between particles do not";
    return what_reads_arrays();
  }

 protected:
  std::shared_ptr<GranularSystem> system;
  WallCandidates candidates;
  WallLaw wall_law;

  /// In init(), if the run is accelerated.
  virtual void begin_run() = 0;
  /// The forces of a step, on particles of which each is where it is.
  virtual void add_contacts() = 0;
  /// Reports the contacts as add_contacts() has left them, through deliver().
  virtual void report_contacts() = 0;
  /// "", or why the methods of the stock class are needed by this kind of wall.
  virtual std::string what_only_stock_does() const = 0;
  /// "", or what in this wall may read the arrays of LAMMPS in every step.
  virtual std::string what_reads_arrays() = 0;

  /// Radii may grow between two rebuilds.
  bool radii_vary() const
  {
    return this->atom->avec->size_forward > 3 || !this->modify->get_fix_by_style("^adapt").empty();
  }
  bool is_member(int i) const { return this->atom->mask[i] & this->groupbit; }
  /// Forces by particle are kept for output.
  bool keeps_contacts() const
  {
    return this->peratom_flag && (system->particles().is_in_arrays() ||
                                  system->steps_in_records().fix_calls().somebody_looks());
  }
  bool touches_beyond_contact() const { return this->model->beyond_contact; }

  /// The temperature of the wall in this step, if it conducts heat.
  void find_wall_temperature()
  {
    if (this->heat_flag && this->tstr)
      this->Twall = this->input->variable->compute_equal(this->tvar);
  }
  double temperature_difference(int i) const
  {
    return this->heat_flag ? this->Twall - this->atom->temperature[i] : 0.0;
  }

  /// Begins a step of a batch, or a report.
  void begin(WallBatch &batch)
  {
    const double dt = this->update->dt;
    if (report)
      batch.begin_report(dt);
    else    // as in LAMMPS: histories stand still while a run is set up
      batch.begin_step(wall_law, this->update->setupflag ? 0.0 : dt, accounts ? &account : nullptr);
  }

  /// Before the batches of a step begin.
  void begin_account()
  {
    accounts = system->account().is_asked();
    if (accounts) account = system->account().part_of_step();
  }

  void deliver(WallBatch &batch, const ParticleState &particles)
  {
    if (report) {
      batch.report(particles, report->requested, report->visit);
      return;
    }
    batch.compute(particles);
    const bool keeps = keeps_contacts();
    if (this->heat_flag || keeps)
      batch.for_each_result([&](const WallBatch::Result &result) {
        if (this->heat_flag) this->atom->heatflow[result.atom] += result.heat_flow;
        if (keeps) keep_contact(result, particles);
      });
    batch.clear();
  }

 private:
  /// Row of a particle in the output by particle: force, contact point, radius, heat flow.
  void keep_contact(const WallBatch::Result &result, const ParticleState &particles)
  {
    double *row = this->array_atom[result.atom];
    row[0] = 1.0;
    for (int d = 0; d < 3; d++) {
      row[1 + d] = result.force[d];
      row[4 + d] = particles.x(result.atom)[d] - result.separation[d];
    }
    row[7] = this->atom->radius[result.atom];
    if (this->size_peratom_cols > 8) row[8] = result.heat_flow;
  }

  struct ReportRequest {
    ContactData requested;
    const VisitContact &visit;
  };

  const char *plain_style;
  std::string stock_reason;
  bool has_forces = false;    // of a step
  const ReportRequest *report = nullptr;
  bool accounts = false;
  WorkAccount account;

  std::string find_reason_for_stock() const
  {
    if (!system->has_pair_style()) return system->reason_of_pair_style();
    if (!LAMMPS_NS::utils::strmatch(this->update->integrate_style, "^verlet"))
      return "run_style is not verlet";
    if (this->fix_rigid && this->force->ftm2v != 1.0)
      return std::string("fix ") + this->fix_rigid->id +
             " moves rigid bodies, and the unit of force is not that of mass times acceleration";
    if (this->group->dynamic[this->igroup]) return "its group is dynamic";
    const std::string reason = reason_of_model(*this->model);
    return reason.empty() ? what_only_stock_does() : reason;
  }
};

}    // namespace Talus

#endif
