// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/body/large_body_shapes.h"

#include "body/motion/body_state.h"
#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/custom_shape.h"
#include "body/shape/frustum.h"
#include "body/shape/plane.h"
#include "body/shape/rectangle.h"
#include "system/regions/region_shape.h"

#include "system/host/shared_file.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "platform.h"
#include "region.h"
#include "utils.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

/// Of a library without the function of this version: was it built with that of another one?
std::string why_no_shape(void *library)
{
  for (int version = 1; version < 100; version++)
    if (platform::dlsym(library, make_shape_name(version)))
      return fmt::format("was built with version {} of custom_shape.h, this Talus has version {}: "
                         "compile it anew",
                         version, shape_version);
  return fmt::format("has no function {}: see custom_shape.h", make_shape_name(shape_version));
}

}    // namespace

std::unique_ptr<LargeBodyShape> LargeBodyShapes::parse(bool two_sided)
{
  using Solid = Shape (LargeBodyShapes::*)();
  static const std::vector<std::string> shapes = {
      "plane", "rectangle", "mesh", "box", "sphere", "cylinder", "cone", "region", "custom"};
  static const Solid solids[] = {&LargeBodyShapes::box,      &LargeBodyShapes::ball,
                                 &LargeBodyShapes::cylinder, &LargeBodyShapes::cone,
                                 &LargeBodyShapes::region,   &LargeBodyShapes::custom};
  const int which = words.choice("shape", shapes);
  words.about(shapes[which]);
  switch (which) {
  case 0:
    return plane(two_sided);
  case 1:
    return rectangle(two_sided);
  case 2:
    return mesh(two_sided);
  default:
    if (two_sided) words.fail(1, "two-sided is for plane, rectangle and mesh");
    return (this->*solids[which - 3])();
  }
}

Talus::PeriodicEdges LargeBodyShapes::periodic_edges() const
{
  Talus::PeriodicEdges edges;
  if (domain->triclinic) return edges;
  edges.box = {Eigen::Vector3d(domain->boxlo), Eigen::Vector3d(domain->boxhi)};
  for (int d = 0; d < 3; d++) edges.periodic[d] = domain->periodicity[d] != 0;
  return edges;
}

/* A piece of this length along an axis of the box that is as long as the box, which is periodic
   there, goes on behind both faces, further than particles go between two rebuilds. */

double LargeBodyShapes::continued(double length, const Vector3<double> &center,
                                  const Vector3<double> &direction) const
{
  constexpr double behind = 0.1;    // over the length, at each end
  const double along[3] = {direction.x, direction.y, direction.z},
               middle[3] = {center.x, center.y, center.z};
  const PeriodicEdges edges = periodic_edges();
  for (int d = 0; d < 3; d++) {
    if (!edges.periodic[d] || std::fabs(along[d]) < 1.0 - 1.0e-9) continue;
    const double allowed = PeriodicEdges::usual_tolerance * domain->prd[d];
    if (std::fabs(middle[d] - 0.5 * length - domain->boxlo[d]) <= allowed &&
        std::fabs(middle[d] + 0.5 * length - domain->boxhi[d]) <= allowed)
      return (1.0 + 2.0 * behind) * length;
  }
  return length;
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
  double lu = words.positive("edge length lu"), lv = words.positive("edge length lv");

  // the part of the edge that lies in the plane, so that users need not orthogonalise
  const Vector3<double> inside = edge - dot(edge, normal) * normal;
  const double length = std::sqrt(dot(inside, inside));
  if (length < 1.0e-6) words.fail(5, "first edge is parallel to the normal");
  const Vector3<double> first = 1.0 / length * inside;
  lu = continued(lu, center, first);
  lv = continued(lv, center, cross(normal, first));
  return std::make_unique<Rectangle>(center, normal, first, lu, lv, two_sided);
}

bool LargeBodyShapes::parse_inside()
{
  return words.choice("side", {"inside", "outside"}) == 0;
}

LargeBodyShapes::Side LargeBodyShapes::parse_side()
{
  return static_cast<Side>(words.choice("side", {"inside", "outside", "open"}));
}

LargeBodyShapes::Shape LargeBodyShapes::box()
{
  const Vector3<double> center = words.vector("center (cx cy cz)");
  const double lx = words.positive("edge length lx"), ly = words.positive("edge length ly"),
               lz = words.positive("edge length lz");
  const bool inside = parse_inside();
  Vector3<double> edges{lx, ly, lz};
  if (!inside)
    edges = {continued(lx, center, {1.0, 0.0, 0.0}), continued(ly, center, {0.0, 1.0, 0.0}),
             continued(lz, center, {0.0, 0.0, 1.0})};
  return std::make_unique<Box>(center, edges, inside);
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
  double length =
      words.take("INF") ? std::numeric_limits<double>::infinity() : words.positive("length l");
  const Side side = parse_side();
  if (side != Side::INSIDE) length = continued(length, center, axis);
  return std::make_unique<Frustum>(center, axis, radius, radius, length, side == Side::INSIDE,
                                   side == Side::OPEN);
}

LargeBodyShapes::Shape LargeBodyShapes::cone()
{
  const Vector3<double> center = words.vector("center (cx cy cz)");
  const Vector3<double> axis = words.direction("axis (ax ay az)");
  const double low = words.number("radius r1"), high = words.number("radius r2");
  if (low < 0.0 || high < 0.0 || low + high == 0.0)
    words.fail(2, "radii must not be negative, and one of them must be positive");
  const double length = words.positive("length l");
  const Side side = parse_side();
  return std::make_unique<Frustum>(center, axis, low, high, length, side == Side::INSIDE,
                                   side == Side::OPEN);
}

StlContent LargeBodyShapes::stl(const std::string &file)
{
  StlContent content;
  try {
    content = parse_stl(read_everywhere(lmp, words, file));
  } catch (const std::runtime_error &problem) {
    words.fail(1, "'" + file + "': " + problem.what());
  }
  if (content.trailing_bytes && comm->me == 0)
    error->warning(
        FLERR,
        "fix large/body mesh '{}': {} bytes behind the last of the {} triangles that the "
        "file announces are not read",
        file, content.trailing_bytes, content.triangles.size());
  return content;
}

LargeBodyShapes::Shape LargeBodyShapes::mesh(bool two_sided)
{
  const std::string file = words.text("file");
  const int file_word = words.index();
  StlContent content = stl(file);
  std::vector<Triangle> &soup = content.triangles;

  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3<double> shift{0.0, 0.0, 0.0};
  std::string side = two_sided ? "two-sided" : "";
  std::optional<double> tolerance;
  for (bool more = true; more;) {    // scaled, then turned, then shifted, in whatever order given
    if (words.take("scale")) {
      scale = words.positive("scale s");
    } else if (words.take("translate")) {
      shift = words.vector("translate x y z");
    } else if (words.take("rotate")) {
      const double angle = words.number("rotate theta");
      const Vector3<double> axis = words.direction("rotate axis (ax ay az)");
      rotation =
          Eigen::AngleAxisd(angle * std::acos(-1.0) / 180.0, to_eigen(axis)).toRotationMatrix();
    } else if (words.take("tolerance")) {
      tolerance = words.not_negative("tolerance d");
    } else {
      more = take_side(side);
    }
  }
  for (Triangle &t : soup)
    for (Vector3<double> &p : t.corner) p = rotated(rotation, scale * p) + shift;

  std::unique_ptr<MeshShape> shape;
  try {
    const bool orient = side != "one-sided";
    TriangleMesh surface =
        tolerance ? TriangleMesh(soup, orient, *tolerance) : TriangleMesh(soup, orient);
    surface.continue_behind(periodic_edges());
    const MeshSide acting = side == "one-sided" ? MeshSide::NORMALS : MeshSide::BOTH;
    shape = std::make_unique<MeshShape>(std::move(surface), acting, true);
  } catch (const std::runtime_error &problem) {
    words.fail(words.index() - file_word + 1, "'" + file + "': " + problem.what());
  }
  shape->set_name(file);
  const MeshReport &report = shape->surface().report();
  const int back = words.index() - file_word + 1;
  if (report.inconsistent_edges && side == "one-sided")
    words.fail(back,
               fmt::format("'{}': {} edges lie between triangles that face opposite sides, the "
                           "first at triangle {}: leave out one-sided, or repair the file",
                           file, report.inconsistent_edges, report.first_inconsistent));
  const bool has_inside = report.closed();
  if (!has_inside && (side == "inside" || side == "outside"))
    words.fail(back,
               fmt::format("'{}' is not closed, so that nothing is {} of it ({}): leave the word "
                           "out, or use one-sided",
                           file, side, what_is_open(report)));
  if (has_inside && side.empty()) shape->set_side(MeshSide::UNDECIDED);
  if (side == "inside" || side == "outside") shape->set_side(shape->side_within(side == "inside"));
  tell(*shape, side);
  return shape;
}

bool LargeBodyShapes::take_side(std::string &side)
{
  for (const char *word : {"one-sided", "two-sided", "inside", "outside"}) {
    if (!words.take(word)) continue;
    if (!side.empty() && side != word) words.fail(1, "is " + side + " already");
    side = word;
    return true;
  }
  return false;
}

std::string LargeBodyShapes::what_is_open(const MeshReport &r)
{
  if (r.open_edges) return fmt::format("{} open edges", r.open_edges);
  if (r.nonmanifold_edges)
    return fmt::format("{} edges of more than two triangles", r.nonmanifold_edges);
  return fmt::format("{} edges whose triangles face opposite sides", r.inconsistent_edges);
}

/* What was found in the file, and on which side the mesh acts. */

void LargeBodyShapes::tell(const MeshShape &shape, const std::string &side)
{
  if (comm->me) return;
  const TriangleMesh &surface = shape.surface();
  const MeshReport &r = surface.report();
  const auto warn = [&](int count, int first, const char *what) {
    if (count)
      error->warning(FLERR, "fix large/body mesh '{}': {} {}; the first is triangle {}",
                     shape.name(), count, what, first);
  };
  warn(r.degenerate, r.first_degenerate, "triangles without area are left out");
  warn(r.duplicate, r.first_duplicate, "triangles that are there already are left out");
  warn(r.nonmanifold_edges, r.first_nonmanifold, "edges belong to more than two triangles");
  std::string text = r.closed() ? fmt::format("closed, volume {:.6g}", std::fabs(surface.volume()))
                                : what_is_open(r);
  if (r.repaired_edges)
    text += fmt::format(", triangles turned at {} edges where neighbors faced opposite sides",
                        r.repaired_edges);
  if (r.joined_corners)
    text += fmt::format(", {} corners joined that are up to {:.2g} apart", r.joined_corners,
                        r.largest_gap);
  if (r.divided_edges)
    text += fmt::format(", triangles divided at {} edges on which corners of others lie (first: "
                        "triangle {})",
                        r.divided_edges, r.first_divided);
  static const char *const acts[] = {"on the side of its normals", "on the side behind its normals",
                                     "on both sides", "on the side where particles are"};
  const std::string where = side == "inside" || side == "outside"
                                ? "on particles " + side + " of it"
                                : acts[static_cast<int>(shape.side())];
  utils::logmesg(lmp,
                 "fix large/body mesh '{}': {} triangles, {}, acts {}; {:.3g} MB on each rank and "
                 "more where particles are\n",
                 shape.name(), surface.num_own(), text, where, shape.memory_usage() / 1048576.0);
}

LargeBodyShapes::Shape LargeBodyShapes::region()
{
  const std::string id = words.text("region-ID");
  Region *region = domain->get_region_by_id(id);
  if (!region) words.fail(1, "region '" + id + "' does not exist");
  const std::string refusal = RegionShape::refusal(*region, false);
  if (!refusal.empty()) words.fail(1, refusal);
  region->init();
  region->prematch();
  return std::make_unique<RegionShape>(RegionShape::MovedBy::BODY, *region, *domain);
}

LargeBodyShapes::Shape LargeBodyShapes::custom()
{
  const std::string file = words.text("shared library");
  const int count = words.integer("number of arguments", 0);
  std::vector<std::string> texts;
  for (int k = 0; k < count; k++) texts.push_back(words.text("argument"));
  std::vector<const char *> arguments;
  for (const std::string &text : texts) arguments.push_back(text.c_str());
  // stays open: shapes made by it may outlive this command
  void *library = platform::dlopen(file);
  if (!library) words.fail(count + 2, "cannot open '" + file + "': " + platform::dlerror());
  auto make =
      reinterpret_cast<MakeShapeFunction>(platform::dlsym(library, make_shape_name(shape_version)));
  if (!make) words.fail(count + 2, "'" + file + "' " + why_no_shape(library));
  char problem[256] = "";
  Shape shape(make(count, arguments.data(), problem, sizeof problem));
  if (!shape) words.fail(count + 2, "'" + file + "': " + problem);
  return shape;
}
