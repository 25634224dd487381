#include "vis/dataset.hpp"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSet.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <exception>

#include "sim/core/errors.hpp"
#include "vis/vtk_messages.hpp"

namespace witherfield::vis {
namespace {

vtkSmartPointer<vtkXMLReader> reader_for(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw IoFailure(fmt::format("cannot read '{}': no such file", file.string()));
  vtkSmartPointer<vtkXMLReader> reader;
  if (file.extension() == ".vti") reader = vtkSmartPointer<vtkXMLImageDataReader>::New();
  if (file.extension() == ".vtp") reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
  if (!reader)
    throw IoFailure(fmt::format("cannot read '{}': expected a .vti or a .vtp file", file.string()));
  if (!reader->CanReadFile(file.c_str()))
    throw IoFailure(
        fmt::format("cannot read '{}': not a VTK XML file of the kind its name says", file.string()));
  reader->SetFileName(file.c_str());
  return reader;
}

/// Runs a step of a reader; every complaint of VTK, and every exception, becomes an IoFailure.
template <class Step>
void guarded(const std::filesystem::path& file, vtkXMLReader& reader, Step&& step) {
  std::string reason;
  {
    const VtkMessages messages;
    try {
      step();
    } catch (const std::exception& e) {
      reason = e.what();
    }
    if (messages.has_error()) reason = messages.first_error();
  }
  if (reason.empty() && reader.GetErrorCode() != vtkErrorCode::NoError)
    reason = vtkErrorCode::GetStringFromErrorCode(reader.GetErrorCode());
  if (!reason.empty())
    throw IoFailure(fmt::format("cannot read '{}': damaged file ({})", file.string(), reason));
}

std::vector<std::string> names(vtkDataArraySelection& selection) {
  std::vector<std::string> out;
  for (int i = 0; i < selection.GetNumberOfArrays(); ++i) out.emplace_back(selection.GetArrayName(i));
  return out;
}

void read_field_data(vtkFieldData& fields, Dataset& out) {
  if (auto* time = fields.GetArray("TimeValue"); time && time->GetNumberOfTuples() > 0) {
    out.has_time = true;
    out.time_days = time->GetComponent(0, 0);
  }
  if (auto* wd = fields.GetArray("wd"); wd && wd->GetNumberOfTuples() > 0) {
    out.has_wd = true;
    out.wd = wd->GetComponent(0, 0);
  }
  if (auto* unit = vtkStringArray::SafeDownCast(fields.GetAbstractArray("length_unit"));
      unit && unit->GetNumberOfValues() > 0)
    out.length_unit = unit->GetValue(0);
  if (auto* units = vtkStringArray::SafeDownCast(fields.GetAbstractArray("units")))
    for (vtkIdType i = 0; i < units->GetNumberOfValues(); ++i) {
      const std::string entry = units->GetValue(i);
      const auto equals = entry.find('=');
      if (equals != std::string::npos) out.units[entry.substr(0, equals)] = entry.substr(equals + 1);
    }
}

}  // namespace

DatasetNames dataset_names(const std::filesystem::path& file) {
  const vtkSmartPointer<vtkXMLReader> reader = reader_for(file);
  guarded(file, *reader, [&] { reader->UpdateInformation(); });
  return {file.extension() == ".vti", names(*reader->GetPointDataArraySelection()),
          names(*reader->GetCellDataArraySelection())};
}

Dataset read_dataset(const std::filesystem::path& file, const std::vector<std::string>& arrays) {
  const vtkSmartPointer<vtkXMLReader> reader = reader_for(file);
  guarded(file, *reader, [&] {
    reader->UpdateInformation();
    for (vtkDataArraySelection* s :
         {reader->GetPointDataArraySelection(), reader->GetCellDataArraySelection()}) {
      s->DisableAllArrays();
      for (const std::string& name : arrays)
        if (s->ArrayExists(name.c_str())) s->EnableArray(name.c_str());
    }
    reader->Update();
  });
  auto* output = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  if (!output) throw IoFailure(fmt::format("cannot read '{}': it holds no data set", file.string()));
  // The caller's own object, free of the reader and its copies.
  Dataset out;
  out.data = {output->NewInstance(), [](vtkDataSet* d) { d->Delete(); }};
  out.data->ShallowCopy(output);
  read_field_data(*out.data->GetFieldData(), out);
  return out;
}

}  // namespace witherfield::vis
