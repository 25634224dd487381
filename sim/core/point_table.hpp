// Points with declared fields, and lines through them: what walkers leave. Simulators or the program fill it, writers
// encode it.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace witherfield {

struct PointTable {
  enum class Digits { single, full, whole };  ///< float, double (times), 32-bit whole number
  struct Column {
    std::string name;  ///< a declared field of one component (sim/core/fields.hpp)
    Digits digits = Digits::single;
    std::vector<double> values;  ///< one per point
  };
  std::vector<glm::dvec3> position_m;
  std::vector<Column> columns;
  std::vector<std::size_t> line_ends;  ///< lines through the points in order: one past each line's last; none = points alone
};

}  // namespace witherfield
