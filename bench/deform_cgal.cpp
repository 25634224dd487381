#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <stdexcept>

#include "bench/deform_peers.hpp"

namespace witherfield::bench {
namespace {

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Vertex = Mesh::Vertex_index;

Mesh mesh_of(const DeformInput& input) {
  Mesh mesh;
  for (const glm::dvec3& p : input.position) mesh.add_vertex({p.x, p.y, p.z});
  for (const auto& t : input.triangles) mesh.add_face(Vertex(unsigned(t[0])), Vertex(unsigned(t[1])), Vertex(unsigned(t[2])));
  return mesh;
}

template <CGAL::Deformation_algorithm_tag Tag>
class CgalDeform : public DeformPeer {
 public:
  CgalDeform(const DeformInput& input, int iterations) : input_(input), iterations_(iterations), mesh_(mesh_of(input)) {}
  void prepare() override {
    deformation_.reset();
    mesh_ = mesh_of(input_);  // CGAL moves the mesh itself; a fraction of a percent of what follows
    deformation_ = std::make_unique<Deformation>(mesh_);
    deformation_->insert_roi_vertices(vertices(mesh_).begin(), vertices(mesh_).end());
    for (const int h : input_.handle) deformation_->insert_control_vertex(Vertex(unsigned(h)));
    if (!deformation_->preprocess()) throw std::runtime_error("CGAL could not factor its system");
  }
  void drag(std::span<const glm::dvec3> target) override {
    for (std::size_t h = 0; h < target.size(); ++h)
      deformation_->set_target_position(Vertex(unsigned(input_.handle[h])), {target[h].x, target[h].y, target[h].z});
    if (iterations_ == 0) deformation_->deform();
    else deformation_->deform(unsigned(iterations_), 0);
  }
  std::vector<glm::dvec3> positions() const override {
    std::vector<glm::dvec3> p;
    for (const Vertex v : mesh_.vertices()) p.emplace_back(mesh_.point(v).x(), mesh_.point(v).y(), mesh_.point(v).z());
    return p;
  }

 private:
  using Deformation = CGAL::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, Tag>;
  DeformInput input_;
  int iterations_;
  Mesh mesh_;
  std::unique_ptr<Deformation> deformation_;
};

}  // namespace

std::unique_ptr<DeformPeer> cgal_original_arap(const DeformInput& input, int iterations) {
  return std::make_unique<CgalDeform<CGAL::ORIGINAL_ARAP>>(input, iterations);
}
std::unique_ptr<DeformPeer> cgal_sre_arap(const DeformInput& input, int iterations) {
  return std::make_unique<CgalDeform<CGAL::SRE_ARAP>>(input, iterations);
}

}  // namespace witherfield::bench
