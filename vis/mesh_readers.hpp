// The readers behind read_mesh_file, one for each kind of file. Each throws as it does.
#pragma once
#include "vis/mesh_files.hpp"

namespace witherfield::vis {

MeshFile read_obj(const std::filesystem::path& file);
MeshFile read_ply(const std::filesystem::path& file);
MeshFile read_off(const std::filesystem::path& file);
MeshFile read_stl(const std::filesystem::path& file);
MeshFile read_surface_vtp(const std::filesystem::path& file);

/// Words of the comment by which this project's OBJ and PLY files state their unit.
inline constexpr std::string_view kUnitComment = "length_unit mm";

}  // namespace witherfield::vis
