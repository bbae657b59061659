// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_shapes.h"

#include "body/motion/body_state.h"
#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/custom_shape.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/plane.h"
#include "body/shape/rectangle.h"
#include "body/shape/stl_file.h"
#include "fix/region_shape.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "platform.h"
#include "region.h"
#include "utils.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

std::unique_ptr<LargeBodyShape> LargeBodyShapes::parse(bool two_sided)
{
  if (words.at_end()) error->all(FLERR, "fix large/body: missing shape: {}", known);
  const std::string shape = words.text("shape");
  words.about(shape);
  if (shape == "plane") return plane(two_sided);
  if (shape == "rectangle") return rectangle(two_sided);
  if (shape == "mesh") return mesh(two_sided);
  const bool is_solid = shape == "box" || shape == "sphere" || shape == "cylinder" ||
                        shape == "cone" || shape == "region" || shape == "custom";
  if (!is_solid)
    error->all(FLERR, 3, "fix large/body: unknown shape '{}', expected {}", shape, known);
  if (two_sided) words.fail(1, "two-sided is for plane, rectangle and mesh");
  if (shape == "box") return box();
  if (shape == "sphere") return ball();
  if (shape == "cylinder") return cylinder();
  if (shape == "cone") return cone();
  if (shape == "region") return region();
  return custom();
}

LargeBodyShapes::Shape LargeBodyShapes::plane(bool two_sided)
{
  const Vector3<double> point = words.vector("point (px py pz)");
  return std::make_unique<Plane>(point, words.direction("normal (nx ny nz)"), two_sided);
}

LargeBodyShapes::Shape LargeBodyShapes::rectangle(bool two_sided)
{
  const Vector3<double> center = words.vector("center (px py pz)");
  const Vector3<double> normal = words.direction("normal (nx ny nz)");
  const Vector3<double> edge = words.direction("first edge (ux uy uz)");
  const double lu = words.number("edge length lu"), lv = words.number("edge length lv");
  if (!(lu > 0.0) || !(lv > 0.0)) words.fail(2, "edge lengths must be positive");

  // the part of the edge that lies in the plane, so that users need not orthogonalise
  const Vector3<double> inside = edge - dot(edge, normal) * normal;
  const double length = std::sqrt(dot(inside, inside));
  if (length < 1.0e-6) words.fail(5, "first edge is parallel to the normal");
  return std::make_unique<Rectangle>(center, normal, 1.0 / length * inside, lu, lv, two_sided);
}

bool LargeBodyShapes::parse_inside()
{
  const std::string side = words.text("inside or outside");
  if (side != "inside" && side != "outside")
    words.fail(1, "expected inside or outside instead of '" + side + "'");
  return side == "inside";
}

LargeBodyShapes::Shape LargeBodyShapes::box()
{
  const Vector3<double> center = words.vector("center (cx cy cz)");
  const double lx = words.positive("edge length lx"), ly = words.positive("edge length ly"),
               lz = words.positive("edge length lz");
  return std::make_unique<Box>(center, Vector3<double>{lx, ly, lz}, parse_inside());
}

LargeBodyShapes::Shape LargeBodyShapes::ball()
{
  const Vector3<double> center = words.vector("center (cx cy cz)");
  const double radius = words.positive("radius r");
  return std::make_unique<Ball>(center, radius, parse_inside());
}

LargeBodyShapes::Shape LargeBodyShapes::cylinder()
{
  const Vector3<double> center = words.vector("center (cx cy cz)");
  const Vector3<double> axis = words.direction("axis (ax ay az)");
  const double radius = words.positive("radius r");
  const double length =
      words.take("INF") ? std::numeric_limits<double>::infinity() : words.positive("length l");
  return std::make_unique<Frustum>(center, axis, radius, radius, length, parse_inside());
}

LargeBodyShapes::Shape LargeBodyShapes::cone()
{
  const Vector3<double> center = words.vector("center (cx cy cz)");
  const Vector3<double> axis = words.direction("axis (ax ay az)");
  const double low = words.number("radius r1"), high = words.number("radius r2");
  if (low < 0.0 || high < 0.0 || low + high == 0.0)
    words.fail(2, "radii must not be negative, and one of them must be positive");
  const double length = words.positive("length l");
  return std::make_unique<Frustum>(center, axis, low, high, length, parse_inside());
}

/* Rank 0 reads, so that the file need not be visible elsewhere. */

std::string LargeBodyShapes::read_everywhere(const std::string &file)
{
  std::string content;
  long long size = -1;
  if (comm->me == 0) {
    if (FILE *fp = std::fopen(file.c_str(), "rb")) {
      char block[1 << 16];
      std::size_t got;
      while ((got = std::fread(block, 1, sizeof block, fp)) > 0) content.append(block, got);
      size = std::ferror(fp) ? -1 : static_cast<long long>(content.size());
      std::fclose(fp);
    }
  }
  MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, world);
  if (size < 0) words.fail(1, "cannot read the file '" + file + "'");
  if (size > MAXSMALLINT) words.fail(1, "the file '" + file + "' is larger than 2 GB");
  content.resize(size);
  MPI_Bcast(&content[0], static_cast<int>(size), MPI_CHAR, 0, world);
  return content;
}

LargeBodyShapes::Shape LargeBodyShapes::mesh(bool two_sided)
{
  const std::string file = words.text("file");
  const int file_word = words.next;
  std::vector<Triangle> soup;
  try {
    soup = parse_stl(read_everywhere(file));
  } catch (const std::runtime_error &problem) {
    words.fail(1, "'" + file + "': " + problem.what());
  }

  double scale = 1.0;
  Rotation turn;
  Vector3<double> shift{0.0, 0.0, 0.0};
  for (bool more = true; more;) {    // scaled, then turned, then shifted, in whatever order given
    if (words.take("scale")) {
      scale = words.positive("scale s");
    } else if (words.take("translate")) {
      shift = words.vector("translate x y z");
    } else if (words.take("rotate")) {
      const double angle = words.number("rotate theta");
      const Vector3<double> axis = words.direction("rotate axis (ax ay az)");
      turn = Rotation(Quaternion::turn(angle * std::acos(-1.0) / 180.0, axis));
    } else {
      more = false;
    }
  }
  for (Triangle &t : soup)
    for (Vector3<double> &p : t.corner) p = turn.to_space(scale * p) + shift;

  std::unique_ptr<MeshShape> shape;
  try {
    shape = std::make_unique<MeshShape>(TriangleMesh(soup), two_sided, true);
  } catch (const std::runtime_error &problem) {
    words.fail(words.next - file_word + 1, "'" + file + "': " + problem.what());
  }

  const TriangleMesh &surface = shape->surface();
  const MeshReport &r = surface.report();
  const auto warn = [&](int count, int first, const char *what) {
    if (count && comm->me == 0)
      error->warning(FLERR, "fix large/body mesh '{}': {} {}; the first is triangle {}", file,
                     count, what, first);
  };
  if (r.turned_edges && !two_sided)
    words.fail(
        words.next - file_word + 1,
        fmt::format("'{}': {} edges lie between triangles that face opposite sides, the first "
                    "at triangle {}: repair the file, or use two-sided",
                    file, r.turned_edges, r.first_turned));
  warn(r.degenerate, r.first_degenerate, "triangles without area are left out");
  warn(r.duplicate, r.first_duplicate, "triangles that are there already are left out");
  warn(r.crowded_edges, r.first_crowded, "edges belong to more than two triangles");
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "fix large/body mesh '{}': {} triangles, {}, {:.3g} MB on each rank "
                   "and more where particles are\n",
                   file, surface.size(),
                   r.closed() ? fmt::format("closed, volume {:.6g}", surface.volume())
                              : fmt::format("{} open edges", r.open_edges),
                   shape->memory_usage() / 1048576.0);
  return shape;
}

LargeBodyShapes::Shape LargeBodyShapes::region()
{
  const std::string id = words.text("region-ID");
  Region *its = domain->get_region_by_id(id);
  if (!its) words.fail(1, "region '" + id + "' does not exist");
  if (its->dynamic_check() || its->varshape)
    words.fail(1, "region '" + id + "' moves or changes: use move of this fix instead");
  its->init();
  its->prematch();
  return std::make_unique<RegionShape>(its, id.c_str());
}

LargeBodyShapes::Shape LargeBodyShapes::custom()
{
  const std::string file = words.text("shared library");
  const int count = words.integer("number of arguments", 0);
  std::vector<const char *> arguments;
  for (int k = 0; k < count; k++) {
    words.text("argument");
    arguments.push_back(words.arg[words.next - 1]);
  }
  // stays open: shapes made by it may outlive this command
  void *library = platform::dlopen(file);
  if (!library) words.fail(count + 2, "cannot open '" + file + "': " + platform::dlerror());
  auto make = reinterpret_cast<MakeShapeFunction>(platform::dlsym(library, TALUS_MAKE_SHAPE_NAME));
  if (!make)
    words.fail(count + 2,
               "'" + file + "' has no function " + TALUS_MAKE_SHAPE_NAME + ": see custom_shape.h");
  char problem[256] = "";
  Shape shape(make(count, arguments.data(), problem, sizeof problem));
  if (!shape) words.fail(count + 2, "'" + file + "': " + problem);
  return shape;
}
