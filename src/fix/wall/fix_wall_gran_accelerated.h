// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the accelerated variants of fix wall/gran and fix wall/gran/region share. They are the stock
// classes (command line, restart data, output), but their contacts are those of a body with the law of
// the stock fix (HostWall): the numbers are those of the stock class but for rounding. In restart
// files histories are as the stock class writes and reads them, with its arrays: these hold them for
// as long as that takes, and in runs where that is not possible: then the methods of the stock class
// are used, with the reason in the log.

#ifndef TALUS_FIX_WALL_FIX_WALL_GRAN_ACCELERATED_H
#define TALUS_FIX_WALL_FIX_WALL_GRAN_ACCELERATED_H

#include "base/state_exchange.h"
#include "fix/motion/plain_style.h"
#include "fix/wall/wall_law.h"
#include "system/bodies/host_wall.h"
#include "system/host/restart_data.h"
#include "system/host/time_formula.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "atom_vec.h"
#include "fix.h"
#include "force.h"
#include "gran_sub_mod.h"
#include "granular_model.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <algorithm>
#include <memory>
#include <string>

namespace Talus {

/// Stock: FixWallGran or a class derived from it.
template <class Stock>
class AcceleratedWall : public Stock, public SystemFix, private HostWall::Arrays {
 public:
  /// `plain`: name of the style without suffix.
  AcceleratedWall(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, const char *plain) :
      Stock(lmp, narg, arg), system(GranularSystem::of(lmp)), wall(this, *this, *system, lmp),
      plain_style(plain)
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
    require_intact_particles(this->lmp);
    stock_reason = find_reason_for_stock();
    if (!stock_reason.empty()) {
      wall.leave_run();
      return;
    }
    wall_law.take(*this->model, this->atom->ntypes);
    const LargeBodyShape &surface = begin_run();
    wall.begin_run(wall_law.laws(), surface, is_bounded() && !radii_vary(), this->use_history);
  }

  void setup_post_neighbor() override { wall.forget_list(); }
  void post_neighbor() override { wall.forget_list(); }

  void post_force(int vflag) override
  {
    wall.begin_step(this->peratom_flag != 0);
    if (!stock_reason.empty()) {
      Stock::post_force(vflag);
      return;
    }
    place();
    if (wall.list_if_needed(displacement())) are_listed();
    wall.compute(heat());
    if (!this->peratom_flag || !system->step().may_be_asked()) return;
    this->clear_stored_contacts();
    wall.for_each_contact([this](const ContactReport &one) { keep_contact(one); });
  }

  double memory_usage() override { return Stock::memory_usage() + wall.memory_usage(); }

  // Restart files
  int pack_restart(int i, double *buf) override
  {
    wall.fill_row(i);
    const int size = Stock::pack_restart(i, buf) ? append_digest(buf) : 0;
    wall.clear_row(i);
    return size;
  }
  void unpack_restart(int i, int nth) override
  {
    if (this->use_history &&
        !stock_particle_data(this->lmp, std::string("Fix ") + plain_style + " " + this->id, i, nth,
                             [this](const double *data) { return stock_size(data); }))
      return;
    Stock::unpack_restart(i, nth);
  }
  int size_restart(int i) override
  {
    wall.fill_row(i);
    const int size = Stock::size_restart(i) + (this->use_history ? size_of_digest : 0);
    wall.clear_row(i);
    return size;
  }
  int maxsize_restart() override
  {
    return Stock::maxsize_restart() + (this->use_history ? size_of_digest : 0);
  }

  // SystemFix
  std::string reason_for_stock() const override { return stock_reason; }
  void exchange_state(StateExchange &x) override { wall.exchange_state(x); }
  void state_is_restored() override { wall.forget_list(); }
  bool adds_forces() const override { return true; }
  bool is_touched() const override { return true; }
  /// Of a wall that is not accelerated there are none.
  void for_each_contact(const VisitContact &visit) const override { wall.for_each_contact(visit); }
  std::string needs_arrays() override
  {
    if (!stock_reason.empty()) return stock_reason;
    if (this->heat_flag && this->tstr && !reads_only_time(this->lmp, this->tstr))
      return std::string("variable ") + this->tstr + " reads more than time";
    if (wall_law.law().has_friction() && !system->pipeline().keeps_omega())
      return "it exerts torques and the contacts between particles do not";
    return what_reads_arrays();
  }

 protected:
  std::shared_ptr<GranularSystem> system;
  HostWall wall;
  WallLaw wall_law;

  /// Of these data of a particle in a restart file: what the stock class would write, -1 if it cannot be.
  virtual LAMMPS_NS::bigint stock_size(const double *data) const = 0;
  /// In init(), if the run is accelerated: its surface.
  virtual const LargeBodyShape &begin_run() = 0;
  /// Where it is in this step.
  virtual void place() = 0;
  /// As long as radii do not grow: which particles cannot touch it for a while is known.
  virtual bool is_bounded() const { return true; }
  /// Particles are listed that may touch it as it is; and how far a point of it has gone at most since.
  virtual void are_listed() = 0;
  virtual double displacement() const = 0;
  /// "", or why the methods of the stock class are needed by this kind of wall.
  virtual std::string what_only_stock_does() const = 0;
  /// "", or what in this wall may read the arrays of LAMMPS in every step.
  virtual std::string what_reads_arrays() = 0;

 private:
  /// Radii may grow between two rebuilds.
  bool radii_vary() const
  {
    return this->atom->avec->size_forward > 3 || !this->modify->get_fix_by_style("^adapt").empty();
  }

  BodyHeat heat()
  {
    if (!this->heat_flag) return {};
    if (this->tstr) this->Twall = this->input->variable->compute_equal(this->tvar);
    return {this->atom->temperature, this->Twall, this->atom->heatflow};
  }
  /// Row of a particle in the output by particle: force, contact point, radius, heat flow.
  void keep_contact(const ContactReport &one)
  {
    double *row = this->array_atom[one.i];
    const Vector3<double> &force = one.force, point = one.center[0] + one.arm[0];
    const double values[8] = {1.0,     force.x, force.y, force.z,
                              point.x, point.y, point.z, this->atom->radius[one.i]};
    std::copy(values, values + 8, row);
    if (this->size_peratom_cols > 8) row[8] = one.heat_flow;
  }

  const char *plain_style;
  std::string stock_reason;

  std::string find_reason_for_stock() const
  {
    if (!system->pair_style().is_there()) return system->pair_style().reason_against();
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
