// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A vehicle in MuJoCo (2.2 and later) for rover.py, which compiles this file and calls it through ctypes: the state of
// MuJoCo is in structures of C, which differ from version to version. One vehicle, on the rank on which the partner lives.
//
// All vectors are in the axes of the world; a state is that of talus.h: position 3, quaternion w x y z 4, velocity 3,
// angular velocity 3. A function returns nullptr, or why it could not do its work.

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace {

constexpr int state_size = 13, load_size = 6;

struct Delete {
  void operator()(mjModel *model) const { mj_deleteModel(model); }
  void operator()(mjData *data) const { mj_deleteData(data); }
};

std::unique_ptr<mjModel, Delete> model;
std::unique_ptr<mjData, Delete> data;
std::vector<int> wheels;    // bodies
std::string problem;

const char *said()
{
  return problem.empty() ? nullptr : problem.c_str();
}

// MuJoCo warns of states that are not finite and starts anew, and waits for a key after errors.
void note(const char *text)
{
  if (problem.empty()) problem = std::string("MuJoCo: ") + text;
}

void stop(const char *text)
{
  std::fprintf(stderr, "MuJoCo: %s\n", text);
  std::exit(1);
}

int body_named(const char *name)
{
  const int body = mj_name2id(model.get(), mjOBJ_BODY, name);
  if (body < 0) problem = std::string("the model has no body '") + name + "'";
  return body;
}

// Wheels are symmetrical, so that MuJoCo's velocity, of the center of mass, is that of the origin of the body.
void write_state(int body, double *state)
{
  mjtNum velocity[6];    // rotation first
  mj_objectVelocity(model.get(), data.get(), mjOBJ_BODY, body, velocity, 0);
  std::copy_n(data->xpos + 3 * body, 3, state);
  std::copy_n(data->xquat + 4 * body, 4, state + 3);
  std::copy_n(velocity + 3, 3, state + 7);
  std::copy_n(velocity, 3, state + 10);
}

}    // namespace

extern "C" {

/// Reads the model; its first body has a free joint, and its actuators hold the speed of wheels. `names`: bodies of
/// `count` wheels. `step`: time of vehicle_advance(). `mass`: of all bodies. `place`: of the first one.
const char *vehicle_open(const char *path, int count, const char *const *names, double step,
                         const double *place, double *mass)
{
  mju_user_warning = note;
  mju_user_error = stop;
  problem.clear();
  wheels.clear();
  char text[1000] = "";
  model.reset(mj_loadXML(path, nullptr, text, sizeof(text)));
  if (!model) {
    problem = text;
    return said();
  }
  model->opt.timestep = step;
  data.reset(mj_makeData(model.get()));
  for (int k = 0; k < count; k++) wheels.push_back(body_named(names[k]));
  *mass = 0.0;
  for (int body = 0; body < model->nbody; body++) *mass += model->body_mass[body];
  std::copy_n(place, 3, data->qpos);
  mj_step1(model.get(), data.get());
  return said();
}

/// State of any body, for instance of the chassis, whose velocity is that of its center of mass.
const char *vehicle_state(const char *name, double *state)
{
  const int body = body_named(name);
  if (body >= 0) write_state(body, state);
  return said();
}

/// One step, with the loads (force 3, torque about the center 3) on all wheels held, and motors that try to turn at
/// `omega`. `states`: of all wheels at its end.
const char *vehicle_advance(double omega, const double *loads, double *states)
{
  std::fill_n(data->ctrl, model->nu, omega);
  for (std::size_t k = 0; k < wheels.size(); k++)
    std::copy_n(loads + load_size * k, load_size, data->xfrc_applied + 6 * wheels[k]);
  mj_step2(model.get(), data.get());
  mj_step1(model.get(),
           data.get());    // begins the next step: places and velocities at the end of this one
  for (std::size_t k = 0; k < wheels.size(); k++) write_state(wheels[k], states + state_size * k);
  return said();
}
}
