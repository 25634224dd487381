#include "vis/xml_document.hpp"

#include <bit>
#include <charconv>
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
    xml += "      <DataArray type=\"Float64\" Name=\"" + name + "\" NumberOfTuples=\"1\" format=\"ascii\">" +
           number_text(value) + "</DataArray>\n";
  for (const auto& [name, strings] : d.texts) {
    // VTK stores strings as the codes of their characters, each string ended by a zero.
    xml += "      <Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" + std::to_string(strings.size()) +
           "\" format=\"ascii\">";
    for (const std::string& s : strings) {
      for (unsigned char c : s) xml += std::to_string(int(c)) + " ";
      xml += "0 ";
    }
    xml += "</Array>\n";
  }
  return xml + "    </FieldData>\n";
}

std::string head(const XmlDocument& d) {
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + d.type +
                    "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"" +
                    compressor(d.compression) + "\">\n  <" + d.type + d.type_attributes + ">\n" + field_data(d) +
                    "    <Piece" + d.piece_attributes + ">\n";
  std::uint64_t offset = 0;
  for (const XmlSection& section : d.sections) {
    xml += "      <" + section.tag + ">\n";
    for (const XmlArray& a : section.arrays) {
      xml += "        <DataArray type=\"" + a.type + "\" Name=\"" + a.name + "\" NumberOfComponents=\"" +
             std::to_string(a.components) + "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
      offset += a.data.stored_bytes();
    }
    xml += "      </" + section.tag + ">\n";
  }
  return xml + "    </Piece>\n  </" + d.type + ">\n  <AppendedData encoding=\"raw\">\n   _";
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

std::string number_text(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x);
  return {text, end.ptr};
}

}  // namespace witherfield::vis
