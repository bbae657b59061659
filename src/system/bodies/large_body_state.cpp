// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A large body in snapshots and restart files.

#include "system/bodies/large_body.h"

#include "base/state_exchange.h"
#include "base/state_numbers.h"

namespace Talus {

/* Local indices of what was seen may be others. */

void LargeBody::exchange_state(StateExchange &x)
{
  finish_reduction();
  body_motion.exchange_state(x);
  if (moved_vertices) moved_vertices->exchange_state(x);
  side.exchange_state(x);
  body_surface->exchange_state(x);
  x(mine, total, reduced, total_is_known, exact, has_forces, dissipated, last_dissipated, impulses,
    for_outputs);
  x.array(digits_here, size_digits);
  x.array(digits_of_all, size_digits);
  if (!x.restores()) return;
  contacts.forget_deepest();
  seen_between = {};
}

/* ---- restart files: side, kind of motion and motion, vertices, what triangles have borne; each with its size before it,
   for the command that reads them may be another one ---- */

namespace {

template <class Write> void write_part(std::vector<double> &all, Write write)
{
  const std::size_t begin = all.size();
  all.push_back(0.0);
  StateNumbers numbers(all);
  write(numbers);
  all[begin] = static_cast<double>(all.size() - begin - 1);
}

/* read(numbers) is not called where a part is empty. */

template <class Read> void read_part(const double *&at, const double *end, Read read)
{
  if (at == end) return;
  const double *const begin = at + 1;
  if (!(*at >= 0.0) || *at > static_cast<double>(end - begin)) return;
  at = begin + static_cast<std::ptrdiff_t>(*at);
  if (begin == at) return;
  StateNumbers numbers(begin, at);
  read(numbers);
}

}    // namespace

std::vector<double> LargeBody::state_of_all_ranks()
{
  if (moved_vertices) moved_vertices->collect_sums();
  if (body_surface->records()) body_surface->reduce();
  std::vector<double> all;
  write_part(all, [this](StateNumbers &x) { side.exchange_state(x); });
  write_part(all, [this](StateNumbers &x) {
    LargeBodyMotion::Kind kind = body_motion.kind_of_motion();
    x(kind);
    body_motion.exchange_state(x);
  });
  write_part(all, [this](StateNumbers &x) {
    if (moved_vertices) moved_vertices->exchange_state(x);
  });
  write_part(all, [this](StateNumbers &x) {
    if (body_surface->records()) body_surface->exchange_state(x);
  });
  return all;
}

LargeBody::RestartProblem LargeBody::restart_from(const double *begin, const double *end)
{
  RestartProblem problem;
  const double *at = begin;
  read_part(at, end, [this](StateNumbers &x) { side.exchange_state(x); });
  bool same_motion = false;
  read_part(at, end, [&](StateNumbers &x) {
    LargeBodyMotion::Kind kind{};
    x(kind);
    same_motion = kind == body_motion.kind_of_motion();
    if (same_motion) body_motion.exchange_state(x);
  });
  if (!same_motion)
    problem.warning = "the restart file has another kind of motion: the body begins where this "
                      "command puts it";
  read_part(at, end, [&](StateNumbers &x) {
    if (!same_motion || !moved_vertices) return;
    moved_vertices->exchange_state(x);
    if (!x.fits() || !moved_vertices->take_over_sums())
      problem.error = "the mesh of the restart file had another number of vertices: use the same "
                      "file and words";
  });
  bool has_sums = false;
  read_part(at, end, [&](StateNumbers &x) {
    if (!body_surface->records()) return;
    body_surface->exchange_state(x);
    has_sums = body_surface->take_over_sums();
  });
  if (body_surface->records() && !has_sums)
    problem.warning += std::string(problem.warning.empty() ? "" : "; ") +
                       "the restart file has no shear work of these triangles: it begins at zero";
  return problem;
}

}    // namespace Talus
