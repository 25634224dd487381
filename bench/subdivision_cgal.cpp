#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include "bench/subdivision_peers.hpp"

namespace witherfield::bench {
namespace {

template <class Real>
class CgalLoop : public LoopPeer {
 public:
  explicit CgalLoop(const LoopInput& input) : steps_(input.steps) {
    for (const auto& p : input.position) control_.add_vertex({Real(p[0]), Real(p[1]), Real(p[2])});
    for (const auto& t : input.triangles)
      control_.add_face(Vertex(unsigned(t[0])), Vertex(unsigned(t[1])), Vertex(unsigned(t[2])));
  }
  void prepare() override {
    mesh_ = Mesh();
    mesh_ = control_;
  }
  void refine() override {
    CGAL::Subdivision_method_3::Loop_subdivision(mesh_,
                                                 CGAL::parameters::number_of_iterations(unsigned(steps_)));
  }
  LoopSums sums() const override {
    return sums_of(
        mesh_.number_of_vertices(), mesh_.number_of_faces(),
        [&](std::size_t v) {
          const auto& p = mesh_.point(Vertex(unsigned(v)));
          return std::array<double, 3>{double(p.x()), double(p.y()), double(p.z())};
        },
        [&](std::size_t f) {
          const auto h = mesh_.halfedge(typename Mesh::Face_index(unsigned(f)));
          return std::array<std::size_t, 3>{mesh_.source(h), mesh_.target(h), mesh_.target(mesh_.next(h))};
        });
  }

 private:
  using Mesh = CGAL::Surface_mesh<typename CGAL::Simple_cartesian<Real>::Point_3>;
  using Vertex = typename Mesh::Vertex_index;
  int steps_;
  Mesh control_, mesh_;
};

}  // namespace

std::unique_ptr<LoopPeer> cgal_loop_float(const LoopInput& input) {
  return std::make_unique<CgalLoop<float>>(input);
}
std::unique_ptr<LoopPeer> cgal_loop_double(const LoopInput& input) {
  return std::make_unique<CgalLoop<double>>(input);
}

}  // namespace witherfield::bench
