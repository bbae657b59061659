// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/convex_words.h"

#include "shape/convex/convex_shape.h"

#include <stdexcept>

namespace Talus {
namespace {

class ConvexDescription : public ShapeDescription {
 public:
  std::vector<std::string> keywords() const override { return {"rounded", "scale"}; }
  void read(const std::string &keyword, Words &words) override
  {
    if (keyword == "rounded")
      radius = words.not_negative("rounded r");
    else
      read_scale(words);
  }

 protected:
  virtual void read_scale(Words &words) { scale = words.positive("scale s"); }

  double radius = 0.0, scale = 1.0;
};

class BoxDescription : public ConvexDescription {
 public:
  explicit BoxDescription(const ShapeReader &from)
  {
    edges = {from.words.positive("box a"), from.words.positive("box b"),
             from.words.positive("box c")};
  }
  std::shared_ptr<const Shape> make() const override
  {
    return std::make_shared<ConvexShape>(ConvexShape::box(edges, radius));
  }

 private:
  void read_scale(Words &words) override { words.fail(1, "scale is for polyhedron and vertices"); }

  Vector3<double> edges;
};

class PolyhedronDescription : public ConvexDescription {
 public:
  explicit PolyhedronDescription(const ShapeReader &from) :
      file(from.words.text("an STL file")), content(from.read_file(file))
  {
  }
  std::shared_ptr<const Shape> make() const override
  {
    try {
      return std::make_shared<ConvexShape>(ConvexShape::stl(content, scale, radius));
    } catch (const std::runtime_error &problem) {
      throw std::runtime_error("'" + file + "': " + problem.what());
    }
  }

 private:
  std::string file, content;
};

class VerticesDescription : public ConvexDescription {
 public:
  explicit VerticesDescription(const ShapeReader &from)
  {
    const int count = from.words.integer("number of vertices", 4);
    for (int n = 0; n < count; n++) vertices.push_back(from.words.vector("vertex x y z"));
  }
  std::shared_ptr<const Shape> make() const override
  {
    std::vector<Vector3<double>> scaled;
    for (const Vector3<double> &v : vertices) scaled.push_back(scale * v);
    return std::make_shared<ConvexShape>(ConvexShape::polyhedron(scaled, radius));
  }

 private:
  std::vector<Vector3<double>> vertices;
};

template <class Description> std::unique_ptr<ShapeDescription> read(const ShapeReader &from)
{
  return std::make_unique<Description>(from);
}

}    // namespace

std::vector<ShapeWord> convex_words()
{
  return {{"box", read<BoxDescription>},
          {"polyhedron", read<PolyhedronDescription>},
          {"vertices", read<VerticesDescription>}};
}

}    // namespace Talus
