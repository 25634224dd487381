#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include "bench/subdivision_peers.hpp"

namespace witherfield::bench {
namespace {

template <class Vector>
struct Traits : OpenMesh::DefaultTraits {
  using Point = Vector;
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};

template <class Vector>
class OpenMeshLoop : public LoopPeer {
 public:
  explicit OpenMeshLoop(const LoopInput& input) : steps_(input.steps) {
    using Real = typename Vector::value_type;
    for (const auto& p : input.position) control_.add_vertex({Real(p[0]), Real(p[1]), Real(p[2])});
    for (const auto& t : input.triangles)
      control_.add_face(control_.vertex_handle(unsigned(t[0])), control_.vertex_handle(unsigned(t[1])),
                        control_.vertex_handle(unsigned(t[2])));
  }
  void prepare() override {
    mesh_ = Mesh();
    mesh_ = control_;
  }
  void refine() override {
    OpenMesh::Subdivider::Uniform::LoopT<Mesh, typename Vector::value_type> loop;
    loop.attach(mesh_);
    loop(std::size_t(steps_));
    loop.detach();
  }
  LoopSums sums() const override {
    return sums_of(
        mesh_.n_vertices(), mesh_.n_faces(),
        [&](std::size_t v) {
          const auto& p = mesh_.point(mesh_.vertex_handle(unsigned(v)));
          return std::array<double, 3>{double(p[0]), double(p[1]), double(p[2])};
        },
        [&](std::size_t f) {
          const auto h = mesh_.halfedge_handle(mesh_.face_handle(unsigned(f)));
          const auto at = [&](auto half) { return std::size_t(mesh_.to_vertex_handle(half).idx()); };
          return std::array{at(h), at(mesh_.next_halfedge_handle(h)), at(mesh_.prev_halfedge_handle(h))};
        });
  }

 private:
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits<Vector>>;
  int steps_;
  Mesh control_, mesh_;
};

}  // namespace

std::unique_ptr<LoopPeer> openmesh_loop_float(const LoopInput& input) {
  return std::make_unique<OpenMeshLoop<OpenMesh::Vec3f>>(input);
}
std::unique_ptr<LoopPeer> openmesh_loop_double(const LoopInput& input) {
  return std::make_unique<OpenMeshLoop<OpenMesh::Vec3d>>(input);
}

}  // namespace witherfield::bench
