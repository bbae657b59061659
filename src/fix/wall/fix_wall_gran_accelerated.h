// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the accelerated variants of fix wall/gran and fix wall/gran/region share. They are the stock
// classes (command line, restart data, output), but their contacts are those of a large body with
// the law of the stock fix (BodyContacts): the numbers are those of the stock class but for
// rounding. Histories rest where those of all bodies do (ContactMemory). In restart files they are as
// the stock class writes and reads them, with its arrays: these hold them for as long as that takes,
// and in runs where that is not possible: then the methods of the stock class are used, with the
// reason in the log.

#ifndef TALUS_FIX_WALL_FIX_WALL_GRAN_ACCELERATED_H
#define TALUS_FIX_WALL_FIX_WALL_GRAN_ACCELERATED_H

#include "base/state_exchange.h"
#include "body/contact/body_contacts.h"
#include "fix/motion/plain_style.h"
#include "fix/wall/wall_law.h"
#include "system/host/restart_data.h"
#include "system/host/time_formula.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
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

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

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
    require_intact_particles(this->lmp);
    is_listed = false;
    stock_reason = find_reason_for_stock();
    if (!stock_reason.empty()) {
      fill_arrays();
      contacts.history.leave_memory();
      return;
    }
    wall_law.take(*this->model, this->atom->ntypes);
    contacts.set_laws(wall_law.laws());
    begin_run();
    contacts.history.keep_parts(surface().most_contacts() > 1);
    contacts.history.keep_records(std::max(wall_law.laws().history_records(), 1));
    if (this->use_history) take_arrays();
  }

  void setup_post_neighbor() override { is_listed = false; }
  void post_neighbor() override { is_listed = false; }

  void post_force(int vflag) override
  {
    for_outputs.forget();
    if (!stock_reason.empty()) {
      Stock::post_force(vflag);
      return;
    }
    place();
    list_if_needed();
    add_contacts();
    if (!this->peratom_flag || !system->step().may_be_asked()) return;
    this->clear_stored_contacts();
    for_outputs.for_each([this](const ContactReport &one) { keep_contact(one); });
  }

  double memory_usage() override
  {
    return Stock::memory_usage() + contacts.memory_usage() + for_outputs.memory_usage();
  }

  // Restart files
  int pack_restart(int i, double *buf) override
  {
    fill_row(i);
    const int size = Stock::pack_restart(i, buf) ? append_digest(buf) : 0;
    clear_row(i);
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
    fill_row(i);
    const int size = Stock::size_restart(i) + (this->use_history ? size_of_digest : 0);
    clear_row(i);
    return size;
  }
  int maxsize_restart() override
  {
    return Stock::maxsize_restart() + (this->use_history ? size_of_digest : 0);
  }

  // SystemFix
  std::string reason_for_stock() const override { return stock_reason; }
  void exchange_state(StateExchange &x) override
  {
    bool in_memory = contacts.history.has_memory();
    x(for_outputs, in_memory);
    if (in_memory)
      contacts.history.rest_in(system->memory(), ContactMemory::name_of(this->id));
    else
      contacts.history.leave_memory();
  }
  void state_is_restored() override { is_listed = false; }
  bool adds_forces() const override { return true; }
  bool is_touched() const override { return true; }
  /// Of a wall that is not accelerated there are none.
  void for_each_contact(const VisitContact &visit) const override { for_outputs.for_each(visit); }
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
  BodyContacts contacts;
  ComputedContacts for_outputs;
  WallLaw wall_law;

  /// Of these data of a particle in a restart file: what the stock class would write, -1 if it cannot be.
  virtual LAMMPS_NS::bigint stock_size(const double *data) const = 0;
  /// In its arrays, of an owned particle: number of contacts; of contact k the part that is touched, and its
  /// history; no contacts; a further one.
  virtual int count(int particle) const = 0;
  virtual int read(int particle, int k, HistoryValues &values) const = 0;
  virtual void clear(int particle) = 0;
  virtual void add(int particle, int part, const HistoryValues &values) = 0;
  /// In init(), if the run is accelerated.
  virtual void begin_run() = 0;
  /// Its surface; where it is in this step.
  virtual const LargeBodyShape &surface() const = 0;
  virtual void place() = 0;
  /// Which particles cannot touch it for a while is known.
  virtual bool is_bounded() const = 0;
  /// Particles are listed that may touch it as it is; and how far a point of it has gone at most since.
  virtual void are_listed(const ParticleState &particles) = 0;
  virtual double displacement() const = 0;
  /// "", or why the methods of the stock class are needed by this kind of wall.
  virtual std::string what_only_stock_does() const = 0;
  /// "", or what in this wall may read the arrays of LAMMPS in every step.
  virtual std::string what_reads_arrays() = 0;

  /// Radii may grow between two rebuilds.
  bool radii_vary() const
  {
    return this->atom->avec->size_forward > 3 || !this->modify->get_fix_by_style("^adapt").empty();
  }

 private:
  /// What the arrays have out of a restart file, or of a run of the stock class, is kept in the memory from here on.
  void take_arrays()
  {
    ContactMemory &memory = system->memory();
    memory.put_aside();
    contacts.history.rest_in(memory, ContactMemory::name_of(this->id));
    for (int i = 0; i < this->atom->nlocal; i++) {
      const int all = count(i);
      if (all)    // a restart file has them twice
        memory.lists_to_fill().remove_if(
            i, [this](const ContactLists::Contact &one) { return contacts.history.owns(one); });
      for (int k = 0; k < all; k++) {
        HistoryValues values{};
        const int part = read(i, k, values);
        contacts.history.add(memory.lists_to_fill(), i, part, {0.0, 0.0, 0.0}, values);
      }
      if (all) clear(i);
    }
  }
  void fill_arrays()
  {
    system->memory().put_aside();
    for (int i = 0; i < this->atom->nlocal; i++) fill_row(i);
  }
  void fill_row(int i)
  {
    if (!contacts.history.has_memory()) return;
    system->memory().lists().for_each(i, [&](const ContactLists::Contact &one) {
      if (contacts.history.owns(one))
        add(i, static_cast<int>(one.feature), BodyHistory::values_of(one));
    });
  }
  /// Of what fill_row() has filled.
  void clear_row(int i)
  {
    if (contacts.history.has_memory()) clear(i);
  }

  /// Particles and wall together may go as far as the skin.
  bool is_stale(double moved) const
  {
    return !is_listed || this->atom->nlocal != owned_then ||
           (is_bounded() && !(moved + moved_then + displacement() <= this->neighbor->skin));
  }
  void list_if_needed()
  {
    const bool bounded = is_bounded();
    if (!is_stale(bounded ? system->step().moved_at_most() : 0.0)) return;
    const double moved = bounded ? system->step().moved_since_rebuild() : 0.0;
    if (is_stale(moved)) list(moved);
  }
  void list(double moved)
  {
    constexpr double anywhere = 1.0e100;
    const ParticleState particles = system->step().particles();
    contacts.find_candidates(surface(), at_rest, particles, this->atom->mask, this->groupbit,
                             is_bounded() ? this->neighbor->skin : anywhere, this->comm->nthreads);
    find_masses();
    are_listed(particles);
    is_listed = true;
    owned_then = this->atom->nlocal;
    moved_then = moved;
  }
  /// As LAMMPS has them here: those of bodies, but neither converted nor infinite.
  void find_masses()
  {
    masses.clear();
    if (!system->masses().needed()) return;
    for (int i = 0; i < this->atom->nlocal; i++) masses.push_back(system->masses().of_body(i));
  }

  BodyHeat heat()
  {
    if (!this->heat_flag) return {};
    if (this->tstr) this->Twall = this->input->variable->compute_equal(this->tvar);
    return {this->atom->temperature, this->Twall, this->atom->heatflow};
  }
  /// As in LAMMPS, histories stand still while a run is set up, but what slips is set back; and where there
  /// may be several contacts none lasts beyond zero overlap.
  void add_contacts()
  {
    constexpr std::size_t worth_a_thread = 100;    // candidates
    const bool accounts = system->account().is_asked();
    WorkAccount account;
    if (accounts) account = system->account().part_of_step();
    BodyStep step;
    step.dt = this->update->setupflag ? 0.0 : this->update->dt;
    step.threads = static_cast<int>(std::clamp<std::size_t>(
        contacts.num_candidates() / worth_a_thread, 1, this->comm->nthreads));
    step.account = accounts ? &account : nullptr;
    step.ends_at_zero_overlap = surface().most_contacts() > 1;
    step.masses = masses.empty() ? nullptr : masses.data();
    step.heat = heat();
    if (system->step().may_be_asked()) step.for_outputs = &for_outputs;
    contacts.compute(surface(), at_rest, system->step().particles(), step);
    if (accounts) system->account().add(account.sum);
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

  const BodyFrame at_rest{};
  const char *plain_style;
  std::string stock_reason;
  bool is_listed = false;
  int owned_then = 0;    // when particles were listed
  double moved_then = 0.0;
  std::vector<double> masses;    // by particle, or empty

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
