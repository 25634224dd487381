// FloorField -> .vti: one layer of cells, metres.
#include <fmt/format.h>

#include <algorithm>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/core/parallel.hpp"
#include "vis/writers.hpp"
#include "vis/xml_document.hpp"

namespace witherfield::vis {

ValueRanges write_floor_vti(const std::filesystem::path& file, const FloorField& floor, const Stamp& stamp,
                            Compression compression) {
  floor.validate();
  XmlDocument document;
  document.type = "ImageData";
  const std::string extent = fmt::format("0 {} 0 {} 0 0", floor.nx, floor.ny);
  document.type_attributes = fmt::format(
      R"( WholeExtent="{0}" Origin="{1} {2} 0" Spacing="{3} {3} {3}" Direction="1 0 0 0 1 0 0 0 1")", extent,
      floor.origin_m.x, floor.origin_m.y, floor.spacing_m);
  document.piece_attributes = fmt::format(R"( Extent="{}")", extent);
  document.compression = compression;
  document.sections.push_back({"CellData", {}});
  ValueRanges ranges;
  for (const FloorChannel& channel : floor.channels) {
    std::vector<float> data(channel.values.size());
    parallel_for(data.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) data[i] = round_mantissa(channel.values[i]);
    });
    const auto [lo, hi] = std::minmax_element(data.begin(), data.end());
    ranges[channel.name] = {double(*lo), double(*hi)};
    document.sections.back().arrays.push_back({channel.name, "Float32", field_spec(channel.name).components,
                                               compress_bytes(std::as_bytes(std::span(data)), compression)});
  }
  add_stamp(document, stamp);
  add_units(document, "m");
  write_xml_document(file, document);
  return ranges;
}

}  // namespace witherfield::vis
