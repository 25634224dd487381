// VTK XML files ("serial" .vti and .vtp) with appended raw data, as written by this project. No VTK involved.
// Format: VTK file formats (VTK User's Guide, "XML file formats"): version 1.0, header_type UInt64,
// little-endian.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "vis/block_codec.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {

struct XmlArray {
  std::string name;
  std::string type;  ///< "Float32", "Int32", "UInt8"
  int components = 1;
  CompressedBytes data;
};

/// PointData, CellData, Points, Verts, Polys ... with their arrays.
struct XmlSection {
  std::string tag;
  std::vector<XmlArray> arrays;
  std::string attributes = {};  ///< such as which array holds the normals: R"( Normals="normal")"
};

struct XmlDocument {
  std::string type;             ///< "ImageData" or "PolyData"
  std::string type_attributes;  ///< of the data set element
  std::string piece_attributes;
  Compression compression = Compression::lz4;
  std::vector<std::pair<std::string, double>> numbers;  ///< FieldData, Float64, one value each
  std::vector<std::pair<std::string, std::vector<std::string>>> texts;  ///< FieldData, strings
  std::vector<XmlSection> sections;
};

/// FieldData that every file of a series carries: TimeValue and wd; then length_unit and units ("name=unit"
/// of each array of the document that has been declared in sim/core/fields.hpp). Call when all sections are
/// there.
void add_stamp(XmlDocument& document, const Stamp& stamp);
void add_units(XmlDocument& document, const std::string& length_unit);

/// @throws IoFailure naming the file; then nothing is left of it.
void write_xml_document(const std::filesystem::path& file, const XmlDocument& document);

}  // namespace witherfield::vis
