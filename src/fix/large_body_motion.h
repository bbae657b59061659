// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a large body moves: the words `move`, `servo`, `gravity` and `load` of fix large/body, and
// the state of the body from step to step. Everything that a restart needs is in to_array().

#ifndef TALUS_FIX_LARGE_BODY_MOTION_H
#define TALUS_FIX_LARGE_BODY_MOTION_H

#include "base/state_exchange.h"
#include "base/words.h"
#include "body/contact/body_load.h"
#include "body/motion/body_state.h"
#include "body/motion/external_motion.h"
#include "body/motion/prescribed_motion.h"
#include "body/motion/rigid_body.h"
#include "body/motion/servo_response.h"
#include "body/shape/mesh_shape.h"
#include "fix/constant_gravity.h"
#include "lmptype.h"
#include "system/region_handle.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class Region;

class LargeBodyMotion : protected Pointers {
 public:
  explicit LargeBodyMotion(LAMMPS *lmp);

  /// One of move, servo, gravity, load, surface_velocity with its arguments, if that is the next
  /// word.
  bool parse(Talus::Words &words);
  /// After all words: checks that they go together, and with the shape.
  void finish(Talus::LargeBodyShape &shape);

  /// Of a body whose shape is a region: it goes where the region goes, or stays if that stays. At
  /// the beginning of each run, after init(), because regions may be defined again. `reference`: of
  /// the shape. Must not be called if there is a motion of its own.
  void follow(Region &region, const Talus::Vector3<double> &reference);
  /// Has one of the words move and servo.
  bool has_own() const { return kind != Kind::NONE && kind != Kind::REGION; }

  /// The body as contacts see it; changes with place() and advance().
  const Talus::BodyFrame &frame() const { return now; }
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
  void advance(const Talus::BodyLoad &load, double lag);

  /// Kinetic energy and that in the field of gravity of a free body, otherwise 0.
  double energy() const;

  /// `fix_modify ID state ...`: the state, and in how many steps; ends in an error of LAMMPS where
  /// these are none. `words`: how many of them were read.
  Talus::BodyState state_from(int narg, char **arg, int &words, int &steps) const;
  /// Of an external body: it is to have this state in so many steps, 0: at once. `way`: how far at most
  /// the body may go in a step; `reach`: how far from the reference point its particles are. Returns
  /// "", or why not.
  std::string guide(const Talus::BodyState &target, int steps, double way, double reach);

  /// kind, state, clock, guide; lag, rate of a servo and what contacts of second order see
  static constexpr int size_restart = 1 + 3 * Talus::BodyState::size + 3 +
                                      Talus::ExternalMotion::size + 2 + Talus::ServoResponse::size;
  void to_array(double *a) const;
  void exchange_state(Talus::StateExchange &x);
  /// False if the motion was of another kind: the body then begins where its words put it.
  bool from_array(const double *a);

 private:
  enum class Kind { NONE, PRESCRIBED, VARIABLE, EXTERNAL, FREE, SERVO, REGION, VERTICES };
  /// A number or an equal-style variable.
  struct Quantity {
    double value = 0.0;
    std::string name;
  };
  void parse_move(Talus::Words &words);
  void parse_variable(Talus::Words &words);
  void parse_free(Talus::Words &words);
  void parse_servo(Talus::Words &words);
  Quantity quantity(Talus::Words &words, const char *name);
  int find(const Quantity &q) const;
  double evaluate(const Quantity &q);
  void evaluate_state();
  void evaluate_region(double dt);
  void move(const Talus::BodyLoad &load, double lag);
  void move_free(Talus::BodyState &state, const Talus::BodyLoad &load, double lag);
  void move_servo(Talus::BodyState &state, const Talus::BodyLoad &load, double lag);
  void find_kinematics(const Talus::BodyState &old, double lag);
  void stand_still();
  void show_kinematics();

  Kind kind = Kind::NONE;
  Talus::MeshShape *mesh = nullptr;    // if its vertices move
  Talus::BodyFrame now;
  Talus::MotionClock clock;
  std::unique_ptr<Talus::PrescribedMotion> prescribed;
  Quantity path[8];    // displacement, velocity, angle, angular velocity
  Talus::Vector3<double> angle_axis{0.0, 0.0, 1.0};
  Talus::RegionHandle region;    // that the body follows
  double region_angle = 0.0;     // at the state that `now` has
  Talus::ExternalMotion external;
  Talus::RigidBody rigid;
  Talus::Servo servo;
  Talus::ServoResponse response;
  Talus::BodyState initial;    // velocities of a free body
  // of the last step, with integrators of second order: see BodyFrame, and advance()
  Talus::BodyState half_way, present;
  double behind = 0.0, servo_rate = 0.0;
  std::unique_ptr<Talus::Vector3<double>> center_of_mass;
  ConstantGravity gravity;
  bool has_load = false;
  Quantity given_load[6];
};

}    // namespace LAMMPS_NS

#endif
