// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a script describes a shape: `type N NAME ARGS keyword value ...` of fix shape/gran. NAME finds a
// ShapeWord, which reads ARGS; then keywords come in any order, those of the description and those of all
// shapes (density, orient); then the shape is made.

#ifndef TALUS_SHAPE_SHAPE_DESCRIPTION_H
#define TALUS_SHAPE_SHAPE_DESCRIPTION_H

#include "base/words.h"
#include "shape/shape.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Talus {

class ShapeDescription {
 public:
  virtual ~ShapeDescription() = default;

  /// Keywords that may follow, and what reads the values of one; what is wrong ends in Words::fail().
  virtual std::vector<std::string> keywords() const { return {}; }
  virtual void read(const std::string &keyword, Words &words)
  {
    (void) keyword;
    (void) words;
  }
  /// Called when all has been read. Throws std::runtime_error with a text that says what is wrong.
  virtual std::shared_ptr<const Shape> make() const = 0;
};

struct ShapeReader {
  Words &words;    ///< behind NAME
  /// The content of a file, the same on all ranks; one that cannot be read ends in Words::fail().
  std::function<std::string(const std::string &name)> read_file;
};

struct ShapeWord {
  std::string name;
  std::unique_ptr<ShapeDescription> (*read)(const ShapeReader &reader);
};

/// Of a shape without keywords of its own, which `make_shape` makes from ARGS.
template <std::shared_ptr<const Shape> (*make_shape)(const ShapeReader &)>
ShapeWord plain_shape(const std::string &name)
{
  class Plain : public ShapeDescription {
   public:
    explicit Plain(std::shared_ptr<const Shape> made) : shape(std::move(made)) {}
    std::shared_ptr<const Shape> make() const override { return shape; }

   private:
    std::shared_ptr<const Shape> shape;
  };
  return {name, [](const ShapeReader &reader) -> std::unique_ptr<ShapeDescription> {
            return std::make_unique<Plain>(make_shape(reader));
          }};
}

}    // namespace Talus

#endif
