#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuVertexBuffer.h>

#include "bench/subdivision_peers.hpp"

namespace witherfield::bench {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

struct Point {
  float p[3];
  void Clear() { p[0] = p[1] = p[2] = 0; }
  void AddWithWeight(const Point& other, float w) {
    for (int a = 0; a < 3; ++a) p[a] += w * other.p[a];
  }
};

std::unique_ptr<Far::TopologyRefiner> refined_topology(const LoopInput& input) {
  const std::vector<int> three(input.triangles.size(), 3);
  const std::vector<float> edge_sharp(input.creases.size(), 10.f), vertex_sharp(input.corners.size(), 10.f);
  Far::TopologyDescriptor d;
  d.numVertices = int(input.position.size());
  d.numFaces = int(input.triangles.size());
  d.numVertsPerFace = three.data();
  d.vertIndicesPerFace = input.triangles[0].data();
  d.numCreases = int(input.creases.size());
  if (d.numCreases > 0) {
    d.creaseVertexIndexPairs = input.creases[0].data();
    d.creaseWeights = edge_sharp.data();
  }
  d.numCorners = int(input.corners.size());
  if (d.numCorners > 0) {
    d.cornerVertexIndices = input.corners.data();
    d.cornerWeights = vertex_sharp.data();
  }
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(d, Factory::Options(OpenSubdiv::Sdc::SCHEME_LOOP, OpenSubdiv::Sdc::Options())));
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(input.steps));
  return refiner;
}

class OpenSubdivLoop : public LoopPeer {
 public:
  explicit OpenSubdivLoop(const LoopInput& input) : input_(input) {}
  void prepare() override {
    refiner_.reset();
    points_.reset();
  }
  void refine() override {
    refiner_ = refined_topology(input_);
    points_ = std::make_unique_for_overwrite<Point[]>(std::size_t(refiner_->GetNumVerticesTotal()));
    static_assert(sizeof(Point) == sizeof input_.position[0]);
    std::copy(input_.position.begin(), input_.position.end(),
              reinterpret_cast<std::array<float, 3>*>(points_.get()));
    const Far::PrimvarRefiner values(*refiner_);
    const Point* from = points_.get();
    for (int k = 1; k <= input_.steps; ++k) {
      Point* to = const_cast<Point*>(from) + refiner_->GetLevel(k - 1).GetNumVertices();
      values.Interpolate(k, from, to);
      from = to;
    }
    last_ = from;
  }
  LoopSums sums() const override {
    const Far::TopologyLevel& level = refiner_->GetLevel(input_.steps);
    return sums_of(
        std::size_t(level.GetNumVertices()), std::size_t(level.GetNumFaces()),
        [&](std::size_t v) {
          return std::array<double, 3>{last_[v].p[0], last_[v].p[1], last_[v].p[2]};
        },
        [&](std::size_t f) {
          const auto t = level.GetFaceVertices(int(f));
          return std::array{std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])};
        });
  }

 private:
  LoopInput input_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::unique_ptr<Point[]> points_;
  const Point* last_ = nullptr;
};

}  // namespace

std::unique_ptr<LoopPeer> opensubdiv_loop(const LoopInput& input) {
  return std::make_unique<OpenSubdivLoop>(input);
}

struct OpenSubdivStencils::Impl {
  std::unique_ptr<const Far::StencilTable> table;
  std::unique_ptr<Osd::CpuVertexBuffer> control, refined;
};

OpenSubdivStencils::OpenSubdivStencils(const LoopInput& input) : impl_(std::make_unique<Impl>()) {
  const auto refiner = refined_topology(input);
  Far::StencilTableFactory::Options options;
  options.generateOffsets = true;
  options.generateIntermediateLevels = false;
  impl_->table.reset(Far::StencilTableFactory::Create(*refiner, options));
  impl_->control.reset(Osd::CpuVertexBuffer::Create(3, int(input.position.size())));
  impl_->refined.reset(Osd::CpuVertexBuffer::Create(3, impl_->table->GetNumStencils()));
}

OpenSubdivStencils::~OpenSubdivStencils() = default;

void OpenSubdivStencils::evaluate(const std::vector<std::array<float, 3>>& control) {
  const Osd::BufferDescriptor three(0, 3, 3);
  impl_->control->UpdateData(control[0].data(), 0, int(control.size()));
  Osd::CpuEvaluator::EvalStencils(impl_->control.get(), three, impl_->refined.get(), three,
                                  impl_->table.get());
}

double OpenSubdivStencils::mean_square() const {
  const std::size_t n = std::size_t(impl_->table->GetNumStencils());
  const float* p = impl_->refined->BindCpuBuffer();
  double sum = 0;
  for (std::size_t i = 0; i < 3 * n; ++i) sum += double(p[i]) * double(p[i]);
  return sum / double(n);
}

double OpenSubdivStencils::megabytes() const {
  return 1e-6 * (8.0 * double(impl_->table->GetControlIndices().size()) +
                 8.0 * double(impl_->table->GetNumStencils()));
}

}  // namespace witherfield::bench
