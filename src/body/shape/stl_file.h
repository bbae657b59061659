// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Triangles of an STL file, binary or ASCII.

#ifndef TALUS_BODY_SHAPE_STL_FILE_H
#define TALUS_BODY_SHAPE_STL_FILE_H

#include "body/shape/large_body_shape.h"

#include <string>
#include <vector>

namespace Talus {

struct StlContent {
  std::vector<Triangle> triangles;
  std::size_t trailing_bytes = 0;    ///< of a binary file, behind its triangles; not read
};

/// Reads the content of a file (all its bytes), in any locale. A file is binary if its length is
/// that which the count after the 80 bytes of header demands; otherwise ASCII if it is text that
/// begins with `solid`, in upper or lower case, perhaps after comments (from a # to the end of the
/// line); otherwise binary with bytes after the last triangle. Normals in the file are not used: the
/// order of the corners decides. Throws std::runtime_error with a text that names the triangle (from
/// 1) or the line, and the cause, if the content is empty, truncated, no STL, holds a coordinate that
/// is not a finite number, or no triangle.
StlContent parse_stl(const std::string &content);

}    // namespace Talus

#endif
