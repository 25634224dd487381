// Triangle meshes from and to files: OBJ, PLY (text and binary, both byte orders), OFF, STL (text and binary)
// and VTP are read; OBJ, PLY and VTP are written. Files written here are in millimetres and say so. Nothing
// is printed.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "sim/core/surface.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {

struct MeshFile {
  Surface surface;
  /// Unit of length that the file states ("mm" or "m"); "" when it states none: then its numbers stand in
  /// position_m as they are.
  std::string length_unit;
};

/// The kind of file is taken from the extension (.obj .ply .off .stl .vtp, any case).
/// Polygons become fans about their first corner, in order; negative OBJ indices count from the end;
/// triangles of STL are joined where corners are equal to the last bit. Normals and texture coordinates are
/// kept where every vertex has a single one; arrays of PLY and VTP whose names are declared fields become
/// fields, red, green and blue of PLY become `diffuse` when there is no such field.
/// @throws InvalidInput naming file, place (line, byte or element) and fault: truncated, not a number, NaN or
/// infinite, index out of range, face with fewer than three corners, no faces, not a file of its kind.
/// @throws IoFailure when the file cannot be opened or read.
MeshFile read_mesh_file(const std::filesystem::path& file);
Surface read_mesh(const std::filesystem::path& file);

/// Text, millimetres, v / vt / vn / f. Positions are shortest decimals: read_mesh gives the same bits.
/// @throws InvalidInput when the surface is not valid; IoFailure naming the file; then nothing is left of it.
void write_obj(const std::filesystem::path& file, const Surface& surface);

/// Binary, little-endian, millimetres as float32: x y z, nx ny nz, u v, red green blue (uchar, encoded sRGB
/// of the field `diffuse`), then every field under its own name (several components: name_x, name_y, name_z)
/// as float32; fields of faces follow the corners of each face. Positions read back equal as float32
/// millimetres.
/// @throws as write_obj.
void write_ply(const std::filesystem::path& file, const Surface& surface);

/// Polys with `normal` (as Normals), `uv` (as TCoords, when there is one) and all fields; length_unit is "mm"
/// or "m" (of the numbers in the file). Positions and uv float32, labels Int32, other fields float32 rounded
/// to 10 bits of mantissa, as everywhere in the project's VTK files. Returns the ranges of the arrays as
/// written. @throws as write_obj.
ValueRanges write_surface_vtp(const std::filesystem::path& file, const Surface& surface, const Stamp& stamp,
                              std::string_view length_unit = "mm",
                              Compression compression = Compression::lz4);

}  // namespace witherfield::vis
