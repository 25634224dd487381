// PointTable -> VTK poly data and text. Files appear whole or not at all.
#pragma once
#include <filesystem>

#include "sim/core/point_table.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {

/// Points with their columns, metres: as vertices, or as lines when the table has some; and the same as text, one point a
/// line under a header "x_m,y_m,z_m,...". @throws InvalidInput (a column's length or name), IoFailure.
void write_table_vtp(const std::filesystem::path& file, const PointTable& table,
                     Compression compression = Compression::lz4);
void write_table_csv(const std::filesystem::path& file, const PointTable& table);

}  // namespace witherfield::vis
