#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkLoopSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "bench/subdivision_peers.hpp"

namespace witherfield::bench {
namespace {

class VtkLoop : public LoopPeer {
 public:
  explicit VtkLoop(const LoopInput& input) : steps_(input.steps) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    for (const auto& p : input.position) points->InsertNextPoint(p.data());
    for (const auto& t : input.triangles) {
      const vtkIdType corners[3] = {t[0], t[1], t[2]};
      cells->InsertNextCell(3, corners);
    }
    control_->SetPoints(points);
    control_->SetPolys(cells);
  }
  void prepare() override {
    filter_ = vtkSmartPointer<vtkLoopSubdivisionFilter>::New();
    filter_->SetInputData(control_);
    filter_->SetNumberOfSubdivisions(steps_);
  }
  void refine() override { filter_->Update(); }
  LoopSums sums() const override {
    vtkPolyData* out = filter_->GetOutput();
    vtkNew<vtkIdList> corners;
    return sums_of(
        std::size_t(out->GetNumberOfPoints()), std::size_t(out->GetNumberOfPolys()),
        [&](std::size_t v) {
          std::array<double, 3> p;
          out->GetPoint(vtkIdType(v), p.data());
          return p;
        },
        [&](std::size_t f) {
          out->GetPolys()->GetCellAtId(vtkIdType(f), corners);
          return std::array{std::size_t(corners->GetId(0)), std::size_t(corners->GetId(1)),
                            std::size_t(corners->GetId(2))};
        });
  }

 private:
  int steps_;
  vtkNew<vtkPolyData> control_;
  vtkSmartPointer<vtkLoopSubdivisionFilter> filter_;
};

}  // namespace

std::unique_ptr<LoopPeer> vtk_loop(const LoopInput& input) {
  return std::make_unique<VtkLoop>(input);
}

}  // namespace witherfield::bench
