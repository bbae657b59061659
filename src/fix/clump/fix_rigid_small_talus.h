/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix rigid/small with `-sf talus`: clumps, rigid sets of spheres, with words and results of the
   style of LAMMPS, to rounding

   Bodies, their migration, molecule templates, fix pour and deposit are those of the stock class.
   What differs is how a step is made:

     * Each rank that owns a sphere of a clump moves the whole clump: it receives the forces on the
       spheres that it does not own and sums all of them in the order of their IDs. So every
       rank has the same bits of a clump's state, whatever the decomposition is, and no state is
       sent. Ghosts must reach as far as clumps do: init() widens `comm_modify cutoff` if needed.
     * Mass, center, inertia and velocities are found from the spheres in the same order when a
       run begins. Clumps that are as the last run, or a restart file, has left them stay so with
       all bits; `reinit` concerns those that a command has moved in between, see keeps_states().
     * In the records, in steps that are not looked at, the kick that ends a step and the
       one that begins the next are made in one pass, with the same bits; see FixNVESphereTalus.
     * Restart files hold the state of each clump.

   Called by: Verlet::run() through Modify; migration and neighbor lists through Modify and Atom.
   Falls back to the methods of LAMMPS: reason_for_stock(). Errors: those of fix rigid/small.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(rigid/small/talus,FixRigidSmallTalus);
// clang-format on
#else

#ifndef LMP_FIX_RIGID_SMALL_TALUS_H
#define LMP_FIX_RIGID_SMALL_TALUS_H

#include "base/in_parallel.h"
#include "body/motion/clump_motion.h"
#include "fix/clump/clump_lanes.h"
#include "fix/clump/clump_table.h"
#include "fix_rigid_small.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixRigidSmallTalus : public FixRigidSmall, public Talus::SystemFix {
 public:
  FixRigidSmallTalus(class LAMMPS *, int, char **);
  ~FixRigidSmallTalus() override;
  void post_constructor() override;
  void init() override;
  void setup_pre_neighbor() override;
  void pre_neighbor() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void deform(int) override;

  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  // SystemFix
  std::string needs_arrays() override;
  std::string reason_for_stock() const override { return reason; }
  bool integrates() const override { return true; }
  Talus::Kicks kicks() const override { return {0.5, 0.5}; }
  bool places_particles() const override { return true; }
  bool moves_particle(int i) const override { return bodytag[i] != 0; }
  void complete_step() override;
  void leave_records() override;
  void exchange_state(Talus::StateExchange &x) override;
  bool exchanges_all() const override { return true; }

 protected:
  std::shared_ptr<Talus::GranularSystem> system;
  std::string reason = "no run yet";    // for the methods of LAMMPS

  // "", or what of the settings only the methods of LAMMPS do; collective
  virtual std::string find_reason();
  std::string reason_of_settings() const;
  // what a clump is made of may differ from what its spheres add up to
  virtual bool given_masses_stay() const { return false; }

  // of a clump in a step: the kick (time), what it adds to velocities by itself, and which part of
  // the step it is for virials; see place_spheres()
  struct Kick {
    double time;
    double gravity_kick[3];
    double share;
  };
  using Loads = Talus::ParticleState::Load;    // torque about the center of mass
  // ranks tell each other the forces on spheres of clumps that they share; collective
  void share_loads();
  // motion(state, loads), which returns that of the spheres, for all clumps of this rank at the
  // same time, if moves_in_lanes(); its spheres then get their places: eight clumps at a time
  template <class Motion> void move_in_lanes(Motion motion)
  {
    particles.records()->extrapolation = extrapolation;
    if (!lanes.are_current()) fill_lanes();
    Talus::in_ranges(lanes.num_groups(), threads(), [&](int, int begin, int end) {
      for (int g = begin; g < end; g++)
        lanes.move(
            table, *particles.records(), g, motion,
            [this](const ClumpSphere &s) { return load_of(s); },
            [this](const ClumpSphere &s) { return shift_of(s); });
    });
  }
  // of clumps whose spheres are in the records, where no more is asked for than such motions give
  bool moves_in_lanes() const;
  // what clumps did in the records since the bodies of the stock class were up to date
  void take_from_lanes();
  // work(clump, body) for all clumps of this rank at the same time, by one thread if virials are
  // tallied; body: its record
  template <class Work> void for_each_clump(Work work)
  {
    Talus::in_ranges(table.size(), evflag ? 1 : threads(), [&](int, int begin, int end) {
      for (int c = begin; c < end; c++) work(c, body[table.body[c]]);
    });
  }
  static Talus::ClumpState<double> state_of(const Body &b);
  static void put_state(const Talus::ClumpState<double> &s, Body &b);
  Loads load_of(const ClumpSphere &sphere) const;
  Loads loads_on(int clump, const Talus::ClumpState<double> &state) const;
  struct SphereVelocity {
    Talus::Vector3<double> v, omega;
  };
  // the spheres that this rank owns get this from the clump's state and their motion. Changes, of
  // those that get places, are those since `before`, of all spheres, or those that this makes
  enum class SphereUpdate { NOTHING, VELOCITIES, POSITIONS_AND_VELOCITIES };
  void place_spheres(int clump, const Talus::ClumpState<double> &state,
                     const Talus::SphereMotion<double> &motion, Body &b, SphereUpdate what,
                     const Kick &kick, const SphereVelocity *before = nullptr);
  // of the spheres of a clump between two steps
  virtual Talus::SphereMotion<double> sphere_motion_of(const Talus::ClumpState<double> &s) const
  {
    return s.sphere_motion();
  }
  // of the changes of velocities that this fix keeps, see RecordStep; before spheres are placed
  double extrapolation;
  // for Step::advance(), which moves none of the spheres
  Talus::RecordStep record_step(double kick) const;
  // before the first of these in a step: where its particles are
  void find_particles() { particles = system->step().particles(); }
  double force_unit() const;

 private:
  enum class Message { STOCK, MEMBERS, STATES, LOADS };
  Message message = Message::STOCK;

  ClumpTable table;
  ClumpLanes lanes;
  bool shares_clumps = false;         // some rank owns a part of a clump
  std::vector<tagint> ghost_clump;    // of ghosts: the body's ID, 0 if in none
  std::vector<double> ghost_rows;     // of ghosts: rows of what was sent last
  int row_size = 0;
  bool restored = false;        // from a restart file, and no run since
  bool states_known = false;    // the set-up has found clumps as the last run has left them

  Talus::ParticleState particles;    // see find_particles()
  bool kick_is_due = false;          // the one that ends the last step has been put off

  int threads() const;
  SphereVelocity velocity_of(const ClumpSphere &sphere) const;    // owned
  void keep_change(Talus::ChangeRecord &change, const ClumpSphere &sphere,
                   const SphereVelocity &old) const;
  std::string reason_of_spheres() const;
  tagint clump_of(int i) const;
  void write_row(int i, double *row) const;
  void write_state_row(int i, double *row) const;
  void exchange_rows(Message what, int size);
  const double *row_of(const ClumpSphere &sphere) const;

  template <class Exchange> void exchange_rows_of_particles(Exchange &x);
  void make_table();
  void fill_lanes();
  Talus::Vector3<double> shift_of(const ClumpSphere &sphere) const;
  void restore_bodies();
  void find_bodies();
  void find_body(int clump);
  static char **with_masses(LAMMPS *lmp, int narg, char **arg);
  void require_whole_clumps() const;
  bool keeps_states();
  bool is_kept(int clump) const;

  void begin_step();
  void end_step(int clump, Body &b, double share_of_virial);
  template <class Real> Talus::Vector3<Real> weight(Real mass) const
  {
    const Talus::Vector3<double> g{gvec[0], gvec[1], gvec[2]};
    return mass * Talus::in_all_lanes<Real>(g);
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
