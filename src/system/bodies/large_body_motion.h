// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The motion of a large body: its state from step to step, as BodyMotionSpec says.

#ifndef TALUS_SYSTEM_BODIES_LARGE_BODY_MOTION_H
#define TALUS_SYSTEM_BODIES_LARGE_BODY_MOTION_H

#include "body/contact/body_load.h"
#include "body/motion/body_state.h"
#include "body/motion/external_motion.h"
#include "body/motion/servo_response.h"
#include "body/shape/mesh_shape.h"
#include "system/bodies/body_motion_spec.h"

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {
class Region;
}

namespace Talus {

class LargeBodyMotion : protected LAMMPS_NS::Pointers {
 public:
  using Kind = BodyMotionSpec::Kind;

  /// A mesh whose vertices move is told so; `shape` must live as long as this.
  LargeBodyMotion(LAMMPS_NS::LAMMPS *lmp, const BodyMotionSpec &spec, LargeBodyShape &shape);

  /// Of a body whose shape is a region: it goes where the region goes, or stays if that stays. At
  /// the beginning of each run, after init(), because regions may be defined again. `reference`: of
  /// the shape. Must not be called if there is a motion of its own.
  void follow(LAMMPS_NS::Region &region, const Vector3<double> &reference);
  /// Has one of the words move and servo.
  bool has_own() const { return kind != Kind::NONE && kind != Kind::REGION; }

  /// The body as contacts see it; changes with place() and advance().
  const BodyFrame &frame() const { return now; }
  bool moves() const { return kind != Kind::NONE; }
  /// Its vertices move: see LargeBodyVertices.
  bool deforms() const { return kind == Kind::VERTICES; }
  /// A function of time, so that steps must be counted without a gap.
  bool depends_on_time() const { return kind == Kind::PRESCRIBED || kind == Kind::VARIABLE; }
  /// Variables are evaluated in every step that may read particles.
  bool asks_variables() const;
  /// The load of a step is needed for the next one.
  bool driven_by_load() const { return kind == Kind::FREE || kind == Kind::SERVO; }

  /// At the start of a run: finds variables.
  void init();
  /// Before the first forces of a run: the state at this step.
  void place();
  /// To this step from the one before. `load`: of all ranks, at the step before, if driven by it.
  /// `lag`: time by which the velocities of particles are behind now, with integrators of second
  /// order, else 0. With those velocities of free and servo bodies are behind as well.
  void advance(const BodyLoad &load, double lag);

  /// Kinetic energy and that in the field of gravity of a free body, otherwise 0.
  double energy() const;

  /// `fix_modify ID state ...`: the state, and in how many steps; ends in an error of LAMMPS where
  /// these are none. `words`: how many of them were read.
  BodyState state_from(int narg, char **arg, int &words, int &steps) const;
  /// Of an external body: it is to have this state in so many steps, 0: at once. `way`: how far at most
  /// the body may go in a step; `reach`: how far from the reference point its particles are. Returns
  /// "", or why not.
  std::string guide(const BodyState &target, int steps, double way, double reach);

  Kind kind_of_motion() const { return kind; }
  template <class Exchange> void exchange_state(Exchange &x)
  {
    x(now.state, now.velocity_change, now.omega_change, clock, region_angle, external, response,
      half_way, present, behind, servo_rate);
    if (!x.restores()) return;
    now.set(now.state);
    show_kinematics();
  }

 private:
  void evaluate_state();
  void evaluate_region(double dt);
  void move(const BodyLoad &load, double lag);
  void move_free(BodyState &state, const BodyLoad &load, double lag);
  void aim_servo();
  void move_servo(BodyState &state, const BodyLoad &load, double lag);
  void find_kinematics(const BodyState &old, double lag);
  void stand_still();
  void show_kinematics();

  BodyMotionSpec given;
  Kind kind;                    // of a region that may change between runs
  MeshShape *mesh = nullptr;    // if its vertices move
  BodyFrame now;
  MotionClock clock;
  LAMMPS_NS::Region *region = nullptr;    // that the body follows, from init() on
  double region_angle = 0.0;              // at the state that `now` has
  ExternalMotion external;
  ServoResponse response;
  // of the last step, with integrators of second order: see BodyFrame, and advance()
  BodyState half_way, present;
  double behind = 0.0, servo_rate = 0.0;
};

}    // namespace Talus

#endif
