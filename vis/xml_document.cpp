#include "vis/xml_document.hpp"

#include <fmt/format.h>

#include <bit>
#include <string>

#include "sim/core/fields.hpp"
#include "vis/atomic_file.hpp"

namespace witherfield::vis {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are declared little-endian");

const char* compressor(Compression c) {
  return c == Compression::lz4 ? "vtkLZ4DataCompressor" : "vtkZLibDataCompressor";
}

std::string field_data(const XmlDocument& d) {
  std::string xml = "    <FieldData>\n";
  for (const auto& [name, value] : d.numbers)
    xml += fmt::format(
        "      <DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" "
        "format=\"ascii\">{}</DataArray>\n",
        name, value);
  for (const auto& [name, strings] : d.texts) {
    xml += fmt::format("      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">",
                       name, strings.size());
    // VTK stores strings as the codes of their characters, each string ended by a zero.
    for (const std::string& s : strings) {
      for (unsigned char c : s) xml += fmt::format("{} ", int(c));
      xml += "0 ";
    }
    xml += "</Array>\n";
  }
  return xml + "    </FieldData>\n";
}

std::string head(const XmlDocument& d) {
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"{1}\">\n"
      "  <{0}{2}>\n{3}    <Piece{4}>\n",
      d.type, compressor(d.compression), d.type_attributes, field_data(d), d.piece_attributes);
  std::uint64_t offset = 0;
  for (const XmlSection& section : d.sections) {
    xml += fmt::format("      <{}{}>\n", section.tag, section.attributes);
    for (const XmlArray& a : section.arrays) {
      xml += fmt::format(
          "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
          "offset=\"{}\"/>\n",
          a.type, a.name, a.components, offset);
      offset += a.data.stored_bytes();
    }
    xml += fmt::format("      </{}>\n", section.tag);
  }
  return xml + fmt::format("    </Piece>\n  </{}>\n  <AppendedData encoding=\"raw\">\n   _", d.type);
}

}  // namespace

void add_stamp(XmlDocument& document, const Stamp& stamp) {
  document.numbers.emplace_back("TimeValue", stamp.time_days);
  document.numbers.emplace_back("wd", stamp.wd);
}

void add_units(XmlDocument& document, const std::string& length_unit) {
  document.texts.push_back({"length_unit", {length_unit}});
  std::vector<std::string> units;
  for (const XmlSection& section : document.sections)
    if (section.tag == "PointData" || section.tag == "CellData")
      for (const XmlArray& a : section.arrays)
        units.push_back(a.name + "=" + std::string(field_spec(a.name).unit));
  document.texts.push_back({"units", std::move(units)});
}

void write_xml_document(const std::filesystem::path& file, const XmlDocument& document) {
  AtomicFile out(file);
  out.write(head(document));
  for (const XmlSection& section : document.sections)
    for (const XmlArray& a : section.arrays) {
      const std::vector<std::uint64_t> header = a.data.header();
      out.write(header.data(), header.size() * sizeof(std::uint64_t));
      for (const Block& b : a.data.blocks) out.write(b->data(), b->size());
    }
  out.write("\n  </AppendedData>\n</VTKFile>\n");
  out.commit();
}

}  // namespace witherfield::vis
