// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Triangles of an STL file, binary or ASCII.

#ifndef TALUS_BODY_SHAPE_STL_FILE_H
#define TALUS_BODY_SHAPE_STL_FILE_H

#include "body/shape/large_body_shape.h"

#include <string>
#include <vector>

namespace Talus {

/// Reads the content of a file (all its bytes). A file is binary if its length is that which the
/// count after the 80 bytes of header demands, otherwise ASCII if it begins with `solid`. Normals
/// in the file are not used: the order of the corners decides. Throws std::runtime_error with a
/// text that names the triangle (from 1) or the line, and the cause, if the content is empty,
/// truncated, no STL, holds a coordinate that is not a finite number, or no triangle.
std::vector<Triangle> parse_stl(const std::string &content);

}    // namespace Talus

#endif
